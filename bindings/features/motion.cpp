// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Features of moving gestures.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "core/arrays.hpp"
#include "core/options.hpp"
#include "hri/features/motion/hybrid_feature.hpp"

namespace py = pybind11;

void bind_motion_features(py::module_& m) {
  hri_bind::bind_options<hri::HybridFeatureOptions>(
      m, "Parts of the hybrid feature of a moving gesture (thesis eq. 5.2-5.13).");
  py::class_<hri::HybridFeatureComputer>(
      m, "HybridFeatureComputer",
      "Moments, orientation, chain codes and speed of a moving hand, each in 0..1, joined.")
      .def(py::init<const hri::HybridFeatureOptions&>(),
           py::arg("options") = hri::HybridFeatureOptions{})
      .def_property_readonly("num_features", &hri::HybridFeatureComputer::num_features,
                             "Columns of the features.")
      .def_property_readonly("num_moments", &hri::HybridFeatureComputer::num_moments,
                             "Those that are moments; they come first.")
      .def_property_readonly("options", &hri::HybridFeatureComputer::options, "As given.")
      .def(
          "compute",
          [](const hri::HybridFeatureComputer& self,
             const std::vector<hri_bind::ByteArray>& masks) {
            std::vector<hri::ImageView> views;
            views.reserve(masks.size());
            for (const hri_bind::ByteArray& mask : masks)
              views.push_back(hri_bind::as_image(mask, 1, "masks"));
            hri::MatrixF out;
            {
              const py::gil_scoped_release release;
              out = self.compute(views);
            }
            return hri_bind::to_array(out);
          },
          py::arg("masks"),
          "float32, a row for every mask of the gesture that shows a hand: moments, orientation, "
          "chain code of the direction from the middle of the way, of the step to the next place, "
          "speed. masks: uint8, each of shape (height, width). Raises InvalidArgument.");
  m.def("direction_code", &hri::direction_code, py::arg("dx"), py::arg("dy"),
        "Freeman's direction of a way in image axes (y down): 0 right, 2 up, 4 left, 6 down; 0 for "
        "no way (thesis eq. 5.11). Raises InvalidArgument for what is not finite.");
}
