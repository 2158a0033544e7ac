// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Times of words that are known beforehand.
#include <algorithm>

#include "hri/core/error.hpp"
#include "hri/recognition/sentence/connected_word_recognizer.hpp"

namespace hri {
namespace {

constexpr std::size_t kMaxWords = 1000;
constexpr double kNoBeam = 1e12;
constexpr int kAllWordsOpen = 100000000;

// Where the given words lie badly, the right path may fall far behind one that cannot reach its end
// any more; whether there is an alignment must not depend on that.
ConnectedDecoderOptions without_pruning(ConnectedDecoderOptions options) {
  options.beam = kNoBeam;
  options.max_open_words = kAllWordsOpen;
  return options;
}

}  // namespace

int ConnectedWordRecognizer::model_of(const std::string& word) const {
  const auto found = std::lower_bound(labels_.begin(), labels_.end(), word);
  if (found != labels_.end() && *found == word) return static_cast<int>(found - labels_.begin());
  if (options_.unknown_words && word == TranscribedWord::kUnknown) return unknown_word();
  std::string message = "words: there is no word '" + word + "'; the words are";
  for (const std::string& label : labels_)
    message += label.find(' ') == std::string::npos ? " " + label : " '" + label + "'";
  if (options_.unknown_words) message += std::string(" ") + TranscribedWord::kUnknown;
  fail(ErrorKind::invalid_argument, message);
}

Transcript ConnectedWordRecognizer::align(Span<const float> audio, int sample_rate_hz,
                                          const std::vector<std::string>& words,
                                          bool confidences) const {
  return align(score(audio, sample_rate_hz), words, confidences);
}

Transcript ConnectedWordRecognizer::align(const ScoredRecording& recording,
                                          const std::vector<std::string>& words,
                                          bool confidences) const {
  require(words.size() <= kMaxWords, "words: there are more than 1000");
  std::vector<int> models;
  models.reserve(words.size());
  for (const std::string& word : words) models.push_back(model_of(word));
  const WordNetwork said = WordNetwork::transcript(models, silence());
  Transcript transcript;
  transcript.notes = recording.notes;
  const MatrixF& scores = recording.log_emissions;
  transcript.complete = false;
  if (scores.rows() == 0) return transcript;
  ConnectedDecoder decoder(chains_, said, without_pruning(options_.decoder));
  for (Eigen::Index t = 0; t < scores.rows(); ++t) decoder.push(row_span(scores, t));
  const DecodedSentence decoded = decoder.finish();
  transcript.complete = decoded.complete;
  transcript.log_score = decoded.log_score;
  transcript.words = words_of(decoded.words, recording);
  if (!decoded.complete || !confidences) return transcript;
  if (!Lattice::fits(chains_, *any_words_, scores.rows())) {
    transcript.notes.emplace_back("too long for confidences");
    return transcript;
  }
  const Lattice lattice =
      Lattice::decode(chains_, *any_words_, scores, options_.decoder, options_.lattice);
  add_confidences(lattice, decoded.words, &transcript);
  for (TranscribedWord& word : transcript.words)
    word.unknown = word.label == TranscribedWord::kUnknown;
  return transcript;
}

}  // namespace hri
