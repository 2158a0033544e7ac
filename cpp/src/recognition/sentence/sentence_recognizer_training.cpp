// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Training of SentenceRecognizer: models of the frames of every word, and of those between words;
// lengths of words, weights of the language and the insertion penalty on sentences held out.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/parallel_for.hpp"
#include "hri/core/error.hpp"
#include "hri/models/sequence_scorer.hpp"
#include "recognition/sentence/sentence_training.hpp"
#include "recognition/sentence/sign_models.hpp"

namespace hri {
namespace {

constexpr int kMaxFolds = 4;
constexpr int kNoFold = -1;
constexpr std::array kFramesPerState{2, 3, 4};
constexpr std::array kPenalties{-40.0, -20.0, 0.0, 20.0};
// Of rows: these have any number of columns, and gestures last longer than words of a sentence.
constexpr std::array<double, kPenalties.size()> kPenaltiesOfRows{-1000.0, -300.0, -100.0, 0.0};
constexpr std::array kScales{8.0, 12.0, 16.0};
// Sentences that weights are chosen on, about: more take long, and change little.
constexpr std::size_t kEnoughSentences = 200;

struct Signed {
  MatrixF frames;
  std::vector<int> words;
  const SignedSample* sample = nullptr;
  int fold = 0;
};

// Errors of one number of frames a state.
struct WeightErrors {
  std::array<std::array<int, kScales.size()>, kPenalties.size()> sentences{};
  std::array<int, kScales.size()> known{};
  int num_sentences = 0;
  std::size_t num_scales = kScales.size();  ///< that are tried

  [[nodiscard]] std::pair<std::size_t, std::size_t> best() const {
    std::pair<std::size_t, std::size_t> best{0, 0};
    for (std::size_t p = 0; p < kPenalties.size(); ++p) {
      for (std::size_t s = 0; s < num_scales; ++s) {
        if (sentences[p][s] < sentences[best.first][best.second]) best = {p, s};
      }
    }
    return best;
  }
  [[nodiscard]] int fewest() const {
    const auto [p, s] = best();
    return sentences[p][s];
  }
  WeightErrors& operator+=(const WeightErrors& more) {
    for (std::size_t s = 0; s < kScales.size(); ++s) {
      known[s] += more.known[s];
      for (std::size_t p = 0; p < kPenalties.size(); ++p) sentences[p][s] += more.sentences[p][s];
    }
    return *this;
  }
};

class SentenceTrainer {
 public:
  SentenceTrainer(const SentenceRecognizerOptions& options, StopCheck should_stop)
      : options_(options), should_stop_(std::move(should_stop)) {}

  SentenceRecognizer run(const std::vector<SignedSample>& samples,
                         const TrainingProgress& progress) {
    read(samples);
    const bool choose_length = options_.frames_per_state == 0;
    std::vector<int> lengths{options_.frames_per_state};
    if (choose_length) lengths.assign(kFramesPerState.begin(), kFramesPerState.end());
    const bool choose = choose_length || options_.choose_weights;
    const int num_folds = choose ? assign_folds() : 0;
    const int num_steps = num_folds * static_cast<int>(lengths.size()) + 1;
    int done = 0;
    if (progress) progress(done, num_steps);
    std::vector<WeightErrors> errors(lengths.size());
    for (WeightErrors& e : errors) e.num_scales = num_scales();
    for (std::size_t i = 0; i < lengths.size(); ++i) {
      options_.frames_per_state = lengths[i];
      for (int fold = 0; fold < num_folds; ++fold) {
        if (usable(fold)) count_errors(fold, &errors[i]);
        if (progress) progress(++done, num_steps);
      }
    }
    const auto best = std::min_element(
        errors.begin(), errors.end(),
        [](const WeightErrors& a, const WeightErrors& b) { return a.fewest() < b.fewest(); });
    options_.frames_per_state = lengths[static_cast<std::size_t>(best - errors.begin())];
    if (options_.choose_weights && best->num_sentences > 0) choose_weights(*best);
    SentenceRecognizer result = train_without(kNoFold, options_);
    if (progress) progress(num_steps, num_steps);
    return result;
  }

 private:
  void read(const std::vector<SignedSample>& samples) {
    detail::SentencesToTrainOn read = detail::frames_to_train_on(samples, &options_);
    reaches_ = read.reaches;
    std::vector<std::string> labels;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      Signed one;
      one.sample = &samples[i];
      one.frames = std::move(read.frames[i]);
      for (const SignedWordSpan& word : samples[i].words) labels.push_back(word.label);
      sentences_.push_back(std::move(one));
    }
    labels_ = sorted_labels(labels);
    for (Signed& one : sentences_) {
      for (const SignedWordSpan& word : one.sample->words)
        one.words.push_back(label_index(labels_, word.label));
    }
  }

