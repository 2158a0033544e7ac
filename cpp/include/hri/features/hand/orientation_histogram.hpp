// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Orientation histograms of an image (Freeman and Roth, 1995; thesis section 4.6.4), over a grid of
// cells with overlapping blocks normalised as by Dalal and Triggs (CVPR 2005).
#pragma once

#include "hri/core/export.hpp"
#include "hri/core/options.hpp"
#include "hri/core/types.hpp"

namespace hri {

struct OrientationHistogramOptions {
  int num_cells = 8;
  int num_bins = 9;

  static constexpr const char* kName = "OrientationHistogramOptions";
  template <class Self, class Visitor>
  static void visit(Self& o, Visitor&& v) {
    v("num_cells", o.num_cells, within(1, 64),
      "cells along each side; 1 gives the single histogram of the thesis");
    v("num_bins", o.num_bins, within(2, 72), "orientations over 180 degrees");
  }
};

/// Values it gives: blocks of 2 x 2 cells, each (2 * 2 * num_bins) long; num_bins where there is
/// one cell.
HRI_API int orientation_histogram_size(const OrientationHistogramOptions& options);

/// Histograms of `image` (any size of at least num_cells a side, values in -1e6..1e6): central
/// differences, angle modulo 180 degrees, magnitude shared out linearly among neighbouring bins and
/// cells, blocks scaled to length 1, clipped at 0.2 and scaled again; a single cell (thesis eq.
/// 4.29-4.32) is scaled to length 1 only. A flat image gives zeros, and blocks whose gradients come
/// to far less than 0.1 together fade towards them. Throws InvalidArgument for sizes that do not
/// fit, and for a value that is not finite or too large (names row and column).
HRI_API void orientation_histogram(ConstMatrixRefF image,
                                   const OrientationHistogramOptions& options, Span<float> out);

}  // namespace hri
