// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/htk/embedded_trainer.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hri/core/error.hpp"
#include "hri/io/model_file.hpp"
#include "htk/composite_pass.hpp"
#include "htk/embedded_sums.hpp"
#include "htk/shared_parameters.hpp"

namespace hri::htk {
namespace {

constexpr double kWeightUnit = 1e-5;
constexpr double kLeastVariance = 1e-10;   // of a column that is constant
constexpr double kLeastPosterior = 1e-15;  // less is lost in rounding
constexpr std::int64_t kNotComputed = -1;
constexpr double kMostExamples = 1e15;
constexpr const char* kKindOfSums = "htk_embedded_sums";

std::size_t place(int number) { return static_cast<std::size_t>(number); }

}  // namespace

class EmbeddedTrainer::Sums {
 public:
  Sums(const ModelSet& models, const EmbeddedTrainerOptions& options)
      : options_(validated(options)),
        models_(models),
        parameters_(models),
        floor_(detail::variance_floor(models, std::max(options.min_variance, kLeastVariance))),
        densities_(parameters_),
        sums_(parameters_) {
    require(!parameters_.hmms.empty(), "there is no model to train");
    const auto fits = [&](const VectorD& v) { return v.size() == models.vector_size; };
    require(std::all_of(parameters_.means.begin(), parameters_.means.end(), fits) &&
                std::all_of(parameters_.variances.begin(), parameters_.variances.end(), fits),
            "the vectors of the models have different sizes");
    for (const MatrixD& matrix : parameters_.transitions) chains_.emplace_back(matrix);
    for (const detail::SharedHmm& hmm : parameters_.hmms) {
      const detail::LogChain& chain = chains_[place(hmm.transitions)];
      require(place(chain.num_states()) == hmm.states.size(),
              "a model has another number of states than of transitions");
      if (chain.min_frames == detail::LogChain::kNoWay)
        fail(ErrorKind::invalid_argument, "no path leads through the model '" + hmm.name + "'");
    }
    num_examples_.resize(parameters_.hmms.size());
    scores_.resize(parameters_.states.size());
    computed_.resize(parameters_.states.size());
    frame_.resize(models.vector_size);
  }

  EmbeddedOutcome add(ConstMatrixRefF frames, const std::vector<std::string>& units) {
    require(!units.empty(), "the transcript of an utterance is empty");
    require(frames.cols() == models_.vector_size,
            "the frames have another number of columns than the models");
    parameters_.require_frames(frames, "the utterance");
    if (begin(units) > frames.rows() || frames.rows() == 0) return EmbeddedOutcome::too_short;
    const double log_likelihood = backward(frames);
    if (!std::isfinite(log_likelihood)) return EmbeddedOutcome::impossible;
    forward(frames);
    for (const int hmm : hmms_) ++num_examples_[place(hmm)];
    log_likelihood_ += log_likelihood;
    num_frames_ += frames.rows();
    return EmbeddedOutcome::added;
  }

  [[nodiscard]] ModelSet estimate() const {
    detail::SharedParameters made = parameters_;
    std::vector<bool> states(made.states.size(), false);
    std::vector<bool> matrices(made.transitions.size(), false);
    for (std::size_t h = 0; h < made.hmms.size(); ++h) {
      if (num_examples_[h] < options_.min_examples) continue;
      for (const int state : made.hmms[h].states) states[place(state)] = true;
      matrices[place(made.hmms[h].transitions)] = true;
    }
    if (options_.update_weights)
      sums_.estimate_weights(states, options_.weight_floor * kWeightUnit, &made);
    if (options_.update_means) sums_.estimate_means(states, &made);
    if (options_.update_variances) sums_.estimate_variances(states, floor_, &made);
    for (std::size_t m = 0; options_.update_transitions && m < matrices.size(); ++m) {
      if (!matrices[m]) continue;
      for (Eigen::Index i = 0; i + 1 < made.transitions[m].rows(); ++i) {
        const double sum = sums_.transitions[m].row(i).sum();
        if (sum > 0) made.transitions[m].row(i) = sums_.transitions[m].row(i) / sum;
      }
    }
    return made.applied_to(models_);
  }

