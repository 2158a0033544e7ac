// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "recognition/sentence/held_out_choices.hpp"

#include <algorithm>
#include <cmath>

#include "core/parallel_for.hpp"
#include "recognition/sentence/embedding_rescorer.hpp"
#include "recognition/sentence/sentence_training.hpp"
#include "recognition/sentence/unknown_word.hpp"

namespace hri::detail {
namespace {

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

int word_errors(const ConnectedWordRecognizer& trained, const ScoredRecording& recording,
                const WordString& string) {
  std::vector<int> found;
  for (const TranscribedWord& word : trained.recognise(recording, {0, 0, false}).words)
    found.push_back(label_index(trained.labels(), word.label));
  return num_word_errors(string.labels, found);
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
    const ScoredRecording recording = trained.score_begun(strings[i].audio, rate_hz);
    for (std::size_t p = 0; p < tried.size(); ++p) {
      poll(stop);
      errors[i][p] = word_errors(tried[p], recording, strings[i]);
    }
  });
  add_all(errors, &penalty_errors_);
}

double HeldOutChoices::best_penalty() const { return kPenalties[lowest(penalty_errors_)]; }

void HeldOutChoices::try_weights(const ConnectedWordRecognizer& trained,
                                 const std::vector<WordString>& strings) {
  std::vector<std::array<int, kWeights.size()>> errors(strings.size());
  const int rate_hz = trained.options().words.cepstra.sample_rate_hz;
  parallel_for(strings.size(), should_stop_, [&](std::size_t i, const StopCheck& stop) {
    errors[i].fill(0);
    std::vector<float> recorded;
    const ScoredRecording cepstra = trained.score_cepstra(strings[i].audio, rate_hz, &recorded);
    if (cepstra.log_emissions.rows() == 0) return;
    const std::vector<RescoredSpan> spans = trained.spans_of(cepstra, recorded);
    for (std::size_t w = 0; w < kWeights.size(); ++w) {
      poll(stop);
      ScoredRecording both = cepstra;
      EmbeddingRescorer::rescore(spans, kWeights[w], trained.chains(), &both.log_emissions);
      errors[i][w] = word_errors(trained, both, strings[i]);
    }
  });
  add_all(errors, &weight_errors_);
}

double HeldOutChoices::best_weight() const { return kWeights[lowest(weight_errors_)]; }

void HeldOutChoices::try_scales(const ConnectedWordRecognizer& trained,
                                const std::vector<WordString>& strings) {
  std::vector<std::array<double, kScales.size()>> losses(strings.size());
  const int rate_hz = trained.options().words.cepstra.sample_rate_hz;
  parallel_for(strings.size(), should_stop_, [&](std::size_t i, const StopCheck& stop) {
    poll(stop);
    losses[i].fill(0);
    const ScoredRecording recording = trained.score(strings[i].audio, rate_hz);
    if (!Lattice::fits(trained.chains(), *trained.network(0), recording.log_emissions.rows()))
      return;
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

void HeldOutChoices::add_leads(const ConnectedWordRecognizer& trained,
                               const std::vector<WordString>& strings, bool is_held_out) {
  const int num_silence = trained.models().back().num_states();
  std::vector<UnknownBackground> backgrounds(strings.size());
  parallel_for(strings.size(), should_stop_, [&](std::size_t i, const StopCheck& stop) {
    poll(stop);
    MatrixF fillers;
    const MatrixF scores =
        trained
            .score_models(strings[i].audio, trained.options().words.cepstra.sample_rate_hz,
                          &fillers, nullptr)
            .log_emissions;
    backgrounds[i] = unknown_background(scores, trained.states_of_words(), num_silence, fillers,
                                        trained.options().unknown_rank);
  });
  const double weight = is_held_out ? kHeldOutWeight : 1 - kHeldOutWeight;
  for (const UnknownBackground& of_string : backgrounds) {
    lead_sum_ += weight * of_string.lead_sum;
    num_speech_ += weight * static_cast<double>(of_string.num_speech);
  }
}

double HeldOutChoices::expected_lead() const {
  return num_speech_ > 0 ? lead_sum_ / num_speech_ : 0;
}

}  // namespace hri::detail
