// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Errors of libhri as exceptions of Python, for every compiled module.
#pragma once

#include <Python.h>

#include <exception>
#include <string>

namespace hri_bind {

// A message names files, whose names need not be text: it is read as Python reads these names.
inline void raise(PyObject* type, const std::exception& error) {
  const std::string text = error.what();
  PyObject* message =
      PyUnicode_DecodeFSDefaultAndSize(text.data(), static_cast<Py_ssize_t>(text.size()));
  if (message == nullptr) return;  // MemoryError is set
  PyErr_SetObject(type, message);
  Py_DECREF(message);
}

}  // namespace hri_bind
