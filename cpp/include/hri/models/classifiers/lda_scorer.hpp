// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Scores a vector against one Gaussian a class, all of one covariance: minus half the squared
// distance to the mean of the class among linear discriminants (lda.hpp).
#pragma once

#include <string>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/types.hpp"
#include "hri/io/model_file.hpp"
#include "hri/models/classifiers/lda.hpp"
#include "hri/models/sequence_scorer.hpp"

namespace hri {

/// How vectors are scored.
struct VectorScoring {
  double shrinkage = 0.2;  ///< of the covariance, see LdaOptions
  double weight = 1;       ///< factor on all scores
};

/// Immutable; const calls are safe from several threads.
class HRI_API LdaScorer {
 public:
  /// Of vectors as matrices of one row: those of every class, none empty, and those of fillers,
  /// words outside the vocabulary, which shape the discriminants too. Throws InvalidArgument as
  /// Lda::train() does.
  static LdaScorer train(const ClassSequences& classes, const ClassSequences& fillers,
                         const VectorScoring& options);

  [[nodiscard]] int num_classes() const { return static_cast<int>(means_.rows()); }
  [[nodiscard]] int num_fillers() const { return static_cast<int>(fillers_.rows()); }
  [[nodiscard]] int dim() const { return lda_.dim(); }
  [[nodiscard]] int num_components() const { return lda_.num_components(); }

  /// Score of every class, shape (num_classes,), for a matrix of one row.
  [[nodiscard]] VectorF scores(ConstMatrixRefF vector) const;
  /// Score of every filler, shape (num_fillers,).
  [[nodiscard]] VectorF filler_scores(ConstMatrixRefF vector) const;

  /// All means moved by what the vectors lie off those of their classes, on average; so many
  /// imagined vectors that lie off by nothing hold that back.
  [[nodiscard]] LdaScorer adapted(const ClassSequences& classes, double prior_vectors) const;
  /// With one class more, of number `index`.
  [[nodiscard]] LdaScorer with_class(int index, const std::vector<MatrixF>& vectors) const;
  [[nodiscard]] LdaScorer without_class(int index) const;
  /// The same with another factor on all scores. Throws InvalidArgument for one out of range.
  [[nodiscard]] LdaScorer with_weight(double weight) const;

  void write(ModelFile& file, const std::string& prefix) const;
  /// Throws FormatError where the sizes do not fit.
  static LdaScorer read(const ModelFile& file, const std::string& prefix, int num_classes);

 private:
  LdaScorer(Lda lda, MatrixF means, MatrixF fillers, double weight);
  [[nodiscard]] VectorF scores_of(const MatrixF& means, ConstMatrixRefF vector) const;

  Lda lda_;
  MatrixF means_;    // among the discriminants, shape (num_classes, num_components)
  MatrixF fillers_;  // shape (num_fillers, num_components)
  double weight_;
};

}  // namespace hri
