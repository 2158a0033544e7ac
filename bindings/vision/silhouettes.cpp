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
  py::enum_<hri::SilhouetteMethod>(m, "SilhouetteMethod")
      .value("chroma_otsu", hri::SilhouetteMethod::chroma_otsu)
      .value("hsv", hri::SilhouetteMethod::hsv)
      .value("grey_otsu", hri::SilhouetteMethod::grey_otsu);
  py::class_<hri::SilhouetteOptions> options(m, "SilhouetteOptions",
                                             "How the hand is found in a picture.");
  hri_bind::options(options)
      .field("method", &hri::SilhouetteOptions::method)
      .field("max_side_px", &hri::SilhouetteOptions::max_side_px)
      .field("blur_px", &hri::SilhouetteOptions::blur_px)
      .field("min_contrast", &hri::SilhouetteOptions::min_contrast)
      .field("sure_contrast", &hri::SilhouetteOptions::sure_contrast)
      .field("min_quality", &hri::SilhouetteOptions::min_quality)
      .field("min_area", &hri::SilhouetteOptions::min_area)
      .field("max_area", &hri::SilhouetteOptions::max_area)
      .field("remove_face", &hri::SilhouetteOptions::remove_face)
      .field("max_hands", &hri::SilhouetteOptions::max_hands);
  py::class_<hri::Silhouette>(m, "Silhouette", "What was found in one picture.")
      .def_property_readonly("grey",
                             [](const hri::Silhouette& s) { return hri_bind::to_array(s.grey); })
      .def_property_readonly("mask",
                             [](const hri::Silhouette& s) { return hri_bind::to_array(s.mask); })
      .def_readonly("quality", &hri::Silhouette::quality)
      .def_readonly("repaired", &hri::Silhouette::repaired,
                    "The frames around it made the mask, because it jumped: see smooth_masks.");
  py::class_<hri::MaskSmoothingOptions> smoothing_options(m, "MaskSmoothingOptions",
                                                          "Which masks of a clip are repaired.");
  hri_bind::options(smoothing_options)
      .field("max_gap", &hri::MaskSmoothingOptions::max_gap)
      .field("min_agreement", &hri::MaskSmoothingOptions::min_agreement)
      .field("max_overlap", &hri::MaskSmoothingOptions::max_overlap);
  m.def(
      "smooth_masks",
      [](std::vector<hri::Silhouette> clip, const hri::MaskSmoothingOptions& chosen) {
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

  py::class_<hri::HandColourOptions> colour_options(
      m, "HandColourOptions", "How the colours of hand and background are learned from a clip.");
  hri_bind::options(colour_options)
      .field("max_side_px", &hri::HandColourOptions::max_side_px)
      .field("fit_side_px", &hri::HandColourOptions::fit_side_px)
      .field("num_fit_frames", &hri::HandColourOptions::num_fit_frames)
      .field("num_rounds", &hri::HandColourOptions::num_rounds)
      .field("min_area", &hri::HandColourOptions::min_area)
      .field("max_area", &hri::HandColourOptions::max_area)
      .field("min_quality", &hri::HandColourOptions::min_quality)
      .field("remove_still", &hri::HandColourOptions::remove_still)
      .field("max_hands", &hri::HandColourOptions::max_hands);
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
      .def_property_readonly("quality", &hri::HandColours::quality);
}
