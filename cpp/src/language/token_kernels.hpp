// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// The steps of token passing, several states a register. A token is a score and an origin: what
// the words before it were. States are padded to whole blocks with such as nothing leads to.
// Scores are added and compared in one order whatever the instruction set, so that all give the
// same bits; of equal scores the first stays.
#pragma once

#include <cstddef>
#include <cstdint>

#include "hri/core/types.hpp"

namespace hri::detail {

/// States of a block; the widest register that is used holds so many scores.
constexpr int kTokenBlock = 4;

/// Tokens of a row of states or nodes. Of states one has to be able to read as far before the first
/// and behind the last as the offsets of their chain reach; what is there does not count.
struct Tokens {
  double* scores;  ///< -inf: there is none
  std::int64_t* origins;
};

/// A chain by how far steps lead: weights[k][to] is that of the step from to + offsets[k].
struct TokenSteps {
  const int* offsets;  ///< rising
  std::ptrdiff_t num_offsets;
  const double* weights;    ///< (num_offsets, size), -inf where there is no step
  std::ptrdiff_t size;      ///< a multiple of kTokenBlock
  const double* log_start;  ///< (size)
};

struct TokenKernels {
  /// The tokens of the states of blocks first_block up to, not with, end_block after one more
  /// frame: the best of one that arrives and of those before, with the emission added. Returns the
  /// best score among them.
  double (*advance)(const TokenSteps& steps, std::ptrdiff_t first_block, std::ptrdiff_t end_block,
                    double arrival_score, std::int64_t arrival_origin, const Tokens& before,
                    const float* emissions, const Tokens& after);
  /// -inf in place of every score below `lowest`. Returns whether any other is left in the block.
  bool (*prune)(double* scores, double lowest);
  /// A token goes to `count` nodes in a row, where it stays if it scores higher than what is there.
  void (*spread)(double score, std::int64_t origin, const double* weights, std::ptrdiff_t count,
                 const Tokens& nodes);
};

/// Those of the widest instruction set this machine has.
const TokenKernels& token_kernels();

/// Those of all instruction sets it has, for tests.
Span<const TokenKernels* const> all_token_kernels();

}  // namespace hri::detail
