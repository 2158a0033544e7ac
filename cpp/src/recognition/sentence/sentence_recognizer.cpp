// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/recognition/sentence/sentence_recognizer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "hri/core/error.hpp"
#include "hri/language/lattice.hpp"
#include "recognition/sentence/sentence_training.hpp"
#include "recognition/sentence/sign_models.hpp"

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

SentenceRecognizer::SentenceRecognizer(
    const SentenceRecognizerOptions& options, std::vector<std::string> labels,
    std::vector<GaussianMixtureHmm> models, const VectorD& final_stays,
    std::shared_ptr<const NGramModel> language, std::optional<MultiStreamCodebook> codebook,
    std::vector<SignVariant> variants, const HandReaches& reaches)
    : options_(validated(options)),
      labels_(std::move(labels)),
      final_stays_(final_stays),
      reaches_(reaches),
      models_(std::make_shared<const std::vector<GaussianMixtureHmm>>(std::move(models))),
      variants_(std::make_shared<const std::vector<SignVariant>>(std::move(variants))),
      language_(std::move(language)) {
  require(labels_ == sorted_labels(labels_), "labels are not sorted");
  const std::size_t num_models = this->models().size();
  require(num_models == labels_.size() + 1,
          "models must be one a label, and one of what lies between");
  require(static_cast<std::size_t>(final_stays_.size()) == num_models,
          "final_stays must have a value for each model");
  require(std::isfinite(reaches.right) && std::isfinite(reaches.left) &&
              std::min(reaches.right, reaches.left) >= 0,
          "reaches must be finite and at least 0");
  check_variants();
  emissions_ = std::make_shared<const GaussianEmissions>(make_chains());
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
  if (is_possibilistic) {
    for (WordChain& chain : chains_) chain = chain.possibilities();
  }
  const auto between = static_cast<int>(labels_.size());
  std::vector<std::vector<int>> of_words(num_models);
  for (std::size_t m = 0; m < words_.size(); ++m)
    of_words[static_cast<std::size_t>(words_[m])].push_back(static_cast<int>(m));
  const WordNetwork words = language_ != nullptr ? WordNetwork::bigram(*language_, labels_, between)
                                                 : WordNetwork::loop(between, between);
  network_ = std::make_shared<const WordNetwork>(words.with_variants(of_words));
}

void SentenceRecognizer::check_variants() const {
  int before = 0;
  Eigen::Index num_transitions = 0;
  for (const SignVariant& variant : *variants_) {
    require(variant.word >= before && static_cast<std::size_t>(variant.word) < labels_.size(),
            "variants are not in the order of the labels");
    before = variant.word;
    const GaussianMixtureHmm& word = models()[static_cast<std::size_t>(variant.word)];
    require(variant.frames.rows() > 0 && variant.frames.cols() == word.dim() &&
                variant.states.size() == static_cast<std::size_t>(variant.frames.rows()),
            "variants have frames that do not fit the models");
    const Eigen::Index length = variant.frames.rows();
    num_transitions += length * length;
    require(length <= detail::kLongestVariant && num_transitions <= detail::kMostTransitions,
            "variants are too long");
    require(variant.frames.allFinite(), "variants have frames that are not finite");
    require(std::all_of(variant.states.begin(), variant.states.end(),
                        [&word](int state) { return state >= 0 && state < word.num_states(); }),
            "variants have states that the models do not");
  }
}

