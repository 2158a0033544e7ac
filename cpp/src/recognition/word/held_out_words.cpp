// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "recognition/word/held_out_words.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "recognition/word/word_threshold.hpp"

namespace hri::detail {
namespace {

template <class T>
void move_behind(std::vector<T>* list, std::vector<T>* more) {
  std::move(more->begin(), more->end(), std::back_inserter(*list));
}

Eigen::Index argmax(const VectorF& scores) {
  Eigen::Index best = 0;
  scores.maxCoeff(&best);
  return best;
}

}  // namespace

void HeldOutWords::add_word(const StreamFrames& frames, int label, const std::string& group,
                            bool as_recorded, const MultiStreamScorer& scorer) {
  using Kind = VerifierExample::Kind;
  const VectorF scores = scorer.scores(frames);
  const WordEvidence evidence = WordVerifier::evidence(scorer, frames, scores);
  const VectorD features = WordVerifier::features(scorer, frames, evidence);
  decisions_.push_back({scores, label, 0});
  features_.push_back(features);
  as_recorded_.push_back(as_recorded);
  if (argmax(scores) == label) examples_.push_back({features, Kind::word});
  // Of two words neither can be left out.
  if (scores.size() <= 2) return;
  as_unknown_.push_back(WordVerifier::features(scorer, frames, evidence, label));
  examples_.push_back({as_unknown_.back(), Kind::other_word});
  words_left_out_.emplace(label, group);
}

void HeldOutWords::add_non_word(const StreamFrames& frames, VerifierExample::Kind kind,
                                const MultiStreamScorer& scorer) {
  const WordEvidence evidence = WordVerifier::evidence(scorer, frames, scorer.scores(frames));
  examples_.push_back({WordVerifier::features(scorer, frames, evidence), kind});
}

void HeldOutWords::append(HeldOutWords more) {
  move_behind(&decisions_, &more.decisions_);
  move_behind(&features_, &more.features_);
  as_recorded_.insert(as_recorded_.end(), more.as_recorded_.begin(), more.as_recorded_.end());
  move_behind(&as_unknown_, &more.as_unknown_);
  move_behind(&examples_, &more.examples_);
  words_left_out_.merge(more.words_left_out_);
}

Judgement HeldOutWords::judge(const WordRecognizerOptions& options,
                              const std::vector<std::string>& labels,
                              const MultiStreamScorer& scorer) {
  Judgement result;
  const auto num_words = static_cast<int>(words_left_out_.size());
  result.verifier =
      WordVerifier::fit(examples_, WordVerifier::features_of_words(scorer, num_words));
  for (std::size_t i = 0; i < decisions_.size(); ++i)
    decisions_[i].score = result.verifier.verification_score(features_[i]);
  std::vector<float> others;
  others.reserve(as_unknown_.size());
  for (const VectorD& features : as_unknown_)
    others.push_back(result.verifier.verification_score(features));
  RejectionRates rates;
  rates.false_reject = false_reject_rate(options, others);
  result.calibration = Calibration::fit(decisions_, rates);
  result.report = report(labels, others, result.calibration);
  return result;
}

// The share of right decisions to reject, noisy copies included. Without an embedding other words
// pass at any threshold that leaves the right ones. With one, both shares count, of words as they
// were recorded: other words are mostly heard as clearly as those of the vocabulary.
double HeldOutWords::false_reject_rate(const WordRecognizerOptions& options,
                                       const std::vector<float>& others) const {
  if (!has_embedding(options.front_end) || others.empty()) return options.false_reject_rate;
  std::vector<float> right;
  std::vector<float> right_as_recorded;
  std::vector<float> others_as_recorded;
  for (std::size_t i = 0; i < decisions_.size(); ++i) {
    const HeldOut& decision = decisions_[i];
    const bool is_right = argmax(decision.scores) == decision.truth;
    if (is_right) right.push_back(decision.score);
    if (!as_recorded_[i]) continue;
    if (is_right) right_as_recorded.push_back(decision.score);
    others_as_recorded.push_back(others[i]);
  }
  if (right_as_recorded.empty()) return options.false_reject_rate;
  const float threshold =
      balanced_threshold(std::move(right_as_recorded), std::move(others_as_recorded),
                         options.false_reject_rate, options.embedding_false_accept_rate);
  const auto num_below =
      std::count_if(right.begin(), right.end(), [&](float score) { return score < threshold; });
  // Half a decision more, so that rounding leaves the threshold at one of them.
  return std::min(0.5, (static_cast<double>(num_below) + 0.5) / static_cast<double>(right.size()));
}

// Of words as they were recorded, whatever the calibration learned from besides.
HeldOutReport HeldOutWords::report(const std::vector<std::string>& labels,
                                   const std::vector<float>& others,
                                   const Calibration& calibration) const {
  std::vector<HeldOut> decisions;
  std::vector<float> others_as_recorded;
  for (std::size_t i = 0; i < decisions_.size(); ++i) {
    if (!as_recorded_[i]) continue;
    decisions.push_back(decisions_[i]);
    if (i < others.size()) others_as_recorded.push_back(others[i]);
  }
  return HeldOutReport::from_decisions(labels, decisions, others_as_recorded, calibration);
}

}  // namespace hri::detail
