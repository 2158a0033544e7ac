// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Many normal random numbers at once, with the same bits on every machine.
#pragma once

#include "hri/core/random.hpp"
#include "hri/core/types.hpp"

namespace hri::detail {

struct NormalKernels {
  /// out[i] = sqrt(-2 log(u[i])) cos(2 pi v[i]), for u in (0, 1] and v in [0, 1); `count` is a
  /// multiple of 8. `out` may be u.
  void (*box_muller)(const double* u, const double* v, std::ptrdiff_t count, double* out);
};

/// Those of the widest instruction set this machine has.
const NormalKernels& normal_kernels();

/// Those of all instruction sets it has, for tests.
Span<const NormalKernels* const> all_normal_kernels();

/// What as many calls of random->normal() give, to rounding.
void fill_normals(Random* random, Span<double> out);

}  // namespace hri::detail
