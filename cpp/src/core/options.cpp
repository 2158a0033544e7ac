// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/core/options.hpp"

#include <cstdio>

namespace hri {
namespace {

std::string number_text(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0 ? "infinity" : "-infinity";
  char text[32];
  // Whole numbers in full, such as 100000 and not 1e+05.
  if (std::fabs(value) < 1e9 && value == std::floor(value)) {
    std::snprintf(text, sizeof text, "%.0f", value);
  } else {
    std::snprintf(text, sizeof text, "%.6g", value);
  }
  return text;
}

}  // namespace

bool Range::holds(double value) const {
  if (with_zero && value == 0) return true;
  if (with_infinity && std::isinf(value) && value > 0) return true;
  const bool inside =
      (without_low ? value > low : value >= low) && (without_high ? value < high : value <= high);
  // Written so that NaN fails.
  if (!inside) return false;
  return parity < 0 || std::fabs(std::fmod(value, 2)) == parity;
}

std::string Range::text() const {
  if (high == any_seed.high) return "0..2^64 - 1";
  std::string text = number_text(low) + ".." + number_text(high);
  if (parity >= 0) text += parity == 1 ? ", odd" : ", even";
  if (without_low) text += ", " + number_text(low) + " excluded";
  if (without_high) text += ", " + number_text(high) + " excluded";
  if (with_zero) text += ", or 0";
  return with_infinity ? text + ", or infinite" : text;
}

std::string Range::fault(double value) const {
  return holds(value) ? std::string() : "must lie in " + text() + ", got " + number_text(value);
}

std::string unit_of(std::string_view field) {
  struct Unit {
    std::string_view suffix;
    const char* unit;
  };
  static constexpr Unit kUnits[] = {{"_ms", "ms"}, {"_s", "s"},       {"_hz", "Hz"},
                                    {"_db", "dB"}, {"_dbfs", "dBFS"}, {"_px", "px"}};
  for (const Unit& u : kUnits) {
    if (field.size() > u.suffix.size() && field.substr(field.size() - u.suffix.size()) == u.suffix)
      return u.unit;
  }
  return {};
}

}  // namespace hri
