// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// What Options.fields() gives.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "core/options.hpp"

namespace py = pybind11;

void bind_option_field(py::module_& m) {
  using Field = hri_bind::OptionField;
  py::class_<Field>(m, "OptionField", "What a field of an options class is.")
      .def_readonly("name", &Field::name, "As in C++.")
      .def_readonly("type", &Field::type, "Its type in Python.")
      .def_property_readonly(
          "default", [](const Field& self) { return self.default_value; },
          "As a plain value: a dict for a nested class.")
      .def_readonly("range", &Field::range,
                    "Values that it may hold; empty where the type says so.")
      .def_readonly("unit", &Field::unit, "Empty for a field without one.")
      .def_readonly("description", &Field::description, "What it does.")
      .def_readonly("choices", &Field::choices, "Names that it may hold; empty for other types.")
      .def_property_readonly(
          "options", [](const Field& self) { return self.options; },
          "The class of a nested field, otherwise None.");
}
