// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "recognition/sentence/held_out_choices.hpp"

#include <algorithm>
#include <cmath>

#include "core/parallel_for.hpp"
#include "recognition/sentence/sentence_training.hpp"
#include "recognition/sentence/unknown_word.hpp"

namespace hri::detail {
namespace {

constexpr std::size_t kNumParts = 3;       // of the vocabulary, taken away in turn
constexpr std::size_t kMostStrings = 100;  // of a fold, that are searched by every unknown word
constexpr double kHeldOutWeight = 0.632;
constexpr double kSurest = 0.999;  // no confidence counts as more: one error is not the end

template <class Sums, class Tried>
void add_all(const std::vector<Tried>& of_strings, Sums* sums) {
  for (const Tried& one : of_strings) {
    for (std::size_t i = 0; i < sums->size(); ++i) (*sums)[i] += one[i];
  }
}

template <class Values>
std::size_t lowest(const Values& values) {
  return static_cast<std::size_t>(std::min_element(values.begin(), values.end()) - values.begin());
}

std::vector<int> labels_of(const std::vector<DecodedWord>& words, int silence) {
  std::vector<int> labels;
  for (const DecodedWord& word : words) {
    if (word.model != silence) labels.push_back(word.model);
  }
  return labels;
}

// Whether a word of this label was said where the middle of `word` is.
bool is_right(const DecodedWord& word, const ScoredRecording& recording, const WordString& string,
              int rate_hz) {
  const double middle =
      0.5 * rate_hz *
      (recording.seconds_of(word.first_frame) + recording.seconds_of(word.last_frame));
  for (std::size_t i = 0; i < string.labels.size(); ++i) {
    if (string.labels[i] == word.model && static_cast<double>(string.firsts[i]) <= middle &&
        middle <= static_cast<double>(string.lasts[i]))
      return true;
  }
  return false;
}

// Which words are known: all, or all but a third of them, each third in turn.
std::vector<std::vector<bool>> vocabularies(std::size_t num_labels) {
  std::vector<std::vector<bool>> known(1, std::vector<bool>(num_labels, true));
  if (num_labels < 2) return known;
  for (std::size_t part = 0; part < std::min(kNumParts, num_labels); ++part) {
    known.emplace_back(num_labels, true);
    for (std::size_t i = part; i < num_labels; i += kNumParts) known.back()[i] = false;
  }
  return known;
}

}  // namespace

void HeldOutChoices::try_penalties(const ConnectedWordRecognizer& trained,
                                   const std::vector<WordString>& strings) {
  std::vector<std::array<int, kPenalties.size()>> errors(strings.size());
  const int rate_hz = trained.options().words.cepstra.sample_rate_hz;
  std::vector<ConnectedWordRecognizer> tried;
  for (const double penalty : kPenalties) {
    ConnectedDecoderOptions decoder = trained.options().decoder;
    decoder.insertion_penalty = penalty;
    tried.push_back(trained.with_decoder(decoder));
  }
  parallel_for(strings.size(), should_stop_, [&](std::size_t i, const StopCheck& stop) {
    const ScoredRecording recording = trained.score(strings[i].audio, rate_hz);
    for (std::size_t p = 0; p < tried.size(); ++p) {
      poll(stop);
      std::vector<int> found;
      for (const TranscribedWord& word : tried[p].recognise(recording, {0, 0, false}).words)
        found.push_back(label_index(trained.labels(), word.label));
      errors[i][p] = num_word_errors(strings[i].labels, found);
    }
  });
  add_all(errors, &penalty_errors_);
}

double HeldOutChoices::best_penalty() const { return kPenalties[lowest(penalty_errors_)]; }

void HeldOutChoices::try_scales(const ConnectedWordRecognizer& trained,
                                const std::vector<WordString>& strings) {
  std::vector<std::array<double, kScales.size()>> losses(strings.size());
  const int rate_hz = trained.options().words.cepstra.sample_rate_hz;
  parallel_for(strings.size(), should_stop_, [&](std::size_t i, const StopCheck& stop) {
    poll(stop);
    losses[i].fill(0);
    const ScoredRecording recording = trained.score(strings[i].audio, rate_hz);
    const Lattice lattice = trained.lattice(recording);
    const std::vector<DecodedWord> words = lattice.best().words;
    for (std::size_t s = 0; s < kScales.size(); ++s) {
      const std::vector<double> confidences = lattice.confidences(words, kScales[s]);
      for (std::size_t w = 0; w < words.size(); ++w) {
        if (words[w].model == trained.silence()) continue;
        const double sure = std::clamp(confidences[w], 1 - kSurest, kSurest);
        losses[i][s] -=
            std::log(is_right(words[w], recording, strings[i], rate_hz) ? sure : 1 - sure);
      }
    }
  });
  add_all(losses, &scale_losses_);
}

double HeldOutChoices::best_scale() const { return kScales[lowest(scale_losses_)]; }

void HeldOutChoices::try_unknown(const ConnectedWordRecognizer& trained,
                                 const std::vector<WordString>& strings, bool is_held_out) {
  const std::size_t num_tried = std::min(strings.size(), kMostStrings);
  const auto tried = [&](std::size_t i) -> const WordString& {
    return strings[i * strings.size() / num_tried];
  };
  const int rank = trained.options().unknown_rank;
  const int num_silence = trained.models().back().num_states();
  std::vector<UnknownBackground> backgrounds(num_tried);
  parallel_for(num_tried, should_stop_, [&](std::size_t i, const StopCheck& stop) {
    poll(stop);
    MatrixF fillers;
    const MatrixF scores = trained.score_models(tried(i).audio, &fillers).log_emissions;
    backgrounds[i] =
        unknown_background(scores, trained.states_of_words(), num_silence, fillers, rank);
  });
  double lead_sum = 0;
  double num_speech = 0;
  for (const UnknownBackground& of_string : backgrounds) {
    lead_sum += of_string.lead_sum;
    num_speech += static_cast<double>(of_string.num_speech);
  }
  if (num_speech == 0) return;
  std::vector<MarginErrors> errors(num_tried);
  parallel_for(num_tried, should_stop_, [&](std::size_t i, const StopCheck& stop) {
    errors[i] = margin_errors(trained, tried(i), lead_sum / num_speech, stop);
  });
  const double weight = is_held_out ? kHeldOutWeight : 1 - kHeldOutWeight;
  lead_sum_ += weight * lead_sum;
  num_speech_ += weight * num_speech;
  for (const MarginErrors& of_string : errors) {
    for (std::size_t m = 0; m < kMargins.size(); ++m) margin_errors_[m] += weight * of_string[m];
  }
}

HeldOutChoices::MarginErrors HeldOutChoices::margin_errors(const ConnectedWordRecognizer& trained,
                                                           const WordString& string, double lead,
                                                           const StopCheck& stop) {
  const int silence = trained.silence();
  const int unknown = trained.unknown_word();
  const int num_silence = trained.models().back().num_states();
  std::vector<WordChain> chains = trained.chains();
  const int num_states = mean_word_length(trained.models(), trained.final_stays());
  chains.push_back(unknown_chain(num_states));
  MatrixF fillers;
  const MatrixF of_models = trained.score_models(string.audio, &fillers).log_emissions;
  MatrixF scores(of_models.rows(), of_models.cols() + num_states);
  scores.leftCols(of_models.cols()) = of_models;
  MarginErrors errors{};
  const auto known_of = vocabularies(trained.labels().size());
  for (const std::vector<bool>& is_known : known_of) {
    std::vector<int> words;
    std::vector<bool> is_of_word(static_cast<std::size_t>(of_models.cols()), false);
    std::size_t state = 0;
    for (std::size_t m = 0; m < is_known.size(); ++m) {
      const int size = trained.models()[m].num_states();
      for (int s = 0; s < size; ++s) is_of_word[state++] = is_known[m];
      if (is_known[m]) words.push_back(static_cast<int>(m));
    }
    words.push_back(unknown);
    std::vector<int> said = string.labels;
    for (int& word : said) {
      if (!is_known[static_cast<std::size_t>(word)]) word = unknown;
    }
    // The whole vocabulary weighs as much as all that miss a part.
    const bool is_whole = &is_known == &known_of.front();
    const int weight = is_whole ? std::max(1, static_cast<int>(known_of.size()) - 1) : 1;
    ConnectedDecoder decoder(chains, WordNetwork::loop(words, silence), trained.options().decoder);
    const UnknownBackground background = unknown_background(
        of_models, is_of_word, num_silence, fillers, trained.options().unknown_rank);
    for (std::size_t m = 0; m < kMargins.size(); ++m) {
      poll(stop);
      scores.rightCols(num_states).colwise() = background.scores(lead, kMargins[m] * lead);
      for (Eigen::Index t = 0; t < scores.rows(); ++t) decoder.push(row_span(scores, t));
      const std::vector<int> found = labels_of(decoder.finish().words, silence);
      errors[m] += weight * num_word_errors(said, found);
    }
  }
  return errors;
}

void HeldOutChoices::set_best_unknown(ConnectedWordRecognizerOptions* options) const {
  if (num_speech_ == 0) return;
  options->unknown_lead = lead_sum_ / num_speech_;
  options->unknown_margin = kMargins[lowest(margin_errors_)] * options->unknown_lead;
}

}  // namespace hri::detail
