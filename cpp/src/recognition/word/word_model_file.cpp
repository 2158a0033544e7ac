// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// WordRecognizer to and from a model file.
#include <utility>

#include "hri/core/error.hpp"
#include "hri/recognition/word/word_recognizer.hpp"
#include "io/option_fields.hpp"
#include "recognition/reading.hpp"

namespace hri {
namespace {

constexpr const char* kKind = "word_recognizer";
constexpr const char* kWeights = "embedding.checksum";

// `embedding` as it was in training: of the same weights, and with the options it had.
std::shared_ptr<const SpeechEmbedding> as_trained(const ModelFile& file,
                                                  const SpeechEmbedding* embedding) {
  SpeechEmbeddingOptions trained;
  detail::read_options(file, &trained, "embedding.");
  const std::string& weights = file.text(kWeights);
  if (embedding == nullptr || embedding->checksum() != weights) {
    fail(ErrorKind::format, file.name() + ": was trained with a speech embedding of the weights " +
                                weights + ", these are " +
                                (embedding == nullptr ? "none" : embedding->checksum()));
  }
  return std::make_shared<const SpeechEmbedding>(embedding->with_options(trained));
}

}  // namespace

ModelFile WordRecognizer::to_model_file() const {
  ModelFile file;
  file.set_kind(kKind);
  file.set_text_list("labels", labels_);
  detail::write_options(options_, file);
  if (const SpeechEmbedding* embedding = front_end_.embedding().get()) {
    file.set_text(kWeights, embedding->checksum());
    detail::write_options(embedding->options(), file, "embedding.");
  }
  verifier_.write(file, scorer_);
  calibration_.write(file);
  held_out_.write(file);
  scorer_.write(file);
  return file;
}

WordRecognizer WordRecognizer::from_model_file(const ModelFile& file,
                                               std::shared_ptr<const SpeechEmbedding> embedding) {
  if (file.kind() != kKind) {
    fail(ErrorKind::format,
         file.name() + ": kind is '" + file.kind() + "', expected '" + kKind + "'");
  }
  if (file.has(kWeights) && embedding == nullptr) {
    fail(ErrorKind::invalid_argument,
         file.name() + ": was trained with a speech embedding of the weights " +
             file.text(kWeights) + ", which it needs to recognise: give their file");
  }
  return detail::with_context(file, [&] { return read(file, std::move(embedding)); });
}

WordRecognizer WordRecognizer::read(const ModelFile& file,
                                    std::shared_ptr<const SpeechEmbedding> embedding) {
  WordRecognizerOptions options;
  detail::read_options(file, &options, "", "models.");
  std::vector<std::string> labels = sorted_labels(file.text_list("labels"));
  if (labels != file.text_list("labels"))
    fail(ErrorKind::format, file.name() + ": labels are not sorted");
  embedding = has_embedding(options.front_end) ? as_trained(file, embedding.get()) : nullptr;
  const WordFrontEnd front_end(options, 1, embedding);
  MultiStreamScorer scorer =
      MultiStreamScorer::read(file, options, front_end.num_streams(),
                              static_cast<int>(labels.size()), front_end.num_features());
  WordVerifier verifier = WordVerifier::read(file, scorer);
  const Calibration calibration = Calibration::read(file);
  HeldOutReport held_out = HeldOutReport::read(file);
  file.require_all_read();
  return {options,     std::move(labels),    std::move(scorer),  std::move(verifier),
          calibration, std::move(embedding), std::move(held_out)};
}

}  // namespace hri
