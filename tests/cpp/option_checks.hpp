// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// What holds for every options struct, field by field as its visit() lists them.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <type_traits>
#include <vector>

#include "hri/core/options.hpp"
#include "hri/io/model_file.hpp"
#include "io/option_fields.hpp"

namespace hri_test {

// Calls f(field, range) for the field of this name, where it is a number.
template <class O, class F>
void with_number(O& options, const std::string& wanted, F&& f) {
  O::visit(options, [&](const char* name, auto& field, const auto& range, const auto&...) {
    using T = std::decay_t<decltype(field)>;
    if constexpr (std::is_arithmetic_v<T> && !std::is_same_v<T, bool>) {
      if (wanted == name) f(field, range);
    }
  });
}

template <class T>
std::vector<T> values_outside(const hri::Range& range) {
  std::vector<T> values;
  if constexpr (std::is_floating_point_v<T>) {
    const T infinity = std::numeric_limits<T>::infinity();
    values = {std::numeric_limits<T>::quiet_NaN(), -infinity, static_cast<T>(-1e308),
              static_cast<T>(1e308), std::nextafter(static_cast<T>(range.high), infinity)};
    if (!range.with_infinity) values.push_back(infinity);
    if (!range.with_zero || range.low > 0 || range.low < 0)
      values.push_back(std::nextafter(static_cast<T>(range.low), -infinity));
    if (range.without_low && !(range.with_zero && range.low == 0))
      values.push_back(static_cast<T>(range.low));
    if (range.without_high) values.push_back(static_cast<T>(range.high));
  } else if constexpr (std::is_signed_v<T>) {
    values = {std::numeric_limits<T>::min(), std::numeric_limits<T>::max(),
              static_cast<T>(range.high + 1)};
    if (!(range.with_zero && range.low == 1)) values.push_back(static_cast<T>(range.low - 1));
    if (range.parity >= 0) values.push_back(static_cast<T>(range.low + 1));
  }
  return values;
}

/// Defaults pass; what lies outside a range is refused by the name of struct and field, whatever
/// the other fields hold, and the ends of a range lie in it.
template <class O>
void expect_ranges_hold() {
  const O defaults{};
  EXPECT_EQ(hri::options_fault(defaults), "");
  std::set<std::string> names;
  O::visit(defaults, [&](const char* name, const auto&, const auto&, const char* description,
                         const auto&...) {
    EXPECT_TRUE(names.insert(name).second) << O::kName << "." << name << " stands twice";
    EXPECT_NE(std::string(description), "") << O::kName << "." << name;
  });
  for (const std::string& name : names) {
    const std::string full = std::string(O::kName) + "." + name;
    O options{};
    with_number(options, name, [&](auto& field, const hri::Range& range) {
      using T = std::decay_t<decltype(field)>;
      for (const T value : values_outside<T>(range)) {
        field = value;
        EXPECT_EQ(hri::options_fault(options).rfind(full + " must lie in ", 0), 0U)
            << full << " = " << +value << ": " << hri::options_fault(options);
        EXPECT_THROW(hri::validate(options), hri::InvalidArgument) << full;
      }
      EXPECT_TRUE(range.without_low || range.holds(range.low)) << full;
      EXPECT_TRUE(range.without_high || range.holds(range.high)) << full;
    });
  }
}

/// What a model file gives back is what went in, and a value outside its range is refused by the
/// name of the field.
template <class O>
void expect_model_file_keeps() {
  const O defaults{};
  hri::ModelFile file;
  hri::detail::write_options(defaults, file, "o.");
  O read{};
  hri::detail::read_options(file, &read, "o.");
  hri::ModelFile again;
  hri::detail::write_options(read, again, "o.");
  EXPECT_EQ(file.metadata(), again.metadata());
  O::visit(defaults, [&](const char* name, const auto& field, const auto&...) {
    using T = std::decay_t<decltype(field)>;
    if constexpr (!hri::is_options<T>) {
      EXPECT_EQ(file.metadata().count(std::string("o.") + name), 1U) << O::kName << "." << name;
    }
    if constexpr (std::is_floating_point_v<T>) {
      hri::ModelFile broken = file;
      broken.set_text(std::string("o.") + name, "-1e308");
      O target{};
      EXPECT_THROW(hri::detail::read_options(broken, &target, "o."), hri::FormatError)
          << O::kName << "." << name;
    }
  });
}

}  // namespace hri_test
