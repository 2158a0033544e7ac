// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Features of tracks of both hands.
#include "hri/features/hand/two_hand_features.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "core/arrays.hpp"
#include "core/options.hpp"

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
