// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Words of sub-word units. The Python class in hri.recognition.subword wraps this.
#include <pybind11/functional.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <string>
#include <vector>

#include "core/arrays.hpp"
#include "core/options.hpp"
#include "core/paths.hpp"
#include "hri/recognition/subword/subword_recognizer.hpp"
#include "models/model_inputs.hpp"

namespace py = pybind11;

namespace {

using hri::SubwordRecognizer;
using hri_bind::as_span;
using hri_bind::FloatArray;

std::vector<hri::WordSample> as_words(const std::vector<FloatArray>& samples,
                                      const std::vector<int>& sample_rates_hz,
                                      const std::vector<std::string>& labels,
                                      const std::vector<std::string>& groups,
                                      const std::string& list) {
  hri::require(samples.size() == labels.size() && samples.size() == sample_rates_hz.size() &&
                   samples.size() == groups.size(),
               "X, sample_rate_hz, y and groups differ in length");
  std::vector<hri::WordSample> words;
  words.reserve(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const std::string name = list + "[" + std::to_string(i) + "]";
    words.push_back(
        {as_span(samples[i], name.c_str()), sample_rates_hz[i], labels[i], groups[i], name});
  }
  return words;
}

SubwordRecognizer train_subwords(const std::vector<FloatArray>& samples,
                                 const std::vector<int>& sample_rates_hz,
                                 const std::vector<std::string>& labels,
                                 const std::vector<std::string>& groups,
                                 const hri::htk::Dictionary& lexicon,
                                 const hri::SubwordRecognizerOptions& options,
                                 const std::function<void(int, int)>& progress) {
  const auto words = as_words(samples, sample_rates_hz, labels, groups, "X");
  hri::TrainingProgress with_gil;
  if (progress) {
    with_gil = [&progress](int done, int total) {
      const py::gil_scoped_acquire gil;
      progress(done, total);
    };
  }
  const py::gil_scoped_release release;
  return SubwordRecognizer::train(words, lexicon, options, with_gil, hri_bind::interrupted);
}

SubwordRecognizer with_spelled_word(const SubwordRecognizer& self, const std::string& label,
                                    const std::vector<std::vector<std::string>>& pronunciations,
                                    const std::vector<FloatArray>& samples,
                                    const std::vector<int>& sample_rates_hz) {
  const std::vector<std::string> labels(samples.size(), label);
  const std::vector<std::string> groups(samples.size());
  const auto words = as_words(samples, sample_rates_hz, labels, groups, "clips");
  const py::gil_scoped_release release;
  return self.with_word(label, pronunciations, words, hri_bind::interrupted);
}

}  // namespace

void bind_subwords(py::module_& m) {
  hri_bind::bind_options<hri::SubwordRecognizerOptions>(m, "Options of SubwordRecognizer.");
  py::class_<SubwordRecognizer>(m, "SubwordRecognizer",
                                "Words of sub-word units; hri.SubwordRecognizer wraps it.")
      .def_static("train", &train_subwords, py::arg("samples"), py::arg("sample_rates_hz"),
                  py::arg("labels"), py::arg("groups"), py::arg("lexicon"), py::arg("options"),
                  py::arg("progress") = nullptr)
      .def("with_word", &with_spelled_word, py::arg("label"), py::arg("pronunciations"),
           py::arg("samples"), py::arg("sample_rates_hz"))
      .def("without_word", &SubwordRecognizer::without_word, py::arg("label"))
      .def_static(
          "load", [](const hri_bind::Path& path) { return SubwordRecognizer::load(path.text); },
          py::arg("path"), py::call_guard<py::gil_scoped_release>())
      .def(
          "save",
          [](const SubwordRecognizer& self, const hri_bind::Path& path) { self.save(path.text); },
          py::arg("path"), py::call_guard<py::gil_scoped_release>())
      .def_static("from_model_file", &SubwordRecognizer::from_model_file, py::arg("file"))
      .def("to_model_file", &SubwordRecognizer::to_model_file)
      .def(
          "recognise",
          [](const SubwordRecognizer& self, const FloatArray& audio, int sample_rate_hz) {
            const auto samples = as_span(audio, "audio");
            const py::gil_scoped_release release;
            return self.recognise(samples, sample_rate_hz);
          },
          py::arg("audio"), py::arg("sample_rate_hz"))
      .def(
          "scores",
          [](const SubwordRecognizer& self, const FloatArray& audio, int sample_rate_hz) {
            const auto samples = as_span(audio, "audio");
            hri::VectorF scores;
            {
              const py::gil_scoped_release release;
              scores = self.scores(samples, sample_rate_hz);
            }
            return hri_bind::to_array(scores);
          },
          py::arg("audio"), py::arg("sample_rate_hz"))
      .def_property_readonly("labels", &SubwordRecognizer::labels)
      .def_property_readonly("lexicon", &SubwordRecognizer::lexicon)
      .def_property_readonly("units",
                             [](const SubwordRecognizer& self) { return self.units().names; })
      .def_property_readonly(
          "threshold", [](const SubwordRecognizer& self) { return self.calibration().threshold(); },
          "Decision.score from which a word is recognised.")
      .def_property_readonly(
          "is_calibrated",
          [](const SubwordRecognizer& self) { return self.calibration().is_fitted(); },
          "Whether anything was held out to calibrate on; else nothing is rejected.")
      .def_property_readonly("options", &SubwordRecognizer::options,
                             "As trained, with what training chose.");
}
