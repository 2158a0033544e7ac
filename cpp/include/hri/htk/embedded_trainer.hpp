// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// HERest: embedded Baum-Welch. The models of an utterance stand one behind the other as its
// transcript says, which needs no times; all models are estimated together (HTK Book, section 8.5).
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/options.hpp"
#include "hri/core/types.hpp"
#include "hri/htk/model_set.hpp"

namespace hri::htk {

struct EmbeddedTrainerOptions {
  double beam = 0;
  double beam_step = 0;
  double beam_limit = 0;
  int min_examples = 3;
  double weight_floor = 0;
  double min_variance = 0;
  bool update_transitions = true;
  bool update_means = true;
  bool update_variances = true;
  bool update_weights = true;

  static constexpr const char* kName = "EmbeddedTrainerOptions";
  template <class Self, class Visitor>
  static void visit(Self& o, Visitor&& v) {
    v("beam", o.beam, within(0, 1e12),
      "states whose backward score falls this much below the best of a frame (natural log) are "
      "dropped; 0: none is");
    v("beam_step", o.beam_step, within(0, 1e12),
      "added to the beam when nothing of an utterance is left; 0: it is left out");
    v("beam_limit", o.beam_limit, within(0, 1e12), "beam up to which the step is added");
    v("min_examples", o.min_examples, within(0, 1000000000),
      "models that occur less often in the transcripts stay as they are");
    v("weight_floor", o.weight_floor, within(0, 100000),
      "smallest mixture weight, in units of 1e-5");
    v("min_variance", o.min_variance, within(0, 1e12),
      "smallest variance; ~v \"varFloor1\" of the models holds beside it");
    v("update_transitions", o.update_transitions, any_value, "False: transitions stay");
    v("update_means", o.update_means, any_value, "False: means stay");
    v("update_variances", o.update_variances, any_value, "False: variances stay");
    v("update_weights", o.update_weights, any_value, "False: mixture weights stay");
  }
};

/// What became of an utterance.
enum class EmbeddedOutcome : std::uint8_t {
  added,
  too_short,   ///< it has fewer frames than its models take at least
  impossible,  ///< no path within the beam leads through it
};
constexpr auto enum_names(EmbeddedOutcome) {
  return std::array{"added", "too_short", "impossible"};
}

/// How often a model was met.
struct ModelOccupation {
  std::string name;
  std::int64_t num_examples = 0;  ///< in the transcripts
  std::vector<double> states;     ///< expected frames; those that share a state have its sum
};

/// Expectations of one pass over the utterances, from which all models are estimated. What macros
/// share is estimated of all that use it. Memory does not grow with the number of utterances. Not
/// for several threads.
class HRI_API EmbeddedTrainer {
 public:
  /// Throws InvalidArgument for options out of range, a set without models, models that no path
  /// leads through, vectors of several sizes, and a "varFloor1" that does not fit.
  explicit EmbeddedTrainer(const ModelSet& models, const EmbeddedTrainerOptions& options = {});
  ~EmbeddedTrainer();
  EmbeddedTrainer(EmbeddedTrainer&&) noexcept;
  EmbeddedTrainer& operator=(EmbeddedTrainer&&) noexcept;

  /// Adds an utterance, `frames` (num_frames, vector_size), by the names of its models in order;
  /// what does not fit changes nothing. Throws InvalidArgument for no model, one that there is not,
  /// another number of columns, and values not finite or, of discrete models, no codeword.
  EmbeddedOutcome add(ConstMatrixRefF frames, const std::vector<std::string>& units);

  /// The sums over the utterances added, for add_sums() of a trainer of the same models: passes
  /// over parts of the recordings, side by side. Throws IoError.
  void write_sums(const std::string& path) const;
  /// As if the utterances that a file sums up were added here. Throws IoError; FormatError naming
  /// file and field for sums of other models, and whatever is no such file.
  void add_sums(const std::string& path);

  /// The models as the utterances added make them most likely, given where they were. Parameters
  /// without frames stay. With means of several variances, each weighs by its own; variances are
  /// about the new means. Without floors no estimate is less likely than the models before it.
  [[nodiscard]] ModelSet estimate() const;

  /// Of the utterances added, under the models before estimation; natural log.
  [[nodiscard]] double log_likelihood() const;
  [[nodiscard]] std::int64_t num_frames() const;
  [[nodiscard]] std::vector<ModelOccupation> occupations() const;

 private:
  class Sums;
  std::unique_ptr<Sums> sums_;
};

}  // namespace hri::htk