  static Sentence words_of(const SignedSample& sample) {
    Sentence words;
    for (const SignedWordSpan& word : sample.words) words.push_back(word.label);
    return words;
  }

  int assign_folds() {
    std::vector<std::string> groups;
    groups.reserve(sentences_.size());
    for (const Signed& one : sentences_) groups.push_back(one.sample->group);
    const std::vector<int> folds =
        held_out_folds(std::vector<int>(sentences_.size(), 0), groups, kMaxFolds);
    for (std::size_t i = 0; i < folds.size(); ++i) sentences_[i].fold = folds[i];
    return *std::max_element(folds.begin(), folds.end()) + 1;
  }

  // Of every label, and behind them of what lies between words.
  [[nodiscard]] ClassSequences sequences_without(int fold) const {
    ClassSequences sequences(labels_.size() + 1);
    for (const Signed& one : sentences_) {
      if (one.fold == fold) continue;
      Eigen::Index end = 0;
      const auto between_until = [&](Eigen::Index first) {
        if (first > end) sequences.back().push_back(one.frames.middleRows(end, first - end));
      };
      for (std::size_t i = 0; i < one.words.size(); ++i) {
        const SignedWordSpan& word = one.sample->words[i];
        const auto [first, last] =
            detail::with_margin(word, options_.margin_frames, one.frames.rows());
        between_until(first);
        sequences[static_cast<std::size_t>(one.words[i])].push_back(
            one.frames.middleRows(first, last - first));
        end = std::max(end, last);
      }
      between_until(one.frames.rows());
    }
    return sequences;
  }

  // Whether there is something to train on without the fold.
  [[nodiscard]] bool usable(int fold) const {
    const ClassSequences sequences = sequences_without(fold);
    const auto num_labels = std::count_if(sequences.begin(), sequences.end() - 1,
                                          [](const auto& words) { return !words.empty(); });
    return num_labels > 1 && !sequences.back().empty();
  }

  // Words that stand only in the fold are left out.
  [[nodiscard]] SentenceRecognizer train_without(int fold,
                                                 const SentenceRecognizerOptions& options) const {
    ClassSequences sequences = sequences_without(fold);
    require(!sequences.back().empty(), "words: all frames lie in words, none before or after them");
    const std::vector<MatrixF> between = std::move(sequences.back());
    sequences.pop_back();
    std::vector<std::string> labels;
    ClassSequences known;
    for (std::size_t c = 0; c < sequences.size(); ++c) {
      if (sequences[c].empty()) continue;
      labels.push_back(labels_[c]);
      known.push_back(std::move(sequences[c]));
    }
    detail::SignModels words = detail::train_sign_models(known, options, should_stop_);
    VectorD stays(words.final_stays.size() + 1);
    stays.head(words.final_stays.size()) = words.final_stays;
    words.hmms.push_back(train_between(between));
    double num_frames = 0;
    for (const MatrixF& frames : between) num_frames += static_cast<double>(frames.rows());
    const auto num_pieces = static_cast<double>(between.size());
    stays[stays.size() - 1] = 1 - num_pieces / (num_frames + 1);
    return {options,
            std::move(labels),
            std::move(words.hmms),
            stays,
            language_without(fold),
            codebook_without(fold),
            std::move(words.variants),
            reaches_};
  }

  // One codebook a column.
  [[nodiscard]] std::optional<MultiStreamCodebook> codebook_without(int fold) const {
    if (options_.model != SequenceModelKind::ptbhmm) return std::nullopt;
    Eigen::Index num_frames = 0;
    for (const Signed& one : sentences_) num_frames += one.fold == fold ? 0 : one.frames.rows();
    MatrixF frames(num_frames, sentences_.front().frames.cols());
    Eigen::Index next = 0;
    for (const Signed& one : sentences_) {
      if (one.fold == fold) continue;
      frames.middleRows(next, one.frames.rows()) = one.frames;
      next += one.frames.rows();
    }
    return detail::train_column_codebooks(frames, options_.num_codewords, should_stop_);
  }

  [[nodiscard]] std::shared_ptr<const NGramModel> language_without(int fold) const {
    if (options_.language_order == 0) return nullptr;
    std::vector<Sentence> texts;
    for (const Signed& one : sentences_) {
      if (one.fold != fold) texts.push_back(words_of(*one.sample));
    }
    NGramOptions options;
    options.order = options_.language_order;
    return std::make_shared<const NGramModel>(NGramModel::train(texts, options));
  }

