// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// The pretrained speech embedding. The Python class hri.recognition.SpeechEmbedding wraps this one.
#include "hri/recognition/word/speech_embedding.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <memory>

#include "core/arrays.hpp"
#include "core/options.hpp"
#include "core/paths.hpp"

namespace py = pybind11;

namespace {

using hri_bind::as_span;
using hri_bind::FloatArray;
using hri_bind::to_array;

}  // namespace

void bind_speech_embedding(py::module_& m) {
  hri_bind::bind_options<hri::SpeechEmbeddingOptions>(m, "How one word becomes one vector.");

  py::class_<hri::SpeechEmbedding, std::shared_ptr<hri::SpeechEmbedding>>(
      m, "SpeechEmbedding", "A pretrained speech embedding.")
      .def(py::init([](const hri_bind::Path& path, const hri::SpeechEmbeddingOptions& options) {
             const py::gil_scoped_release release;
             return hri::SpeechEmbedding::load(path.text, options);
           }),
           py::arg("path"), py::arg("options") = hri::SpeechEmbeddingOptions{})
      .def(
          "compute",
          [](const hri::SpeechEmbedding& self, const FloatArray& audio, int sample_rate_hz) {
            const auto samples = as_span(audio, "audio");
            hri::MatrixF rows;
            {
              const py::gil_scoped_release release;
              rows = self.compute(samples, sample_rate_hz);
            }
            return to_array(rows);
          },
          py::arg("audio"), py::arg("sample_rate_hz"))
      .def(
          "word",
          [](const hri::SpeechEmbedding& self, const FloatArray& audio, int sample_rate_hz) {
            const auto samples = as_span(audio, "audio");
            hri::VectorF vector;
            {
              const py::gil_scoped_release release;
              vector = self.word(samples, sample_rate_hz);
            }
            return to_array(vector);
          },
          py::arg("audio"), py::arg("sample_rate_hz"))
      .def_property_readonly("num_outputs", &hri::SpeechEmbedding::num_outputs)
      .def_property_readonly("window_s", &hri::SpeechEmbedding::window_s)
      .def_property_readonly("step_s", &hri::SpeechEmbedding::step_s)
      .def_property_readonly("checksum", &hri::SpeechEmbedding::checksum)
      .def_property_readonly("options", &hri::SpeechEmbedding::options);
}
