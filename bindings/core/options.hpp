// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Options structs in Python: keyword constructor that refuses unknown names, attributes, as_dict(),
// repr. Defaults stay in the C++ structs; a nested options field also takes a dict of the fields to
// change.
#pragma once

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

// pybind11's own types are hidden, so what holds them has to be.
#pragma GCC visibility push(hidden)
namespace hri_bind {

namespace py = pybind11;

template <class T>
class OptionsBinder {
 public:
  explicit OptionsBinder(py::class_<T>& cls)
      : cls_(cls), names_(std::make_shared<std::vector<std::string>>()) {
    const auto names = names_;
    cls_.def(py::init([names](const py::kwargs& values) {
      py::object self = py::cast(T{});
      for (const auto& [key, value] : values)
        assign(self, *names, py::cast<std::string>(key), value);
      return py::cast<T>(self);
    }));
    cls_.def("as_dict", [names](const py::object& self) {
      py::dict result;
      for (const std::string& name : *names) {
        const py::object value = self.attr(name.c_str());
        if (py::hasattr(value, "as_dict")) {
          result[name.c_str()] = value.attr("as_dict")();
        } else if (py::hasattr(value, "__members__")) {
          result[name.c_str()] = value.attr("name");
        } else {
          result[name.c_str()] = value;
        }
      }
      return result;
    });
    cls_.def("__repr__", [names](const py::object& self) {
      std::string text = py::cast<std::string>(py::type::of(self).attr("__name__")) + "(";
      for (const std::string& name : *names) {
        text += (text.back() == '(' ? "" : ", ") + name + "=" +
                py::cast<std::string>(py::repr(self.attr(name.c_str())));
      }
      return text + ")";
    });
    cls_.def("__eq__", [](const py::object& self, const py::object& other) {
      return py::type::of(self).is(py::type::of(other)) &&
             self.attr("as_dict")().equal(other.attr("as_dict")());
    });
  }

  template <class Field>
  OptionsBinder& field(const char* name, Field T::*member, const char* doc = "") {
    names_->emplace_back(name);
    cls_.def_readwrite(name, member, doc);
    return *this;
  }

 private:
  // Enums also take their name, nested options also a dict.
  static void assign(const py::object& self, const std::vector<std::string>& names,
                     const std::string& name, const py::handle& value) {
    bool known = false;
    std::string list;
    for (const std::string& n : names) {
      known = known || n == name;
      list += (list.empty() ? "" : ", ") + n;
    }
    const auto type_name = py::cast<std::string>(py::type::of(self).attr("__name__"));
    if (!known) throw py::type_error(type_name + " has no field '" + name + "'; it has: " + list);
    const py::type field_type = py::type::of(self.attr(name.c_str()));
    py::object converted = py::reinterpret_borrow<py::object>(value);
    if (py::isinstance<py::str>(value) && py::hasattr(field_type, "__members__")) {
      const py::dict members = field_type.attr("__members__");
      if (!members.contains(value)) {
        throw py::value_error(type_name + "." + name + " must be one of " +
                              py::cast<std::string>(py::str(py::list(members))) + ", got '" +
                              py::cast<std::string>(value) + "'");
      }
      converted = members[value];
    } else if (py::isinstance<py::dict>(value) && py::hasattr(field_type, "as_dict")) {
      // Fields that the dict leaves out stay as they are: the outer struct may set them its own
      // way.
      const py::dict fields = self.attr(name.c_str()).attr("as_dict")();
      fields.attr("update")(value);
      converted = field_type(**fields);
    }
    try {
      self.attr(name.c_str()) = converted;
    } catch (py::error_already_set&) {
      throw py::type_error(type_name + "." + name + " cannot be " +
                           py::cast<std::string>(py::repr(value)));
    }
  }

  py::class_<T>& cls_;
  std::shared_ptr<std::vector<std::string>> names_;
};

template <class T>
OptionsBinder<T> options(py::class_<T>& cls) {
  return OptionsBinder<T>(cls);
}

}  // namespace hri_bind
#pragma GCC visibility pop