// Fills chains_ and words_, and returns the models whose states are scored.
std::vector<GaussianMixtureHmm> SentenceRecognizer::make_chains() {
  std::vector<GaussianMixtureHmm> scored;
  const auto num_labels = static_cast<int>(labels_.size());
  auto variant = variants_->begin();
  for (int word = 0; word <= num_labels; ++word) {
    const GaussianMixtureHmm& model = models()[static_cast<std::size_t>(word)];
    if (variant == variants_->end() || variant->word != word) {
      const double stay = final_stays_[word];
      chains_.push_back(word < num_labels ? WordChain::of(model.chain(), stay)
                                          : between_chain(model.chain(), stay));
      scored.push_back(model);
      words_.push_back(word);
    }
    for (; variant != variants_->end() && variant->word == word; ++variant) {
      scored.push_back(detail::variant_model(*variant, model, options_));
      chains_.push_back(detail::variant_chain(scored.back().num_states()));
      words_.push_back(word);
    }
  }
  return scored;
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

// Of every frame and state; what depends on a hand that is out of view all the time is left out.
ScoredSentence SentenceRecognizer::score(ConstMatrixRefF tracks, double scale_px) const {
  const detail::SentenceFrames frames =
      detail::sentence_frames(options_, tracks, scale_px, reaches_);
  const MatrixF& features = frames.features;
  require(features.cols() == emissions_->dim(),
          "rows do not have as many columns as those that were trained on");
  MatrixF result(features.rows(), emissions_->num_states());
  if (possibilities_ != nullptr) {
    possibilities_->compute(features, frames.known_columns, result);
  } else if (frames.are_known()) {
    emissions_->compute(features, result);
  } else {
    const MatrixF known = features(Eigen::all, frames.known_columns);
    emissions_->marginal(frames.known_columns).compute(known, result);
  }
  return {std::move(result)};
}

// Has seen all frames of a sentence.
ConnectedDecoder SentenceRecognizer::decoder_behind(const ScoredSentence& scored) const {
  const MatrixF& scores = scored.log_emissions;
  ConnectedDecoder decoder(chains_, *network_, options_.decoder);
  for (Eigen::Index t = 0; t < scores.rows(); ++t) decoder.push(row_span(scores, t));
  return decoder;
}

RecognisedSentence SentenceRecognizer::recognise(ConstMatrixRefF tracks, double scale_px) const {
  return recognise(score(tracks, scale_px));
}

RecognisedSentence SentenceRecognizer::recognise(const ScoredSentence& scored) const {
  const DecodedSentence found = decoder_behind(scored).finish();
  return sentence_of(found.log_score, named(found.words));
}

RecognisedSentence SentenceRecognizer::recognise_begun(ConstMatrixRefF tracks,
                                                       double scale_px) const {
  const DecodedSentence found = decoder_behind(score(tracks, scale_px)).partial();
  return sentence_of(found.log_score, named(found.words));
}

std::vector<RecognisedSentence> SentenceRecognizer::recognise_n_best(ConstMatrixRefF tracks,
                                                                     int count,
                                                                     double scale_px) const {
  const Lattice of_variants =
      Lattice::decode(chains_, *network_, score(tracks, scale_px).log_emissions, options_.decoder);
  // Sentences differ in their words, not in the variants of these.
  std::vector<Lattice::Node> nodes = of_variants.nodes();
  for (Lattice::Node& node : nodes) {
    if (node.model != WordNetwork::kNull) node.model = words_[static_cast<std::size_t>(node.model)];
  }
  std::vector<RecognisedSentence> result;
  for (const DecodedSentence& found : Lattice(std::move(nodes), of_variants.arcs()).n_best(count))
    result.push_back(sentence_of(found.log_score, found.words));
  return result;
}

// Numbers of labels in place of those of variants.
std::vector<DecodedWord> SentenceRecognizer::named(std::vector<DecodedWord> words) const {
  for (DecodedWord& word : words) word.model = words_[static_cast<std::size_t>(word.model)];
  return words;
}

// Without what lies between the words, and without the margins that reach into it. A first and a
// last word that nothing lies beside have no margin there, and may not have ended.
RecognisedSentence SentenceRecognizer::sentence_of(double log_score,
                                                   const std::vector<DecodedWord>& words) const {
  RecognisedSentence sentence;
  sentence.log_score = log_score;
  const auto lies_between = [&](std::size_t i) {
    return i < words.size() && words[i].model == static_cast<int>(labels_.size());
  };
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (lies_between(i)) continue;
    RecognisedSign sign{labels_[static_cast<std::size_t>(words[i].model)], words[i].first_frame,
                        words[i].last_frame, words[i].log_score};
    const std::int64_t spare = std::min<std::int64_t>(options_.margin_frames,
                                                      (sign.last_frame - sign.first_frame - 1) / 2);
    if (i > 0 && lies_between(i - 1)) sign.first_frame += spare;
    if (lies_between(i + 1)) sign.last_frame -= spare;
    sentence.words.push_back(std::move(sign));
  }
  return sentence;
}

// Of every label.
VectorD SentenceRecognizer::scores_of(ConstMatrixRefF of_states) const {
  VectorD scores = VectorD::Constant(static_cast<Eigen::Index>(labels_.size()), kImpossible);
  Eigen::Index column = 0;
  for (std::size_t m = 0; m < chains_.size() && words_[m] < scores.size(); ++m) {
    const WordChain& chain = chains_[m];
    scores[words_[m]] = std::max(scores[words_[m]], best_path(chain, of_states, column));
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
  return best_of_spans(score_spans(score(tracks, scale_px), spans), spans, with_language);
}

MatrixD SentenceRecognizer::score_spans(const ScoredSentence& scored,
                                        const std::vector<SignedWordSpan>& spans) const {
  const MatrixF& of_frames = scored.log_emissions;
  require(of_frames.cols() == emissions_->num_states(),
          "the scores are those of another recogniser");
  detail::check_spans(spans, of_frames.rows());
  MatrixD scores(static_cast<Eigen::Index>(spans.size()),
                 static_cast<Eigen::Index>(labels_.size()));
  for (std::size_t i = 0; i < spans.size(); ++i) {
    const auto [first, last] =
        detail::with_margin(spans[i], options_.margin_frames, of_frames.rows());
    scores.row(static_cast<Eigen::Index>(i)) = scores_of(of_frames.middleRows(first, last - first));
  }
  return scores;
}

RecognisedSentence SentenceRecognizer::best_of_spans(const MatrixD& scores,
                                                     const std::vector<SignedWordSpan>& spans,
                                                     bool with_language) const {
  const auto n = static_cast<Eigen::Index>(labels_.size());
  require(scores.rows() == static_cast<Eigen::Index>(spans.size()) && scores.cols() == n,
          "scores must have a row for each span, and a column for each label");
  MatrixD table = MatrixD::Zero(n + 1, n + 1);
  if (with_language && language_ != nullptr) table = language_table();
  std::vector<std::vector<Eigen::Index>> previous(spans.size());
  VectorD best = VectorD::Zero(n);
  for (std::size_t i = 0; i < spans.size(); ++i) {
    VectorD next(n);
    previous[i].resize(static_cast<std::size_t>(n));
    for (Eigen::Index j = 0; j < n; ++j) {
      Eigen::Index& from = previous[i][static_cast<std::size_t>(j)];
      from = n;
      const double before = i == 0 ? table(n, j) : (best + table.col(j).head(n)).maxCoeff(&from);
      next[j] = before + scores(static_cast<Eigen::Index>(i), j);
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
