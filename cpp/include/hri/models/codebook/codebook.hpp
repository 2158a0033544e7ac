// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Vector quantisation by Linde, Buzo and Gray (IEEE Trans. Commun. 28, 1980), thesis eq. 4.33-4.35.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/options.hpp"
#include "hri/core/stop_check.hpp"
#include "hri/core/types.hpp"
#include "hri/io/model_file.hpp"

namespace hri {

namespace detail {
class CodewordTable;
}

struct CodebookOptions {
  int num_codewords = 64;
  int max_iterations = 50;
  double tolerance = 1e-4;
  double split_epsilon = 0.01;
  StopCheck should_stop;

  static constexpr const char* kName = "CodebookOptions";
  template <class Self, class Visitor>
  static void visit(Self& o, Visitor&& v) {
    v("num_codewords", o.num_codewords, within(1, 65536),
      "codewords; fewer come out where the data have fewer different rows");
    v("max_iterations", o.max_iterations, within(1, 100000),
      "iterations of k-means after each split");
    v("tolerance", o.tolerance, within(0, 1e6),
      "training stops when the distortion falls by a smaller share");
    v("split_epsilon", o.split_epsilon, above(0, 1000),
      "a codeword splits into c + e s and c - e s, s the deviation of its cell");
  }
};

/// How the training of a codebook went: one entry an iteration of k-means.
struct CodebookReport {
  std::vector<int> sizes;           ///< codewords there were
  std::vector<double> distortions;  ///< mean squared distance, before the centroids moved
  bool converged = false;           ///< false: the iteration limit ended the last size
};

/// Immutable; const calls are safe from several threads. Invariant: at least one codeword, all
/// finite.
class HRI_API Codebook {
 public:
  /// Throws InvalidArgument for an empty or non-finite matrix.
  explicit Codebook(MatrixF centroids);

  /// Grows from one codeword by splitting. Cells that run empty take half of the cell with the
  /// largest distortion; every codeword that comes out has rows. Throws InvalidArgument for no rows
  /// or values not finite (names row and column).
  static Codebook train_lbg(ConstMatrixRefF rows, const CodebookOptions& options,
                            CodebookReport* report = nullptr);
  /// k-means from the centroids given, as many as come out; `num_codewords` is not used.
  static Codebook train_kmeans(ConstMatrixRefF rows, ConstMatrixRefF centroids,
                               const CodebookOptions& options, CodebookReport* report = nullptr);

  [[nodiscard]] int size() const { return static_cast<int>(centroids_.rows()); }
  [[nodiscard]] int dim() const { return static_cast<int>(centroids_.cols()); }
  [[nodiscard]] const MatrixF& centroids() const { return centroids_; }

  /// The nearest codeword of one frame (the lower index where two are as near).
  [[nodiscard]] int quantise(Span<const float> frame) const;
  /// One symbol a row. Frames with NaN or infinity are refused with row and column.
  [[nodiscard]] std::vector<std::int32_t> quantise(ConstMatrixRefF frames) const;
  /// Into the caller's buffer; allocates nothing.
  void quantise(ConstMatrixRefF frames, Span<std::int32_t> out) const;
  /// The same with `stride` places of `out` from one row's symbol to the next row's.
  void quantise(ConstMatrixRefF frames, std::int32_t* out, std::ptrdiff_t stride) const;
  /// Mean squared distance of the rows to their codewords.
  [[nodiscard]] double distortion(ConstMatrixRefF frames) const;

  void write(ModelFile& file, const std::string& prefix) const;
  static Codebook read(const ModelFile& file, const std::string& prefix);

 private:
  MatrixF centroids_;
  std::shared_ptr<const detail::CodewordTable> table_;  // never changed, so copies share it
};

}  // namespace hri
