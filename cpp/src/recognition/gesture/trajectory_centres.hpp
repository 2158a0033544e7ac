// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// The mean trajectories of every class. A gesture outside the vocabulary may lie on the right side
// of a separating plane, yet far from all that was ever seen there.
#pragma once

#include <vector>

#include "hri/core/types.hpp"
#include "hri/io/model_file.hpp"

namespace hri::detail {

/// A trajectory that was trained on.
struct KnownTrajectory {
  VectorF trajectory;
  int klass = 0;
  bool final_stroke = false;  ///< of a gesture that pauses; else the whole gesture
};

/// Immutable once trained.
class TrajectoryCentres {
 public:
  TrajectoryCentres() = default;

  /// Every class needs a whole gesture.
  static TrajectoryCentres train(const std::vector<KnownTrajectory>& trajectories, int num_classes);

  /// With one class more, of number `index`, from trajectories of it, at least one of them whole.
  /// What is usual stays: few gestures say too little of how far others may lie.
  [[nodiscard]] TrajectoryCentres with_class(
      int index, const std::vector<KnownTrajectory>& trajectories) const;

  /// The centres as trajectories, which stand for what the classes were trained on.
  [[nodiscard]] std::vector<KnownTrajectory> trajectories() const;

  /// Log of the squared distance of a trajectory to the nearest centre of a class, against how far
  /// trajectories lie from their centres on the average.
  [[nodiscard]] float log_distance(const VectorF& trajectory, Eigen::Index klass) const;

  /// Logs of squared distances to the nearest centre of a class, by parts. What stays the same of a
  /// shape, mostly the hand and the light, is left out.
  struct Distances {
    double shape = 0;  ///< of how the shape changes
    double way = 0;    ///< of where the hand goes, and how large it gets
  };
  [[nodiscard]] Distances log_distances(const VectorF& trajectory, Eigen::Index klass) const;

  void write(ModelFile& file) const;
  /// Throws FormatError where the centres do not fit trajectories of `dim` values and the classes.
  static TrajectoryCentres read(const ModelFile& file, int dim, int num_classes);

 private:
  // Two rows a class: of whole gestures, and of final strokes; where there are none, of whole
  // gestures again.
  MatrixF centres_;
  double usual_ = 1;
};

}  // namespace hri::detail
