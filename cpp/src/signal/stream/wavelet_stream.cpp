// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/signal/stream/wavelet_stream.hpp"

#include <algorithm>

#include "hri/core/error.hpp"
#include "signal/dwt_lines.hpp"

namespace hri {
namespace {

constexpr std::size_t kPiece = 512;

}  // namespace

template <class T>
WaveletStream<T>::WaveletStream(const WaveletStreamOptions& options)
    : wavelet_(&wavelet(validated(options).wavelet)) {
  levels_.resize(static_cast<std::size_t>(options.num_levels));
  for (Level& level : levels_) {
    level.waiting.resize(kPiece + 2 * detail::kMaxTaps);
    level.approx.resize(kPiece);
    level.detail.resize(kPiece);
  }
  reset();
}

template <class T>
void WaveletStream<T>::reset() {
  for (Level& level : levels_) {
    // The zeros before the first sample.
    level.num_waiting = wavelet_->dec_lo.size() - 2;
    std::fill(level.waiting.begin(), level.waiting.end(), T(0));
    level.num_taken = 0;
    level.num_given = 0;
  }
}

template <class T>
void WaveletStream<T>::feed(Span<const T> samples, Emit emit, void* sink) {
  for (std::size_t i = 0; i < samples.size(); i += kPiece)
    advance(0, samples.subspan(i, std::min(kPiece, samples.size() - i)), emit, sink);
}

template <class T>
void WaveletStream<T>::advance(std::size_t index, Span<const T> samples, Emit emit, void* sink) {
  Level& level = levels_[index];
  const std::size_t taps = wavelet_->dec_lo.size();
  std::copy(samples.begin(), samples.end(),
            level.waiting.begin() + static_cast<std::ptrdiff_t>(level.num_waiting));
  level.num_waiting += samples.size();
  level.num_taken += samples.size();
  if (level.num_waiting < taps) return;
  const std::size_t count = (level.num_waiting - taps) / 2 + 1;
  detail::analyse_extended(level.waiting.data(), detail::analysis_filters<T>(*wavelet_),
                           static_cast<std::ptrdiff_t>(count), level.approx.data(),
                           level.detail.data());
  const auto used = level.waiting.begin() + static_cast<std::ptrdiff_t>(2 * count);
  std::copy(used, level.waiting.begin() + static_cast<std::ptrdiff_t>(level.num_waiting),
            level.waiting.begin());
  level.num_waiting -= 2 * count;
  level.num_given += count;
  emit(sink, num_levels() - static_cast<int>(index), Span<const T>(level.detail.data(), count));
  const Span<const T> approx(level.approx.data(), count);
  if (index + 1 < levels_.size()) {
    advance(index + 1, approx, emit, sink);
  } else {
    emit(sink, 0, approx);
  }
}

template <class T>
void WaveletStream<T>::flush(Emit emit, void* sink) {
  const T zeros[detail::kMaxTaps] = {};
  const std::size_t taps = wavelet_->dec_lo.size();
  for (std::size_t i = 0; i < levels_.size() && levels_[0].num_taken > 0; ++i) {
    Level& level = levels_[i];
    const std::size_t missing = dwt_length(level.num_taken, taps, Border::zero) - level.num_given;
    const std::size_t needed = 2 * missing + taps - 2;
    if (needed > level.num_waiting)
      advance(i, Span<const T>(zeros, needed - level.num_waiting), emit, sink);
  }
  reset();
}

template class WaveletStream<float>;
template class WaveletStream<double>;

}  // namespace hri
