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
  hri_bind::bind_options<hri::GestureSegmenterOptions>(
      m, "When a gesture begins and ends; times in seconds.");
  py::class_<hri::GestureSegment>(m, "GestureSegment", "An event in a stream of masks.")
      .def_readonly("kind", &hri::GestureSegment::kind, "'none', 'start', 'end' or 'dropped'.")
      .def_readonly("reason", &hri::GestureSegment::reason,
                    "Why it ended: 'rested', 'left', 'cut', 'ended', 'arrived', 'stalled'.")
      .def_readonly("first_s", &hri::GestureSegment::first_s, "Its beginning, in seconds.")
      .def_readonly("last_s", &hri::GestureSegment::last_s, "Its end, in seconds.")
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
      .def_property_readonly("in_gesture", &hri::GestureSegmenter::in_gesture,
                             "A gesture has begun and not ended.")
      .def_property_readonly("hand_away", &hri::GestureSegmenter::hand_away, "No hand is in view.")
      .def_property_readonly("may_have_begun_s", &hri::GestureSegmenter::may_have_begun_s,
                             "When a gesture that is not reported yet may have begun.")
      .def_property_readonly("options", &hri::GestureSegmenter::options,
                             "As passed, with defaults filled in.");
}
