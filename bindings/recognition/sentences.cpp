// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Sentences of signs. The Python class in hri.recognition.sentence wraps this.
#include <pybind11/functional.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "core/arrays.hpp"
#include "core/options.hpp"
#include "core/paths.hpp"
#include "hri/recognition/sentence/sentence_recognizer.hpp"
#include "hri/recognition/sentence/sentence_stream.hpp"
#include "models/model_inputs.hpp"

namespace py = pybind11;

namespace {

using hri_bind::as_matrix;
using hri_bind::as_span;
using hri_bind::FloatArray;
using Spans = std::vector<std::tuple<std::string, std::int64_t, std::int64_t>>;
using Frames = std::vector<std::pair<std::int64_t, std::int64_t>>;  // first, and one past the last

std::vector<hri::SignedWordSpan> spans_of(const Spans& words) {
  std::vector<hri::SignedWordSpan> spans;
  spans.reserve(words.size());
  for (const auto& [label, first, last] : words) spans.push_back({label, first, last});
  return spans;
}

std::vector<hri::SignedWordSpan> spans_of(const Frames& frames) {
  std::vector<hri::SignedWordSpan> spans;
  spans.reserve(frames.size());
  for (const auto& [first, last] : frames) spans.push_back({"", first, last});
  return spans;
}

hri::SentenceRecognizer train_sentences(const std::vector<FloatArray>& tracks,
                                        const std::vector<Spans>& words,
                                        const std::vector<double>& scales_px,
                                        const std::vector<std::string>& groups,
                                        const hri::SentenceRecognizerOptions& options,
                                        const std::function<void(int, int)>& progress) {
  hri::require(tracks.size() == words.size() && tracks.size() == scales_px.size() &&
                   tracks.size() == groups.size(),
               "X, y, scales_px and groups differ in length");
  std::vector<hri::SignedSample> samples;
  samples.reserve(tracks.size());
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    const std::string name = "X[" + std::to_string(i) + "]";
    samples.push_back(
        {as_matrix(tracks[i], name.c_str()), scales_px[i], spans_of(words[i]), groups[i], name});
  }
  hri::TrainingProgress with_gil;
  if (progress) {
    with_gil = [&progress](int done, int total) {
      const py::gil_scoped_acquire gil;
      progress(done, total);
    };
  }
  const py::gil_scoped_release release;
  return hri::SentenceRecognizer::train(samples, options, with_gil, hri_bind::interrupted);
}

}  // namespace

void bind_sentence_stream(py::module_& m) {
  hri_bind::bind_options<hri::SentenceStreamOptions>(m, "When signed sentences begin and end.");
  py::class_<hri::StreamedSign, hri::RecognisedSign>(m, "StreamedSign",
                                                     "One word of a sentence in a stream.")
      .def_readonly("first_s", &hri::StreamedSign::first_s, "Time of its first frame.")
      .def_readonly("last_s", &hri::StreamedSign::last_s, "Time of its last frame.");
  py::class_<hri::SentenceEvent>(m, "SentenceEvent", "What happened with a frame.")
      .def_readonly("kind", &hri::SentenceEvent::kind,
                    "'none', 'start', 'partial', 'end' or 'dropped'.")
      .def_readonly("reason", &hri::SentenceEvent::reason,
                    "Why it ended: 'rested', 'left', 'cut', 'ended' or 'stalled'.")
      .def_readonly("words", &hri::SentenceEvent::words, "In the order of time.")
      .def_readonly("log_score", &hri::SentenceEvent::log_score, "Of the best path.")
      .def_readonly("num_stable", &hri::SentenceEvent::num_stable,
                    "So many of the first words are kept until the sentence ends.")
      .def_readonly("first_s", &hri::SentenceEvent::first_s, "Its beginning.")
      .def_readonly("last_s", &hri::SentenceEvent::last_s, "Its end, so far.");
  py::class_<hri::SentenceStream>(m, "SentenceStream",
                                  "A stream; hri.recognition.SentenceStream wraps it.")
      .def(py::init<hri::SentenceRecognizer, const hri::SentenceStreamOptions&>(),
           py::arg("recognizer"), py::arg("options"))
      .def(
          "push",
          [](hri::SentenceStream& self, const FloatArray& row, double time_s) {
            const auto span = as_span(row, "row");
            const py::gil_scoped_release release;
            return self.push(span, time_s);
          },
          py::arg("row"), py::arg("time_s"))
      .def("finish", &hri::SentenceStream::finish, py::call_guard<py::gil_scoped_release>())
      .def("interrupt", &hri::SentenceStream::interrupt)
      .def_property_readonly("in_sentence", &hri::SentenceStream::in_sentence,
                             "One has begun and not ended.")
      .def_property_readonly("change", &hri::SentenceStream::change,
                             "Movement in units of still_change.")
      .def_property_readonly("num_columns", &hri::SentenceStream::num_columns, "Of a frame.")
      .def_property_readonly("num_kept", &hri::SentenceStream::num_kept, "Frames in memory.");
}

