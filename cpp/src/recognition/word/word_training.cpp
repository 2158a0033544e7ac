// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Training of WordRecognizer: features of every sample and of its augmented copies, models without
// each fold of speakers for verifier and calibration, then the models that are kept.
#include <algorithm>
#include <iterator>
#include <utility>

#include "core/parallel_for.hpp"
#include "hri/core/error.hpp"
#include "hri/recognition/word/word_recognizer.hpp"
#include "recognition/word/non_words.hpp"
#include "recognition/word/word_augmentation.hpp"

namespace hri {
namespace {

constexpr int kMaxFolds = 4;
constexpr std::size_t kNonWordSources = 300;  // samples from which non-words are made, at most
constexpr int kDefaultRateHz = 16000;
constexpr int kNoFold = -1;

int training_rate_hz(const std::vector<WordSample>& samples, int wanted_hz) {
  if (wanted_hz != 0) return wanted_hz;
  int rate = kDefaultRateHz;
  for (const WordSample& s : samples) rate = std::min(rate, s.sample_rate_hz);
  return rate;
}

std::vector<std::string> words_of(const std::vector<WordSample>& samples) {
  std::vector<std::string> words;
  words.reserve(samples.size());
  for (const WordSample& s : samples) words.push_back(s.label);
  return words;
}

// A sound that the verifier learns to reject.
struct NonWord {
  VerifierExample::Kind kind;
  StreamFrames frames;
};

// The features of one sample.
struct PreparedSample {
  int label = 0;
  int fold = 0;
  std::string group;
  std::vector<StreamFrames> copies;  // the sample itself first
  std::vector<NonWord> non_words;
};

// Decisions on held-out folds, and what the verifier learns from them.
struct HeldOutFolds {
  std::vector<HeldOut> decisions;
  std::vector<VectorD> features;  // of each decision
  std::vector<VerifierExample> examples;

  void append(HeldOutFolds more) {
    std::move(more.decisions.begin(), more.decisions.end(), std::back_inserter(decisions));
    std::move(more.features.begin(), more.features.end(), std::back_inserter(features));
    std::move(more.examples.begin(), more.examples.end(), std::back_inserter(examples));
  }
};

class WordTrainer {
 public:
  WordTrainer(const std::vector<WordSample>& samples, const WordRecognizerOptions& options,
              StopCheck should_stop)
      : options_(options),
        labels_(sorted_labels(words_of(samples))),
        augmentation_(options),
        non_words_(options.cepstra.sample_rate_hz, options.seed),
        source_step_(1 + samples.size() / kNonWordSources),
        should_stop_(std::move(should_stop)) {}

  WordRecognizer run(const std::vector<WordSample>& samples, const std::vector<WordSample>& fillers,
                     const TrainingProgress& progress) {
    train_fillers(fillers);
    prepare(samples);
    const int num_folds = assign_folds();
    const int num_steps = num_folds + 2;
    int step = 0;
    const auto report = [&] {
      if (progress) progress(++step, num_steps);
    };
    HeldOutFolds held_out;
    for (int fold = 0; fold < num_folds; ++fold) {
      report();
      score_fold(fold, &held_out);
    }
    report();
    WordRecognizer result = assemble(train_without(kNoFold), std::move(held_out));
    report();
    return result;
  }

 private:
  // Words without speech are left out.
  void train_fillers(const std::vector<WordSample>& fillers) {
    if (fillers.empty() || options_.model == SequenceModelKind::ptbhmm) return;
    std::vector<std::string> words = words_of(fillers);
    std::sort(words.begin(), words.end());
    words.erase(std::unique(words.begin(), words.end()), words.end());
    std::vector<std::vector<StreamFrames>> of_samples(fillers.size());
    detail::parallel_for(fillers.size(), should_stop_, [&](std::size_t i, const StopCheck&) {
      const std::vector<float> word =
          augmentation_.trim(fillers[i], detail::sample_name(fillers[i], "fillers", i));
      // Augmented as the vocabulary is, so that neither of the two fits noise or a voice better.
      if (!word.empty()) of_samples[i] = augmentation_.copies(word, i);
    });
    std::vector<std::vector<StreamFrames>> copies(words.size());
    for (std::size_t i = 0; i < fillers.size(); ++i) {
      auto& list = copies[static_cast<std::size_t>(label_index(words, fillers[i].label))];
      for (StreamFrames& copy : of_samples[i]) list.push_back(std::move(copy));
    }
    ClassStreams sequences;
    for (const auto& list : copies) {
      if (list.empty()) continue;
      sequences.emplace_back();
      for (const StreamFrames& copy : list) sequences.back().push_back(&copy);
    }
    fillers_ = hri::train_fillers(sequences, augmentation_.front_end().num_streams(), options_,
                                  should_stop_);
  }

  // Samples without speech are left out; train_without() refuses a label that has no other.
  void prepare(const std::vector<WordSample>& samples) {
    std::vector<std::vector<float>> words(samples.size());
    std::vector<PreparedSample> made(samples.size());
    detail::parallel_for(samples.size(), should_stop_, [&](std::size_t i, const StopCheck&) {
      words[i] = augmentation_.trim(samples[i], detail::sample_name(samples[i], "samples", i));
      if (words[i].empty()) return;
      made[i].label = label_index(labels_, samples[i].label);
      made[i].group = samples[i].group;
      made[i].copies = augmentation_.copies(words[i], i);
    });
    add_non_words(samples, words, &made);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      if (!words[i].empty()) prepared_.push_back(std::move(made[i]));
    }
  }

