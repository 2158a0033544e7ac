// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Vector quantisation by streams: groups of columns, such as static and delta cepstra, are coded
// apart by codebooks of their own (Gupta, Lennig and Mermelstein, ICASSP 1987).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/types.hpp"
#include "hri/io/model_file.hpp"
#include "hri/models/codebook/codebook.hpp"

namespace hri {

/// Immutable; const calls are safe from several threads. Invariant: at least one stream. The first
/// stream has the first columns of a frame, the next one those that follow.
class HRI_API MultiStreamCodebook {
 public:
  /// Throws InvalidArgument for no codebook.
  explicit MultiStreamCodebook(std::vector<Codebook> streams);

  /// One codebook a stream by LBG, all with the same options; `widths` are columns a stream and add
  /// up to the columns of the rows. `reports`, if given, gets one report a stream. Throws
  /// InvalidArgument for widths that do not fit, and where Codebook::train_lbg does.
  static MultiStreamCodebook train_lbg(ConstMatrixRefF rows, Span<const int> widths,
                                       const CodebookOptions& options,
                                       std::vector<CodebookReport>* reports = nullptr);

  [[nodiscard]] int num_streams() const { return static_cast<int>(streams_.size()); }
  [[nodiscard]] const Codebook& stream(int s) const {
    return streams_[static_cast<std::size_t>(s)];
  }
  /// Columns of a frame: the streams' widths together.
  [[nodiscard]] int dim() const { return dim_; }

  /// Symbols (num_frames, num_streams). Frames with NaN or infinity are refused with row and
  /// column.
  [[nodiscard]] Matrix<std::int32_t> quantise(ConstMatrixRefF frames) const;
  /// Into the caller's buffer, num_streams() symbols a frame; allocates nothing.
  void quantise(ConstMatrixRefF frames, Span<std::int32_t> out) const;
  /// Mean squared distance of the frames to their codewords: the sum of the streams'.
  [[nodiscard]] double distortion(ConstMatrixRefF frames) const;

  void write(ModelFile& file, const std::string& prefix) const;
  static MultiStreamCodebook read(const ModelFile& file, const std::string& prefix);

 private:
  void check(ConstMatrixRefF frames) const;

  std::vector<Codebook> streams_;
  int dim_ = 0;
};

}  // namespace hri
