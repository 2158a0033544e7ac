// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Training of ConnectedWordRecognizer: isolated recordings to strings, strings to sequences of
// every word and of silence, one HMM each; the insertion penalty on strings of speakers held out.
#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include "core/parallel_for.hpp"
#include "hri/core/error.hpp"
#include "hri/recognition/sentence/connected_word_recognizer.hpp"
#include "hri/signal/activity.hpp"
#include "hri/signal/resample.hpp"
#include "recognition/recording_folds.hpp"
#include "recognition/sentence/held_out_choices.hpp"
#include "recognition/sentence/naming.hpp"
#include "recognition/sentence/sentence_training.hpp"
#include "recognition/sentence/training_strings.hpp"
#include "recognition/sentence/word_vectors.hpp"
#include "recognition/word/word_augmentation.hpp"

namespace hri {
namespace {

using detail::SpokenWord;
using detail::StringMaker;
using detail::WordString;

constexpr int kMostFolds = 4;
constexpr int kOfNoFold = -1;
constexpr int kOfAllFolds = -2;  // fillers, of which no person is held out
constexpr int kDefaultRateHz = 16000;
constexpr int kSpeakersPerMixture = 2;
constexpr int kMaxMixtures = 4;
// Of the embedding, where nothing can be held out: the least that was chosen for a speaker of the
// studies, as too little leaves the decision to the cepstra and too much takes it from them.
constexpr double kWeightUnchosen = 20;
constexpr Eigen::Index kMaxCodedFrames = 20000;  // that codebooks of a column each are trained on

// The models of a training, before they are a recogniser.
struct TrainedWords {
  std::vector<GaussianMixtureHmm> models;
  VectorD final_stays;
  std::optional<MultiStreamCodebook> codebook;  // of the kind ptbhmm
  std::optional<EmbeddedWords> embedded;        // of the front end both
};

// Frames at even distances, of all sequences one behind the other: as many as codebooks need.
MatrixF sampled_frames(const ClassSequences& sequences) {
  Eigen::Index num_frames = 0;
  for (const auto& of_class : sequences) {
    for (const MatrixF& frames : of_class) num_frames += frames.rows();
  }
  const Eigen::Index step = (num_frames + kMaxCodedFrames - 1) / kMaxCodedFrames;
  MatrixF result((num_frames + step - 1) / step, sequences.front().front().cols());
  Eigen::Index at = 0;
  for (const auto& of_class : sequences) {
    for (const MatrixF& frames : of_class) {
      for (Eigen::Index t = 0; t < frames.rows(); ++t, ++at) {
        if (at % step == 0) result.row(at / step) = frames.row(t);
      }
    }
  }
  return result;
}

// Forced alignment: where words that are known lie in frames.
class Aligner {
 public:
  explicit Aligner(const TrainedWords& trained) : emissions_(trained.models) {
    for (std::size_t m = 0; m < trained.models.size(); ++m) {
      chains_.push_back(WordChain::of(trained.models[m].chain(),
                                      trained.final_stays[static_cast<Eigen::Index>(m)]));
    }
  }

  // Words and silences; `otherwise` where the frames are too few for the words.
  [[nodiscard]] std::vector<DecodedWord> align(const MatrixF& frames,
                                               const std::vector<int>& labels,
                                               std::vector<DecodedWord> otherwise) const {
    MatrixF log_emissions(frames.rows(), emissions_.num_states());
    emissions_.compute(frames, log_emissions);
    const int silence = static_cast<int>(chains_.size()) - 1;
    ConnectedDecoder decoder(chains_, WordNetwork::transcript(labels, silence));
    for (Eigen::Index t = 0; t < frames.rows(); ++t) decoder.push(row_span(log_emissions, t));
    DecodedSentence sentence = decoder.finish();
    return sentence.complete ? std::move(sentence.words) : std::move(otherwise);
  }

