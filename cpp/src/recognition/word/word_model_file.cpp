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

}  // namespace

ModelFile WordRecognizer::to_model_file() const {
  ModelFile file;
  file.set_kind(kKind);
  file.set_text_list("labels", labels_);
  detail::write_options(options_, file);
  verifier_.write(file, scorer_);
  calibration_.write(file);
  scorer_.write(file);
  return file;
}

WordRecognizer WordRecognizer::from_model_file(const ModelFile& file) {
  if (file.kind() != kKind) {
    fail(ErrorKind::format,
         file.name() + ": kind is '" + file.kind() + "', expected '" + kKind + "'");
  }
  return detail::with_context(file, [&] { return read(file); });
}

WordRecognizer WordRecognizer::read(const ModelFile& file) {
  WordRecognizerOptions options;
  detail::read_options(file, &options, "", "models.");
  std::vector<std::string> labels = sorted_labels(file.text_list("labels"));
  if (labels != file.text_list("labels"))
    fail(ErrorKind::format, file.name() + ": labels are not sorted");
  const WordFrontEnd front_end(options);
  MultiStreamScorer scorer =
      MultiStreamScorer::read(file, options, front_end.num_streams(),
                              static_cast<int>(labels.size()), front_end.num_features());
  WordVerifier verifier = WordVerifier::read(file, scorer);
  const Calibration calibration = Calibration::read(file);
  file.require_all_read();
  return {options, std::move(labels), std::move(scorer), std::move(verifier), calibration};
}

}  // namespace hri
