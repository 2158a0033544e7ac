// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// SequenceScorer of Gaussian-mixture HMMs, with a garbage model of all classes and filler models.
#include <optional>
#include <utility>

#include "core/parallel_for.hpp"
#include "hri/core/error.hpp"
#include "hri/models/adaptation/linear_adaptation.hpp"
#include "hri/models/adaptation/map_adaptation.hpp"
#include "hri/models/hmm/few_samples.hpp"
#include "hri/models/hmm/gaussian_mixture.hpp"
#include "models/hmm/expectation.hpp"
#include "models/hmm/path_fit.hpp"
#include "models/scorer_kinds.hpp"

namespace hri::detail {
namespace {

constexpr int kSharedIterations = 2;  // the second holds back from what the first found
constexpr double kGarbageWideWeight = 0.01;
constexpr Eigen::Index kMostGarbageFrames = 540000;  // an hour and a half of speech
// The names of fillers in model files since format version 1.
constexpr const char* kNumFillers = "num_background";
constexpr const char* kFiller = "background";
constexpr std::int64_t kMaxFillers = 10000;

VectorF scores_of(const std::vector<GaussianMixtureHmm>& hmms, ConstMatrixRefF frames) {
  return log_likelihoods(hmms, frames).cwiseMax(kImpossible);
}

class HmmScorer final : public SequenceScorer {
 public:
  HmmScorer(int max_iterations, std::vector<GaussianMixtureHmm> hmms, GaussianMixture garbage,
            FillerModels fillers)
      : max_iterations_(max_iterations),
        hmms_(std::move(hmms)),
        garbage_(std::move(garbage)),
        fillers_(std::move(fillers)) {}

  [[nodiscard]] SequenceModelKind kind() const override { return SequenceModelKind::hmm; }
  [[nodiscard]] int num_classes() const override { return static_cast<int>(hmms_.size()); }
  [[nodiscard]] int num_fillers() const override { return static_cast<int>(fillers_.size()); }
  [[nodiscard]] VectorF scores(ConstMatrixRefF frames) const override {
    return scores_of(hmms_, frames);
  }
  [[nodiscard]] VectorF filler_scores(ConstMatrixRefF frames) const override {
    return scores_of(fillers_, frames);
  }
  [[nodiscard]] float garbage_score(ConstMatrixRefF frames) const override {
    return static_cast<float>(garbage_.log_likelihood(frames));
  }
  [[nodiscard]] bool has_paths() const override { return true; }
  [[nodiscard]] PathFit path_fit(ConstMatrixRefF frames, int index, int left_out) const override {
    return fit_path(hmms_, frames, static_cast<std::size_t>(index), left_out);
  }

  [[nodiscard]] std::shared_ptr<const SequenceScorer> adapt(
      const ClassSequences& sequences, const AdaptationOptions& options) const {
    require(sequences.size() == hmms_.size(), "sequences needs one list a class");
    std::vector<MatrixF> all;
    for (const auto& list : sequences) all.insert(all.end(), list.begin(), list.end());
    auto result = std::make_shared<HmmScorer>(max_iterations_, hmms_, garbage_, fillers_);
    if (all.empty()) return result;
    result->adapt_together(sequences, options);
    if (options.each_class) result->adapt_each(sequences, all, options);
    return result;
  }

  [[nodiscard]] std::shared_ptr<const SequenceScorer> extend(int index,
                                                             const std::vector<MatrixF>& sequences,
                                                             int num_recordings,
                                                             const StopCheck& should_stop) const {
    auto result = std::make_shared<HmmScorer>(max_iterations_, hmms_, garbage_, fillers_);
    result->hmms_.insert(
        result->hmms_.begin() + index,
        train_few(hmms_, sequences, {num_recordings, max_iterations_, should_stop}));
    return result;
  }
  [[nodiscard]] std::shared_ptr<const SequenceScorer> without_class(int index) const override {
    auto result = std::make_shared<HmmScorer>(max_iterations_, hmms_, garbage_, fillers_);
    result->hmms_.erase(result->hmms_.begin() + index);
    return result;
  }

  void write(ModelFile& file, const std::string& prefix) const override {
    for (std::size_t c = 0; c < hmms_.size(); ++c)
      hmms_[c].write(file, prefix + "hmm." + std::to_string(c) + ".");
    garbage_.write(file, prefix + "garbage.");
    file.set_integer(prefix + kNumFillers, num_fillers());
    for (std::size_t w = 0; w < fillers_.size(); ++w)
      fillers_[w].write(file, prefix + kFiller + "." + std::to_string(w) + ".");
  }

 private:
  // First what holds for all classes, observed or not: classes that were observed would otherwise
  // explain the voice or the noise better than the rest and win whatever is said.
  void adapt_together(const ClassSequences& sequences, const AdaptationOptions& options) {
    for (int i = 0; i < kSharedIterations; ++i) {
      const LinearAdaptation shared =
          estimate_linear_adaptation(hmms_, sequences, options.shared_frames, options.should_stop);
      for (auto* models : {&hmms_, &fillers_}) {
        for (GaussianMixtureHmm& hmm : *models)
          hmm = GaussianMixtureHmm(hmm.chain(), shared.apply(hmm.bank()));
      }
      garbage_ = GaussianMixture(shared.apply(garbage_.bank()));
    }
  }

