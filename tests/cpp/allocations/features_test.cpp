// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Cepstra into a caller's buffer allocate nothing once the thread has computed some before.
#include <gtest/gtest.h>

#include "allocations/allocation_counter.hpp"
#include "hri/core/random.hpp"
#include "hri/features/speech/cepstra_stream.hpp"

namespace hri {
namespace {

using testing_data::allocations_of;

std::vector<float> noise(std::size_t count) {
  Random random(1);
  std::vector<float> audio(count);
  for (float& v : audio) v = static_cast<float>(random.normal());
  return audio;
}

// Every kind of work that can be asked for, of a stream too.
std::vector<CepstraOptions> all_options() {
  CepstraOptions hfcc;
  hfcc.filter_bank = FilterBankKind::hfcc;
  hfcc.normalisation = Normalisation::running_mean_variance;
  hfcc.rasta_pole = 0.94;
  CepstraOptions lpcc;
  lpcc.kind = CepstraKind::linear_prediction;
  lpcc.normalisation = Normalisation::none;
  CepstraOptions other_size;
  other_size.fft_size = 500;
  other_size.padding = FramePadding::centred;
  other_size.normalisation = Normalisation::running_mean;
  return {hfcc, lpcc, other_size, CepstraOptions::htk(), CepstraOptions::kaldi()};
}

TEST(Cepstra, AllocateNothingTheSecondTime) {
  std::vector<CepstraOptions> all = all_options();
  all.emplace_back();
  all.push_back(CepstraOptions::librosa(16000));
  const std::vector<float> audio = noise(16000);
  for (const CepstraOptions& options : all) {
    const CepstraComputer computer(options);
    MatrixF out(computer.num_frames(audio.size()), computer.num_features());
    const auto compute = [&] { computer.compute(audio, out); };
    compute();
    EXPECT_EQ(allocations_of(compute), 0);
  }
}

TEST(CepstraStreams, AllocateNothingOnceTheThreadHasComputed) {
  const std::vector<float> audio = noise(16000);
  for (const CepstraOptions& options : all_options()) {
    CepstraStream stream(options);
    MatrixF out(stream.max_frames(audio.size()), stream.num_features());
    stream.push(audio, out);
    stream.finish(out);
    EXPECT_EQ(allocations_of([&] {
                for (std::size_t n = 0; n < audio.size(); n += 320)
                  stream.push(Span<const float>(audio).subspan(n, 320), out);
                stream.push(audio, out);
                stream.finish(out);
              }),
              0);
  }
}

}  // namespace
}  // namespace hri
