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
  py::enum_<hri::FilterBankKind>(m, "FilterBankKind")
      .value("mel", hri::FilterBankKind::mel)
      .value("hfcc", hri::FilterBankKind::hfcc);
  py::enum_<hri::MelScale>(m, "MelScale")
      .value("htk", hri::MelScale::htk)
      .value("slaney", hri::MelScale::slaney);
  py::enum_<hri::FilterAxis>(m, "FilterAxis")
      .value("hz", hri::FilterAxis::hz)
      .value("mel", hri::FilterAxis::mel);

  py::class_<hri::FilterBankOptions> bank(m, "FilterBankOptions",
                                          "Triangular filters over a power spectrum.");
  hri_bind::options(bank)
      .field("kind", &hri::FilterBankOptions::kind)
      .field("num_filters", &hri::FilterBankOptions::num_filters)
      .field("low_hz", &hri::FilterBankOptions::low_hz)
      .field("high_hz", &hri::FilterBankOptions::high_hz)
      .field("erb_factor", &hri::FilterBankOptions::erb_factor)
      .field("warp", &hri::FilterBankOptions::warp)
      .field("warp_low_hz", &hri::FilterBankOptions::warp_low_hz)
      .field("warp_high_hz", &hri::FilterBankOptions::warp_high_hz)
      .field("mel_scale", &hri::FilterBankOptions::mel_scale)
      .field("axis", &hri::FilterBankOptions::axis)
      .field("unit_area", &hri::FilterBankOptions::unit_area);
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
