// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// End points, resampling.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "arrays.hpp"
#include "hri/signal/activity.hpp"
#include "hri/signal/resample.hpp"
#include "options.hpp"

namespace py = pybind11;
using hri_bind::as_span;
using hri_bind::to_array;

void bind_signal(py::module_& m) {
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
