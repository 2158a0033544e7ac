// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/hmm/mixture_bank.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "hri/core/error.hpp"
#include "hri/models/row_checks.hpp"
#include "models/hmm/mixture_kernels.hpp"

namespace hri {
namespace {

constexpr double kLog2Pi = 1.8378770664093454835606594728112;

template <class T>
T log_sum_exp(const T* values, int count) {
  T top = values[0];
  for (int i = 1; i < count; ++i) top = values[i] > top ? values[i] : top;
  if (!(top > -std::numeric_limits<T>::infinity())) return top;
  // Added to a sum of exp(highest) or more, what lies this far below is lost in rounding.
  constexpr T kLost = sizeof(T) == sizeof(float) ? 19 : 39;
  T sum = 0;
  T highest = -std::numeric_limits<T>::infinity();
  for (int i = 0; i < count; ++i) {
    const T exponent = values[i] - top;
    if (exponent < highest - kLost) continue;
    sum += std::exp(exponent);
    highest = std::max(highest, exponent);
  }
  return top + std::log(sum);
}

// The densities of states from those of their components.
template <class T>
void mix(const T* components, int num_states, int num_mixtures, T* out) {
  if (num_mixtures == 1) {
    std::copy_n(components, num_states, out);
    return;
  }
  for (int j = 0; j < num_states; ++j)
    out[j] = log_sum_exp(components + static_cast<std::ptrdiff_t>(j) * num_mixtures, num_mixtures);
}

// Means and precisions by columns, each row padded; after them there is nothing.
template <class T, class Buffer>
void lay_out(const MatrixD& means, const MatrixD& variances, Buffer* columns) {
  const std::ptrdiff_t stride = detail::padded(means.rows());
  columns->assign(static_cast<std::size_t>(2 * means.cols() * stride), T{0});
  for (Eigen::Index d = 0; d < means.cols(); ++d) {
    T* mean = columns->data() + d * stride;
    T* precision = mean + means.cols() * stride;
    for (Eigen::Index r = 0; r < means.rows(); ++r) {
      mean[r] = static_cast<T>(means(r, d));
      precision[r] = static_cast<T>(1.0 / variances(r, d));
    }
  }
}

template <class Buffer>
auto table_of(const Buffer& columns, Eigen::Index rows, int dim) {
  using T = typename Buffer::value_type;
  const std::ptrdiff_t stride = detail::padded(rows);
  return detail::GaussianColumns<T>{columns.data(), columns.data() + dim * stride, stride, dim};
}

}  // namespace

MixtureBank::MixtureBank(MatrixD weights, MatrixD means, MatrixD variances)
    : weights_(std::move(weights)), means_(std::move(means)), variances_(std::move(variances)) {
  const Eigen::Index rows = weights_.size();
  require(rows > 0 && means_.rows() == rows && variances_.rows() == rows && means_.cols() > 0 &&
              variances_.cols() == means_.cols(),
          "mixture bank: shapes of weights, means and variances do not fit");
  require(weights_.allFinite() && means_.allFinite() && variances_.allFinite(),
          "mixture bank: a value is not finite");
  require(variances_.minCoeff() > 0, "mixture bank: variances must be positive");
  require(
      weights_.minCoeff() >= 0 && (weights_.rowwise().sum().array() - 1.0).abs().maxCoeff() < 1e-6,
      "mixture bank: the weights of a state must be >= 0 and sum to 1");
  constants_.resize(static_cast<std::size_t>(rows));
  for (Eigen::Index r = 0; r < rows; ++r) {
    const double weight = weights_.data()[r];
    constants_[static_cast<std::size_t>(r)] =
        std::log(weight) - 0.5 * (static_cast<double>(means_.cols()) * kLog2Pi +
                                  variances_.row(r).array().log().sum());
  }
  constants_f_.assign(constants_.begin(), constants_.end());
  lay_out<double>(means_, variances_, &columns_);
  lay_out<float>(means_, variances_, &columns_f_);
}

void MixtureBank::log_densities(ConstMatrixRefF frames, MatrixRefF out) const {
  if (frames.cols() != dim()) {
    fail(ErrorKind::invalid_argument, "frames have " + std::to_string(frames.cols()) +
                                          " columns, the model has " + std::to_string(dim()));
  }
  validate_finite(frames, "frames");
  require(out.rows() == frames.rows() && out.cols() == num_states(),
          "out must have shape (num_frames, num_states)");
  const int k = num_mixtures();
  const auto table = table_of(columns_f_, means_.rows(), dim());
  thread_local std::vector<float> scratch;
  scratch.resize(static_cast<std::size_t>(table.stride));
  const detail::MixtureKernels& kernels = detail::mixture_kernels();
  for (Eigen::Index t = 0; t < frames.rows(); ++t) {
    kernels.distances_f(frames.data() + t * frames.outerStride(), table, scratch.data());
    for (std::size_t r = 0; r < constants_f_.size(); ++r)
      scratch[r] = constants_f_[r] - 0.5F * scratch[r];
    mix(scratch.data(), num_states(), k, out.data() + t * out.outerStride());
  }
}

void MixtureBank::log_densities(ConstMatrixRefF frames, MatrixD* out, MatrixD* components) const {
  out->resize(frames.rows(), num_states());
  if (components != nullptr) components->resize(frames.rows(), means_.rows());
  validate_finite(frames, "frames");
  detail::log_densities_of_finite(*this, frames, out->data(), num_states(),
                                  components == nullptr ? nullptr : components->data(),
                                  means_.rows());
}

void MixtureBank::log_densities(ConstMatrixRefF frames, double* out) const {
  validate_finite(frames, "frames");
  detail::log_densities_of_finite(*this, frames, out, num_states(), nullptr, 0);
}

void detail::log_densities_of_finite(const MixtureBank& bank, ConstMatrixRefF frames, double* out,
                                     std::ptrdiff_t stride, double* components,
                                     std::ptrdiff_t component_stride) {
  const int k = bank.num_mixtures();
  const auto num_rows = static_cast<std::ptrdiff_t>(bank.constants_.size());
  const auto table = table_of(bank.columns_, num_rows, bank.dim());
  thread_local AlignedVector buffer;
  buffer.resize(static_cast<std::size_t>(table.stride + bank.dim()));
  double* logs = buffer.data();
  double* x = logs + table.stride;
  const MixtureKernels& kernels = mixture_kernels();
  for (Eigen::Index t = 0; t < frames.rows(); ++t) {
    const float* frame = frames.data() + t * frames.outerStride();
    for (int d = 0; d < bank.dim(); ++d) x[d] = static_cast<double>(frame[d]);
    kernels.distances(x, table, logs);
    for (std::ptrdiff_t r = 0; r < num_rows; ++r)
      logs[r] = bank.constants_[static_cast<std::size_t>(r)] - 0.5 * logs[r];
    if (components != nullptr) std::copy_n(logs, num_rows, components + t * component_stride);
    mix(logs, bank.num_states(), k, out + t * stride);
  }
}

void MixtureBank::write(ModelFile& file, const std::string& prefix) const {
  file.set_matrix(prefix + "weights", weights_);
  file.set_matrix(prefix + "means", means_);
  file.set_matrix(prefix + "variances", variances_);
}

MixtureBank MixtureBank::read(const ModelFile& file, const std::string& prefix) {
  const MatrixD weights = file.matrix_d(prefix + "weights");
  const MatrixD means = file.matrix_d(prefix + "means");
  const MatrixD variances = file.matrix_d(prefix + "variances");
  const auto refuse = [&](const char* field, const std::string& what) {
    fail(ErrorKind::format, file.name() + ": field '" + prefix + field + "' " + what);
  };
  if (weights.size() == 0 || !(weights.minCoeff() >= 0) ||
      (weights.rowwise().sum().array() - 1.0).abs().maxCoeff() > 1e-6) {
    refuse("weights", "must hold rows >= 0 that sum to 1");
  }
  if (means.rows() != weights.size() || means.cols() == 0)
    refuse("means", "must have one row a weight");
  if (variances.rows() != means.rows() || variances.cols() != means.cols() ||
      !(variances.minCoeff() > 0)) {
    refuse("variances", "must be positive and of the shape of '" + prefix + "means'");
  }
  return MixtureBank(weights, means, variances);
}

}  // namespace hri
