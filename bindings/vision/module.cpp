// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// hri._native_vision: what needs OpenCV. Its errors are the classes of hri._native.
#include <pybind11/pybind11.h>

#include "hri/core/error.hpp"

namespace py = pybind11;

void bind_vision(py::module_& m);
void bind_vision_hands(py::module_& m);
void bind_vision_gestures(py::module_& m);

PYBIND11_MODULE(_native_vision, m) {
  m.doc() = "libhri's vision part: silhouettes of hands in colour pictures.";
  // Never released: exception classes live as long as the process.
  static PyObject* const invalid_argument =
      py::object(py::module_::import("hri._native").attr("InvalidArgument")).release().ptr();
  py::register_exception_translator([](std::exception_ptr p) {
    try {
      if (p) std::rethrow_exception(p);
    } catch (const hri::InvalidArgument& e) {
      PyErr_SetString(invalid_argument, e.what());
    }
  });
  bind_vision(m);
  bind_vision_hands(m);
  bind_vision_gestures(m);
}
