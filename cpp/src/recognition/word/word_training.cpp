// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Training of WordRecognizer: features of every sample and of its augmented copies, models without
// each fold of speakers for verifier and calibration, then the models that are kept.
#include <algorithm>
#include <memory>
#include <set>
#include <utility>

#include "core/parallel_for.hpp"
#include "hri/core/error.hpp"
#include "hri/recognition/word/word_recognizer.hpp"
#include "recognition/word/filler_memo.hpp"
#include "recognition/word/held_out_words.hpp"
#include "recognition/word/non_words.hpp"
#include "recognition/word/training_steps.hpp"
#include "recognition/word/weight_choice.hpp"
#include "recognition/word/word_augmentation.hpp"
#include "recognition/word/word_folds.hpp"

namespace hri {
namespace {

constexpr int kMaxFolds = 4;
constexpr std::size_t kNonWordSources = 300;  // samples from which non-words are made, at most
constexpr int kDefaultRateHz = 16000;
constexpr int kNoFold = -1;
constexpr int kSpeakersPerMixture = 2;
constexpr int kMaxMixtures = 4;

int training_rate_hz(const std::vector<WordSample>& samples, int wanted_hz) {
  if (wanted_hz != 0) return wanted_hz;
  int rate = kDefaultRateHz;
  for (const WordSample& s : samples) rate = std::min(rate, s.sample_rate_hz);
  return rate;
}

// Few voices are one Gaussian; many are several (study commands-curve).
int training_mixtures(const std::vector<WordSample>& samples, int wanted) {
  if (wanted != 0) return wanted;
  std::set<std::string> speakers;
  for (const WordSample& s : samples) speakers.insert(s.group);
  return std::clamp(static_cast<int>(speakers.size()) / kSpeakersPerMixture, 1, kMaxMixtures);
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
  std::string recording;
  std::vector<StreamFrames> copies;  // the sample itself first
  MatrixF window;                    // for the network's training, where there is one
  std::vector<NonWord> non_words;
};

class WordTrainer {
 public:
  WordTrainer(const std::vector<WordSample>& samples, const WordRecognizerOptions& options,
              const std::shared_ptr<const SpeechEmbedding>& embedding, StopCheck should_stop)
      : options_(options),
        labels_(sorted_labels(words_of(samples))),
        augmentation_(options, embedding),
        non_words_(options.cepstra.sample_rate_hz, options.seed),
        source_step_(1 + samples.size() / kNonWordSources),
        should_stop_(std::move(should_stop)) {}

  WordRecognizer run(const std::vector<WordSample>& samples, const std::vector<WordSample>& fillers,
                     const std::vector<WordSample>& embedding_fillers,
                     const TrainingProgress& progress) {
    // Recordings; models of every fold and those that are kept, and the epochs of their networks,
    // each as the many recordings that take about as long. There may be fewer folds in the end.
    const int num_folds_of_all = num_folds_of(samples);
    const bool has_fillers = takes_fillers() && !fillers.empty();
    const std::size_t num_fillers =
        has_fillers ? fillers.size() + (has_vectors() ? embedding_fillers.size() : 0) : 0;
    const int num_read = static_cast<int>(num_fillers + samples.size());
    model_steps_ = 1 + static_cast<int>(samples.size()) / (has_vectors() ? 40 : 2);
    const int num_steps = num_read + model_steps_ * (num_folds_of_all * (1 + num_epochs(0)) + 1 +
                                                     num_epochs(kNoFold));
    steps_ = std::make_shared<detail::TrainingSteps>(progress, num_steps);
    if (has_fillers) {
      fillers_ = detail::remembered_fillers(
          fillers, embedding_fillers, options_, augmentation_.front_end().embedding().get(),
          [&] { return train_fillers(fillers, embedding_fillers); });
      steps_->reach(static_cast<int>(num_fillers));
    }
    prepare(samples);
    steps_->reach(num_read);
    const int num_folds = assign_folds();
    const std::vector<int> folds = usable_folds(num_folds);
    std::vector<MultiStreamScorer> scorers;
    for (const int fold : folds) {
      scorers.push_back(train_without(fold));
      steps_->add(model_steps_);
    }
    weigh(folds, &scorers);
    detail::HeldOutWords held_out;
    for (std::size_t i = 0; i < folds.size(); ++i) score_fold(folds[i], scorers[i], &held_out);
    WordRecognizer result = assemble(train_without(kNoFold), std::move(held_out));
    steps_->reach(num_steps);
    return result;
  }