 private:
  GaussianEmissions emissions_;
  std::vector<WordChain> chains_;
};

class ConnectedWordTrainer {
 public:
  ConnectedWordTrainer(const ConnectedWordRecognizerOptions& options,
                       std::vector<std::string> labels,
                       std::shared_ptr<const SpeechEmbedding> embedding, StopCheck should_stop)
      : options_(options),
        labels_(std::move(labels)),
        maker_(options),
        embedding_(std::move(embedding)),
        should_stop_(std::move(should_stop)) {}

  ConnectedWordRecognizer run(const std::vector<WordSample>& samples,
                              const std::vector<WordSample>& fillers,
                              const TrainingProgress& progress) {
    read(samples, "samples");
    const int num_folds = options_.choose_penalty ? assign_folds() : 0;
    const int num_steps = num_folds + 1;
    if (progress) progress(0, num_steps);
    if (options_.unknown_words && !fillers.empty())
      fillers_ = fillers_of(fillers, options_, should_stop_);
    if (embedding_ != nullptr) {
      vectors_.emplace(embedding_, options_.words);
      vectors_->add(words_, maker_, should_stop_);
      if (options_.unknown_words) vectors_->add(read_others(fillers), maker_, should_stop_);
    }
    const std::vector<Fold> folds = train_folds(num_folds, num_steps, progress);
    TrainedWords all = train_without(kOfNoFold);
    if (!folds.empty()) choose(folds, all);
    if (embedding_ != nullptr && options_.words.embedding_weight == 0)
      options_.words.embedding_weight = kWeightUnchosen;
    ConnectedWordRecognizer result = recognizer(options_, std::move(all));
    if (progress) progress(num_steps, num_steps);
    return result;
  }

 private:
  // A recogniser that was trained without some speakers, and strings of these.
  using Fold = std::pair<ConnectedWordRecognizer, std::vector<WordString>>;

  // The words of strings of their own: the models of the vocabulary and of silence are the same
  // with fillers and without.
  static FillerModels fillers_of(const std::vector<WordSample>& samples,
                                 ConnectedWordRecognizerOptions options,
                                 const StopCheck& should_stop) {
    options.words.model = SequenceModelKind::hmm;  // possibilities come of its densities
    options.words.front_end = FrontEndKind::cepstra;
    std::set<std::string> labels;
    for (const WordSample& sample : samples) labels.insert(sample.label);
    ConnectedWordTrainer trainer(options, {labels.begin(), labels.end()}, nullptr, should_stop);
    trainer.read(samples, "fillers");
    FillerModels models = trainer.train_without(kOfNoFold).models;
    models.pop_back();  // that of silence
    return models;
  }

  // Words without speech are left out, but every label needs one.
  void read(const std::vector<WordSample>& samples, const char* list) {
    words_ = spoken(samples, list,
                    [this](const WordSample& s) { return label_index(labels_, s.label); });
    for (std::size_t c = 0; c < labels_.size(); ++c) {
      if (!has_label(static_cast<int>(c), kOfNoFold))
        fail(ErrorKind::invalid_argument,
             "no recording of the label '" + labels_[c] + "' has speech in it");
    }
  }

  // Words outside the vocabulary, all of one class behind those of the labels.
  [[nodiscard]] std::vector<SpokenWord> read_others(const std::vector<WordSample>& samples) const {
    std::vector<SpokenWord> words =
        spoken(samples, "fillers", [this](const WordSample&) { return silence(); });
    for (SpokenWord& word : words) word.fold = kOfAllFolds;
    return words;
  }

  template <class LabelOf>
  [[nodiscard]] std::vector<SpokenWord> spoken(const std::vector<WordSample>& samples,
                                               const char* list, const LabelOf& label_of) const {
    std::vector<SpokenWord> words(samples.size());
    detail::parallel_for(samples.size(), should_stop_, [&](std::size_t i, const StopCheck&) {
      detail::naming(detail::sample_name(samples[i], list, i),
                     [&] { read_one(samples[i], &words[i]); });
      words[i].label = label_of(samples[i]);
    });
    words.erase(std::remove_if(words.begin(), words.end(),
                               [](const SpokenWord& word) { return word.first == word.last; }),
                words.end());
    return words;
  }

