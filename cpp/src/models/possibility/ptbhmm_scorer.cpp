// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// SequenceScorer of possibility-theory HMMs over the symbols of a codebook.
#include <utility>

#include "hri/core/error.hpp"
#include "hri/models/codebook/codebook.hpp"
#include "hri/models/hmm/few_samples.hpp"
#include "hri/models/possibility/possibilistic_hmm.hpp"
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

class PtbhmmScorer final : public SequenceScorer {
 public:
  PtbhmmScorer(int max_iterations, Codebook codebook, PossibilisticHmmSet models)
      : max_iterations_(max_iterations),
        codebook_(std::move(codebook)),
        models_(std::move(models)) {}

  [[nodiscard]] SequenceModelKind kind() const override { return SequenceModelKind::ptbhmm; }
  [[nodiscard]] int num_classes() const override { return models_.num_classes(); }
  [[nodiscard]] VectorF scores(ConstMatrixRefF frames) const override {
    return models_.log_possibilities(codebook_.quantise(frames)).cwiseMax(kImpossible);
  }
  // A log-possibility is already a ratio to the best explanation of every symbol (thesis eq. 5.14).
  [[nodiscard]] float garbage_score(ConstMatrixRefF /*frames*/) const override { return 0; }

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
  }

 private:
  [[nodiscard]] std::shared_ptr<const SequenceScorer> with_models(
      std::vector<DiscreteHmm> models) const {
    return std::make_shared<PtbhmmScorer>(max_iterations_, codebook_,
                                          PossibilisticHmmSet(std::move(models), models_.rule()));
  }

  int max_iterations_;
  Codebook codebook_;
  PossibilisticHmmSet models_;
};

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
  return std::make_shared<PtbhmmScorer>(options.max_iterations, std::move(codebook),
                                        std::move(models));
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
  return std::make_shared<PtbhmmScorer>(options.max_iterations, std::move(codebook),
                                        std::move(models));
}

std::shared_ptr<const SequenceScorer> extend_ptbhmm_scorer(const SequenceScorer& scorer, int index,
                                                           const std::vector<MatrixF>& sequences,
                                                           int num_recordings,
                                                           const StopCheck& should_stop) {
  return static_cast<const PtbhmmScorer&>(scorer).extend(index, sequences, num_recordings,
                                                         should_stop);
}

}  // namespace hri::detail
