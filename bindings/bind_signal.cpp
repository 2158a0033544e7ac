// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Wavelets, end points, resampling.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "arrays.hpp"
#include "hri/signal/activity.hpp"
#include "hri/signal/dwt.hpp"
#include "hri/signal/resample.hpp"
#include "options.hpp"

namespace py = pybind11;
using hri_bind::as_matrix;
using hri_bind::as_span;
using hri_bind::to_array;

namespace {

template <class T>
using Array = py::array_t<T, py::array::c_style>;
// Of one dtype, in any layout: the overload is chosen by the dtype alone.
template <class T>
using AnyLayout = py::array_t<T, 0>;

template <class T>
Array<T> contiguous(const AnyLayout<T>& a) {
  return Array<T>(a);
}

template <class T>
void bind_dwt(py::module_& m) {
  m.def(
      "dwt",
      [](const AnyLayout<T>& x, const std::string& wavelet, hri::Border border) {
        const Array<T> held = contiguous(x);
        const auto samples = as_span(held, "x");
        const hri::Wavelet& w = hri::wavelet(wavelet);
        const std::size_t count = hri::dwt_length(samples.size(), w.dec_lo.size(), border);
        Array<T> approx(static_cast<py::ssize_t>(count));
        Array<T> detail(static_cast<py::ssize_t>(count));
        hri::Span<T> a(approx.mutable_data(), count);
        hri::Span<T> d(detail.mutable_data(), count);
        {
          const py::gil_scoped_release release;
          hri::dwt<T>(samples, w, border, a, d);
        }
        return std::make_pair(approx, detail);
      },
      py::arg("x").noconvert(), py::arg("wavelet"), py::arg("border"),
      "One level: (approximation, detail), float32 or float64 as x.");
  m.def(
      "idwt",
      [](const AnyLayout<T>& approx, const AnyLayout<T>& detail, const std::string& wavelet,
         hri::Border border) {
        const Array<T> low = contiguous(approx);
        const Array<T> high = contiguous(detail);
        const auto a = as_span(low, "approx");
        const auto d = as_span(high, "detail");
        const hri::Wavelet& w = hri::wavelet(wavelet);
        const auto taps = static_cast<py::ssize_t>(w.rec_lo.size());
        const py::ssize_t size =
            border == hri::Border::periodization ? 2 * low.size() : 2 * low.size() - taps + 2;
        hri::require(size > 0, "too few coefficients for this wavelet");
        Array<T> out(size);
        hri::Span<T> x(out.mutable_data(), static_cast<std::size_t>(size));
        {
          const py::gil_scoped_release release;
          hri::idwt<T>(a, d, w, border, x);
        }
        return out;
      },
      py::arg("approx").noconvert(), py::arg("detail").noconvert(), py::arg("wavelet"),
      py::arg("border"), "The inverse of one level.");
  m.def(
      "wavedec",
      [](const AnyLayout<T>& x, const std::string& wavelet, hri::Border border, int num_levels) {
        const Array<T> held = contiguous(x);
        const auto samples = as_span(held, "x");
        const hri::Wavelet& w = hri::wavelet(wavelet);
        hri::WaveletDecomposition<T> result;
        {
          const py::gil_scoped_release release;
          result = hri::wavedec<T>(samples, w, border, num_levels);
        }
        py::list out;
        for (const auto& c : result.coefficients) out.append(to_array(c));
        return out;
      },
      py::arg("x").noconvert(), py::arg("wavelet"), py::arg("border"), py::arg("num_levels"),
      "Several levels, [approximation, coarsest detail, ..., finest detail].");
  m.def(
      "waverec",
      [](const std::vector<AnyLayout<T>>& coefficients, const std::string& wavelet,
         hri::Border border, std::size_t num_samples) {
        const hri::Wavelet& w = hri::wavelet(wavelet);
        hri::WaveletDecomposition<T> d;
        d.num_samples = num_samples;
        for (const auto& c : coefficients) {
          const Array<T> held = contiguous(c);
          const auto values = as_span(held, "coefficients");
          d.coefficients.emplace_back(values.begin(), values.end());
        }
        std::vector<T> x;
        {
          const py::gil_scoped_release release;
          x = hri::waverec<T>(d, w, border);
        }
        return to_array(x);
      },
      py::arg("coefficients").noconvert(), py::arg("wavelet"), py::arg("border"),
      py::arg("num_samples"), "The inverse of wavedec.");
}

template <class T>
void bind_dwt2(py::module_& m) {
  m.def(
      "dwt2",
      [](const AnyLayout<T>& image, const std::string& wavelet, hri::Border border) {
        const hri::Matrix<T> pixels = as_matrix(contiguous(image), "image");
        const hri::Wavelet& w = hri::wavelet(wavelet);
        hri::Dwt2<T> d;
        {
          const py::gil_scoped_release release;
          d = hri::dwt2<T>(pixels, w, border);
        }
        return py::make_tuple(
            to_array(d.approx),
            py::make_tuple(to_array(d.horizontal), to_array(d.vertical), to_array(d.diagonal)));
      },
      py::arg("image").noconvert(), py::arg("wavelet"), py::arg("border"),
      "One level of an image: (approximation, (horizontal, vertical, diagonal)).");
  m.def(
      "idwt2",
      [](const AnyLayout<T>& approx, const AnyLayout<T>& horizontal, const AnyLayout<T>& vertical,
         const AnyLayout<T>& diagonal, const std::string& wavelet, hri::Border border,
         std::pair<Eigen::Index, Eigen::Index> shape) {
        const hri::Dwt2<T> level{as_matrix(contiguous(approx), "approx"),
                                 as_matrix(contiguous(horizontal), "horizontal"),
                                 as_matrix(contiguous(vertical), "vertical"),
                                 as_matrix(contiguous(diagonal), "diagonal")};
        const hri::Wavelet& w = hri::wavelet(wavelet);
        hri::Matrix<T> image;
        {
          const py::gil_scoped_release release;
          image = hri::idwt2<T>(level, w, border, shape.first, shape.second);
        }
        return to_array(image);
      },
      py::arg("approx").noconvert(), py::arg("horizontal").noconvert(),
      py::arg("vertical").noconvert(), py::arg("diagonal").noconvert(), py::arg("wavelet"),
      py::arg("border"), py::arg("shape"), "The inverse of dwt2.");
}

}  // namespace

