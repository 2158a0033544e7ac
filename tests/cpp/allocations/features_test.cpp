// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Cepstra into a caller's buffer allocate nothing once the thread has computed some before.
#include <gtest/gtest.h>

#include "allocations/allocation_counter.hpp"
#include "hri/core/random.hpp"
#include "hri/features/cepstra.hpp"

namespace hri {
namespace {

using testing_data::allocations_of;

TEST(Cepstra, AllocateNothingTheSecondTime) {
  Random random(1);
  std::vector<float> audio(16000);
  for (float& v : audio) v = static_cast<float>(random.normal());
  for (const FilterBankKind kind : {FilterBankKind::mel, FilterBankKind::hfcc}) {
    for (const Normalisation normalisation : {Normalisation::none, Normalisation::mean_variance}) {
      CepstraOptions options;
      options.filter_bank = kind;
      options.normalisation = normalisation;
      const CepstraComputer computer(options);
      MatrixF out(computer.num_frames(audio.size()), computer.num_features());
      const auto compute = [&] { computer.compute(audio, out); };
      compute();
      EXPECT_EQ(allocations_of(compute), 0);
    }
  }
}

}  // namespace
}  // namespace hri
