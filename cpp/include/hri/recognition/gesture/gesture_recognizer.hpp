// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Isolated signs and gestures: grey images with hand masks -> hand features -> classifier ->
// Decision (thesis ch. 3). Still signs are classified frame by frame and the frames vote; movements
// are scored whole by sequence models.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/image_view.hpp"
#include "hri/core/options.hpp"
#include "hri/core/types.hpp"
#include "hri/features/hand/hand_features.hpp"
#include "hri/features/hand/hand_finder_options.hpp"
#include "hri/features/hand/hand_source.hpp"
#include "hri/io/model_file.hpp"
#include "hri/models/classifiers/logistic_regression.hpp"
#include "hri/recognition/calibration.hpp"
#include "hri/recognition/decision.hpp"
#include "hri/recognition/gesture/gesture_features.hpp"
#include "hri/recognition/held_out_report.hpp"
#include "hri/recognition/training.hpp"

namespace hri {

enum class GestureModel : std::uint8_t {
  svm,         ///< linear one-vs-rest support vector machine; frames vote with their margins
  bayes,       ///< Gaussian Bayes on principal components; frames vote with their log posteriors
  knn,         ///< k nearest neighbours on principal components; frames vote
  hmm,         ///< Gaussian HMM a gesture over principal components and the hand's track
  ptbhmm,      ///< possibility-theory HMM over a codebook of the same
  trajectory,  ///< linear support vector machine over the whole trajectory, resampled at a few
               ///< points; needs few examples
  rbf,         ///< least-squares support vector machine with a radial kernel; frames vote
  automatic,   ///< rbf; svm for more than 3000 frames; trajectory where most training gestures have
               ///< 8 frames or more; a trained recogniser's options say which it became
};
constexpr auto enum_names(GestureModel) {
  return std::array{"svm", "bayes", "knn", "hmm", "ptbhmm", "trajectory", "rbf", "automatic"};
}

/// What the rows of features are made from. C++ makes them from silhouettes; landmarks come from
/// outside and feed the same classifiers.
enum class GestureSource : std::uint8_t {
  silhouettes,  ///< hand features of masks and grey pictures
  landmarks,    ///< joints of the hand as a tracker gives them
};
constexpr auto enum_names(GestureSource) { return std::array{"silhouettes", "landmarks"}; }

struct GestureRecognizerOptions {
  GestureSource source = GestureSource::silhouettes;
  int num_hands = 1;
  double relation_weight = 3;
  HandFinderOptions hands;
  bool use_faces = false;
  double min_quality = 0.25;
  HandFeatureOptions features;
  GestureModel model = GestureModel::automatic;
  double svm_cost = 1.0;
  double turn_degrees = 30;
  double rbf_cost = 10;
  double rbf_sharpness = 1.5;
  int num_components = 40;
  int num_neighbours = 5;
  int num_states = 6;
  int num_codewords = 64;
  int max_iterations = 12;
  double false_reject_rate = 0.04;
  std::uint64_t seed = 0;

  static constexpr const char* kName = "GestureRecognizerOptions";
  template <class Self, class Visitor>
  static void visit(Self& o, Visitor&& v) {
    v("source", o.source, any_value, "what the features are taken of");
    v("num_hands", o.num_hands, within(1, 2), "2: gestures are of both hands, or of either");
    v("relation_weight", o.relation_weight, within(0, 1e6),
      "of the way between two hands, in sides of the picture, beside their shapes, of length 1");
    v("hands", o.hands, any_value, "how hands are found in pictures");
    v("use_faces", o.use_faces, any_value,
      "where a face is seen, hands are those of that person; needs a finder of faces, to which a "
      "palm may look like one");
    v("min_quality", o.min_quality, within(0, 1),
      "least quality of an observation that shows a hand: hands have more in any light, walls "
      "mostly less");
    v("features", o.features, any_value, "features of a hand (silhouettes)");
    v("model", o.model, any_value,
      "kind of the models; a trained recogniser says which one automatic became");
    v("svm_cost", o.svm_cost, above(0, 1e12),
      "C of the linear support vector machine (svm, trajectory)");
    v("turn_degrees", o.turn_degrees, within(0, 90),
      "training gestures are also learned with the hand turned by so much to either side, in the "
      "plane of the picture (trajectory); 0: only as they are");
    v("rbf_cost", o.rbf_cost, above(0, 1e12), "C of rbf");
    v("rbf_sharpness", o.rbf_sharpness, above(0, 1e6), "of its kernel, see RbfClassifierOptions");
    v("num_components", o.num_components, within(1, 1000),
      "principal components (bayes, knn, hmm, ptbhmm)");
    v("num_neighbours", o.num_neighbours, within(1, 1000), "k of knn");
    v("num_states", o.num_states, within(1, 64), "left-right states a gesture (hmm, ptbhmm)");
    v("num_codewords", o.num_codewords, within(2, 4096), "size of the codebook (ptbhmm)");
    v("max_iterations", o.max_iterations, within(1, 1000), "iterations of Baum-Welch at most");
    v("false_reject_rate", o.false_reject_rate, within(0, 0.5),
      "share of correct held-out gestures that the threshold may reject");
    v("seed", o.seed, any_seed, "of everything random in training");
  }
};

/// One training gesture: a row of features a frame, as GestureRecognizer::features gives them.
/// `group` is the signer.
struct GestureSample {
  MatrixF features;
  std::string label;
  std::string group;
};

namespace detail {
class GestureScorer;  // turns the features of one gesture into scores
}

/// Immutable once made; const calls are safe from several threads.
class HRI_API GestureRecognizer {
 public:
  /// Trains on the features of labelled gestures. Throws InvalidArgument for NaN, a label without a
  /// frame that shows a hand, fewer than two labels; Interrupted when `should_stop` says so.
  static GestureRecognizer train(const std::vector<GestureSample>& samples,
                                 const GestureRecognizerOptions& options,
                                 const TrainingProgress& progress = {},
                                 const StopCheck& should_stop = {});