 private:
  [[nodiscard]] detail::TrainedFillers train_fillers(
      const std::vector<WordSample>& fillers,
      const std::vector<WordSample>& embedding_fillers) const {
    detail::TrainedFillers result;
    const auto of_words = copies_of(fillers, "fillers");
    ClassStreams sequences(of_words.size());
    for (std::size_t w = 0; w < of_words.size(); ++w) {
      for (const StreamFrames& copy : of_words[w]) sequences[w].push_back(&copy);
    }
    result.models = hri::train_fillers(sequences, augmentation_.front_end().num_streams(), options_,
                                       should_stop_);
    if (!has_vectors()) return result;
    append_vectors(of_words, &result.vectors);
    append_vectors(copies_of(embedding_fillers, "embedding_fillers"), &result.vectors);
    return result;
  }

  // Of every word, in the order of their labels. Those without speech are left out.
  [[nodiscard]] std::vector<std::vector<StreamFrames>> copies_of(
      const std::vector<WordSample>& fillers, const char* list_name) const {
    std::vector<std::string> words = words_of(fillers);
    std::sort(words.begin(), words.end());
    words.erase(std::unique(words.begin(), words.end()), words.end());
    std::vector<std::vector<StreamFrames>> of_samples(fillers.size());
    detail::parallel_for(fillers.size(), should_stop_, [&](std::size_t i, const StopCheck&) {
      const detail::TrainingWord word =
          augmentation_.read(fillers[i], detail::sample_name(fillers[i], list_name, i));
      // Augmented as the vocabulary is, so that neither of the two fits noise or a voice better.
      if (word.has_speech()) of_samples[i] = augmentation_.copies(word, i);
      steps_->add(1);
    });
    std::vector<std::vector<StreamFrames>> copies(words.size());
    for (std::size_t i = 0; i < fillers.size(); ++i) {
      auto& list = copies[static_cast<std::size_t>(label_index(words, fillers[i].label))];
      for (StreamFrames& copy : of_samples[i]) list.push_back(std::move(copy));
    }
    copies.erase(
        std::remove_if(copies.begin(), copies.end(), [](const auto& list) { return list.empty(); }),
        copies.end());
    return copies;
  }

  void append_vectors(const std::vector<std::vector<StreamFrames>>& of_words,
                      ClassSequences* vectors) const {
    const auto num_streams = static_cast<std::size_t>(augmentation_.front_end().num_streams());
    for (const auto& list : of_words) {
      vectors->emplace_back();
      for (const StreamFrames& copy : list) {
        if (copy.size() > num_streams) vectors->back().push_back(copy[num_streams]);
      }
    }
  }

