// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Training of SubwordRecognizer, and words added to it.
#include <algorithm>
#include <utility>

#include "core/parallel_for.hpp"
#include "hri/core/error.hpp"
#include "hri/recognition/subword/subword_recognizer.hpp"
#include "recognition/recording_folds.hpp"
#include "recognition/sentence/naming.hpp"
#include "recognition/sentence/sentence_front_end.hpp"
#include "recognition/subword/bonus_choice.hpp"
#include "recognition/subword/unit_training.hpp"

namespace hri {
namespace {

using detail::SentenceFrontEnd;
using detail::UnitUtterance;

constexpr int kNoFold = -1;
constexpr int kDefaultRateHz = 16000;

using Units = std::vector<std::string>;

// A recorded word, as it is and at every warp.
struct SubwordSample {
  int label = 0;
  int fold = kNoFold;
  std::vector<UnitUtterance> copies;
};

std::string name_of(const WordSample& sample, std::size_t index) {
  return sample.name.empty() ? "samples[" + std::to_string(index) + "]" : sample.name;
}

// Frames of recordings at every warp of the filters: 1, then below and above it in turn.
class UtteranceReader {
 public:
  explicit UtteranceReader(const WordRecognizerOptions& options) {
    for (int i = 0; i < options.num_vtlp_factors; ++i) {
      const int step = (i + 1) / 2;
      front_ends_.emplace_back(options, 1 + (i % 2 == 0 ? step : -step) * options.vtlp_step);
    }
  }

  // Nothing without speech.
  [[nodiscard]] std::vector<UnitUtterance> read(const WordSample& sample, const std::string& name,
                                                const Units& units) const {
    const SentenceFrontEnd& plain = front_ends_.front();
    if (static_cast<double>(sample.samples.size()) * 1000 <
        SentenceFrontEnd::kEdgeMs * sample.sample_rate_hz / 4)
      fail(ErrorKind::invalid_argument, name + ": audio is too short");
    detail::CutSentence word;
    detail::naming(name, [&] { word = plain.cut(sample.samples, sample.sample_rate_hz); });
    std::vector<UnitUtterance> copies;
    if (word.samples.empty()) return copies;
    for (const SentenceFrontEnd& front_end : front_ends_) {
      UnitUtterance utterance{front_end.frames(word.samples), 0, units};
      const auto edge = static_cast<double>(front_end.samples_of(SentenceFrontEnd::kEdgeMs));
      while (2 * utterance.num_edge < utterance.frames.rows() &&
             front_end.middle_of(static_cast<double>(utterance.num_edge)) < edge)
        ++utterance.num_edge;
      copies.push_back(std::move(utterance));
    }
    return copies;
  }

 private:
  std::vector<SentenceFrontEnd> front_ends_;
};

htk::Dictionary entries_of(const htk::Dictionary& lexicon, const std::vector<std::string>& labels) {
  const auto by_word = lexicon.by_word();
  htk::Dictionary used;
  for (const std::string& label : labels) {
    const auto found = by_word.find(label);
    if (found == by_word.end())
      fail(ErrorKind::invalid_argument, "the lexicon has no word '" + label + "'");
    for (const int number : found->second) {
      used.entries.push_back(lexicon.entries[static_cast<std::size_t>(number)]);
      for (const std::string& unit : used.entries.back().models) {
        if (unit == UnitModels::kSilence || unit.find(SubwordRecognizer::kOwnUnit) != unit.npos)
          fail(ErrorKind::invalid_argument, "no unit of a word may be called '" + unit + "'");
      }
    }
  }
  return used;
}

class SubwordTrainer {
 public:
  SubwordTrainer(const SubwordRecognizerOptions& options, std::vector<std::string> labels,
                 const htk::Dictionary& lexicon, StopCheck should_stop)
      : options_(options),
        labels_(std::move(labels)),
        lexicon_(entries_of(lexicon, labels_)),
        should_stop_(std::move(should_stop)) {}

  SubwordRecognizer run(const std::vector<WordSample>& samples, const TrainingProgress& progress) {
    read(samples);
    const int num_speaker_folds = assign_folds(samples, options_.num_word_folds);
    const int num_word_folds = num_speaker_folds > 0 ? options_.num_word_folds : 0;
    const int num_steps = num_word_folds + (options_.num_folds > 1 ? options_.num_folds : 0) + 1;
    int done = 0;
    const auto advance = [&](int to) {
      if (progress) progress(done = to, num_steps);
    };
    advance(0);
    detail::BonusChoice bonus;
    for (int fold = 0; fold < num_word_folds; ++fold) {
      try_without_words(fold, fold % num_speaker_folds, samples, &bonus);
      advance(done + 1);
    }
    if (num_word_folds > 0) options_.unrecorded_bonus = bonus.best();
    const int num_folds = assign_folds(samples, options_.num_folds);
    std::vector<HeldOut> held_out;
    for (int fold = 0; fold < num_folds; ++fold) {
      add_held_out(fold, samples, &held_out);
      advance(done + 1);
    }
    // Every fold of speakers took the last recordings of some unit with it.
    const int num_dealt = held_out.empty() ? deal_folds(options_.num_folds) : 0;
    for (int fold = 0; fold < num_dealt; ++fold) add_held_out(fold, samples, &held_out);
    RejectionRates rates;
    rates.false_reject = options_.false_reject_rate;
    SubwordRecognizer result(options_, lexicon_,
                             detail::train_units(all_but(kNoFold), options_, should_stop_),
                             Calibration::fit(held_out, rates));
    advance(num_steps);
    return result;
  }

