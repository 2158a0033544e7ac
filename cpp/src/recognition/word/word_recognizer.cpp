// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/recognition/word/word_recognizer.hpp"

#include <utility>

#include "hri/core/error.hpp"
#include "hri/signal/resample.hpp"
#include "recognition/word/word_cut.hpp"

namespace hri {

WordRecognizer::WordRecognizer(const WordRecognizerOptions& options,
                               std::vector<std::string> labels)
    : options_(options), labels_(std::move(labels)) {
  streams_.push_back({CepstraComputer(options.cepstra), SequenceModels(options.models)});
  if (options.level_stream) {
    CepstraOptions level = options.cepstra;
    level.normalisation = Normalisation::level;
    streams_.push_back({CepstraComputer(level), SequenceModels(options.models)});
  }
}

std::vector<float> WordRecognizer::locate(Span<const float> samples, int sample_rate_hz,
                                          std::vector<std::string>* notes) const {
  const int rate = options_.cepstra.sample_rate_hz;
  std::vector<float> word;
  if (sample_rate_hz == rate) {
    word.assign(samples.begin(), samples.end());
  } else {
    word = resample(samples, sample_rate_hz, rate);
    if (notes != nullptr) {
      notes->push_back("resampled from " + std::to_string(sample_rate_hz) + " to " +
                       std::to_string(rate) + " Hz");
    }
  }
  if (!options_.trim) {
    if (!find_speech(word, rate, options_.activity).found) word.clear();
    return word;
  }
  return detail::cut_word(word, rate, options_.activity, options_.floor_db);
}

std::vector<MatrixF> WordRecognizer::frames(Span<const float> word) const {
  std::vector<MatrixF> result;
  result.reserve(streams_.size());
  for (const WordStream& stream : streams_) result.push_back(stream.cepstra.compute(word));
  return result;
}

VectorF WordRecognizer::score(const std::vector<MatrixF>& frames) const {
  VectorF sum = streams_.front().models.scores(frames.front());
  for (std::size_t s = 1; s < streams_.size(); ++s) sum += streams_[s].models.scores(frames[s]);
  return sum;
}

VectorD WordRecognizer::features(const std::vector<MatrixF>& frames, const VectorF& scores,
                                 int left_out) const {
  std::vector<const SequenceModels*> models;
  models.reserve(streams_.size());
  for (const WordStream& stream : streams_) models.push_back(&stream.models);
  return WordVerifier::features(models, frames, scores, left_out);
}

float WordRecognizer::verification_score(const std::vector<MatrixF>& frames,
                                         const VectorF& scores) const {
  return verifier_.verification_score(features(frames, scores));
}

VectorF WordRecognizer::scores(Span<const float> samples, int sample_rate_hz) const {
  const std::vector<float> word = locate(samples, sample_rate_hz, nullptr);
  if (word.empty()) fail(ErrorKind::invalid_argument, "no speech found in the audio");
  return score(frames(word));
}

Decision WordRecognizer::recognise(Span<const float> samples, int sample_rate_hz) const {
  std::vector<MatrixF> word_frames;
  return recognise(samples, sample_rate_hz, &word_frames);
}

Decision WordRecognizer::recognise(Span<const float> samples, int sample_rate_hz,
                                   std::vector<MatrixF>* word_frames) const {
  Decision decision;
  std::vector<std::string> notes;
  const std::vector<float> word = locate(samples, sample_rate_hz, &notes);
  if (!word.empty()) {
    *word_frames = frames(word);
    const VectorF word_scores = score(*word_frames);
    decision =
        calibration_.decide(word_scores, verification_score(*word_frames, word_scores), labels_);
  }
  decision.notes = std::move(notes);
  return decision;
}

void WordRecognizer::save(const std::string& path) const { to_model_file().write(path); }

WordRecognizer WordRecognizer::load(const std::string& path) {
  return from_model_file(ModelFile::read(path));
}

}  // namespace hri