  void read_one(const WordSample& sample, SpokenWord* word) const {
    detail::check_recording(sample.samples, sample.sample_rate_hz);
    const int rate_hz = maker_.front_end().sample_rate_hz();
    if (sample.sample_rate_hz == rate_hz) {
      word->clip.assign(sample.samples.begin(), sample.samples.end());
    } else {
      word->clip = resample(sample.samples, sample.sample_rate_hz, rate_hz);
    }
    ActivityOptions activity = options_.words.activity;
    activity.padding_ms = 0;
    const SpeechBounds bounds = find_speech(word->clip, rate_hz, activity);
    if (!bounds.found) return;
    word->first = bounds.first;
    word->last = bounds.last;
    word->group = sample.group;
  }

  [[nodiscard]] bool has_label(int label, int without_fold) const {
    return std::any_of(words_.begin(), words_.end(), [&](const SpokenWord& word) {
      return word.label == label && word.fold != without_fold;
    });
  }

  int assign_folds() {
    std::vector<int> classes;
    std::vector<std::string> groups;
    for (const SpokenWord& word : words_) {
      classes.push_back(word.label);
      groups.push_back(word.group);
    }
    const std::vector<int> folds = detail::usable_folds(classes, groups, kMostFolds);
    for (std::size_t i = 0; i < words_.size(); ++i) words_[i].fold = folds[i];
    return *std::max_element(folds.begin(), folds.end()) + 1;
  }

  // Whether every word is trained without the fold.
  [[nodiscard]] bool usable(int fold) const {
    for (std::size_t c = 0; c < labels_.size(); ++c) {
      if (!has_label(static_cast<int>(c), fold)) return false;
    }
    return true;
  }

  template <class Chosen>
  [[nodiscard]] std::vector<const SpokenWord*> words_where(Chosen&& chosen) const {
    std::vector<const SpokenWord*> found;
    for (const SpokenWord& word : words_) {
      if (chosen(word)) found.push_back(&word);
    }
    return found;
  }

  [[nodiscard]] TrainedWords train_without(int fold) const {
    const auto words = words_where([fold](const SpokenWord& w) { return w.fold != fold; });
    TrainedWords trained = train_models(sequences_of(words, nullptr));
    for (int i = 0; i < options_.num_alignments; ++i)
      trained = train_models(sequences_of(words, &trained));
    if (vectors_) trained.embedded = vectors_->train_without(fold, should_stop_);
    return trained;
  }

  [[nodiscard]] int silence() const { return static_cast<int>(labels_.size()); }

  // Every copy joins the words in another way. With models the words lie where these put them.
  [[nodiscard]] ClassSequences sequences_of(const std::vector<const SpokenWord*>& words,
                                            const TrainedWords* models) const {
    std::optional<Aligner> aligner;
    if (models != nullptr) aligner.emplace(*models);
    const auto num_copies = static_cast<std::size_t>(maker_.num_copies());
    std::vector<ClassSequences> of_copies(num_copies);
    const std::uint64_t seed = options_.words.seed;
    detail::parallel_for(num_copies, should_stop_, [&](std::size_t copy, const StopCheck& stop) {
      of_copies[copy].resize(labels_.size() + 1);
      std::uint64_t of_string = seed + copy;
      for (const WordString& string : maker_.join(words, seed + copy)) {
        poll(stop);
        const MatrixF frames =
            maker_.frames(string, static_cast<int>(copy), of_string += num_copies);
        auto segments = maker_.segments(string, frames.rows(), silence());
        if (aligner) segments = aligner->align(frames, string.labels, std::move(segments));
        for (const DecodedWord& segment : segments) {
          of_copies[copy][static_cast<std::size_t>(segment.model)].push_back(
              frames.middleRows(segment.first_frame, segment.last_frame - segment.first_frame));
        }
      }
    });
    ClassSequences all(labels_.size() + 1);
    for (ClassSequences& of_copy : of_copies) {
      for (std::size_t c = 0; c < all.size(); ++c)
        std::move(of_copy[c].begin(), of_copy[c].end(), std::back_inserter(all[c]));
    }
    return all;
  }

