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
#include "hri/recognition/sentence/connected_word_stream.hpp"
#include "models/model_inputs.hpp"
#include "recognition/word_samples.hpp"

namespace py = pybind11;

namespace {

using hri_bind::as_span;
using hri_bind::as_word_samples;
using hri_bind::FloatArray;

hri::ConnectedWordRecognizer train_connected(
    const std::vector<FloatArray>& samples, const std::vector<int>& sample_rates_hz,
    const std::vector<std::string>& labels, const std::vector<std::string>& groups,
    const hri::ConnectedWordRecognizerOptions& options,
    const std::function<void(int, int)>& progress, const std::vector<FloatArray>& fillers,
    const std::vector<int>& filler_rates_hz, const std::vector<std::string>& filler_labels,
    const std::vector<std::string>& filler_groups,
    const std::shared_ptr<hri::SpeechEmbedding>& embedding) {
  const auto words = as_word_samples(samples, sample_rates_hz, labels, groups, "X");
  const auto others =
      as_word_samples(fillers, filler_rates_hz, filler_labels, filler_groups, "fillers");
  hri::TrainingProgress with_gil;
  if (progress) {
    with_gil = [&progress](int done, int total) {
      const py::gil_scoped_acquire gil;
      progress(done, total);
    };
  }
  const py::gil_scoped_release release;
  return hri::ConnectedWordRecognizer::train(words, options, with_gil, hri_bind::interrupted,
                                             others, embedding);
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
                    "What it adds to the transcript's.")
      .def_readonly("confidence", &hri::TranscribedWord::confidence,
                    "How probable it is that this word was said here; None: not known.")
      .def_readonly("unknown", &hri::TranscribedWord::unknown,
                    "Whether it is no word of the vocabulary, or its confidence too low.");
  py::class_<hri::TranscriptAlternative>(m, "TranscriptAlternative", "Another sentence.")
      .def_readonly("words", &hri::TranscriptAlternative::words, "In the order of time.")
      .def_readonly("log_score", &hri::TranscriptAlternative::log_score, "Of its best path.");
  py::class_<hri::ScoredRecording>(m, "ScoredRecording", "A recording as models score it.")
      .def_property_readonly(
          "log_emissions",
          [](const hri::ScoredRecording& self) { return hri_bind::to_array(self.log_emissions); },
          "float32, shape (num_frames, num_states).")
      .def_readonly("first_s", &hri::ScoredRecording::first_s, "Where the first frame begins.")
      .def_readonly("frame_s", &hri::ScoredRecording::frame_s, "From one frame to the next.");
  py::class_<hri::Transcript>(m, "Transcript", "The words of a recording.")
      .def_readonly("words", &hri::Transcript::words, "In the order of time.")
      .def_readonly("alternatives", &hri::Transcript::alternatives, "The best first.")
      .def_readonly("slots", &hri::Transcript::slots, "Of the grammar.")
      .def_readonly("log_score", &hri::Transcript::log_score, "Of the best path.")
      .def_readonly("complete", &hri::Transcript::complete, "Whether there were enough frames.")
      .def_readonly("notes", &hri::Transcript::notes, "What was converted or assumed on the way.");
  py::class_<hri::ConnectedWordRecognizer>(m, "ConnectedWordRecognizer",
                                           "Connected words; hri.ConnectedWordRecognizer wraps it.")
      .def_static("train", &train_connected, py::arg("samples"), py::arg("sample_rates_hz"),
                  py::arg("labels"), py::arg("groups"), py::arg("options"),
                  py::arg("progress") = nullptr, py::arg("fillers") = std::vector<FloatArray>{},
                  py::arg("filler_rates_hz") = std::vector<int>{},
                  py::arg("filler_labels") = std::vector<std::string>{},
                  py::arg("filler_groups") = std::vector<std::string>{},
                  py::arg("embedding") = nullptr)
      .def_static(
          "load",
          [](const hri_bind::Path& path, const std::shared_ptr<hri::SpeechEmbedding>& embedding) {
            return hri::ConnectedWordRecognizer::load(path.text, embedding);
          },
          py::arg("path"), py::arg("embedding") = nullptr, py::call_guard<py::gil_scoped_release>())
      .def(
          "save",
          [](const hri::ConnectedWordRecognizer& self, const hri_bind::Path& path) {
            self.save(path.text);
          },
          py::arg("path"), py::call_guard<py::gil_scoped_release>())
      .def_static(
          "from_model_file",
          [](const hri::ModelFile& file, const std::shared_ptr<hri::SpeechEmbedding>& embedding) {
            return hri::ConnectedWordRecognizer::from_model_file(file, embedding);
          },
          py::arg("file"), py::arg("embedding") = nullptr, py::call_guard<py::gil_scoped_release>())
      .def("to_model_file", &hri::ConnectedWordRecognizer::to_model_file,
           py::call_guard<py::gil_scoped_release>())
      .def("with_language", &hri::ConnectedWordRecognizer::with_language, py::arg("language"),
           py::call_guard<py::gil_scoped_release>())
      .def("with_grammar", &hri::ConnectedWordRecognizer::with_grammar, py::arg("grammar"),
           py::call_guard<py::gil_scoped_release>())
      .def("with_decoder", &hri::ConnectedWordRecognizer::with_decoder, py::arg("decoder"))
      .def(
          "recognise",
          [](const hri::ConnectedWordRecognizer& self, const FloatArray& audio, int sample_rate_hz,
             int num_words, int num_alternatives) {
            const auto samples = as_span(audio, "audio");
            const py::gil_scoped_release release;
            return self.recognise(samples, sample_rate_hz, {num_words, num_alternatives});
          },
          py::arg("audio"), py::arg("sample_rate_hz"), py::arg("num_words") = 0,
          py::arg("num_alternatives") = 0)
      .def(
          "score",
          [](const hri::ConnectedWordRecognizer& self, const FloatArray& audio,
             int sample_rate_hz) {
            const auto samples = as_span(audio, "audio");
            const py::gil_scoped_release release;
            return self.score(samples, sample_rate_hz);
          },
          py::arg("audio"), py::arg("sample_rate_hz"))
      .def(
          "align",
          [](const hri::ConnectedWordRecognizer& self, const hri::ScoredRecording& recording,
             const std::vector<std::string>& words) { return self.align(recording, words); },
          py::arg("recording"), py::arg("words"), py::call_guard<py::gil_scoped_release>())
      .def("lattice", &hri::ConnectedWordRecognizer::lattice, py::arg("recording"),
           py::arg("num_words") = 0, py::call_guard<py::gil_scoped_release>())
      .def_property_readonly("labels", &hri::ConnectedWordRecognizer::labels)
      .def_property_readonly("num_fillers", &hri::ConnectedWordRecognizer::num_fillers,
                             "Filler words with a model; none without unknown_words.")
      .def_property_readonly("options", &hri::ConnectedWordRecognizer::options,
                             "As trained, with what training chose.");
  hri_bind::bind_options<hri::ConnectedWordStreamOptions>(m, "Options of ConnectedWordStream.");
  py::class_<hri::ConnectedWordResult>(m, "ConnectedWordResult", "What an utterance holds.")
      .def_readonly("transcript", &hri::ConnectedWordResult::transcript,
                    "Times from the beginning of the stream.")
      .def_readonly("num_stable", &hri::ConnectedWordResult::num_stable,
                    "So many of the first words are kept until the utterance ends.")
      .def_readonly("is_final", &hri::ConnectedWordResult::is_final, "Whether it has ended.")
      .def_readonly("first_s", &hri::ConnectedWordResult::first_s, "Its beginning.")
      .def_readonly("last_s", &hri::ConnectedWordResult::last_s, "Its end, so far.");
  py::class_<hri::ConnectedWordStream>(m, "ConnectedWordStream",
                                       "A stream; hri.recognition.ConnectedWordStream wraps it.")
      .def(py::init<hri::ConnectedWordRecognizer, int, const hri::ConnectedWordStreamOptions&,
                    std::string>(),
           py::arg("recognizer"), py::arg("sample_rate_hz"), py::arg("options"),
           py::arg("wake_word"))
      .def(
          "process",
          [](hri::ConnectedWordStream& self, const FloatArray& samples) {
            const auto span = as_span(samples, "samples");
            const py::gil_scoped_release release;
            return self.process(span);
          },
          py::arg("samples"))
      .def("finish", &hri::ConnectedWordStream::finish, py::call_guard<py::gil_scoped_release>())
      .def_property_readonly("options", &hri::ConnectedWordStream::options)
      .def_property_readonly("num_kept", &hri::ConnectedWordStream::num_kept, "Samples in memory.");
}
