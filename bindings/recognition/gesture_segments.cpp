// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Gesture segments in a stream of masks.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "core/arrays.hpp"
#include "core/options.hpp"
#include "hri/recognition/gesture/gesture_segmenter.hpp"

namespace py = pybind11;

void bind_gesture_segments(py::module_& m) {
  m.attr("LEARNED_STILL_CHANGE") = hri::kLearnedStillChange;
  py::class_<hri::GestureSegmenterOptions> options(
      m, "GestureSegmenterOptions", "When a gesture begins and ends; times in seconds.");
  hri_bind::options(options)
      .field("appear_s", &hri::GestureSegmenterOptions::appear_s)
      .field("leave_s", &hri::GestureSegmenterOptions::leave_s)
      .field("rest_s", &hri::GestureSegmenterOptions::rest_s)
      .field("still_change", &hri::GestureSegmenterOptions::still_change)
      .field("compare_s", &hri::GestureSegmenterOptions::compare_s)
      .field("min_gesture_s", &hri::GestureSegmenterOptions::min_gesture_s)
      .field("max_gesture_s", &hri::GestureSegmenterOptions::max_gesture_s)
      .field("take_away_s", &hri::GestureSegmenterOptions::take_away_s)
      .field("context_s", &hri::GestureSegmenterOptions::context_s)
      .field("arrivals", &hri::GestureSegmenterOptions::arrivals);
  py::enum_<hri::GestureSegmentKind>(m, "GestureSegmentKind")
      .value("none", hri::GestureSegmentKind::none)
      .value("start", hri::GestureSegmentKind::start)
      .value("end", hri::GestureSegmentKind::end)
      .value("dropped", hri::GestureSegmentKind::dropped);
  py::enum_<hri::GestureSegmentReason>(m, "GestureSegmentReason")
      .value("none", hri::GestureSegmentReason::none)
      .value("rested", hri::GestureSegmentReason::rested)
      .value("left", hri::GestureSegmentReason::left)
      .value("cut", hri::GestureSegmentReason::cut)
      .value("ended", hri::GestureSegmentReason::ended)
      .value("arrived", hri::GestureSegmentReason::arrived)
      .value("stalled", hri::GestureSegmentReason::stalled);
  py::class_<hri::GestureSegment>(m, "GestureSegment", "An event in a stream of masks.")
      .def_property_readonly(
          "kind",
          [](const hri::GestureSegment& s) -> py::object { return py::cast(s.kind).attr("name"); },
          "'none', 'start', 'end' or 'dropped'.")
      .def_property_readonly(
          "reason",
          [](const hri::GestureSegment& s) -> py::object {
            return py::cast(s.reason).attr("name");
          },
          "Why it ended: 'rested', 'left', 'cut', 'ended', 'arrived', 'stalled'.")
      .def_readonly("first_s", &hri::GestureSegment::first_s)
      .def_readonly("last_s", &hri::GestureSegment::last_s)
      .def_readonly("from_rest", &hri::GestureSegment::from_rest,
                    "The hand rested in view before it.");
  py::class_<hri::GestureSegmenter>(m, "GestureSegmenter",
                                    "Finds when gestures begin and end, from masks of the hand.")
      .def(py::init([](const hri::GestureSegmenterOptions& chosen) {
             return hri::GestureSegmenter(chosen);
           }),
           py::arg("options") = hri::GestureSegmenterOptions{})
      .def(
          "push",
          [](hri::GestureSegmenter& self, const hri_bind::ByteArray& mask, double time_s) {
            return self.push(hri_bind::as_image(mask, 1, "mask"), time_s);
          },
          py::arg("mask"), py::arg("time_s"), "The next mask (0 is background) and its time.")
      .def("finish", &hri::GestureSegmenter::finish, "The stream has ended.")
      .def("interrupt", &hri::GestureSegmenter::interrupt,
           "Forgets everything; what had begun is dropped.")
      .def(
          "replace_outlines",
          [](hri::GestureSegmenter& self, const hri_bind::ByteArray& mask) {
            self.replace_outlines(hri_bind::as_image(mask, 1, "mask"));
          },
          py::arg("mask"), "The hand of now looks like this, as it is found in another way.")
      .def_property_readonly("in_gesture", &hri::GestureSegmenter::in_gesture)
      .def_property_readonly("hand_away", &hri::GestureSegmenter::hand_away)
      .def_property_readonly("may_have_begun_s", &hri::GestureSegmenter::may_have_begun_s)
      .def_property_readonly("options", &hri::GestureSegmenter::options);
}
