// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Features of speech.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "core/arrays.hpp"
#include "core/options.hpp"
#include "hri/features/speech/cepstra_stream.hpp"
#include "hri/features/speech/spectral_envelope.hpp"
#include "hri/features/speech/time_normalisation.hpp"
#include "hri/signal/linear_prediction.hpp"

namespace py = pybind11;

namespace {

using Options = hri::CepstraOptions;
using Computer = hri::CepstraComputer;

void bind_cepstra_options(py::module_& m) {
  auto cepstra = hri_bind::bind_options<Options>(m, "Cepstra of speech (MFCC, HFCC, LPCC).");
  cepstra
      .def_static("htk", &Options::htk, py::arg("sample_rate_hz") = 16000,
                  "HTK's MFCC_0 by the configuration of the HTK book: c1 .. c12, c0.")
      .def_static("kaldi", &Options::kaldi, py::arg("sample_rate_hz") = 16000,
                  "Kaldi's compute-mfcc-feats by its defaults, without dither: log energy, c1 .. "
                  "c12.")
      .def_static("librosa", &Options::librosa, py::arg("sample_rate_hz") = 22050,
                  "librosa.feature.mfcc by its defaults: 20 cepstra of 128 filters.");
}

void bind_computer(py::module_& m) {
  py::class_<Computer>(m, "CepstraComputer", "Cepstra of whole clips.")
      .def(py::init<const Options&>(), py::arg("options") = Options{})
      .def_property_readonly("options", &Computer::options, "As passed, with defaults filled in.")
      .def_property_readonly("num_features", &Computer::num_features, "Columns of the features.")
      .def("num_frames", &Computer::num_frames, py::arg("num_samples"),
           "Frames of a clip of so many samples.")
      .def(
          "compute",
          [](const Computer& self, const hri_bind::FloatArray& audio) {
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
}

// The first `count` rows, for which `rows` was made.
py::array_t<float> first_rows(const hri::MatrixF& rows, int count) {
  py::array_t<float> out({static_cast<py::ssize_t>(count), static_cast<py::ssize_t>(rows.cols())});
  std::copy_n(rows.data(), count * rows.cols(), out.mutable_data());
  return out;
}

void bind_cepstra_stream(py::module_& m) {
  py::class_<hri::CepstraStream>(
      m, "CepstraStream",
      "Cepstra of audio that comes in blocks: the numbers of CepstraComputer, to "
      "the bit. One thread at a time.")
      .def(py::init<const Options&>(), py::arg("options"))
      .def_property_readonly("options", &hri::CepstraStream::options,
                             "As passed, with defaults filled in.")
      .def_property_readonly("num_features", &hri::CepstraStream::num_features,
                             "Columns of the features.")
      .def(
          "push",
          [](hri::CepstraStream& self, const hri_bind::FloatArray& audio) {
            const auto samples = hri_bind::as_span(audio, "audio");
            hri::MatrixF rows(self.max_frames(samples.size()), self.num_features());
            int count = 0;
            {
              const py::gil_scoped_release release;
              count = self.push(samples, rows);
            }
            return first_rows(rows, count);
          },
          py::arg("audio"), "Frames that are now complete, float32, shape (any, num_features).")
      .def(
          "finish",
          [](hri::CepstraStream& self, bool keep_normalisation) {
            hri::MatrixF rows(self.max_frames(0), self.num_features());
            const int count = self.finish(rows, keep_normalisation);
            return first_rows(rows, count);
          },
          py::arg("keep_normalisation") = false,
          "The frames that are left; then a new utterance may begin.")
      .def("reset", &hri::CepstraStream::reset, py::arg("keep_normalisation") = false,
           "Ready for the next utterance; the running normalisation may go on.");
}

void bind_linear_prediction(py::module_& m) {
  m.def(
      "linear_prediction",
      [](const hri_bind::DoubleArray& frame, int order) {
        const auto x = hri_bind::as_span(frame, "frame");
        hri::require(order >= 1, "order must be at least 1");
        std::vector<double> r(static_cast<std::size_t>(order) + 1);
        std::vector<double> a(static_cast<std::size_t>(order));
        hri::autocorrelation(x, r);
        const double gain = hri::levinson_durbin(r, a);
        return std::make_pair(hri_bind::to_array(a), gain);
      },
      py::arg("frame"), py::arg("order"),
      "(a, gain): x[n] is predicted as -a[0] x[n-1] - ..., by the autocorrelation method.");
  m.def(
      "lpc_cepstrum",
      [](const hri_bind::DoubleArray& a, double gain, int num_cepstra) {
        hri::require(num_cepstra >= 0, "num_cepstra must not be negative");
        std::vector<double> c(static_cast<std::size_t>(num_cepstra) + 1);
        hri::lpc_cepstrum(hri_bind::as_span(a, "a"), gain, c);
        return hri_bind::to_array(c);
      },
      py::arg("a"), py::arg("gain"), py::arg("num_cepstra"),
      "c0 .. c_num of the log spectrum ln(gain / |A|^2) = c0 + 2 sum of c_n cos(n w).");
}

}  // namespace

void bind_speech_features(py::module_& m) {
  bind_cepstra_options(m);
  bind_computer(m);
  bind_cepstra_stream(m);
  bind_linear_prediction(m);
  m.def(
      "spectral_envelope",
      [](const hri_bind::FloatArray& cepstra, int num_bins) {
        const hri::MatrixF rows = hri_bind::as_matrix(cepstra, "cepstra");
        if (num_bins < 1) throw py::value_error("num_bins must be at least 1");
        hri::MatrixF out(rows.rows(), num_bins);
        for (Eigen::Index t = 0; t < rows.rows(); ++t)
          hri::spectral_envelope(hri::row_span(rows, t),
                                 {out.data() + t * num_bins, static_cast<std::size_t>(num_bins)});
        return hri_bind::to_array(out);
      },
      py::arg("cepstra"), py::arg("num_bins"),
      "exp(sum of c_i cos(pi i t / num_bins)), t = 1 .. num_bins, of rows c_1, c_2, ...; shape "
      "(num_frames, num_bins) (thesis eq. 3.34-3.36).");
  m.def(
      "normalise_time",
      [](const hri_bind::FloatArray& frames, int num_rows) {
        return hri_bind::to_array(
            hri::normalise_time(hri_bind::as_matrix(frames, "frames"), num_rows));
      },
      py::arg("frames"), py::arg("num_rows"),
      "Frames stretched or squeezed to num_rows rows by linear interpolation, float32.");
}
