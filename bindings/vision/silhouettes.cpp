// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Silhouettes; the part that needs OpenCV.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <optional>
#include <string>
#include <vector>

#include "core/arrays.hpp"
#include "core/options.hpp"
#include "hri/vision/hand_colours.hpp"
#include "hri/vision/mask_smoothing.hpp"
#include "hri/vision/silhouette.hpp"

namespace py = pybind11;

void bind_vision(py::module_& m) {
  // Bound in hri._native, as recognisers own and save them without OpenCV.
  const py::module_ core = py::module_::import("hri._native");
  for (const char* name :
       {"SilhouetteOptions", "MaskSmoothingOptions", "HandColourOptions", "HandObservation"})
    m.attr(name) = core.attr(name);
  m.def(
      "smooth_masks",
      [](std::vector<hri::HandObservation> clip, const hri::MaskSmoothingOptions& chosen) {
        const py::gil_scoped_release release;
        hri::smooth_masks(chosen, &clip);
        return clip;
      },
      py::arg("silhouettes"), py::arg("options") = hri::MaskSmoothingOptions{},
      "Silhouettes of a clip, with masks repaired that jump for a frame or two between frames that "
      "agree, and have less quality than these.");
  py::class_<hri::SilhouetteExtractor>(m, "SilhouetteExtractor",
                                       "Finds the hand in colour pictures.")
      .def(py::init([](const hri::SilhouetteOptions& chosen,
                       const std::optional<hri_bind::ByteArray>& background) {
             return background ? hri::SilhouetteExtractor(
                                     chosen, hri_bind::as_image(*background, 3, "background"))
                               : hri::SilhouetteExtractor(chosen);
           }),
           py::arg("options") = hri::SilhouetteOptions{}, py::arg("background") = py::none(),
           "background: uint8, shape (height, width, 3), the place without a person.")
      .def(
          "extract",
          [](const hri::SilhouetteExtractor& self, const hri_bind::ByteArray& bgr) {
            const auto picture = hri_bind::as_image(bgr, 3, "picture");
            const py::gil_scoped_release release;
            return self.extract(picture);
          },
          py::arg("bgr"), "bgr: uint8, shape (height, width, 3).");

  py::class_<hri::HandColours>(m, "HandColours",
                               "Finds the hand by the colours it has in its own clip.")
      .def_static(
          "learn",
          [](const std::vector<hri_bind::ByteArray>& frames,
             const hri::HandColourOptions& colours) {
            std::vector<hri::ImageView> views;
            views.reserve(frames.size());
            for (std::size_t i = 0; i < frames.size(); ++i)
              views.push_back(
                  hri_bind::as_image(frames[i], 3, ("frame " + std::to_string(i)).c_str()));
            const py::gil_scoped_release release;
            return hri::HandColours::learn(views, colours);
          },
          py::arg("frames"), py::arg("options") = hri::HandColourOptions{},
          "frames: uint8, each of shape (height, width, 3), BGR. None where no hand stands out.")
      .def(
          "extract",
          [](const hri::HandColours& self, const hri_bind::ByteArray& bgr) {
            const auto picture = hri_bind::as_image(bgr, 3, "picture");
            const py::gil_scoped_release release;
            return self.extract(picture);
          },
          py::arg("bgr"), "bgr: uint8, shape (height, width, 3).")
      .def_property_readonly("quality", &hri::HandColours::quality,
                             "How well the pixels on both sides of the outline separate, 0..1.");
}
