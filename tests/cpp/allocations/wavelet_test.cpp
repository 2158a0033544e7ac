// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Transforms into the caller's memory allocate nothing once the thread has done one of that size.
#include <gtest/gtest.h>

#include <vector>

#include "allocations/allocation_counter.hpp"
#include "hri/signal/dwt.hpp"
#include "hri/signal/dwt2.hpp"
#include "hri/signal/stream/wavelet_stream.hpp"

namespace hri {
namespace {

using testing_data::allocations_of;

template <class T>
void expect_signals_without_allocation(Border border) {
  const Wavelet& w = wavelet("db6");
  const std::vector<T> x(3001, T(1));
  std::vector<std::vector<T>> values;
  std::vector<Span<T>> bands;
  std::vector<Span<const T>> inputs;
  for (const std::size_t length : wavedec_lengths(x.size(), w.dec_lo.size(), border, 4))
    values.emplace_back(length);
  for (std::vector<T>& band : values) {
    bands.emplace_back(band);
    inputs.emplace_back(band);
  }
  std::vector<T> back(x.size());
  const auto both = [&] {
    wavedec<T>(x, w, border, Span<const Span<T>>(bands));
    waverec<T>(Span<const Span<const T>>(inputs), w, border, back);
  };
  both();
  EXPECT_EQ(allocations_of(both), 0) << static_cast<int>(border);
}

template <class T>
void expect_pictures_without_allocation(Border border) {
  const Wavelet& w = wavelet("bior4.4");
  const Matrix<T> image = Matrix<T>::Ones(61, 80);
  const Dwt2Shape shape = dwt2_shape(61, 80, w.dec_lo.size(), border);
  Matrix<T> approx(shape.rows, shape.cols);
  Matrix<T> horizontal = approx;
  Matrix<T> vertical = approx;
  Matrix<T> diagonal = approx;
  const auto transform = [&] {
    dwt2<T>(image, w, border, Dwt2Bands<T>{approx, horizontal, vertical, diagonal});
  };
  transform();
  EXPECT_EQ(allocations_of(transform), 0) << static_cast<int>(border);
}

TEST(Wavelets, AllocateNothingTheSecondTime) {
  for (const Border border :
       {Border::symmetric, Border::periodization, Border::smooth, Border::antireflect}) {
    expect_signals_without_allocation<float>(border);
    expect_signals_without_allocation<double>(border);
    expect_pictures_without_allocation<float>(border);
    expect_pictures_without_allocation<double>(border);
  }
}

TEST(WaveletStreams, AllocateNothingAtAll) {
  WaveletStream<float> stream({"db6", 4});
  const std::vector<float> x(5000, 1.0F);
  double sum = 0;
  const auto sink = [&sum](int band, Span<const float> values) {
    for (const float v : values) sum += band * static_cast<double>(v);
  };
  EXPECT_EQ(allocations_of([&] {
              stream.push(x, sink);
              stream.push(Span<const float>(x).subspan(0, 7), sink);
              stream.finish(sink);
            }),
            0);
  EXPECT_NE(sum, 0);
}

}  // namespace
}  // namespace hri
