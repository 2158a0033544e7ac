// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "models/codebook/nearest_codeword.hpp"

#include <algorithm>
#include <cfloat>
#include <cstdint>
#include <limits>
#include <utility>

#include "core/simd.hpp"

namespace hri::detail {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr int kBlock = 32;    // codewords at a time against a few rows
constexpr int kGroup = 8;     // codewords at a time against a block of rows
constexpr int kWidest = 512;  // columns of rows searched by blocks; wider ones go one by one

}  // namespace
}  // namespace hri::detail

#define HRI_KERNEL_FILE "models/codebook/nearest_codeword_kernel.inc"
#include "core/foreach_instruction_set.inc"

namespace hri::detail {

CodewordTable::CodewordTable(const MatrixF& centroids)
    : middle_(centroids.cast<double>().colwise().mean().transpose().cast<float>()) {
  const Eigen::Index size = centroids.rows();
  const Eigen::Index dim = centroids.cols();
  const Eigen::Index num_blocks = (size + kBlock - 1) / kBlock;
  values_.assign(static_cast<std::size_t>(num_blocks * kBlock * dim), kInfinity);
  const Eigen::Index num_groups = (size + kGroup - 1) / kGroup;
  halves_.assign(static_cast<std::size_t>(num_groups * kGroup), kInfinity);
  products_.assign(static_cast<std::size_t>(num_groups * kGroup * dim), 0.0F);
  for (Eigen::Index k = 0; k < size; ++k) {
    float* value = values_.data() + k / kBlock * kBlock * dim + k % kBlock;
    float* product = products_.data() + k / kGroup * kGroup * dim + k % kGroup;
    double square = 0;
    for (Eigen::Index d = 0; d < dim; ++d) {
      value[d * kBlock] = centroids(k, d);
      const float away = centroids(k, d) - middle_[d];
      product[d * kGroup] = -away;
      square += static_cast<double>(away) * away;
    }
    halves_[static_cast<std::size_t>(k)] = static_cast<float>(square / 2);
    reach_ = std::max(reach_, static_cast<float>(square));
  }
}

CodewordLayout CodewordTable::layout() const {
  CodewordLayout layout;
  layout.dim = static_cast<int>(middle_.size());
  const auto dim = static_cast<std::size_t>(std::max(layout.dim, 1));
  layout.num_blocks = static_cast<std::ptrdiff_t>(values_.size() / (kBlock * dim));
  layout.num_groups = static_cast<std::ptrdiff_t>(halves_.size() / kGroup);
  layout.values = values_.data();
  layout.middle = middle_.data();
  layout.products = products_.data();
  layout.halves = halves_.data();
  layout.reach = reach_;
  return layout;
}

Span<const CodewordKernels> all_codeword_kernels() {
  static constexpr CodewordKernels kAll[] = {HRI_EVERY_SET(, kKernels)};
  return runnable(kAll);
}

const CodewordKernels& codeword_kernels() {
  static const CodewordKernels& best = widest(all_codeword_kernels());
  return best;
}

float squared_distance(const float* a, const float* b, int dim) {
  float sum = 0;
  for (int d = 0; d < dim; ++d) {
    const float step = a[d] - b[d];
    sum += step * step;
  }
  return sum;
}

void add_to_cells(const float* rows, std::ptrdiff_t stride, std::ptrdiff_t num_rows,
                  const MatrixF& centroids, const std::int32_t* cells, CellSums* sums) {
  codeword_kernels().add(rows, stride, num_rows, centroids.data(),
                         static_cast<int>(centroids.cols()), cells, sums->sums.data(),
                         sums->counts.data(), sums->distortions.data());
}

}  // namespace hri::detail
