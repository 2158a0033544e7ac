// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Recognisers and decisions. The Python classes in hri.recognition wrap these.
#include <pybind11/functional.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <optional>

#include "core/arrays.hpp"
#include "core/options.hpp"
#include "core/paths.hpp"
#include "hri/recognition/gesture/gesture_recognizer.hpp"
#include "hri/recognition/word/word_recognizer.hpp"
#include "models/model_inputs.hpp"
#include "recognition/word_samples.hpp"

namespace py = pybind11;

namespace {

using hri_bind::as_image;
using hri_bind::as_matrix;
using hri_bind::as_span;
using hri_bind::as_word_samples;
using hri_bind::ByteArray;
using hri_bind::FloatArray;

hri::TrainingProgress with_gil(const std::function<void(int, int)>& progress) {
  if (!progress) return {};
  return [&progress](int done, int total) {
    const py::gil_scoped_acquire gil;
    progress(done, total);
  };
}

std::vector<hri::HandImage> as_hand_images(const std::vector<ByteArray>& greys,
                                           const std::vector<ByteArray>& masks) {
  hri::require(greys.size() == masks.size(), "greys and masks differ in length");
  std::vector<hri::HandImage> frames;
  for (std::size_t i = 0; i < greys.size(); ++i) {
    frames.push_back({as_image(greys[i], 1, "grey"), as_image(masks[i], 1, "mask")});
    const auto& f = frames.back();
    hri::require(f.mask.empty() ||
                     (f.grey.width_px == f.mask.width_px && f.grey.height_px == f.mask.height_px),
                 "grey and mask differ in size");
  }
  return frames;
}

void bind_decision(py::module_& m) {
  py::class_<hri::NBest>(m, "NBest", "One class of the n-best list.")
      .def_readonly("label", &hri::NBest::label, "A class, \"unknown\" or \"no_input\".")
      .def_readonly("probability", &hri::NBest::probability, "Calibrated probability, 0..1.")
      .def_readonly("log_score", &hri::NBest::log_score, "The model's own score.");
  py::class_<hri::Decision>(m, "Decision", "What a recogniser says of one utterance or gesture.")
      .def_readonly("status", &hri::Decision::status, "'recognised', 'unknown' or 'no_input'.")
      .def_readonly("label", &hri::Decision::label, "A class, \"unknown\" or \"no_input\".")
      .def_readonly("confidence", &hri::Decision::confidence,
                    "Calibrated probability of the best class.")
      .def_readonly("score", &hri::Decision::score,
                    "What the rejection threshold was compared with.")
      .def_readonly("class_threshold", &hri::Decision::class_threshold,
                    "Confidence from which the best class is sure.")
      .def_readonly("nbest", &hri::Decision::nbest, "Every class in falling order.")
      .def_readonly("notes", &hri::Decision::notes, "What was converted or assumed on the way.");
  py::class_<hri::UtteranceDecision>(m, "UtteranceDecision",
                                     "The decision on one utterance of a longer recording.")
      .def_readonly("first_s", &hri::UtteranceDecision::first_s, "Its beginning, in seconds.")
      .def_readonly("last_s", &hri::UtteranceDecision::last_s, "Its end, in seconds.")
      .def_readonly("decision", &hri::UtteranceDecision::decision,
                    "The Decision; empty for segments.");
}

hri::WordRecognizer with_word(const hri::WordRecognizer& self, const std::string& label,
                              const std::vector<FloatArray>& clips,
                              const std::vector<int>& sample_rates_hz) {
  const auto words = as_word_samples(clips, sample_rates_hz,
                                     std::vector<std::string>(clips.size(), label), {}, "clips");
  const py::gil_scoped_release release;
  return self.with_word(words, hri_bind::interrupted);
}

hri::WordRecognizer train_words(
    const std::vector<FloatArray>& samples, const std::vector<int>& sample_rates_hz,
    const std::vector<std::string>& labels, const std::vector<std::string>& groups,
    const hri::WordRecognizerOptions& options, const std::function<void(int, int)>& progress,
    const std::vector<FloatArray>& fillers, const std::vector<int>& filler_rates_hz,
    const std::vector<std::string>& filler_labels,
    const std::shared_ptr<hri::SpeechEmbedding>& embedding,
    const std::vector<FloatArray>& embedding_fillers,
    const std::vector<int>& embedding_filler_rates_hz,
    const std::vector<std::string>& embedding_filler_labels,
    const std::vector<std::string>& recordings) {
  auto words = as_word_samples(samples, sample_rates_hz, labels, groups, "X");
  if (!recordings.empty() && recordings.size() != words.size())
    hri::fail(hri::ErrorKind::invalid_argument, "X and recordings differ in length");
  for (std::size_t i = 0; i < recordings.size(); ++i) words[i].recording = recordings[i];
  const auto others = as_word_samples(fillers, filler_rates_hz, filler_labels, {}, "fillers");
  const auto embedded = as_word_samples(embedding_fillers, embedding_filler_rates_hz,
                                        embedding_filler_labels, {}, "embedding_fillers");
  const py::gil_scoped_release release;
  return hri::WordRecognizer::train(words, options, with_gil(progress), hri_bind::interrupted,
                                    others, embedding, embedded);
}

template <class Recognizer>
std::optional<hri::HeldOutReport> held_out_of(const Recognizer& self) {
  if (self.held_out().empty()) return std::nullopt;
  return self.held_out();
}

void bind_held_out_report(py::module_& m) {
  py::class_<hri::ConfusedPair>(m, "ConfusedPair",
                                "Two classes that are confused with one another.")
      .def_readonly("first", &hri::ConfusedPair::first, "A class number.")
      .def_readonly("second", &hri::ConfusedPair::second, "A larger one.")
      .def_readonly("rate", &hri::ConfusedPair::rate,
                    "Share of the samples decided for either that are the other.");
  py::class_<hri::HeldOutReport>(
      m, "HeldOutReport", "What training saw on samples held out; hri.HeldOutReport wraps it.")
      .def_readonly("labels", &hri::HeldOutReport::labels, "Of the classes in training.")
      .def_property_readonly(
          "confusion",
          [](const hri::HeldOutReport& self) { return hri_bind::to_array(self.confusion); },
          "Counts, by true and by best class.")
      .def_readonly("false_reject_rate", &hri::HeldOutReport::false_reject_rate,
                    "Share of right decisions below the threshold.")
      .def_readonly("num_others", &hri::HeldOutReport::num_others,
                    "How many samples were treated as unknown.")
      .def_readonly("false_accept_rate", &hri::HeldOutReport::false_accept_rate,
                    "Share of these that are not below it; 0 without any.")
      .def("confused_pairs", &hri::HeldOutReport::confused_pairs,
           "List of ConfusedPair in falling order of their rate.");
}

void bind_words(py::module_& m) {
  hri_bind::bind_options<hri::SequenceModelOptions>(m, "The models trained on one front end.");

  hri_bind::bind_options<hri::WordRecognizerOptions>(m, "Options of WordRecognizer.");

  py::class_<hri::WordRecognizer>(m, "WordRecognizer",
                                  "Isolated words; hri.WordRecognizer wraps it.")
      .def_static("train", &train_words, py::arg("samples"), py::arg("sample_rates_hz"),
                  py::arg("labels"), py::arg("groups"), py::arg("options"),
                  py::arg("progress") = nullptr, py::arg("fillers") = std::vector<FloatArray>{},
                  py::arg("filler_rates_hz") = std::vector<int>{},
                  py::arg("filler_labels") = std::vector<std::string>{},
                  py::arg("embedding") = nullptr,
                  py::arg("embedding_fillers") = std::vector<FloatArray>{},
                  py::arg("embedding_filler_rates_hz") = std::vector<int>{},
                  py::arg("embedding_filler_labels") = std::vector<std::string>{},
                  py::arg("recordings") = std::vector<std::string>{})
      .def("with_word", &with_word, py::arg("label"), py::arg("clips"), py::arg("sample_rates_hz"))
      .def("without_word", &hri::WordRecognizer::without_word, py::arg("label"))
      .def_static(
          "load",
          [](const hri_bind::Path& path, const std::shared_ptr<hri::SpeechEmbedding>& embedding) {
            return hri::WordRecognizer::load(path.text, embedding);
          },
          py::arg("path"), py::arg("embedding") = nullptr, py::call_guard<py::gil_scoped_release>())
      .def(
          "save",
          [](const hri::WordRecognizer& self, const hri_bind::Path& path) { self.save(path.text); },
          py::arg("path"), py::call_guard<py::gil_scoped_release>())
      .def_static(
          "from_model_file",
          [](const hri::ModelFile& file, const std::shared_ptr<hri::SpeechEmbedding>& embedding) {
            return hri::WordRecognizer::from_model_file(file, embedding);
          },
          py::arg("file"), py::arg("embedding") = nullptr)
      .def("to_model_file", &hri::WordRecognizer::to_model_file)
      .def(
          "recognise",
          [](const hri::WordRecognizer& self, const FloatArray& audio, int sample_rate_hz) {
            const auto samples = as_span(audio, "audio");
            const py::gil_scoped_release release;
            return self.recognise(samples, sample_rate_hz);
          },
          py::arg("audio"), py::arg("sample_rate_hz"))
      .def(
          "recognise_utterances",
          [](const hri::WordRecognizer& self, const FloatArray& audio, int sample_rate_hz) {
            const auto samples = as_span(audio, "audio");
            const py::gil_scoped_release release;
            return self.recognise_utterances(samples, sample_rate_hz);
          },
          py::arg("audio"), py::arg("sample_rate_hz"))
      .def(
          "scores",
          [](const hri::WordRecognizer& self, const FloatArray& audio, int sample_rate_hz) {
            const auto samples = as_span(audio, "audio");
            hri::VectorF scores;
            {
              const py::gil_scoped_release release;
              scores = self.scores(samples, sample_rate_hz);
            }
            return hri_bind::to_array(scores);
          },
          py::arg("audio"), py::arg("sample_rate_hz"))
      .def_property_readonly("labels", &hri::WordRecognizer::labels)
      .def_property_readonly(
          "threshold",
          [](const hri::WordRecognizer& self) { return self.calibration().threshold(); },
          "Score from which a word is recognised.")
      .def_property_readonly(
          "is_calibrated",
          [](const hri::WordRecognizer& self) { return self.calibration().is_fitted(); },
          "Whether anything was held out to calibrate on; else nothing is rejected.")
      .def_property_readonly("held_out", &held_out_of<hri::WordRecognizer>,
                             "HeldOutReport, or None.")
      .def_property_readonly("options", &hri::WordRecognizer::options,
                             "As passed, with defaults filled in.");
}

hri::GestureRecognizer train_gestures(const std::vector<FloatArray>& features,
                                      const std::vector<std::string>& labels,
                                      const std::vector<std::string>& groups,
                                      const hri::GestureRecognizerOptions& options,
                                      const std::function<void(int, int)>& progress) {
  hri::require(features.size() == labels.size() && features.size() == groups.size(),
               "features, labels and groups differ in length");
  std::vector<hri::GestureSample> samples;
  samples.reserve(features.size());
  for (std::size_t i = 0; i < features.size(); ++i) {
    samples.push_back({as_matrix(features[i], "features"), labels[i], groups[i]});
  }
  const py::gil_scoped_release release;
  return hri::GestureRecognizer::train(samples, options, with_gil(progress), hri_bind::interrupted);
}

hri::GestureRecognizer with_gesture(const hri::GestureRecognizer& self, const std::string& label,
                                    const std::vector<FloatArray>& features) {
  std::vector<hri::GestureSample> samples;
  samples.reserve(features.size());
  for (const FloatArray& rows : features)
    samples.push_back({as_matrix(rows, "features"), label, ""});
  const py::gil_scoped_release release;
  return self.with_gesture(samples, hri_bind::interrupted);
}

py::array_t<float> gesture_features(const std::vector<ByteArray>& greys,
                                    const std::vector<ByteArray>& masks,
                                    const hri::HandFeatureOptions& options) {
  const auto frames = as_hand_images(greys, masks);
  hri::MatrixF rows;
  {
    const py::gil_scoped_release release;
    rows = hri::GestureRecognizer::features(frames, options);
  }
  return hri_bind::to_array(rows);
}

void bind_gestures(py::module_& m) {
  hri_bind::bind_options<hri::GestureRecognizerOptions>(m, "Options of GestureRecognizer.");

  py::class_<hri::GestureFeatureComputer>(m, "GestureFeatureComputer",
                                          "Rows of features, one a frame that shows a hand.")
      .def(py::init<const hri::HandFeatureOptions&, double>(),
           py::arg("options") = hri::HandFeatureOptions{}, py::arg("min_quality") = 0.0)
      .def_property_readonly("num_features", &hri::GestureFeatureComputer::num_features,
                             "Columns of the features.")
      .def(
          "compute",
          [](const hri::GestureFeatureComputer& self,
             const std::vector<hri::HandObservation>& hands) {
            hri::MatrixF rows;
            {
              const py::gil_scoped_release release;
              rows = self.compute(hri::Span<const hri::HandObservation>(hands));
            }
            return hri_bind::to_array(rows);
          },
          py::arg("hands"), "float32, shape (num_hands, num_features).")
      .def(
          "compute_every",
          [](const hri::GestureFeatureComputer& self,
             const std::vector<hri::HandObservation>& hands) {
            hri::MatrixF rows;
            {
              const py::gil_scoped_release release;
              rows = self.compute_every(hri::Span<const hri::HandObservation>(hands));
            }
            return hri_bind::to_array(rows);
          },
          py::arg("hands"), "The same with a row for every frame, all NaN where it shows no hand.");

  py::class_<hri::GestureRecognizer>(m, "GestureRecognizer",
                                     "Signs and gestures; hri.GestureRecognizer wraps it.")
      .def_static("train", &train_gestures, py::arg("features"), py::arg("labels"),
                  py::arg("groups"), py::arg("options"), py::arg("progress") = nullptr)
      .def("with_gesture", &with_gesture, py::arg("label"), py::arg("features"))
      .def_static("features", &gesture_features, py::arg("greys"), py::arg("masks"),
                  py::arg("options"))
      .def_static(
          "load",
          [](const hri_bind::Path& path) { return hri::GestureRecognizer::load(path.text); },
          py::arg("path"), py::call_guard<py::gil_scoped_release>())
      .def(
          "save",
          [](const hri::GestureRecognizer& self, const hri_bind::Path& path) {
            self.save(path.text);
          },
          py::arg("path"), py::call_guard<py::gil_scoped_release>())
      .def(
          "recognise",
          [](const hri::GestureRecognizer& self, const std::vector<hri::HandObservation>& hands) {
            const py::gil_scoped_release release;
            return self.recognise(hands);
          },
          py::arg("hands"))
      .def_property_readonly("is_dynamic", &hri::GestureRecognizer::is_dynamic)
      .def_property_readonly(
          "is_calibrated",
          [](const hri::GestureRecognizer& self) { return self.calibration().is_fitted(); },
          "Whether anything was held out to calibrate on; else nothing is rejected.")
      .def_property_readonly("held_out", &held_out_of<hri::GestureRecognizer>,
                             "HeldOutReport, or None.")
      .def_static("from_model_file", &hri::GestureRecognizer::from_model_file, py::arg("file"))
      .def("to_model_file", &hri::GestureRecognizer::to_model_file)
      .def_property_readonly("starts_at_rest", &hri::GestureRecognizer::starts_at_rest)
      .def_property_readonly("pauses", &hri::GestureRecognizer::pauses)
      .def(
          "recognise_features",
          [](const hri::GestureRecognizer& self, const FloatArray& features) {
            const hri::MatrixF rows = as_matrix(features, "features");
            const py::gil_scoped_release release;
            return self.recognise_features(rows);
          },
          py::arg("features"))
      .def(
          "scores",
          [](const hri::GestureRecognizer& self, const FloatArray& features) {
            const hri::MatrixF rows = as_matrix(features, "features");
            hri::VectorF scores;
            {
              const py::gil_scoped_release release;
              scores = self.scores(rows);
            }
            return hri_bind::to_array(scores);
          },
          py::arg("features"))
      .def_property_readonly("labels", &hri::GestureRecognizer::labels)
      .def_property_readonly("options", &hri::GestureRecognizer::options,
                             "As passed, with defaults filled in.");
}

}  // namespace

void bind_recognition(py::module_& m) {
  bind_decision(m);
  bind_held_out_report(m);
  bind_words(m);
  bind_gestures(m);
}
