// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Possibility-theory HMMs over frames: emissions are Gaussian mixtures, scaled frame by frame over
// all classes and states (thesis eq. 5.14). Otherwise as possibilistic_hmm.hpp.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/types.hpp"
#include "hri/io/model_file.hpp"
#include "hri/models/hmm/gaussian_mixture_hmm.hpp"
#include "hri/models/possibility/possibilistic_hmm.hpp"
#include "hri/models/possibility/possibility.hpp"
#include "hri/models/possibility/state_possibilities.hpp"

namespace hri {

namespace detail {
template <class T>
class PossibilityChains;
}

/// Immutable; const calls are safe from several threads. Invariant: at every frame the emission of
/// the best state of all classes has possibility 1.
class HRI_API PossibilisticGaussianHmmSet {
 public:
  /// Throws InvalidArgument unless all models have one topology and dimension.
  explicit PossibilisticGaussianHmmSet(std::vector<GaussianMixtureHmm> models,
                                       const PossibilisticRule& rule = {});

  /// Trains every class on its own sequences by Baum-Welch. `per_class[c]` must not be empty.
  static PossibilisticGaussianHmmSet train(const std::vector<std::vector<MatrixF>>& per_class,
                                           const GaussianMixtureHmmOptions& options,
                                           const PossibilisticRule& rule = {});

  /// The set with one class more, which comes last; no other class is trained again.
  [[nodiscard]] PossibilisticGaussianHmmSet with_class(GaussianMixtureHmm model) const;

  /// log possibility of the frames under each class, shape (num_classes,), natural log. The chains
  /// cost as much as those of PossibilisticHmmSet; densities come on top. Throws InvalidArgument
  /// for no frames, another dimension or values that are not finite.
  [[nodiscard]] VectorF log_possibilities(ConstMatrixRefF frames) const;
  /// The same into the caller's buffer (num_classes), without allocating once the thread has scored
  /// as many frames.
  void log_possibilities(ConstMatrixRefF frames, Span<float> out) const;

  /// Possibility and necessity of each class given the frames (eq. 5.14-5.15).
  [[nodiscard]] Possibilities classify(ConstMatrixRefF frames) const;

  /// The most possible path of one class and its log possibility, computed in double; empty where
  /// it is impossible. Throws InvalidArgument for another class, and as log_possibilities() does.
  double viterbi(int class_index, ConstMatrixRefF frames, std::vector<int>* path = nullptr) const;

  /// As PossibilisticHmmSet::state_possibilities; densities of all classes come on top. Throws
  /// InvalidArgument as viterbi() does, and for a conditioned minimum unless concentration is 1.
  [[nodiscard]] StatePossibilities state_possibilities(int class_index,
                                                       ConstMatrixRefF frames) const;

  [[nodiscard]] int num_classes() const { return static_cast<int>(models_.size()); }
  [[nodiscard]] int dim() const { return models_.front().dim(); }
  [[nodiscard]] const Topology& topology() const { return models_.front().chain().topology(); }
  [[nodiscard]] const PossibilisticRule& rule() const { return rule_; }
  /// The models before scaling.
  [[nodiscard]] const std::vector<GaussianMixtureHmm>& models() const { return models_; }

  void write(ModelFile& file, const std::string& prefix) const;
  static PossibilisticGaussianHmmSet read(const ModelFile& file, const std::string& prefix);

 private:
  [[nodiscard]] MatrixD log_emissions(int class_index, ConstMatrixRefF frames) const;

  std::vector<GaussianMixtureHmm> models_;
  PossibilisticRule rule_;
  std::shared_ptr<const detail::PossibilityChains<float>> chains_;  // immutable
};

}  // namespace hri
