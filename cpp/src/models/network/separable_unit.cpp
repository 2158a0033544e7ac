// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "models/network/separable_unit.hpp"

#include <algorithm>

#include "core/simd.hpp"

namespace hri::detail {
namespace {

// to[i] += a[i] b[i]
HRI_SIMD_CLONES void add_products(const float* a, const float* b, Eigen::Index count, float* to) {
  for (Eigen::Index i = 0; i < count; ++i) to[i] += a[i] * b[i];
}

// Calls use(k, row of y, row of x) for every tap that meets a frame, in order of the rows of y.
template <class Use>
void for_each_tap(const RowOffsets& offsets, int taps, int step, const Use& use) {
  Eigen::Index out = 0;
  for (std::size_t s = 0; s + 1 < offsets.size(); ++s) {
    const Eigen::Index first = offsets[s];
    const Eigen::Index frames = offsets[s + 1] - first;
    for (Eigen::Index t = 0; t < frames; t += step, ++out) {
      const Eigen::Index from = t - taps / 2;
      const Eigen::Index begin = std::max<Eigen::Index>(0, -from);
      const Eigen::Index end = std::min<Eigen::Index>(taps, frames - from);
      for (Eigen::Index k = begin; k < end; ++k) use(k, out, first + from + k);
    }
  }
}

}  // namespace

RowOffsets thinned(const RowOffsets& offsets, int step) {
  RowOffsets result{0};
  for (std::size_t s = 0; s + 1 < offsets.size(); ++s)
    result.push_back(result.back() + (offsets[s + 1] - offsets[s] + step - 1) / step);
  return result;
}

void filter(const MatrixF& x, const RowOffsets& offsets, ConstMatrixRefF kernel, int step,
            MatrixF* y) {
  y->setZero(thinned(offsets, step).back(), x.cols());
  for_each_tap(offsets, static_cast<int>(kernel.rows()), step,
               [&](Eigen::Index k, Eigen::Index to, Eigen::Index from) {
                 add_products(kernel.row(k).data(), x.row(from).data(), x.cols(),
                              y->row(to).data());
               });
}

void filter_slopes(const MatrixF& x, const RowOffsets& offsets, ConstMatrixRefF kernel, int step,
                   const MatrixF& by_y, MatrixF* by_kernel, MatrixF* by_x) {
  by_kernel->setZero(kernel.rows(), kernel.cols());
  by_x->setZero(x.rows(), x.cols());
  for_each_tap(
      offsets, static_cast<int>(kernel.rows()), step,
      [&](Eigen::Index k, Eigen::Index y, Eigen::Index from) {
        add_products(by_y.row(y).data(), x.row(from).data(), x.cols(), by_kernel->row(k).data());
        add_products(by_y.row(y).data(), kernel.row(k).data(), x.cols(), by_x->row(from).data());
      });
}

}  // namespace hri::detail