  // Samples without speech are left out; train_without() refuses a label that has no other.
  void prepare(const std::vector<WordSample>& samples) {
    std::vector<std::vector<float>> words(samples.size());
    std::vector<PreparedSample> made(samples.size());
    detail::parallel_for(samples.size(), should_stop_, [&](std::size_t i, const StopCheck&) {
      detail::TrainingWord word =
          augmentation_.read(samples[i], detail::sample_name(samples[i], "samples", i));
      steps_->add(1);
      if (!word.has_speech()) return;
      made[i].label = label_index(labels_, samples[i].label);
      made[i].group = samples[i].group;
      made[i].recording = samples[i].recording;
      made[i].copies = augmentation_.copies(word, i);
      made[i].window = std::move(word.word.window);
      words[i] = std::move(word.word.samples);
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
      if (front_end.is_long_enough(a.size()))
        to->push_back({kind, front_end.frames(front_end.untrimmed(a))});
    }
  }

  [[nodiscard]] int num_folds_of(const std::vector<WordSample>& samples) const {
    std::vector<detail::WordOrigin> words;
    words.reserve(samples.size());
    for (const WordSample& s : samples)
      words.push_back({label_index(labels_, s.label), s.group, s.recording});
    const std::vector<int> folds = detail::word_folds(words, kMaxFolds);
    return folds.empty() ? 0 : 1 + *std::max_element(folds.begin(), folds.end());
  }

  int assign_folds() {
    std::vector<detail::WordOrigin> words;
    words.reserve(prepared_.size());
    for (const PreparedSample& p : prepared_) words.push_back({p.label, p.group, p.recording});
    const std::vector<int> folds = detail::word_folds(words, kMaxFolds);
    int num_folds = 0;
    for (std::size_t i = 0; i < folds.size(); ++i) {
      prepared_[i].fold = folds[i];
      num_folds = std::max(num_folds, folds[i] + 1);
    }
    return num_folds;
  }

  // Those without which every label is left.
  [[nodiscard]] std::vector<int> usable_folds(int num_folds) const {
    std::vector<int> folds;
    for (int fold = 0; fold < num_folds; ++fold) {
      if (has_every_class_without(fold)) folds.push_back(fold);
    }
    return folds;
  }

  [[nodiscard]] bool has_vectors() const {
    return augmentation_.front_end().embedding() != nullptr;
  }
  [[nodiscard]] bool has_network() const { return augmentation_.spectrograms() != nullptr; }
  // Vectors compare with fillers, but beside cepstra only where the models of these do.
  [[nodiscard]] bool takes_fillers() const {
    return !has_cepstra(options_.front_end) || options_.model != SequenceModelKind::ptbhmm;
  }

  // Of vectors beside the streams (1 where there are none), then of the network beside both, by the
  // scorers of the folds.
  void weigh(const std::vector<int>& folds, std::vector<MultiStreamScorer>* scorers) {
    if (has_vectors()) {
      vector_weight_ = options_.embedding_weight;
      if (vector_weight_ == 0) {
        vector_weight_ = detail::choose_weight(
            held_out_scores(folds, *scorers, [](const auto& scorer, const StreamFrames& frames) {
              return std::pair(scorer.stream_scores(frames), scorer.vector_scores(frames));
            }));
      }
      for (MultiStreamScorer& scorer : *scorers) scorer = scorer.with_vector_weight(vector_weight_);
    }
    if (!has_network()) return;
    network_weight_ = options_.network_weight;
    if (network_weight_ == 0) {
      network_weight_ = detail::choose_weight(
          held_out_scores(folds, *scorers, [](const auto& scorer, const StreamFrames& frames) {
            const VectorF network = scorer.network_scores(frames);
            return std::pair(VectorF(scorer.scores(frames) - network), network);
          }));
    }
    for (MultiStreamScorer& scorer : *scorers) scorer = scorer.with_network_weight(network_weight_);
  }

  // Of every word held out that is judged, what two(scorer without it, its frames) gives.
  template <class Two>
  [[nodiscard]] std::vector<detail::HeldOutScores> held_out_scores(
      const std::vector<int>& folds, const std::vector<MultiStreamScorer>& scorers,
      const Two& two) const {
    std::vector<std::vector<detail::HeldOutScores>> found(prepared_.size());
    detail::parallel_for(prepared_.size(), should_stop_, [&](std::size_t i, const StopCheck&) {
      const PreparedSample& p = prepared_[i];
      const auto fold = std::find(folds.begin(), folds.end(), p.fold);
      if (fold == folds.end()) return;
      const auto& scorer = scorers[static_cast<std::size_t>(fold - folds.begin())];
      for (const StreamFrames* copy : judged_copies(p)) {
        auto [first, second] = two(scorer, *copy);
        found[i].push_back({std::move(first), std::move(second), p.label});
      }
    });
    std::vector<detail::HeldOutScores> all;
    for (auto& words : found) std::move(words.begin(), words.end(), std::back_inserter(all));
    return all;
  }

  // What is judged of a word held out: itself, and its noisy copies, which noise takes away from
  // its models and its fillers.
  [[nodiscard]] std::vector<const StreamFrames*> judged_copies(const PreparedSample& p) const {
    std::vector<const StreamFrames*> result{&p.copies.front()};
    const auto num_noisy = static_cast<std::size_t>(options_.num_noisy_copies);
    for (std::size_t i = p.copies.size() - num_noisy; i < p.copies.size(); ++i)
      result.push_back(&p.copies[i]);
    return result;
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
    const VectorTraining vectors{{options_.embedding_penalty, options_.embedding_shrinkage},
                                 fillers_->vectors};
    const NetworkTraining network = network_without(fold);
    MultiStreamScorer scorer = MultiStreamScorer::train(
        sequences, options_, fillers_->models, should_stop_, has_vectors() ? &vectors : nullptr,
        has_network() ? &network : nullptr);
    if (has_vectors()) scorer = scorer.with_vector_weight(vector_weight_);
    if (has_network()) scorer = scorer.with_network_weight(network_weight_);
    return scorer;
  }

  // Of the network without a fold. Those that only judge how far networks are to be trusted take
  // half the time.
  [[nodiscard]] int num_epochs(int fold) const {
    if (!has_network()) return 0;
    const int all = options_.network.num_epochs;
    return fold == kNoFold ? all : (all + 1) / 2;
  }

  [[nodiscard]] NetworkTraining network_without(int fold) const {
    NetworkTraining result;
    result.options = options_.network;
    result.options.seed += options_.seed;
    result.options.num_epochs = num_epochs(fold);
    result.progress = [this](int) { steps_->add(model_steps_); };
    std::vector<const MatrixF*> windows;
    for (const PreparedSample& p : prepared_) {
      if (p.fold == fold) continue;
      result.classes.push_back(p.label);
      windows.push_back(&p.window);
    }
    result.examples = [this, windows](std::size_t i, Random* random, MatrixF* input) {
      augmentation_.spectrograms()->make_example(*windows[i], random, input);
    };
    return result;
  }

  [[nodiscard]] bool has_every_class_without(int fold) const {
    const ClassStreams sequences = sequences_without(fold);
    return std::none_of(sequences.begin(), sequences.end(),
                        [](const auto& list) { return list.empty(); });
  }

  void score_fold(int fold, const MultiStreamScorer& scorer, detail::HeldOutWords* held_out) const {
    std::vector<const PreparedSample*> left_out;
    for (const PreparedSample& p : prepared_) {
      if (p.fold == fold) left_out.push_back(&p);
    }
    std::vector<detail::HeldOutWords> found(left_out.size());
    detail::parallel_for(left_out.size(), should_stop_, [&](std::size_t i, const StopCheck&) {
      score_sample(*left_out[i], scorer, &found[i]);
    });
    for (detail::HeldOutWords& one : found) held_out->append(std::move(one));
  }

  void score_sample(const PreparedSample& p, const MultiStreamScorer& scorer,
                    detail::HeldOutWords* held_out) const {
    for (const StreamFrames* copy : judged_copies(p))
      held_out->add_word(*copy, p.label, p.group, copy == &p.copies.front(), scorer);
    for (const NonWord& n : p.non_words) held_out->add_non_word(n.frames, n.kind, scorer);
  }

  [[nodiscard]] WordRecognizer assemble(MultiStreamScorer scorer,
                                        detail::HeldOutWords held_out) const {
    detail::Judgement judgement = held_out.judge(options_, labels_, scorer);
    return {options_,
            labels_,
            std::move(scorer),
            std::move(judgement.verifier),
            judgement.calibration,
            augmentation_.front_end().embedding(),
            std::move(judgement.report)};
  }

  WordRecognizerOptions options_;
  std::vector<std::string> labels_;
  detail::WordAugmentation augmentation_;
  detail::NonWords non_words_;
  std::size_t source_step_;
  StopCheck should_stop_;
  std::shared_ptr<detail::TrainingSteps> steps_;
  int model_steps_ = 1;
  std::shared_ptr<const detail::TrainedFillers> fillers_ =
      std::make_shared<const detail::TrainedFillers>();
  double vector_weight_ = 1;
  double network_weight_ = 1;
  std::vector<PreparedSample> prepared_;
};

}  // namespace

WordRecognizer WordRecognizer::train(const std::vector<WordSample>& samples,
                                     const WordRecognizerOptions& options,
                                     const TrainingProgress& progress, const StopCheck& should_stop,
                                     const std::vector<WordSample>& fillers,
                                     const std::shared_ptr<const SpeechEmbedding>& embedding,
                                     const std::vector<WordSample>& embedding_fillers) {
  validate(options);
  require(embedding_fillers.empty() || (embedding != nullptr && !fillers.empty()),
          "embedding_fillers need a speech embedding and other fillers");
  WordRecognizerOptions used = options;
  used.cepstra.sample_rate_hz = training_rate_hz(samples, options.cepstra.sample_rate_hz);
  used.num_mixtures = training_mixtures(samples, options.num_mixtures);
  return WordTrainer(samples, used, embedding, should_stop)
      .run(samples, fillers, embedding_fillers, progress);
}

}  // namespace hri
