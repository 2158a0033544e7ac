// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "htk/base_conversion.hpp"

#include <cmath>
#include <vector>

#include "core/numbers.hpp"
#include "hri/core/error.hpp"
#include "hri/signal/linear_prediction.hpp"

namespace hri::htk::detail {
namespace {

bool is_of_filters_alone(BaseKind base) {
  return base == BaseKind::fbank || base == BaseKind::melspec;
}

bool is_of_prediction(BaseKind base) {
  return base == BaseKind::lpc || base == BaseKind::lprefc || base == BaseKind::irefc;
}

// The predictor of reflection coefficients: Levinson's recursion.
void predictor_of(Span<const double> k, Span<double> a) {
  std::vector<double> before(a.size());
  for (std::size_t i = 0; i < k.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) before[j] = a[j];
    for (std::size_t j = 0; j < i; ++j) a[j] = before[j] - k[i] * before[i - 1 - j];
    a[i] = -k[i];
  }
}

double lifter_of(double lifter, int n) {
  return lifter > 0 ? 1 + lifter / 2 * std::sin(hri::detail::kPi * n / lifter) : 1;
}

MatrixF cepstra_of_filters(const MatrixF& logs, bool with_c0, const HtkFeatureOptions& options) {
  const auto num_filters = static_cast<double>(logs.cols());
  const double scale = std::sqrt(2 / num_filters);
  require(options.num_cepstra < logs.cols(), "there are not as many filters as cepstra");
  MatrixD transform(logs.cols(), options.num_cepstra + (with_c0 ? 1 : 0));
  for (Eigen::Index m = 0; m < logs.cols(); ++m) {
    for (int n = 1; n <= options.num_cepstra; ++n) {
      const double angle = hri::detail::kPi * n * (static_cast<double>(m) + 0.5) / num_filters;
      transform(m, n - 1) = scale * std::cos(angle) * lifter_of(options.lifter, n);
    }
    if (with_c0) transform(m, options.num_cepstra) = scale;
  }
  return (logs.cast<double>() * transform).cast<float>();
}

}  // namespace

bool is_convertible(BaseKind from, BaseKind to) {
  if (is_of_filters_alone(from))
    return to == BaseKind::mfcc || (from == BaseKind::melspec && to == BaseKind::fbank);
  return is_of_prediction(from) && (is_of_prediction(to) || to == BaseKind::lpcepstra);
}

void reflection_coefficients(Span<const double> a, Span<double> k) {
  std::vector<double> now(a.begin(), a.end());
  std::vector<double> before(now.size());
  for (std::size_t i = now.size(); i-- > 0;) {
    k[i] = -now[i];
    const double rest = 1 - k[i] * k[i];
    require(rest > 0, "a reflection coefficient is not within -1..1");
    for (std::size_t j = 0; j < i; ++j) before[j] = (now[j] + k[i] * now[i - 1 - j]) / rest;
    now = before;
  }
}

MatrixF converted_statics(const MatrixF& statics, ParameterKind from, BaseKind to, bool with_c0,
                          const HtkFeatureOptions& options) {
  constexpr float kLeastOfFilter = 1;  // HTK's MELFLOOR
  const Eigen::Index energy = from.has(kEnergy) ? 1 : 0;
  const MatrixF base = statics.leftCols(statics.cols() - energy);
  MatrixF made;
  if (is_of_filters_alone(from.base)) {
    const MatrixF logs =
        from.base == BaseKind::fbank ? base : MatrixF(base.cwiseMax(kLeastOfFilter).array().log());
    made = to == BaseKind::fbank ? logs : cepstra_of_filters(logs, with_c0, options);
  } else {
    const auto order = static_cast<std::size_t>(base.cols());
    const bool cepstra = to == BaseKind::lpcepstra;
    made.resize(base.rows(), cepstra ? options.num_cepstra : base.cols());
    std::vector<double> a(order);
    std::vector<double> k(order);
    std::vector<double> c(static_cast<std::size_t>(options.num_cepstra) + 1);
    for (Eigen::Index t = 0; t < base.rows(); ++t) {
      for (std::size_t i = 0; i < order; ++i) {
        const auto value = static_cast<double>(base(t, static_cast<Eigen::Index>(i)));
        (from.base == BaseKind::lpc ? a : k)[i] = value;
      }
      if (from.base != BaseKind::lpc) predictor_of(k, a);
      if (cepstra) {
        lpc_cepstrum(a, 1, c);
        for (int n = 1; n <= options.num_cepstra; ++n)
          made(t, n - 1) =
              static_cast<float>(c[static_cast<std::size_t>(n)] * lifter_of(options.lifter, n));
        continue;
      }
      if (to != BaseKind::lpc) reflection_coefficients(a, k);
      for (std::size_t i = 0; i < order; ++i)
        made(t, static_cast<Eigen::Index>(i)) =
            static_cast<float>((to == BaseKind::lpc ? a : k)[i]);
    }
  }
  MatrixF all(made.rows(), made.cols() + energy);
  all.leftCols(made.cols()) = made;
  if (energy > 0) all.rightCols(1) = statics.rightCols(1);
  return all;
}

}  // namespace hri::htk::detail
