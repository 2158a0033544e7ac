// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/hmm/discrete_hmm.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hri/core/error.hpp"
#include "hri/core/random.hpp"
#include "models/hmm/dense_kernels.hpp"
#include "models/hmm/forward_backward.hpp"
#include "models/hmm/forward_pass.hpp"

namespace hri {
namespace {

const char* emission_fault(int num_states, const MatrixD& emission) {
  if (emission.rows() != num_states || emission.cols() < 1)
    return "emission needs a row for every state";
  if (!emission.allFinite() || emission.minCoeff() < 0) return "emission must be finite and >= 0";
  if ((emission.rowwise().sum().array() - 1).abs().maxCoeff() > 1e-6)
    return "the rows of emission must sum to 1";
  return nullptr;
}

// A model that is trained on has its own number of symbols.
void check(const DiscreteHmmOptions& o, int num_symbols) {
  validate(o);
  require(num_symbols > 0, "DiscreteHmmOptions.num_symbols must be set");
  require(o.emission_floor * num_symbols <= 1, "emission_floor must not exceed 1 / num_symbols");
}

// Raises what lies below the floor to it and scales the rest, so that rows sum to 1: the likeliest
// of all distributions with that floor.
MatrixD floored(MatrixD emission, double floor) {
  for (Eigen::Index i = 0; i < emission.rows(); ++i) {
    auto row = emission.row(i).array();
    // Scaling down may bring others below the floor; each round settles one or more.
    while (row.minCoeff() < floor) {
      const double free = (row > floor).select(row, 0.0).sum();
      const double held = floor * static_cast<double>((row <= floor).count());
      if (!(free > 0) || held >= 1) {
        row = 1.0 / static_cast<double>(row.size());
        break;
      }
      row = (row > floor).select(row * ((1 - held) / free), floor);
    }
  }
  return emission;
}

// Emissions counted from uniform segments; states of other topologies start from the common
// histogram, stirred.
MatrixD initial_emission(const std::vector<SymbolSequence>& sequences,
                         const DiscreteHmmOptions& options) {
  const int n = options.topology.num_states;
  MatrixD counts = MatrixD::Constant(n, options.num_symbols, 1e-3);
  Random random(options.seed);
  for (const SymbolSequence& s : sequences) {
    const std::vector<int> states =
        detail::uniform_segmentation(static_cast<Eigen::Index>(s.size()), n);
    for (std::size_t t = 0; t < s.size(); ++t) {
      if (options.topology.kind == Topology::Kind::left_right) {
        counts(states[t], s[t]) += 1;
      } else {
        for (int j = 0; j < n; ++j) counts(j, s[t]) += random.uniform();
      }
    }
  }
  return floored(counts.array().colwise() / counts.rowwise().sum().array(), options.emission_floor);
}

detail::Rows<double> rows_by(Span<const std::int32_t> symbols, const detail::PaddedMatrix& table) {
  return {table.row(0), table.stride(), static_cast<std::ptrdiff_t>(symbols.size()),
          symbols.data()};
}

}  // namespace

const char* DiscreteHmmOptions::conflict() const {
  return emission_floor * num_symbols <= 1 ? nullptr
                                           : "emission_floor must not exceed 1 / num_symbols";
}

void validate_symbols(const std::vector<SymbolSequence>& sequences, int num_symbols,
                      const std::string& where) {
  require(!sequences.empty(), "training needs at least one sequence");
  for (std::size_t s = 0; s < sequences.size(); ++s) {
    if (sequences[s].empty())
      fail(ErrorKind::invalid_argument,
           where + "sequence " + std::to_string(s) + " has no symbols");
    for (std::size_t t = 0; t < sequences[s].size(); ++t) {
      if (sequences[s][t] >= 0 && sequences[s][t] < num_symbols) continue;
      fail(ErrorKind::invalid_argument, where + "sequence " + std::to_string(s) + ": symbol " +
                                            std::to_string(sequences[s][t]) + " at position " +
                                            std::to_string(t) + " lies outside 0.." +
                                            std::to_string(num_symbols - 1));
    }
  }
}

DiscreteHmm::DiscreteHmm(MarkovChain chain, MatrixD emission)
    : chain_(std::move(chain)), emission_(std::move(emission)) {
  const char* fault = emission_fault(num_states(), emission_);
  require(fault == nullptr, fault);
  const MatrixD by_symbol = emission_.transpose();
  by_symbol_ = detail::PaddedMatrix(by_symbol);
  log_by_symbol_ = detail::PaddedMatrix(detail::safe_log(by_symbol));
  double smallest = 1;
  for (Eigen::Index i = 0; i < emission_.size(); ++i) {
    if (emission_.data()[i] > 0) smallest = std::min(smallest, emission_.data()[i]);
  }
  smallest_step_ = smallest * chain_.smallest_probability();
}

void DiscreteHmm::validate_symbol(std::int32_t symbol, std::size_t position) const {
  if (symbol >= 0 && symbol < num_symbols()) return;
  fail(ErrorKind::invalid_argument, "symbol " + std::to_string(symbol) + " at position " +
                                        std::to_string(position) + " lies outside 0.." +
                                        std::to_string(num_symbols() - 1));
}

void DiscreteHmm::validate_all(Span<const std::int32_t> symbols) const {
  require(!symbols.empty(), "symbols must not be empty");
  const auto count = static_cast<std::uint32_t>(num_symbols());
  bool known = true;  // all in one go, as a word is scored fast; one by one to say which is not
  for (const std::int32_t symbol : symbols) known &= static_cast<std::uint32_t>(symbol) < count;
  for (std::size_t t = 0; !known && t < symbols.size(); ++t) validate_symbol(symbols[t], t);
}

DiscreteHmm DiscreteHmm::train(const std::vector<SymbolSequence>& sequences,
                               const DiscreteHmmOptions& options, TrainingReport* report) {
  check(options, options.num_symbols);
  validate_symbols(sequences, options.num_symbols);
  return DiscreteHmm(MarkovChain::initial(options.topology), initial_emission(sequences, options))
      .retrain(sequences, options, report);
}

DiscreteHmm DiscreteHmm::retrain(const std::vector<SymbolSequence>& sequences,
                                 const DiscreteHmmOptions& options, TrainingReport* report) const {
  check(options, num_symbols());
  validate_symbols(sequences, num_symbols());
  const int n = num_states();
  DiscreteHmm model = *this;
  double num_total = 0;
  for (const SymbolSequence& s : sequences) num_total += static_cast<double>(s.size());
  TrainingReport local;
  detail::PaddedMatrix gamma;
  for (int iteration = 0; iteration < options.max_iterations && !local.converged; ++iteration) {
    detail::ChainCounts counts(n);
    MatrixD by_symbol = MatrixD::Zero(num_symbols(), by_symbol_.stride());
    double total = 0;
    for (const SymbolSequence& s : sequences) {
      poll(options.should_stop);
      total += model.expect(s, &gamma, &counts);
      for (std::size_t t = 0; t < s.size(); ++t) {
        by_symbol.row(s[t]) += Eigen::Map<const Eigen::RowVectorXd>(
            gamma.row(static_cast<std::ptrdiff_t>(t)), by_symbol.cols());
      }
    }
    if (!local.log_likelihoods.empty()) {
      local.converged = (total - local.log_likelihoods.back()) / num_total < options.tolerance;
    }
    local.log_likelihoods.push_back(total);
    const MatrixD emitted = by_symbol.leftCols(n).transpose().array() + options.emission_prior;
    MatrixD emission = model.emission_;
    constexpr double kUnvisited = 1e-8;
    for (int j = 0; j < n; ++j) {
      if (emitted.row(j).sum() > kUnvisited)
        emission.row(j) = emitted.row(j) / emitted.row(j).sum();
    }
    detail::add_pseudo_counts(model.chain_, options.transition_prior, &counts);
    model = DiscreteHmm(
        options.train_transitions ? detail::estimate_chain(counts, model.chain_) : model.chain_,
        floored(emission, options.emission_floor));
  }
  if (report != nullptr) *report = std::move(local);
  return model;
}

void DiscreteHmm::begin(detail::ForwardPass* pass) const {
  pass->reset(chain_, detail::first_arithmetic(smallest_step_));
}

void DiscreteHmm::advance(detail::ForwardPass* pass, std::int32_t symbol) const {
  pass->step(chain_, by_symbol_.row(symbol), log_by_symbol_.row(symbol));
}

double DiscreteHmm::log_likelihood(Span<const std::int32_t> symbols) const {
  validate_all(symbols);
  thread_local detail::ForwardPass pass;
  begin(&pass);
  for (const std::int32_t symbol : symbols) advance(&pass, symbol);
  return pass.log_likelihood();
}

double DiscreteHmm::log_likelihood_exact(Span<const std::int32_t> symbols) const {
  validate_all(symbols);
  thread_local detail::ForwardPass pass;
  pass.reset(chain_, detail::ForwardPass::Arithmetic::logs);
  for (const std::int32_t symbol : symbols) pass.step(chain_, nullptr, log_by_symbol_.row(symbol));
  return pass.log_likelihood();
}

double DiscreteHmm::viterbi(Span<const std::int32_t> symbols, std::vector<int>* path) const {
  validate_all(symbols);
  return detail::viterbi(chain_, rows_by(symbols, log_by_symbol_), path);
}

MatrixD DiscreteHmm::posterior(Span<const std::int32_t> symbols) const {
  MatrixD result;
  require(std::isfinite(state_posteriors(symbols, &result)),
          "symbols are impossible under the model");
  return result;
}

double DiscreteHmm::state_posteriors(Span<const std::int32_t> symbols, MatrixD* posteriors) const {
  validate_all(symbols);
  thread_local detail::PaddedMatrix gamma;
  const double log_likelihood = expect(symbols, &gamma, nullptr);
  const auto num_frames = static_cast<Eigen::Index>(symbols.size());
  using Padded = Eigen::Map<const MatrixD, Eigen::Unaligned, Eigen::OuterStride<>>;
  *posteriors =
      Padded(gamma.row(0), num_frames, num_states(), Eigen::OuterStride<>(gamma.stride()));
  return log_likelihood;
}

ForwardBackward DiscreteHmm::forward_backward(Span<const std::int32_t> symbols) const {
  validate_all(symbols);
  return detail::both_ways(chain_, rows_by(symbols, log_by_symbol_));
}

double DiscreteHmm::expect(Span<const std::int32_t> symbols, detail::PaddedMatrix* gamma,
                           detail::ChainCounts* counts) const {
  gamma->resize(static_cast<std::ptrdiff_t>(symbols.size()), num_states());
  double score = 0;
  const bool scaled =
      detail::first_arithmetic(smallest_step_) == detail::ForwardPass::Arithmetic::scaled;
  if (scaled && detail::scaled_forward_backward(chain_, rows_by(symbols, by_symbol_), gamma, counts,
                                                &score)) {
    return score;
  }
  return detail::forward_backward(chain_, rows_by(symbols, log_by_symbol_), gamma->row(0),
                                  gamma->stride(), counts);
}

void DiscreteHmm::write(ModelFile& file, const std::string& prefix) const {
  chain_.write(file, prefix);
  file.set_matrix(prefix + "emission", emission_);
}

DiscreteHmm DiscreteHmm::read(const ModelFile& file, const std::string& prefix) {
  MarkovChain chain = MarkovChain::read(file, prefix);
  MatrixD emission = file.matrix_d(prefix + "emission");
  if (const char* fault = emission_fault(chain.num_states(), emission))
    fail(ErrorKind::format, file.name() + ": field '" + prefix + "emission': " + fault);
  return {std::move(chain), std::move(emission)};
}

}  // namespace hri
