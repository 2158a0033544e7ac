// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/recognition/sentence/connected_word_recognizer.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "hri/core/error.hpp"
#include "recognition/sentence/embedding_rescorer.hpp"
#include "recognition/sentence/sentence_front_end.hpp"
#include "recognition/sentence/unknown_word.hpp"
#include "recognition/sentence/word_times.hpp"

namespace hri {
namespace {

constexpr int kMaxLength = 1000;

ConnectedWordRecognizerOptions with_rate(ConnectedWordRecognizerOptions options) {
  require(options.words.cepstra.sample_rate_hz != 0, "words.cepstra.sample_rate_hz is not set");
  return options;
}

}  // namespace

const char* ConnectedWordRecognizerOptions::conflict() const {
  if (words.front_end == FrontEndKind::embedding)
    return "words.front_end must be cepstra or both: an embedding does not say where words lie";
  if (words.use_network) return "words.use_network must be false";
  return nullptr;
}

std::string Transcript::text() const {
  std::string text;
  for (const TranscribedWord& word : words) {
    text += text.empty() ? "" : " ";
    text += word.unknown ? TranscribedWord::kUnknown : word.label;
  }
  return text;
}

ConnectedWordRecognizer::ConnectedWordRecognizer(const ConnectedWordRecognizerOptions& options,
                                                 std::vector<std::string> labels,
                                                 std::vector<GaussianMixtureHmm> models,
                                                 const VectorD& final_stays,
                                                 std::optional<MultiStreamCodebook> codebook,
                                                 FillerModels fillers,
                                                 std::optional<EmbeddedWords> embedded)
    : options_(with_rate(validated(options))),
      labels_(std::move(labels)),
      final_stays_(final_stays),
      front_end_(std::make_shared<const detail::SentenceFrontEnd>(options.words)),
      times_(std::make_shared<const detail::WordTimes>(front_end_->sample_rate_hz(),
                                                       options_.words.activity)),
      emissions_(std::make_shared<const GaussianEmissions>(std::move(models))) {
  require(labels_ == sorted_labels(labels_), "labels are not sorted");
  check_labels(labels_);
  const std::size_t num_models = this->models().size();
  require(num_models == labels_.size() + 1, "models must be one a label, and one of silence");
  require(static_cast<std::size_t>(final_stays_.size()) == num_models,
          "final_stays must have a value for each model");
  require(emissions_->dim() == front_end_->num_features(),
          "the models and the front end differ in their features");
  const bool is_possibilistic = options_.words.model == SequenceModelKind::ptbhmm;
  require(codebook.has_value() == is_possibilistic,
          "there must be a codebook exactly where words.model is ptbhmm");
  if (!fillers.empty()) {
    fillers_ = std::make_shared<const GaussianEmissions>(std::move(fillers));
    require(fillers_->dim() == emissions_->dim(), "fillers and models differ in their features");
  }
  if (is_possibilistic) {
    if (fillers_ != nullptr)
      filler_possibilities_ = std::make_shared<const CodedPossibilities>(*fillers_, *codebook);
    possibilities_ = std::make_shared<const CodedPossibilities>(*emissions_, std::move(*codebook));
  }
  require(embedded.has_value() == has_embedding(options_.words.front_end),
          "there must be a speech embedding exactly where words.front_end is both");
  if (embedded.has_value()) {
    require(embedded->embedding != nullptr, "the speech embedding is missing");
    const int beyond = embedded->classifier.num_classes() - static_cast<int>(labels_.size());
    require(embedded->classifier.dim() == embedded->embedding->vector_size() &&
                (beyond == 0 || beyond == 1),
            "the classifier does not fit the speech embedding and the labels");
    rescorer_ = std::make_shared<const detail::EmbeddingRescorer>(std::move(*embedded));
  }
  for (std::size_t m = 0; m < num_models; ++m) {
    WordChain chain = WordChain::of(
        this->models()[m].chain(), final_stays_[static_cast<Eigen::Index>(m)], m + 1 == num_models);
    chains_.push_back(is_possibilistic ? chain.possibilities() : std::move(chain));
  }
  if (options_.unknown_words) {
    chains_.push_back(
        detail::unknown_chain(detail::mean_word_length(this->models(), final_stays_)));
  }
  std::vector<int> words(labels_.size());
  std::iota(words.begin(), words.end(), 0);
  if (options_.unknown_words) words.push_back(unknown_word());
  any_words_ = std::make_shared<const WordNetwork>(WordNetwork::loop(words, silence()));
  sentences_ = any_words_;
}

void ConnectedWordRecognizer::check_labels(const std::vector<std::string>& labels) {
  for (const char* reserved : {TranscribedWord::kUnknown, TranscribedWord::kSilence}) {
    if (std::find(labels.begin(), labels.end(), reserved) == labels.end()) continue;
    fail(ErrorKind::invalid_argument,
         std::string("labels: '") + reserved + "' stands for no word of a vocabulary");
  }
}

ConnectedWordRecognizer ConnectedWordRecognizer::with_language(NGramModel language) const {
  ConnectedWordRecognizer result = *this;
  result.sentences_ =
      std::make_shared<const WordNetwork>(WordNetwork::bigram(language, labels_, silence()));
  result.language_ = std::make_shared<const NGramModel>(std::move(language));
  result.grammar_ = nullptr;
  return result;
}

ConnectedWordRecognizer ConnectedWordRecognizer::with_grammar(Grammar grammar) const {
  ConnectedWordRecognizer result = *this;
  result.sentences_ = std::make_shared<const WordNetwork>(grammar.network(
      labels_, silence(), options_.unknown_words ? unknown_word() : WordNetwork::kNull));
  result.grammar_ = std::make_shared<const Grammar>(std::move(grammar));
  result.language_ = nullptr;
  return result;
}

ConnectedWordRecognizer ConnectedWordRecognizer::with_decoder(
    const ConnectedDecoderOptions& decoder) const {
  ConnectedWordRecognizer result = *this;
  result.options_.decoder = validated(decoder);
  return result;
}

ConnectedWordRecognizer ConnectedWordRecognizer::with_embedding_weight(double weight) const {
  ConnectedWordRecognizer result = *this;
  result.options_.words.embedding_weight = weight;
  validate(result.options_);
  return result;
}

std::shared_ptr<const WordNetwork> ConnectedWordRecognizer::network(int num_words) const {
  if (num_words == 0) return sentences_;
  const auto num_labels = static_cast<int>(labels_.size());
  return std::make_shared<const WordNetwork>(
      WordNetwork::sequence(num_labels, num_words, silence()));
}

double ScoredRecording::seconds_of(std::int64_t frame) const {
  return std::max(0.0, first_s + static_cast<double>(frame) * frame_s);
}

ScoredRecording ConnectedWordRecognizer::score(Span<const float> audio, int sample_rate_hz) const {
  std::vector<float> recorded;
  ScoredRecording recording = score_cepstra(audio, sample_rate_hz, &recorded);
  if (rescorer_ == nullptr || recording.log_emissions.rows() == 0) return recording;
  detail::EmbeddingRescorer::rescore(spans_of(recording, recorded), options_.words.embedding_weight,
                                     chains_, &recording.log_emissions);
  return recording;
}

ScoredRecording ConnectedWordRecognizer::score_begun(Span<const float> audio,
                                                     int sample_rate_hz) const {
  return score_cepstra(audio, sample_rate_hz, nullptr);
}

ScoredRecording ConnectedWordRecognizer::score_cepstra(Span<const float> audio, int sample_rate_hz,
                                                       std::vector<float>* recorded) const {
  MatrixF fillers;
  ScoredRecording recording =
      score_models(audio, sample_rate_hz, options_.unknown_words ? &fillers : nullptr, recorded);
  MatrixF& scores = recording.log_emissions;
  if (!options_.unknown_words || scores.rows() == 0) return recording;
  const VectorF unknown =
      detail::unknown_background(scores, states_of_words(), models().back().num_states(), fillers,
                                 options_.unknown_rank)
          .scores(options_.unknown_lead, options_.unknown_margin * options_.unknown_lead);
  const Eigen::Index num_states = chains_.back().log_start.size();
  scores.conservativeResize(Eigen::NoChange, scores.cols() + num_states);
  scores.rightCols(num_states).colwise() = unknown;
  return recording;
}

std::vector<detail::RescoredSpan> ConnectedWordRecognizer::spans_of(
    const ScoredRecording& recording, Span<const float> recorded) const {
  const MatrixF& scores = recording.log_emissions;
  ConnectedDecoder decoder(chains_, *any_words_, options_.decoder);
  for (Eigen::Index t = 0; t < scores.rows(); ++t) decoder.push(row_span(scores, t));
  std::vector<DecodedWord> words = decoder.finish().words;
  words.erase(std::remove_if(words.begin(), words.end(),
                             [this](const DecodedWord& w) { return w.model == silence(); }),
              words.end());
  const std::vector<TranscribedWord> timed = words_of(words, recording);
  const int rate_hz = front_end_->sample_rate_hz();
  const auto sample_of = [&](double time_s) {
    return static_cast<std::ptrdiff_t>((time_s - recording.activity_first_s) * rate_hz);
  };
  std::vector<detail::RescoredSpan> spans;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const VectorF named = rescorer_->scores(recorded, rate_hz, sample_of(timed[i].first_s),
                                            sample_of(timed[i].last_s));
    const auto of_words = named.head(silence());
    const float best = options_.unknown_words ? named.maxCoeff() : of_words.maxCoeff();
    spans.push_back({words[i].first_frame, words[i].last_frame, of_words.array() - best});
  }
  return spans;
}

