// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// NumPy arrays to views and matrices. Contiguous arrays of the right dtype are not copied on the
// way to a view.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <string>
#include <utility>

#include "hri/core/error.hpp"
#include "hri/core/image_view.hpp"
#include "hri/core/types.hpp"

namespace hri_bind {

namespace py = pybind11;

using FloatArray = py::array_t<float, py::array::c_style | py::array::forcecast>;
using DoubleArray = py::array_t<double, py::array::c_style | py::array::forcecast>;
using IntArray = py::array_t<std::int32_t, py::array::c_style | py::array::forcecast>;
using ByteArray = py::array_t<std::uint8_t, py::array::c_style>;

inline void require_dimensions(const py::array& a, int dimensions, const char* name) {
  if (a.ndim() != dimensions) {
    hri::fail(hri::ErrorKind::invalid_argument, std::string(name) + " must have " +
                                                    std::to_string(dimensions) +
                                                    " dimensions, got " + std::to_string(a.ndim()));
  }
}

template <class T, int Flags>
hri::Span<const T> as_span(const py::array_t<T, Flags>& a, const char* name) {
  require_dimensions(a, 1, name);
  return {a.data(), static_cast<std::size_t>(a.size())};
}

template <class T, int Flags>
Eigen::Map<const hri::Matrix<T>> as_matrix(const py::array_t<T, Flags>& a, const char* name) {
  require_dimensions(a, 2, name);
  return {a.data(), a.shape(0), a.shape(1)};
}

/// One channel (height, width) or interleaved (height, width, channels); an empty array gives an
/// empty view.
inline hri::ImageView as_image(const ByteArray& a, int channels, const char* name) {
  if (a.size() == 0) return {};
  require_dimensions(a, channels == 1 ? 2 : 3, name);
  if (channels != 1 && a.shape(2) != channels) {
    hri::fail(hri::ErrorKind::invalid_argument, std::string(name) + " must have " +
                                                    std::to_string(channels) + " channels, got " +
                                                    std::to_string(a.shape(2)));
  }
  const auto width = static_cast<int>(a.shape(1));
  return {a.data(), width, static_cast<int>(a.shape(0)), channels,
          static_cast<std::ptrdiff_t>(width) * channels};
}

inline py::array_t<std::uint8_t> to_array(const hri::GreyImage& image) {
  py::array_t<std::uint8_t> out({image.height_px, image.width_px});
  std::copy(image.pixels.begin(), image.pixels.end(), out.mutable_data());
  return out;
}

template <class T>
py::array_t<T> to_array(const hri::Vector<T>& v) {
  return py::array_t<T>(v.size(), v.data());
}

template <class T>
py::array_t<T> to_array(const hri::Matrix<T>& m) {
  py::array_t<T> out({m.rows(), m.cols()});
  std::copy(m.data(), m.data() + m.size(), out.mutable_data());
  return out;
}

template <class T>
py::array_t<T> to_array(const std::vector<T>& v) {
  return py::array_t<T>(static_cast<py::ssize_t>(v.size()), v.data());
}

}  // namespace hri_bind
