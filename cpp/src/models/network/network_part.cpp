// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "models/network/network_part.hpp"

#include <algorithm>
#include <cmath>

#include "models/network/product_kernels.hpp"
#include "models/network/sequence_layers.hpp"

namespace hri::detail {
namespace {

constexpr Eigen::Index kFirstTaps = 11;
constexpr Eigen::Index kBlockTaps = 9;  // two more in every further block
constexpr Eigen::Index kLastTaps = 15;

double head_dropout(const SequenceNetworkOptions& options) {
  return std::min(0.9, 2 * options.dropout);
}

// Leaves out a share of the values and raises the others to make up for it.
void drop(double share, Random* random, MatrixF* values) {
  if (share == 0) return;
  const auto keep = static_cast<float>(1 / (1 - share));
  const auto bound = static_cast<std::uint32_t>(share * 4294967296.0);
  float* v = values->data();
  const Eigen::Index size = values->size();
  for (Eigen::Index i = 0; i < size; i += 2) {
    const std::uint64_t bits = random->next_u64();
    v[i] = static_cast<std::uint32_t>(bits) < bound ? 0.0F : v[i] * keep;
    if (i + 1 < size)
      v[i + 1] = static_cast<std::uint32_t>(bits >> 32) < bound ? 0.0F : v[i + 1] * keep;
  }
}

}  // namespace

NetworkLayout::NetworkLayout(int dim, int num_classes, const SequenceNetworkOptions& options) {
  const Eigen::Index channels = options.num_channels;
  add_unit(kFirstTaps, whole_columns<Eigen::Index>(dim), channels);
  for (int block = 0; block < options.num_blocks; ++block) {
    add_unit(kBlockTaps + 2 * block, channels, channels);
    add_unit(kBlockTaps + 2 * block, channels, channels);
  }
  add_unit(kLastTaps, channels, 2 * channels);
  head_weights_ = take(4 * channels, num_classes);
  head_bias_ = take(num_classes, 1);
  decaying_.push_back(head_weights_);
}

Slot NetworkLayout::take(Eigen::Index rows, Eigen::Index cols) {
  const Slot slot{num_values_, rows, cols};
  num_values_ += slot.size();
  return slot;
}

void NetworkLayout::add_unit(Eigen::Index taps, Eigen::Index in, Eigen::Index out) {
  UnitSlots unit;
  unit.kernel = take(taps, in);
  unit.weights = take(in, out);
  unit.scale = take(out, 1);
  unit.shift = take(out, 1);
  unit.out = out;
  unit.statistics = num_statistics_;
  num_statistics_ += out;
  decaying_.push_back(unit.kernel);
  decaying_.push_back(unit.weights);
  units_.push_back(unit);
}

VectorF NetworkLayout::initial(std::uint64_t seed) const {
  Random random(seed);
  VectorF values = VectorF::Zero(num_values_);
  for (const Slot& slot : decaying_) {
    const double range = 2 / std::sqrt(static_cast<double>(slot.rows));
    for (Eigen::Index i = 0; i < slot.size(); ++i)
      values[slot.first + i] = static_cast<float>(range * (random.uniform() - 0.5));
  }
  for (const UnitSlots& unit : units_) values.segment(unit.scale.first, unit.out).setOnes();
  return values;
}

NetworkPart::NetworkPart(const NetworkLayout& layout)
    : layout_(&layout), units_(layout.units().size()) {}

void NetworkPart::clear() {
  offsets_.assign(1, 0);
  labels_.clear();
  examples_.clear();
}

void NetworkPart::add(ConstMatrixRefF frames, int label) {
  examples_.push_back(with_whole_columns(frames));
  offsets_.push_back(offsets_.back() + frames.rows());
  labels_.push_back(label);
}

void NetworkPart::forward(std::size_t unit, const VectorF& values, const MatrixF& input,
                          const RowOffsets& offsets, int step, const MatrixF* residual,
                          double dropout, Random* random) {
  const UnitSlots& slots = layout_->units()[unit];
  Unit& u = units_[unit];
  filter(input, offsets, Slot::matrix(values, slots.kernel), step, &u.filtered);
  multiply(u.filtered, Slot::matrix(values, slots.weights), &u.normal);
  auto mean = means_.segment(slots.statistics, slots.out);
  auto variance = variances_.segment(slots.statistics, slots.out);
  mean = u.normal.colwise().mean().transpose();
  u.normal.rowwise() -= mean.transpose();
  variance = u.normal.colwise().squaredNorm().transpose() / static_cast<float>(u.normal.rows());
  u.inverse_deviation = (variance.array() + kVarianceFloor).rsqrt().matrix();
  u.normal = u.normal * u.inverse_deviation.asDiagonal();
  u.output = u.normal * Slot::vector(values, slots.scale).asDiagonal();
  u.output.rowwise() += Slot::vector(values, slots.shift).transpose();
  if (residual != nullptr) u.output += *residual;
  u.output = u.output.cwiseMax(0.0F);
  drop(dropout, random, &u.output);
}

void NetworkPart::backward(std::size_t unit, const VectorF& values, const MatrixF& input,
                           const RowOffsets& offsets, int step, double dropout, MatrixF* by_output,
                           MatrixF* by_residual, MatrixF* by_input) {
  const UnitSlots& slots = layout_->units()[unit];
  const Unit& u = units_[unit];
  // Where the output is 0, it was below or left out.
  *by_output =
      (u.output.array() > 0.0F).select(*by_output * static_cast<float>(1 / (1 - dropout)), 0.0F);
  if (by_residual != nullptr) *by_residual = *by_output;
  const VectorF by_shift = by_output->colwise().sum().transpose();
  const VectorF by_scale = by_output->cwiseProduct(u.normal).colwise().sum().transpose();
  Slot::vector(slopes_, slots.shift) = by_shift;
  Slot::vector(slopes_, slots.scale) = by_scale;
  // Through the batch statistics (Ioffe and Szegedy, 2015).
  const auto rows = static_cast<float>(u.normal.rows());
  MatrixF& by_product = *by_output;
  by_product.rowwise() -= by_shift.transpose() / rows;
  by_product -= u.normal * (by_scale / rows).asDiagonal();
  const VectorF factor = Slot::vector(values, slots.scale).cwiseProduct(u.inverse_deviation);
  by_product = by_product * factor.asDiagonal();
  MatrixF by_weights;
  multiply(u.filtered.transpose(), by_product, &by_weights);
  Slot::matrix(slopes_, slots.weights) = by_weights;
  MatrixF by_filtered;
  multiply(by_product, Slot::matrix(values, slots.weights).transpose(), &by_filtered);
  MatrixF by_kernel;
  filter_slopes(input, offsets, Slot::matrix(values, slots.kernel), step, by_filtered, &by_kernel,
                by_input);
  Slot::matrix(slopes_, slots.kernel) = by_kernel;
}

void NetworkPart::judge(const VectorF& values, const SequenceNetworkOptions& options,
                        Random* random, MatrixF* by_last) {
  const MatrixF& last = units_.back().output;
  const RowOffsets offsets = thinned(offsets_, kFirstStep);
  const Eigen::Index channels = last.cols();
  const auto count = static_cast<Eigen::Index>(labels_.size());
  MatrixF pooled(count, 2 * channels);
  std::vector<std::vector<Eigen::Index>> where(labels_.size());
  for (Eigen::Index s = 0; s < count; ++s) {
    const auto at = static_cast<std::size_t>(s);
    const auto rows = last.middleRows(offsets[at], offsets[at + 1] - offsets[at]);
    pooled.row(s).head(channels) = rows.colwise().mean();
    for (Eigen::Index c = 0; c < channels; ++c) {
      Eigen::Index row = 0;
      pooled(s, channels + c) = rows.col(c).maxCoeff(&row);
      where[at].push_back(offsets[at] + row);
    }
  }
  MatrixF kept = MatrixF::Ones(count, 2 * channels);
  drop(head_dropout(options), random, &kept);
  pooled = pooled.cwiseProduct(kept);
  const auto weights = Slot::matrix(values, layout_->head_weights());
  MatrixF scores = pooled * weights;
  scores.rowwise() += Slot::vector(values, layout_->head_bias()).transpose();
  const auto spread =
      static_cast<float>(options.label_smoothing / static_cast<double>(scores.cols()));
  loss_ = 0;
  for (Eigen::Index s = 0; s < count; ++s) {
    auto row = scores.row(s);
    const float best = row.maxCoeff();
    row.array() -= best + std::log((row.array() - best).exp().sum());
    const int label = labels_[static_cast<std::size_t>(s)];
    const auto own = static_cast<float>(1 - options.label_smoothing);
    loss_ -= static_cast<double>(own * row[label] + spread * row.sum());
    row = row.array().exp() - spread;
    row[label] -= own;
  }
  Slot::matrix(slopes_, layout_->head_weights()) = pooled.transpose() * scores;
  Slot::vector(slopes_, layout_->head_bias()) = scores.colwise().sum().transpose();
  const MatrixF by_pooled = (scores * weights.transpose()).cwiseProduct(kept);
  by_last->resize(last.rows(), channels);
  for (Eigen::Index s = 0; s < count; ++s) {
    const auto at = static_cast<std::size_t>(s);
    const Eigen::Index rows = offsets[at + 1] - offsets[at];
    by_last->middleRows(offsets[at], rows).rowwise() =
        by_pooled.row(s).head(channels) / static_cast<float>(rows);
    for (Eigen::Index c = 0; c < channels; ++c)
      (*by_last)(where[at][static_cast<std::size_t>(c)], c) += by_pooled(s, channels + c);
  }
}

void NetworkPart::forward(const VectorF& values, double dropout, Random* random) {
  means_.resize(layout_->num_statistics());
  variances_.resize(layout_->num_statistics());
  input_.resize(offsets_.back(), examples_.front().cols());
  for (std::size_t s = 0; s < examples_.size(); ++s)
    input_.middleRows(offsets_[s], examples_[s].rows()) = examples_[s];
  const RowOffsets offsets = thinned(offsets_, kFirstStep);
  const std::size_t last = units_.size() - 1;
  const auto output = [&](std::size_t unit) -> const MatrixF& { return units_[unit].output; };
  forward(0, values, input_, offsets_, kFirstStep, nullptr, 0, random);
  for (std::size_t u = 1; u < last; u += 2) {
    forward(u, values, output(u - 1), offsets, 1, nullptr, dropout, random);
    forward(u + 1, values, output(u), offsets, 1, &output(u - 1), dropout, random);
  }
  forward(last, values, output(last - 1), offsets, 1, nullptr, 0, random);
}

void NetworkPart::measure(const VectorF& values) {
  Random unused(0);
  forward(values, 0, &unused);
}

void NetworkPart::run(const VectorF& values, const SequenceNetworkOptions& options,
                      Random* random) {
  forward(values, options.dropout, random);
  slopes_.resize(layout_->num_values());
  const RowOffsets offsets = thinned(offsets_, kFirstStep);
  const std::size_t last = units_.size() - 1;
  const auto output = [&](std::size_t unit) -> const MatrixF& { return units_[unit].output; };
  MatrixF by_output;
  MatrixF by_inner;
  MatrixF by_residual;
  judge(values, options, random, &by_output);
  backward(last, values, output(last - 1), offsets, 1, 0, &by_output, nullptr, &by_inner);
  by_output.swap(by_inner);
  for (std::size_t u = last - 1; u > 0; u -= 2) {
    backward(u, values, output(u - 1), offsets, 1, options.dropout, &by_output, &by_residual,
             &by_inner);
    backward(u - 1, values, output(u - 2), offsets, 1, options.dropout, &by_inner, nullptr,
             &by_output);
    by_output += by_residual;
  }
  backward(0, values, input_, offsets_, kFirstStep, 0, &by_output, nullptr, &by_inner);
}

}  // namespace hri::detail
