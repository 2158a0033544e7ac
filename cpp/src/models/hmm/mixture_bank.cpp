// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/hmm/mixture_bank.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "core/simd.hpp"
#include "hri/core/error.hpp"
#include "hri/models/row_checks.hpp"

namespace hri {
namespace {

constexpr double kLog2Pi = 1.8378770664093454835606594728112;

// Weighted squared distance of one frame to every row of means; the hot loop of scoring.
template <class T>
[[gnu::always_inline]] inline void weigh(const T* x, const T* means, const T* precisions,
                                         int num_rows, int dim, T* out) {
  constexpr int kLanes = 64 / sizeof(T);
  for (int r = 0; r < num_rows; ++r) {
    const T* m = means + static_cast<std::ptrdiff_t>(r) * dim;
    const T* p = precisions + static_cast<std::ptrdiff_t>(r) * dim;
    T lanes[kLanes] = {};
    int d = 0;
    for (; d + kLanes <= dim; d += kLanes) {
      for (int l = 0; l < kLanes; ++l) {
        const T diff = x[d + l] - m[d + l];
        lanes[l] += diff * diff * p[d + l];
      }
    }
    T sum = 0;
    for (; d < dim; ++d) {
      const T diff = x[d] - m[d];
      sum += diff * diff * p[d];
    }
    for (int width = kLanes / 2; width > 0; width /= 2) {
      for (int l = 0; l < width; ++l) lanes[l] += lanes[l + width];
    }
    out[r] = sum + lanes[0];
  }
}

HRI_SIMD_CLONES
void weighted_distances(const float* x, const float* means, const float* precisions, int num_rows,
                        int dim, float* out) {
  weigh(x, means, precisions, num_rows, dim, out);
}

HRI_SIMD_CLONES
void weighted_distances(const double* x, const double* means, const double* precisions,
                        int num_rows, int dim, double* out) {
  weigh(x, means, precisions, num_rows, dim, out);
}

template <class T>
T log_sum_exp(const T* values, int count) {
  T top = values[0];
  for (int i = 1; i < count; ++i) top = values[i] > top ? values[i] : top;
  if (count == 1 || !(top > -std::numeric_limits<T>::infinity())) return top;
  T sum = 0;
  for (int i = 0; i < count; ++i) sum += std::exp(values[i] - top);
  return top + std::log(sum);
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
  constants_.resize(rows);
  for (Eigen::Index r = 0; r < rows; ++r) {
    const double weight = weights_.data()[r];
    constants_[r] = std::log(weight) - 0.5 * (static_cast<double>(means_.cols()) * kLog2Pi +
                                              variances_.row(r).array().log().sum());
  }
  precisions_ = variances_.cwiseInverse();
  means_f_ = means_.cast<float>();
  precisions_f_ = precisions_.cast<float>();
  constants_f_ = constants_.cast<float>();
}

void MixtureBank::log_densities(ConstMatrixRefF frames, MatrixRefF out) const {
  if (frames.cols() != dim()) {
    fail(ErrorKind::invalid_argument, "frames have " + std::to_string(frames.cols()) +
                                          " columns, the model has " + std::to_string(dim()));
  }
  validate_finite(frames, "frames");
  require(out.rows() == frames.rows() && out.cols() == num_states(),
          "out must have shape (num_frames, num_states)");
  const int num_rows = static_cast<int>(means_f_.rows());
  const int k = num_mixtures();
  thread_local std::vector<float> scratch;
  scratch.resize(static_cast<std::size_t>(num_rows));
  for (Eigen::Index t = 0; t < frames.rows(); ++t) {
    const float* x = frames.data() + t * frames.outerStride();
    weighted_distances(x, means_f_.data(), precisions_f_.data(), num_rows, dim(), scratch.data());
    for (int r = 0; r < num_rows; ++r) {
      float& s = scratch[static_cast<std::size_t>(r)];
      s = constants_f_[r] - 0.5F * s;
    }
    for (int j = 0; j < num_states(); ++j) out(t, j) = log_sum_exp(scratch.data() + j * k, k);
  }
}

void MixtureBank::log_densities(ConstMatrixRefF frames, MatrixD* out, MatrixD* components) const {
  out->resize(frames.rows(), num_states());
  if (components != nullptr) components->resize(frames.rows(), means_.rows());
  log_densities_in_double(frames, out->data(),
                          components == nullptr ? nullptr : components->data());
}

void MixtureBank::log_densities(ConstMatrixRefF frames, double* out) const {
  log_densities_in_double(frames, out, nullptr);
}

void MixtureBank::log_densities_in_double(ConstMatrixRefF frames, double* out,
                                          double* components) const {
  validate_finite(frames, "frames");
  const int k = num_mixtures();
  const auto width = static_cast<std::size_t>(dim());
  thread_local std::vector<double> buffer;
  buffer.resize(width + static_cast<std::size_t>(means_.rows()));
  Eigen::Map<Eigen::RowVectorXd> x(buffer.data(), dim());
  for (Eigen::Index t = 0; t < frames.rows(); ++t) {
    x = frames.row(t).cast<double>();
    double* row = components == nullptr ? buffer.data() + width : components + t * means_.rows();
    weighted_distances(x.data(), means_.data(), precisions_.data(), static_cast<int>(means_.rows()),
                       dim(), row);
    for (Eigen::Index r = 0; r < means_.rows(); ++r) row[r] = constants_[r] - 0.5 * row[r];
    for (int j = 0; j < num_states(); ++j)
      out[t * num_states() + j] = log_sum_exp(row + static_cast<std::ptrdiff_t>(j) * k, k);
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
