// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Forwards and backwards through SequenceNetwork as it trains: with batch statistics and dropout.
// All values that are learned lie in one vector.
#pragma once

#include <cstdint>
#include <vector>

#include "hri/core/random.hpp"
#include "hri/core/types.hpp"
#include "hri/models/network/sequence_network.hpp"
#include "models/network/separable_unit.hpp"

namespace hri::detail {

constexpr float kVarianceFloor = 1e-5F;

/// Where a matrix lies in a vector of values.
struct Slot {
  Eigen::Index first = 0;
  Eigen::Index rows = 0;
  Eigen::Index cols = 0;

  [[nodiscard]] Eigen::Index size() const { return rows * cols; }

  static Eigen::Map<const MatrixF> matrix(const VectorF& values, const Slot& slot) {
    return {values.data() + slot.first, slot.rows, slot.cols};
  }
  static Eigen::Map<MatrixF> matrix(VectorF& values, const Slot& slot) {
    return {values.data() + slot.first, slot.rows, slot.cols};
  }
  static Eigen::Map<const VectorF> vector(const VectorF& values, const Slot& slot) {
    return {values.data() + slot.first, slot.size()};
  }
  static Eigen::Map<VectorF> vector(VectorF& values, const Slot& slot) {
    return {values.data() + slot.first, slot.size()};
  }
};

/// A separable convolution whose outputs are normalised by batch statistics, scaled and shifted.
struct UnitSlots {
  Slot kernel;   ///< shape (taps, in)
  Slot weights;  ///< shape (in, out)
  Slot scale, shift;
  Eigen::Index out = 0;
  Eigen::Index statistics = 0;  ///< where its channels begin among those of all units
};

class NetworkLayout {
 public:
  NetworkLayout(int dim, int num_classes, const SequenceNetworkOptions& options);

  [[nodiscard]] const std::vector<UnitSlots>& units() const { return units_; }
  [[nodiscard]] const Slot& head_weights() const { return head_weights_; }  ///< (pooled, classes)
  [[nodiscard]] const Slot& head_bias() const { return head_bias_; }
  /// Those that weight decay is for.
  [[nodiscard]] const std::vector<Slot>& decaying() const { return decaying_; }
  [[nodiscard]] Eigen::Index num_values() const { return num_values_; }
  [[nodiscard]] Eigen::Index num_statistics() const { return num_statistics_; }

  [[nodiscard]] VectorF initial(std::uint64_t seed) const;

 private:
  Slot take(Eigen::Index rows, Eigen::Index cols);
  void add_unit(Eigen::Index taps, Eigen::Index in, Eigen::Index out);

  std::vector<UnitSlots> units_;
  Slot head_weights_, head_bias_;
  std::vector<Slot> decaying_;
  Eigen::Index num_values_ = 0;
  Eigen::Index num_statistics_ = 0;
};

/// Some examples of a batch, and what is computed of them; used again for every batch.
class NetworkPart {
 public:
  explicit NetworkPart(const NetworkLayout& layout);

  void clear();
  void add(ConstMatrixRefF frames, int label);

  /// Computes the slopes, summed over the examples.
  void run(const VectorF& values, const SequenceNetworkOptions& options, Random* dropout);
  /// Computes the batch statistics, without dropout.
  void measure(const VectorF& values);

  /// Of the loss without weight decay, by every value.
  [[nodiscard]] const VectorF& slopes() const { return slopes_; }
  [[nodiscard]] double loss() const { return loss_; }
  [[nodiscard]] const VectorF& means() const { return means_; }
  [[nodiscard]] const VectorF& variances() const { return variances_; }

 private:
  struct Unit {
    MatrixF filtered, normal, output;
    VectorF inverse_deviation;
  };

  void forward(const VectorF& values, double dropout, Random* random);
  void forward(std::size_t unit, const VectorF& values, const MatrixF& input,
               const RowOffsets& offsets, int step, const MatrixF* residual, double dropout,
               Random* random);
  // From the slopes by the unit's output, which are used up; those by a residual are added up.
  void backward(std::size_t unit, const VectorF& values, const MatrixF& input,
                const RowOffsets& offsets, int step, double dropout, MatrixF* by_output,
                MatrixF* by_residual, MatrixF* by_input);
  // Mean and maximum over time, softmax and cross-entropy; gives the slopes by the last output.
  void judge(const VectorF& values, const SequenceNetworkOptions& options, Random* random,
             MatrixF* by_last);

  const NetworkLayout* layout_;
  RowOffsets offsets_{0};
  std::vector<int> labels_;
  std::vector<MatrixF> examples_;
  MatrixF input_;
  std::vector<Unit> units_;
  VectorF slopes_, means_, variances_;
  double loss_ = 0;
};

}  // namespace hri::detail
