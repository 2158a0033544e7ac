// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Inputs of the models' bindings: whole numbers of any NumPy type, vectors, model files, and the
// interrupt check.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "core/arrays.hpp"
#include "hri/core/error.hpp"
#include "hri/core/types.hpp"

namespace hri_bind {

template <class T, int Flags>
hri::Vector<T> as_vector(const py::array_t<T, Flags>& array, const char* name) {
  const hri::Span<const T> values = as_span(array, name);
  return Eigen::Map<const hri::Vector<T>>(values.data(), static_cast<Eigen::Index>(values.size()));
}

/// Whole numbers of any NumPy integer type, one dimension, as int32; refuses floats and what does
/// not fit. Contiguous int32 arrays are viewed, not copied, and short ones of other types need no
/// memory of the heap. Must not outlive the array.
class Integers {
 public:
  Integers(const py::array& array, const char* name)
      : size_(static_cast<std::size_t>(array.size())) {
    const char kind = array.dtype().kind();
    if (array.ndim() != 1 || (kind != 'i' && kind != 'u' && size_ > 0)) {
      hri::fail(hri::ErrorKind::invalid_argument,
                std::string(name) + " must be one-dimensional integers");
    }
    const bool plain = kind == 'i' && is_plain(array);
    if (plain && array.itemsize() == sizeof(std::int32_t) && array.strides(0) == array.itemsize()) {
      data_ = static_cast<const std::int32_t*>(array.data());
    } else if (plain && array.itemsize() == sizeof(std::int64_t)) {
      narrow(static_cast<const char*>(array.data()), array.strides(0), name);
    } else {
      const py::array_t<std::int64_t, py::array::c_style | py::array::forcecast> wide(array);
      narrow(reinterpret_cast<const char*>(wide.data()), sizeof(std::int64_t), name);
    }
  }
  Integers(const Integers&) = delete;
  Integers& operator=(const Integers&) = delete;

  [[nodiscard]] hri::Span<const std::int32_t> span() const { return {data_, size_}; }

 private:
  static bool is_plain(const py::array& array) {
    const char order = array.dtype().byteorder();
    return (order == '=' || order == '|') &&
           (array.flags() & py::detail::npy_api::NPY_ARRAY_ALIGNED_) != 0;
  }

  void narrow(const char* from, py::ssize_t stride, const char* name) {
    std::int32_t* to = few_.data();
    if (size_ > few_.size()) {
      many_.resize(size_);
      to = many_.data();
    }
    data_ = to;
    for (std::size_t i = 0; i < size_; ++i, from += stride) {
      const std::int64_t value = *reinterpret_cast<const std::int64_t*>(from);
      if (value < std::numeric_limits<std::int32_t>::min() ||
          value > std::numeric_limits<std::int32_t>::max()) {
        hri::fail(hri::ErrorKind::invalid_argument, std::string(name) + "[" + std::to_string(i) +
                                                        "] = " + std::to_string(value) +
                                                        " is out of range");
      }
      to[i] = static_cast<std::int32_t>(value);
    }
  }

  const std::int32_t* data_ = nullptr;
  std::size_t size_;
  std::array<std::int32_t, 256> few_;
  std::vector<std::int32_t> many_;
};

inline std::vector<std::int32_t> as_integers(const py::array& array, const char* name) {
  const Integers integers(array, name);
  return {integers.span().begin(), integers.span().end()};
}

/// Symbol sequences of a training.
inline std::vector<std::vector<std::int32_t>> as_symbols(const std::vector<py::array>& arrays) {
  std::vector<std::vector<std::int32_t>> sequences;
  sequences.reserve(arrays.size());
  for (const py::array& a : arrays) sequences.push_back(as_integers(a, "a sequence"));
  return sequences;
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