  // With unknown words no more than people said the word, such as the one who added it.
  [[nodiscard]] int num_mixtures_of(int label) const {
    std::set<std::string> speakers;
    std::set<std::string> all;
    for (const SpokenWord& word : words_) {
      all.insert(word.group);
      if (word.label == label) speakers.insert(word.group);
    }
    const int most = options_.words.num_mixtures;
    if (!options_.unknown_words || all.size() < 2) return most;
    return std::min(most, static_cast<int>(speakers.size()));
  }

  [[nodiscard]] TrainedWords train_models(const ClassSequences& sequences) const {
    std::vector<std::optional<GaussianMixtureHmm>> models(sequences.size());
    TrainedWords trained;
    trained.final_stays.resize(static_cast<Eigen::Index>(sequences.size()));
    detail::parallel_for(sequences.size(), should_stop_, [&](std::size_t c, const StopCheck& stop) {
      const bool is_silence = c + 1 == sequences.size();
      GaussianMixtureHmmOptions options;
      options.topology.num_states =
          is_silence ? options_.silence_states : options_.words.num_states;
      options.num_mixtures =
          is_silence ? options_.silence_mixtures : num_mixtures_of(static_cast<int>(c));
      options.max_iterations = options_.words.max_iterations;
      options.seed = options_.words.seed;
      options.should_stop = stop;
      models[c] = GaussianMixtureHmm::train(sequences[c], options);
      trained.final_stays[static_cast<Eigen::Index>(c)] =
          detail::final_stay(*models[c], sequences[c]);
    });
    for (auto& model : models) trained.models.push_back(std::move(*model));
    if (options_.words.model == SequenceModelKind::ptbhmm)
      trained.codebook = detail::train_column_codebooks(sampled_frames(sequences),
                                                        options_.words.num_codewords, should_stop_);
    return trained;
  }

  [[nodiscard]] ConnectedWordRecognizer recognizer(const ConnectedWordRecognizerOptions& options,
                                                   TrainedWords trained) const {
    return {options,
            labels_,
            std::move(trained.models),
            trained.final_stays,
            std::move(trained.codebook),
            fillers_,
            std::move(trained.embedded)};
  }

  // What is to be chosen with, without the unknown word.
  [[nodiscard]] ConnectedWordRecognizerOptions options_of_folds() const {
    ConnectedWordRecognizerOptions of_folds = options_;
    of_folds.unknown_words = false;
    return of_folds;
  }

  // Models of all folds but one each; the insertion penalty is chosen on strings of this one.
  std::vector<Fold> train_folds(int num_folds, int num_steps, const TrainingProgress& progress) {
    detail::HeldOutChoices choices(should_stop_);
    std::vector<Fold> folds;
    for (int fold = 0; fold < num_folds; ++fold) {
      if (usable(fold)) {
        folds.emplace_back(
            recognizer(options_of_folds(), train_without(fold)),
            maker_.join(words_where([fold](const SpokenWord& w) { return w.fold == fold; }),
                        options_.words.seed));
        choices.try_penalties(folds.back().first, folds.back().second);
      }
      if (progress) progress(fold + 1, num_steps);
    }
    if (num_folds > 0) options_.decoder.insertion_penalty = choices.best_penalty();
    return folds;
  }

  // The rest, with this penalty; `all` are the models that know all speakers.
  void choose(const std::vector<Fold>& folds, const TrainedWords& all) {
    if (embedding_ != nullptr && options_.words.embedding_weight == 0) choose_weight(folds);
    detail::HeldOutChoices choices(should_stop_);
    const ConnectedWordRecognizer of_all = recognizer(options_of_folds(), all);
    for (const auto& [trained, strings] : folds) {
      choices.try_scales(as_chosen(trained), strings);
      if (!options_.unknown_words) continue;
      choices.add_leads(trained, strings, true);
      choices.add_leads(of_all, strings, false);
    }
    options_.confidence_scale = choices.best_scale();
    if (choices.expected_lead() > 0) options_.unknown_lead = choices.expected_lead();
  }

