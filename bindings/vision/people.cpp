// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Faces, and the hands of the person whose face is seen.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <memory>

#include "core/arrays.hpp"
#include "core/options.hpp"
#include "core/paths.hpp"
#include "hri/vision/face_finder.hpp"
#include "hri/vision/person_hands.hpp"

namespace py = pybind11;

void bind_vision_people(py::module_& m) {
  hri_bind::bind_options<hri::FaceFinderOptions>(m, "How faces are found.");
  hri_bind::bind_options<hri::PersonOptions>(
      m, "How the hands of a person whose face is seen are found.");
  py::class_<hri::Face>(m, "Face", "The square around a face.")
      .def(py::init([](double left_px, double top_px, double side_px) {
             return hri::Face{left_px, top_px, side_px};
           }),
           py::arg("left_px"), py::arg("top_px"), py::arg("side_px"), "In pixels of the picture.")
      .def_readonly("left_px", &hri::Face::left_px, "Column of its left side.")
      .def_readonly("top_px", &hri::Face::top_px, "Row of its upper side.")
      .def_readonly("side_px", &hri::Face::side_px, "Width and height.");
  py::class_<hri::FaceFinder, std::shared_ptr<hri::FaceFinder>>(m, "FaceFinder",
                                                                "Finds the face in pictures.")
      .def(py::init([](const hri_bind::Path& cascade, const hri::FaceFinderOptions& options) {
             return std::make_shared<hri::FaceFinder>(cascade.text, options);
           }),
           py::arg("cascade"), py::arg("options") = hri::FaceFinderOptions{},
           "cascade: path of a cascade of classifiers, as OpenCV writes them.")
      .def(
          "find",
          [](const hri::FaceFinder& self, const hri_bind::ByteArray& bgr) {
            const auto picture = hri_bind::as_image(bgr, 3, "picture");
            const py::gil_scoped_release release;
            return self.find(picture);
          },
          py::arg("bgr"),
          "The Face on which most windows agree, or None. bgr: uint8, shape (height, width, 3).")
      .def(
          "find_in_still",
          [](const hri::FaceFinder& self, const hri_bind::ByteArray& bgr) {
            const auto picture = hri_bind::as_image(bgr, 3, "picture");
            const py::gil_scoped_release release;
            return self.find_in_still(picture);
          },
          py::arg("bgr"),
          "The same of a single picture: where fewer than sure_neighbours windows agree it is "
          "searched at twice its size, too, for faces that are small.");
  py::class_<hri::PersonHands>(m, "PersonHands", "Finds the hands of a person whose face is seen.")
      .def(py::init<const hri::PersonOptions&>(), py::arg("options") = hri::PersonOptions{})
      .def(
          "extract",
          [](const hri::PersonHands& self, const hri_bind::ByteArray& bgr, const hri::Face& face) {
            const auto picture = hri_bind::as_image(bgr, 3, "picture");
            const py::gil_scoped_release release;
            return self.extract(picture, face);
          },
          py::arg("bgr"), py::arg("face"),
          "The HandObservation of the person with this face. bgr: uint8, shape (height, width, "
          "3).");
}
