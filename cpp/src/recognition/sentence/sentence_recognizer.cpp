// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/recognition/sentence/sentence_recognizer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "hri/core/error.hpp"
#include "recognition/sentence/sentence_training.hpp"

namespace hri {
namespace {

constexpr double kImpossible = -std::numeric_limits<double>::infinity();
// Of a word with more states than frames, whose last states were not reached.
constexpr double kUnfinished = -1000;

// What lies between words begins and ends in any of its states.
WordChain between_chain(const MarkovChain& chain, double stay) {
  require(stay > 0 && stay < 1, "final_stays must lie in 0..1");
  WordChain result;
  result.log_start = chain.log_start();
  result.log_transition = chain.transition().unaryExpr(
      [stay](double a) { return a > 0 ? std::log(a * stay) : kImpossible; });
  result.log_exit = VectorD::Constant(chain.num_states(), std::log(1 - stay));
  result.is_silence = true;
  return result;
}

// The best path of a word through frames whose states have the scores from `column` on.
double best_path(const WordChain& chain, ConstMatrixRefF log_emissions, Eigen::Index column) {
  const Eigen::Index n = chain.log_start.size();
  VectorD best =
      chain.log_start + log_emissions.row(0).segment(column, n).transpose().cast<double>();
  VectorD next(n);
  for (Eigen::Index t = 1; t < log_emissions.rows(); ++t) {
    for (Eigen::Index j = 0; j < n; ++j)
      next[j] = (best + chain.log_transition.col(j)).maxCoeff() + log_emissions(t, column + j);
    best.swap(next);
  }
  const double finished = (best + chain.log_exit).maxCoeff();
  return finished > kImpossible ? finished : best.maxCoeff() + kUnfinished;
}

}  // namespace

std::string RecognisedSentence::text() const {
  std::string text;
  for (const RecognisedSign& word : words) text += (text.empty() ? "" : " ") + word.label;
  return text;
}

SentenceRecognizer::SentenceRecognizer(const SentenceRecognizerOptions& options,
                                       std::vector<std::string> labels,
                                       std::vector<GaussianMixtureHmm> models,
                                       const VectorD& final_stays,
                                       std::shared_ptr<const NGramModel> language,
                                       std::optional<MultiStreamCodebook> codebook)
    : options_(validated(options)),
      labels_(std::move(labels)),
      final_stays_(final_stays),
      emissions_(std::make_shared<const GaussianEmissions>(std::move(models))),
      language_(std::move(language)) {
  require(labels_ == sorted_labels(labels_), "labels are not sorted");
  const std::size_t num_models = this->models().size();
  require(num_models == labels_.size() + 1,
          "models must be one a label, and one of what lies between");
  require(static_cast<std::size_t>(final_stays_.size()) == num_models,
          "final_stays must have a value for each model");
  const bool are_tracks = options_.input == SentenceInput::tracks;
  require(are_tracks ? emissions_->dim() == TwoHandFeatureComputer(options_.features).num_features()
                     : emissions_->dim() % (1 + options_.features.delta_orders) == 0,
          "the models and the options differ in their features");
  const bool is_possibilistic = options_.model == SequenceModelKind::ptbhmm;
  require(codebook.has_value() == is_possibilistic,
          "there must be a codebook exactly where model is ptbhmm");
  if (is_possibilistic) {
    possibilities_ = std::make_shared<const CodedPossibilities>(*emissions_, std::move(*codebook));
  }
  require((language_ == nullptr) == (options_.language_order == 0),
          "there must be a language model exactly where language_order is not 0");
  for (std::size_t m = 0; m < num_models; ++m) {
    const MarkovChain& chain = this->models()[m].chain();
    const double stay = final_stays_[static_cast<Eigen::Index>(m)];
    WordChain states = m + 1 < num_models ? WordChain::of(chain, stay) : between_chain(chain, stay);
    chains_.push_back(is_possibilistic ? states.possibilities() : std::move(states));
  }
  const auto between = static_cast<int>(labels_.size());
  network_ = std::make_shared<const WordNetwork>(
      language_ != nullptr ? WordNetwork::bigram(*language_, labels_, between)
                           : WordNetwork::loop(between, between));
}

SentenceRecognizer SentenceRecognizer::with_decoder(const ConnectedDecoderOptions& decoder) const {
  SentenceRecognizer result = *this;
  result.options_.decoder = validated(decoder);
  return result;
}

SentenceRecognizer SentenceRecognizer::with_known_language_scale(double scale) const {
  SentenceRecognizer result = *this;
  result.options_.known_language_scale = scale;
  validate(result.options_);
  return result;
}

MatrixF SentenceRecognizer::frames_of(ConstMatrixRefF tracks, double scale_px) const {
  MatrixF frames = detail::sentence_frames(options_, tracks, scale_px);
  require(frames.cols() == emissions_->dim(),
          "rows do not have as many columns as those that were trained on");
  return frames;
}

MatrixF SentenceRecognizer::log_emissions(ConstMatrixRefF frames) const {
  MatrixF result(frames.rows(), emissions_->num_states());
  if (possibilities_ != nullptr) {
    possibilities_->compute(frames, result);
  } else {
    emissions_->compute(frames, result);
  }
  return result;
}

// Has seen all frames of a sentence.
ConnectedDecoder SentenceRecognizer::decoder_behind(ConstMatrixRefF tracks, double scale_px) const {
  const MatrixF scores = log_emissions(frames_of(tracks, scale_px));
  ConnectedDecoder decoder(chains_, *network_, options_.decoder);
  for (Eigen::Index t = 0; t < scores.rows(); ++t) decoder.push(row_span(scores, t));
  return decoder;
}

RecognisedSentence SentenceRecognizer::recognise(ConstMatrixRefF tracks, double scale_px) const {
  return sentence_of(decoder_behind(tracks, scale_px).finish());
}

RecognisedSentence SentenceRecognizer::recognise_begun(ConstMatrixRefF tracks,
                                                       double scale_px) const {
  return sentence_of(decoder_behind(tracks, scale_px).partial());
}

// Without what lies between the words.
RecognisedSentence SentenceRecognizer::sentence_of(const DecodedSentence& decoded) const {
  RecognisedSentence sentence;
  sentence.log_score = decoded.log_score;
  for (const DecodedWord& word : decoded.words) {
    if (word.model == static_cast<int>(labels_.size())) continue;
    sentence.words.push_back({labels_[static_cast<std::size_t>(word.model)], word.first_frame,
                              word.last_frame, word.log_score});
  }
  return sentence;
}

// Of every label.
VectorD SentenceRecognizer::scores_of(ConstMatrixRefF frames) const {
  const MatrixF of_states = log_emissions(frames);
  VectorD scores(static_cast<Eigen::Index>(labels_.size()));
  Eigen::Index column = 0;
  for (Eigen::Index m = 0; m < scores.size(); ++m) {
    const WordChain& chain = chains_[static_cast<std::size_t>(m)];
    scores[m] = best_path(chain, of_states, column);
    column += chain.log_start.size();
  }
  return scores;
}

// Scaled log P(column | row); behind the labels the beginning of a sentence and its end.
MatrixD SentenceRecognizer::language_table() const {
  const auto n = static_cast<Eigen::Index>(labels_.size());
  std::vector<int> words;
  words.reserve(labels_.size());
  for (const std::string& label : labels_) words.push_back(language_->index_of(label));
  MatrixD table(n + 1, n + 1);
  for (Eigen::Index i = 0; i <= n; ++i) {
    const int before = i < n ? words[static_cast<std::size_t>(i)] : language_->start();
    const Span<const int> history(&before, language_->order() > 1 ? 1 : 0);
    for (Eigen::Index j = 0; j <= n; ++j) {
      const int word = j < n ? words[static_cast<std::size_t>(j)] : language_->end();
      table(i, j) = options_.known_language_scale * language_->log_probability(history, word);
    }
  }
  return table;
}

RecognisedSentence SentenceRecognizer::recognise_spans(ConstMatrixRefF tracks,
                                                       const std::vector<SignedWordSpan>& spans,
                                                       double scale_px, bool with_language) const {
  const MatrixF frames = frames_of(tracks, scale_px);
  detail::check_spans(spans, frames.rows());
  const auto n = static_cast<Eigen::Index>(labels_.size());
  MatrixD table = MatrixD::Zero(n + 1, n + 1);
  if (with_language && language_ != nullptr) table = language_table();
  std::vector<std::vector<Eigen::Index>> previous(spans.size());
  MatrixD scores(static_cast<Eigen::Index>(spans.size()), n);
  VectorD best = VectorD::Zero(n);
  for (std::size_t i = 0; i < spans.size(); ++i) {
    const SignedWordSpan& span = spans[i];
    const VectorD own =
        scores_of(frames.middleRows(span.first_frame, span.last_frame - span.first_frame));
    scores.row(static_cast<Eigen::Index>(i)) = own;
    VectorD next(n);
    previous[i].resize(static_cast<std::size_t>(n));
    for (Eigen::Index j = 0; j < n; ++j) {
      Eigen::Index& from = previous[i][static_cast<std::size_t>(j)];
      from = n;
      const double before = i == 0 ? table(n, j) : (best + table.col(j).head(n)).maxCoeff(&from);
      next[j] = before + own[j];
    }
    best.swap(next);
  }
  RecognisedSentence sentence;
  if (spans.empty()) return sentence;
  Eigen::Index word = 0;
  sentence.log_score = (best + table.col(n).head(n)).maxCoeff(&word);
  for (std::size_t i = spans.size(); i-- > 0;) {
    sentence.words.push_back({labels_[static_cast<std::size_t>(word)], spans[i].first_frame,
                              spans[i].last_frame, scores(static_cast<Eigen::Index>(i), word)});
    word = previous[i][static_cast<std::size_t>(word)];
  }
  std::reverse(sentence.words.begin(), sentence.words.end());
  return sentence;
}

}  // namespace hri
