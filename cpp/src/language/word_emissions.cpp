// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/language/word_emissions.hpp"

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

}  // namespace hri