  /// The same with one gesture more, from few samples of it, all with one label that is new; three
  /// suffice. Rejection and calibration stay, and held_out() knows nothing of the new gesture. What
  /// is trained again depends on the model:
  ///  - rbf, knn: the model keeps the rows that it was trained on, and is trained on all of them;
  ///  - trajectory: the mean trajectories of the others stand for their gestures, see
  ///    LinearSvm::with_class;
  ///  - hmm, ptbhmm: the models of the others stay as they are, to the bit.
  /// Throws InvalidArgument for no sample, labels that differ or are known already, a sample
  /// without a hand, of another width or not finite (names it), dynamic gestures of fewer than 8
  /// frames, and the models svm and bayes, which keep too little; Interrupted.
  [[nodiscard]] GestureRecognizer with_gesture(const std::vector<GestureSample>& samples,
                                               const StopCheck& should_stop = {}) const;

  static GestureRecognizer load(const std::string& path);
  void save(const std::string& path) const;
  [[nodiscard]] ModelFile to_model_file() const;
  static GestureRecognizer from_model_file(const ModelFile& file);

  /// The rows of `frames` that show a hand, see GestureFeatureComputer.
  static MatrixF features(const std::vector<HandImage>& frames, const HandFeatureOptions& options);

  /// The rows of a clip (BGR) in which `source` finds the hand, or both, as `options` say.
  static MatrixF features(Span<const ImageView> clip, const HandSource& source,
                          const GestureRecognizerOptions& options);

  /// Recognises one gesture (a still is one frame) by hands that were found in its frames. No hand
  /// in any frame gives no_input. Throws InvalidArgument for a recogniser of both hands.
  [[nodiscard]] Decision recognise(Span<const HandObservation> hands) const;
  /// The same by both hands (num_hands 2): spans of equal length, of the left and of the right
  /// hand of the picture. Throws InvalidArgument where the number of hands is another.
  [[nodiscard]] Decision recognise(Span<const HandObservation> left,
                                   Span<const HandObservation> right) const;
  /// The same by the frames themselves (BGR), in which `source` finds the hand, or both.
  [[nodiscard]] Decision recognise(Span<const ImageView> clip, const HandSource& source) const;
  [[nodiscard]] Decision recognise_features(ConstMatrixRefF features) const;

  /// Raw score of every label for features with at least one row.
  [[nodiscard]] VectorF scores(ConstMatrixRefF features) const;

  [[nodiscard]] const std::vector<std::string>& labels() const { return labels_; }
  [[nodiscard]] const GestureRecognizerOptions& options() const { return options_; }
  [[nodiscard]] const Calibration& calibration() const { return calibration_; }
  /// On gestures held out in training, of signers held out where every gesture is left without
  /// them, else of recordings; empty where none could be held out. Gestures are also treated as
  /// unknown where there are three or more and the model is rbf or trajectory: verifier and report
  /// are made from the same of them. Gestures added since are not in it.
  [[nodiscard]] const HeldOutReport& held_out() const { return held_out_; }
  /// What makes rows of features of observations, as its options say.
  [[nodiscard]] const GestureFeatureComputer& front_end() const { return *front_end_; }

  /// Whether it was trained on dynamic gestures, scored whole, rather than on signs that are held,
  /// whose frames vote.
  [[nodiscard]] bool is_dynamic() const;

  /// Whether most gestures trained on began with a hand that rested in view (model trajectory):
  /// then a hand that comes into view and rests has shown nothing yet.
  [[nodiscard]] bool starts_at_rest() const;
  /// Whether most were made of several strokes with pauses between them (model trajectory): then
  /// the movement before a short pause may belong to a gesture.
  [[nodiscard]] bool pauses() const;

 private:
  GestureRecognizer() = default;
  static GestureRecognizer read(const ModelFile& file);

  GestureRecognizerOptions options_;
  std::optional<GestureFeatureComputer> front_end_;
  std::vector<std::string> labels_;
  std::shared_ptr<const detail::GestureScorer> scorer_;
  LogisticRegression
      verifier_;  // of the scorer's confidence features; empty where nothing was learned
  Calibration calibration_;
  HeldOutReport held_out_;
};

}  // namespace hri
