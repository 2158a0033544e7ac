// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// The models that sequence_model_test.cpp puts to the test. A case names the model and its
// sequences, makes both, and says what the score is over all paths: a sum of probabilities, or for
// models of possibility the largest.
#pragma once

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "hri/models/hmm/discrete_hmm.hpp"
#include "hri/models/hmm/gaussian_mixture_hmm.hpp"
#include "hri/models/possibility/possibilistic_hmm.hpp"
#include "models/model_testing.hpp"

namespace hri::testing_data {

using Kind = Topology::Kind;

inline const std::vector<Topology> kTopologies{
    {Kind::left_right, 3, 1}, {Kind::left_right, 3, 2},
    {Kind::left_right, 1, 1}, {Kind::banded, 3, 1},
    {Kind::ergodic, 3, 1},    {Kind::ergodic, 1, 1},
    {Kind::banded, 9, 2},     {Kind::rank_one_plus_band, 4, 1},
    {Kind::ergodic, 9, 1},
};

// What adding up, or taking the largest of, the probabilities of all paths gives.
struct AllPaths {
  double sum = 0;
  double best = 0;
  std::vector<int> best_path;
  MatrixD posterior;  // of the states, frame by frame
};

inline AllPaths all_paths(const VectorD& start, const MatrixD& transition, const MatrixD& b) {
  AllPaths result;
  const auto n = static_cast<int>(start.size());
  const auto num_frames = static_cast<int>(b.rows());
  result.posterior = MatrixD::Zero(num_frames, n);
  const int num_paths = static_cast<int>(std::lround(std::pow(n, num_frames)));
  std::vector<int> path(static_cast<std::size_t>(num_frames));
  for (int code = 0; code < num_paths; ++code) {
    for (int t = 0, rest = code; t < num_frames; ++t, rest /= n)
      path[static_cast<std::size_t>(t)] = rest % n;
    double p = start[path[0]] * b(0, path[0]);
    for (int t = 1; t < num_frames; ++t) {
      p *= transition(path[static_cast<std::size_t>(t) - 1], path[static_cast<std::size_t>(t)]) *
           b(t, path[static_cast<std::size_t>(t)]);
    }
    result.sum += p;
    for (int t = 0; t < num_frames; ++t)
      result.posterior(t, path[static_cast<std::size_t>(t)]) += p;
    if (p > result.best) {
      result.best = p;
      result.best_path = path;
    }
  }
  if (result.sum > 0) result.posterior /= result.sum;
  return result;
}

// Random rows that sum to 1, with the topology's zeros.
inline MatrixD random_band(const Topology& topology, Random* random) {
  MatrixD a = MatrixD::Zero(topology.num_states, topology.num_states);
  for (int i = 0; i < topology.num_states; ++i) {
    for (int j = topology.first_next(i); j < topology.end_next(i); ++j)
      a(i, j) = 0.1 + random->uniform();
    a.row(i) /= a.row(i).sum();
  }
  return a;
}

/// Random start (where any may be) and transitions, and jumps where the topology has them.
inline MarkovChain random_chain(const Topology& topology, Random* random) {
  const int n = topology.num_states;
  VectorD start = initial_start(topology);
  for (int i = 0; i < n; ++i) start[i] *= 0.1 + random->uniform();
  start /= start.sum();
  MatrixD band = random_band(topology, random);
  if (topology.kind != Kind::rank_one_plus_band) return {topology, start, band};
  VectorD leave(n);
  VectorD land(n);
  for (int i = 0; i < n; ++i) {
    leave[i] = 0.1 + 0.5 * random->uniform();
    land[i] = 0.1 + random->uniform();
    band.row(i) *= 1 - leave[i];
  }
  return {topology, start, band, leave, land / land.sum()};
}

/// The same numbers as a chain without structure.
inline MarkovChain as_ergodic(const MarkovChain& chain) {
  return {{Kind::ergodic, chain.num_states(), 1}, chain.start(), chain.transition()};
}

template <class Values>
Values permuted_rows(const Values& values, const std::vector<int>& order, Eigen::Index group = 1) {
  Values result = values;
  for (std::size_t i = 0; i < order.size(); ++i) {
    result.middleRows(static_cast<Eigen::Index>(i) * group, group) =
        values.middleRows(order[i] * group, group);
  }
  return result;
}

struct DiscreteCase {
  using Model = DiscreteHmm;
  using Sequence = SymbolSequence;
  static constexpr bool kProbabilistic = true;
  static constexpr const char* kTransitionField = "transition";
  static constexpr double kRounding = 1e-12;  // of log_likelihood, for other orders of its sums
  static constexpr int kNumLetters = 4;       // letters: frames that differ

