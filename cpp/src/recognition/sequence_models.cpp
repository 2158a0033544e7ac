// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/recognition/sequence_models.hpp"

#include <utility>

#include "hri/core/error.hpp"
#include "hri/models/hmm/few_samples.hpp"

namespace hri {
namespace {

// Smallest emission, as a share of what every symbol would have if all were alike.
constexpr double kEmissionFloor = 0.1;
constexpr int kSharedIterations = 2;
constexpr const char* kNumBackground = "num_background";
constexpr std::int64_t kMaxBackground = 10000;
constexpr float kImpossible = -1e30F;  // stands for log 0, so that differences stay finite

MatrixF stacked(const std::vector<std::vector<MatrixF>>& per_label) {
  Eigen::Index rows = 0;
  for (const auto& list : per_label) {
    for (const MatrixF& m : list) rows += m.rows();
  }
  MatrixF all(rows, per_label.front().front().cols());
  Eigen::Index at = 0;
  for (const auto& list : per_label) {
    for (const MatrixF& m : list) {
      all.middleRows(at, m.rows()) = m;
      at += m.rows();
    }
  }
  return all;
}

Topology left_right(int num_states) {
  Topology topology;
  topology.kind = Topology::Kind::left_right;
  topology.num_states = num_states;
  return topology;
}

}  // namespace

SequenceModels::SequenceModels(const SequenceModelOptions& options) : options_(options) {
  require(options.num_states >= 1 && options.num_states <= 64, "num_states must lie in 1..64");
  require(options.num_mixtures >= 1 && options.num_mixtures <= 64,
          "num_mixtures must lie in 1..64");
  require(options.num_codewords >= 2 && options.num_codewords <= 4096,
          "num_codewords must lie in 2..4096");
  require(options.garbage_mixtures >= 1 && options.garbage_mixtures <= 256,
          "garbage_mixtures must lie in 1..256");
  require(options.max_iterations >= 1 && options.max_iterations <= 1000,
          "max_iterations must lie in 1..1000");
}

void SequenceModels::train(const std::vector<std::vector<MatrixF>>& per_label,
                           const StopCheck& should_stop) {
  if (options_.model == SequenceModelKind::ptbhmm) {
    train_ptbhmm(per_label, should_stop);
  } else {
    train_hmms(per_label, should_stop);
  }
}

std::vector<GaussianMixtureHmm> SequenceModels::hmms_of(
    const std::vector<std::vector<MatrixF>>& per_label, const StopCheck& should_stop) const {
  GaussianMixtureHmmOptions options;
  options.topology = left_right(options_.num_states);
  options.num_mixtures = options_.num_mixtures;
  options.max_iterations = options_.max_iterations;
  options.seed = options_.seed;
  options.should_stop = should_stop;
  std::vector<GaussianMixtureHmm> result;
  result.reserve(per_label.size());
  for (const auto& sequences : per_label)
    result.push_back(GaussianMixtureHmm::train(sequences, options));
  return result;
}

void SequenceModels::train_hmms(const std::vector<std::vector<MatrixF>>& per_label,
                                const StopCheck& should_stop) {
  hmms_ = hmms_of(per_label, should_stop);
  GaussianMixtureOptions garbage;
  garbage.num_mixtures = options_.garbage_mixtures;
  garbage.wide_weight = 0.01;
  garbage.seed = options_.seed;
  garbage.should_stop = should_stop;
  garbage_ = {GaussianMixture::train(stacked(per_label), garbage)};
}

void SequenceModels::train_background(const std::vector<std::vector<MatrixF>>& per_word,
                                      const StopCheck& should_stop) {
  require(options_.model == SequenceModelKind::hmm,
          "only models of the kind hmm are compared with background words, these are ptbhmm");
  background_ = hmms_of(per_word, should_stop);
}

void SequenceModels::train_ptbhmm(const std::vector<std::vector<MatrixF>>& per_label,
                                  const StopCheck& should_stop) {
  CodebookOptions book;
  book.num_codewords = options_.num_codewords;
  book.should_stop = should_stop;
  codebook_ = {Codebook::train_lbg(stacked(per_label), book)};
  std::vector<std::vector<SymbolSequence>> symbols;
  symbols.reserve(per_label.size());
  for (const auto& sequences : per_label) symbols.push_back(quantised(sequences));
  PossibilisticHmmOptions options;
  options.topology = left_right(options_.num_states);
  options.num_symbols = codebook_.front().size();
  options.max_iterations = options_.max_iterations;
  options.emission_floor = kEmissionFloor / options.num_symbols;
  options.seed = options_.seed;
  options.should_stop = should_stop;
  ptbhmm_ = {PossibilisticHmmSet::train(symbols, options)};
}

SequenceModels SequenceModels::adapted(const std::vector<std::vector<MatrixF>>& per_label,
                                       const AdaptationOptions& options) const {
  require(options_.model == SequenceModelKind::hmm,
          "only models of the kind hmm adapt, these are ptbhmm");
  require(per_label.size() == hmms_.size(), "per_label needs one list a class");
  SequenceModels result = *this;
  std::vector<MatrixF> all;
  for (const auto& sequences : per_label) all.insert(all.end(), sequences.begin(), sequences.end());
  if (all.empty()) return result;
  // First what holds for all words, heard or not: words that were heard would otherwise explain the
  // voice or the noise better than the rest and win whatever is said.
  for (int i = 0; i < kSharedIterations; ++i) {
    const LinearAdaptation shared = estimate_linear_adaptation(
        result.hmms_, per_label, options.shared_frames, options.should_stop);
    for (auto* models : {&result.hmms_, &result.background_}) {
      for (GaussianMixtureHmm& hmm : *models)
        hmm = GaussianMixtureHmm(hmm.chain(), shared.apply(hmm.bank()));
    }
    result.garbage_.front() = GaussianMixture(shared.apply(result.garbage_.front().bank()));
  }
  if (!options.each_word) return result;
  const MapAdaptationOptions of_words{options.prior_frames, options.num_iterations,
                                      options.should_stop};
  for (std::size_t c = 0; c < per_label.size(); ++c)
    result.hmms_[c] = adapt_map(result.hmms_[c], per_label[c], of_words);
  // As many imagined frames as all states of all words have.
  MapAdaptationOptions of_garbage = of_words;
  of_garbage.prior_frames *= static_cast<double>(hmms_.size()) * hmms_.front().num_states();
  result.garbage_.front() = adapt_map(result.garbage_.front(), all, of_garbage);
  return result;
}

std::vector<SymbolSequence> SequenceModels::quantised(const std::vector<MatrixF>& sequences) const {
  std::vector<SymbolSequence> symbols;
  symbols.reserve(sequences.size());
  for (const MatrixF& m : sequences) symbols.push_back(codebook_.front().quantise(m));
  return symbols;
}

SequenceModels SequenceModels::with_class(int index, const std::vector<MatrixF>& sequences,
                                          int num_recordings, const StopCheck& should_stop) const {
  const FewSampleOptions options{num_recordings, options_.max_iterations, should_stop};
  SequenceModels result = *this;
  if (options_.model == SequenceModelKind::ptbhmm) {
    const PossibilisticHmmSet& set = ptbhmm_.front();
    std::vector<DiscreteHmm> models = set.models();
    models.insert(models.begin() + index, train_few(models, quantised(sequences),
                                                    kEmissionFloor / set.num_symbols(), options));
    result.ptbhmm_ = {PossibilisticHmmSet(std::move(models), set.rule())};
  } else {
    result.hmms_.insert(result.hmms_.begin() + index, train_few(hmms_, sequences, options));
  }
  return result;
}

SequenceModels SequenceModels::without_class(int index) const {
  SequenceModels result = *this;
  if (options_.model == SequenceModelKind::ptbhmm) {
    std::vector<DiscreteHmm> models = ptbhmm_.front().models();
    models.erase(models.begin() + index);
    result.ptbhmm_ = {PossibilisticHmmSet(std::move(models), ptbhmm_.front().rule())};
  } else {
    result.hmms_.erase(result.hmms_.begin() + index);
  }
  return result;
}

VectorF SequenceModels::scores(ConstMatrixRefF frames) const {
  if (options_.model == SequenceModelKind::ptbhmm) {
    return ptbhmm_.front()
        .log_possibilities(codebook_.front().quantise(frames))
        .cwiseMax(kImpossible);
  }
  VectorF result(static_cast<Eigen::Index>(hmms_.size()));
  for (std::size_t c = 0; c < hmms_.size(); ++c) {
    result[static_cast<Eigen::Index>(c)] = static_cast<float>(hmms_[c].log_likelihood(frames));
  }
  return result.cwiseMax(kImpossible);
}

VectorF SequenceModels::background_scores(ConstMatrixRefF frames) const {
  VectorF result(static_cast<Eigen::Index>(background_.size()));
  for (std::size_t w = 0; w < background_.size(); ++w)
    result[static_cast<Eigen::Index>(w)] =
        static_cast<float>(background_[w].log_likelihood(frames));
  return result.cwiseMax(kImpossible);
}

float SequenceModels::garbage_score(ConstMatrixRefF frames) const {
  // A log-possibility is already a ratio to the best explanation of every symbol (thesis eq. 5.14).
  if (options_.model == SequenceModelKind::ptbhmm) return 0;
  return static_cast<float>(garbage_.front().log_likelihood(frames));
}

void SequenceModels::write(ModelFile& file, const std::string& prefix) const {
  if (options_.model == SequenceModelKind::ptbhmm) {
    codebook_.front().write(file, prefix + "codebook.");
    ptbhmm_.front().write(file, prefix + "ptbhmm.");
    return;
  }
  for (std::size_t c = 0; c < hmms_.size(); ++c)
    hmms_[c].write(file, prefix + "hmm." + std::to_string(c) + ".");
  garbage_.front().write(file, prefix + "garbage.");
  file.set_integer(prefix + kNumBackground, num_background());
  for (std::size_t w = 0; w < background_.size(); ++w)
    background_[w].write(file, prefix + "background." + std::to_string(w) + ".");
}

void SequenceModels::read(const ModelFile& file, const std::string& prefix, int num_classes,
                          int dim) {
  const auto check_width = [&](Eigen::Index width, const std::string& what) {
    if (width != dim) {
      fail(ErrorKind::format, file.name() + ": field '" + what + "': has " + std::to_string(width) +
                                  " features, the front end gives " + std::to_string(dim));
    }
  };
  if (options_.model == SequenceModelKind::ptbhmm) {
    codebook_ = {Codebook::read(file, prefix + "codebook.")};
    ptbhmm_ = {PossibilisticHmmSet::read(file, prefix + "ptbhmm.")};
    check_width(codebook_.front().dim(), prefix + "codebook");
    if (ptbhmm_.front().num_classes() != num_classes ||
        ptbhmm_.front().num_symbols() != codebook_.front().size()) {
      fail(ErrorKind::format, prefix + "ptbhmm: does not fit the labels or the codebook");
    }
    return;
  }
  const auto read_hmms = [&](std::int64_t count, const std::string& what) {
    std::vector<GaussianMixtureHmm> hmms;
    for (std::int64_t c = 0; c < count; ++c) {
      const std::string name = prefix + what + "." + std::to_string(c) + ".";
      hmms.push_back(GaussianMixtureHmm::read(file, name));
      check_width(hmms.back().dim(), name);
    }
    return hmms;
  };
  hmms_ = read_hmms(num_classes, "hmm");
  const std::int64_t num_background = file.integer(prefix + kNumBackground);
  if (num_background < 0 || num_background > kMaxBackground) {
    fail(ErrorKind::format, file.name() + ": field '" + prefix + kNumBackground +
                                "': " + std::to_string(num_background) + " does not lie in 0.." +
                                std::to_string(kMaxBackground));
  }
  background_ = read_hmms(num_background, "background");
  garbage_ = {GaussianMixture::read(file, prefix + "garbage.")};
  check_width(garbage_.front().dim(), prefix + "garbage");
}

}  // namespace hri