  [[nodiscard]] GaussianMixtureHmm train_between(const std::vector<MatrixF>& sequences) const {
    GaussianMixtureHmmOptions options;
    options.topology.kind = Topology::Kind::ergodic;
    options.topology.num_states = options_.between_states;
    options.num_mixtures = options_.between_mixtures;
    options.transition_prior = 1;
    options.seed = options_.seed;
    options.should_stop = should_stop_;
    return GaussianMixtureHmm::train(sequences, options);
  }

  [[nodiscard]] std::vector<int> indices(const RecognisedSentence& sentence) const {
    std::vector<int> result;
    result.reserve(sentence.words.size());
    for (const RecognisedSign& word : sentence.words)
      result.push_back(label_index(labels_, word.label));
    return result;
  }

  // Without a language model its scale changes nothing.
  [[nodiscard]] std::size_t num_scales() const {
    return options_.choose_weights && options_.language_order > 0 ? kScales.size() : 1;
  }
  [[nodiscard]] std::size_t num_penalties() const {
    return options_.choose_weights ? kPenalties.size() : 1;
  }

  [[nodiscard]] double penalty(std::size_t p) const {
    return options_.input == SentenceInput::rows ? kPenaltiesOfRows[p] : kPenalties[p];
  }

  // Of the fold, evenly.
  [[nodiscard]] std::vector<const Signed*> enough_of(int fold) const {
    const std::size_t step = (sentences_.size() + kEnoughSentences - 1) / kEnoughSentences;
    std::vector<const Signed*> result;
    std::size_t number = 0;
    for (const Signed& one : sentences_) {
      if (one.fold == fold && number++ % step == 0) result.push_back(&one);
    }
    return result;
  }

  // Of sentences of the fold, by every weight. With variants the best of a word's models counts,
  // which scores higher than one model would: weights chosen by one model a word insert too many
  // words. Only of rows, whose gestures are long, variants would take many times as long.
  void count_errors(int fold, WeightErrors* errors) const {
    SentenceRecognizerOptions options = options_;
    if (options.input == SentenceInput::rows) options.max_variant_frames = 0;
    const SentenceRecognizer trained = train_without(fold, options);
    const std::vector<const Signed*> held_out = enough_of(fold);
    errors->num_sentences += static_cast<int>(held_out.size());
    std::vector<std::vector<SentenceRecognizer>> tried(num_penalties());
    for (std::size_t p = 0; p < num_penalties(); ++p) {
      for (std::size_t s = 0; s < num_scales(); ++s)
        tried[p].push_back(with_weights(trained, p, s));
    }
    std::vector<WeightErrors> of_sentences(held_out.size());
    detail::parallel_for(held_out.size(), should_stop_, [&](std::size_t i, const StopCheck& stop) {
      const Signed& one = *held_out[i];
      const ScoredSentence scored = trained.score(one.sample->tracks, one.sample->scale_px);
      const MatrixD of_spans = trained.score_spans(scored, one.sample->words);
      for (std::size_t s = 0; s < num_scales(); ++s) {
        of_sentences[i].known[s] = detail::num_word_errors(
            one.words, indices(tried[0][s].best_of_spans(of_spans, one.sample->words)));
        for (std::size_t p = 0; p < num_penalties(); ++p) {
          poll(stop);
          of_sentences[i].sentences[p][s] =
              detail::num_word_errors(one.words, indices(tried[p][s].recognise(scored)));
        }
      }
    });
    for (const WeightErrors& of_sentence : of_sentences) *errors += of_sentence;
  }

  [[nodiscard]] SentenceRecognizer with_weights(const SentenceRecognizer& trained, std::size_t p,
                                                std::size_t s) const {
    if (!options_.choose_weights) return trained;
    ConnectedDecoderOptions decoder = options_.decoder;
    decoder.insertion_penalty = penalty(p);
    decoder.language_scale = kScales[s];
    return trained.with_decoder(decoder).with_known_language_scale(kScales[s]);
  }

  void choose_weights(const WeightErrors& errors) {
    const auto [p, s] = errors.best();
    options_.decoder.insertion_penalty = penalty(p);
    if (options_.language_order == 0) return;
    options_.decoder.language_scale = kScales[s];
    const auto known = std::min_element(errors.known.begin(), errors.known.end());
    options_.known_language_scale = kScales[static_cast<std::size_t>(known - errors.known.begin())];
  }

  SentenceRecognizerOptions options_;
  StopCheck should_stop_;
  HandReaches reaches_;
  std::vector<std::string> labels_;
  std::vector<Signed> sentences_;
};

}  // namespace

SentenceRecognizer SentenceRecognizer::train(const std::vector<SignedSample>& samples,
                                             const SentenceRecognizerOptions& options,
                                             const TrainingProgress& progress,
                                             const StopCheck& should_stop) {
  validate(options);
  return SentenceTrainer(options, should_stop).run(samples, progress);
}

}  // namespace hri
