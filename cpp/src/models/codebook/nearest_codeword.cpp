// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "models/codebook/nearest_codeword.hpp"

#include <algorithm>
#include <cfloat>
#include <limits>

#include "hri/core/simd.hpp"

// A fused multiply-add rounds once where others round twice, and compilers fuse unless told.
#if defined(__clang__)
#pragma STDC FP_CONTRACT OFF
#elif defined(__GNUC__)
#pragma GCC optimize("fp-contract=off")
#endif

namespace hri::detail {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr int kBlock = 32;    // codewords at a time against a few rows
constexpr int kGroup = 8;     // codewords at a time against a block of rows
constexpr int kWidest = 512;  // columns of rows searched by blocks; wider ones go one by one

namespace baseline {
constexpr int kLanes = 4;
#include "models/codebook/nearest_codeword_kernel.inc"
}  // namespace baseline

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#pragma GCC push_options
#pragma GCC target("arch=haswell")
namespace avx2 {
constexpr int kLanes = 8;
#include "models/codebook/nearest_codeword_kernel.inc"
}  // namespace avx2
#pragma GCC pop_options
#pragma GCC push_options
#pragma GCC target("arch=skylake-avx512,prefer-vector-width=512")
namespace avx512 {
constexpr int kLanes = 16;
#include "models/codebook/nearest_codeword_kernel.inc"
}  // namespace avx512
#pragma GCC pop_options
#endif

}  // namespace

CodewordTable::CodewordTable(const MatrixF& centroids)
    : middle_(centroids.cast<double>().colwise().mean().transpose().cast<float>()) {
  find_nearest();  // the processor is asked now, so that no search allocates
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

std::vector<NamedSearch> searches() {
  std::vector<NamedSearch> found = {{"baseline", &baseline::search_rows}};
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
    found.push_back({"avx2", &avx2::search_rows});
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
      __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq")) {
    found.push_back({"avx512", &avx512::search_rows});
  }
#endif
  return found;
}

Search find_nearest() {
  static const Search best = searches().back().search;
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

HRI_SIMD_CLONES
void add_to_cells(const float* rows, std::ptrdiff_t stride, std::ptrdiff_t num_rows,
                  const MatrixF& centroids, const std::int32_t* cells, CellSums* sums) {
  const auto dim = static_cast<int>(centroids.cols());
  const float* all_centroids = centroids.data();
  double* all_sums = sums->sums.data();
  double* counts = sums->counts.data();
  double* distortions = sums->distortions.data();
  for (std::ptrdiff_t r = 0; r < num_rows; ++r) {
    const float* row = rows + r * stride;
    const std::ptrdiff_t cell = cells[r];
    const float* centroid = all_centroids + cell * dim;
    double* sum = all_sums + cell * dim;
    float distance = 0;
    for (int d = 0; d < dim; ++d) {
      const float step = row[d] - centroid[d];
      distance += step * step;
      sum[d] += static_cast<double>(row[d]);
    }
    counts[cell] += 1;
    distortions[cell] += static_cast<double>(distance);
  }
}

}  // namespace hri::detail