void bind_sentences(py::module_& m) {
  hri_bind::bind_options<hri::SentenceRecognizerOptions>(m, "Options of SentenceRecognizer.");
  py::class_<hri::RecognisedSign>(m, "RecognisedSign", "One word of a signed sentence.")
      .def_readonly("label", &hri::RecognisedSign::label, "A word of the vocabulary.")
      .def_readonly("first_frame", &hri::RecognisedSign::first_frame, "Its first frame.")
      .def_readonly("last_frame", &hri::RecognisedSign::last_frame, "One past its last frame.")
      .def_readonly("log_score", &hri::RecognisedSign::log_score,
                    "What it adds to the sentence's.");
  py::class_<hri::RecognisedSentence>(m, "RecognisedSentence", "The words of a signed sentence.")
      .def_readonly("words", &hri::RecognisedSentence::words, "In the order of time.")
      .def_readonly("log_score", &hri::RecognisedSentence::log_score, "Of the best path.");
  py::class_<hri::SentenceRecognizer>(m, "SentenceRecognizer",
                                      "Sentences of signs; hri.SentenceRecognizer wraps it.")
      .def_static("train", &train_sentences, py::arg("tracks"), py::arg("words"),
                  py::arg("scales_px"), py::arg("groups"), py::arg("options"),
                  py::arg("progress") = nullptr)
      .def_static(
          "load",
          [](const hri_bind::Path& path) { return hri::SentenceRecognizer::load(path.text); },
          py::arg("path"), py::call_guard<py::gil_scoped_release>())
      .def(
          "save",
          [](const hri::SentenceRecognizer& self, const hri_bind::Path& path) {
            self.save(path.text);
          },
          py::arg("path"), py::call_guard<py::gil_scoped_release>())
      .def_static("from_model_file", &hri::SentenceRecognizer::from_model_file, py::arg("file"))
      .def("to_model_file", &hri::SentenceRecognizer::to_model_file)
      .def("with_decoder", &hri::SentenceRecognizer::with_decoder, py::arg("decoder"))
      .def("with_known_language_scale", &hri::SentenceRecognizer::with_known_language_scale,
           py::arg("scale"))
      .def(
          "recognise",
          [](const hri::SentenceRecognizer& self, const FloatArray& tracks, double scale_px) {
            const auto view = as_matrix(tracks, "tracks");
            const py::gil_scoped_release release;
            return self.recognise(view, scale_px);
          },
          py::arg("tracks"), py::arg("scale_px") = 0.0)
      .def(
          "recognise_n_best",
          [](const hri::SentenceRecognizer& self, const FloatArray& tracks, int count,
             double scale_px) {
            const auto view = as_matrix(tracks, "tracks");
            const py::gil_scoped_release release;
            return self.recognise_n_best(view, count, scale_px);
          },
          py::arg("tracks"), py::arg("count"), py::arg("scale_px") = 0.0)
      .def(
          "recognise_spans",
          [](const hri::SentenceRecognizer& self, const FloatArray& tracks, const Frames& frames,
             double scale_px, bool with_language) {
            const auto view = as_matrix(tracks, "tracks");
            const py::gil_scoped_release release;
            return self.recognise_spans(view, spans_of(frames), scale_px, with_language);
          },
          py::arg("tracks"), py::arg("spans"), py::arg("scale_px") = 0.0,
          py::arg("with_language") = true)
      .def(
          "score_spans",
          [](const hri::SentenceRecognizer& self, const FloatArray& tracks, const Frames& frames,
             double scale_px) {
            const auto view = as_matrix(tracks, "tracks");
            hri::MatrixD scores;
            {
              const py::gil_scoped_release release;
              scores = self.score_spans(self.score(view, scale_px), spans_of(frames));
            }
            return hri_bind::to_array(scores);
          },
          py::arg("tracks"), py::arg("spans"), py::arg("scale_px") = 0.0,
          "Log scores (num_spans, num_labels) of every label in every span.")
      .def_property_readonly("labels", &hri::SentenceRecognizer::labels)
      .def_property_readonly("options", &hri::SentenceRecognizer::options,
                             "As trained, with what training chose.");
  bind_sentence_stream(m);
}
