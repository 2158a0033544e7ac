// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// End points: in a clip, and in a stream.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "core/arrays.hpp"
#include "core/options.hpp"
#include "hri/signal/activity.hpp"
#include "hri/signal/activity_meter.hpp"
#include "hri/signal/stream/endpointer.hpp"

namespace py = pybind11;
using hri_bind::as_span;
using hri_bind::to_array;

namespace {

void bind_clips(py::module_& m) {
  hri_bind::bind_options<hri::ActivityOptions>(m, "Where a clip holds speech.");
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
      "(first, last) sample of the word, or None without speech.");
  m.def(
      "activity_frames",
      [](const hri_bind::FloatArray& audio, int sample_rate_hz, const hri::ActivityOptions& o) {
        const auto samples = as_span(audio, "audio");
        hri::ActivityMeter meter(sample_rate_hz, o);
        hri::MatrixF rows(static_cast<Eigen::Index>(samples.size() / meter.frame_shift() + 1),
                          static_cast<Eigen::Index>(2 + meter.num_bands()));
        Eigen::Index count = 0;
        {
          const py::gil_scoped_release release;
          for (std::size_t at = 0; at < samples.size();) {
            hri::ActivityFrame frame;
            bool complete = false;
            at += meter.take(samples.subspan(at, samples.size() - at), &frame, &complete);
            if (!complete) break;
            rows(count, 0) = frame.level_db;
            rows(count, 1) = frame.voicing;
            for (Eigen::Index b = 0; b < meter.num_bands(); ++b)
              rows(count, 2 + b) = frame.band_db[static_cast<std::size_t>(b)];
            ++count;
          }
        }
        return to_array(hri::MatrixF(rows.topRows(count)));
      },
      py::arg("audio"), py::arg("sample_rate_hz"), py::arg("options") = hri::ActivityOptions{},
      "What end points are found from, a row a frame: level (dB), voicing (0..1), then the level "
      "of "
      "each band (dB).");
}

// Every event in these samples; the stream goes on.
std::vector<hri::Endpoint> push(hri::Endpointer& self, const hri_bind::FloatArray& block) {
  const auto samples = as_span(block, "samples");
  std::vector<hri::Endpoint> events;
  const py::gil_scoped_release release;
  for (std::size_t at = 0; at < samples.size();) {
    hri::Endpoint event;
    at += self.consume(samples.subspan(at, samples.size() - at), &event);
    if (event.kind != hri::EndpointKind::none) events.push_back(event);
  }
  return events;
}

std::vector<hri::Endpoint> finish(hri::Endpointer& self) {
  std::vector<hri::Endpoint> events;
  const py::gil_scoped_release release;
  for (hri::Endpoint e = self.finish(); e.kind != hri::EndpointKind::none; e = self.finish())
    events.push_back(e);
  return events;
}

void bind_end_point_streams(py::module_& m) {
  hri_bind::bind_options<hri::EndpointerOptions>(m,
                                                 "When an utterance in a stream begins and ends.");
  py::class_<hri::Endpoint>(m, "Endpoint",
                            "An event; positions are samples since the stream began.")
      .def_readonly("kind", &hri::Endpoint::kind,
                    "Which event: 'none', 'speech_start', 'speech_pause', 'speech_end' or "
                    "'speech_dropped'.")
      .def_readonly("at", &hri::Endpoint::at, "Samples processed when this was decided.")
      .def_readonly("first", &hri::Endpoint::first, "First sample of the utterance.")
      .def_readonly("last", &hri::Endpoint::last, "The sample behind its last.")
      .def_readonly("segment_first", &hri::Endpoint::segment_first,
                    "First sample of the utterance with the noise around it.")
      .def_readonly("segment_last", &hri::Endpoint::segment_last,
                    "The sample behind the last of these.")
      .def_readonly("cut", &hri::Endpoint::cut, "It reached max_utterance_ms.");
  py::class_<hri::Endpointer>(m, "Endpointer",
                              "Finds utterances in a stream, whatever the size of its blocks.")
      .def(py::init<int, const hri::EndpointerOptions&>(), py::arg("sample_rate_hz"),
           py::arg("options") = hri::EndpointerOptions{})
      .def("push", &push, py::arg("samples"), "The events in the next samples of the stream.")
      .def("finish", &finish, "The last events; the next stream may begin.")
      .def_property_readonly("options", &hri::Endpointer::options,
                             "As passed, with defaults filled in.")
      .def_property_readonly("num_samples", &hri::Endpointer::num_samples,
                             "Samples processed so far.")
      .def_property_readonly("in_speech", &hri::Endpointer::in_speech,
                             "Speech has begun and not ended.")
      .def_property_readonly("level_db", &hri::Endpointer::level_db,
                             "Level of the last frame, relative to full scale.")
      .def_property_readonly("excess_db", &hri::Endpointer::excess_db,
                             "Excess of that level over the noise floor.");
}

}  // namespace

void bind_end_points(py::module_& m) {
  bind_clips(m);
  bind_end_point_streams(m);
}
