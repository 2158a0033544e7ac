// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Gestures in clips and streams of pictures: hands found and recognised in one call. The
// recognisers are those of hri._native.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/arrays.hpp"
#include "core/options.hpp"
#include "hri/features/hand/landmarks.hpp"
#include "hri/recognition/gesture/gesture_spotter.hpp"
#include "hri/recognition/gesture/gesture_stream.hpp"
#include "hri/vision/hand_finder.hpp"
#include "vision/clips.hpp"

namespace py = pybind11;

namespace {

using hri_bind::as_clip;
using hri_bind::ByteArray;
using hri_bind::FloatArray;

py::object place_of(const hri::GestureSpotter& spotter) {
  const auto& place = spotter.place();
  if (!place) return py::none();
  return py::make_tuple(place->x, place->y, place->area);
}

using Faces = std::optional<std::shared_ptr<hri::FaceFinder>>;

hri::HandFinder finder_of(const hri::HandFinderOptions& options, const Faces& faces) {
  return faces ? hri::HandFinder(options, *faces) : hri::HandFinder(options);
}

template <class Stream>
hri::HandObservation hand_of(const Stream& self) {
  return self.spotter().hand();
}

void bind_spotter(py::module_& m) {
  py::class_<hri::GestureSpotter>(m, "GestureSpotter", "Gesture segments in a stream of pictures.")
      .def(py::init([](const hri::HandFinder& hands, bool dynamic,
                       const hri::GestureSegmenterOptions& options, int max_hands) {
             return std::make_unique<hri::GestureSpotter>(hands.stream(dynamic, max_hands),
                                                          options);
           }),
           py::arg("hands"), py::arg("dynamic") = true,
           py::arg("options") = hri::GestureSegmenterOptions{}, py::arg("max_hands") = 1)
      .def(
          "push",
          [](hri::GestureSpotter& self, const ByteArray& bgr, double time_s) {
            const auto picture = hri_bind::as_image(bgr, 3, "picture");
            const py::gil_scoped_release release;
            return self.push(picture, time_s);
          },
          py::arg("bgr"), py::arg("time_s"), "The GestureSegment event of the next picture.")
      .def("finish", &hri::GestureSpotter::finish,
           "The stream has ended: the GestureSegment that ends with it.")
      .def("interrupt", &hri::GestureSpotter::interrupt,
           "Pictures are missing: drops the gesture that has begun.")
      .def_property_readonly(
          "hand", [](const hri::GestureSpotter& self) { return hri::HandObservation(self.hand()); },
          "The hand in the last picture, a HandObservation.")
      .def_property_readonly("place", &place_of, "x, y and area in shares; None without a hand.")
      .def_property_readonly(
          "in_gesture",
          [](const hri::GestureSpotter& self) { return self.segmenter().in_gesture(); },
          "A gesture has begun and not ended.")
      .def_property_readonly("kept_since_s", &hri::GestureSpotter::kept_since_s,
                             "Pictures from then on may belong to a gesture.");
}

void bind_stream(py::module_& m) {
  hri_bind::bind_options<hri::GestureStreamOptions>(m,
                                                    "How the gestures of a stream are decided on.");
  py::class_<hri::GestureEvent>(m, "GestureEvent", "What happened with a picture of a stream.")
      .def_readonly("kind", &hri::GestureEvent::kind,
                    "'segment', 'partial', 'preliminary' or 'decision'.")
      .def_readonly("segment", &hri::GestureEvent::segment,
                    "The GestureSegment that this is about.")
      .def_readonly("decision", &hri::GestureEvent::decision, "The Decision; empty for segments.");
  py::class_<hri::GestureStream>(m, "GestureStream", "Decides on the gestures of a stream.")
      .def_static("options_for", &hri::GestureStream::options_for, py::arg("recognizer"))
      .def(py::init([](const hri::GestureRecognizer& recognizer,
                       const std::optional<hri::GestureStreamOptions>& chosen, const Faces& faces) {
             const hri::HandFinder finder = finder_of(recognizer.options().hands, faces);
             return std::make_unique<hri::GestureStream>(
                 recognizer, finder.stream(recognizer.is_dynamic(), recognizer.options().num_hands),
                 chosen ? *chosen : hri::GestureStream::options_for(recognizer));
           }),
           py::arg("recognizer"), py::arg("options") = py::none(), py::arg("faces") = py::none(),
           "faces: a FaceFinder, by which hands are found while a face is seen.")
      .def(
          "push",
          [](hri::GestureStream& self, const ByteArray& bgr, double time_s,
             const std::vector<FloatArray>& landmarks) {
            const auto picture = hri_bind::as_image(bgr, 3, "picture");
            std::vector<hri::MatrixF> hands;
            hands.reserve(landmarks.size());
            for (const FloatArray& points : landmarks)
              hands.emplace_back(hri_bind::as_matrix(points, "landmarks"));
            const py::gil_scoped_release release;
            return std::vector<hri::GestureEvent>(self.push(picture, time_s, hands));
          },
          py::arg("bgr"), py::arg("time_s"), py::arg("landmarks") = std::vector<FloatArray>(),
          "The events of the next picture; landmarks of every hand found, the surest first, in "
          "pixels, float32, shape (21, 2).")
      .def(
          "finish",
          [](hri::GestureStream& self) {
            const py::gil_scoped_release release;
            return std::vector<hri::GestureEvent>(self.finish());
          },
          "The stream has ended: preliminary decisions settle.")
      .def(
          "interrupt",
          [](hri::GestureStream& self) { return std::vector<hri::GestureEvent>(self.interrupt()); },
          "What was shown and has not settled is forgotten.")
      .def_property_readonly("hand", &hand_of<hri::GestureStream>,
                             "The hand in the last picture, a HandObservation.")
      .def_property_readonly(
          "place", [](const hri::GestureStream& self) { return place_of(self.spotter()); },
          "x, y and area in shares; None without a hand.")
      .def_property_readonly(
          "in_gesture",
          [](const hri::GestureStream& self) { return self.spotter().segmenter().in_gesture(); },
          "A gesture has begun and not ended.")
      .def_property_readonly("options", &hri::GestureStream::options,
                             "As passed, with defaults filled in.");
}

}  // namespace

void bind_vision_gestures(py::module_& m) {
  bind_spotter(m);
  bind_stream(m);
  m.def(
      "recognise_gesture",
      [](const hri::GestureRecognizer& recognizer, const std::vector<ByteArray>& clip) {
        const auto views = as_clip(clip);
        const py::gil_scoped_release release;
        return recognizer.recognise(views, hri::HandFinder(recognizer.options().hands));
      },
      py::arg("recognizer"), py::arg("clip"), "The Decision on a clip of BGR frames.");
  m.def(
      "gesture_features",
      [](const std::vector<ByteArray>& clip, const hri::GestureRecognizerOptions& options,
         const Faces& faces) {
        const auto views = as_clip(clip);
        hri::MatrixF rows;
        {
          const py::gil_scoped_release release;
          rows = hri::GestureRecognizer::features(views, finder_of(options.hands, faces), options);
        }
        return hri_bind::to_array(rows);
      },
      py::arg("clip"), py::arg("options"), py::arg("faces") = py::none(),
      "Rows of features of a clip, float32.");
}
