// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/language/word_emissions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "hri/core/error.hpp"
#include "hri/language/connected_decoder.hpp"
#include "models/model_testing.hpp"

namespace hri {
namespace {

// Without leaving words early or late: a word may end in any state, at no cost.
template <class Start, class Transition>
WordChain closed_chain(const Start& log_start, const Transition& log_transition) {
  return {log_start, log_transition, VectorD::Zero(log_start.size()), false};
}

// One word that lasts from the first frame to the last.
WordNetwork only_word(int model) {
  constexpr int null = WordNetwork::kNull;
  return {{null, model, null}, {{0, 1}, {1, 2}}, 0, 2};
}

TEST(GaussianEmissions, GiveTheDecoderTheViterbiScoreOfEveryModel) {
  std::vector<GaussianMixtureHmm> models;
  std::vector<WordChain> chains;
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    GaussianMixtureHmmOptions options;
    options.topology.num_states = 2 + static_cast<int>(seed);
    options.num_mixtures = 2;
    models.push_back(GaussianMixtureHmm::train(
        {testing_data::noise(60, 3, seed, 0.5), testing_data::noise(50, 3, seed + 10)}, options));
    const MarkovChain& chain = models.back().chain();
    chains.push_back(closed_chain(chain.log_start(), chain.transition().array().log()));
  }
  const GaussianEmissions emissions(models);
  ASSERT_EQ(emissions.num_states(), 3 + 4 + 5);
  const MatrixF frames = testing_data::noise(40, 3, 7);
  MatrixF scores(40, emissions.num_states());
  emissions.compute(frames, scores);
  for (int m = 0; m < 3; ++m) {
    ConnectedDecoder decoder(chains, only_word(m));
    for (Eigen::Index t = 0; t < frames.rows(); ++t) decoder.push(row_span(scores, t));
    const DecodedSentence found = decoder.finish();
    const double expected = models[static_cast<std::size_t>(m)].viterbi(frames);
    EXPECT_NEAR(found.log_score, expected, 1e-4 * std::fabs(expected));  // floats against doubles
  }
  EXPECT_THROW(emissions.compute(testing_data::noise(40, 4, 7), scores), InvalidArgument);
  MatrixF narrow(40, 3);
  EXPECT_THROW(emissions.compute(frames, narrow), InvalidArgument);
}

TEST(GaussianEmissions, RefuseModelsOfDifferentDimensions) {
  GaussianMixtureHmmOptions options;
  const auto model = [&](int dim) {
    return GaussianMixtureHmm::train({testing_data::noise(60, dim, 1)}, options);
  };
  EXPECT_THROW(GaussianEmissions({}), InvalidArgument);
  EXPECT_THROW(GaussianEmissions({model(2), model(3)}), InvalidArgument);
}

TEST(GaussianEmissions, MarginalIsTheIntegralOverWhatIsLeftOut) {
  GaussianMixtureHmmOptions options;
  options.num_mixtures = 2;
  options.topology.num_states = 2;
  const auto model = GaussianMixtureHmm::train(
      {testing_data::noise(60, 2, 1, 0.5), testing_data::noise(50, 2, 11)}, options);
  const GaussianEmissions emissions({model});
  const std::vector<int> second{1};
  const GaussianEmissions marginal = emissions.marginal(second);
  ASSERT_EQ(marginal.dim(), 1);
  ASSERT_EQ(marginal.num_states(), 2);
  MatrixF found(1, 2);
  const MatrixF frame = MatrixF::Constant(1, 1, 0.4F);
  marginal.compute(frame, found);
  constexpr double kStep = 0.01;
  const Eigen::Index count = 4000;
  MatrixF grid(count, 2);
  grid.col(1).setConstant(0.4F);
  grid.col(0) = VectorF::LinSpaced(count, -20.0F, 19.99F);
  MatrixF densities(count, 2);
  emissions.compute(grid, densities);
  for (int j = 0; j < 2; ++j) {
    const double integral = densities.col(j).cast<double>().array().exp().sum() * kStep;
    EXPECT_NEAR(std::exp(found(0, j)), integral, 1e-3 * integral);
  }
  EXPECT_THROW(emissions.marginal(std::vector<int>{}), InvalidArgument);
  EXPECT_THROW(emissions.marginal(std::vector<int>{2}), InvalidArgument);
  EXPECT_THROW(emissions.marginal(std::vector<int>{-1}), InvalidArgument);
}

TEST(PossibilisticEmissions, GiveTheDecoderThePossibilityOfEveryModel) {
  std::vector<std::vector<SymbolSequence>> per_class(2);
  for (std::int32_t c = 0; c < 2; ++c) {
    for (std::int32_t k = 0; k < 5; ++k)
      per_class[static_cast<std::size_t>(c)].push_back({c, c, k % 3, 2, 2 - c, 3, 3});
  }
  PossibilisticHmmOptions options;
  options.topology.num_states = 3;
  options.num_symbols = 4;
  const auto set = PossibilisticHmmSet::train(per_class, options);
  const PossibilisticEmissions emissions(set);
  std::vector<WordChain> chains;
  for (int c = 0; c < 2; ++c) {
    const VectorD log_start = set.start(c).array().log();
    const MatrixD log_transition = set.transition(c).array().log();
    chains.push_back(closed_chain(log_start, log_transition));
  }
  const SymbolSequence symbols{0, 1, 2, 2, 1, 3};
  for (int c = 0; c < 2; ++c) {
    ConnectedDecoder decoder(chains, only_word(c));
    for (const std::int32_t symbol : symbols) decoder.push(emissions.of(symbol));
    EXPECT_NEAR(decoder.finish().log_score, set.viterbi(c, symbols), 1e-5);
  }
  EXPECT_THROW((void)emissions.of(4), InvalidArgument);
  EXPECT_THROW((void)emissions.of(-1), InvalidArgument);
  options.rule.conjunction = Conjunction::min;
  EXPECT_THROW(PossibilisticEmissions(PossibilisticHmmSet::train(per_class, options)),
               InvalidArgument);
}

TEST(CodedPossibilities, AreDensitiesOfCodewordsByTheLargestInEveryColumn) {
  std::vector<GaussianMixtureHmm> models;
  for (const std::uint64_t seed : {1U, 2U}) {
    GaussianMixtureHmmOptions options;
    options.num_mixtures = 2;
    options.topology.num_states = 2 + static_cast<int>(seed);
    models.push_back(GaussianMixtureHmm::train({testing_data::noise(80, 3, seed)}, options));
  }
  const GaussianEmissions emissions(models);
  const MatrixF frames = testing_data::noise(50, 3, 7);
  CodebookOptions options;
  options.num_codewords = 8;
  const std::vector<int> widths{1, 1, 1};
  const auto codebook = MultiStreamCodebook::train_lbg(frames, widths, options);
  const CodedPossibilities possibilities(emissions, codebook);
  ASSERT_EQ(possibilities.num_states(), 3 + 4);
  ASSERT_EQ(possibilities.dim(), 3);
  MatrixF found(50, 7);
  possibilities.compute(frames, found);
  const Matrix<std::int32_t> symbols = codebook.quantise(frames);
  for (Eigen::Index t = 0; t < frames.rows(); ++t) {
    VectorD expected = VectorD::Zero(7);
    for (int c = 0; c < 3; ++c) {
      const double codeword = codebook.stream(c).centroids()(symbols(t, c), 0);
      VectorD densities(7);
      Eigen::Index state = 0;
      for (const GaussianMixtureHmm& model : models) {
        const MixtureBank& bank = model.bank();
        for (int j = 0; j < model.num_states(); ++j, ++state) {
          double density = 0;
          for (int k = 0; k < 2; ++k) {
            const double variance = bank.variances()(2 * j + k, c);
            const double away = codeword - bank.means()(2 * j + k, c);
            density += bank.weights()(j, k) * std::exp(-0.5 * away * away / variance) /
                       std::sqrt(2 * M_PI * variance);
          }
          densities[state] = density;
        }
      }
      expected.array() += (densities / densities.maxCoeff()).array().log();
    }
    EXPECT_LT((found.row(t).transpose().cast<double>() - expected).cwiseAbs().maxCoeff(), 1e-3);
  }
  EXPECT_LE(found.maxCoeff(), 0);
  // Columns are joined by the product.
  MatrixF parts = MatrixF::Zero(50, 7);
  for (const std::vector<int>& columns : {std::vector<int>{1}, std::vector<int>{0, 2}}) {
    MatrixF part(50, 7);
    possibilities.compute(frames, columns, part);
    parts += part;
  }
  EXPECT_LT((parts - found).cwiseAbs().maxCoeff(), 1e-4);
  EXPECT_THROW(possibilities.compute(frames, {}, found), InvalidArgument);
  EXPECT_THROW(possibilities.compute(frames, std::vector<int>{3}, found), InvalidArgument);
  MatrixF narrow(50, 3);
  EXPECT_THROW(possibilities.compute(frames, narrow), InvalidArgument);
  EXPECT_THROW(possibilities.compute(testing_data::noise(50, 4, 7), found), InvalidArgument);
  const std::vector<int> two{1, 2};
  const auto wider = MultiStreamCodebook::train_lbg(frames, two, options);
  EXPECT_THROW(CodedPossibilities(emissions, wider), InvalidArgument);
}

}  // namespace
}  // namespace hri
