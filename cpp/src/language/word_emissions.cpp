// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/language/word_emissions.hpp"

#include <algorithm>
#include <utility>

#include "hri/core/error.hpp"

namespace hri {

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
    : codebook_(std::move(codebook)) {
  require(codebook_.dim() == models.dim() && codebook_.num_streams() == models.dim(),
          "codebook: it must have a stream for every column of the models");
  for (int c = 0; c < dim(); ++c) {
    MatrixF codewords = codebook_.stream(c).centroids();
    std::sort(codewords.data(), codewords.data() + codewords.size());
    Column column;
    for (Eigen::Index k = 1; k < codewords.rows(); ++k)
      column.borders.push_back(0.5F * (codewords(k - 1, 0) + codewords(k, 0)));
    column.table.resize(codewords.rows(), models.num_states());
    Eigen::Index state = 0;
    for (const GaussianMixtureHmm& model : models.models()) {
      const MixtureBank& bank = model.bank();
      const MixtureBank part(bank.weights(), bank.means().col(c), bank.variances().col(c));
      part.log_densities(codewords, column.table.middleCols(state, model.num_states()));
      state += model.num_states();
    }
    column.table.colwise() -= column.table.rowwise().maxCoeff().eval();
    columns_.push_back(std::move(column));
  }
}

void CodedPossibilities::compute(ConstMatrixRefF frames, MatrixRefF out) const {
  require(frames.cols() == dim(), "frames do not have the columns of the codebook");
  require(out.rows() == frames.rows() && out.cols() == num_states(),
          "out must have a row a frame and a column a state");
  require(frames.allFinite(), "frames must be finite");
  for (Eigen::Index t = 0; t < frames.rows(); ++t) {
    out.row(t).setZero();
    for (Eigen::Index c = 0; c < frames.cols(); ++c) {
      const Column& column = columns_[static_cast<std::size_t>(c)];
      const auto border =
          std::upper_bound(column.borders.begin(), column.borders.end(), frames(t, c));
      out.row(t) += column.table.row(border - column.borders.begin());
    }
  }
}

}  // namespace hri
