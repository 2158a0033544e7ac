// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Any model file: what loads must decide, within memory and time, and what it decides are numbers.
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "fuzzing.hpp"
#include "hri/htk/embedded_trainer.hpp"
#include "hri/io/model_file.hpp"
#include "hri/models/classifiers/distance_classifier.hpp"
#include "hri/models/classifiers/gaussian_bayes.hpp"
#include "hri/models/classifiers/knn.hpp"
#include "hri/models/classifiers/lda.hpp"
#include "hri/models/classifiers/linear_svm.hpp"
#include "hri/models/classifiers/pca.hpp"
#include "hri/models/classifiers/possibility_classifier.hpp"
#include "hri/models/classifiers/rbf_classifier.hpp"
#include "hri/models/codebook/multi_stream_codebook.hpp"
#include "hri/models/hmm/discrete_hmm.hpp"
#include "hri/models/hmm/gaussian_mixture.hpp"
#include "hri/models/hmm/gaussian_mixture_hmm.hpp"
#include "hri/models/possibility/possibilistic_gaussian_hmm.hpp"
#include "hri/recognition/gesture/gesture_recognizer.hpp"
#include "hri/recognition/sentence/connected_word_recognizer.hpp"
#include "hri/recognition/sentence/sentence_recognizer.hpp"
#include "hri/recognition/subword/subword_recognizer.hpp"
#include "hri/recognition/word/word_recognizer.hpp"
#include "model_bytes.hpp"

