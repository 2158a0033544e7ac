// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Every options struct of the core; tests/py/test_options.py checks that none is left out.
#include <gtest/gtest.h>

#include "hri/features/hand/hand_features.hpp"
#include "hri/features/hand/hand_finder_options.hpp"
#include "hri/features/hand/hand_pair.hpp"
#include "hri/features/hand/hand_track.hpp"
#include "hri/features/hand/landmark_pair.hpp"
#include "hri/features/hand/two_hand_features.hpp"
#include "hri/features/motion/hybrid_feature.hpp"
#include "hri/htk/embedded_trainer.hpp"
#include "hri/htk/feature_extractor.hpp"
#include "hri/htk/viterbi_trainer.hpp"
#include "hri/language/connected_decoder.hpp"
#include "hri/language/lattice.hpp"
#include "hri/language/ngram_model.hpp"
#include "hri/models/adaptation/map_adaptation.hpp"
#include "hri/models/classifiers/distance_classifier.hpp"
#include "hri/models/classifiers/gaussian_bayes.hpp"
#include "hri/models/classifiers/knn.hpp"
#include "hri/models/classifiers/lda.hpp"
#include "hri/models/classifiers/linear_svm.hpp"
#include "hri/models/classifiers/logistic_regression.hpp"
#include "hri/models/classifiers/rbf_classifier.hpp"
#include "hri/models/classifiers/softmax_regression.hpp"
#include "hri/models/codebook/codebook.hpp"
#include "hri/models/hmm/few_samples.hpp"
#include "hri/models/hmm/gaussian_mixture.hpp"
#include "hri/models/hmm/hmm_stream.hpp"
#include "hri/models/hmm/model_selection.hpp"
#include "hri/models/possibility/possibilistic_hmm.hpp"
#include "hri/recognition/gesture/gesture_recognizer.hpp"
#include "hri/recognition/gesture/gesture_stream.hpp"
#include "hri/recognition/sentence/connected_word_recognizer.hpp"
#include "hri/recognition/sentence/connected_word_stream.hpp"
#include "hri/recognition/sentence/sentence_recognizer.hpp"
#include "hri/recognition/sentence/sentence_stream.hpp"
#include "hri/recognition/subword/subword_recognizer.hpp"
#include "hri/recognition/word/speaker_adapter.hpp"
#include "hri/recognition/word/speech_embedding.hpp"
#include "hri/signal/shrinkage.hpp"
#include "hri/signal/stream/endpointer.hpp"
#include "hri/signal/stream/wavelet_stream.hpp"
#include "option_checks.hpp"

namespace hri {
namespace {

template <class O>
class EveryOptions : public testing::Test {};

using All = testing::Types<
    ActivityOptions, EndpointerOptions, ShrinkageOptions, WaveletStreamOptions,
    FourierDescriptorOptions, HandFeatureOptions, HandPairOptions, WaveletDescriptorOptions,
    HandTrackOptions, SilhouetteCepstrumOptions, ChainCodeOptions, OrientationHistogramOptions,
    CepstraOptions, FilterBankOptions, CodebookOptions, LdaOptions, DistanceClassifierOptions,
    GaussianBayesOptions, LogisticRegressionOptions, SoftmaxRegressionOptions,
    SequenceNetworkOptions, KnnOptions, LinearSvmOptions, RbfClassifierOptions,
    MapAdaptationOptions, Topology, PossibilisticRule, PossibilisticHmmOptions, HmmStreamOptions,
    FewSampleOptions, GaussianMixtureHmmOptions, GaussianMixtureOptions, DiscreteHmmOptions,
    StateChoiceOptions, SequenceModelOptions, AdaptationOptions, SpeakerAdapterOptions,
    SpeechEmbeddingOptions, WordRecognizerOptions, GestureRecognizerOptions, SilhouetteOptions,
    HandColourOptions, MaskSmoothingOptions, HandFinderOptions, GestureSegmenterOptions,
    GestureStreamOptions, NGramOptions, ConnectedDecoderOptions, ConnectedWordRecognizerOptions,
    htk::HtkFeatureOptions, htk::EmbeddedTrainerOptions, htk::ViterbiTrainerOptions,
    TwoHandFeatureOptions, SentenceRecognizerOptions, LandmarkPairOptions, LatticeOptions,
    ConnectedWordStreamOptions, SubwordRecognizerOptions, HybridFeatureOptions,
    SentenceStreamOptions>;
TYPED_TEST_SUITE(EveryOptions, All);

TYPED_TEST(EveryOptions, RefusesWhatLiesOutsideARange) {
  hri_test::expect_ranges_hold<TypeParam>();
}

TYPED_TEST(EveryOptions, GoesThroughAModelFile) {
  if constexpr (!std::is_same_v<TypeParam, HmmStreamOptions>) {  // infinite: no file holds it
    hri_test::expect_model_file_keeps<TypeParam>();
  }
}

TEST(WordRecognizerOptions, RefusesWhatOnceWroteBeyondTheClip) {
  WordRecognizerOptions options;
  options.activity.padding_ms = -1e308;
  EXPECT_THROW(WordRecognizer::train({}, options), InvalidArgument);
  EXPECT_EQ(options_fault(options), "ActivityOptions.padding_ms must lie in 0..1000, got -1e+308");
}

}  // namespace
}  // namespace hri
