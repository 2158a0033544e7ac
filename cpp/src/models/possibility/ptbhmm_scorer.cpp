// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// SequenceScorer of possibility-theory HMMs over the symbols of a codebook.
#include <algorithm>
#include <cmath>
#include <utility>

#include "hri/core/error.hpp"
#include "hri/models/codebook/codebook.hpp"
#include "hri/models/hmm/few_samples.hpp"
#include "hri/models/possibility/possibilistic_hmm.hpp"
#include "models/possibility/possibility_chain.hpp"
#include "models/scorer_kinds.hpp"

namespace hri::detail {
namespace {

// Smallest emission, as a share of what every symbol would have if all were alike.
constexpr double kEmissionFloor = 0.1;

std::vector<SymbolSequence> quantise(const Codebook& codebook,
                                     const std::vector<MatrixF>& sequences) {
  std::vector<SymbolSequence> symbols;
  symbols.reserve(sequences.size());
  for (const MatrixF& m : sequences) symbols.push_back(codebook.quantise(m));
  return symbols;
}

// What possibilities are scaled by (eq. 5.14): the largest emission of every symbol, transition and
// start of all classes.
struct SetScale {
  VectorD emission;
  double transition = 0;
  double start = 0;
};

SetScale scale_of(const std::vector<DiscreteHmm>& models) {
  SetScale result;
  result.emission = VectorD::Zero(models.front().num_symbols());
  for (const DiscreteHmm& m : models)
    result.emission = result.emission.cwiseMax(m.emission().colwise().maxCoeff().transpose());
  const ChainScale chains(chains_of(models));
  result.transition = chains.transition;
  result.start = chains.start;
  return result;
}

// By how much a possibility falls that is scaled by `now` in place of `trained`.
double log_shift(double trained, double now) {
  return trained > 0 && now > 0 ? std::log(trained / now) : 0.0;
}

class PtbhmmScorer final : public SequenceScorer {
 public:
  // `trained`: the scale that thresholds were found with.
  PtbhmmScorer(int max_iterations, Codebook codebook, PossibilisticHmmSet models, SetScale trained)
      : max_iterations_(max_iterations),
        codebook_(std::move(codebook)),
        models_(std::move(models)),
        trained_(std::move(trained)) {
    const SetScale now = scale_of(models_.models());
    emission_shift_ = trained_.emission.binaryExpr(now.emission, &log_shift);
    transition_shift_ = log_shift(trained_.transition, now.transition);
    start_shift_ = log_shift(trained_.start, now.start);
  }

  [[nodiscard]] SequenceModelKind kind() const override { return SequenceModelKind::ptbhmm; }
  [[nodiscard]] int num_classes() const override { return models_.num_classes(); }
  [[nodiscard]] VectorF scores(ConstMatrixRefF frames) const override {
    return models_.log_possibilities(codebook_.quantise(frames)).cwiseMax(kImpossible);
  }
  // A log-possibility is already a ratio to the best explanation of every symbol (thesis eq. 5.14).
  // Classes that were added since training explain symbols better, so that the possibilities of all
  // others fall, while thresholds stay: the garbage model falls as far.
  [[nodiscard]] float garbage_score(ConstMatrixRefF frames) const override {
    if (!is_shifted()) return 0;
    const SymbolSequence symbols = codebook_.quantise(frames);
    double sum = start_shift_ + transition_shift_ * (static_cast<double>(symbols.size()) - 1);
    for (const std::int32_t symbol : symbols) sum += emission_shift_[symbol];
    return static_cast<float>(sum);
  }

  [[nodiscard]] std::shared_ptr<const SequenceScorer> extend(int index,
                                                             const std::vector<MatrixF>& sequences,
                                                             int num_recordings,
                                                             const StopCheck& should_stop) const {
    std::vector<DiscreteHmm> models = models_.models();
    models.insert(
        models.begin() + index,
        train_few(models, quantise(codebook_, sequences), kEmissionFloor / models_.num_symbols(),
                  {num_recordings, max_iterations_, should_stop}));
    return with_models(std::move(models));
  }
  [[nodiscard]] std::shared_ptr<const SequenceScorer> without_class(int index) const override {
    std::vector<DiscreteHmm> models = models_.models();
    models.erase(models.begin() + index);
    return with_models(std::move(models));
  }