 private:
  void read(const std::vector<WordSample>& samples) {
    const UtteranceReader reader(options_.words);
    const auto by_word = lexicon_.by_word();
    words_.resize(samples.size());
    detail::parallel_for(samples.size(), should_stop_, [&](std::size_t i, const StopCheck&) {
      const int first = by_word.at(samples[i].label).front();
      words_[i].label = label_index(labels_, samples[i].label);
      words_[i].copies = reader.read(samples[i], name_of(samples[i], i),
                                     lexicon_.entries[static_cast<std::size_t>(first)].models);
    });
    for (std::size_t c = 0; c < labels_.size(); ++c) {
      const bool said = std::any_of(words_.begin(), words_.end(), [&](const SubwordSample& word) {
        return word.label == static_cast<int>(c) && !word.copies.empty();
      });
      if (!said)
        fail(ErrorKind::invalid_argument,
             "no recording of the label '" + labels_[c] + "' has speech in it");
    }
  }

  // Gives their number; 0 where no speaker can be held out.
  int assign_folds(const std::vector<WordSample>& samples, int most) {
    if (most < 2) return 0;
    std::vector<int> classes;
    std::vector<std::string> groups;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      classes.push_back(words_[i].label);
      groups.push_back(samples[i].group);
    }
    return set_folds(held_out_folds(classes, groups, most));
  }

  // The same by recordings, of all speakers together.
  int deal_folds(int most) {
    if (most < 2) return 0;
    std::vector<int> classes;
    classes.reserve(words_.size());
    for (const SubwordSample& word : words_) classes.push_back(word.label);
    return set_folds(detail::dealt_folds(classes, most));
  }

  int set_folds(const std::vector<int>& folds) {
    int count = 0;
    for (std::size_t i = 0; i < folds.size(); ++i) {
      words_[i].fold = folds[i];
      count = std::max(count, folds[i] + 1);
    }
    return count > 1 ? count : 0;
  }

  // Utterances of the other folds; of labels for which `leaves_out` says so none.
  template <class LeavesOut>
  [[nodiscard]] std::vector<UnitUtterance> all_but(int fold, LeavesOut&& leaves_out) const {
    std::vector<UnitUtterance> utterances;
    for (const SubwordSample& word : words_) {
      if ((fold == kNoFold || word.fold != fold) && !leaves_out(word.label))
        utterances.insert(utterances.end(), word.copies.begin(), word.copies.end());
    }
    return utterances;
  }
  [[nodiscard]] std::vector<UnitUtterance> all_but(int fold) const {
    return all_but(fold, [](int) { return false; });
  }

  // The entries whose units all have a model.
  [[nodiscard]] htk::Dictionary entries_with(const UnitModels& units) const {
    htk::Dictionary covered;
    for (const htk::Pronunciation& entry : lexicon_.entries) {
      if (std::all_of(entry.models.begin(), entry.models.end(),
                      [&](const std::string& unit) { return units.find(unit) >= 0; }))
        covered.entries.push_back(entry);
    }
    return covered;
  }

  // Calls use(label, scores) for the words of a fold that `units` can recognise.
  template <class Use>
  void score_fold(int fold, UnitModels units, const std::vector<WordSample>& samples,
                  Use&& use) const {
    htk::Dictionary lexicon = entries_with(units);
    const auto by_word = lexicon.by_word();
    if (by_word.size() < 2) return;
    const SubwordRecognizer others(options_, std::move(lexicon), std::move(units), {});
    for (std::size_t i = 0; i < samples.size(); ++i) {
      poll(should_stop_);
      if (words_[i].fold != fold || words_[i].copies.empty() ||
          by_word.count(samples[i].label) == 0)
        continue;
      use(words_[i].label, others.labels(),
          others.scores(samples[i].samples, samples[i].sample_rate_hz));
    }
  }

  // How every so many-th word, left out with the speakers of a fold, does against words that its
  // units were trained on.
  void try_without_words(int word_fold, int fold, const std::vector<WordSample>& samples,
                         detail::BonusChoice* bonus) const {
    const auto left_out = [&](int label) { return label % options_.num_word_folds == word_fold; };
    const std::vector<UnitUtterance> rest = all_but(fold, left_out);
    if (rest.empty()) return;
    score_fold(fold, detail::train_units(rest, options_, should_stop_), samples,
               [&](int truth, const std::vector<std::string>& labels, const VectorF& scores) {
                 std::vector<bool> is_new;
                 is_new.reserve(labels.size());
                 for (const std::string& label : labels)
                   is_new.push_back(left_out(label_index(labels_, label)));
                 bonus->add(scores, is_new,
                            label_index(labels, labels_[static_cast<std::size_t>(truth)]));
               });
  }