  static Model make(const Topology& topology, std::uint64_t seed) {
    Random random(seed);
    MatrixD emission(topology.num_states, kNumLetters);
    for (Eigen::Index i = 0; i < emission.size(); ++i) emission.data()[i] = 0.1 + random.uniform();
    for (Eigen::Index j = 0; j < emission.rows(); ++j) emission.row(j) /= emission.row(j).sum();
    return {random_chain(topology, &random), emission};
  }
  // State i is what order[i] was.
  static Model permuted(const Model& model, const MarkovChain& chain,
                        const std::vector<int>& order) {
    return {chain, permuted_rows(model.emission(), order)};
  }
  static Sequence spell(const std::vector<int>& letters) {
    return {letters.begin(), letters.end()};
  }
  static Sequence sequence(int num_frames, std::uint64_t seed) {
    Random random(seed);
    Sequence s;
    for (int t = 0; t < num_frames; ++t)
      s.push_back(static_cast<std::int32_t>(random.below(kNumLetters)));
    return s;
  }
  static MatrixD densities(const Model& model, const Sequence& s) {
    MatrixD b(static_cast<Eigen::Index>(s.size()), model.num_states());
    for (std::size_t t = 0; t < s.size(); ++t)
      b.row(static_cast<Eigen::Index>(t)) = model.emission().col(s[t]).transpose();
    return b;
  }
  static MatrixD emissions(const Model& model) { return model.emission(); }
  static VectorD start(const Model& model) { return model.chain().start(); }
  static MatrixD transition(const Model& model) { return model.chain().transition(); }
  static double over_all(const AllPaths& paths) { return paths.sum; }
  static DiscreteHmmOptions options(const Topology& topology) {
    DiscreteHmmOptions options;
    options.topology = topology;
    options.num_symbols = kNumLetters;
    options.emission_floor = 0;
    options.tolerance = 0;
    return options;
  }
  static Model train(const std::vector<Sequence>& sequences, const Topology& topology,
                     TrainingReport* report, const StopCheck& stop) {
    DiscreteHmmOptions o = options(topology);
    o.should_stop = stop;
    return Model::train(sequences, o, report);
  }
};

struct GaussianCase {
  using Model = GaussianMixtureHmm;
  using Sequence = MatrixF;
  static constexpr bool kProbabilistic = true;
  static constexpr const char* kTransitionField = "transition";
  static constexpr double kRounding = 1e-12;
  static constexpr int kNumLetters = 4;

