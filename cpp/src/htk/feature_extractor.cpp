// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/htk/feature_extractor.hpp"

#include <algorithm>
#include <cmath>

#include "hri/core/error.hpp"
#include "hri/core/kernels.hpp"
#include "hri/signal/linear_prediction.hpp"
#include "htk/base_conversion.hpp"
#include "htk/differences.hpp"

namespace hri::htk {
namespace {

constexpr double kFullScale = 32768;  // of the 16-bit samples that HTK computes with
constexpr double kLogZero = -1e10;    // HTK's log of no energy
constexpr double kLeastEnergy = 2.45e-308;
constexpr float kLeastFilter = 1;  // HTK's MELFLOOR

bool is_of_filters(BaseKind base) {
  return base == BaseKind::mfcc || base == BaseKind::fbank || base == BaseKind::melspec;
}

bool is_of_predictor(BaseKind base) {
  return base == BaseKind::lpc || base == BaseKind::lprefc || base == BaseKind::irefc;
}

ParameterKind checked(ParameterKind kind) {
  const bool known =
      is_of_filters(kind.base) || is_of_predictor(kind.base) || kind.base == BaseKind::lpcepstra;
  if (!known)
    fail(ErrorKind::invalid_argument,
         "parameters of kind " + kind.text() +
             " are not computed; MFCC, FBANK, MELSPEC, LPC, LPREFC, IREFC and LPCEPSTRA are");
  if (const char* fault = kind.fault(); fault != nullptr)
    fail(ErrorKind::invalid_argument, "the parameter kind '" + kind.text() + "' " + fault);
  require(!kind.has(kC0) || kind.base == BaseKind::mfcc, "_0 needs the kind MFCC");
  return kind;
}

// Milliseconds of so many whole samples as fit, as HTK rounds.
double whole_samples_ms(double ms, int sample_rate_hz) {
  constexpr double kRounding = 1e-6;
  const double samples = std::floor(ms * sample_rate_hz / 1000 + kRounding);
  return std::max(1.0, samples) * 1000 / sample_rate_hz;
}

CepstraOptions cepstra_options(ParameterKind kind, int sample_rate_hz,
                               const HtkFeatureOptions& given) {
  require(sample_rate_hz >= 1000 && sample_rate_hz <= 384000,
          "sample_rate_hz must lie in 1000..384000");
  CepstraOptions o = CepstraOptions::htk(sample_rate_hz);
  o.frame_shift_ms = whole_samples_ms(given.frame_shift_ms, sample_rate_hz);
  o.frame_length_ms = whole_samples_ms(given.frame_length_ms, sample_rate_hz);
  o.remove_dc = given.zero_mean;
  o.pre_emphasis = given.pre_emphasis;
  o.window = given.hamming ? WindowKind::hamming : WindowKind::rectangular;
  o.use_power = given.use_power;
  o.num_filters = given.num_filters;
  o.low_hz = given.low_hz;
  o.high_hz = given.high_hz;
  o.warp = 1 / given.warp;
  o.warp_low_hz = given.warp_low_hz;
  o.warp_high_hz = given.warp_high_hz;
  o.lpc_order = given.lpc_order;
  o.num_cepstra = given.num_cepstra;
  o.lifter = given.lifter;
  o.use_c0 = kind.has(kC0);
  if (!is_of_filters(kind.base)) o.kind = CepstraKind::linear_prediction;
  // Of the others only frames and filters are used.
  if (kind.base != BaseKind::mfcc && kind.base != BaseKind::lpcepstra) o.num_cepstra = 1;
  return o;
}

int fft_size_of(int frame_length) {
  int size = 2;
  while (size < frame_length) size *= 2;
  return size;
}

}  // namespace

FeatureExtractor::FeatureExtractor(ParameterKind kind, int sample_rate_hz,
                                   const HtkFeatureOptions& options)
    : kind_(checked(kind)),
      options_(validated(options)),
      computer_(cepstra_options(kind, sample_rate_hz, options)),
      fft_(fft_size_of(computer_.frame_length())),
      bank_(computer_.options().filter_bank_options(), sample_rate_hz, fft_.size()),
      window_(make_window(computer_.options().window, computer_.frame_length())) {}

int FeatureExtractor::num_base() const {
  if (is_of_predictor(kind_.base)) return options_.lpc_order;
  return kind_.base == BaseKind::fbank || kind_.base == BaseKind::melspec ? options_.num_filters
                                                                          : options_.num_cepstra;
}

int FeatureExtractor::num_columns() const {
  const int num_static = num_base() + (kind_.has(kC0) ? 1 : 0) + (kind_.has(kEnergy) ? 1 : 0);
  return num_static * kind_.num_blocks() - (kind_.has(kNoEnergy) ? 1 : 0);
}

std::int32_t FeatureExtractor::sample_period() const {
  constexpr double kUnitsPerMs = 1e4;
  return static_cast<std::int32_t>(std::lround(options_.frame_shift_ms * kUnitsPerMs));
}

MatrixF FeatureExtractor::compute(Span<const float> audio) const {
  const std::size_t bad = first_not_finite(audio.data(), audio.size());
  if (bad < audio.size())
    fail(ErrorKind::invalid_argument, "audio is not finite at sample " + std::to_string(bad));
  require(computer_.num_frames(audio.size()) > 0, "audio is too short for one frame");
  const MatrixF coefficients = base(audio);
  MatrixF statics(coefficients.rows(), coefficients.cols() + (kind_.has(kEnergy) ? 1 : 0));
  statics.leftCols(coefficients.cols()) = coefficients;
  if (kind_.has(kEnergy)) statics.rightCols(1) = log_energies(audio).cast<float>();
  const MatrixF all = detail::with_differences(statics, kind_, options_);
  return kind_.has(kNoEnergy) ? detail::without_energy(all, kind_) : all;
}

MatrixF FeatureExtractor::base(Span<const float> audio) const {
  switch (kind_.base) {
    case BaseKind::fbank:
      return filter_energies(audio).cwiseMax(kLeastFilter).array().log();
    case BaseKind::melspec:
      return filter_energies(audio);
    case BaseKind::lpc:
      return linear_prediction(audio);
    case BaseKind::lprefc:
    case BaseKind::irefc:
      return detail::converted_statics(linear_prediction(audio), {BaseKind::lpc, 0}, kind_.base,
                                       false, options_);
    default:
      return computer_.compute(audio);
  }
}

// A frame in the scale of 16-bit samples; unless `raw` with pre-emphasis and window.
void FeatureExtractor::condition(Span<const float> audio, Eigen::Index frame, bool raw,
                                 VectorD* out) const {
  const auto length = static_cast<Eigen::Index>(computer_.frame_length());
  const float* first = audio.data() + frame * computer_.frame_shift();
  *out = Eigen::Map<const VectorF>(first, length).cast<double>() * kFullScale;
  if (options_.zero_mean) out->array() -= out->mean();
  if (raw) return;
  for (Eigen::Index n = length - 1; n > 0; --n) (*out)[n] -= options_.pre_emphasis * (*out)[n - 1];
  (*out)[0] *= 1 - options_.pre_emphasis;
  out->array() *= Eigen::Map<const VectorF>(window_.data(), length).cast<double>().array();
}

MatrixF FeatureExtractor::filter_energies(Span<const float> audio) const {
  MatrixF out(computer_.num_frames(audio.size()), bank_.num_filters());
  VectorD frame;
  VectorF padded = VectorF::Zero(fft_.size());
  VectorF spectrum(fft_.num_bins());
  const Span<float> bins(spectrum.data(), static_cast<std::size_t>(spectrum.size()));
  for (Eigen::Index t = 0; t < out.rows(); ++t) {
    condition(audio, t, false, &frame);
    padded.head(frame.size()) = frame.cast<float>();
    fft_.power_spectrum({padded.data(), static_cast<std::size_t>(padded.size())}, bins);
    if (!options_.use_power) spectrum = spectrum.cwiseSqrt();
    bank_.apply(bins, {out.data() + t * out.cols(), static_cast<std::size_t>(out.cols())});
  }
  return out;
}

MatrixF FeatureExtractor::linear_prediction(Span<const float> audio) const {
  MatrixF out(computer_.num_frames(audio.size()), options_.lpc_order);
  VectorD frame;
  std::vector<double> r(static_cast<std::size_t>(options_.lpc_order) + 1);
  std::vector<double> a(static_cast<std::size_t>(options_.lpc_order));
  for (Eigen::Index t = 0; t < out.rows(); ++t) {
    condition(audio, t, false, &frame);
    autocorrelation({frame.data(), static_cast<std::size_t>(frame.size())}, r);
    levinson_durbin(r, a);
    out.row(t) = Eigen::Map<const VectorD>(a.data(), out.cols()).cast<float>().transpose();
  }
  return out;
}

VectorD FeatureExtractor::log_energies(Span<const float> audio) const {
  VectorD out(computer_.num_frames(audio.size()));
  VectorD frame;
  for (Eigen::Index t = 0; t < out.size(); ++t) {
    condition(audio, t, options_.raw_energy, &frame);
    const double energy = frame.squaredNorm();
    out[t] = energy < kLeastEnergy ? kLogZero : std::log(energy);
  }
  if (!options_.normalise_energy) return out;
  const double most = out.maxCoeff();
  const double least = most - options_.silence_floor_db * std::log(10.0) / 10;
  return 1 - (most - out.array().max(least)) * options_.energy_scale;
}

}  // namespace hri::htk
