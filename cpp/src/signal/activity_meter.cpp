// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/signal/activity_meter.hpp"

#include <algorithm>
#include <cmath>

#include "core/numbers.hpp"
#include "hri/core/error.hpp"
#include "hri/core/kernels.hpp"
#include "signal/word_bounds.hpp"

namespace hri {
namespace {

using detail::kPi;
constexpr double kRumbleHz = 60;
constexpr std::array<double, kMaxActivityBands + 1> kEdgesHz{100, 500, 1000, 2000, 3800, 7500};
constexpr double kLowHz = 1000;
// Voicing is computed below this: noise of kitchens and streets has little energy there.
constexpr double kVoicedHz = 900;
constexpr double kPitchRateHz = 4000;
constexpr double kMinPitchHz = 60;
constexpr double kMaxPitchHz = 400;
constexpr double kVoicingWindowS = 0.025;
// Half-way to a difference: low noise is then not mistaken for a low voice, and voices keep their
// pitch.
constexpr double kWhitening = 0.7;
constexpr double kHighest = 0.47;  // of the sample rate, so that no filter is laid on the border
constexpr double kSilence = 1e-12;

std::size_t samples_of(double ms, int rate_hz) {
  return static_cast<std::size_t>(std::max(1L, std::lround(ms * rate_hz / 1000)));
}

}  // namespace

ActivityMeter::Section ActivityMeter::low_pass(double cutoff_hz, int rate_hz) {
  const double k = std::tan(kPi * std::min(cutoff_hz / rate_hz, kHighest));
  const double norm = 1 / (1 + std::sqrt(2.0) * k + k * k);
  Section s;
  s.b0 = s.b2 = k * k * norm;
  s.b1 = 2 * s.b0;
  s.a1 = 2 * (k * k - 1) * norm;
  s.a2 = (1 - std::sqrt(2.0) * k + k * k) * norm;
  return s;
}

ActivityMeter::Section ActivityMeter::high_pass(double cutoff_hz, int rate_hz) {
  Section s = low_pass(cutoff_hz, rate_hz);
  const double k = std::tan(kPi * std::min(cutoff_hz / rate_hz, kHighest));
  const double norm = s.b0 / (k * k);
  s.b0 = s.b2 = norm;
  s.b1 = -2 * norm;
  return s;
}

ActivityMeter::Section ActivityMeter::band_pass(double low_hz, double high_hz, int rate_hz) {
  const double low = std::tan(kPi * low_hz / rate_hz);
  const double high = std::tan(kPi * std::min(high_hz / rate_hz, kHighest));
  const double width = high - low;
  const double norm = 1 / (1 + width + low * high);
  Section s;
  s.b0 = width * norm;
  s.b1 = 0;
  s.b2 = -s.b0;
  s.a1 = 2 * (low * high - 1) * norm;
  s.a2 = (1 - width + low * high) * norm;
  return s;
}

ActivityMeter::ActivityMeter(int sample_rate_hz, const ActivityOptions& options) {
  detail::check(options, sample_rate_hz);
  frame_length_ = samples_of(options.frame_ms, sample_rate_hz);
  frame_shift_ = samples_of(options.shift_ms, sample_rate_hz);
  rumble_ = high_pass(kRumbleHz, sample_rate_hz);
  smooth_ = low_pass(kVoicedHz, sample_rate_hz);
  for (std::size_t b = 0; b < kMaxActivityBands; ++b) {
    if (b > 0 && kEdgesHz[b + 1] > 0.5 * sample_rate_hz && kEdgesHz[b] > 0.4 * sample_rate_hz)
      break;
    bands_.push_back(band_pass(kEdgesHz[b], kEdgesHz[b + 1], sample_rate_hz));
    if (kEdgesHz[b + 1] <= kLowHz) ++num_low_bands_;
  }
  power_.assign(bands_.size() + 1, std::vector<float>(frame_length_));
  decimation_ = static_cast<std::size_t>(std::max(1L, std::lround(sample_rate_hz / kPitchRateHz)));
  const double pitch_rate_hz = sample_rate_hz / static_cast<double>(decimation_);
  min_lag_ = static_cast<std::size_t>(pitch_rate_hz / kMaxPitchHz);
  max_lag_ = static_cast<std::size_t>(std::ceil(pitch_rate_hz / kMinPitchHz));
  window_ = static_cast<std::size_t>(std::lround(kVoicingWindowS * pitch_rate_hz));
  const std::size_t longest = std::max(frame_length_, frame_shift_) / decimation_ + 2;
  pitch_.resize(window_ + max_lag_ + longest);
  energy_.resize(window_ + max_lag_ + 1);
  reset();
}

void ActivityMeter::reset() {
  const auto forget = [](Section& s) { s.s1 = s.s2 = 0; };
  forget(rumble_);
  forget(smooth_);
  std::for_each(bands_.begin(), bands_.end(), forget);
  std::fill(pitch_.begin(), pitch_.end(), 0.0F);
  num_pitch_ = window_ + max_lag_;  // silence precedes the stream
  filled_ = skip_ = phase_ = 0;
  offset_ = last_smooth_ = 0;
  started_ = false;
}

std::size_t ActivityMeter::take(Span<const float> samples, ActivityFrame* frame, bool* complete) {
  *complete = false;
  for (std::size_t n = 0; n < samples.size(); ++n) {
    hear(samples[n]);
    if (filled_ < frame_length_) continue;
    finish_frame(frame);
    *complete = true;
    return n + 1;
  }
  return samples.size();
}

void ActivityMeter::hear(float sample) {
  if (!started_) {
    offset_ = sample;  // a DC offset is not sound, and its onset not a click
    started_ = true;
  }
  const double x = rumble_.filter(sample - offset_);
  const double smooth = smooth_.filter(x);
  if (phase_ == 0) {
    pitch_[num_pitch_++] = static_cast<float>(smooth - kWhitening * last_smooth_);
    last_smooth_ = smooth;
    phase_ = decimation_;
  }
  --phase_;
  const bool skipped = skip_ > 0;
  if (!skipped) power_[0][filled_] = static_cast<float>(x * x);
  for (std::size_t b = 0; b < bands_.size(); ++b) {
    const double y = bands_[b].filter(x);
    if (!skipped) power_[b + 1][filled_] = static_cast<float>(y * y);
  }
  if (skipped) {
    --skip_;
  } else {
    ++filled_;
  }
}

void ActivityMeter::finish_frame(ActivityFrame* frame) {
  const auto decibel = [&](const std::vector<float>& squares) {
    double sum = 0;
    for (const float v : squares) sum += v;
    return static_cast<float>(10 * std::log10(sum / static_cast<double>(frame_length_) + kSilence));
  };
  frame->level_db = decibel(power_[0]);
  frame->band_db.fill(0);
  for (std::size_t b = 0; b < bands_.size(); ++b) frame->band_db[b] = decibel(power_[b + 1]);
  frame->voicing = voicing();

  const std::size_t kept = frame_length_ > frame_shift_ ? frame_length_ - frame_shift_ : 0;
  skip_ = frame_shift_ > frame_length_ ? frame_shift_ - frame_length_ : 0;
  for (std::vector<float>& squares : power_)
    std::copy(squares.end() - static_cast<std::ptrdiff_t>(kept), squares.end(), squares.begin());
  filled_ = kept;
}

float ActivityMeter::voicing() {
  const std::size_t needed = window_ + max_lag_;
  std::copy(pitch_.begin() + static_cast<std::ptrdiff_t>(num_pitch_ - needed),
            pitch_.begin() + static_cast<std::ptrdiff_t>(num_pitch_), pitch_.begin());
  num_pitch_ = needed;
  energy_[0] = 0;
  for (std::size_t n = 0; n < needed; ++n)
    energy_[n + 1] = energy_[n] + static_cast<double>(pitch_[n]) * pitch_[n];
  const float* now = pitch_.data() + max_lag_;
  const double own = energy_[needed] - energy_[max_lag_];
  double best = 0;
  for (std::size_t lag = min_lag_; lag <= max_lag_; ++lag) {
    const double before = energy_[needed - lag] - energy_[max_lag_ - lag];
    const double product = dot(now, now - lag, static_cast<int>(window_));
    best = std::max(best, product / std::sqrt(own * before + kSilence * kSilence));
  }
  return static_cast<float>(std::min(1.0, best));
}

}  // namespace hri