  void write_sums(const std::string& path) const {
    ModelFile file;
    file.set_kind(kKindOfSums);
    file.set_text("models", fingerprint());
    file.set_number("log_likelihood", log_likelihood_);
    file.set_integer("num_frames", num_frames_);
    VectorD examples(static_cast<Eigen::Index>(num_examples_.size()));
    for (std::size_t h = 0; h < num_examples_.size(); ++h)
      examples[static_cast<Eigen::Index>(h)] = static_cast<double>(num_examples_[h]);
    file.set_vector("examples", examples);
    sums_.write(&file);
    file.write(path);
  }

  void add_sums(const std::string& path) {
    const ModelFile file = ModelFile::read(path);
    const auto refuse = [&path](const std::string& why) {
      fail(ErrorKind::format, path + ": " + why);
    };
    if (file.kind() != kKindOfSums) refuse("kind: no sums of embedded training");
    if (file.text("models") != fingerprint()) refuse("models: sums of other models");
    const double log_likelihood = file.number("log_likelihood");
    const std::int64_t num_frames = file.integer("num_frames");
    const VectorD examples = file.vector_d("examples");
    if (num_frames < 0) refuse("num_frames: is below 0");
    if (examples.size() != static_cast<Eigen::Index>(num_examples_.size()))
      refuse("examples: not as many as the models");
    for (const double count : examples) {
      if (count < 0 || count > kMostExamples || count != std::floor(count))
        refuse("examples: one is no whole number");
    }
    detail::SharedSums sums = sums_;
    sums.add(file);
    file.require_all_read();
    sums_ = std::move(sums);
    for (std::size_t h = 0; h < num_examples_.size(); ++h)
      num_examples_[h] += static_cast<std::int64_t>(examples[static_cast<Eigen::Index>(h)]);
    log_likelihood_ += log_likelihood;
    num_frames_ += num_frames;
  }

  [[nodiscard]] std::vector<ModelOccupation> occupations() const {
    std::vector<ModelOccupation> all;
    for (std::size_t h = 0; h < parameters_.hmms.size(); ++h) {
      ModelOccupation one{parameters_.hmms[h].name, num_examples_[h], {}};
      for (const int state : parameters_.hmms[h].states)
        one.states.push_back(sums_.occupation(state));
      all.push_back(std::move(one));
    }
    return all;
  }

  [[nodiscard]] double log_likelihood() const { return log_likelihood_; }
  [[nodiscard]] std::int64_t num_frames() const { return num_frames_; }

 private:
  // Of the models, before estimation: FNV-1a of their text.
  [[nodiscard]] std::string fingerprint() const {
    std::uint64_t hash = 0xcbf29ce484222325U;
    for (const char c : models_.to_text()) {
      hash ^= static_cast<unsigned char>(c);
      hash *= 0x100000001b3U;
    }
    std::string digits;
    for (int nibble = 15; nibble >= 0; --nibble)
      digits += "0123456789abcdef"[(hash >> (4U * static_cast<unsigned>(nibble))) & 0xfU];
    return digits;
  }

  // Gives the least number of frames.
  std::int64_t begin(const std::vector<std::string>& units) {
    hmms_.clear();
    states_.clear();
    std::vector<const detail::LogChain*> chains;
    for (const std::string& unit : units) {
      const int number = parameters_.find(unit);
      if (number < 0) fail(ErrorKind::invalid_argument, "there is no model '" + unit + "'");
      const detail::SharedHmm& hmm = parameters_.hmms[place(number)];
      hmms_.push_back(number);
      states_.insert(states_.end(), hmm.states.begin(), hmm.states.end());
      chains.push_back(&chains_[place(hmm.transitions)]);
    }
    return pass_.begin(chains);
  }

