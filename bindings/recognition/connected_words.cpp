// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Connected words. The Python class in hri.recognition.sentence wraps this.
#include <pybind11/functional.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <memory>
#include <string>

#include "core/arrays.hpp"
#include "core/options.hpp"
#include "core/paths.hpp"
#include "hri/recognition/sentence/connected_word_recognizer.hpp"
#include "models/model_inputs.hpp"

namespace py = pybind11;

namespace {

using hri_bind::as_span;
using hri_bind::FloatArray;

hri::ConnectedWordRecognizer train(const std::vector<FloatArray>& samples,
                                   const std::vector<int>& sample_rates_hz,
                                   const std::vector<std::string>& labels,
                                   const std::vector<std::string>& groups,
                                   const hri::ConnectedWordRecognizerOptions& options,
                                   const std::function<void(int, int)>& progress) {
  hri::require(samples.size() == labels.size() && samples.size() == sample_rates_hz.size() &&
                   samples.size() == groups.size(),
               "X, sample_rate_hz, y and groups differ in length");
  std::vector<hri::WordSample> words;
  words.reserve(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const std::string name = "X[" + std::to_string(i) + "]";
    words.push_back(
        {as_span(samples[i], name.c_str()), sample_rates_hz[i], labels[i], groups[i], name});
  }
  hri::TrainingProgress with_gil;
  if (progress) {
    with_gil = [&progress](int done, int total) {
      const py::gil_scoped_acquire gil;
      progress(done, total);
    };
  }
  const py::gil_scoped_release release;
  return hri::ConnectedWordRecognizer::train(words, options, with_gil, hri_bind::interrupted);
}

}  // namespace

void bind_connected_words(py::module_& m) {
  hri_bind::bind_options<hri::ConnectedWordRecognizerOptions>(
      m, "Options of ConnectedWordRecognizer.");
  py::class_<hri::TranscribedWord>(m, "TranscribedWord", "One word of a transcript.")
      .def_readonly("label", &hri::TranscribedWord::label, "A word of the vocabulary.")
      .def_readonly("first_s", &hri::TranscribedWord::first_s, "Its beginning, in seconds.")
      .def_readonly("last_s", &hri::TranscribedWord::last_s, "Its end, in seconds.")
      .def_readonly("log_score", &hri::TranscribedWord::log_score,
                    "What it adds to the transcript's.");
  py::class_<hri::Transcript>(m, "Transcript", "The words of a recording.")
      .def_readonly("words", &hri::Transcript::words, "In the order of time.")
      .def_readonly("log_score", &hri::Transcript::log_score, "Of the best path.")
      .def_readonly("complete", &hri::Transcript::complete, "Whether there were enough frames.")
      .def_readonly("notes", &hri::Transcript::notes, "What was converted or assumed on the way.");
  py::class_<hri::ConnectedWordRecognizer>(m, "ConnectedWordRecognizer",
                                           "Connected words; hri.ConnectedWordRecognizer wraps it.")
      .def_static("train", &train, py::arg("samples"), py::arg("sample_rates_hz"),
                  py::arg("labels"), py::arg("groups"), py::arg("options"),
                  py::arg("progress") = nullptr)
      .def_static(
          "load",
          [](const hri_bind::Path& path) { return hri::ConnectedWordRecognizer::load(path.text); },
          py::arg("path"), py::call_guard<py::gil_scoped_release>())
      .def(
          "save",
          [](const hri::ConnectedWordRecognizer& self, const hri_bind::Path& path) {
            self.save(path.text);
          },
          py::arg("path"), py::call_guard<py::gil_scoped_release>())
      .def_static("from_model_file", &hri::ConnectedWordRecognizer::from_model_file,
                  py::arg("file"))
      .def("to_model_file", &hri::ConnectedWordRecognizer::to_model_file)
      .def("with_language", &hri::ConnectedWordRecognizer::with_language, py::arg("language"))
      .def("with_decoder", &hri::ConnectedWordRecognizer::with_decoder, py::arg("decoder"))
      .def(
          "recognise",
          [](const hri::ConnectedWordRecognizer& self, const FloatArray& audio, int sample_rate_hz,
             int num_words) {
            const auto samples = as_span(audio, "audio");
            const py::gil_scoped_release release;
            return self.recognise(samples, sample_rate_hz, num_words);
          },
          py::arg("audio"), py::arg("sample_rate_hz"), py::arg("num_words") = 0)
      .def_property_readonly("labels", &hri::ConnectedWordRecognizer::labels)
      .def_property_readonly("options", &hri::ConnectedWordRecognizer::options,
                             "As trained, with what training chose.");
}
