// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// What an options struct declares about its fields, once. A struct `O` has
//
//   static constexpr const char* kName = "O";
//   template <class Self, class Visitor>
//   static void visit(Self& o, Visitor&& v) {
//     v("frame_ms", o.frame_ms, within(1, 1000), "length of a frame");
//     ...
//   }
//   [[nodiscard]] const char* conflict() const;  // only where fields depend on each other
//
// and validation, model files, Python, its stubs, the command line and the documentation take the
// fields from there. A field of a number or text needs a range; a flag, an enum and a nested struct
// take any_value. Attributes may follow the description: formerly(), older_default().
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "hri/core/error.hpp"
#include "hri/core/export.hpp"

namespace hri {

/// The numbers that a field may hold. NaN lies in no range.
struct HRI_API Range {
  double low;
  double high;
  bool without_low = false;
  bool without_high = false;
  bool with_zero = false;
  bool with_infinity = false;
  int parity = -1;  ///< 0 even, 1 odd, -1 either

  [[nodiscard]] constexpr Range or_zero() const {
    Range r = *this;
    r.with_zero = true;
    return r;
  }
  [[nodiscard]] constexpr Range or_infinity() const {
    Range r = *this;
    r.with_infinity = true;
    return r;
  }
  [[nodiscard]] constexpr Range odd() const {
    Range r = *this;
    r.parity = 1;
    return r;
  }
  [[nodiscard]] constexpr Range even() const {
    Range r = *this;
    r.parity = 0;
    return r;
  }

  [[nodiscard]] bool holds(double value) const;
  [[nodiscard]] std::string text() const;  ///< "1..1000", "above 0, up to 10", "0 or odd, 1..9"
  /// "", or what is wrong with the value, as in "must lie in 1..64, got 0".
  [[nodiscard]] std::string fault(double value) const;
};

constexpr Range within(double low, double high) { return {low, high}; }
/// Greater than `low`.
constexpr Range above(double low, double high) { return {low, high, true}; }
/// Less than `high`.
constexpr Range below(double low, double high) { return {low, high, false, true}; }

/// Of a field whose type says what it may hold: a flag, an enum, a nested struct.
struct AnyValue {};
inline constexpr AnyValue any_value;

/// Of the seed of a random generator: every 64-bit number.
inline constexpr Range any_seed{0, 18446744073709551615.0};

/// The field's name in model files of earlier versions.
struct Formerly {
  const char* name;
};
constexpr Formerly formerly(const char* name) { return {name}; }

/// What a model file without the field means, where today's default is another.
template <class T>
struct OlderDefault {
  T value;
};
template <class T>
constexpr OlderDefault<T> older_default(T value) {
  return {value};
}

// Enums have their names beside them: enum_names(E) gives an array, in the order of the values,
// which count from 0.

template <class E, class = void>
inline constexpr bool has_enum_names = false;
template <class E>
inline constexpr bool has_enum_names<E, std::void_t<decltype(enum_names(E{}))>> = std::is_enum_v<E>;

template <class E>
constexpr bool is_named(E value) {
  return static_cast<std::size_t>(value) < enum_names(E{}).size();
}

/// Throws InvalidArgument for a value that has no name.
template <class E>
const char* enum_name(E value) {
  require(is_named(value), "a value of an enumeration has no name");
  return enum_names(E{})[static_cast<std::size_t>(value)];
}

/// Whether `name` is one of the names; then its value is in `*value`.
template <class E>
constexpr bool parse_enum(std::string_view name, E* value) {
  constexpr auto names = enum_names(E{});
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (name == names[i]) {
      *value = static_cast<E>(i);
      return true;
    }
  }
  return false;
}

/// "'hmm', 'ptbhmm'".
template <class E>
std::string enum_list() {
  std::string list;
  for (const char* name : enum_names(E{}))
    list += (list.empty() ? "'" : ", '") + std::string(name) + "'";
  return list;
}

template <class T, class = void>
inline constexpr bool is_options = false;
template <class T>
inline constexpr bool is_options<T, std::void_t<decltype(T::kName)>> = true;

/// "ms" of "frame_ms"; "" for names that end in no unit.
HRI_API std::string unit_of(std::string_view field);

namespace detail {

template <class T, class = void>
inline constexpr bool has_conflict = false;
template <class T>
inline constexpr bool has_conflict<T, std::void_t<decltype(std::declval<const T&>().conflict())>> =
    true;

/// "", or what is wrong with the value, as in "must lie in 1..64, got 0".
template <class T, class R>
std::string value_fault(const T& value, const R& range) {
  if constexpr (std::is_same_v<T, bool> || is_options<T>) {
    static_assert(std::is_same_v<R, AnyValue>, "flags and nested options take any_value");
    return {};
  } else if constexpr (std::is_enum_v<T>) {
    static_assert(std::is_same_v<R, AnyValue>, "enums take any_value");
    return is_named(value) ? std::string() : "must be one of " + enum_list<T>();
  } else if constexpr (std::is_arithmetic_v<T>) {
    static_assert(std::is_same_v<R, Range>, "a number needs a range");
    return range.fault(static_cast<double>(value));
  } else {
    static_assert(!std::is_same_v<R, AnyValue>, "text needs a range");
    return range.holds(value) ? std::string() : "must be " + range.text() + ", got '" + value + "'";
  }
}

}  // namespace detail

/// "", or what is wrong with the first field that is outside its range, or with fields that do not
/// go together.
template <class O>
std::string options_fault(const O& options) {
  std::string found;
  O::visit(options, [&found](const char* name, const auto& value, const auto& range, const char*,
                             const auto&...) {
    if (!found.empty()) return;
    using T = std::decay_t<decltype(value)>;
    found = detail::value_fault(value, range);
    if (!found.empty()) {
      found = std::string(O::kName) + "." + name + " " + found;
    } else if constexpr (is_options<T>) {
      found = options_fault(value);
    }
  });
  if constexpr (detail::has_conflict<O>) {
    if (found.empty()) {
      if (const char* conflict = options.conflict(); conflict != nullptr)
        found = std::string(O::kName) + ": " + conflict;
    }
  }
  return found;
}

/// Throws InvalidArgument that names the field and its range.
template <class O, class = std::enable_if_t<is_options<O>>>
void validate(const O& options) {
  const std::string found = options_fault(options);
  if (!found.empty()) fail(ErrorKind::invalid_argument, found);
}

/// The options, once validate() has passed them: for the first entry of an initialiser list.
template <class O>
O validated(const O& options) {
  validate(options);
  return options;
}

}  // namespace hri