  // Each non-word depends on the words before it, so that only their features are independent.
  void add_non_words(const std::vector<WordSample>& samples,
                     const std::vector<std::vector<float>>& words,
                     std::vector<PreparedSample>* made) {
    using Kind = VerifierExample::Kind;
    struct Sounds {
      std::size_t source;
      std::vector<std::vector<float>> noises, speech;
    };
    std::vector<Sounds> all;
    for (std::size_t i = 0; i < samples.size(); i += source_step_) {
      poll(should_stop_);
      if (words[i].empty()) continue;
      std::vector<std::vector<float>> noises = non_words_.sounds(words[i]);
      all.push_back(
          {i, std::move(noises), non_words_.speech(words[i], samples[i].label, samples[i].group)});
    }
    detail::parallel_for(all.size(), should_stop_, [&](std::size_t k, const StopCheck&) {
      std::vector<NonWord>& to = (*made)[all[k].source].non_words;
      append_frames(all[k].noises, Kind::sound, &to);
      append_frames(all[k].speech, Kind::other_word, &to);
    });
  }

  void append_frames(const std::vector<std::vector<float>>& audio, VerifierExample::Kind kind,
                     std::vector<NonWord>* to) const {
    const WordFrontEnd& front_end = augmentation_.front_end();
    for (const std::vector<float>& a : audio) {
      if (front_end.num_frames(a.size()) > 0) to->push_back({kind, front_end.frames(a)});
    }
  }

  int assign_folds() {
    std::vector<int> classes;
    std::vector<std::string> groups;
    for (const PreparedSample& p : prepared_) {
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

  [[nodiscard]] ClassStreams sequences_without(int fold) const {
    ClassStreams sequences(labels_.size());
    for (const PreparedSample& p : prepared_) {
      if (p.fold == fold) continue;
      auto& list = sequences[static_cast<std::size_t>(p.label)];
      for (const StreamFrames& copy : p.copies) list.push_back(&copy);
    }
    return sequences;
  }

  [[nodiscard]] MultiStreamScorer train_without(int fold) const {
    const ClassStreams sequences = sequences_without(fold);
    for (std::size_t c = 0; c < sequences.size(); ++c) {
      if (sequences[c].empty()) {
        fail(ErrorKind::invalid_argument,
             "label '" + labels_[c] + "': no sample with speech in it");
      }
    }
    return MultiStreamScorer::train(sequences, options_, fillers_, should_stop_);
  }

  [[nodiscard]] bool has_every_class_without(int fold) const {
    const ClassStreams sequences = sequences_without(fold);
    return std::none_of(sequences.begin(), sequences.end(),
                        [](const auto& list) { return list.empty(); });
  }

  void score_fold(int fold, HeldOutFolds* held_out) const {
    if (!has_every_class_without(fold)) return;  // there is nothing to calibrate on
    const MultiStreamScorer scorer = train_without(fold);
    std::vector<const PreparedSample*> left_out;
    for (const PreparedSample& p : prepared_) {
      if (p.fold == fold) left_out.push_back(&p);
    }
    std::vector<HeldOutFolds> found(left_out.size());
    detail::parallel_for(left_out.size(), should_stop_, [&](std::size_t i, const StopCheck&) {
      score_sample(*left_out[i], scorer, &found[i]);
    });
    for (HeldOutFolds& one : found) held_out->append(std::move(one));
  }

  static void score_sample(const PreparedSample& p, const MultiStreamScorer& scorer,
                           HeldOutFolds* held_out) {
    using Kind = VerifierExample::Kind;
    const StreamFrames& frames = p.copies.front();
    const VectorF scores = scorer.scores(frames);
    Eigen::Index best = 0;
    scores.maxCoeff(&best);
    const VectorD features = WordVerifier::features(scorer, frames, scores);
    held_out->decisions.push_back({scores, p.label, 0});
    held_out->features.push_back(features);
    if (best == p.label) held_out->examples.push_back({features, Kind::word});
    if (scores.size() > 2) {
      held_out->examples.push_back(
          {WordVerifier::features(scorer, frames, scores, p.label), Kind::other_word});
    }
    for (const NonWord& n : p.non_words) {
      held_out->examples.push_back(
          {WordVerifier::features(scorer, n.frames, scorer.scores(n.frames)), n.kind});
    }
  }

  [[nodiscard]] WordRecognizer assemble(MultiStreamScorer scorer, HeldOutFolds held_out) const {
    WordVerifier verifier = WordVerifier::fit(held_out.examples, scorer.num_fillers() > 0);
    for (std::size_t i = 0; i < held_out.decisions.size(); ++i)
      held_out.decisions[i].score = verifier.verification_score(held_out.features[i]);
    const Calibration calibration =
        Calibration::fit(held_out.decisions, options_.false_reject_rate);
    return {options_, labels_, std::move(scorer), std::move(verifier), calibration};
  }

  WordRecognizerOptions options_;
  std::vector<std::string> labels_;
  detail::WordAugmentation augmentation_;
  detail::NonWords non_words_;
  std::size_t source_step_;
  StopCheck should_stop_;
  std::vector<FillerModels> fillers_;  // of every stream
  std::vector<PreparedSample> prepared_;
};

}  // namespace

WordRecognizer WordRecognizer::train(const std::vector<WordSample>& samples,
                                     const WordRecognizerOptions& options,
                                     const TrainingProgress& progress, const StopCheck& should_stop,
                                     const std::vector<WordSample>& fillers) {
  validate(options);
  WordRecognizerOptions used = options;
  used.cepstra.sample_rate_hz = training_rate_hz(samples, options.cepstra.sample_rate_hz);
  return WordTrainer(samples, used, should_stop).run(samples, fillers, progress);
}

}  // namespace hri
