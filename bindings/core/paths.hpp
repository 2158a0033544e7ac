// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Names of files: str, bytes or os.PathLike, in the encoding that Python has for them, so that
// every name which the system allows can be passed.
#pragma once

#include <pybind11/pybind11.h>

#include <string>

#include "hri/core/error.hpp"

namespace hri_bind {

struct Path {
  std::string text;
};

}  // namespace hri_bind

namespace pybind11::detail {

template <>
struct type_caster<hri_bind::Path> {
  PYBIND11_TYPE_CASTER(hri_bind::Path, const_name("str | bytes | os.PathLike[str]"));

  bool load(handle source, bool /*convert*/) {
    auto given = reinterpret_steal<object>(PyOS_FSPath(source.ptr()));
    if (!given) {
      PyErr_Clear();
      return false;
    }
    if (PyUnicode_Check(given.ptr())) {
      given = reinterpret_steal<object>(PyUnicode_EncodeFSDefault(given.ptr()));
      if (!given) {
        PyErr_Clear();
        const auto shown = reinterpret_steal<str>(PyObject_ASCII(source.ptr()));
        hri::fail(hri::ErrorKind::invalid_argument,
                  "the path " + static_cast<std::string>(shown) +
                      " has a character that no file name can hold here");
      }
    }
    value.text = static_cast<std::string>(reinterpret_borrow<bytes>(given));
    return true;
  }
};

}  // namespace pybind11::detail
