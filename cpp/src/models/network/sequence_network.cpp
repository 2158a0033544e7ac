// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/network/sequence_network.hpp"

#include <cmath>
#include <utility>

#include "hri/core/error.hpp"
#include "hri/core/kernels.hpp"
#include "models/network/product_kernels.hpp"
#include "models/network/separable_unit.hpp"
#include "models/network/sequence_layers.hpp"

namespace hri {
namespace {

constexpr double kPenalty = 1;       // on the weights of a class that is added
constexpr double kRowsPerOther = 3;  // recordings that the mean of another class stands for then

std::string layer_prefix(const std::string& prefix, std::size_t layer) {
  return prefix + "layer." + std::to_string(layer) + ".";
}

void cut_below_zero(MatrixF* x) { *x = x->cwiseMax(0.0F); }

MatrixF apply(const SeparableConvolution& layer, const MatrixF& x,
              const detail::RowOffsets& offsets, int step) {
  MatrixF filtered;
  MatrixF result;
  detail::filter(x, offsets, layer.kernel, step, &filtered);
  detail::multiply(filtered, layer.weights, layer.bias, &result);
  return result;
}

}  // namespace

const char* SequenceNetworkOptions::conflict() const {
  return num_channels % detail::kProductColumns == 0 ? nullptr
                                                     : "num_channels must be a multiple of 8";
}

SequenceNetwork::SequenceNetwork(std::vector<SeparableConvolution> layers, int dim,
                                 SoftmaxRegression head, MatrixF means)
    : layers_(std::move(layers)), dim_(dim), head_(std::move(head)), means_(std::move(means)) {}

VectorF SequenceNetwork::pooled(ConstMatrixRefF frames) const {
  require(frames.rows() > 0, "a sequence has no frame");
  require(frames.cols() == dim_, "frames do not fit the network");
  MatrixF x = detail::with_whole_columns(frames);
  require(first_not_finite(x.data(), static_cast<std::size_t>(x.size())) ==
              static_cast<std::size_t>(x.size()),
          "frames are not finite");
  detail::RowOffsets offsets{0, x.rows()};
  x = apply(layers_.front(), x, offsets, detail::kFirstStep);
  cut_below_zero(&x);
  offsets = detail::thinned(offsets, detail::kFirstStep);
  for (std::size_t l = 1; l + 1 < layers_.size(); l += 2) {
    MatrixF inner = apply(layers_[l], x, offsets, 1);
    cut_below_zero(&inner);
    x += apply(layers_[l + 1], inner, offsets, 1);
    cut_below_zero(&x);
  }
  x = apply(layers_.back(), x, offsets, 1);
  cut_below_zero(&x);
  VectorF result(2 * x.cols());
  result << x.colwise().mean().transpose(), x.colwise().maxCoeff().transpose();
  return result;
}

VectorF SequenceNetwork::scores(ConstMatrixRefF frames) const {
  const VectorF row = pooled(frames);
  return head_.scores({row.data(), static_cast<std::size_t>(row.size())});
}

VectorF SequenceNetwork::log_posteriors(ConstMatrixRefF frames) const {
  VectorF result = scores(frames);
  const float best = result.maxCoeff();
  result.array() -= best + std::log((result.array() - best).exp().sum());
  return result;
}

SequenceNetwork SequenceNetwork::with_class(int index, const std::vector<MatrixF>& sequences,
                                            const StopCheck& should_stop) const {
  require(!sequences.empty(), "a class has no sequence");
  MatrixF rows(static_cast<Eigen::Index>(sequences.size()), head_.dim());
  for (std::size_t i = 0; i < sequences.size(); ++i)
    rows.row(static_cast<Eigen::Index>(i)) = pooled(sequences[i]).transpose();
  SoftmaxRegressionOptions options;
  options.penalty = kPenalty;
  SoftmaxRegression head =
      head_.with_class(index, rows, means_, kRowsPerOther, options, should_stop);
  MatrixF means(means_.rows() + 1, means_.cols());
  means << means_.topRows(index), rows.colwise().mean(), means_.bottomRows(means_.rows() - index);
  return {layers_, dim_, std::move(head), std::move(means)};
}

SequenceNetwork SequenceNetwork::without_class(int index) const {
  require(num_classes() > 2, "a network needs two classes at least");
  SoftmaxRegression head = head_.without_class(index);
  MatrixF means(means_.rows() - 1, means_.cols());
  means << means_.topRows(index), means_.bottomRows(means_.rows() - index - 1);
  return {layers_, dim_, std::move(head), std::move(means)};
}

void SequenceNetwork::write(ModelFile& file, const std::string& prefix) const {
  file.set_integer(prefix + "dim", dim_);
  file.set_integer(prefix + "layers", static_cast<std::int64_t>(layers_.size()));
  for (std::size_t l = 0; l < layers_.size(); ++l) {
    const std::string at = layer_prefix(prefix, l);
    file.set_matrix(at + "kernel", layers_[l].kernel);
    file.set_matrix(at + "weights", layers_[l].weights);
    file.set_vector(at + "bias", layers_[l].bias);
  }
  head_.write(file, prefix + "head.");
  file.set_matrix(prefix + "means", means_);
}

SequenceNetwork SequenceNetwork::read(const ModelFile& file, const std::string& prefix) {
  const auto refuse = [&](const std::string& field, const char* why) {
    fail(ErrorKind::format, file.name() + ": field '" + field + "' " + why);
  };
  const std::int64_t dim = file.integer(prefix + "dim");
  const std::int64_t num_layers = file.integer(prefix + "layers");
  if (dim < 1 || dim > detail::kMaxNetworkSize) refuse(prefix + "dim", "is out of range");
  if (num_layers < 4 || num_layers > detail::kMaxNetworkSize || num_layers % 2 != 0)
    refuse(prefix + "layers", "is out of range");
  std::vector<SeparableConvolution> layers;
  Eigen::Index channels = detail::whole_columns(dim);
  for (std::int64_t l = 0; l < num_layers; ++l) {
    const std::string at = layer_prefix(prefix, static_cast<std::size_t>(l));
    layers.push_back(
        {file.matrix_f(at + "kernel"), file.matrix_f(at + "weights"), file.vector_f(at + "bias")});
    const SeparableConvolution& layer = layers.back();
    if (layer.kernel.rows() % 2 != 1 || layer.kernel.cols() != channels)
      refuse(at + "kernel", "does not fit the layer before");
    const Eigen::Index out = layer.weights.cols();
    const bool in_block = l > 0 && l + 1 < num_layers;
    if (layer.weights.rows() != channels || out < 1 || out % detail::kProductColumns != 0 ||
        (in_block && out != channels)) {
      refuse(at + "weights", "does not fit the layer before");
    }
    if (layer.bias.size() != out) refuse(at + "bias", "does not fit the weights");
    channels = out;
  }
  SoftmaxRegression head = SoftmaxRegression::read(file, prefix + "head.");
  if (head.dim() != 2 * channels) refuse(prefix + "head.weights", "does not fit the last layer");
  MatrixF means = file.matrix_f(prefix + "means");
  if (means.rows() != head.num_classes() || means.cols() != head.dim())
    refuse(prefix + "means", "does not fit the classes");
  return {std::move(layers), static_cast<int>(dim), std::move(head), std::move(means)};
}

}  // namespace hri
