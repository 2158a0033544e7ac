// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Log scores of the states of all models of a ConnectedDecoder, frame by frame.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "hri/core/cache_line.hpp"
#include "hri/core/export.hpp"
#include "hri/core/types.hpp"
#include "hri/models/codebook/multi_stream_codebook.hpp"
#include "hri/models/hmm/gaussian_mixture_hmm.hpp"
#include "hri/models/possibility/possibilistic_hmm.hpp"

namespace hri {

/// Log densities of Gaussian-mixture HMMs. Immutable; const calls are safe from several threads.
class HRI_API GaussianEmissions {
 public:
  /// Throws InvalidArgument for no model and for models of different dimensions.
  explicit GaussianEmissions(std::vector<GaussianMixtureHmm> models);

  /// Of `frames` (num_frames, dim()) into `out` (num_frames, num_states()), natural log, model by
  /// model. Allocates nothing once the thread has scored as many frames. Throws InvalidArgument for
  /// other shapes and values not finite.
  void compute(ConstMatrixRefF frames, MatrixRefF out) const;

  /// The densities of some columns alone, whatever the others are. Throws InvalidArgument for no
  /// columns and those that there are not.
  [[nodiscard]] GaussianEmissions marginal(Span<const int> columns) const;

  [[nodiscard]] int dim() const { return models_.front().dim(); }
  [[nodiscard]] int num_states() const { return num_states_; }  ///< of all models
  [[nodiscard]] const std::vector<GaussianMixtureHmm>& models() const { return models_; }

 private:
  std::vector<GaussianMixtureHmm> models_;
  int num_states_ = 0;
};

/// Log possibilities of a set of possibility-theory HMMs (thesis eq. 5.14), scaled over all models
/// as the set is. Its conjunction has to be the product: log scores add up along a path. Immutable;
/// const calls are safe from several threads.
class HRI_API PossibilisticEmissions {
 public:
  /// Throws InvalidArgument for a set of another conjunction.
  explicit PossibilisticEmissions(const PossibilisticHmmSet& set);

  /// Of one symbol, num_states() values, model by model. Throws InvalidArgument for an unknown one.
  [[nodiscard]] Span<const float> of(std::int32_t symbol) const;

  [[nodiscard]] int num_states() const { return static_cast<int>(table_.cols()); }
  [[nodiscard]] int num_symbols() const { return static_cast<int>(table_.rows()); }

 private:
  MatrixF table_;  // by symbol
};

/// Log possibilities (thesis eq. 5.14) of Gaussian-mixture HMMs over the symbols of codebooks, one
/// a column: the density of a state at the codeword, divided by the largest of all models and
/// states; columns are joined by the product. Immutable; const calls are safe from several threads.
class HRI_API CodedPossibilities {
 public:
  /// Throws InvalidArgument unless the codebook has a stream for every column of the models.
  CodedPossibilities(const GaussianEmissions& models, MultiStreamCodebook codebook);

  /// Of `frames` (num_frames, dim()) into `out` (num_frames, num_states()), natural log, model by
  /// model. Allocates nothing once the thread has computed as many states. Throws InvalidArgument
  /// for other shapes and values not finite.
  void compute(ConstMatrixRefF frames, MatrixRefF out) const;
  /// The same of some columns alone: those of `frames` (num_frames, dim()) with these numbers.
  /// Throws InvalidArgument for no columns and those that there are not, too.
  void compute(ConstMatrixRefF frames, Span<const int> columns, MatrixRefF out) const;

  [[nodiscard]] int dim() const { return codebook_.dim(); }
  [[nodiscard]] int num_states() const { return num_states_; }
  [[nodiscard]] const MultiStreamCodebook& codebook() const { return codebook_; }

 private:
  struct Column {
    std::vector<float> borders;  // between codewords, rising, padded
    std::ptrdiff_t first_row;    // of the table: that of the lowest codeword
  };

  MultiStreamCodebook codebook_;
  int num_states_;
  std::ptrdiff_t stride_;  // of the table
  std::vector<Column> columns_;
  std::vector<int> all_columns_;  // their numbers
  // By column of the frames and codeword, rising, and state; rows are padded.
  std::vector<float, detail::CacheLineAllocator<float>> table_;
};

}  // namespace hri