  double backward(ConstMatrixRefF frames) {
    std::fill(computed_.begin(), computed_.end(), kNotComputed);
    const auto densities = [&](std::int64_t t, int first, int end, double* out) {
      frame_ = frames.row(t).transpose().cast<double>();
      for (int s = first; s < end; ++s) {
        // A state that occurs several times is computed once.
        const std::size_t state = place(states_[place(s)]);
        if (computed_[state] != t) scores_[state] = densities_.state(states_[place(s)], frame_);
        computed_[state] = t;
        out[s - first] = scores_[state];
      }
    };
    double beam = options_.beam;
    double found = pass_.backward(frames.rows(), beam, densities);
    while (!std::isfinite(found) && beam > 0 && options_.beam_step > 0 &&
           beam + options_.beam_step <= options_.beam_limit) {
      beam += options_.beam_step;
      found = pass_.backward(frames.rows(), beam, densities);
    }
    return found;
  }

  void forward(ConstMatrixRefF frames) {
    std::vector<MatrixD*> counts;
    counts.reserve(hmms_.size());
    for (const int hmm : hmms_)
      counts.push_back(&sums_.transitions[place(parameters_.hmms[place(hmm)].transitions)]);
    pass_.forward(counts, [&](std::int64_t t, int first, int end, const double* gamma) {
      frame_ = frames.row(t).transpose().cast<double>();
      for (int s = first; s < end; ++s) {
        if (gamma[s - first] < kLeastPosterior) continue;
        const int state = states_[place(s)];
        const double score = densities_.state(state, frame_);
        for (std::size_t c = 0; c < densities_.components().size(); ++c) {
          const double share = gamma[s - first] * std::exp(densities_.components()[c] - score);
          if (share >= kLeastPosterior)
            sums_.add(state, densities_.first_slot() + c, frame_, share);
        }
      }
    });
  }

  EmbeddedTrainerOptions options_;
  ModelSet models_;
  detail::SharedParameters parameters_;
  VectorD floor_;
  detail::SharedDensities densities_;
  detail::SharedSums sums_;
  std::vector<detail::LogChain> chains_;  // by the place of the transitions
  std::vector<std::int64_t> num_examples_;
  double log_likelihood_ = 0;
  std::int64_t num_frames_ = 0;
  // Of the utterance at hand.
  detail::CompositePass pass_;
  std::vector<int> hmms_;
  std::vector<int> states_;  // shared ones, by state of the composite
  std::vector<double> scores_;
  std::vector<std::int64_t> computed_;  // the frame that the score belongs to
  VectorD frame_;
};

EmbeddedTrainer::EmbeddedTrainer(const ModelSet& models, const EmbeddedTrainerOptions& options)
    : sums_(std::make_unique<Sums>(models, options)) {}
EmbeddedTrainer::~EmbeddedTrainer() = default;
EmbeddedTrainer::EmbeddedTrainer(EmbeddedTrainer&&) noexcept = default;
EmbeddedTrainer& EmbeddedTrainer::operator=(EmbeddedTrainer&&) noexcept = default;

EmbeddedOutcome EmbeddedTrainer::add(ConstMatrixRefF frames,
                                     const std::vector<std::string>& units) {
  return sums_->add(frames, units);
}

void EmbeddedTrainer::write_sums(const std::string& path) const { sums_->write_sums(path); }
void EmbeddedTrainer::add_sums(const std::string& path) { sums_->add_sums(path); }
ModelSet EmbeddedTrainer::estimate() const { return sums_->estimate(); }
double EmbeddedTrainer::log_likelihood() const { return sums_->log_likelihood(); }
std::int64_t EmbeddedTrainer::num_frames() const { return sums_->num_frames(); }
std::vector<ModelOccupation> EmbeddedTrainer::occupations() const { return sums_->occupations(); }

}  // namespace hri::htk
