// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Scores one vector that stands for a whole sequence: the log posteriors of softmax regression say
// which class it is, its squared distances to the means of classes and fillers among linear
// discriminants (lda.hpp) whether it is any.
#pragma once

#include <string>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/types.hpp"
#include "hri/io/model_file.hpp"
#include "hri/models/classifiers/lda.hpp"
#include "hri/models/classifiers/softmax_regression.hpp"
#include "hri/models/sequence_scorer.hpp"

namespace hri {

/// How vectors are scored.
struct VectorScoring {
  double penalty = 100;    ///< of softmax regression, see SoftmaxRegressionOptions
  double shrinkage = 0.8;  ///< of the covariance, see LdaOptions
};

/// Immutable; const calls are safe from several threads.
class HRI_API VectorScorer {
 public:
  /// Of vectors as matrices of one row: those of every class, none empty, and those of fillers,
  /// words outside the vocabulary, which shape the discriminants too. Throws InvalidArgument as
  /// Lda::train() and SoftmaxRegression::train() do.
  static VectorScorer train(const ClassSequences& classes, const ClassSequences& fillers,
                            const VectorScoring& options, const StopCheck& should_stop = {});

  [[nodiscard]] int num_classes() const { return static_cast<int>(means_.rows()); }
  [[nodiscard]] int num_fillers() const { return static_cast<int>(fillers_.rows()); }
  [[nodiscard]] int dim() const { return lda_.dim(); }
  [[nodiscard]] double weight() const { return weight_; }

  /// Log posterior of every class, but for a constant, times weight(); shape (num_classes,), for a
  /// matrix of one row.
  [[nodiscard]] VectorF scores(ConstMatrixRefF vector) const;
  /// Squared distance to the mean of every class, shape (num_classes,).
  [[nodiscard]] VectorF squared_distances(ConstMatrixRefF vector) const;
  /// The same to every filler, shape (num_fillers,).
  [[nodiscard]] VectorF filler_squared_distances(ConstMatrixRefF vector) const;

  /// Everything moved by what the vectors lie off the means of their classes, on average; so many
  /// imagined vectors that lie off by nothing hold that back.
  [[nodiscard]] VectorScorer adapted(const ClassSequences& classes, double prior_vectors) const;
  /// With one class more, of number `index`; what is known of the others stays as it is.
  [[nodiscard]] VectorScorer with_class(int index, const std::vector<MatrixF>& vectors,
                                        const StopCheck& should_stop = {}) const;
  [[nodiscard]] VectorScorer without_class(int index) const;
  /// The same with another factor on all scores (1 at first). Throws InvalidArgument for one out of
  /// range.
  [[nodiscard]] VectorScorer with_weight(double weight) const;

  void write(ModelFile& file, const std::string& prefix) const;
  /// Throws FormatError where the sizes do not fit.
  static VectorScorer read(const ModelFile& file, const std::string& prefix, int num_classes);

 private:
  VectorScorer(SoftmaxRegression softmax, Lda lda, MatrixF means, MatrixF fillers);
  void place_means();

  SoftmaxRegression softmax_;
  Lda lda_;
  MatrixF means_;                        // of vectors, shape (num_classes, dim)
  MatrixF fillers_;                      // shape (num_fillers, dim)
  MatrixF mean_places_, filler_places_;  // the same among the discriminants
  double penalty_ = 0;                   // that the regression was trained with
  double vectors_per_class_ = 1;
  double weight_ = 1;
};

}  // namespace hri
