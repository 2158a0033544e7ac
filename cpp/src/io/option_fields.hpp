// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Options structs to and from the metadata of a model file, field by field as their visit() lists
// them. Fields of nested structs are called "outer.inner"; enums are kept by name.
#pragma once

#include <cstdint>
#include <string>
#include <type_traits>
#include <utility>

#include "hri/core/error.hpp"
#include "hri/core/options.hpp"
#include "hri/io/model_file.hpp"

namespace hri::detail {

/// Files of version 1 hold the number of the value.
template <class E>
E read_enum(const ModelFile& file, const std::string& key) {
  E value{};
  if (parse_enum(file.text(key), &value)) return value;
  const std::string refused = file.name() + ": field '" + key + "' must be one of " +
                              enum_list<E>() + ", got '" + file.text(key) + "'";
  if (file.version() > 1) fail(ErrorKind::format, refused);
  const std::int64_t number = file.integer(key);
  if (number < 0 || number >= static_cast<std::int64_t>(enum_names(E{}).size()))
    fail(ErrorKind::format, refused);
  return static_cast<E>(number);
}

template <class E>
void write_enum(E value, ModelFile& file, const std::string& key) {
  file.set_text(key, enum_name(value));
}

template <class O>
void write_options(const O& options, ModelFile& file, const std::string& prefix = "") {
  O::visit(options, [&](const char* name, const auto& value, const auto&...) {
    using T = std::decay_t<decltype(value)>;
    const std::string key = prefix + name;
    if constexpr (is_options<T>) {
      write_options(value, file, key + ".");
    } else if constexpr (std::is_enum_v<T>) {
      write_enum(value, file, key);
    } else if constexpr (std::is_same_v<T, std::string>) {
      file.set_text(key, value);
    } else if constexpr (std::is_floating_point_v<T>) {
      file.set_number(key, static_cast<double>(value));
    } else {
      file.set_integer(key, static_cast<std::int64_t>(value));
    }
  });
}

template <class T>
T read_field(const ModelFile& file, const std::string& key) {
  if constexpr (std::is_enum_v<T>) {
    return read_enum<T>(file, key);
  } else if constexpr (std::is_same_v<T, std::string>) {
    return file.text(key);
  } else if constexpr (std::is_floating_point_v<T>) {
    return static_cast<T>(file.number(key));
  } else {
    const std::int64_t number = file.integer(key);
    const T value = static_cast<T>(number);
    if (static_cast<std::int64_t>(value) != number) {
      fail(ErrorKind::format,
           file.name() + ": field '" + key + "' is out of range: " + std::to_string(number));
    }
    return value;
  }
}

/// The key that holds a field: its own, or one of its former ones.
class FieldKey {
 public:
  FieldKey(const ModelFile& file, std::string key)
      : file_(file), key_(std::move(key)), found_(file.has(key_)) {}

  void try_former(const std::string& key) {
    if (found_ || !file_.has(key)) return;
    key_ = key;
    found_ = true;
  }
  void consider(const std::string& prefix, const Formerly& former) {
    try_former(prefix + former.name);
  }
  template <class T>
  void consider(const std::string& /*prefix*/, const OlderDefault<T>& /*older*/) {}

  [[nodiscard]] bool found() const { return found_; }
  [[nodiscard]] const std::string& key() const { return key_; }

 private:
  const ModelFile& file_;
  std::string key_;
  bool found_;
};

template <class T>
void take_older_default(const Formerly& /*former*/, T* /*value*/) {}
template <class T, class D>
void take_older_default(const OlderDefault<D>& older, T* value) {
  *value = older.value;
}

/// Reads every field; one that the file lacks takes what older files meant. `former_group` is where
/// version 1 kept fields that have no group today, as in "models.". Throws FormatError that names
/// the file and the field.
template <class O>
void read_options(const ModelFile& file, O* options, const std::string& prefix = "",
                  const std::string& former_group = "") {
  O::visit(*options, [&](const char* name, auto& value, const auto& range, const char*,
                         const auto&... attributes) {
    using T = std::decay_t<decltype(value)>;
    if constexpr (is_options<T>) {
      read_options(file, &value, prefix + name + ".");
    } else {
      FieldKey field(file, prefix + name);
      if (!former_group.empty()) field.try_former(former_group + name);
      (field.consider(prefix, attributes), ...);
      if (!field.found()) {
        (take_older_default(attributes, &value), ...);
        return;
      }
      value = read_field<T>(file, field.key());
      if (const std::string wrong = value_fault(value, range); !wrong.empty())
        fail(ErrorKind::format, file.name() + ": field '" + field.key() + "' " + wrong);
    }
  });
  if constexpr (has_conflict<O>) {
    if (const char* conflict = options->conflict(); conflict != nullptr)
      fail(ErrorKind::format, file.name() + ": " + prefix + conflict);
  }
}

}  // namespace hri::detail
