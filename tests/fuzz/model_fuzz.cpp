// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Any model file: what loads must decide, within memory and time, and what it decides are numbers.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "fuzzing.hpp"
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

void use(const ModelFile& file) {
  const std::string kind = file.kind();
  if (kind == "word_recognizer") {
    static const std::vector<float> kTone = tone();
    const auto words = hri::WordRecognizer::from_model_file(file);
    hri::fuzzing::check(words.recognise({kTone.data(), kTone.size()}, 8000));
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
    const auto words = hri::ConnectedWordRecognizer::from_model_file(file);
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
    static_cast<void>(pca.transform(rows(5, pca.dim())));
  } else if (kind == "lda") {
    const auto lda = hri::Lda::read(file, kPrefix);
    static_cast<void>(lda.transform(rows(5, lda.dim())));
  } else if (kind == "gaussian_mixture_hmm") {
    const auto hmm = hri::GaussianMixtureHmm::read(file, kPrefix);
    static_cast<void>(hmm.log_likelihood(rows(9, hmm.dim())));
  } else if (kind == "discrete_hmm") {
    const auto hmm = hri::DiscreteHmm::read(file, kPrefix);
    const std::vector<std::int32_t> symbols = {0, 1, 1, 0, 2};
    static_cast<void>(hmm.log_likelihood({symbols.data(), symbols.size()}));
  } else if (kind == "gaussian_mixture") {
    const auto mixture = hri::GaussianMixture::read(file, kPrefix);
    static_cast<void>(mixture.log_likelihood(rows(9, mixture.dim())));
  } else if (kind == "possibilistic_hmm_set") {
    static_cast<void>(hri::PossibilisticHmmSet::read(file, kPrefix));
  } else if (kind == "possibilistic_gaussian_hmm_set") {
    static_cast<void>(hri::PossibilisticGaussianHmmSet::read(file, kPrefix));
  } else {
    // The rest are read one after the other; what does not fit is refused.
    using hri::fuzzing::expect_typed_errors;
    expect_typed_errors([&] { hri::Knn::read(file, kPrefix); });
    expect_typed_errors([&] { hri::LinearSvm::read(file, kPrefix); });
    expect_typed_errors([&] { hri::RbfClassifier::read(file, kPrefix); });
    expect_typed_errors([&] { hri::GaussianBayes::read(file, kPrefix); });
    expect_typed_errors([&] { hri::DistanceClassifier::read(file, kPrefix); });
    expect_typed_errors([&] { hri::PossibilityClassifier::read(file, kPrefix); });
    expect_typed_errors([&] { hri::MarkovChain::read(file, kPrefix); });
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
