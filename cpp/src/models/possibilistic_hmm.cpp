// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/possibilistic_hmm.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "forward_backward.hpp"
#include "hri/core/error.hpp"

namespace hri {
namespace {

constexpr float kMinusInf = -std::numeric_limits<float>::infinity();

const char* set_fault(const Topology& topology, const std::vector<MatrixD>& transitions,
                      const std::vector<MatrixD>& emissions) {
  if (const char* fault = topology_fault(topology)) return fault;
  if (transitions.empty() || transitions.size() != emissions.size())
    return "a set needs at least one class";
  const Eigen::Index n = topology.num_states;
  for (std::size_t c = 0; c < transitions.size(); ++c) {
    if (transitions[c].rows() != n || transitions[c].cols() != n || emissions[c].rows() != n ||
        emissions[c].cols() != emissions[0].cols() || emissions[c].cols() < 1) {
      return "the shapes of transitions and emissions do not fit";
    }
    if (!transitions[c].allFinite() || !emissions[c].allFinite())
      return "a possibility is not finite";
    if (transitions[c].minCoeff() < 0 || emissions[c].minCoeff() < 0 ||
        transitions[c].maxCoeff() > 1 || emissions[c].maxCoeff() > 1) {
      return "possibilities must lie in 0..1";
    }
    for (int i = 0; i < topology.num_states; ++i) {
      if (std::abs(transitions[c].row(i).maxCoeff() - 1) > 1e-9)
        return "every row of transition needs maximum 1";
      for (int j = 0; j < topology.num_states; ++j) {
        if (!topology.allows(i, j) && transitions[c](i, j) != 0)
          return "transition has an entry outside its topology";
      }
    }
  }
  return nullptr;
}

// Viterbi re-estimation: count along best paths instead of summing over all of them.
DiscreteHmm reestimate(const std::vector<SymbolSequence>& sequences, const DiscreteHmm& model,
                       double floor) {
  const int n = model.num_states();
  detail::ChainCounts counts(n);
  MatrixD emitted = MatrixD::Constant(n, model.num_symbols(), 1e-9);
  std::vector<int> path;
  for (const SymbolSequence& s : sequences) {
    model.viterbi(s, &path);
    if (path.empty()) continue;
    counts.start[path.front()] += 1;
    for (std::size_t t = 0; t < path.size(); ++t) {
      emitted(path[t], s[t]) += 1;
      if (t > 0) counts.band(path[t - 1], path[t]) += 1;
    }
  }
  // One imagined visit of every allowed transition keeps rare ones possible.
  for (int i = 0; i < n; ++i) {
    for (int j = model.chain().topology().first_next(i); j < model.chain().topology().end_next(i);
         ++j)
      counts.band(i, j) += 1;
  }
  MatrixD emission = model.emission();
  for (int j = 0; j < n; ++j) {
    if (emitted.row(j).sum() > 0.5) emission.row(j) = emitted.row(j) / emitted.row(j).sum();
    emission.row(j) = emission.row(j).cwiseMax(floor);
    emission.row(j) /= emission.row(j).sum();
  }
  return {detail::estimate_chain(counts, model.chain()), emission};
}

DiscreteHmm train_class(const std::vector<SymbolSequence>& sequences,
                        const PossibilisticHmmOptions& options) {
  DiscreteHmmOptions first;
  first.topology = options.topology;
  first.num_symbols = options.num_symbols;
  first.emission_floor = options.emission_floor;
  first.max_iterations = 1;
  first.seed = options.seed;
  first.should_stop = options.should_stop;
  DiscreteHmm model = DiscreteHmm::train(sequences, first);
  for (int iteration = 0; iteration < options.max_iterations; ++iteration) {
    poll(options.should_stop);
    DiscreteHmm next = reestimate(sequences, model, options.emission_floor);
    const double moved =
        std::max((next.chain().transition() - model.chain().transition()).cwiseAbs().maxCoeff(),
                 (next.emission() - model.emission()).cwiseAbs().maxCoeff());
    model = std::move(next);
    if (moved < options.tolerance) break;
  }
  return model;
}

// max over i of join(phi(i), s_ij) for the states i that lead to j.
template <class Join>
float best_previous(const Topology& topology, const MatrixF& log_s, const float* phi, int j,
                    const Join& join) {
  const int begin =
      topology.kind == Topology::Kind::ergodic ? 0 : std::max(0, j - topology.max_jump);
  int end = topology.num_states;
  if (topology.kind == Topology::Kind::left_right) end = j + 1;
  if (topology.kind == Topology::Kind::banded)
    end = std::min(topology.num_states, j + topology.max_jump + 1);
  float best = kMinusInf;
  for (int i = begin; i < end; ++i) best = std::max(best, join(phi[i], log_s(i, j)));
  return best;
}

// Logs of possibilities rise with them, so min and max may be taken of the logs.
template <class Join>
float score(const Topology& topology, const MatrixF& log_s, const MatrixF& log_pi,
            Span<const std::int32_t> symbols, bool condition, const Join& join) {
  const auto n = static_cast<std::size_t>(topology.num_states);
  thread_local std::vector<float> buffers;
  buffers.resize(2 * n);
  float* phi = buffers.data();
  float* next = phi + n;
  float scale = 0;
  for (std::size_t t = 0; t < symbols.size(); ++t) {
    const float* pi = log_pi.data() + static_cast<Eigen::Index>(symbols[t]) * log_pi.cols();
    for (int j = 0; j < topology.num_states; ++j) {
      const bool startable = topology.kind != Topology::Kind::left_right || j == 0;
      const float before =
          t == 0 ? (startable ? 0.0F : kMinusInf) : best_previous(topology, log_s, phi, j, join);
      next[j] = join(before, pi[j]);
    }
    std::swap(phi, next);
    if (!condition) continue;
    const float top = *std::max_element(phi, phi + n);
    if (top == kMinusInf) return kMinusInf;
    for (std::size_t j = 0; j < n; ++j) phi[j] -= top;
    scale += top;
  }
  return *std::max_element(phi, phi + n) + scale;
}

double most_possible_path(const Topology& topology, const VectorD& log_start, const MatrixD& log_s,
                          const MatrixD& log_b, std::vector<int>* path) {
  const Eigen::Index num_frames = log_b.rows();
  MatrixD delta(num_frames, topology.num_states);
  Matrix<int> from = Matrix<int>::Zero(num_frames, topology.num_states);
  delta.row(0) = log_start.transpose() + log_b.row(0);
  for (Eigen::Index t = 1; t < num_frames; ++t) {
    for (int j = 0; j < topology.num_states; ++j) {
      const VectorD scores = delta.row(t - 1).transpose() + log_s.col(j);
      delta(t, j) = scores.maxCoeff(&from(t, j)) + log_b(t, j);
    }
  }
  int state = 0;
  const double best = delta.row(num_frames - 1).maxCoeff(&state);
  if (path != nullptr) {
    path->clear();
    if (!(best > -std::numeric_limits<double>::infinity())) return best;
    path->resize(static_cast<std::size_t>(num_frames));
    for (Eigen::Index t = num_frames - 1; t >= 0; --t) {
      (*path)[static_cast<std::size_t>(t)] = state;
      state = from(t, state);
    }
  }
  return best;
}

}  // namespace

PossibilisticHmmSet::PossibilisticHmmSet(Topology topology, Conjunction conjunction,
                                         bool conditioned, std::vector<MatrixD> transitions,
                                         std::vector<MatrixD> emissions)
    : topology_(topology),
      num_symbols_(static_cast<int>(emissions.front().cols())),
      conjunction_(conjunction),
      conditioned_(conditioned),
      transitions_(std::move(transitions)),
      emissions_(std::move(emissions)) {
  for (std::size_t c = 0; c < transitions_.size(); ++c) {
    log_transitions_.push_back(detail::safe_log(transitions_[c]).cast<float>());
    log_emissions_.push_back(detail::safe_log(MatrixD(emissions_[c].transpose())).cast<float>());
  }
}

PossibilisticHmmSet PossibilisticHmmSet::train(
    const std::vector<std::vector<SymbolSequence>>& per_class,
    const PossibilisticHmmOptions& options) {
  validate(options.topology);
  require(options.num_symbols >= 1 && options.num_symbols <= 65536,
          "num_symbols must lie in 1..65536");
  require(options.max_iterations >= 1, "max_iterations must be at least 1");
  require(options.emission_floor >= 0 && options.emission_floor * options.num_symbols <= 1,
          "emission_floor must lie in 0..1/num_symbols");
  require(options.tolerance >= 0, "tolerance must not be negative");
  require(!per_class.empty(), "training needs at least one class");
  std::vector<DiscreteHmm> models;
  for (std::size_t c = 0; c < per_class.size(); ++c) {
    if (per_class[c].empty())
      fail(ErrorKind::invalid_argument, "class " + std::to_string(c) + " has no sequence");
    validate_symbols(per_class[c], options.num_symbols, "class " + std::to_string(c) + ", ");
    models.push_back(train_class(per_class[c], options));
  }
  return from_hmms(models, options.conjunction, options.conditioned);
}

PossibilisticHmmSet PossibilisticHmmSet::from_hmms(const std::vector<DiscreteHmm>& models,
                                                   Conjunction conjunction, bool conditioned) {
  require(!models.empty(), "a set needs at least one model");
  const Topology& topology = models.front().chain().topology();
  std::vector<MatrixD> transitions;
  std::vector<MatrixD> emissions;
  VectorD largest = VectorD::Zero(models.front().num_symbols());
  for (const DiscreteHmm& m : models) {
    require(m.chain().topology().kind == topology.kind && m.num_states() == topology.num_states &&
                m.chain().topology().max_jump == topology.max_jump &&
                m.num_symbols() == models.front().num_symbols(),
            "all models of a set need the same topology and number of symbols");
    transitions.emplace_back(m.chain().transition().array().colwise() /
                             m.chain().transition().rowwise().maxCoeff().array());
    emissions.push_back(m.emission());
    largest = largest.cwiseMax(m.emission().colwise().maxCoeff().transpose());
  }
  // Eq. 5.14: divide by the largest likelihood of the symbol over all classes and states.
  for (MatrixD& e : emissions) {
    for (Eigen::Index o = 0; o < e.cols(); ++o) {
      if (largest[o] > 0) e.col(o) /= largest[o];
    }
  }
  return {topology, conjunction, conditioned, std::move(transitions), std::move(emissions)};
}

VectorF PossibilisticHmmSet::log_possibilities(Span<const std::int32_t> symbols) const {
  require(!symbols.empty(), "symbols must not be empty");
  for (std::size_t t = 0; t < symbols.size(); ++t) {
    if (symbols[t] >= 0 && symbols[t] < num_symbols_) continue;
    fail(ErrorKind::invalid_argument, "symbol " + std::to_string(symbols[t]) + " at position " +
                                          std::to_string(t) + " lies outside 0.." +
                                          std::to_string(num_symbols_ - 1));
  }
  VectorF result(num_classes());
  for (int c = 0; c < num_classes(); ++c) {
    const MatrixF& s = log_transitions_[static_cast<std::size_t>(c)];
    const MatrixF& pi = log_emissions_[static_cast<std::size_t>(c)];
    switch (conjunction_) {
      case Conjunction::product:
        result[c] = score(topology_, s, pi, symbols, false, [](float a, float b) { return a + b; });
        break;
      case Conjunction::min:
        result[c] = score(topology_, s, pi, symbols, conditioned_,
                          [](float a, float b) { return std::min(a, b); });
        break;
      case Conjunction::max:
        result[c] = score(topology_, s, pi, symbols, false,
                          [](float a, float b) { return std::max(a, b); });
        break;
    }
  }
  return result;
}

double PossibilisticHmmSet::viterbi(int class_index, Span<const std::int32_t> symbols,
                                    std::vector<int>* path) const {
  require(!symbols.empty(), "symbols must not be empty");
  const MatrixD& pi = emission(class_index);
  MatrixD log_b(static_cast<Eigen::Index>(symbols.size()), topology_.num_states);
  for (std::size_t t = 0; t < symbols.size(); ++t) {
    require(symbols[t] >= 0 && symbols[t] < num_symbols_,
            "a symbol lies outside 0..num_symbols - 1");
    log_b.row(static_cast<Eigen::Index>(t)) =
        detail::safe_log(VectorD(pi.col(symbols[t]))).transpose();
  }
  VectorD start = VectorD::Ones(topology_.num_states);
  if (topology_.kind == Topology::Kind::left_right) start = initial_start(topology_);
  const VectorD log_start = detail::safe_log(start);
  const MatrixD log_s = detail::safe_log(transition(class_index));
  return most_possible_path(topology_, log_start, log_s, log_b, path);
}

const MatrixD& PossibilisticHmmSet::transition(int class_index) const {
  require(class_index >= 0 && class_index < num_classes(), "class_index out of range");
  return transitions_[static_cast<std::size_t>(class_index)];
}

const MatrixD& PossibilisticHmmSet::emission(int class_index) const {
  require(class_index >= 0 && class_index < num_classes(), "class_index out of range");
  return emissions_[static_cast<std::size_t>(class_index)];
}

void PossibilisticHmmSet::write(ModelFile& file, const std::string& prefix) const {
  write_topology(topology_, file, prefix);
  file.set_integer(prefix + "conjunction", static_cast<std::int64_t>(conjunction_));
  file.set_integer(prefix + "conditioned", conditioned_ ? 1 : 0);
  file.set_integer(prefix + "num_classes", num_classes());
  for (int c = 0; c < num_classes(); ++c) {
    file.set_matrix(prefix + std::to_string(c) + ".transition", transition(c));
    file.set_matrix(prefix + std::to_string(c) + ".emission", emission(c));
  }
}

PossibilisticHmmSet PossibilisticHmmSet::read(const ModelFile& file, const std::string& prefix) {
  const Topology topology = read_topology(file, prefix);
  const std::int64_t conjunction = file.integer(prefix + "conjunction");
  const std::int64_t conditioned = file.integer(prefix + "conditioned");
  const std::int64_t num_classes = file.integer(prefix + "num_classes");
  if (conjunction < 0 || conjunction > 2 || conditioned < 0 || conditioned > 1 || num_classes < 1) {
    fail(ErrorKind::format,
         file.name() + ": fields of '" + prefix + "': conjunction, conditioned or num_classes");
  }
  std::vector<MatrixD> transitions;
  std::vector<MatrixD> emissions;
  for (std::int64_t c = 0; c < num_classes;
       ++c) {  // a class that is not there ends this, however large the number
    transitions.push_back(file.matrix_d(prefix + std::to_string(c) + ".transition"));
    emissions.push_back(file.matrix_d(prefix + std::to_string(c) + ".emission"));
  }
  if (const char* fault = set_fault(topology, transitions, emissions)) {
    fail(ErrorKind::format, file.name() + ": fields of '" + prefix + "': " + fault);
  }
  return {topology, static_cast<Conjunction>(conjunction), conditioned == 1, std::move(transitions),
          std::move(emissions)};
}

}  // namespace hri
