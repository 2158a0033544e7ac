// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "recognition/word/word_augmentation.hpp"

#include <algorithm>

#include "hri/core/error.hpp"
#include "hri/core/kernels.hpp"
#include "hri/core/random.hpp"
#include "recognition/word/training_noise.hpp"

namespace hri::detail {
namespace {

// 1, 1 - step, 1 + step, 1 - 2 step, 1 + 2 step: as many as asked for.
std::vector<double> warp_factors(const WordRecognizerOptions& options) {
  std::vector<double> factors{1.0};
  for (int i = 1; static_cast<int>(factors.size()) < options.num_vtlp_factors; ++i) {
    factors.push_back(1.0 - i * options.vtlp_step);
    factors.push_back(1.0 + i * options.vtlp_step);
  }
  return factors;
}

void check(const WordSample& sample, const std::string& name, double frame_ms) {
  const std::size_t bad = first_not_finite(sample.samples.data(), sample.samples.size());
  if (bad < sample.samples.size()) {
    fail(ErrorKind::invalid_argument,
         name + ": audio is not finite at index " + std::to_string(bad));
  }
  const double duration_ms =
      1000.0 * static_cast<double>(sample.samples.size()) / std::max(1, sample.sample_rate_hz);
  if (duration_ms < frame_ms) {
    fail(ErrorKind::invalid_argument, name + ": audio is too short: " +
                                          std::to_string(duration_ms) + " ms, less than one frame");
  }
}

}  // namespace

WordAugmentation::WordAugmentation(const WordRecognizerOptions& options,
                                   const std::shared_ptr<const SpeechEmbedding>& embedding)
    : options_(validated(options)) {
  // The embedding has no filters to warp: warped copies have none of their own.
  WordRecognizerOptions cepstra_only = options;
  cepstra_only.front_end = FrontEndKind::cepstra;
  for (const double factor : warp_factors(options)) {
    if (front_ends_.empty()) {
      front_ends_.emplace_back(options, factor, embedding);
    } else {
      front_ends_.emplace_back(cepstra_only, factor);
    }
  }
}

std::vector<float> WordAugmentation::trim(const WordSample& sample, const std::string& name) const {
  check(sample, name, std::max(options_.activity.frame_ms, options_.cepstra.frame_length_ms));
  return front_end().trim(sample.samples, sample.sample_rate_hz).samples;
}

std::vector<StreamFrames> WordAugmentation::copies(Span<const float> word,
                                                   std::size_t index) const {
  std::vector<StreamFrames> result;
  result.reserve(front_ends_.size() + static_cast<std::size_t>(options_.num_noisy_copies));
  const SpeechEmbedding* embedding = front_end().embedding().get();
  result.push_back(front_end().frames(word));
  for (std::size_t warp = 1; warp < front_ends_.size(); ++warp)
    result.push_back(front_ends_[warp].frames(word));
  const double least_snr_db =
      embedding == nullptr ? options_.min_snr_db : options_.embedding_min_snr_db;
  const double largest_snr_db =
      embedding == nullptr ? options_.max_snr_db : options_.embedding_max_snr_db;
  Random random(options_.seed + (index + 1) * 0x9E3779B97F4A7C15ULL);
  for (int copy = 0; copy < options_.num_noisy_copies; ++copy) {
    const double snr_db = least_snr_db + random.uniform() * (largest_snr_db - least_snr_db);
    const std::vector<float> noisy = with_noise(word, snr_db, &random);
    const std::size_t warp = (index + static_cast<std::size_t>(copy)) % front_ends_.size();
    result.push_back(front_ends_[warp].frames(noisy));
    if (embedding != nullptr && warp > 0) {
      result.back().emplace_back(
          embedding->vector_of(noisy, front_end().sample_rate_hz()).transpose());
    }
  }
  return result;
}

std::string sample_name(const WordSample& sample, const char* list, std::size_t index) {
  return sample.name.empty() ? std::string(list) + "[" + std::to_string(index) + "]" : sample.name;
}

}  // namespace hri::detail