  // Folds without which a unit has no recording are passed over.
  void add_held_out(int fold, const std::vector<WordSample>& samples,
                    std::vector<HeldOut>* held_out) const {
    const std::vector<UnitUtterance> rest = all_but(fold);
    if (rest.empty()) return;
    UnitModels units = detail::train_units(rest, options_, should_stop_);
    if (entries_with(units).entries.size() != lexicon_.entries.size()) return;
    score_fold(fold, std::move(units), samples,
               [&](int truth, const std::vector<std::string>&, const VectorF& scores) {
                 HeldOut one;
                 one.scores = scores;
                 one.truth = truth;
                 one.score = scores.maxCoeff();
                 held_out->push_back(std::move(one));
               });
  }

  SubwordRecognizerOptions options_;
  std::vector<std::string> labels_;
  htk::Dictionary lexicon_;
  StopCheck should_stop_;
  std::vector<SubwordSample> words_;
};

// The models that a word is made of, in its order, under names of its own; and silence.
UnitModels own_units(const UnitModels& units, const std::string& label, const Units& word) {
  UnitModels own;
  const auto add = [&](const std::string& name, const std::string& unit) {
    const int number = units.find(unit);
    if (number < 0)
      fail(ErrorKind::invalid_argument,
           "there is no unit '" + unit + "', of the word '" + label + "'");
    own.names.push_back(name);
    own.models.push_back(units.models[static_cast<std::size_t>(number)]);
    own.final_stays.push_back(units.final_stays[static_cast<std::size_t>(number)]);
  };
  for (const std::string& unit : word)
    add(label + SubwordRecognizer::kOwnUnit + std::to_string(own.names.size()), unit);
  add(UnitModels::kSilence, UnitModels::kSilence);
  return own;
}

}  // namespace

SubwordRecognizer SubwordRecognizer::train(const std::vector<WordSample>& samples,
                                           const htk::Dictionary& lexicon,
                                           const SubwordRecognizerOptions& options,
                                           const TrainingProgress& progress,
                                           const StopCheck& should_stop) {
  SubwordRecognizerOptions used = validated(options);
  std::vector<std::string> labels;
  int& rate_hz = used.words.cepstra.sample_rate_hz;
  const bool takes_lowest = rate_hz == 0;
  if (takes_lowest) rate_hz = kDefaultRateHz;
  for (const WordSample& sample : samples) {
    labels.push_back(sample.label);
    if (takes_lowest) rate_hz = std::min(rate_hz, sample.sample_rate_hz);
  }
  return SubwordTrainer(used, sorted_labels(labels), lexicon, should_stop).run(samples, progress);
}

SubwordRecognizer SubwordRecognizer::with_word(
    const std::string& label, const std::vector<std::vector<std::string>>& pronunciations,
    const std::vector<WordSample>& samples, const StopCheck& should_stop) const {
  require(!pronunciations.empty() && !pronunciations.front().empty(),
          "an added word needs a pronunciation");
  const auto at = std::lower_bound(labels_.begin(), labels_.end(), label);
  if (at != labels_.end() && *at == label)
    fail(ErrorKind::invalid_argument, "there is a word '" + label + "' already");
  htk::Dictionary lexicon = lexicon_;
  UnitModels units = units_;
  for (const Units& pronunciation : pronunciations) {
    htk::Pronunciation entry;
    entry.word = label;
    entry.models = pronunciation;
    lexicon.entries.push_back(std::move(entry));
  }
  if (!samples.empty()) {
    UnitModels own = own_units(units_, label, pronunciations.front());
    const Units names(own.names.begin(), own.names.end() - 1);
    const UtteranceReader reader(options_.words);
    std::vector<UnitUtterance> utterances;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      auto copies = reader.read(samples[i], name_of(samples[i], i), names);
      if (copies.empty())
        fail(ErrorKind::invalid_argument, name_of(samples[i], i) + ": there is no speech in it");
      // Warped copies stand for other speakers in training; here there is no doubt who speaks.
      utterances.push_back(std::move(copies.front()));
    }
    own = detail::adapt_units(own, utterances, options_, should_stop);
    for (std::size_t u = 0; u + 1 < own.names.size(); ++u) {
      units.names.push_back(own.names[u]);
      units.models.push_back(own.models[u]);
      units.final_stays.push_back(own.final_stays[u]);
    }
    lexicon.entries[lexicon_.entries.size()].models = names;
  }
  std::vector<std::string> unrecorded = unrecorded_;
  if (samples.empty()) unrecorded.push_back(label);
  return {options_, std::move(lexicon), std::move(units),
          calibration_.with_class(static_cast<int>(at - labels_.begin())), std::move(unrecorded)};
}

}  // namespace hri
