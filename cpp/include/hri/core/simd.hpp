// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Run-time CPU dispatch for hot loops: the compiler makes one clone per instruction set and the
// loader picks one. Put HRI_SIMD_CLONES in front of a non-inline function in a .cpp file. Shipped
// builds never use -march=native.
#pragma once

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && defined(__gnu_linux__) && \
    !defined(HRI_NO_SIMD_CLONES)
#define HRI_SIMD_CLONES \
  __attribute__((target_clones("arch=skylake-avx512", "arch=haswell", "default")))
#else
#define HRI_SIMD_CLONES
#endif