namespace {

// Ends the program, as a crash does: words that were found without a score that is a number.
template <class Sentence>
void check_sentence(const Sentence& sentence) {
  if (!std::isfinite(sentence.log_score)) std::abort();
  for (const auto& word : sentence.words) {
    if (!std::isfinite(word.log_score)) std::abort();
  }
}

using hri::MatrixF;
using hri::ModelFile;

constexpr const char* kPrefix = "model.";

// A tone whose pitch rises, between pauses.
std::vector<float> tone() {
  std::vector<float> samples(5600, 1e-4F);
  for (std::size_t i = 0; i < 2400; ++i) {
    const auto t = static_cast<float>(i) / 8000;
    samples[1600 + i] = 0.3F * std::sin(6.2831853F * (400 + 700 * t) * t);
  }
  return samples;
}

MatrixF rows(Eigen::Index count, int dim) {
  MatrixF m(count, dim);
  for (Eigen::Index i = 0; i < m.size(); ++i)
    m.data()[i] = 0.1F * static_cast<float>((i * 37) % 19) - 0.9F;
  return m;
}

// Ends the program where what was found of finite input is no number; -inf is one.
void check_numbers(double value) {
  if (std::isnan(value)) std::abort();
}
template <class Derived>
void check_numbers(const Eigen::MatrixBase<Derived>& values) {
  if (values.hasNaN()) std::abort();
}

// Reads a classifier, and decides on a row.
template <class Classifier>
void decide(const ModelFile& file) {
  const auto classifier = Classifier::read(file, kPrefix);
  const MatrixF row = rows(1, classifier.dim());
  check_numbers(
      classifier.decision_values({row.data(), static_cast<std::size_t>(classifier.dim())}));
}

// Of a few weights; the seeds that read an embedding were trained with it.
const std::shared_ptr<const hri::SpeechEmbedding>& embedding() {
  static const auto kEmbedding = std::make_shared<const hri::SpeechEmbedding>(
      hri::SpeechEmbedding::load(HRI_FUZZ_FOLDER "/embedding.onnx"));
  return kEmbedding;
}

struct TemporaryFile {
  std::string path =
      (std::filesystem::temp_directory_path() / "model_fuzz.").string() + std::to_string(getpid());
  ~TemporaryFile() { std::remove(path.c_str()); }
};

// Sums of embedded training are read from a path, for models of their own.
void add_sums(const ModelFile& file) {
  static const hri::htk::ModelSet models = [] {
    hri::htk::ModelSet set;
    set.parse(
        "~h a <BEGINHMM> <NUMSTATES> 3 <STATE> 2 <MEAN> 1 0.5 <VARIANCE> 1 2 <TRANSP> 3 0 1 0 0 "
        "0.5 0.5 0 0 0 <ENDHMM>",
        "models");
    return set;
  }();
  static const TemporaryFile kept;
  hri::htk::EmbeddedTrainer trainer(models);
  file.write(kept.path);
  trainer.add_sums(kept.path);
  check_numbers(trainer.log_likelihood());
  // What was estimated can be written and read.
  hri::htk::ModelSet again;
  again.parse(trainer.estimate().to_text(), "again");
}

void use(const ModelFile& file) {
  const std::string kind = file.kind();
  if (kind == "word_recognizer") {
    static const std::vector<float> kTone = tone();
    const auto words = hri::WordRecognizer::from_model_file(file, embedding());
    hri::fuzzing::check(words.recognise({kTone.data(), kTone.size()}, 8000));
  } else if (kind == "subword_recognizer") {
    static const std::vector<float> kTone = tone();
    const auto words = hri::SubwordRecognizer::from_model_file(file);
    hri::fuzzing::check(words.recognise({kTone.data(), kTone.size()}, 8000));
  } else if (kind == "htk_embedded_sums") {
    add_sums(file);
  } else if (kind == "gesture_recognizer") {
    const auto gestures = hri::GestureRecognizer::from_model_file(file);
    for (const Eigen::Index n : {1, 30}) {
      for (const int dim : {85, 82, 99, 1}) {
        hri::fuzzing::expect_typed_errors(
            [&] { hri::fuzzing::check(gestures.recognise_features(rows(n, dim))); });
      }
    }
  } else if (kind == "connected_word_recognizer") {
    static const std::vector<float> kTone = tone();
    const auto words = hri::ConnectedWordRecognizer::from_model_file(file, embedding());
    hri::TranscriptionQuery query;
    for (const int num_words : {0, 2}) {
      query.num_words = num_words;
      check_sentence(words.recognise({kTone.data(), kTone.size()}, 8000, query));
    }
  } else if (kind == "sentence_recognizer") {
    const auto signs = hri::SentenceRecognizer::from_model_file(file);
    for (const int dim : {6, 12}) {
      hri::fuzzing::expect_typed_errors([&] { check_sentence(signs.recognise(rows(12, dim))); });
      hri::fuzzing::expect_typed_errors([&] {
        check_sentence(signs.recognise_spans(rows(12, dim), {{"", 1, 5}, {"", 6, 11}}));
      });
    }
  } else if (kind == "codebook") {
    const auto book = hri::Codebook::read(file, kPrefix);
    if (book.dim() < 4096) static_cast<void>(book.quantise(rows(5, book.dim())));
  } else if (kind == "multi_stream_codebook") {
    const auto book = hri::MultiStreamCodebook::read(file, kPrefix);
    if (book.dim() < 4096) static_cast<void>(book.quantise(rows(5, book.dim())));
  } else if (kind == "pca") {
    const auto pca = hri::Pca::read(file, kPrefix);
    check_numbers(pca.transform(rows(5, pca.dim())));
  } else if (kind == "lda") {
    const auto lda = hri::Lda::read(file, kPrefix);
    check_numbers(lda.transform(rows(5, lda.dim())));
  } else if (kind == "gaussian_mixture_hmm") {
    const auto hmm = hri::GaussianMixtureHmm::read(file, kPrefix);
    check_numbers(hmm.log_likelihood(rows(9, hmm.dim())));
  } else if (kind == "discrete_hmm") {
    const auto hmm = hri::DiscreteHmm::read(file, kPrefix);
    const std::vector<std::int32_t> symbols = {0, 1, 1, 0, 2};
    check_numbers(hmm.log_likelihood({symbols.data(), symbols.size()}));
  } else if (kind == "gaussian_mixture") {
    const auto mixture = hri::GaussianMixture::read(file, kPrefix);
    check_numbers(mixture.log_likelihood(rows(9, mixture.dim())));
  } else if (kind == "possibilistic_hmm_set") {
    const auto set = hri::PossibilisticHmmSet::read(file, kPrefix);
    const std::vector<std::int32_t> symbols = {0, 1, 1, 0, 2};
    check_numbers(set.log_possibilities({symbols.data(), symbols.size()}));
  } else if (kind == "possibilistic_gaussian_hmm_set") {
    const auto set = hri::PossibilisticGaussianHmmSet::read(file, kPrefix);
    check_numbers(set.log_possibilities(rows(9, set.dim())));
  } else {
    // The rest are read one after the other; what does not fit is refused.
    using hri::fuzzing::expect_typed_errors;
    expect_typed_errors([&] { decide<hri::Knn>(file); });
    expect_typed_errors([&] { decide<hri::LinearSvm>(file); });
    expect_typed_errors([&] { decide<hri::RbfClassifier>(file); });
    expect_typed_errors([&] { decide<hri::GaussianBayes>(file); });
    expect_typed_errors([&] { decide<hri::DistanceClassifier>(file); });
    expect_typed_errors([&] { decide<hri::PossibilityClassifier>(file); });
    expect_typed_errors([&] {
      const auto chain = hri::MarkovChain::read(file, kPrefix);
      check_numbers(chain.start());
      check_numbers(chain.transition());
      check_numbers(chain.smallest_probability());
    });
  }
}

}  // namespace

extern "C" size_t LLVMFuzzerMutate(std::uint8_t* data, size_t size, size_t max_size);

extern "C" size_t LLVMFuzzerCustomMutator(std::uint8_t* data, size_t size, size_t max_size,
                                          unsigned seed) {
  std::mt19937 random(seed);
  const auto plain = [&] { return LLVMFuzzerMutate(data, size, max_size); };
  if (random() % 16 == 0) return plain();
  auto file = hri::fuzzing::ModelBytes::parse(data, size);
  if (!file) return plain();
  for (unsigned i = 0; i <= random() % 3; ++i) file->change(random);
  const std::vector<std::uint8_t> changed = file->serialise();
  if (changed.size() > max_size) return plain();
  std::copy(changed.begin(), changed.end(), data);
  return changed.size();
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  hri::fuzzing::expect_typed_errors([&] { use(ModelFile::parse({data, size}, "input")); });
  return 0;
}
