// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Silhouettes; the part that needs OpenCV.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "arrays.hpp"
#include "hri/vision/silhouette.hpp"
#include "options.hpp"

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
      .field("remove_face", &hri::SilhouetteOptions::remove_face);
  py::class_<hri::Silhouette>(m, "Silhouette", "What was found in one picture.")
      .def_property_readonly("grey",
                             [](const hri::Silhouette& s) { return hri_bind::to_array(s.grey); })
      .def_property_readonly("mask",
                             [](const hri::Silhouette& s) { return hri_bind::to_array(s.mask); })
      .def_readonly("quality", &hri::Silhouette::quality);
  py::class_<hri::SilhouetteExtractor>(m, "SilhouetteExtractor",
                                       "Finds the hand in colour pictures.")
      .def(py::init<const hri::SilhouetteOptions&>(), py::arg("options") = hri::SilhouetteOptions{})
      .def(
          "extract",
          [](const hri::SilhouetteExtractor& self, const hri_bind::ByteArray& bgr) {
            const auto picture = hri_bind::as_image(bgr, 3, "picture");
            const py::gil_scoped_release release;
            return self.extract(picture);
          },
          py::arg("bgr"), "bgr: uint8, shape (height, width, 3).");
}
