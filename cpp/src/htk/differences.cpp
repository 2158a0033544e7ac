// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "htk/differences.hpp"

#include <array>
#include <numeric>

#include "hri/core/error.hpp"
#include "hri/features/speech/dynamics.hpp"
#include "htk/base_conversion.hpp"

namespace hri::htk {
namespace {

std::array<int, 3> windows_of(const HtkFeatureOptions& options) {
  return {options.delta_window, options.acceleration_window, options.third_window};
}

}  // namespace

namespace detail {

MatrixF with_differences(const MatrixF& statics, ParameterKind kind,
                         const HtkFeatureOptions& options) {
  const auto width = static_cast<int>(statics.cols());
  const int num_blocks = kind.num_blocks();
  MatrixF out(statics.rows(), width * num_blocks);
  out.leftCols(width) = statics;
  const std::array<int, 3> windows = windows_of(options);
  for (int block = 1; block < num_blocks; ++block)
    append_deltas(out, (block - 1) * width, width, windows[static_cast<std::size_t>(block - 1)]);
  if (kind.has(kZeroMean)) {
    auto cepstra = out.leftCols(width - (kind.has(kEnergy) ? 1 : 0));
    const Eigen::RowVectorXd mean = cepstra.cast<double>().colwise().mean();
    cepstra.rowwise() -= mean.cast<float>();
  }
  return out;
}

MatrixF without_energy(const MatrixF& frames, ParameterKind kind) {
  const Eigen::Index column = frames.cols() / kind.num_blocks() - 1;
  MatrixF out(frames.rows(), frames.cols() - 1);
  out.leftCols(column) = frames.leftCols(column);
  out.rightCols(out.cols() - column) = frames.rightCols(out.cols() - column);
  return out;
}

}  // namespace detail

ParameterFile convert(const ParameterFile& file, ParameterKind kind,
                      const HtkFeatureOptions& options) {
  validate(options);
  if (kind.base == BaseKind::anon) kind.base = file.kind.base;
  const auto missing = [&](const std::string& what) {
    fail(ErrorKind::invalid_argument,
         "frames of kind " + file.kind.text() + " cannot become " + kind.text() + what);
  };
  if (kind.has(kEnergy) != file.kind.has(kEnergy)) missing(": energy is not added or left out");
  if (file.kind.has(kZeroMean) && (!kind.has(kZeroMean) || kind.base != file.kind.base))
    missing(": the mean is not known");
  if (kind.base != file.kind.base) {
    if (!detail::is_convertible(file.kind.base, kind.base)) missing("");
    if (kind.has(kC0) && kind.base != BaseKind::mfcc) missing(": only MFCC has _0");
    ParameterKind made{kind.base, static_cast<std::uint16_t>(kind.qualifiers & (kEnergy | kC0))};
    const MatrixF statics = detail::converted_statics(file.values.leftCols(file.num_static()),
                                                      file.kind, kind.base, kind.has(kC0), options);
    return convert({made, file.sample_period, statics, {}, {}}, kind, options);
  }
  if (kind.has(kC0) != file.kind.has(kC0)) missing(": c0 is not added or left out");
  ParameterFile out;
  out.kind = kind;
  out.sample_period = file.sample_period;
  const int num_static = file.num_static();
  const bool zero_mean = kind.has(kZeroMean) && !file.kind.has(kZeroMean);
  if (kind.num_blocks() > file.kind.num_blocks() || zero_mean) {
    // Differences are the same with and without the mean.
    ParameterKind made = kind;
    if (!zero_mean) made.qualifiers = static_cast<std::uint16_t>(made.qualifiers & ~kZeroMean);
    out.values = detail::with_differences(file.values.leftCols(num_static), made, options);
  } else {
    out.values = file.values.leftCols(num_static * kind.num_blocks());
  }
  return out;
}

std::optional<int> frames_beside(ParameterKind from, ParameterKind to,
                                 const HtkFeatureOptions& options) {
  const bool same_base = to.base == BaseKind::anon || to.base == from.base;
  if (!same_base || (to.has(kZeroMean) && !from.has(kZeroMean))) return std::nullopt;
  if (to.num_blocks() <= from.num_blocks()) return 0;
  const std::array<int, 3> windows = windows_of(options);
  return std::accumulate(windows.begin(), windows.begin() + to.num_blocks() - 1, 0);
}

MatrixF observations(const ParameterFile& file, ParameterKind kind,
                     const HtkFeatureOptions& options) {
  const ParameterFile converted = convert(file, kind.plain(), options);
  return kind.has(kNoEnergy) ? detail::without_energy(converted.values, kind) : converted.values;
}

}  // namespace hri::htk
