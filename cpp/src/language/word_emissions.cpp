// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/language/word_emissions.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "hri/core/error.hpp"
#include "language/possibility_kernels.hpp"

namespace hri {
namespace {

void check_columns(Span<const int> columns, int dim) {
  require(!columns.empty(), "columns: there is none");
  require(std::all_of(columns.begin(), columns.end(), [dim](int c) { return c >= 0 && c < dim; }),
          "columns: there is one that the models do not have");
}

}  // namespace

GaussianEmissions::GaussianEmissions(std::vector<GaussianMixtureHmm> models)
    : models_(std::move(models)) {
  require(!models_.empty(), "models: there is none");
  for (const GaussianMixtureHmm& model : models_) {
    require(model.dim() == dim(), "models: they differ in dimension");
    num_states_ += model.num_states();
  }
}

void GaussianEmissions::compute(ConstMatrixRefF frames, MatrixRefF out) const {
  require(out.rows() == frames.rows() && out.cols() == num_states_,
          "out must have a row a frame and a column a state");
  Eigen::Index first = 0;
  for (const GaussianMixtureHmm& model : models_) {
    model.bank().log_densities(frames, out.middleCols(first, model.num_states()));
    first += model.num_states();
  }
}

GaussianEmissions GaussianEmissions::marginal(Span<const int> columns) const {
  check_columns(columns, dim());
  std::vector<GaussianMixtureHmm> marginals;
  marginals.reserve(models_.size());
  const auto num_columns = static_cast<Eigen::Index>(columns.size());
  for (const GaussianMixtureHmm& model : models_) {
    const MixtureBank& bank = model.bank();
    MatrixD means(bank.means().rows(), num_columns);
    MatrixD variances(bank.means().rows(), num_columns);
    for (Eigen::Index i = 0; i < num_columns; ++i) {
      means.col(i) = bank.means().col(columns[static_cast<std::size_t>(i)]);
      variances.col(i) = bank.variances().col(columns[static_cast<std::size_t>(i)]);
    }
    marginals.emplace_back(model.chain(),
                           MixtureBank(bank.weights(), std::move(means), std::move(variances)));
  }
  return GaussianEmissions(std::move(marginals));
}

PossibilisticEmissions::PossibilisticEmissions(const PossibilisticHmmSet& set)
    : table_(set.num_symbols(), set.num_classes() * set.num_states()) {
  require(set.rule().conjunction == Conjunction::product,
          "connected words need the conjunction product");
  for (int c = 0; c < set.num_classes(); ++c) {
    table_.middleCols(c * set.num_states(), set.num_states()) =
        set.emission(c).transpose().array().log().cast<float>();
  }
}

Span<const float> PossibilisticEmissions::of(std::int32_t symbol) const {
  require(symbol >= 0 && symbol < num_symbols(), "symbol is not one of the models'");
  return row_span(table_, symbol);
}

CodedPossibilities::CodedPossibilities(const GaussianEmissions& models,
                                       MultiStreamCodebook codebook)
    : codebook_(std::move(codebook)),
      num_states_(models.num_states()),
      stride_((num_states_ + detail::kRowFloats - 1) / detail::kRowFloats * detail::kRowFloats) {
  require(codebook_.dim() == models.dim() && codebook_.num_streams() == models.dim(),
          "codebook: it must have a stream for every column of the models");
  std::ptrdiff_t num_rows = 0;
  for (int c = 0; c < dim(); ++c) num_rows += codebook_.stream(c).centroids().rows();
  table_.resize(static_cast<std::size_t>(num_rows * stride_));
  std::ptrdiff_t first_row = 0;
  for (int c = 0; c < dim(); ++c) {
    MatrixF codewords = codebook_.stream(c).centroids();
    std::sort(codewords.data(), codewords.data() + codewords.size());
    Column column{{}, first_row};
    for (Eigen::Index k = 1; k < codewords.rows(); ++k)
      column.borders.push_back(0.5F * (codewords(k - 1, 0) + codewords(k, 0)));
    while (column.borders.size() % detail::kRowFloats != 0)
      column.borders.push_back(std::numeric_limits<float>::infinity());
    MatrixF table(codewords.rows(), num_states_);
    Eigen::Index state = 0;
    for (const GaussianMixtureHmm& model : models.models()) {
      const MixtureBank& bank = model.bank();
      const MixtureBank part(bank.weights(), bank.means().col(c), bank.variances().col(c));
      part.log_densities(codewords, table.middleCols(state, model.num_states()));
      state += model.num_states();
    }
    table.colwise() -= table.rowwise().maxCoeff().eval();
    for (Eigen::Index k = 0; k < table.rows(); ++k, ++first_row)
      std::copy_n(table.row(k).data(), num_states_, table_.begin() + first_row * stride_);
    columns_.push_back(std::move(column));
    all_columns_.push_back(c);
  }
}

void CodedPossibilities::compute(ConstMatrixRefF frames, MatrixRefF out) const {
  compute(frames, all_columns_, out);
}

void CodedPossibilities::compute(ConstMatrixRefF frames, Span<const int> columns,
                                 MatrixRefF out) const {
  check_columns(columns, dim());
  require(frames.cols() == dim(), "frames do not have the columns of the codebook");
  require(out.rows() == frames.rows() && out.cols() == num_states(),
          "out must have a row a frame and a column a state");
  require(frames.allFinite(), "frames must be finite");
  thread_local std::vector<const float*> rows;
  thread_local std::vector<float, detail::CacheLineAllocator<float>> sums;
  rows.resize(columns.size());
  sums.resize(static_cast<std::size_t>(stride_));
  const detail::PossibilityKernels& kernels = detail::possibility_kernels();
  for (Eigen::Index t = 0; t < frames.rows(); ++t) {
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const Column& column = columns_[static_cast<std::size_t>(columns[i])];
      const std::ptrdiff_t codeword = kernels.count_up_to(
          column.borders.data(), static_cast<std::ptrdiff_t>(column.borders.size()),
          frames(t, columns[i]));
      rows[i] = table_.data() + (column.first_row + codeword) * stride_;
    }
    kernels.add_rows(rows.data(), static_cast<std::ptrdiff_t>(rows.size()), stride_, sums.data());
    std::copy_n(sums.data(), num_states_, out.row(t).data());
  }
}

}  // namespace hri