ScoredRecording ConnectedWordRecognizer::score_models(Span<const float> audio, int sample_rate_hz,
                                                      MatrixF* fillers,
                                                      std::vector<float>* recorded) const {
  detail::CutSentence sentence = front_end_->cut(audio, sample_rate_hz);
  ScoredRecording recording;
  recording.notes = std::move(sentence.notes);
  const double rate_hz = front_end_->sample_rate_hz();
  // A frame begins in the middle between two.
  recording.first_s =
      (static_cast<double>(sentence.offset) + front_end_->middle_of(-0.5)) / rate_hz;
  recording.frame_s = (front_end_->middle_of(1) - front_end_->middle_of(0)) / rate_hz;
  if (sentence.samples.empty()) return recording;
  recording.activity = times_->frames(sentence.recorded);
  recording.activity_first_s = static_cast<double>(sentence.recorded_offset) / rate_hz;
  if (recorded != nullptr) *recorded = std::move(sentence.recorded);
  const MatrixF frames = front_end_->frames(std::move(sentence.samples));
  recording.log_emissions.resize(frames.rows(), emissions_->num_states());
  if (possibilities_ != nullptr) {
    possibilities_->compute(frames, recording.log_emissions);
  } else {
    emissions_->compute(frames, recording.log_emissions);
  }
  if (fillers == nullptr || fillers_ == nullptr) return recording;
  fillers->resize(frames.rows(), fillers_->num_states());
  if (filler_possibilities_ != nullptr) {
    filler_possibilities_->compute(frames, *fillers);
  } else {
    fillers_->compute(frames, *fillers);
  }
  return recording;
}

