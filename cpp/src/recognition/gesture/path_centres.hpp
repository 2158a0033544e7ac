// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// The mean paths of every class. A movement outside the vocabulary may lie on the right side of a
// separating plane, yet far from all that was ever seen there.
#pragma once

#include <vector>

#include "hri/core/types.hpp"
#include "hri/io/model_file.hpp"

namespace hri::detail {

/// A path that was trained on.
struct KnownPath {
  VectorF path;
  int klass = 0;
  bool last_movement = false;  ///< of a gesture that pauses; else the whole gesture
};

/// Immutable once trained.
class PathCentres {
 public:
  PathCentres() = default;

  /// Every class needs a whole gesture.
  static PathCentres train(const std::vector<KnownPath>& paths, int num_classes);

  /// Log of the squared distance of a path to the nearest centre of a class, against how far paths
  /// lie from their centres on the average.
  [[nodiscard]] float log_distance(const VectorF& path, Eigen::Index klass) const;

  void write(ModelFile& file) const;
  /// Throws FormatError where the centres do not fit paths of `dim` values and the classes.
  static PathCentres read(const ModelFile& file, int dim, int num_classes);

 private:
  // Two rows a class: of whole gestures, and of last movements; where there are none, of whole
  // gestures again.
  MatrixF centres_;
  double usual_ = 1;
};

}  // namespace hri::detail
