// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Enums in Python are the names that stand beside them in C++ (enum_names): text, typed as a
// Literal. Include this in every file whose bindings take or give an enum.
#pragma once

#include <pybind11/pybind11.h>

#include <cstddef>
#include <string>
#include <type_traits>

#include "hri/core/options.hpp"

// pybind11's own types are hidden, so what holds them has to be.
#pragma GCC visibility push(hidden)
namespace pybind11::detail {

#if PYBIND11_VERSION_HEX >= 0x03000000
// pybind11's own conversion of enums gives way.
template <class E>
struct type_caster_enum_type_enabled<E, std::enable_if_t<hri::has_enum_names<E>>>
    : std::false_type {};
#endif

constexpr std::size_t text_length(const char* text) {
  std::size_t length = 0;
  while (text[length] != '\0') ++length;
  return length;
}

// "typing.Literal['hmm', 'ptbhmm']".
template <class E>
constexpr auto literal_of() {
  constexpr auto names = enum_names(E{});
  constexpr char kOpen[] = "typing.Literal[";
  constexpr std::size_t kSize = [&] {
    std::size_t size = text_length(kOpen) + 1;
    for (std::size_t i = 0; i < names.size(); ++i) size += text_length(names[i]) + (i == 0 ? 2 : 4);
    return size;
  }();
  descr<kSize> result;
  std::size_t at = 0;
  const auto add = [&result, &at](const char* text) {
    for (std::size_t i = 0; text[i] != '\0'; ++i) result.text[at++] = text[i];
  };
  add(kOpen);
  for (std::size_t i = 0; i < names.size(); ++i) {
    add(i == 0 ? "'" : ", '");
    add(names[i]);
    add("'");
  }
  add("]");
  return result;
}

template <class E>
struct type_caster<E, std::enable_if_t<hri::has_enum_names<E>>> {
  PYBIND11_TYPE_CASTER(E, literal_of<E>());

  bool load(handle source, bool /*convert*/) {
    if (!isinstance<str>(source)) return false;
    const auto text = pybind11::cast<std::string>(source);
    if (!hri::parse_enum(text, &value)) {
      hri::fail(hri::ErrorKind::invalid_argument,
                "must be one of " + hri::enum_list<E>() + ", got '" + text + "'");
    }
    return true;
  }
  static handle cast(E source, return_value_policy /*policy*/, handle /*parent*/) {
    return str(hri::enum_name(source)).release();
  }
};

}  // namespace pybind11::detail
#pragma GCC visibility pop