std::shared_ptr<const SpeechEmbedding> ConnectedWordRecognizer::embedding() const {
  return rescorer_ == nullptr ? nullptr : rescorer_->words().embedding;
}

std::vector<bool> ConnectedWordRecognizer::states_of_words() const {
  std::vector<bool> result(static_cast<std::size_t>(emissions_->num_states()), true);
  const auto of_silence = models().back().num_states();
  std::fill(result.end() - of_silence, result.end(), false);
  return result;
}

Transcript ConnectedWordRecognizer::recognise(Span<const float> audio, int sample_rate_hz,
                                              const TranscriptionQuery& query) const {
  return recognise(score(audio, sample_rate_hz), query);
}

Transcript ConnectedWordRecognizer::recognise(const ScoredRecording& recording,
                                              const TranscriptionQuery& query) const {
  require(query.num_words >= 0 && query.num_words <= kMaxLength, "num_words must lie in 0..1000");
  require(query.num_alternatives >= 0 && query.num_alternatives <= kMaxLength,
          "num_alternatives must lie in 0..1000");
  Transcript transcript;
  transcript.notes = recording.notes;
  const MatrixF& scores = recording.log_emissions;
  if (scores.rows() == 0) return transcript;
  const auto searched = network(query.num_words);
  ConnectedDecoder decoder(chains_, *searched, options_.decoder);
  for (Eigen::Index t = 0; t < scores.rows(); ++t) decoder.push(row_span(scores, t));
  const DecodedSentence decoded = decoder.finish();
  transcript.complete = decoded.complete;
  transcript.log_score = decoded.log_score;
  transcript.words = words_of(decoded.words, recording);
  if (!decoded.complete) return transcript;
  if (query.confidences || query.num_alternatives > 0)
    weigh(recording, query, *searched, decoded.words, &transcript);
  // After the confidences, by which words are unknown.
  if (grammar_ != nullptr && query.num_words == 0) transcript.slots = slots_of(transcript.words);
  return transcript;
}

