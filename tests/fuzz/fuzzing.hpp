// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// What the fuzz targets share: numbers drawn from the input, and the rule that only hri::Error may
// come out of the library.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <limits>
#include <string>
#include <type_traits>

#include "hri/core/error.hpp"
#include "hri/core/options.hpp"
#include "hri/recognition/decision.hpp"

namespace hri::fuzzing {

/// Takes bytes from the front of the input; zeros when it has ended.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}

  std::uint8_t byte() { return at_ < size_ ? data_[at_++] : std::uint8_t{0}; }
  [[nodiscard]] bool ended() const { return at_ >= size_; }

  template <class T>
  T raw() {
    T value{};
    auto* out = reinterpret_cast<std::uint8_t*>(&value);
    for (std::size_t i = 0; i < sizeof(T); ++i) out[i] = byte();
    return value;
  }

  int below(int n) { return n <= 0 ? 0 : static_cast<int>(raw<std::uint16_t>() % n); }

  /// Often one at which code breaks.
  double number(double low, double high) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    const double odd[] = {0,
                          -0.0,
                          1,
                          -1,
                          low,
                          high,
                          std::nextafter(low, -kInfinity),
                          std::nextafter(high, kInfinity),
                          1e15,
                          -1e15,
                          1e300,
                          -1e300,
                          1e-300,
                          std::numeric_limits<double>::quiet_NaN(),
                          kInfinity,
                          -kInfinity};
    const int kind = byte();
    if (kind < 16) return odd[kind];
    if (kind < 40) return raw<double>();
    return low + (high - low) * raw<std::uint16_t>() / 65535.0;
  }

 private:
  const std::uint8_t* data_;
  std::size_t size_;
  std::size_t at_ = 0;
};

/// Draws every field of an options struct that visit() lists, in its range and beyond; a field is
/// left as it is as often as not.
template <class O>
void draw_options(Bytes& bytes, O* options) {
  O::visit(*options, [&](const char*, auto& value, const auto& range, const char*, const auto&...) {
    using T = std::decay_t<decltype(value)>;
    if constexpr (is_options<T>) {
      draw_options(bytes, &value);
    } else if ((bytes.byte() & 1) != 0) {
      if constexpr (std::is_same_v<T, bool>) {
        value = (bytes.byte() & 1) != 0;
      } else if constexpr (std::is_enum_v<T>) {
        value = static_cast<T>(bytes.below(static_cast<int>(enum_names(T{}).size()) + 1));
      } else if constexpr (std::is_floating_point_v<T>) {
        value = static_cast<T>(bytes.number(range.low, range.high));
      } else if constexpr (std::is_integral_v<T>) {
        const double drawn = bytes.number(range.low, range.high);
        const bool fits = drawn > static_cast<double>(std::numeric_limits<T>::lowest()) &&
                          drawn < static_cast<double>(std::numeric_limits<T>::max());
        value = fits ? static_cast<T>(drawn) : std::numeric_limits<T>::lowest();
      } else {
        value =
            std::string(static_cast<std::size_t>(bytes.below(12)), static_cast<char>(bytes.byte()));
      }
    }
  });
}

/// Ends the program, as a crash does, where a decision that is no number claims to be one.
inline void check(const Decision& decision) {
  bool sound = std::isfinite(decision.confidence) && decision.confidence >= 0 &&
               decision.confidence <= 1.001F;
  for (const NBest& entry : decision.nbest) sound = sound && std::isfinite(entry.probability);
  if (decision.status == DecisionStatus::recognised) sound = sound && !std::isnan(decision.score);
  if (sound) return;
  std::cerr << "a decision without numbers: " << decision.label << "\n";
  std::abort();
}

/// Runs `action`; errors of the library are what it should give, others are findings.
template <class F>
void expect_typed_errors(const F& action) {
  try {
    action();
  } catch (const Error&) {  // as it should be
  }
}

}  // namespace hri::fuzzing
