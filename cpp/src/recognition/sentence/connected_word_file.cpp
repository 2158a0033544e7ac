// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// ConnectedWordRecognizer to and from a model file.
#include <utility>

#include "hri/core/error.hpp"
#include "hri/recognition/sentence/connected_word_recognizer.hpp"
#include "io/option_fields.hpp"
#include "recognition/reading.hpp"
#include "recognition/sentence/embedding_rescorer.hpp"

namespace hri {
namespace {

constexpr const char* kConnectedKind = "connected_word_recognizer";
constexpr const char* kLanguageEntry = "language";
constexpr const char* kGrammar = "grammar";
constexpr const char* kCodebookEntry = "codebook.";
constexpr const char* kEmbeddedWords = "embedded_words.";
constexpr const char* kWeights = "embedding.checksum";
constexpr const char* kEmbeddingOptions = "embedding.";
constexpr const char* kNumFillers = "num_fillers";
constexpr std::int64_t kMaxFillers = 10000;

std::string entry_of(std::size_t model) { return "hmm." + std::to_string(model) + "."; }
std::string filler_entry(std::int64_t model) { return "filler." + std::to_string(model) + "."; }

FillerModels read_fillers(const ModelFile& file) {
  FillerModels fillers;
  if (!file.has(kNumFillers)) return fillers;
  const std::int64_t count = file.integer(kNumFillers);
  if (count < 1 || count > kMaxFillers) {
    fail(ErrorKind::format, file.name() + ": field '" + kNumFillers +
                                "': " + std::to_string(count) + " does not lie in 1.." +
                                std::to_string(kMaxFillers));
  }
  for (std::int64_t f = 0; f < count; ++f)
    fillers.push_back(GaussianMixtureHmm::read(file, filler_entry(f)));
  return fillers;
}

// With the embedding as it was in training: of the same weights, and with the options it had.
EmbeddedWords read_embedded(const ModelFile& file, const SpeechEmbedding* given) {
  const std::string& weights = file.text(kWeights);
  if (given == nullptr || given->checksum() != weights) {
    fail(ErrorKind::format, file.name() + ": was trained with a speech embedding of the weights " +
                                weights + ", these are " +
                                (given == nullptr ? "none" : given->checksum()));
  }
  SpeechEmbeddingOptions trained;
  detail::read_options(file, &trained, kEmbeddingOptions);
  return {std::make_shared<const SpeechEmbedding>(given->with_options(trained)),
          SoftmaxRegression::read(file, kEmbeddedWords)};
}

}  // namespace

ModelFile ConnectedWordRecognizer::to_model_file() const {
  ModelFile file;
  file.set_kind(kConnectedKind);
  file.set_text_list("labels", labels_);
  detail::write_options(options_, file);
  for (std::size_t m = 0; m < models().size(); ++m) models()[m].write(file, entry_of(m));
  file.set_vector("final_stays", final_stays_);
  if (fillers_ != nullptr) {
    file.set_integer(kNumFillers, num_fillers());
    for (std::int64_t f = 0; f < num_fillers(); ++f)
      fillers_->models()[static_cast<std::size_t>(f)].write(file, filler_entry(f));
  }
  if (possibilities_ != nullptr) possibilities_->codebook().write(file, kCodebookEntry);
  if (rescorer_ != nullptr) {
    file.set_text(kWeights, rescorer_->words().embedding->checksum());
    detail::write_options(rescorer_->words().embedding->options(), file, kEmbeddingOptions);
    rescorer_->words().classifier.write(file, kEmbeddedWords);
  }
  if (language_ != nullptr) file.set_text(kLanguageEntry, language_->to_arpa());
  if (grammar_ != nullptr) file.set_text(kGrammar, grammar_->text());
  return file;
}

void ConnectedWordRecognizer::save(const std::string& path) const { to_model_file().write(path); }

ConnectedWordRecognizer ConnectedWordRecognizer::load(
    const std::string& path, std::shared_ptr<const SpeechEmbedding> embedding) {
  return from_model_file(ModelFile::read(path), std::move(embedding));
}

ConnectedWordRecognizer ConnectedWordRecognizer::from_model_file(
    const ModelFile& file, std::shared_ptr<const SpeechEmbedding> embedding) {
  if (file.kind() != kConnectedKind) {
    fail(ErrorKind::format,
         file.name() + ": kind is '" + file.kind() + "', expected '" + kConnectedKind + "'");
  }
  if (file.has(kWeights) && embedding == nullptr) {
    fail(ErrorKind::invalid_argument,
         file.name() + ": was trained with a speech embedding of the weights " +
             file.text(kWeights) + ", which it needs to recognise: give their file");
  }
  return detail::with_context(file, [&] { return read(file, embedding); });
}

ConnectedWordRecognizer ConnectedWordRecognizer::read(
    const ModelFile& file, const std::shared_ptr<const SpeechEmbedding>& embedding) {
  ConnectedWordRecognizerOptions options;
  detail::read_options(file, &options);
  std::vector<std::string> labels = file.text_list("labels");
  std::vector<GaussianMixtureHmm> models;
  for (std::size_t m = 0; m <= labels.size(); ++m)
    models.push_back(GaussianMixtureHmm::read(file, entry_of(m)));
  const VectorD final_stays = file.vector_d("final_stays");
  std::optional<MultiStreamCodebook> codebook;
  if (options.words.model == SequenceModelKind::ptbhmm)
    codebook = MultiStreamCodebook::read(file, kCodebookEntry);
  std::optional<EmbeddedWords> embedded;
  if (has_embedding(options.words.front_end)) embedded = read_embedded(file, embedding.get());
  ConnectedWordRecognizer result(options, std::move(labels), std::move(models), final_stays,
                                 std::move(codebook), read_fillers(file), std::move(embedded));
  if (file.has(kLanguageEntry)) {
    result = result.with_language(
        NGramModel::parse(file.text(kLanguageEntry), file.name() + ": language"));
  }
  if (file.has(kGrammar))
    result = result.with_grammar(Grammar::parse(file.text(kGrammar), file.name() + ": grammar"));
  file.require_all_read();
  return result;
}

}  // namespace hri