  static Model make(const Topology& topology, std::uint64_t seed) {
    Random random(seed);
    const int n = topology.num_states;
    const MatrixD weights = MatrixD::Constant(n, 2, 0.5);
    MatrixD means(2 * n, 2);
    for (Eigen::Index i = 0; i < means.size(); ++i) means.data()[i] = 2.0 * random.normal();
    MatrixD variances(2 * n, 2);
    for (Eigen::Index i = 0; i < variances.size(); ++i)
      variances.data()[i] = 0.5 + random.uniform();
    return {random_chain(topology, &random), MixtureBank(weights, means, variances)};
  }
  static Model permuted(const Model& model, const MarkovChain& chain,
                        const std::vector<int>& order) {
    const MixtureBank& bank = model.bank();
    return {chain,
            MixtureBank(permuted_rows(bank.weights(), order), permuted_rows(bank.means(), order, 2),
                        permuted_rows(bank.variances(), order, 2))};
  }
  static Sequence spell(const std::vector<int>& letters) {
    const MatrixF alphabet = noise(kNumLetters, 2, 77);
    MatrixF s(static_cast<Eigen::Index>(letters.size()), 2);
    for (std::size_t t = 0; t < letters.size(); ++t)
      s.row(static_cast<Eigen::Index>(t)) = alphabet.row(letters[t]);
    return s;
  }
  static Sequence sequence(int num_frames, std::uint64_t seed) {
    return noise(num_frames, 2, seed);
  }
  static MatrixD densities(const Model& model, const Sequence& s) {
    MatrixD b = MatrixD::Zero(s.rows(), model.num_states());
    for (Eigen::Index t = 0; t < s.rows(); ++t) {
      for (int j = 0; j < model.num_states(); ++j) {
        for (int k = 0; k < 2; ++k) {
          double p = model.bank().weights()(j, k);
          for (int d = 0; d < 2; ++d) {
            const double v = model.bank().variances()(2 * j + k, d);
            const double x = static_cast<double>(s(t, d)) - model.bank().means()(2 * j + k, d);
            p *= std::exp(-0.5 * x * x / v) / std::sqrt(2 * 3.14159265358979323846 * v);
          }
          b(t, j) += p;
        }
      }
    }
    return b;
  }
  static MatrixD emissions(const Model& model) { return model.bank().means(); }
  static VectorD start(const Model& model) { return model.chain().start(); }
  static MatrixD transition(const Model& model) { return model.chain().transition(); }
  static double over_all(const AllPaths& paths) { return paths.sum; }
  static GaussianMixtureHmmOptions options(const Topology& topology) {
    GaussianMixtureHmmOptions options;
    options.topology = topology;
    options.num_mixtures = 2;
    options.weight_floor = 0;
    options.variance_floor = 1e-6;
    options.tolerance = 0;
    return options;
  }
  static Model train(const std::vector<Sequence>& sequences, const Topology& topology,
                     TrainingReport* report, const StopCheck& stop) {
    GaussianMixtureHmmOptions o = options(topology);
    o.should_stop = stop;
    return Model::train(sequences, o, report);
  }
};

// One class of a set of possibility-theory models, product conjunction: the score is the best path.
class OnePossibilisticHmm {
 public:
  explicit OnePossibilisticHmm(const DiscreteHmm& model) : set_({model}) {}
  explicit OnePossibilisticHmm(PossibilisticHmmSet set) : set_(std::move(set)) {}

  [[nodiscard]] double log_likelihood(const SymbolSequence& s) const {
    return static_cast<double>(set_.log_possibilities(s)[0]);
  }
  [[nodiscard]] double log_likelihood_exact(const SymbolSequence& s) const {
    return set_.log_possibilities_exact(s)[0];
  }
  double viterbi(const SymbolSequence& s, std::vector<int>* path = nullptr) const {
    return set_.viterbi(0, s, path);
  }
  [[nodiscard]] const MarkovChain& chain() const { return set_.models().front().chain(); }
  [[nodiscard]] const DiscreteHmm& model() const { return set_.models().front(); }
  [[nodiscard]] const PossibilisticHmmSet& set() const { return set_; }
  void write(ModelFile& file, const std::string& prefix) const { set_.write(file, prefix); }
  static OnePossibilisticHmm read(const ModelFile& file, const std::string& prefix) {
    return OnePossibilisticHmm(PossibilisticHmmSet::read(file, prefix));
  }

 private:
  PossibilisticHmmSet set_;
};

struct PossibilisticCase : DiscreteCase {
  using Model = OnePossibilisticHmm;
  static constexpr bool kProbabilistic = false;
  static constexpr const char* kTransitionField = "0.transition";
  static constexpr double kRounding = 5e-5;  // thousands of floats added up

  static Model make(const Topology& topology, std::uint64_t seed) {
    return Model(DiscreteCase::make(topology, seed));
  }
  static Model permuted(const Model& model, const MarkovChain& chain,
                        const std::vector<int>& order) {
    return Model(DiscreteCase::permuted(model.model(), chain, order));
  }
  static MatrixD densities(const Model& model, const Sequence& s) {
    const MatrixD emission = model.set().emission(0);
    MatrixD b(static_cast<Eigen::Index>(s.size()), emission.rows());
    for (std::size_t t = 0; t < s.size(); ++t)
      b.row(static_cast<Eigen::Index>(t)) = emission.col(s[t]).transpose();
    return b;
  }
  static MatrixD emissions(const Model& model) { return model.set().emission(0); }
  static VectorD start(const Model& model) { return model.set().start(0); }
  static MatrixD transition(const Model& model) { return model.set().transition(0); }
  static double over_all(const AllPaths& paths) { return paths.best; }
};

}  // namespace hri::testing_data
