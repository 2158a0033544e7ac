// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Training of WordRecognizer: frames of every sample and of its copies, models without each fold of
// speakers for the calibration, then the models that are kept.
#include <algorithm>
#include <utility>

#include "hri/core/error.hpp"
#include "hri/recognition/word/word_recognizer.hpp"
#include "recognition/word/non_words.hpp"
#include "recognition/word/word_frames.hpp"

namespace hri {
namespace {

constexpr int kMaxFolds = 4;
constexpr std::size_t kNonWordSources = 300;  // samples from which non-words are made, at most
constexpr int kDefaultRateHz = 16000;

int training_rate_hz(const std::vector<WordSample>& samples, int wanted_hz) {
  if (wanted_hz != 0) return wanted_hz;
  int rate = kDefaultRateHz;
  for (const WordSample& s : samples) rate = std::min(rate, s.sample_rate_hz);
  return rate;
}

std::vector<std::string> labels_of(const std::vector<WordSample>& samples) {
  std::vector<std::string> names;
  names.reserve(samples.size());
  for (const WordSample& s : samples) names.push_back(s.label);
  return sorted_labels(names);
}

}  // namespace

class WordTrainer {
 public:
  WordTrainer(const std::vector<WordSample>& samples, const WordRecognizerOptions& options,
              StopCheck should_stop)
      : result_(options, labels_of(samples)),
        frames_(result_),
        non_words_(options.cepstra.sample_rate_hz, options.models.seed),
        source_step_(1 + samples.size() / kNonWordSources),
        should_stop_(std::move(should_stop)) {}

  // Before `run`; words in which nobody is heard are left out.
  void learn_background(const std::vector<WordSample>& background) {
    if (background.empty() || result_.options_.models.model == SequenceModelKind::ptbhmm) return;
    std::vector<std::string> words;
    words.reserve(background.size());
    for (const WordSample& s : background) words.push_back(s.label);
    std::sort(words.begin(), words.end());
    words.erase(std::unique(words.begin(), words.end()), words.end());
    std::vector<std::vector<std::vector<MatrixF>>> per_stream(
        result_.streams_.size(), std::vector<std::vector<MatrixF>>(words.size()));
    for (std::size_t i = 0; i < background.size(); ++i) {
      poll(should_stop_);
      const std::vector<float> word =
          frames_.locate(background[i], "background word " + std::to_string(i));
      if (word.empty()) continue;
      const auto index = static_cast<std::size_t>(label_index(words, background[i].label));
      // Copies as those of the vocabulary, so that none of the two fits noise or a voice better.
      for (std::vector<MatrixF>& frames : frames_.of(word, i)) {
        for (std::size_t s = 0; s < frames.size(); ++s)
          per_stream[s][index].push_back(std::move(frames[s]));
      }
    }
    for (std::size_t s = 0; s < per_stream.size(); ++s) {
      auto& words_heard = per_stream[s];
      words_heard.erase(std::remove_if(words_heard.begin(), words_heard.end(),
                                       [](const auto& list) { return list.empty(); }),
                        words_heard.end());
      result_.streams_[s].models.train_background(words_heard, should_stop_);
    }
  }

  WordRecognizer run(const std::vector<WordSample>& samples, const TrainingProgress& progress) {
    for (std::size_t i = 0; i < samples.size(); ++i) prepare(samples[i], i);
    const int num_folds = assign_folds();
    const int num_steps = num_folds + 2;
    HeldOutFolds held_out;
    for (int fold = 0; fold < num_folds; ++fold) {
      if (progress) progress(fold + 1, num_steps);
      score_fold(fold, &held_out);
    }
    if (progress) progress(num_folds + 1, num_steps);
    train_without(-1);
    calibrate(std::move(held_out));
    if (progress) progress(num_steps, num_steps);
    return std::move(result_);
  }

 private:
  // What is kept of one sample: the frames of every stream, first as it is, then of each copy.
  struct Prepared {
    int label = 0;
    int fold = 0;
    std::string group;
    std::vector<std::vector<MatrixF>> variants;
    std::vector<std::pair<TrialKind, std::vector<MatrixF>>> non_words;  // frames of every stream
  };

  void prepare(const WordSample& sample, std::size_t index) {
    if (should_stop_ && should_stop_()) fail(ErrorKind::interrupted, "training interrupted");
    const std::vector<float> word = frames_.locate(sample, "sample " + std::to_string(index));
    if (word.empty())
      return;  // nobody speaks; a label without any word is refused in train_without
    Prepared p;
    p.label = label_index(result_.labels_, sample.label);
    p.group = sample.group;
    p.variants = frames_.of(word, index);
    if (index % source_step_ == 0) {
      add_non_words(non_words_.sounds(word), TrialKind::sound, &p);
      add_non_words(non_words_.speech(word, sample.label, sample.group), TrialKind::other_word, &p);
    }
    prepared_.push_back(std::move(p));
  }

