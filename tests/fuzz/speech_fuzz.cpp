// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Any options of speech, with any samples: refused, or features and words that are numbers.
#include <algorithm>
#include <vector>

#include "fuzzing.hpp"
#include "hri/features/speech/cepstra.hpp"
#include "hri/features/speech/cepstra_stream.hpp"
#include "hri/recognition/word/word_recognizer.hpp"
#include "hri/signal/shrinkage.hpp"
#include "hri/signal/stream/endpointer.hpp"

namespace {

using hri::fuzzing::Bytes;

std::vector<float> draw_samples(Bytes& bytes) {
  std::vector<float> samples(static_cast<std::size_t>(bytes.below(6000)));
  const auto level = static_cast<float>(bytes.number(0, 1));
  unsigned state = bytes.raw<unsigned>() | 1U;
  for (float& v : samples) {
    state = state * 1664525U + 1013904223U;
    v = level * (static_cast<float>(state >> 8U) / 8388608.0F - 1);
  }
  if (!samples.empty())
    samples[static_cast<std::size_t>(bytes.below(static_cast<int>(samples.size())))] =
        static_cast<float>(bytes.number(-1, 1));
  return samples;
}

void cepstra(Bytes& bytes) {
  hri::CepstraOptions options;
  hri::fuzzing::draw_options(bytes, &options);
  const hri::CepstraComputer computer(options);
  const auto samples = draw_samples(bytes);
  const auto rows = computer.compute({samples.data(), samples.size()});
  if (!rows.allFinite()) std::abort();
}

void endpoints(Bytes& bytes) {
  hri::EndpointerOptions options;
  hri::fuzzing::draw_options(bytes, &options);
  hri::Endpointer endpointer(bytes.below(50000), options);
  const auto samples = draw_samples(bytes);
  hri::Endpoint event;
  for (std::size_t at = 0; at < samples.size();) {
    const std::size_t n =
        std::min(samples.size() - at, std::size_t{1} + static_cast<std::size_t>(bytes.below(2000)));
    const std::size_t heard = endpointer.consume({samples.data() + at, n}, &event);
    if (heard > n || (heard == 0 && event.kind == hri::EndpointKind::none)) std::abort();
    at += heard;
  }
  for (int i = 0; endpointer.finish().kind != hri::EndpointKind::none; ++i) {
    if (i > 10) std::abort();
  }
}

void words(Bytes& bytes) {
  hri::WordRecognizerOptions options;
  options.max_iterations = 1;
  hri::fuzzing::draw_options(bytes, &options);
  // What takes long by right is no finding.
  options.max_iterations = std::min(options.max_iterations, 2);
  options.num_codewords = std::min(options.num_codewords, 16);
  options.num_states = std::min(options.num_states, 8);
  options.num_mixtures = std::min(options.num_mixtures, 4);
  options.garbage_mixtures = std::min(options.garbage_mixtures, 4);
  options.num_noisy_copies = std::min(options.num_noisy_copies, 1);
  options.network.num_channels = std::min(options.network.num_channels, 16);
  options.network.num_blocks = std::min(options.network.num_blocks, 2);
  options.network.num_epochs = std::min(options.network.num_epochs, 2);
  std::vector<std::vector<float>> sounds(4);
  std::vector<hri::WordSample> clips;
  for (std::size_t i = 0; i < sounds.size(); ++i) {
    sounds[i] = draw_samples(bytes);
    clips.push_back({{sounds[i].data(), sounds[i].size()},
                     8000,
                     i % 2 == 0 ? "a" : "b",
                     i / 2 == 0 ? "x" : "y"});
  }
  const auto recogniser = hri::WordRecognizer::train(clips, options);
  const auto samples = draw_samples(bytes);
  hri::fuzzing::check(recogniser.recognise({samples.data(), samples.size()}, 8000));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  hri::fuzzing::expect_typed_errors([&] {
    Bytes bytes(data, size);
    switch (bytes.byte() % 8) {
      case 0:
        words(bytes);
        break;
      case 1:
      case 2:
      case 3:
        endpoints(bytes);
        break;
      default:
        cepstra(bytes);
    }
  });
  return 0;
}
