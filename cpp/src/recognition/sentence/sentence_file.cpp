// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// SentenceRecognizer to and from a model file.
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "hri/core/error.hpp"
#include "hri/recognition/sentence/sentence_recognizer.hpp"
#include "io/option_fields.hpp"
#include "recognition/reading.hpp"

namespace hri {
namespace {

constexpr const char* kKind = "sentence_recognizer";
constexpr const char* kLanguage = "language";
constexpr const char* kCodebook = "codebook.";
constexpr const char* kReaches = "reaches";  // of the right hand and of the left one
constexpr const char* kVariantWords = "variants.words";
constexpr const char* kVariantLengths = "variants.lengths";
constexpr const char* kVariantStates = "variants.states";
constexpr const char* kVariantFrames = "variants.frames";

std::string prefix_of(std::size_t model) { return "hmm." + std::to_string(model) + "."; }

int integer(float value, const char* name) {
  if (!(value >= 0) || value > 1e7F || value != std::floor(value))
    fail(ErrorKind::format, std::string(name) + " has a value that is no whole number");
  return static_cast<int>(value);
}

void write_variants(const std::vector<SignVariant>& variants, ModelFile& file) {
  if (variants.empty()) return;
  VectorF words(static_cast<Eigen::Index>(variants.size()));
  VectorF lengths(words.size());
  Eigen::Index num_frames = 0;
  for (const SignVariant& variant : variants) num_frames += variant.frames.rows();
  VectorF states(num_frames);
  MatrixF frames(num_frames, variants.front().frames.cols());
  Eigen::Index first = 0;
  for (std::size_t v = 0; v < variants.size(); ++v) {
    const SignVariant& variant = variants[v];
    const Eigen::Index length = variant.frames.rows();
    words[static_cast<Eigen::Index>(v)] = static_cast<float>(variant.word);
    lengths[static_cast<Eigen::Index>(v)] = static_cast<float>(length);
    for (Eigen::Index t = 0; t < length; ++t)
      states[first + t] = static_cast<float>(variant.states[static_cast<std::size_t>(t)]);
    frames.middleRows(first, length) = variant.frames;
    first += length;
  }
  file.set_vector(kVariantWords, words);
  file.set_vector(kVariantLengths, lengths);
  file.set_vector(kVariantStates, states);
  file.set_matrix(kVariantFrames, frames);
}

HandReaches read_reaches(const ModelFile& file) {
  if (!file.has(kReaches)) return {};
  const VectorD reaches = file.vector_d(kReaches);
  if (reaches.size() != 2) fail(ErrorKind::format, "reaches must have two values");
  return {reaches[0], reaches[1]};
}

std::vector<SignVariant> read_variants(const ModelFile& file) {
  std::vector<SignVariant> variants;
  if (!file.has(kVariantWords)) return variants;
  const VectorF words = file.vector_f(kVariantWords);
  const VectorF lengths = file.vector_f(kVariantLengths);
  const VectorF states = file.vector_f(kVariantStates);
  const MatrixF frames = file.matrix_f(kVariantFrames);
  if (lengths.size() != words.size() || states.size() != frames.rows())
    fail(ErrorKind::format, "variants do not have as many values each");
  Eigen::Index first = 0;
  for (Eigen::Index v = 0; v < words.size(); ++v) {
    const int length = integer(lengths[v], kVariantLengths);
    if (length < 1 || length > frames.rows() - first)
      fail(ErrorKind::format, "variants.lengths do not add up to the frames");
    SignVariant variant{integer(words[v], kVariantWords), frames.middleRows(first, length), {}};
    for (Eigen::Index t = 0; t < length; ++t)
      variant.states.push_back(integer(states[first + t], kVariantStates));
    variants.push_back(std::move(variant));
    first += length;
  }
  if (first != frames.rows())
    fail(ErrorKind::format, "variants.lengths do not add up to the frames");
  return variants;
}

}  // namespace

ModelFile SentenceRecognizer::to_model_file() const {
  ModelFile file;
  file.set_kind(kKind);
  file.set_text_list("labels", labels_);
  detail::write_options(options_, file);
  for (std::size_t m = 0; m < models().size(); ++m) models()[m].write(file, prefix_of(m));
  file.set_vector("final_stays", final_stays_);
  if (options_.input == SentenceInput::tracks) {
    VectorD reaches(2);
    reaches << reaches_.right, reaches_.left;
    file.set_vector(kReaches, reaches);
  }
  write_variants(*variants_, file);
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
                            std::move(language), std::move(codebook), read_variants(file),
                            read_reaches(file));
  file.require_all_read();
  return result;
}

}  // namespace hri
