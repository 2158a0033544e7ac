// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// WordRecognizer to and from a model file.
#include "hri/core/error.hpp"
#include "hri/recognition/word/word_recognizer.hpp"
#include "recognition/option_fields.hpp"
#include "recognition/reading.hpp"

namespace hri {
namespace {

constexpr const char* kKind = "word_recognizer";

std::string stream_prefix(std::size_t index) { return "stream." + std::to_string(index) + "."; }

}  // namespace

ModelFile WordRecognizer::to_model_file() const {
  ModelFile file;
  file.set_kind(kKind);
  file.set_text_list("labels", labels_);
  detail::visit_word(detail::FieldWriter{file}, options_);
  verifier_.write(file, options_.models.model, streams_.front().models.num_background() > 0);
  calibration_.write(file);
  for (std::size_t s = 0; s < streams_.size(); ++s)
    streams_[s].models.write(file, stream_prefix(s));
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
  detail::visit_word(detail::FieldReader{file}, options);
  WordRecognizer result(options, sorted_labels(file.text_list("labels")));
  if (result.labels_ != file.text_list("labels"))
    fail(ErrorKind::format, file.name() + ": labels are not sorted");
  result.calibration_ = Calibration::read(file);
  for (std::size_t s = 0; s < result.streams_.size(); ++s) {
    WordStream& stream = result.streams_[s];
    stream.models.read(file, stream_prefix(s), static_cast<int>(result.labels_.size()),
                       stream.cepstra.num_features());
  }
  const int num_background = result.streams_.front().models.num_background();
  for (const WordStream& stream : result.streams_) {
    if (stream.models.num_background() != num_background)
      fail(ErrorKind::format, file.name() + ": streams differ in their background words");
  }
  result.verifier_ = WordVerifier::read(file, options.models.model, num_background > 0);
  return result;
}

}  // namespace hri
