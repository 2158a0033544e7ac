// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// The stationary wavelet transform, and the filters of a wavelet.
#include "hri/signal/stationary.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "core/arrays.hpp"

namespace py = pybind11;
using hri_bind::as_matrix;
using hri_bind::as_span;
using hri_bind::to_array;

namespace {

template <class T>
using Array = py::array_t<T, py::array::c_style>;

template <class T>
void bind_swt(py::module_& m) {
  m.def(
      "swt",
      [](const Array<T>& x, const std::string& wavelet, int num_levels) {
        const auto samples = as_span(x, "x");
        const hri::Wavelet& w = hri::wavelet(wavelet);
        const int most = hri::max_swt_level(samples.size());
        if (num_levels < 1 || num_levels > most) {
          hri::fail(hri::ErrorKind::invalid_argument,
                    "level is " + std::to_string(num_levels) + ", must be 1.." +
                        std::to_string(most) + " for " + std::to_string(samples.size()) +
                        " samples: the length must be a multiple of 2**level");
        }
        const auto size = static_cast<Eigen::Index>(samples.size());
        hri::Matrix<T> approximations(num_levels, size);
        hri::Matrix<T> details(num_levels, size);
        {
          const py::gil_scoped_release release;
          hri::swt<T>(samples, w, approximations, details);
        }
        return py::make_tuple(to_array(approximations), to_array(details));
      },
      py::arg("x").noconvert(), py::arg("wavelet"), py::arg("num_levels"),
      "Approximations and details, each of shape (num_levels, num_samples), finest level first.");
  m.def(
      "iswt",
      [](const Array<T>& approximation, const Array<T>& details, const std::string& wavelet) {
        const auto a = as_span(approximation, "approximation");
        const auto d = as_matrix(details, "details");
        const hri::Wavelet& w = hri::wavelet(wavelet);
        Array<T> out(approximation.size());
        const hri::Span<T> x(out.mutable_data(), a.size());
        {
          const py::gil_scoped_release release;
          hri::iswt<T>(a, d, w, x);
        }
        return out;
      },
      py::arg("approximation").noconvert(), py::arg("details").noconvert(), py::arg("wavelet"),
      "The inverse, from the approximation of the highest level and all details.");
}

}  // namespace

void bind_stationary(py::module_& m) {
  bind_swt<float>(m);
  bind_swt<double>(m);
  m.def(
      "wavelet_filters",
      [](const std::string& name) {
        const hri::Wavelet& w = hri::wavelet(name);
        return py::make_tuple(w.dec_lo, w.dec_hi, w.rec_lo, w.rec_hi);
      },
      py::arg("name"), "The filters dec_lo, dec_hi, rec_lo and rec_hi.");
}
