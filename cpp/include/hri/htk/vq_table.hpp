// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// HTK's VQ tables, by which frames become codewords of discrete models (HTK Book, HQuant).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/types.hpp"
#include "hri/htk/parameter_kind.hpp"
#include "hri/models/codebook/codebook.hpp"

namespace hri::htk {

/// Codewords of one stream, in a list or as leaves of a binary tree.
struct HRI_API VqTable {
  /// How near a frame is to a node: by the squared distance, or with that of every column times the
  /// inverse variance of the node, less the log of these.
  enum class Distance : std::uint8_t { variances = 1, euclidean = 5 };

  struct Node {
    int codeword = 0;  ///< from 1; 0: none, a fork of a tree
    int id = 1;        ///< differs from node to node, above 0
    int left = 0;      ///< id of the node below; 0: none
    int right = 0;     ///< the same; of a list the next node
    VectorF mean;
    VectorF inverse_variance;  ///< empty where the distance is euclidean
  };

  ParameterKind kind;  ///< of the frames; ANON: any, which files have as 0
  bool is_tree = false;
  Distance distance = Distance::euclidean;
  std::vector<Node> nodes;  ///< of a tree the root first

  /// Throws IoError; FormatError naming file and line for whatever is no such table, codewords that
  /// are not 1, 2, ... each once, nodes that are no tree, and what is not read: several streams and
  /// full covariances.
  static VqTable read(const std::string& path);
  /// The same from memory; `name` stands for the path in messages.
  static VqTable parse(const std::string& text, const std::string& name);

  /// A list of the codewords of `codebook`. `deviation`, of frames before each column was divided
  /// by its own: the codebook is of such frames, and the distance is by variances; empty: it is
  /// euclidean. Throws InvalidArgument for more than 4096 codewords, and deviations that are not
  /// one a column above 0.
  static VqTable of_codebook(const Codebook& codebook, ParameterKind kind,
                             const VectorF& deviation = {});

  /// The text of a file; numbers read back equal. Throws InvalidArgument for what parse() refuses.
  [[nodiscard]] std::string to_text() const;
  void write(const std::string& path) const;

  [[nodiscard]] int num_codewords() const;
  [[nodiscard]] int dim() const;

  /// The nearest codeword of every row, from 1; in a tree, the way goes to the nearer node at every
  /// fork. The first of those as near. Throws InvalidArgument for another number of columns, values
  /// not finite, and nodes that are no tree.
  [[nodiscard]] std::vector<std::int32_t> quantise(ConstMatrixRefF frames) const;
};

}  // namespace hri::htk
