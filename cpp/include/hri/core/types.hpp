// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Matrices and views used by every public header. Matrices are row-major with rows = time (or
// samples). No fixed-size Eigen type appears by value in a public header: alignment would make the
// ABI depend on flags.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <type_traits>
#include <vector>

#if EIGEN_MAX_ALIGN_BYTES != 64
#error \
    "compile with -DEIGEN_MAX_ALIGN_BYTES=64, as hri::core and pkg-config give it: libhri frees matrices of yours"
#endif

namespace hri {

template <class T>
using Matrix = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
template <class T>
using Vector = Eigen::Matrix<T, Eigen::Dynamic, 1>;

using MatrixF = Matrix<float>;
using MatrixD = Matrix<double>;
using VectorF = Vector<float>;
using VectorD = Vector<double>;

/// Read-only and writable references to row-major matrices whose rows are contiguous.
using ConstMatrixRefF = Eigen::Ref<const MatrixF>;
using MatrixRefF = Eigen::Ref<MatrixF>;
using ConstMatrixRefD = Eigen::Ref<const MatrixD>;

/// A pointer and a length (C++17 has no std::span). Does not own; T may be const.
template <class T>
class Span {
 public:
  constexpr Span() = default;
  constexpr Span(T* data, std::size_t size) : data_(data), size_(size) {}
  template <
      class U, class A,
      class = std::enable_if_t<std::is_same_v<std::remove_const_t<T>, U> && std::is_const_v<T>>>
  // NOLINTNEXTLINE(google-explicit-constructor): a vector is a span
  Span(const std::vector<U, A>& v) : data_(v.data()), size_(v.size()) {}
  template <class U, class A, class = std::enable_if_t<std::is_same_v<std::remove_const_t<T>, U>>>
  // NOLINTNEXTLINE(google-explicit-constructor)
  Span(std::vector<U, A>& v) : data_(v.data()), size_(v.size()) {}
  template <class U, class = std::enable_if_t<std::is_same_v<const U, T> && !std::is_const_v<U>>>
  constexpr Span(Span<U> other)  // NOLINT(google-explicit-constructor)
      : data_(other.data()), size_(other.size()) {}

  [[nodiscard]] constexpr T* data() const { return data_; }
  [[nodiscard]] constexpr std::size_t size() const { return size_; }
  [[nodiscard]] constexpr bool empty() const { return size_ == 0; }
  constexpr T& operator[](std::size_t i) const { return data_[i]; }
  [[nodiscard]] constexpr T* begin() const { return data_; }
  [[nodiscard]] constexpr T* end() const { return data_ + size_; }
  /// `count` elements from `offset`; the caller keeps offset + count <= size().
  [[nodiscard]] constexpr Span subspan(std::size_t offset, std::size_t count) const {
    return Span(data_ + offset, count);
  }

 private:
  T* data_ = nullptr;
  std::size_t size_ = 0;
};

/// The row `t` of a row-major matrix as a span.
template <class M>
Span<const typename M::Scalar> row_span(const M& m, Eigen::Index t) {
  return {m.data() + t * m.outerStride(), static_cast<std::size_t>(m.cols())};
}

}  // namespace hri