  void choose_weight(const std::vector<Fold>& folds) {
    detail::HeldOutChoices choices(should_stop_);
    for (const auto& [trained, strings] : folds) choices.try_weights(as_chosen(trained), strings);
    options_.words.embedding_weight = choices.best_weight();
  }

  // A model of a fold with what was chosen so far.
  [[nodiscard]] ConnectedWordRecognizer as_chosen(const ConnectedWordRecognizer& trained) const {
    return trained.with_decoder(options_.decoder)
        .with_embedding_weight(options_.words.embedding_weight);
  }

  ConnectedWordRecognizerOptions options_;
  std::vector<std::string> labels_;
  StringMaker maker_;
  std::shared_ptr<const SpeechEmbedding> embedding_;  // nullptr: cepstra alone
  StopCheck should_stop_;
  std::vector<SpokenWord> words_;
  std::optional<detail::WordVectors> vectors_;  // with an embedding
  FillerModels fillers_;
};

// Options of isolated words that were set, and that connected ones are not made by.
const char* without_effect(const WordRecognizerOptions& words) {
  const WordRecognizerOptions usual;
  if (words.trim != usual.trim) return "words.trim has no effect";
  if (words.garbage_mixtures != usual.garbage_mixtures)
    return "words.garbage_mixtures has no effect";
  if (words.false_reject_rate != usual.false_reject_rate)
    return "words.false_reject_rate has no effect; min_confidence and unknown_margin have";
  if (!has_embedding(words.front_end)) {
    if (words.num_embedding_copies != usual.num_embedding_copies)
      return "words.num_embedding_copies has no effect with front_end cepstra";
    if (words.embedding_penalty != usual.embedding_penalty)
      return "words.embedding_penalty has no effect with front_end cepstra";
    if (words.embedding_weight != usual.embedding_weight)
      return "words.embedding_weight has no effect with front_end cepstra";
  }
  if (words.embedding_shrinkage != usual.embedding_shrinkage)
    return "words.embedding_shrinkage has no effect";
  if (words.embedding_false_accept_rate != usual.embedding_false_accept_rate)
    return "words.embedding_false_accept_rate has no effect";
  return nullptr;
}

}  // namespace

ConnectedWordRecognizer ConnectedWordRecognizer::train(
    const std::vector<WordSample>& samples, const ConnectedWordRecognizerOptions& options,
    const TrainingProgress& progress, const StopCheck& should_stop,
    const std::vector<WordSample>& fillers,
    const std::shared_ptr<const SpeechEmbedding>& embedding) {
  validate(options);
  require(has_embedding(options.words.front_end) == (embedding != nullptr),
          "there must be a speech embedding exactly where words.front_end is both");
  if (const char* fault = without_effect(options.words)) fail(ErrorKind::invalid_argument, fault);
  std::vector<std::string> labels;
  std::set<std::string> speakers;
  ConnectedWordRecognizerOptions used = options;
  int& rate_hz = used.words.cepstra.sample_rate_hz;
  const bool takes_lowest = rate_hz == 0;
  if (takes_lowest) rate_hz = kDefaultRateHz;
  for (const WordSample& sample : samples) {
    labels.push_back(sample.label);
    speakers.insert(sample.group);
    if (takes_lowest) rate_hz = std::min(rate_hz, sample.sample_rate_hz);
  }
  check_labels(labels);
  if (used.words.num_mixtures == 0) {
    // Sharper models keep foreign words apart better.
    const int per_mixture = used.unknown_words ? 1 : kSpeakersPerMixture;
    used.words.num_mixtures =
        std::clamp(static_cast<int>(speakers.size()) / per_mixture, 1, kMaxMixtures);
  }
  return ConnectedWordTrainer(used, sorted_labels(labels), embedding, should_stop)
      .run(samples, fillers, progress);
}

}  // namespace hri
