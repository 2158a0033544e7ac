// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "recognition/word/spectrogram_augmentation.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace hri::detail {
namespace {

constexpr int kFrames = WordSpectrogram::kNumFrames;
constexpr int kBands = WordSpectrogram::kNumBands;
constexpr double kNoiseSeconds = 10;
// Ranges that training draws from, evenly.
constexpr double kMostSpeed = 0.15;  // log of the factor on time
constexpr double kMostShift = 10;    // frames
constexpr double kMostWarp = 0.1;    // log of the factor on frequencies
constexpr double kNoisy = 0.7;       // share of the examples
constexpr double kLeastSnrDb = -3;
constexpr double kLargestSnrDb = 32;
constexpr double kWhite = 0.3;  // share of the noise; the power of other noise falls with frequency
constexpr double kMostSlope = 1.2;  // to the power of this, at most
constexpr int kNumMasks = 2;        // of bands, and of frames
constexpr double kMostBands = 6;
constexpr double kMostFrames = 15;
constexpr int kLoudest = 3;  // the word has one in so many frames, at least

double mel(double hz) { return 2595 * std::log10(1 + hz / 700); }

double between(double low, double high, Random* random) {
  return low + (high - low) * random->uniform();
}

float power_of(float decibels) { return std::exp(decibels * 0.23025851F); }

// Mean power of the loudest frames.
double loudness(const MatrixF& powers) {
  VectorF of_frames = powers.rowwise().sum();
  const Eigen::Index count = of_frames.size() / kLoudest;
  std::nth_element(of_frames.data(), of_frames.data() + count, of_frames.data() + of_frames.size(),
                   [](float a, float b) { return a > b; });
  return static_cast<double>(of_frames.head(count).mean());
}

void mask(Random* random, MatrixF* input) {
  for (int i = 0; i < kNumMasks; ++i) {
    const auto band = static_cast<Eigen::Index>(between(0, kBands, random));
    const auto bands = static_cast<Eigen::Index>(between(0, kMostBands, random));
    input->middleCols(band, std::min<Eigen::Index>(bands, kBands - band)).setZero();
    const auto frame = static_cast<Eigen::Index>(between(0, kFrames, random));
    const auto frames = static_cast<Eigen::Index>(between(0, kMostFrames, random));
    input->middleRows(frame, std::min<Eigen::Index>(frames, kFrames - frame)).setZero();
  }
}

}  // namespace

SpectrogramAugmentation::SpectrogramAugmentation(const WordSpectrogram& spectrogram,
                                                 std::uint64_t seed)
    : band_hz_(spectrogram.band_hz()),
      low_mel_(mel(static_cast<double>(band_hz_[0]))),
      mel_step_((mel(static_cast<double>(band_hz_[kBands - 1])) - low_mel_) / (kBands - 1)) {
  Random random(seed);
  std::vector<float> audio(
      static_cast<std::size_t>(kNoiseSeconds * spectrogram.log_mel().options().sample_rate_hz));
  for (float& x : audio) x = static_cast<float>(random.normal());
  noise_ = spectrogram.log_mel().compute(audio).unaryExpr(&power_of);
}

void SpectrogramAugmentation::add_noise(double snr_db, Random* random, MatrixF* decibels) const {
  const auto first = static_cast<Eigen::Index>(
      random->below(static_cast<std::uint64_t>(noise_.rows() - decibels->rows())));
  const double slope = random->uniform() < kWhite ? 0 : between(0, kMostSlope, random);
  VectorF colour(kBands);
  for (Eigen::Index b = 0; b < kBands; ++b)
    colour[b] = static_cast<float>(std::pow(static_cast<double>(band_hz_[b]) / 1000, -slope));
  MatrixF noise = noise_.middleRows(first, decibels->rows()) * colour.asDiagonal();
  MatrixF powers = decibels->unaryExpr(&power_of);
  const double of_noise = static_cast<double>(noise.rowwise().sum().mean());
  const double gain = loudness(powers) / of_noise * std::pow(10, -snr_db / 10);
  powers += static_cast<float>(gain) * noise;
  *decibels = powers.unaryExpr([](float p) { return 4.3429448F * std::log(p); });
}

MatrixF SpectrogramAugmentation::noisy_input(const MatrixF& window, double snr_db,
                                             Random* random) const {
  MatrixF frames = window.middleRows(WordSpectrogram::kMargin, kFrames);
  add_noise(snr_db, random, &frames);
  return WordSpectrogram::normalised(frames);
}

void SpectrogramAugmentation::make_example(const MatrixF& window, Random* random,
                                           MatrixF* input) const {
  const double speed = std::exp(between(-kMostSpeed, kMostSpeed, random));
  const double shift = between(-kMostShift, kMostShift, random);
  const double warp = std::exp(between(-kMostWarp, kMostWarp, random));
  std::vector<Eigen::Index> band(kBands);
  VectorF band_share(kBands);
  for (Eigen::Index b = 0; b < kBands; ++b) {
    const double at = (mel(warp * static_cast<double>(band_hz_[b])) - low_mel_) / mel_step_;
    const double inside = std::clamp(at, 0.0, kBands - 1.001);
    band[static_cast<std::size_t>(b)] = static_cast<Eigen::Index>(inside);
    band_share[b] = static_cast<float>(inside - std::floor(inside));
  }
  MatrixF frames(kFrames, kBands);
  const auto rows = static_cast<double>(window.rows());
  for (Eigen::Index t = 0; t < kFrames; ++t) {
    const double at = (static_cast<double>(t) - kFrames / 2.0) * speed + rows / 2 + shift;
    const double inside = std::clamp(at, 0.0, rows - 1.001);
    const auto row = static_cast<Eigen::Index>(inside);
    const auto share = static_cast<float>(inside - std::floor(inside));
    for (Eigen::Index b = 0; b < kBands; ++b) {
      const Eigen::Index from = band[static_cast<std::size_t>(b)];
      const float before =
          window(row, from) + band_share[b] * (window(row, from + 1) - window(row, from));
      const float after = window(row + 1, from) +
                          band_share[b] * (window(row + 1, from + 1) - window(row + 1, from));
      frames(t, b) = before + share * (after - before);
    }
  }
  if (random->uniform() < kNoisy)
    add_noise(between(kLeastSnrDb, kLargestSnrDb, random), random, &frames);
  *input = WordSpectrogram::normalised(frames);
  mask(random, input);
}

}  // namespace hri::detail
