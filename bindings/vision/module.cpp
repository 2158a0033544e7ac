// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// hri._native_vision: what needs OpenCV. Its errors are the classes of hri._native.
#include <pybind11/pybind11.h>

#include "core/errors.hpp"
#include "hri/core/error.hpp"

namespace py = pybind11;

void bind_vision(py::module_& m);
void bind_vision_hands(py::module_& m);
void bind_vision_gestures(py::module_& m);
void bind_vision_people(py::module_& m);

namespace {

// Never released: exception classes live as long as the process.
PyObject* error_class(const char* name) {
  return py::object(py::module_::import("hri._native").attr(name)).release().ptr();
}

}  // namespace

PYBIND11_MODULE(_native_vision, m) {
  m.doc() = "libhri's vision part: silhouettes of hands in colour pictures.";
  static PyObject* const invalid_argument = error_class("InvalidArgument");
  static PyObject* const format_error = error_class("FormatError");
  static PyObject* const io_error = error_class("IoError");
  py::register_exception_translator([](std::exception_ptr p) {
    try {
      if (p) std::rethrow_exception(p);
    } catch (const hri::InvalidArgument& e) {
      hri_bind::raise(invalid_argument, e);
    } catch (const hri::FormatError& e) {
      hri_bind::raise(format_error, e);
    } catch (const hri::IoError& e) {
      hri_bind::raise(io_error, e);
    }
  });
  bind_vision(m);
  bind_vision_people(m);
  bind_vision_hands(m);
  bind_vision_gestures(m);
}
