// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Features of tracks of both hands.
#include "hri/features/hand/two_hand_features.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "core/arrays.hpp"
#include "core/options.hpp"
#include "hri/features/hand/landmark_pair.hpp"
#include "hri/features/hand/pair_rows.hpp"

namespace py = pybind11;
using hri_bind::as_matrix;
using hri_bind::FloatArray;

void bind_two_hand_features(py::module_& m) {
  hri_bind::bind_options<hri::TwoHandFeatureOptions>(m, "Features of tracks of both hands.");
  m.attr("TWO_HAND_TRACK_COLUMNS") = py::tuple(py::cast(hri::kTwoHandTrackColumns));
  m.def(
      "hand_scale_px",
      [](const FloatArray& tracks) { return hri::hand_scale_px(as_matrix(tracks, "tracks")); },
      py::arg("tracks"),
      "Root mean square distance of the hands from the reference, in pixels. tracks: float32, "
      "shape (num_frames, 6), columns TWO_HAND_TRACK_COLUMNS, NaN where a point is out of sight. "
      "Raises InvalidArgument.");
  m.def(
      "pair_rows",
      [](const FloatArray& left, const FloatArray& right, double relation_weight) {
        return hri_bind::to_array(
            hri::pair_rows(as_matrix(left, "left"), as_matrix(right, "right"), relation_weight));
      },
      py::arg("left"), py::arg("right"), py::arg("relation_weight"),
      "Rows of a gesture of both hands, float32, a row for every frame that shows a hand. left, "
      "right: rows of each in every frame, all NaN where it is not seen. Raises InvalidArgument.");
  m.def(
      "track_rows",
      [](const FloatArray& tracks, double scale_px, int num_hands) {
        return hri_bind::to_array(
            hri::track_rows(as_matrix(tracks, "tracks"), scale_px, num_hands));
      },
      py::arg("tracks"), py::arg("scale_px") = 0.0, py::arg("num_hands") = 2,
      "Rows of a gesture of which only places are known, for GestureRecognizer.fit_features: "
      "float32, shape (num_frames, num_features). tracks, scale_px: as of "
      "TwoHandFeatureComputer.compute. Raises InvalidArgument.");
  hri_bind::bind_options<hri::LandmarkPairOptions>(m, "How landmarks of two hands are kept apart.");
  py::class_<hri::LandmarkPairTracker>(m, "LandmarkPairTracker",
                                       "Tracks both hands in a stream of landmarks.")
      .def(py::init<const hri::LandmarkPairOptions&>(),
           py::arg("options") = hri::LandmarkPairOptions{})
      .def(
          "push",
          [](hri::LandmarkPairTracker& self, const std::vector<FloatArray>& hands, int width_px) {
            std::vector<hri::MatrixF> points;
            points.reserve(hands.size());
            for (const FloatArray& hand : hands) points.emplace_back(as_matrix(hand, "hands"));
            return self.push(points, width_px);
          },
          py::arg("hands"), py::arg("width_px"),
          "Which of the hands found, each float32 of shape (21, 2) in pixels, is the left one of "
          "the picture, and which the right one; -1: not seen. Raises InvalidArgument.")
      .def("reset", &hri::LandmarkPairTracker::reset, "Forgets both hands.");
  py::class_<hri::TwoHandFeatureComputer>(
      m, "TwoHandFeatureComputer",
      "Features of both hands in every frame, from tracks of the hands and the head.")
      .def(py::init<const hri::TwoHandFeatureOptions&>(),
           py::arg("options") = hri::TwoHandFeatureOptions{})
      .def_property_readonly("num_features", &hri::TwoHandFeatureComputer::num_features,
                             "Columns of the result.")
      .def_property_readonly("options", &hri::TwoHandFeatureComputer::options, "As given.")
      .def(
          "compute",
          [](const hri::TwoHandFeatureComputer& self, const FloatArray& tracks, double scale_px) {
            const auto view = as_matrix(tracks, "tracks");
            return hri_bind::to_array(scale_px == 0 ? self.compute(view)
                                                    : self.compute(view, scale_px));
          },
          py::arg("tracks"), py::arg("scale_px") = 0.0,
          "float32, shape (num_frames, num_features). tracks: as of hand_scale_px(); scale_px: by "
          "which places are divided, 0: hand_scale_px(tracks). Raises InvalidArgument.");
}