  void adapt_each(const ClassSequences& sequences, const std::vector<MatrixF>& all,
                  const AdaptationOptions& options) {
    const MapAdaptationOptions of_classes{options.prior_frames, options.num_iterations,
                                          options.should_stop};
    // As many prior frames as all states of all classes have.
    MapAdaptationOptions of_garbage = of_classes;
    of_garbage.prior_frames *= static_cast<double>(hmms_.size()) * hmms_.front().num_states();
    for (std::size_t c = 0; c < sequences.size(); ++c)
      hmms_[c] = adapt_map(hmms_[c], sequences[c], of_classes);
    garbage_ = adapt_map(garbage_, all, of_garbage);
  }

  int max_iterations_;
  std::vector<GaussianMixtureHmm> hmms_;  // one a class
  GaussianMixture garbage_;
  FillerModels fillers_;
};

std::vector<GaussianMixtureHmm> read_hmms(const ModelFile& file, const std::string& prefix,
                                          std::int64_t count, int dim) {
  std::vector<GaussianMixtureHmm> hmms;
  for (std::int64_t c = 0; c < count; ++c) {
    const std::string name = prefix + "." + std::to_string(c) + ".";
    hmms.push_back(GaussianMixtureHmm::read(file, name));
    check_width(file, name, hmms.back().dim(), dim);
  }
  return hmms;
}

GaussianMixtureHmmOptions hmm_options(const SequenceModelOptions& options, const StopCheck& stop) {
  GaussianMixtureHmmOptions of_hmm;
  of_hmm.topology = left_right(options.num_states);
  of_hmm.num_mixtures = std::max(1, options.num_mixtures);
  of_hmm.max_iterations = options.max_iterations;
  of_hmm.seed = options.seed;
  of_hmm.should_stop = stop;
  return of_hmm;
}

GaussianMixtureOptions garbage_options(const SequenceModelOptions& options, const StopCheck& stop) {
  GaussianMixtureOptions of_garbage;
  of_garbage.num_mixtures = options.garbage_mixtures;
  of_garbage.wide_weight = kGarbageWideWeight;
  of_garbage.seed = options.seed;
  of_garbage.should_stop = stop;
  return of_garbage;
}

std::vector<GaussianMixtureHmm> all_of(std::vector<std::optional<GaussianMixtureHmm>> trained) {
  std::vector<GaussianMixtureHmm> result;
  result.reserve(trained.size());
  for (auto& hmm : trained) result.push_back(std::move(*hmm));
  return result;
}

}  // namespace

std::vector<GaussianMixtureHmm> train_hmms(const ClassSequences& sequences,
                                           const SequenceModelOptions& options,
                                           const StopCheck& should_stop) {
  std::vector<std::optional<GaussianMixtureHmm>> trained(sequences.size());
  parallel_for(sequences.size(), should_stop, [&](std::size_t c, const StopCheck& stop) {
    trained[c] = GaussianMixtureHmm::train(sequences[c], hmm_options(options, stop));
  });
  return all_of(std::move(trained));
}

std::shared_ptr<const SequenceScorer> train_hmm_scorer(const ClassSequences& sequences,
                                                       const SequenceModelOptions& options,
                                                       const StopCheck& should_stop,
                                                       const FillerModels& fillers) {
  std::vector<std::optional<GaussianMixtureHmm>> hmms(sequences.size());
  std::optional<GaussianMixture> garbage;
  // The model of all frames takes longest, and begins first.
  parallel_for(sequences.size() + 1, should_stop, [&](std::size_t i, const StopCheck& stop) {
    if (i == 0) {
      garbage = GaussianMixture::train(stack_frames(sequences, kMostGarbageFrames),
                                       garbage_options(options, stop));
    } else {
      hmms[i - 1] = GaussianMixtureHmm::train(sequences[i - 1], hmm_options(options, stop));
    }
  });
  return std::make_shared<HmmScorer>(options.max_iterations, all_of(std::move(hmms)),
                                     std::move(*garbage), fillers);
}

std::shared_ptr<const SequenceScorer> read_hmm_scorer(const ModelFile& file,
                                                      const std::string& prefix,
                                                      const SequenceModelOptions& options,
                                                      int num_classes, int dim) {
  std::vector<GaussianMixtureHmm> hmms = read_hmms(file, prefix + "hmm", num_classes, dim);
  const std::int64_t num_fillers = file.integer(prefix + kNumFillers);
  if (num_fillers < 0 || num_fillers > kMaxFillers) {
    fail(ErrorKind::format, file.name() + ": field '" + prefix + kNumFillers +
                                "': " + std::to_string(num_fillers) + " does not lie in 0.." +
                                std::to_string(kMaxFillers));
  }
  FillerModels fillers = read_hmms(file, prefix + kFiller, num_fillers, dim);
  GaussianMixture garbage = GaussianMixture::read(file, prefix + "garbage.");
  check_width(file, prefix + "garbage", garbage.dim(), dim);
  return std::make_shared<HmmScorer>(options.max_iterations, std::move(hmms), std::move(garbage),
                                     std::move(fillers));
}

std::shared_ptr<const SequenceScorer> adapt_hmm_scorer(const SequenceScorer& scorer,
                                                       const ClassSequences& sequences,
                                                       const AdaptationOptions& options) {
  return static_cast<const HmmScorer&>(scorer).adapt(sequences, options);
}

std::shared_ptr<const SequenceScorer> extend_hmm_scorer(const SequenceScorer& scorer, int index,
                                                        const std::vector<MatrixF>& sequences,
                                                        int num_recordings,
                                                        const StopCheck& should_stop) {
  return static_cast<const HmmScorer&>(scorer).extend(index, sequences, num_recordings,
                                                      should_stop);
}

}  // namespace hri::detail
