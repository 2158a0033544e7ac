// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// SentenceRecognizer to and from a model file.
#include <utility>

#include "hri/core/error.hpp"
#include "hri/recognition/sentence/sentence_recognizer.hpp"
#include "io/option_fields.hpp"
#include "recognition/reading.hpp"

namespace hri {
namespace {

constexpr const char* kKind = "sentence_recognizer";
constexpr const char* kLanguage = "language";
constexpr const char* kCodebook = "codebook.";

std::string prefix_of(std::size_t model) { return "hmm." + std::to_string(model) + "."; }

}  // namespace

ModelFile SentenceRecognizer::to_model_file() const {
  ModelFile file;
  file.set_kind(kKind);
  file.set_text_list("labels", labels_);
  detail::write_options(options_, file);
  for (std::size_t m = 0; m < models().size(); ++m) models()[m].write(file, prefix_of(m));
  file.set_vector("final_stays", final_stays_);
  if (possibilities_ != nullptr) possibilities_->codebook().write(file, kCodebook);
  if (language_ != nullptr) file.set_text(kLanguage, language_->to_arpa());
  return file;
}

void SentenceRecognizer::save(const std::string& path) const { to_model_file().write(path); }

SentenceRecognizer SentenceRecognizer::load(const std::string& path) {
  return from_model_file(ModelFile::read(path));
}

SentenceRecognizer SentenceRecognizer::from_model_file(const ModelFile& file) {
  if (file.kind() != kKind) {
    fail(ErrorKind::format,
         file.name() + ": kind is '" + file.kind() + "', expected '" + kKind + "'");
  }
  return detail::with_context(file, [&] { return read(file); });
}

SentenceRecognizer SentenceRecognizer::read(const ModelFile& file) {
  SentenceRecognizerOptions options;
  detail::read_options(file, &options);
  std::vector<std::string> labels = file.text_list("labels");
  std::vector<GaussianMixtureHmm> models;
  for (std::size_t m = 0; m <= labels.size(); ++m)
    models.push_back(GaussianMixtureHmm::read(file, prefix_of(m)));
  const VectorD final_stays = file.vector_d("final_stays");
  std::shared_ptr<const NGramModel> language;
  if (file.has(kLanguage)) {
    language = std::make_shared<const NGramModel>(
        NGramModel::parse(file.text(kLanguage), file.name() + ": language"));
  }
  std::optional<MultiStreamCodebook> codebook;
  if (options.model == SequenceModelKind::ptbhmm)
    codebook = MultiStreamCodebook::read(file, kCodebook);
  SentenceRecognizer result(options, std::move(labels), std::move(models), final_stays,
                            std::move(language), std::move(codebook));
  file.require_all_read();
  return result;
}

}  // namespace hri
