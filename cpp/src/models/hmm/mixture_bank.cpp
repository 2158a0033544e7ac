// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/hmm/mixture_bank.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/numbers.hpp"
#include "hri/core/error.hpp"
#include "hri/models/row_checks.hpp"
#include "models/hmm/dense_kernels.hpp"
#include "models/hmm/mixture_kernels.hpp"
#include "models/hmm/mixture_training.hpp"

namespace hri {
namespace {

using detail::kLog2Pi;

using detail::kMinusInf;

// Log densities of states from those of their components, in double, with the exponentials of all
// components side by side.
class Mixing {
 public:
  Mixing(int num_states, int num_mixtures)
      : num_states_(num_states),
        num_mixtures_(num_mixtures),
        stride_(detail::padded(static_cast<std::ptrdiff_t>(num_states) * num_mixtures)) {
    const std::ptrdiff_t states = detail::padded(num_states);
    thread_local detail::AlignedVector buffer;
    buffer.resize(static_cast<std::size_t>(2 * stride_ + 3 * states));
    below_ = buffer.data();
    shares_ = below_ + stride_;
    tops_ = shares_ + stride_;
    sums_ = tops_ + states;
    logs_ = sums_ + states;
    std::fill_n(below_, stride_, 0.0);
    std::fill_n(sums_, states, 1.0);
  }

  // `shares`, if not null, are those of the components in the densities of their states.
  void mix(const double* components, double* out, double* shares) {
    const std::ptrdiff_t k = num_mixtures_;
    for (int j = 0; j < num_states_; ++j) {
      const double* own = components + j * k;
      tops_[j] = *std::max_element(own, own + k);
      for (std::ptrdiff_t c = 0; c < k; ++c) below_[j * k + c] = own[c] - tops_[j];
    }
    const detail::DenseKernels& kernels = detail::dense_kernels();
    kernels.exponentials(below_, 0, stride_, shares_);
    for (int j = 0; j < num_states_; ++j) {
      double sum = 0;
      for (std::ptrdiff_t c = 0; c < k; ++c) sum += shares_[j * k + c];
      sums_[j] = tops_[j] > kMinusInf ? sum : 1;
    }
    kernels.logarithms(sums_, 0, detail::padded(num_states_), logs_);
    for (int j = 0; j < num_states_; ++j) {
      out[j] = tops_[j] + logs_[j];
      if (shares == nullptr) continue;
      for (std::ptrdiff_t c = 0; c < k; ++c) shares[j * k + c] = shares_[j * k + c] / sums_[j];
    }
  }

 private:
  int num_states_;
  int num_mixtures_;
  std::ptrdiff_t stride_;
  double* below_;  // the best component of the state
  double* shares_;
  double* tops_;
  double* sums_;
  double* logs_;
};

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

void detail::require_width(ConstMatrixRefF frames, Eigen::Index dim) {
  if (frames.cols() != dim) {
    fail(ErrorKind::invalid_argument, "frames have " + std::to_string(frames.cols()) +
                                          " columns, the model has " + std::to_string(dim));
  }
}

void MixtureBank::log_densities(ConstMatrixRefF frames, MatrixRefF out) const {
  detail::require_width(frames, dim());
  validate_finite(frames, "frames");
  require(out.rows() == frames.rows() && out.cols() == num_states(),
          "out must have shape (num_frames, num_states)");
  const auto table = table_of(columns_f_, means_.rows(), dim());
  thread_local std::vector<float> scratch;
  scratch.resize(static_cast<std::size_t>(2 * table.stride));
  const detail::MixtureKernels& kernels = detail::mixture_kernels();
  const int k = num_mixtures();
  for (Eigen::Index t = 0; t < frames.rows(); ++t) {
    kernels.distances_f(frames.data() + t * frames.outerStride(), table, scratch.data());
    for (std::size_t r = 0; r < constants_f_.size(); ++r)
      scratch[r] = constants_f_[r] - 0.5F * scratch[r];
    float* of_frame = out.data() + t * out.outerStride();
    if (k == 1) {
      std::copy_n(scratch.data(), constants_f_.size(), of_frame);
    } else {
      kernels.log_sums(scratch.data(), num_states(), k, scratch.data() + table.stride, of_frame);
    }
  }
}

void MixtureBank::log_densities(ConstMatrixRefF frames, MatrixD* out, MatrixD* shares) const {
  detail::require_width(frames, dim());
  out->resize(frames.rows(), num_states());
  if (shares != nullptr) shares->setOnes(frames.rows(), means_.rows());
  validate_finite(frames, "frames");
  detail::log_densities_of_finite(*this, frames, out->data(), num_states(),
                                  shares == nullptr ? nullptr : shares->data(), means_.rows());
}

void MixtureBank::log_densities(ConstMatrixRefF frames, double* out) const {
  detail::require_width(frames, dim());
  validate_finite(frames, "frames");
  detail::log_densities_of_finite(*this, frames, out, num_states(), nullptr, 0);
}

void detail::log_densities_of_finite(const MixtureBank& bank, ConstMatrixRefF frames, double* out,
                                     std::ptrdiff_t stride, double* shares,
                                     std::ptrdiff_t share_stride) {
  const auto num_rows = static_cast<std::ptrdiff_t>(bank.constants_.size());
  const auto table = table_of(bank.columns_, num_rows, bank.dim());
  thread_local AlignedVector buffer;
  buffer.resize(static_cast<std::size_t>(table.stride + bank.dim()));
  double* logs = buffer.data();
  double* x = logs + table.stride;
  const MixtureKernels& kernels = mixture_kernels();
  const bool mixed = bank.num_mixtures() > 1;
  Mixing mixing(bank.num_states(), bank.num_mixtures());
  for (Eigen::Index t = 0; t < frames.rows(); ++t) {
    const float* frame = frames.data() + t * frames.outerStride();
    for (int d = 0; d < bank.dim(); ++d) x[d] = static_cast<double>(frame[d]);
    kernels.distances(x, table, logs);
    for (std::ptrdiff_t r = 0; r < num_rows; ++r)
      logs[r] = bank.constants_[static_cast<std::size_t>(r)] - 0.5 * logs[r];
    if (mixed) {
      mixing.mix(logs, out + t * stride, shares == nullptr ? nullptr : shares + t * share_stride);
    } else {
      std::copy_n(logs, num_rows, out + t * stride);
    }
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
