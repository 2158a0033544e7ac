// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// k nearest neighbours by Euclidean distance.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/options.hpp"
#include "hri/core/types.hpp"
#include "hri/io/model_file.hpp"

namespace hri {

namespace detail {
class RowTable;
}

struct KnnOptions {
  int num_neighbours = 5;

  static constexpr const char* kName = "KnnOptions";
  template <class Self, class Visitor>
  static void visit(Self& o, Visitor&& v) {
    v("num_neighbours", o.num_neighbours, within(1, 1000),
      "neighbours that vote; fewer where there are fewer rows");
  }
};

/// Immutable; const calls are safe from several threads.
class HRI_API Knn {
 public:
  /// Throws InvalidArgument as validate_rows does.
  static Knn train(ConstMatrixRefF rows, Span<const int> classes, int num_classes,
                   const KnnOptions& options);

  /// With one class more, of number `index`. Throws InvalidArgument for rows not finite, none, or
  /// of another width, and for an index out of range.
  [[nodiscard]] Knn with_class(int index, ConstMatrixRefF rows) const;

  /// Share of the k nearest rows in every class, 0..1, shape (num_classes,); of two classes with as
  /// many neighbours the one whose nearest row is nearer has up to 1e-3 more.
  [[nodiscard]] VectorF decision_values(Span<const float> row) const;
  /// The same for many rows, a row each, equal to the bit and faster than one by one.
  [[nodiscard]] MatrixF decision_values(ConstMatrixRefF rows) const;
  /// Distance to the nearest row.
  [[nodiscard]] float nearest_distance(Span<const float> row) const;

  [[nodiscard]] int num_classes() const { return num_classes_; }
  [[nodiscard]] int dim() const { return dim_; }

  void write(ModelFile& file, const std::string& prefix) const;
  static Knn read(const ModelFile& file, const std::string& prefix);

 private:
  void keep(ConstMatrixRefF rows);

  std::shared_ptr<const detail::RowTable> rows_;  // never changed, so copies share it
  int dim_ = 0;
  std::vector<int> classes_;
  int num_classes_ = 0;
  int num_neighbours_ = 1;
};

}  // namespace hri
