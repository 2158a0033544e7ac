// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// What reading and writing of parameter files share.
#pragma once

#include <cstdint>

#include "hri/htk/parameter_kind.hpp"

namespace hri::htk::detail {

constexpr float kLargestInteger = 32767;  ///< of the integers of _C and IREFC
constexpr int kExtraSamples = 4;          ///< that scale and offset of _C count as

inline bool is_of_integers(ParameterKind kind) {
  return kind.base == BaseKind::waveform || kind.base == BaseKind::discrete ||
         kind.base == BaseKind::irefc;
}

/// HTK's checksum of the big-endian 16-bit words behind the header.
class Checksum {
 public:
  void add(std::uint16_t word) { sum_ = (sum_ * 65536 + word) % 36897; }
  [[nodiscard]] std::uint16_t value() const { return static_cast<std::uint16_t>(sum_); }

 private:
  std::uint32_t sum_ = 0;
};

}  // namespace hri::htk::detail
