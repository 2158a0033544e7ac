// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Options structs in Python, from their visit(): a constructor of typed keywords, attributes,
// as_dict(), fields(), a repr of what differs from the defaults, equality, copies and pickles. An
// object is checked when it is made and whenever a field is set. A nested struct also takes a dict
// of the fields to change.
#pragma once

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cmath>
#include <cstring>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/enums.hpp"
#include "hri/core/options.hpp"

// pybind11's own types are hidden, so what holds them has to be.
#pragma GCC visibility push(hidden)
namespace hri_bind {

namespace py = pybind11;

/// What a field is, as Options.fields() gives it.
struct OptionField {
  std::string name;
  std::string type;
  py::object default_value;
  std::string range;
  std::string unit;
  std::string description;
  std::vector<std::string> choices;
  py::object options;  ///< class of a nested struct, or None
};

inline std::string text_of(py::handle object) { return py::cast<std::string>(py::str(object)); }
inline std::string repr_of(py::handle object) { return py::cast<std::string>(py::repr(object)); }

template <class O>
const O& defaults() {
  static const O options{};
  return options;
}

// Calls f(field) for the field of this name. The type comes first, so that f need not fit others.
template <class Field, class O, class F>
void with_field(O& options, const char* wanted, F&& f) {
  O::visit(options, [&](const char* name, auto& field, const auto&...) {
    if constexpr (std::is_same_v<std::decay_t<decltype(field)>, Field>) {
      if (std::strcmp(name, wanted) == 0) f(field);
    }
  });
}

template <class O>
py::dict as_dict(const O& options);

template <class Field>
py::object to_object(const Field& field) {
  if constexpr (hri::is_options<Field>) {
    return as_dict(field);
  } else {
    return py::cast(field);
  }
}

template <class O>
py::dict as_dict(const O& options) {
  py::dict result;
  O::visit(options, [&](const char* name, const auto& field, const auto&...) {
    result[name] = to_object(field);
  });
  return result;
}

// The fields in which `options` differs from `base`.
template <class O>
py::dict differences(const O& options, const O& base) {
  py::dict result;
  O::visit(options, [&](const char* name, const auto& field, const auto&...) {
    using Field = std::decay_t<decltype(field)>;
    with_field<Field>(base, name, [&](const Field& other) {
      if constexpr (hri::is_options<Field>) {
        py::dict inner = differences(field, other);
        if (!inner.empty()) result[name] = std::move(inner);
      } else if (field != other) {
        result[name] = to_object(field);
      }
    });
  });
  return result;
}

template <class O>
[[noreturn]] void refuse_name(const std::string& name) {
  py::list names;
  std::string group;
  O::visit(defaults<O>(), [&](const char* own, const auto& field, const auto&...) {
    using Field = std::decay_t<decltype(field)>;
    names.append(own);
    if constexpr (hri::is_options<Field>) {
      Field::visit(field, [&](const char* inner, const auto&...) {
        if (group.empty() && name == inner) group = own;
      });
    }
  });
  std::string message = std::string(O::kName) + " has no field '" + name + "'";
  const py::list close = py::module_::import("difflib").attr("get_close_matches")(name, names, 1);
  if (!group.empty()) {
    message += "; it is a field of " + group + ": " + group + "={'" + name + "': ...}.";
  } else {
    message += close.empty() ? "." : "; did you mean '" + text_of(close[0]) + "'?";
  }
  throw py::type_error(message + " Its fields are " + text_of(py::str(", ").attr("join")(names)));
}

template <class O>
void assign_all(O* options, const py::dict& values);

template <class O, class Field, class Range>
void assign(const char* name, Field* field, const Range& range, py::handle value) {
  const std::string what = std::string(O::kName) + "." + name;
  const auto must_be = [&](const std::string& kind) -> void {
    throw py::type_error(what + " must be " + kind + ", got " + repr_of(value));
  };
  if constexpr (hri::is_options<Field>) {
    if (py::isinstance<Field>(value)) {
      *field = py::cast<Field>(value);
    } else if (py::hasattr(value, "keys")) {
      // Fields that the dict leaves out stay: the outer struct may have set them its own way.
      assign_all(field, py::dict(py::reinterpret_borrow<py::object>(value)));
    } else {
      must_be(std::string(Field::kName) + " or a dict of its fields");
    }
  } else if constexpr (std::is_enum_v<Field>) {
    if (!py::isinstance<py::str>(value)) must_be("one of " + hri::enum_list<Field>());
    if (!hri::parse_enum(text_of(value), field)) {
      hri::fail(hri::ErrorKind::invalid_argument,
                what + " must be one of " + hri::enum_list<Field>() + ", got " + repr_of(value));
    }
  } else if constexpr (std::is_same_v<Field, std::string>) {
    if (!py::isinstance<py::str>(value)) must_be("text");
    *field = text_of(value);
  } else if constexpr (std::is_same_v<Field, bool>) {
    py::detail::make_caster<bool> caster;
    if (!caster.load(value, false)) must_be("True or False");
    *field = py::detail::cast_op<bool>(caster);
  } else {
    constexpr bool kWhole = std::is_integral_v<Field>;
    py::detail::make_caster<Field> caster;
    if (!py::isinstance<py::bool_>(value) && caster.load(value, true)) {
      *field = py::detail::cast_op<Field>(caster);
    } else if (py::isinstance<py::int_>(value) && !py::isinstance<py::bool_>(value)) {
      hri::fail(hri::ErrorKind::invalid_argument,
                what + " must lie in " + range.text() + ", got " + text_of(value));
    } else {
      must_be(kWhole ? "a whole number" : "a number");
    }
  }
}

template <class O>
void assign_all(O* options, const py::dict& values) {
  for (const auto& [key, value] : values) {
    const auto wanted = py::cast<std::string>(key);
    bool known = false;
    const py::handle given = value;
    O::visit(*options, [&](const char* name, auto& field, const auto& range, const auto&...) {
      if (wanted != name) return;
      known = true;
      assign<O>(name, &field, range, given);
    });
    if (!known) refuse_name<O>(wanted);
  }
}

template <class O>
O from_dict(const py::dict& values) {
  O options;
  assign_all(&options, values);
  hri::validate(options);
  return options;
}

template <class Field>
std::string type_name() {
  if constexpr (hri::is_options<Field>) {
    const py::type type = py::type::of<Field>();
    return text_of(type.attr("__module__")) + "." + text_of(type.attr("__qualname__"));
  } else if constexpr (std::is_enum_v<Field>) {
    return "typing.Literal[" + hri::enum_list<Field>() + "]";
  } else if constexpr (std::is_same_v<Field, std::string>) {
    return "str";
  } else if constexpr (std::is_same_v<Field, bool>) {
    return "bool";
  } else {
    return std::is_integral_v<Field> ? "int" : "float";
  }
}

template <class Field, class Range>
std::string range_text(const Range& range) {
  if constexpr (std::is_same_v<Range, hri::AnyValue>) {
    return {};
  } else {
    return range.text();
  }
}

template <class O>
std::vector<OptionField> option_fields() {
  std::vector<OptionField> fields;
  O::visit(defaults<O>(), [&](const char* name, const auto& value, const auto& range,
                              const char* description, const auto&...) {
    using Field = std::decay_t<decltype(value)>;
    OptionField f;
    f.name = name;
    f.type = type_name<Field>();
    f.default_value = to_object(value);
    f.range = range_text<Field>(range);
    f.unit = hri::unit_of(name);
    f.description = description;
    f.options = py::none();
    if constexpr (hri::is_options<Field>) {
      f.options = py::type::of<Field>();
    } else if constexpr (std::is_enum_v<Field>) {
      for (const char* choice : enum_names(Field{})) f.choices.emplace_back(choice);
    }
    fields.push_back(std::move(f));
  });
  return fields;
}

// One line that type checkers read, then nothing: the class lists the fields.
template <class O>
std::string constructor_doc(const std::string& module) {
  std::string text = "__init__(self: " + module + "." + O::kName + ", *";
  O::visit(defaults<O>(), [&](const char* name, const auto& value, const auto&...) {
    using Field = std::decay_t<decltype(value)>;
    text += std::string(", ") + name + ": " + type_name<Field>();
    if constexpr (hri::is_options<Field>) {
      text += " | collections.abc.Mapping[str, typing.Any] = ...";
    } else {
      const std::string shown = repr_of(to_object(value));
      text += " = " + (shown == "inf" ? "..." : shown);
    }
  });
  return text + ") -> None\n";
}

template <class O>
std::string class_doc(const char* doc) {
  std::string text = std::string(doc) + "\n\nParameters\n----------\n";
  for (const OptionField& f : option_fields<O>()) {
    text += f.name + " : ";
    if (!f.options.is_none()) {
      text += text_of(f.options.attr("__name__")) + " or dict";
    } else {
      text += f.choices.empty() ? f.type : "{";
      for (std::size_t i = 0; i < f.choices.size(); ++i)
        text += (i == 0 ? "'" : ", '") + f.choices[i] + (i + 1 == f.choices.size() ? "'}" : "'");
      text += ", default " + repr_of(f.default_value);
    }
    text += "\n    " + f.description + (f.range.empty() ? "" : "; " + f.range) +
            (f.range.empty() || f.unit.empty() ? "" : " " + f.unit) + "\n";
  }
  return text;
}

/// The class of an options struct; classes of structs nested in it have to be bound before.
template <class O>
py::class_<O> bind_options(py::handle scope, const char* doc) {
  py::class_<O> cls(scope, O::kName, class_doc<O>(doc).c_str());
  {
    py::options plain;
    plain.disable_function_signatures();
    cls.def(py::init([](const py::kwargs& values) { return from_dict<O>(values); }),
            constructor_doc<O>(text_of(scope.attr("__name__"))).c_str());
  }
  O::visit(defaults<O>(), [&](const char* name, const auto& value, const auto& range,
                              const char* description, const auto&...) {
    using Field = std::decay_t<decltype(value)>;
    const auto get = [name](O& self) -> const Field& {
      const Field* found = nullptr;
      with_field<Field>(self, name, [&](const Field& field) { found = &field; });
      return *found;
    };
    const auto set = [name, range](O& self, const py::object& given) {
      O changed = self;
      with_field<Field>(changed, name,
                        [&](Field& field) { assign<O>(name, &field, range, given); });
      hri::validate(changed);
      self = std::move(changed);
    };
    cls.def_property(name, get, set, description);
  });
  cls.def("as_dict", &as_dict<O>, "All fields as plain values, those of nested structs as dicts.");
  cls.def_static("fields", &option_fields<O>, "What each field is, in their order.");
  cls.def("__repr__", [](const O& self) {
    std::string text = std::string(O::kName) + "(";
    for (const auto& [name, value] : differences(self, defaults<O>()))
      text += (text.back() == '(' ? "" : ", ") + text_of(name) + "=" + repr_of(value);
    return text + ")";
  });
  cls.def("__eq__", [](const O& self, const py::object& other) {
    return py::isinstance<O>(other) && differences(self, py::cast<const O&>(other)).empty();
  });
  cls.def(py::pickle(&as_dict<O>, &from_dict<O>));
  return cls;
}

}  // namespace hri_bind
#pragma GCC visibility pop
