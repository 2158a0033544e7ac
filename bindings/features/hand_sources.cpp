// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// How hands are found, what is found, and features of landmarks; all that needs no OpenCV.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <optional>

#include "core/arrays.hpp"
#include "core/options.hpp"
#include "hri/features/hand/hand_finder_options.hpp"
#include "hri/features/hand/hand_place.hpp"
#include "hri/features/hand/hand_source.hpp"
#include "hri/features/hand/landmarks.hpp"

namespace py = pybind11;

namespace {

// A view of an image that another object keeps.
py::array_t<std::uint8_t> shared_array(const hri::GreyImage& image, const py::object& owner) {
  py::array_t<std::uint8_t> view({image.height_px, image.width_px}, image.pixels.data(), owner);
  view.attr("setflags")(py::arg("write") = false);
  return view;
}

void bind_finder_options(py::module_& m) {
  hri_bind::bind_options<hri::SilhouetteOptions>(m, "How the hand is found in a picture.");
  hri_bind::bind_options<hri::MaskSmoothingOptions>(m, "Which masks of a clip are repaired.");
  hri_bind::bind_options<hri::HandColourOptions>(
      m, "How the colours of hand and background are learned from a clip.");
  hri_bind::bind_options<hri::HandFinderOptions>(m, "How hands are found in clips and streams.");
}

}  // namespace

void bind_hand_sources(py::module_& m) {
  bind_finder_options(m);
  py::class_<hri::HandObservation>(m, "HandObservation", "What was found in one picture.")
      .def(py::init([](const hri_bind::ByteArray& grey, const hri_bind::ByteArray& mask,
                       double quality) {
             const auto copied = [](const hri::ImageView& view) {
               hri::GreyImage image(view.width_px, view.height_px);
               std::copy_n(view.data, image.pixels.size(), image.pixels.begin());
               return image;
             };
             const auto of_grey = hri_bind::as_image(grey, 1, "grey");
             const auto of_mask = hri_bind::as_image(mask, 1, "mask");
             hri::require(
                 of_grey.width_px == of_mask.width_px && of_grey.height_px == of_mask.height_px,
                 "grey and mask differ in size");
             return hri::HandObservation{copied(of_grey), copied(of_mask), quality, false, false};
           }),
           py::arg("grey"), py::arg("mask"), py::arg("quality") = 1.0,
           "Of a hand that was found in another way; uint8 arrays of one size, 255 is hand.")
      .def_property_readonly(
          "grey",
          [](const py::object& self) {
            return shared_array(py::cast<const hri::HandObservation&>(self).grey, self);
          },
          "uint8, read-only, at the working size.")
      .def_property_readonly(
          "mask",
          [](const py::object& self) {
            return shared_array(py::cast<const hri::HandObservation&>(self).mask, self);
          },
          "uint8, read-only: 255 is hand; all 0 without one.")
      .def_readonly("quality", &hri::HandObservation::quality,
                    "0 (no hand) .. 1: how far the mask can be trusted.")
      .def_readonly("repaired", &hri::HandObservation::repaired,
                    "The frames around it made the mask, because it jumped: see smooth_masks.")
      .def_readonly("touching", &hri::HandObservation::touching,
                    "Of one of two hands: one region holds both, the border is a guess.");
  m.def(
      "hand_place",
      [](const hri_bind::ByteArray& mask) -> py::object {
        const auto place = hri::hand_place(hri_bind::as_image(mask, 1, "mask"));
        if (!place) return py::none();
        return py::make_tuple(place->x, place->y, place->area);
      },
      py::arg("mask"), "x, y and area of the hand in shares of the picture; None without one.");
  m.attr("NUM_LANDMARKS") = hri::kNumLandmarks;
  m.def("landmark_column_names", &hri::landmark_column_names,
        "Names of the columns of landmark_features; joints are numbered as MediaPipe's are.");
  m.def(
      "landmark_features",
      [](const hri_bind::FloatArray& points, int width_px, int height_px) {
        const auto rows = hri_bind::as_matrix(points, "points");
        hri::VectorF out(hri::kNumLandmarkFeatures);
        hri::landmark_features(rows, width_px, height_px,
                               {out.data(), static_cast<std::size_t>(out.size())});
        return hri_bind::to_array(out);
      },
      py::arg("points"), py::arg("width_px"), py::arg("height_px"),
      "float32, shape (85,), of joints in pixels, shape (21, 2).");
}