void ConnectedWordRecognizer::weigh(const ScoredRecording& recording,
                                    const TranscriptionQuery& query, const WordNetwork& searched,
                                    const std::vector<DecodedWord>& decoded,
                                    Transcript* transcript) const {
  const MatrixF& scores = recording.log_emissions;
  if (!Lattice::fits(chains_, searched, scores.rows())) {
    transcript->notes.emplace_back("too long for confidences and alternatives");
    return;
  }
  const Lattice lattice =
      Lattice::decode(chains_, searched, scores, options_.decoder, options_.lattice);
  if (query.confidences) add_confidences(lattice, decoded, transcript);
  if (query.num_alternatives == 0) return;
  for (const DecodedSentence& sentence : lattice.n_best(query.num_alternatives))
    transcript->alternatives.push_back({words_of(sentence.words, recording), sentence.log_score});
}

Transcript ConnectedWordRecognizer::recognise_begun(const ScoredRecording& recording,
                                                    std::size_t* num_decided) const {
  ConnectedDecoder decoder(chains_, *sentences_, options_.decoder);
  const MatrixF& scores = recording.log_emissions;
  for (Eigen::Index t = 0; t < scores.rows(); ++t) decoder.push(row_span(scores, t));
  std::vector<DecodedWord> words = decoder.take_decided();
  *num_decided = static_cast<std::size_t>(
      std::count_if(words.begin(), words.end(),
                    [this](const DecodedWord& word) { return word.model != silence(); }));
  const DecodedSentence rest = decoder.partial();
  words.insert(words.end(), rest.words.begin(), rest.words.end());
  Transcript transcript;
  transcript.complete = false;
  transcript.log_score = rest.log_score;
  transcript.words = words_of(words, recording);
  return transcript;
}

Slots ConnectedWordRecognizer::slots_of(const std::vector<TranscribedWord>& words) const {
  std::vector<std::string> sentence;
  for (const TranscribedWord& word : words) {
    if (word.unknown) return {};
    sentence.push_back(word.label);
  }
  return grammar_->slots_of(sentence).value_or(Slots());
}

Lattice ConnectedWordRecognizer::lattice(const ScoredRecording& recording, int num_words) const {
  require(num_words >= 0 && num_words <= kMaxLength, "num_words must lie in 0..1000");
  if (recording.log_emissions.rows() == 0) return {{}, {}};
  return Lattice::decode(chains_, *network(num_words), recording.log_emissions, options_.decoder,
                         options_.lattice);
}

std::vector<TranscribedWord> ConnectedWordRecognizer::words_of(
    const std::vector<DecodedWord>& decoded, const ScoredRecording& recording) const {
  std::vector<TranscribedWord> words;
  for (const DecodedWord& word : decoded) {
    if (word.model == silence()) continue;
    TranscribedWord found;
    found.unknown = word.model == unknown_word();
    found.label =
        found.unknown ? TranscribedWord::kUnknown : labels_[static_cast<std::size_t>(word.model)];
    found.first_s = recording.seconds_of(word.first_frame);
    found.last_s = recording.seconds_of(word.last_frame);
    found.log_score = word.log_score;
    words.push_back(std::move(found));
  }
  times_->extend(recording, &words);
  return words;
}

void ConnectedWordRecognizer::add_confidences(const Lattice& lattice,
                                              const std::vector<DecodedWord>& decoded,
                                              Transcript* transcript) const {
  const std::vector<double> confidences = lattice.confidences(decoded, options_.confidence_scale);
  std::size_t word = 0;
  for (std::size_t i = 0; i < decoded.size(); ++i) {
    if (decoded[i].model == silence()) continue;
    TranscribedWord& found = transcript->words[word++];
    found.confidence = confidences[i];
    found.unknown = found.unknown || confidences[i] < options_.min_confidence;
  }
}

}  // namespace hri
