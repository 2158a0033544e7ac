// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// The wavelet transform of a signal that arrives in pieces. All coefficients together, after
// finish(), are those of wavedec() with a border of zeros, to the bit.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/options.hpp"
#include "hri/core/types.hpp"
#include "hri/signal/wavelet.hpp"

namespace hri {

struct WaveletStreamOptions {
  std::string wavelet = "db4";
  int num_levels = 3;

  static constexpr const char* kName = "WaveletStreamOptions";
  template <class Self, class Visitor>
  static void visit(Self& o, Visitor&& v) {
    v("wavelet", o.wavelet, WaveletName{}, "wavelet of the transform");
    v("num_levels", o.num_levels, within(1, 30), "levels of the transform");
  }
};

/// T is float or double. After the constructor nothing is allocated, however long the pieces are.
/// Coefficient k of level 1 is final with sample 2 k + 1.
template <class T>
class HRI_API WaveletStream {
 public:
  /// Throws InvalidArgument for options out of range.
  explicit WaveletStream(const WaveletStreamOptions& options);

  /// Calls sink(band, values) with what has become final, each band in its order. Bands are counted
  /// as in wavedec(): 0 the approximation, 1 the coarsest detail, num_levels the finest. The values
  /// live until sink returns; one call of push may call it several times for a band.
  template <class Sink>
  void push(Span<const T> samples, Sink&& sink) {
    auto give = [&sink](int band, Span<const T> values) { sink(band, values); };
    feed(samples, &call<decltype(give)>, &give);
  }
  /// Gives the rest, as if zeros followed, and starts anew.
  template <class Sink>
  void finish(Sink&& sink) {
    auto give = [&sink](int band, Span<const T> values) { sink(band, values); };
    flush(&call<decltype(give)>, &give);
  }
  /// Forgets what was pushed.
  void reset();

  [[nodiscard]] int num_levels() const { return static_cast<int>(levels_.size()); }

 private:
  using Emit = void (*)(void* sink, int band, Span<const T> values);
  struct Level {
    std::vector<T> waiting;  // samples that coming outputs still read
    std::size_t num_waiting = 0;
    std::size_t num_taken = 0;
    std::size_t num_given = 0;
    std::vector<T> approx;
    std::vector<T> detail;
  };

  template <class Give>
  static void call(void* give, int band, Span<const T> values) {
    (*static_cast<Give*>(give))(band, values);
  }
  void feed(Span<const T> samples, Emit emit, void* sink);
  void flush(Emit emit, void* sink);
  // Takes at most kPiece samples into a level and passes its approximation on.
  void advance(std::size_t level, Span<const T> samples, Emit emit, void* sink);

  const Wavelet* wavelet_;
  std::vector<Level> levels_;
};

}  // namespace hri