void bind_signal(py::module_& m) {
  py::enum_<hri::Border>(m, "Border",
                         "What stands beyond the ends of a signal, by PyWavelets' names.")
      .value("symmetric", hri::Border::symmetric)
      .value("zero", hri::Border::zero)
      .value("constant", hri::Border::constant)
      .value("periodic", hri::Border::periodic)
      .value("reflect", hri::Border::reflect)
      .value("periodization", hri::Border::periodization);
  m.def("wavelet_names", &hri::wavelet_names);
  bind_dwt<float>(m);
  bind_dwt<double>(m);
  bind_dwt2<float>(m);
  bind_dwt2<double>(m);

  py::class_<hri::ActivityOptions> options(m, "ActivityOptions",
                                           "Where somebody speaks in a clip.");
  hri_bind::options(options)
      .field("frame_ms", &hri::ActivityOptions::frame_ms)
      .field("shift_ms", &hri::ActivityOptions::shift_ms)
      .field("silence_dbfs", &hri::ActivityOptions::silence_dbfs)
      .field("min_range_db", &hri::ActivityOptions::min_range_db)
      .field("margin_db", &hri::ActivityOptions::margin_db)
      .field("max_depth_db", &hri::ActivityOptions::max_depth_db)
      .field("padding_ms", &hri::ActivityOptions::padding_ms);
  m.def(
      "find_speech",
      [](const hri_bind::FloatArray& audio, int sample_rate_hz,
         const hri::ActivityOptions& o) -> py::object {
        const auto samples = as_span(audio, "audio");
        hri::SpeechBounds b;
        {
          const py::gil_scoped_release release;
          b = hri::find_speech(samples, sample_rate_hz, o);
        }
        if (!b.found) return py::none();
        return py::make_tuple(b.first, b.last);
      },
      py::arg("audio"), py::arg("sample_rate_hz"), py::arg("options") = hri::ActivityOptions{},
      "(first, last) sample of the word, or None where nobody speaks.");
  m.def(
      "resample",
      [](const hri_bind::FloatArray& samples, int from_hz, int to_hz) {
        const auto x = as_span(samples, "samples");
        std::vector<float> y;
        {
          const py::gil_scoped_release release;
          y = hri::resample(x, from_hz, to_hz);
        }
        return to_array(y);
      },
      py::arg("samples"), py::arg("from_hz"), py::arg("to_hz"),
      "Band-limited change of sampling rate.");
}
