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
using Stream = hri::CepstraStream;

void bind_options(py::module_& m) {
  py::enum_<hri::CepstraKind>(m, "CepstraKind")
      .value("filter_bank", hri::CepstraKind::filter_bank)
      .value("linear_prediction", hri::CepstraKind::linear_prediction);
  py::enum_<hri::FramePadding>(m, "FramePadding")
      .value("none", hri::FramePadding::none)
      .value("centred", hri::FramePadding::centred);
  py::enum_<hri::WindowKind>(m, "WindowKind")
      .value("hamming", hri::WindowKind::hamming)
      .value("hann", hri::WindowKind::hann)
      .value("hann_periodic", hri::WindowKind::hann_periodic)
      .value("povey", hri::WindowKind::povey)
      .value("rectangular", hri::WindowKind::rectangular);
  py::enum_<hri::Normalisation>(m, "Normalisation")
      .value("none", hri::Normalisation::none)
      .value("level", hri::Normalisation::level)
      .value("mean", hri::Normalisation::mean)
      .value("mean_variance", hri::Normalisation::mean_variance)
      .value("running_mean", hri::Normalisation::running_mean)
      .value("running_mean_variance", hri::Normalisation::running_mean_variance);

  py::class_<Options> cepstra(m, "CepstraOptions", "Cepstra of speech (MFCC, HFCC, LPCC).");
  hri_bind::options(cepstra)
      .field("sample_rate_hz", &Options::sample_rate_hz, "1000..384000")
      .field("frame_length_ms", &Options::frame_length_ms, "1..1000")
      .field("frame_shift_ms", &Options::frame_shift_ms, "1..1000")
      .field("padding", &Options::padding,
             "none, or zeros around the audio so that frame t has sample t * shift in its middle")
      .field("sample_scale", &Options::sample_scale, "32768: as if samples were 16-bit integers")
      .field("remove_dc", &Options::remove_dc, "subtract the mean of every frame")
      .field("pre_emphasis", &Options::pre_emphasis, "0 (off) .. 1")
      .field("frame_pre_emphasis", &Options::frame_pre_emphasis,
             "every frame begins anew, as in HTK and Kaldi")
      .field("window", &Options::window, "laid over every frame")
      .field("fft_size", &Options::fft_size,
             "even, at least the frame's samples; 0: the next power of two")
      .field("kind", &Options::kind, "filter_bank (MFCC, HFCC) or linear_prediction (LPCC)")
      .field("lpc_order", &Options::lpc_order, "1..64")
      .field("filter_bank", &Options::filter_bank, "mel or hfcc")
      .field("num_filters", &Options::num_filters, "1..512")
      .field("low_hz", &Options::low_hz, "lower edge of the first filter")
      .field("high_hz", &Options::high_hz, "upper edge of the last filter; 0: the Nyquist rate")
      .field("erb_factor", &Options::erb_factor, "bandwidth factor E of HFCC-E, 0.1..10")
      .field("warp", &Options::warp, "vocal-tract-length factor on the filter frequencies, 0.5..2")
      .field("warp_low_hz", &Options::warp_low_hz,
             "where the warp bends back to low_hz; 0: it does not")
      .field("warp_high_hz", &Options::warp_high_hz,
             "where the warp bends back to high_hz; 0: it does not")
      .field("mel_scale", &Options::mel_scale, "htk or slaney")
      .field("filter_axis", &Options::filter_axis,
             "along which the sides of filters are straight: hz or mel")
      .field("unit_area", &Options::unit_area, "filters of equal area, not of equal height")
      .field("use_power", &Options::use_power, "False: filters over the magnitude")
      .field("energy_floor", &Options::energy_floor, "below the log, 1e-30..1e30")
      .field("decibels", &Options::decibels, "10 log10 in place of ln")
      .field("top_db", &Options::top_db,
             "filters this far below the loudest of the utterance are raised to that; 0: off")
      .field("num_cepstra", &Options::num_cepstra, "c1 .. c_num, 1..num_filters - 1")
      .field("use_c0", &Options::use_c0, "put c0 in front")
      .field("use_energy", &Options::use_energy, "log energy of the frame in the place of c0")
      .field("htk_c0", &Options::htk_c0,
             "c0 (or the energy) behind the others, and c0 sqrt(2) times as large")
      .field("lifter", &Options::lifter, "HTK's sine lifter; 0: off")
      .field("rasta_pole", &Options::rasta_pole, "of the RASTA filter, below 1; 0: off")
      .field("normalisation", &Options::normalisation, "of an utterance or running")
      .field("running_s", &Options::running_s, "memory of the running normalisations")
      .field("delta_orders", &Options::delta_orders, "0..2")
      .field("delta_window", &Options::delta_window,
             "frames on each side of the regression, 1..10");
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
      .def_property_readonly("options", &Computer::options)
      .def_property_readonly("num_features", &Computer::num_features)
      .def("num_frames", &Computer::num_frames, py::arg("num_samples"))
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

void bind_stream(py::module_& m) {
  py::class_<Stream>(m, "CepstraStream",
                     "Cepstra of audio that comes in blocks: the numbers of CepstraComputer, to "
                     "the bit. One thread at a time.")
      .def(py::init<const Options&>(), py::arg("options"))
      .def_property_readonly("options", &Stream::options)
      .def_property_readonly("num_features", &Stream::num_features)
      .def(
          "push",
          [](Stream& self, const hri_bind::FloatArray& audio) {
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
          [](Stream& self, bool keep_normalisation) {
            hri::MatrixF rows(self.max_frames(0), self.num_features());
            const int count = self.finish(rows, keep_normalisation);
            return first_rows(rows, count);
          },
          py::arg("keep_normalisation") = false,
          "The frames that are left; then a new utterance may begin.")
      .def("reset", &Stream::reset, py::arg("keep_normalisation") = false);
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
  bind_options(m);
  bind_computer(m);
  bind_stream(m);
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
