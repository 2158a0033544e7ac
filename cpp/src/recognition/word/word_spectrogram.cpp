// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/recognition/word/word_spectrogram.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "hri/core/error.hpp"

namespace hri {
namespace {

constexpr double kLowHz = 60;
constexpr double kHighHz = 7600;
constexpr double kHighShare = 0.475;  // of the sample rate, at most
constexpr float kRangeDb = 70;
constexpr float kUnitDb = 17;
constexpr double kQuietest = 0.05;  // of the frames
constexpr float kBelowDb = 3;       // the quietest, where there is no audio

CepstraOptions log_mel_options(int sample_rate_hz) {
  CepstraOptions o;
  o.sample_rate_hz = sample_rate_hz;
  o.pre_emphasis = 0;
  o.window = WindowKind::hann;
  o.num_filters = WordSpectrogram::kNumBands;
  o.low_hz = kLowHz;
  o.high_hz = std::min(kHighHz, kHighShare * sample_rate_hz);
  o.decibels = true;
  return o;
}

VectorF middles(const CepstraOptions& options) {
  const auto mel = [](double hz) { return 2595 * std::log10(1 + hz / 700); };
  const double low = mel(options.low_hz);
  const double step = (mel(options.high_hz) - low) / (WordSpectrogram::kNumBands + 1);
  VectorF result(WordSpectrogram::kNumBands);
  for (int b = 0; b < WordSpectrogram::kNumBands; ++b)
    result[b] = static_cast<float>(700 * (std::pow(10, (low + (b + 1) * step) / 2595) - 1));
  return result;
}

// Of every band, what the quietest frames have.
VectorF floor_of(const MatrixF& decibels) {
  VectorF result(decibels.cols());
  std::vector<float> column(static_cast<std::size_t>(decibels.rows()));
  const auto place = static_cast<std::ptrdiff_t>(kQuietest * static_cast<double>(column.size()));
  for (Eigen::Index b = 0; b < decibels.cols(); ++b) {
    Eigen::Map<VectorF>(column.data(), decibels.rows()) = decibels.col(b);
    std::nth_element(column.begin(), column.begin() + place, column.end());
    result[b] = column[static_cast<std::size_t>(place)] - kBelowDb;
  }
  return result;
}

}  // namespace

WordSpectrogram::WordSpectrogram(int sample_rate_hz)
    : log_mel_(log_mel_options(sample_rate_hz)), band_hz_(middles(log_mel_.options())) {}

MatrixF WordSpectrogram::window(Span<const float> audio, std::size_t middle) const {
  constexpr int kRows = kNumFrames + 2 * kMargin;
  const auto shift = static_cast<double>(log_mel_.options().samples_of(10));
  const auto half_frame = static_cast<double>(log_mel_.options().samples_of(25)) / 2;
  const MatrixF all = log_mel_.compute(audio);
  if (all.rows() == 0) return MatrixF::Zero(kRows, kNumBands);
  const auto middle_frame =
      static_cast<Eigen::Index>(std::lround((static_cast<double>(middle) - half_frame) / shift));
  const Eigen::Index first = middle_frame - kRows / 2;
  const Eigen::Index begin = std::clamp<Eigen::Index>(first, 0, all.rows());
  const Eigen::Index end = std::clamp<Eigen::Index>(first + kRows, begin, all.rows());
  MatrixF result(kRows, kNumBands);
  result.rowwise() = floor_of(all).transpose();
  result.middleRows(begin - first, end - begin) = all.middleRows(begin, end - begin);
  return result;
}

MatrixF WordSpectrogram::normalised(ConstMatrixRefF decibels) {
  MatrixF result = decibels.cwiseMax(decibels.maxCoeff() - kRangeDb);
  result.array() -= result.mean();
  return result / kUnitDb;
}

MatrixF WordSpectrogram::input(const MatrixF& window) {
  require(window.rows() >= kMargin + kNumFrames, "the window has too few frames");
  return normalised(window.middleRows(kMargin, kNumFrames));
}

}  // namespace hri
