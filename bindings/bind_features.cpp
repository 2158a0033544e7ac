// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Features of speech.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "arrays.hpp"
#include "hri/features/cepstra.hpp"
#include "hri/features/time_normalisation.hpp"
#include "options.hpp"

namespace py = pybind11;

void bind_features(py::module_& m) {
  py::enum_<hri::FilterBankKind>(m, "FilterBankKind")
      .value("mel", hri::FilterBankKind::mel)
      .value("hfcc", hri::FilterBankKind::hfcc);
  py::enum_<hri::Normalisation>(m, "Normalisation")
      .value("none", hri::Normalisation::none)
      .value("level", hri::Normalisation::level)
      .value("mean", hri::Normalisation::mean)
      .value("mean_variance", hri::Normalisation::mean_variance);

  py::class_<hri::FilterBankOptions> bank(m, "FilterBankOptions",
                                          "Triangular filters over a power spectrum.");
  hri_bind::options(bank)
      .field("kind", &hri::FilterBankOptions::kind)
      .field("num_filters", &hri::FilterBankOptions::num_filters)
      .field("low_hz", &hri::FilterBankOptions::low_hz)
      .field("high_hz", &hri::FilterBankOptions::high_hz)
      .field("erb_factor", &hri::FilterBankOptions::erb_factor)
      .field("warp", &hri::FilterBankOptions::warp);
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

  py::class_<hri::CepstraOptions> cepstra(m, "CepstraOptions", "Cepstra of speech (MFCC, HFCC).");
  hri_bind::options(cepstra)
      .field("sample_rate_hz", &hri::CepstraOptions::sample_rate_hz)
      .field("frame_length_ms", &hri::CepstraOptions::frame_length_ms)
      .field("frame_shift_ms", &hri::CepstraOptions::frame_shift_ms)
      .field("pre_emphasis", &hri::CepstraOptions::pre_emphasis)
      .field("filter_bank", &hri::CepstraOptions::filter_bank)
      .field("num_filters", &hri::CepstraOptions::num_filters)
      .field("low_hz", &hri::CepstraOptions::low_hz)
      .field("high_hz", &hri::CepstraOptions::high_hz)
      .field("erb_factor", &hri::CepstraOptions::erb_factor)
      .field("warp", &hri::CepstraOptions::warp)
      .field("num_cepstra", &hri::CepstraOptions::num_cepstra)
      .field("use_c0", &hri::CepstraOptions::use_c0)
      .field("lifter", &hri::CepstraOptions::lifter)
      .field("normalisation", &hri::CepstraOptions::normalisation)
      .field("delta_orders", &hri::CepstraOptions::delta_orders)
      .field("delta_window", &hri::CepstraOptions::delta_window);
  py::class_<hri::CepstraComputer>(m, "CepstraComputer", "Cepstra of whole clips.")
      .def(py::init<const hri::CepstraOptions&>(), py::arg("options") = hri::CepstraOptions{})
      .def_property_readonly("options", &hri::CepstraComputer::options)
      .def_property_readonly("num_features", &hri::CepstraComputer::num_features)
      .def("num_frames", &hri::CepstraComputer::num_frames, py::arg("num_samples"))
      .def(
          "compute",
          [](const hri::CepstraComputer& self, const hri_bind::FloatArray& audio) {
            const auto samples = hri_bind::as_span(audio, "audio");
            py::array_t<float> out({static_cast<py::ssize_t>(self.num_frames(samples.size())),
                                    static_cast<py::ssize_t>(self.num_features())});
            Eigen::Map<hri::MatrixF> rows(out.mutable_data(), out.shape(0), out.shape(1));
            const py::gil_scoped_release release;
            self.compute(samples, rows);
            return out;
          },
          py::arg("audio"),
          "Features, float32, shape (num_frames, num_features); raises InvalidArgument for NaN.");

  m.def(
      "normalise_time",
      [](const hri_bind::FloatArray& frames, int num_rows) {
        return hri_bind::to_array(
            hri::normalise_time(hri_bind::as_matrix(frames, "frames"), num_rows));
      },
      py::arg("frames"), py::arg("num_rows"),
      "Frames stretched or squeezed to num_rows rows by linear interpolation, float32.");
}
