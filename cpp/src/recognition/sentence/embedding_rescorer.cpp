// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "recognition/sentence/embedding_rescorer.hpp"

#include <algorithm>

namespace hri::detail {
namespace {

constexpr double kAroundMs = 30;  // of a word: boundaries are not that exact

}  // namespace

VectorF EmbeddingRescorer::vector_of(const SpeechEmbedding& embedding, Span<const float> audio,
                                     int sample_rate_hz, std::ptrdiff_t first,
                                     std::ptrdiff_t last) {
  const auto around = static_cast<std::ptrdiff_t>(kAroundMs * sample_rate_hz / 1000);
  const auto size = static_cast<std::ptrdiff_t>(audio.size());
  first = std::clamp<std::ptrdiff_t>(first - around, 0, size);
  last = std::clamp<std::ptrdiff_t>(last + around, first, size);
  return embedding.vector_of({audio.data() + first, static_cast<std::size_t>(last - first)},
                             sample_rate_hz);
}

VectorF EmbeddingRescorer::scores(Span<const float> audio, int sample_rate_hz, std::ptrdiff_t first,
                                  std::ptrdiff_t last) const {
  const VectorF vector = vector_of(*words_.embedding, audio, sample_rate_hz, first, last);
  return words_.classifier.scores({vector.data(), static_cast<std::size_t>(vector.size())});
}

void EmbeddingRescorer::rescore(const std::vector<RescoredSpan>& spans, double weight,
                                const std::vector<WordChain>& chains, MatrixF* log_emissions) {
  for (const RescoredSpan& span : spans) {
    const Eigen::Index num_frames = span.last_frame - span.first_frame;
    const VectorF of_frame =
        span.log_odds * static_cast<float>(weight / static_cast<double>(num_frames));
    Eigen::Index state = 0;
    for (Eigen::Index label = 0; label < of_frame.size(); ++label) {
      const Eigen::Index num_states = chains[static_cast<std::size_t>(label)].log_start.size();
      log_emissions->block(span.first_frame, state, num_frames, num_states).array() +=
          of_frame[label];
      state += num_states;
    }
  }
}

}  // namespace hri::detail
