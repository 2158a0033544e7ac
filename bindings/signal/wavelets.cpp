// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Wavelet transforms; hri.wavelets is their face in Python.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "core/arrays.hpp"
#include "core/enums.hpp"
#include "hri/signal/dwt.hpp"
#include "hri/signal/dwt2.hpp"

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

// As for arrays of other types: Python then takes the general way.
void require_signal(const py::array& a) {
  if (a.ndim() != 1) throw py::type_error("a signal has one dimension");
}

// An array that the transform writes to itself. NumPy makes it at once: pybind11's constructor puts
// shape and strides on the heap first, a tenth of the time of a short transform.
template <class T>
Array<T> new_array(std::size_t size) {
  auto& numpy = py::detail::npy_api::get();
  auto shape = static_cast<Py_intptr_t>(size);
  PyObject* made =
      numpy.PyArray_NewFromDescr_(numpy.PyArray_Type_, py::dtype::of<T>().release().ptr(), 1,
                                  &shape, nullptr, nullptr, 0, nullptr);
  if (made == nullptr) throw py::error_already_set();
  return py::reinterpret_steal<Array<T>>(made);
}
template <class T>
hri::Span<T> writable(Array<T>& a) {
  return {a.mutable_data(), static_cast<std::size_t>(a.size())};
}
template <class T>
Eigen::Map<hri::Matrix<T>> writable_matrix(Array<T>& a) {
  return {a.mutable_data(), a.shape(0), a.shape(1)};
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
        Array<T> approx = new_array<T>(count);
        Array<T> detail = new_array<T>(count);
        const auto a = writable(approx);
        const auto d = writable(detail);
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
        Array<T> out = new_array<T>(hri::idwt_length(a.size(), w.rec_lo.size(), border));
        const auto x = writable(out);
        hri::require(!x.empty(), "too few coefficients for this wavelet");
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
        require_signal(x);
        const Array<T> held = contiguous(x);
        const auto samples = as_span(held, "x");
        const hri::Wavelet& w = hri::wavelet(wavelet);
        const auto lengths =
            hri::wavedec_lengths(samples.size(), w.dec_lo.size(), border, num_levels);
        py::list out(lengths.size());
        std::vector<hri::Span<T>> bands;
        bands.reserve(lengths.size());
        for (std::size_t i = 0; i < lengths.size(); ++i) {
          Array<T> band = new_array<T>(lengths[i]);
          bands.push_back(writable(band));
          out[i] = std::move(band);
        }
        {
          const py::gil_scoped_release release;
          hri::wavedec<T>(samples, w, border, hri::Span<const hri::Span<T>>(bands));
        }
        return out;
      },
      py::arg("x").noconvert(), py::arg("wavelet"), py::arg("border"), py::arg("num_levels"),
      "Several levels, [approximation, coarsest detail, ..., finest detail].");
  m.def(
      "waverec",
      [](const std::vector<AnyLayout<T>>& coefficients, const std::string& wavelet,
         hri::Border border, std::size_t num_samples) {
        const hri::Wavelet& w = hri::wavelet(wavelet);
        std::vector<Array<T>> held;
        std::vector<hri::Span<const T>> bands;
        held.reserve(coefficients.size());
        bands.reserve(coefficients.size());
        for (const auto& c : coefficients) {
          require_signal(c);
          held.push_back(contiguous(c));
          bands.push_back(as_span(held.back(), "coefficients"));
        }
        const std::size_t full =
            bands.empty() ? 0 : hri::idwt_length(bands.back().size(), w.rec_lo.size(), border);
        Array<T> out = new_array<T>(std::min(full, num_samples));
        const auto x = writable(out);
        {
          const py::gil_scoped_release release;
          hri::waverec<T>(hri::Span<const hri::Span<const T>>(bands), w, border, x);
        }
        return out;
      },
      py::arg("coefficients").noconvert(), py::arg("wavelet"), py::arg("border"),
      py::arg("num_samples"), "The inverse of wavedec.");
}

