// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/signal/activity.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "hri/core/error.hpp"
#include "hri/core/kernels.hpp"
#include "hri/signal/framing.hpp"

namespace hri {
namespace {

constexpr double kFloorQuantile = 0.1;

void check(const ActivityOptions& o, int sample_rate_hz) {
  require(sample_rate_hz >= 1000 && sample_rate_hz <= 384000,
          "sample_rate_hz must lie in 1000..384000");
  require(o.frame_ms >= 1 && o.frame_ms <= 1000 && o.shift_ms >= 1 && o.shift_ms <= 1000,
          "frame_ms and shift_ms must lie in 1..1000");
  require(o.silence_dbfs >= -120 && o.silence_dbfs <= 0, "silence_dbfs must lie in -120..0");
  require(o.min_range_db >= 0 && o.min_range_db <= 60, "min_range_db must lie in 0..60");
  require(o.margin_db >= 0 && o.margin_db <= 60, "margin_db must lie in 0..60");
  require(o.max_depth_db >= 1 && o.max_depth_db <= 120, "max_depth_db must lie in 1..120");
  require(o.padding_ms >= 0 && o.padding_ms <= 1000, "padding_ms must lie in 0..1000");
}

// Mean power of every frame in dB relative to full scale; digital silence is -200.
std::vector<double> frame_levels_db(Span<const float> audio, int length, int shift) {
  std::vector<double> levels(static_cast<std::size_t>(num_frames(audio.size(), length, shift)));
  for (std::size_t t = 0; t < levels.size(); ++t) {
    double power = 0;
    for (const float x :
         audio.subspan(t * static_cast<std::size_t>(shift), static_cast<std::size_t>(length))) {
      power += static_cast<double>(x) * x;
    }
    levels[t] = 10.0 * std::log10(power / length + 1e-20);
  }
  return levels;
}

}  // namespace

SpeechBounds find_speech(Span<const float> audio, int sample_rate_hz,
                         const ActivityOptions& options) {
  check(options, sample_rate_hz);
  const std::size_t bad = first_not_finite(audio.data(), audio.size());
  if (bad < audio.size()) {
    fail(ErrorKind::invalid_argument, "audio is not finite at sample " + std::to_string(bad));
  }
  const int length =
      std::max(1, static_cast<int>(std::lround(options.frame_ms * sample_rate_hz / 1000)));
  const int shift =
      std::max(1, static_cast<int>(std::lround(options.shift_ms * sample_rate_hz / 1000)));
  const std::vector<double> levels = frame_levels_db(audio, length, shift);
  if (levels.empty()) {
    fail(ErrorKind::invalid_argument, "audio is too short: " + std::to_string(audio.size()) +
                                          " samples, one frame takes " + std::to_string(length));
  }
  std::vector<double> sorted = levels;
  std::sort(sorted.begin(), sorted.end());
  const double floor =
      sorted[static_cast<std::size_t>(kFloorQuantile * static_cast<double>(sorted.size()))];
  const double peak = sorted.back();
  if (peak < options.silence_dbfs || peak - floor < options.min_range_db) return {};

  // Above the noise, but neither deeper than max_depth below the peak nor so high that a trimmed
  // clip without any silence would lose its quieter half.
  const double threshold =
      std::max(peak - options.max_depth_db, std::min(floor + options.margin_db, peak - 10.0));
  const auto loud = [&](double level) { return level > threshold; };
  const auto first = std::find_if(levels.begin(), levels.end(), loud) - levels.begin();
  const auto last = levels.rend() - std::find_if(levels.rbegin(), levels.rend(), loud) - 1;
  const auto padding =
      static_cast<std::ptrdiff_t>(std::lround(options.padding_ms * sample_rate_hz / 1000));
  SpeechBounds bounds;
  bounds.first = static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, first * shift - padding));
  bounds.last = std::min(audio.size(), static_cast<std::size_t>(last * shift + length + padding));
  bounds.found = true;
  return bounds;
}

}  // namespace hri
