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

// Which words are known: all, or one half of them or the other.
std::vector<std::vector<bool>> vocabularies(std::size_t num_labels) {
  std::vector<std::vector<bool>> known(3, std::vector<bool>(num_labels, true));
  if (num_labels < 2) return {known.front()};
  for (std::size_t i = 0; i < num_labels; ++i) known[1 + i % 2][i] = false;
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
                                 const std::vector<WordString>& strings) {
  const int silence = trained.silence();
  const int unknown = trained.unknown_word();
  const int num_states = trained.models().front().num_states();
  const int rate_hz = trained.options().words.cepstra.sample_rate_hz;
  const auto known_of = vocabularies(trained.labels().size());
  std::vector<UnknownErrors> errors(strings.size());
  parallel_for(strings.size(), should_stop_, [&](std::size_t i, const StopCheck& stop) {
    errors[i] = {};
    MatrixF scores = trained.score(strings[i].audio, rate_hz).log_emissions;
    const Eigen::Index num_known = scores.cols();
    scores.conservativeResize(Eigen::NoChange, num_known + num_states);
    for (const std::vector<bool>& is_known : known_of) {
      std::vector<int> words;
      std::vector<bool> is_of_word(static_cast<std::size_t>(num_known), false);
      std::size_t state = 0;
      for (std::size_t m = 0; m < is_known.size(); ++m) {
        const int size = trained.models()[m].num_states();
        for (int s = 0; s < size; ++s) is_of_word[state++] = is_known[m];
        if (is_known[m]) words.push_back(static_cast<int>(m));
      }
      words.push_back(unknown);
      std::vector<int> said = strings[i].labels;
      for (int& word : said) {
        if (!is_known[static_cast<std::size_t>(word)]) word = unknown;
      }
      const WordNetwork network = WordNetwork::loop(words, silence);
      for (std::size_t r = 0; r < kRanks.size(); ++r) {
        score_unknown(is_of_word, kRanks[r], &scores);
        for (std::size_t p = 0; p < kUnknownPenalties.size(); ++p) {
          poll(stop);
          std::vector<WordChain> chains = trained.chains();
          chains.push_back(unknown_chain(num_states, kUnknownPenalties[p]));
          ConnectedDecoder decoder(chains, network, trained.options().decoder);
          for (Eigen::Index t = 0; t < scores.rows(); ++t) decoder.push(row_span(scores, t));
          const std::vector<int> found = labels_of(decoder.finish().words, silence);
          // Both halves together weigh as much as the whole vocabulary.
          const int weight = &is_known == &known_of.front() ? 2 : 1;
          errors[i][r][p] += weight * num_word_errors(said, found);
        }
      }
    }
  });
  for (const UnknownErrors& of_string : errors) {
    for (std::size_t r = 0; r < kRanks.size(); ++r) {
      for (std::size_t p = 0; p < kUnknownPenalties.size(); ++p)
        unknown_errors_[r][p] += of_string[r][p];
    }
  }
}

void HeldOutChoices::set_best_unknown(ConnectedWordRecognizerOptions* options) const {
  int fewest = unknown_errors_[0][0];
  options->unknown_rank = kRanks[0];
  options->unknown_penalty = kUnknownPenalties[0];
  for (std::size_t r = 0; r < kRanks.size(); ++r) {
    for (std::size_t p = 0; p < kUnknownPenalties.size(); ++p) {
      if (unknown_errors_[r][p] >= fewest) continue;
      fewest = unknown_errors_[r][p];
      options->unknown_rank = kRanks[r];
      options->unknown_penalty = kUnknownPenalties[p];
    }
  }
}

}  // namespace hri::detail
