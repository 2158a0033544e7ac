// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Adaptation to a speaker. The Python class hri.SpeakerAdapter wraps this one.
#include "hri/recognition/word/speaker_adapter.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "core/arrays.hpp"
#include "core/options.hpp"
#include "models/model_inputs.hpp"

namespace py = pybind11;

namespace {

using hri_bind::as_span;
using hri_bind::FloatArray;

}  // namespace

void bind_speaker_adapter(py::module_& m) {
  hri_bind::bind_options<hri::SpeakerAdapterOptions>(m, "Options of SpeakerAdapter.");

  py::class_<hri::SpeakerAdapter>(m, "SpeakerAdapter", "Adapts a word recogniser to a speaker.")
      .def(py::init<hri::WordRecognizer, const hri::SpeakerAdapterOptions&>(),
           py::arg("recognizer"), py::arg("options") = hri::SpeakerAdapterOptions{})
      .def(
          "recognise",
          [](hri::SpeakerAdapter& self, const FloatArray& audio, int sample_rate_hz) {
            const auto samples = as_span(audio, "audio");
            const py::gil_scoped_release release;
            return self.recognise(samples, sample_rate_hz);
          },
          py::arg("audio"), py::arg("sample_rate_hz"))
      .def(
          "learn",
          [](hri::SpeakerAdapter& self, const FloatArray& audio, int sample_rate_hz,
             const std::string& label) {
            const auto samples = as_span(audio, "audio");
            const py::gil_scoped_release release;
            self.learn(samples, sample_rate_hz, label);
          },
          py::arg("audio"), py::arg("sample_rate_hz"), py::arg("label"))
      .def(
          "update", [](hri::SpeakerAdapter& self) { self.update(hri_bind::interrupted); },
          py::call_guard<py::gil_scoped_release>())
      .def("reset", &hri::SpeakerAdapter::reset)
      .def_property_readonly("update_due", &hri::SpeakerAdapter::update_due)
      .def_property_readonly("num_words", &hri::SpeakerAdapter::num_words)
      .def_property_readonly("num_learned", &hri::SpeakerAdapter::num_learned)
      .def_property_readonly("recognizer", [](const hri::SpeakerAdapter& self) {
        return hri::WordRecognizer(self.recognizer());
      });
}
