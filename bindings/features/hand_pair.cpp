// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Both hands of a stream of masks.
#include "hri/features/hand/hand_pair.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <array>

#include "core/arrays.hpp"
#include "core/options.hpp"

namespace py = pybind11;

void bind_hand_pair(py::module_& m) {
  hri_bind::bind_options<hri::HandPairOptions>(m, "How two hands are kept apart.");
  py::class_<hri::PairedHand>(m, "PairedHand", "One of two hands in a frame.")
      .def_property_readonly(
          "mask", [](const hri::PairedHand& h) { return hri_bind::to_array(h.mask); },
          "uint8, shape (height, width), 255 where the hand is.")
      .def_readonly("seen", &hri::PairedHand::seen, "The hand is in view.")
      .def_readonly("touching", &hri::PairedHand::touching,
                    "One region holds both hands: the border between them is a guess.")
      .def_readonly("x_px", &hri::PairedHand::x_px, "Column of the hand's centre.")
      .def_readonly("y_px", &hri::PairedHand::y_px, "Row of the hand's centre.");
  py::class_<hri::HandPairTracker>(m, "HandPairTracker",
                                   "Tracks both hands in a stream of masks, also while they "
                                   "touch and where they cross.")
      .def(py::init<const hri::HandPairOptions&>(), py::arg("options") = hri::HandPairOptions{})
      .def(
          "push",
          [](hri::HandPairTracker& self, const hri_bind::ByteArray& mask) {
            const auto shape = hri_bind::as_image(mask, 1, "mask");
            const py::gil_scoped_release release;
            return std::array<hri::PairedHand, 2>(self.push(shape));
          },
          py::arg("mask"),
          "The left hand of the picture, then the right one. mask: uint8, shape (height, width).")
      .def("reset", &hri::HandPairTracker::reset, "Forgets both hands.");
}
