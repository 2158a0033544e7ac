// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "recognition/word/word_frames.hpp"

#include <algorithm>

#include "hri/core/error.hpp"
#include "hri/core/kernels.hpp"
#include "hri/core/random.hpp"
#include "recognition/word/training_noise.hpp"

namespace hri {
namespace {

// 1, 1 - step, 1 + step, 1 - 2 step, 1 + 2 step: as many as asked for.
std::vector<double> warp_factors(const WordRecognizerOptions& options) {
  std::vector<double> factors{1.0};
  for (int i = 1; static_cast<int>(factors.size()) < options.num_warps; ++i) {
    factors.push_back(1.0 - i * options.warp_step);
    factors.push_back(1.0 + i * options.warp_step);
  }
  return factors;
}

// Also those of recognisers that were loaded, whose files nobody has checked for this.
void check(const WordRecognizerOptions& options) {
  require(options.num_warps == 1 || options.num_warps == 3 || options.num_warps == 5,
          "num_warps must be 1, 3 or 5");
  require(options.noise_copies >= 0 && options.noise_copies <= 10,
          "noise_copies must lie in 0..10");
  require(options.noise_low_db >= -20 && options.noise_low_db <= options.noise_high_db &&
              options.noise_high_db <= 100,
          "noise_low_db and noise_high_db must lie in -20..100, in this order");
  require(options.floor_db >= 20 && options.floor_db <= 120, "floor_db must lie in 20..120");
  require(options.warp_step >= 0 && options.warp_step <= 0.2, "warp_step must lie in 0..0.2");
}

void check(const WordSample& sample, const std::string& what, double frame_ms) {
  const std::size_t bad = first_not_finite(sample.samples.data(), sample.samples.size());
  if (bad < sample.samples.size()) {
    fail(ErrorKind::invalid_argument,
         what + ": audio is not finite at index " + std::to_string(bad));
  }
  const double duration_ms =
      1000.0 * static_cast<double>(sample.samples.size()) / std::max(1, sample.sample_rate_hz);
  if (duration_ms < frame_ms) {
    fail(ErrorKind::invalid_argument, what + ": audio is too short: " +
                                          std::to_string(duration_ms) + " ms, less than one frame");
  }
}

}  // namespace

WordFrames::WordFrames(const WordRecognizer& recognizer) {
  check(recognizer.options_);
  for (const double factor : warp_factors(recognizer.options_)) {
    WordRecognizerOptions warped = recognizer.options_;
    warped.cepstra.warp *= factor;
    fronts_.push_back(WordRecognizer(warped, recognizer.labels_));
  }
}

std::vector<float> WordFrames::locate(const WordSample& sample, const std::string& what) const {
  const WordRecognizer& plain = fronts_.front();
  const WordRecognizerOptions& options = plain.options_;
  check(sample, what, std::max(options.activity.frame_ms, options.cepstra.frame_length_ms));
  return plain.locate(sample.samples, sample.sample_rate_hz, nullptr);
}

std::vector<std::vector<MatrixF>> WordFrames::of(Span<const float> word, std::size_t index) const {
  const WordRecognizerOptions& o = fronts_.front().options_;
  std::vector<std::vector<MatrixF>> variants;
  variants.reserve(fronts_.size());
  for (const WordRecognizer& front : fronts_) variants.push_back(front.frames(word));
  Random random(o.models.seed + (index + 1) * 0x9E3779B97F4A7C15ULL);
  for (int copy = 0; copy < o.noise_copies; ++copy) {
    const double snr_db = o.noise_low_db + random.uniform() * (o.noise_high_db - o.noise_low_db);
    const std::vector<float> noisy = detail::with_noise(word, snr_db, &random);
    const std::size_t warp = (index + static_cast<std::size_t>(copy)) % fronts_.size();
    variants.push_back(fronts_[warp].frames(noisy));
  }
  return variants;
}

}  // namespace hri