template <class T>
py::tuple detail_arrays(const hri::Dwt2<T>& level) {
  return py::make_tuple(to_array(level.horizontal), to_array(level.vertical),
                        to_array(level.diagonal));
}

template <class T>
void bind_dwt2(py::module_& m) {
  m.def(
      "dwt2",
      [](const AnyLayout<T>& image, const std::string& wavelet, hri::Border border) {
        const Array<T> held = contiguous(image);
        const auto pixels = as_matrix(held, "image");
        const hri::Wavelet& w = hri::wavelet(wavelet);
        const hri::Dwt2Shape shape =
            hri::dwt2_shape(pixels.rows(), pixels.cols(), w.dec_lo.size(), border);
        const auto band = [&shape] { return Array<T>({shape.rows, shape.cols}); };
        Array<T> approx = band();
        Array<T> horizontal = band();
        Array<T> vertical = band();
        Array<T> diagonal = band();
        const hri::Dwt2Bands<T> bands{writable_matrix(approx), writable_matrix(horizontal),
                                      writable_matrix(vertical), writable_matrix(diagonal)};
        {
          const py::gil_scoped_release release;
          hri::dwt2<T>(pixels, w, border, bands);
        }
        return py::make_tuple(approx, py::make_tuple(horizontal, vertical, diagonal));
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
  m.def(
      "wavedec2",
      [](const AnyLayout<T>& image, const std::string& wavelet, hri::Border border,
         int num_levels) {
        const Array<T> held = contiguous(image);
        const auto pixels = as_matrix(held, "image");
        const hri::Wavelet& w = hri::wavelet(wavelet);
        hri::WaveletDecomposition2<T> d;
        {
          const py::gil_scoped_release release;
          d = hri::wavedec2<T>(pixels, w, border, num_levels);
        }
        py::list out;
        out.append(to_array(d.approx));
        for (const auto& level : d.details) out.append(detail_arrays(level));
        return out;
      },
      py::arg("image").noconvert(), py::arg("wavelet"), py::arg("border"), py::arg("num_levels"),
      "Several levels of an image, [approximation, coarsest details, ..., finest details].");
  m.def(
      "waverec2",
      [](const AnyLayout<T>& approx, const std::vector<std::array<AnyLayout<T>, 3>>& details,
         const std::string& wavelet, hri::Border border,
         std::pair<Eigen::Index, Eigen::Index> shape) {
        hri::WaveletDecomposition2<T> d;
        d.approx = as_matrix(contiguous(approx), "approx");
        d.rows = shape.first;
        d.cols = shape.second;
        for (const auto& level : details) {
          d.details.push_back({{},
                               as_matrix(contiguous(level[0]), "horizontal"),
                               as_matrix(contiguous(level[1]), "vertical"),
                               as_matrix(contiguous(level[2]), "diagonal")});
        }
        const hri::Wavelet& w = hri::wavelet(wavelet);
        hri::Matrix<T> image;
        {
          const py::gil_scoped_release release;
          image = hri::waverec2<T>(d, w, border);
        }
        return to_array(image);
      },
      py::arg("approx").noconvert(), py::arg("details").noconvert(), py::arg("wavelet"),
      py::arg("border"), py::arg("shape"), "The inverse of wavedec2.");
}

}  // namespace

void bind_wavelets(py::module_& m) {
  m.def("wavelet_names", &hri::wavelet_names, "Names of all wavelets, as PyWavelets has them.");
  m.def(
      "max_dwt_level",
      [](std::size_t num_samples, const std::string& wavelet) {
        return hri::max_dwt_level(num_samples, hri::wavelet(wavelet).dec_lo.size());
      },
      py::arg("num_samples"), py::arg("wavelet"),
      "Levels until the border reaches every coefficient.");
  bind_dwt<float>(m);
  bind_dwt<double>(m);
  bind_dwt2<float>(m);
  bind_dwt2<double>(m);
}
