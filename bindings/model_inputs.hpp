// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Inputs of the models' bindings: whole numbers of any NumPy type, vectors, model files, and the
// interrupt check.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "arrays.hpp"
#include "hri/core/error.hpp"
#include "hri/core/types.hpp"

namespace hri_bind {

template <class T, int Flags>
hri::Vector<T> as_vector(const py::array_t<T, Flags>& array, const char* name) {
  const hri::Span<const T> values = as_span(array, name);
  return Eigen::Map<const hri::Vector<T>>(values.data(), static_cast<Eigen::Index>(values.size()));
}

/// Whole numbers of any NumPy integer type, one dimension; refuses floats and what does not fit
/// into 32 bits.
inline std::vector<std::int32_t> as_integers(const py::array& array, const char* name) {
  const char kind = array.dtype().kind();
  if (array.ndim() != 1 || (kind != 'i' && kind != 'u' && array.size() > 0)) {
    hri::fail(hri::ErrorKind::invalid_argument,
              std::string(name) + " must be one-dimensional integers");
  }
  const py::array_t<std::int64_t, py::array::c_style | py::array::forcecast> wide(array);
  std::vector<std::int32_t> values;
  values.reserve(static_cast<std::size_t>(wide.size()));
  for (py::ssize_t i = 0; i < wide.size(); ++i) {
    const std::int64_t value = wide.data()[i];
    if (value < std::numeric_limits<std::int32_t>::min() ||
        value > std::numeric_limits<std::int32_t>::max()) {
      hri::fail(hri::ErrorKind::invalid_argument, std::string(name) + "[" + std::to_string(i) +
                                                      "] = " + std::to_string(value) +
                                                      " is out of range");
    }
    values.push_back(static_cast<std::int32_t>(value));
  }
  return values;
}

/// Polled by trainings: true once a signal handler raised (Ctrl-C).
inline bool interrupted() {
  const py::gil_scoped_acquire gil;
  return PyErr_CheckSignals() != 0;
}

/// write and read, which every model has.
template <class Model>
void bind_files(py::class_<Model>& cls) {
  cls.def("write", &Model::write, py::arg("file"), py::arg("prefix"),
          "Adds the model to a ModelFile.");
  cls.def_static(
      "read", &Model::read, py::arg("file"), py::arg("prefix"),
      "Reads what `write` added; raises FormatError naming the field that does not fit.");
}

}  // namespace hri_bind
