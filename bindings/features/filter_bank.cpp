// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Filter banks.
#include "hri/features/speech/filter_bank.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "core/arrays.hpp"
#include "core/options.hpp"

namespace py = pybind11;

void bind_filter_bank(py::module_& m) {
  hri_bind::bind_options<hri::FilterBankOptions>(m, "Triangular filters over a power spectrum.");
  m.def(
      "filter_bank",
      [](const hri::FilterBankOptions& options, int sample_rate_hz, int fft_size) {
        return hri_bind::to_array(hri::FilterBank(options, sample_rate_hz, fft_size).weights());
      },
      py::arg("options"), py::arg("sample_rate_hz"), py::arg("fft_size"),
      "Weights, float32, shape (num_filters, fft_size / 2 + 1).");
  m.def(
      "filter_edges",
      [](const hri::FilterBankOptions& options, int sample_rate_hz) {
        const auto triangles = hri::filter_triangles(options, sample_rate_hz);
        hri::MatrixD edges(static_cast<Eigen::Index>(triangles.size()), 3);
        for (Eigen::Index i = 0; i < edges.rows(); ++i) {
          const auto& t = triangles[static_cast<std::size_t>(i)];
          edges.row(i) << t.low_hz, t.centre_hz, t.high_hz;
        }
        return hri_bind::to_array(edges);
      },
      py::arg("options"), py::arg("sample_rate_hz"),
      "Low, centre and high frequency in Hz, shape (num_filters, 3).");
}