  void write(ModelFile& file, const std::string& prefix) const override {
    codebook_.write(file, prefix + "codebook.");
    models_.write(file, prefix + "ptbhmm.");
    if (!is_shifted()) return;
    file.set_vector(prefix + "ptbhmm.trained_emission", trained_.emission);
    file.set_number(prefix + "ptbhmm.trained_transition", trained_.transition);
    file.set_number(prefix + "ptbhmm.trained_start", trained_.start);
  }

 private:
  [[nodiscard]] std::shared_ptr<const SequenceScorer> with_models(
      std::vector<DiscreteHmm> models) const {
    return std::make_shared<PtbhmmScorer>(max_iterations_, codebook_,
                                          PossibilisticHmmSet(std::move(models), models_.rule()),
                                          trained_);
  }

  [[nodiscard]] bool is_shifted() const {
    return start_shift_ != 0 || transition_shift_ != 0 || !emission_shift_.isZero(0);
  }

  int max_iterations_;
  Codebook codebook_;
  PossibilisticHmmSet models_;
  SetScale trained_;
  VectorD emission_shift_;  // in logs, of every symbol; 0 while the classes are those of training
  double transition_shift_ = 0;
  double start_shift_ = 0;
};

// That of `models` where the file has none: no class was added or removed.
SetScale read_scale(const ModelFile& file, const std::string& prefix,
                    const PossibilisticHmmSet& models) {
  SetScale result = scale_of(models.models());
  if (!file.has(prefix + "trained_emission")) return result;
  const auto is_share = [](double value) { return value >= 0 && value <= 1; };
  result.emission = file.vector_d(prefix + "trained_emission");
  result.transition = file.number(prefix + "trained_transition");
  result.start = file.number(prefix + "trained_start");
  if (result.emission.size() != models.num_symbols() ||
      !std::all_of(result.emission.begin(), result.emission.end(), is_share) ||
      !is_share(result.transition) || !is_share(result.start)) {
    fail(ErrorKind::format, file.name() + ": field '" + prefix +
                                "trained_emission' and those of transitions and starts must hold "
                                "numbers in 0..1, one a symbol");
  }
  return result;
}

}  // namespace

std::shared_ptr<const SequenceScorer> train_ptbhmm_scorer(const ClassSequences& sequences,
                                                          const SequenceModelOptions& options,
                                                          const StopCheck& should_stop) {
  CodebookOptions of_codebook;
  of_codebook.num_codewords = options.num_codewords;
  of_codebook.should_stop = should_stop;
  Codebook codebook = Codebook::train_lbg(stack_frames(sequences, kAllFrames), of_codebook);
  std::vector<std::vector<SymbolSequence>> symbols;
  symbols.reserve(sequences.size());
  for (const auto& list : sequences) symbols.push_back(quantise(codebook, list));
  PossibilisticHmmOptions of_models;
  of_models.topology = left_right(options.num_states);
  of_models.num_symbols = codebook.size();
  of_models.max_iterations = options.max_iterations;
  of_models.emission_floor = kEmissionFloor / of_models.num_symbols;
  of_models.seed = options.seed;
  of_models.should_stop = should_stop;
  PossibilisticHmmSet models = PossibilisticHmmSet::train(symbols, of_models);
  SetScale scale = scale_of(models.models());
  return std::make_shared<PtbhmmScorer>(options.max_iterations, std::move(codebook),
                                        std::move(models), std::move(scale));
}

std::shared_ptr<const SequenceScorer> read_ptbhmm_scorer(const ModelFile& file,
                                                         const std::string& prefix,
                                                         const SequenceModelOptions& options,
                                                         int num_classes, int dim) {
  Codebook codebook = Codebook::read(file, prefix + "codebook.");
  PossibilisticHmmSet models = PossibilisticHmmSet::read(file, prefix + "ptbhmm.");
  check_width(file, prefix + "codebook", codebook.dim(), dim);
  if (models.num_classes() != num_classes || models.num_symbols() != codebook.size())
    fail(ErrorKind::format, prefix + "ptbhmm: does not fit the labels or the codebook");
  SetScale trained = read_scale(file, prefix + "ptbhmm.", models);
  return std::make_shared<PtbhmmScorer>(options.max_iterations, std::move(codebook),
                                        std::move(models), std::move(trained));
}

std::shared_ptr<const SequenceScorer> extend_ptbhmm_scorer(const SequenceScorer& scorer, int index,
                                                           const std::vector<MatrixF>& sequences,
                                                           int num_recordings,
                                                           const StopCheck& should_stop) {
  return static_cast<const PtbhmmScorer&>(scorer).extend(index, sequences, num_recordings,
                                                         should_stop);
}

}  // namespace hri::detail
