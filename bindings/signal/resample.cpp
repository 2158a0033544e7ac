// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Resampling.
#include "hri/signal/resample.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "core/arrays.hpp"

namespace py = pybind11;
using hri_bind::as_span;
using hri_bind::to_array;

void bind_resample(py::module_& m) {
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
