// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Scores of several HMMs while their input still arrives, frame by frame.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/options.hpp"
#include "hri/core/types.hpp"
#include "hri/models/hmm/discrete_hmm.hpp"
#include "hri/models/hmm/gaussian_mixture_hmm.hpp"

namespace hri {

struct HmmStreamOptions {
  double beam = std::numeric_limits<double>::infinity();

  static constexpr const char* kName = "HmmStreamOptions";
  template <class Self, class Visitor>
  static void visit(Self& o, Visitor&& v) {
    v("beam", o.beam, above(0, 1e12).or_infinity(),
      "models whose log-likelihood falls this much below the best (natural log, of all frames so "
      "far) are dropped until reset()");
  }
};

/// What one frame of a model is.
template <class Model>
struct HmmFrame;
template <>
struct HmmFrame<DiscreteHmm> {
  using Type = std::int32_t;
};
template <>
struct HmmFrame<GaussianMixtureHmm> {
  using Type = Span<const float>;
};

/// After any number of frames the scores are those of Model::log_likelihood() of all of them. For
/// one thread at a time.
template <class Model>
class HRI_API HmmStream {
 public:
  using Frame = typename HmmFrame<Model>::Type;

  /// Throws InvalidArgument for no model, models over different symbols or dimensions, or a beam
  /// that is not positive.
  explicit HmmStream(std::vector<Model> models, const HmmStreamOptions& options = {});
  HmmStream(HmmStream&&) noexcept;
  HmmStream& operator=(HmmStream&&) noexcept;
  HmmStream(const HmmStream&) = delete;
  HmmStream& operator=(const HmmStream&) = delete;
  ~HmmStream();

  /// Advances all models by one frame; allocates nothing. Throws InvalidArgument for an unknown
  /// symbol, or values that are not finite or not dim() many; then nothing has changed.
  void push(Frame frame);

  /// log P(frames so far | model) of every model into `out` (num_models() values); 0 before the
  /// first frame, -inf for models that are dropped or impossible.
  void log_likelihoods(Span<double> out) const;

  /// The `count` best models (all, if there are fewer), best first, the lower index where two are
  /// equal; models at -inf are left out.
  [[nodiscard]] std::vector<int> nbest(int count) const;

  /// Back to before the first frame, with all models.
  void reset();

  [[nodiscard]] int num_models() const;
  [[nodiscard]] int num_active() const;  ///< models not dropped
  [[nodiscard]] std::int64_t num_frames() const;
  [[nodiscard]] const Model& model(int index) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

using DiscreteHmmStream = HmmStream<DiscreteHmm>;
using GaussianMixtureHmmStream = HmmStream<GaussianMixtureHmm>;

extern template class HmmStream<DiscreteHmm>;
extern template class HmmStream<GaussianMixtureHmm>;

}  // namespace hri