  void add_non_words(const std::vector<std::vector<float>>& audio, TrialKind kind,
                     Prepared* p) const {
    for (const std::vector<float>& a : audio) {
      if (result_.streams_.front().cepstra.num_frames(a.size()) > 0)
        p->non_words.emplace_back(kind, result_.frames(a));
    }
  }

  int assign_folds() {
    std::vector<int> classes;
    std::vector<std::string> groups;
    for (const Prepared& p : prepared_) {
      classes.push_back(p.label);
      groups.push_back(p.group);
    }
    const std::vector<int> folds = held_out_folds(classes, groups, kMaxFolds);
    int num_folds = 0;
    for (std::size_t i = 0; i < folds.size(); ++i) {
      prepared_[i].fold = folds[i];
      num_folds = std::max(num_folds, folds[i] + 1);
    }
    return num_folds;
  }

  // Trains every stream on all folds but `left_out` (-1 leaves nothing out). False when a class
  // would be empty.
  bool train_without(int left_out) {
    for (std::size_t s = 0; s < result_.streams_.size(); ++s) {
      std::vector<std::vector<MatrixF>> per_label(result_.labels_.size());
      for (const Prepared& p : prepared_) {
        if (p.fold == left_out) continue;
        for (const auto& streams : p.variants)
          per_label[static_cast<std::size_t>(p.label)].push_back(streams[s]);
      }
      for (std::size_t c = 0; c < per_label.size(); ++c) {
        if (!per_label[c].empty()) continue;
        if (left_out >= 0) return false;
        fail(ErrorKind::invalid_argument,
             "label '" + result_.labels_[c] + "': no sample with speech in it");
      }
      result_.streams_[s].models.train(per_label, should_stop_);
    }
    return true;
  }

  // What the folds left: decisions, what each of them tells the verifier, and its other trials.
  struct HeldOutFolds {
    std::vector<HeldOut> decisions;
    std::vector<VectorD> features;
    std::vector<VerifierTrial> trials;
  };

  void score_fold(int fold, HeldOutFolds* held_out) {
    if (!train_without(fold)) return;  // without every class there is nothing to calibrate on
    for (const Prepared& p : prepared_) {
      if (p.fold != fold) continue;
      if (should_stop_ && should_stop_()) fail(ErrorKind::interrupted, "training interrupted");
      const std::vector<MatrixF>& frames = p.variants.front();
      const VectorF scores = result_.score(frames);
      Eigen::Index best = 0;
      scores.maxCoeff(&best);
      held_out->decisions.push_back({scores, p.label, 0});
      held_out->features.push_back(result_.features(frames, scores));
      if (best == p.label) held_out->trials.push_back({held_out->features.back(), TrialKind::word});
      if (scores.size() > 2) {
        held_out->trials.push_back(
            {result_.features(frames, scores, p.label), TrialKind::other_word});
      }
      for (const auto& [kind, heard] : p.non_words)
        held_out->trials.push_back({result_.features(heard, result_.score(heard)), kind});
    }
  }

  void calibrate(HeldOutFolds held_out) {
    result_.verifier_ =
        WordVerifier::fit(held_out.trials, result_.streams_.front().models.num_background() > 0);
    for (std::size_t i = 0; i < held_out.decisions.size(); ++i)
      held_out.decisions[i].score = result_.verifier_.verification_score(held_out.features[i]);
    result_.calibration_ = Calibration::fit(held_out.decisions, result_.options_.false_reject_rate);
  }

  WordRecognizer result_;
  WordFrames frames_;
  detail::NonWords non_words_;
  std::size_t source_step_;
  StopCheck should_stop_;
  std::vector<Prepared> prepared_;
};

WordRecognizer WordRecognizer::train(const std::vector<WordSample>& samples,
                                     const WordRecognizerOptions& options,
                                     const TrainingProgress& progress, const StopCheck& should_stop,
                                     const std::vector<WordSample>& background) {
  require(options.false_reject_rate >= 0 && options.false_reject_rate <= 0.5,
          "false_reject_rate must lie in 0..0.5");
  WordRecognizerOptions used = options;
  used.cepstra.sample_rate_hz = training_rate_hz(samples, options.cepstra.sample_rate_hz);
  WordTrainer trainer(samples, used, should_stop);
  trainer.learn_background(background);
  return trainer.run(samples, progress);
}

}  // namespace hri
