// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/hmm/model_selection.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "hri/core/error.hpp"
#include "models/model_testing.hpp"

namespace hri {
namespace {

using Kind = Topology::Kind;
using namespace testing_data;

int drawn(const double* probabilities, int count, Random* random) {
  double left = random->uniform();
  for (int i = 0; i + 1 < count; ++i) {
    if (left < probabilities[i]) return i;
    left -= probabilities[i];
  }
  return count - 1;
}

std::vector<int> states_of(const MarkovChain& chain, int num_frames, Random* random) {
  const int n = chain.num_states();
  std::vector<int> states{drawn(chain.start().data(), n, random)};
  while (static_cast<int>(states.size()) < num_frames)
    states.push_back(drawn(chain.transition().data() + states.back() * n, n, random));
  return states;
}

// Three states that stay, each with symbols of its own for the most part.
std::vector<SymbolSequence> words(const MarkovChain& chain, int count, std::uint64_t seed) {
  MatrixD emission(3, 4);
  emission << 0.85, 0.05, 0.05, 0.05, 0.05, 0.85, 0.05, 0.05, 0.05, 0.05, 0.45, 0.45;
  Random random(seed);
  std::vector<SymbolSequence> sequences;
  for (int s = 0; s < count; ++s) {
    SymbolSequence& word = sequences.emplace_back();
    for (const int state : states_of(chain, 60, &random))
      word.push_back(drawn(emission.data() + state * 4, 4, &random));
  }
  return sequences;
}

std::vector<MatrixF> curves(const MarkovChain& chain, int count, std::uint64_t seed) {
  Random random(seed);
  std::vector<MatrixF> sequences;
  for (int s = 0; s < count; ++s) {
    const std::vector<int> states = states_of(chain, 60, &random);
    MatrixF& curve = sequences.emplace_back(60, 2);
    for (Eigen::Index t = 0; t < 60; ++t) {
      const int state = states[static_cast<std::size_t>(t)];
      curve(t, 0) = static_cast<float>(4 * state + random.normal());
      curve(t, 1) = static_cast<float>((state == 1 ? 4 : 0) + random.normal());
    }
  }
  return sequences;
}

MarkovChain known(Kind kind) {
  const Topology topology{kind, 3, 1};
  return {topology, initial_start(topology), initial_transition(topology, 0.9)};
}

StateChoiceOptions by(StateChoiceOptions::Criterion criterion) {
  StateChoiceOptions options;
  options.criterion = criterion;
  options.seed = 4;
  return options;
}

const std::vector<int> kCandidates{1, 2, 3, 4, 5};

TEST(ChooseNumStates, FindsTheStatesOfAKnownModel) {
  for (const Kind kind : {Kind::left_right, Kind::ergodic}) {
    const std::vector<SymbolSequence> symbols = words(known(kind), 30, 1);
    const std::vector<MatrixF> frames = curves(known(kind), 20, 2);
    DiscreteHmmOptions discrete;
    discrete.topology.kind = kind;
    discrete.num_symbols = 4;
    discrete.max_iterations = 100;
    GaussianMixtureHmmOptions gaussian;
    gaussian.topology.kind = kind;
    const StateChoiceOptions bic = by(StateChoiceOptions::Criterion::bic);
    const StateChoice a = choose_num_states(symbols, discrete, kCandidates, bic);
    const StateChoice b = choose_num_states(frames, gaussian, kCandidates, bic);
    EXPECT_EQ(a.num_states, 3);
    EXPECT_EQ(b.num_states, 3);
    ASSERT_EQ(a.candidates.size(), kCandidates.size());
    double frames_total = 30 * 60;
    for (std::size_t i = 0; i < kCandidates.size(); ++i) {
      const StateChoice::Candidate& c = a.candidates[i];
      EXPECT_EQ(c.num_states, kCandidates[i]);
      EXPECT_NEAR(
          c.score,
          c.log_likelihood - 0.5 * static_cast<double>(c.num_parameters) * std::log(frames_total),
          1e-6);
    }
  }
}

TEST(ChooseNumStates, FindsThemByHeldOutSequencesToo) {
  const StateChoiceOptions held_out = by(StateChoiceOptions::Criterion::held_out);
  DiscreteHmmOptions discrete;
  discrete.topology.kind = Kind::left_right;
  discrete.num_symbols = 4;
  discrete.max_iterations = 100;
  const std::vector<int> few{1, 2, 3};
  const StateChoice a =
      choose_num_states(words(known(Kind::left_right), 30, 1), discrete, few, held_out);
  EXPECT_EQ(a.num_states, 3);
  GaussianMixtureHmmOptions gaussian;
  gaussian.topology.kind = Kind::ergodic;
  const StateChoice b =
      choose_num_states(curves(known(Kind::ergodic), 20, 2), gaussian, few, held_out);
  EXPECT_EQ(b.num_states, 3);
  EXPECT_LT(a.candidates[0].score, a.candidates[1].score);
  EXPECT_NEAR(a.candidates[0].score, a.candidates[0].log_likelihood / (30 * 60), 1e-12);
}

TEST(ChooseNumStates, RepeatsForOneSeed) {
  DiscreteHmmOptions options;
  options.topology.kind = Kind::ergodic;
  options.num_symbols = 4;
  options.max_iterations = 3;
  StateChoiceOptions choice = by(StateChoiceOptions::Criterion::held_out);
  const auto score = [&] {
    return choose_num_states(words(known(Kind::ergodic), 10, 1), options, std::vector<int>{3},
                             choice)
        .candidates[0]
        .score;
  };
  const double first = score();
  EXPECT_EQ(score(), first);
  choice.seed = 5;
  EXPECT_NE(score(), first);
}

TEST(ChooseNumStates, CountsFreeParameters) {
  EXPECT_EQ(num_free_parameters(Topology{Kind::ergodic, 4, 1}), 3 + 4 * 3);
  EXPECT_EQ(num_free_parameters(Topology{Kind::left_right, 4, 1}), 3);  // the last state only stays
  EXPECT_EQ(num_free_parameters(Topology{Kind::left_right, 4, 2}), 2 + 2 + 1);
  EXPECT_EQ(num_free_parameters(Topology{Kind::banded, 4, 1}), 3 + 1 + 2 + 2 + 1);
  // The band's 10 entries, leave 4, less 4 rows that sum to 1; land 3; start 3.
  EXPECT_EQ(num_free_parameters(Topology{Kind::rank_one_plus_band, 4, 1}), 10 + 3 + 3);
  DiscreteHmmOptions discrete;
  discrete.topology = {Kind::ergodic, 4, 1};
  discrete.num_symbols = 6;
  EXPECT_EQ(num_free_parameters(discrete), 15 + 4 * 5);
  discrete.train_transitions = false;
  EXPECT_EQ(num_free_parameters(discrete), 4 * 5);
  GaussianMixtureHmmOptions gaussian;
  gaussian.topology = {Kind::ergodic, 4, 1};
  gaussian.num_mixtures = 3;
  EXPECT_EQ(num_free_parameters(gaussian, 5), 15 + 4 * 2 + 2 * 4 * 3 * 5);
  gaussian.tied_variance = true;
  EXPECT_EQ(num_free_parameters(gaussian, 5), 15 + 4 * 2 + 4 * 3 * 5 + 5);
}

TEST(ChooseNumStates, RefusesOptionsOutOfRangeByName) {
  DiscreteHmmOptions options;
  options.num_symbols = 4;
  const std::vector<SymbolSequence> data{{0, 1}, {1, 2}};
  const auto refused = [&](const std::vector<int>& candidates, const StateChoiceOptions& choice) {
    return message_of<InvalidArgument>(
        [&] { return choose_num_states(data, options, candidates, choice); });
  };
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "candidates", refused({}, {}));
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "num_states", refused({0}, {}));
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "num_folds",
                      refused({2}, by(StateChoiceOptions::Criterion::held_out)));
  StateChoiceOptions choice;
  choice.num_restarts = 0;
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "num_restarts", refused({2}, choice));
}

}  // namespace
}  // namespace hri
