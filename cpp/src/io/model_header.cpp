// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "io/model_header.hpp"

#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "hri/core/error.hpp"

namespace hri::detail {
namespace {

using nlohmann::json;

// What both readers do with a value that has no place in their form.
class StrictReader : public nlohmann::json_sax<json> {
 public:
  bool null() override { return misplaced(); }
  bool boolean(bool /*value*/) override { return misplaced(); }
  bool number_integer(number_integer_t /*value*/) override { return misplaced(); }
  bool number_unsigned(number_unsigned_t /*value*/) override { return misplaced(); }
  bool number_float(number_float_t /*value*/, const string_t& /*text*/) override {
    return misplaced();
  }
  bool string(string_t& /*value*/) override { return misplaced(); }
  bool binary(binary_t& /*value*/) override { return misplaced(); }
  bool start_object(std::size_t /*size*/) override { return misplaced(); }
  bool key(string_t& /*value*/) override { return misplaced(); }
  bool end_object() override { return misplaced(); }
  bool start_array(std::size_t /*size*/) override { return misplaced(); }
  bool end_array() override { return misplaced(); }
  bool parse_error(std::size_t /*at*/, const std::string& /*token*/,
                   const json::exception& /*error*/) override {
    return false;
  }

 protected:
  virtual bool misplaced() = 0;
};

// {"__metadata__": {KEY: TEXT, ...}, NAME: {"dtype": TEXT, "shape": [N, N], "data_offsets": [N,
// N]},
// ...}
class HeaderReader : public StrictReader {
 public:
  explicit HeaderReader(const std::string& name) : name_(name) {}
  ModelHeader header;

  bool start_object(std::size_t /*size*/) override {
    if (place_ == Place::before) {
      place_ = Place::top;
    } else if (place_ == Place::top) {
      place_ = key_ == "__metadata__" ? Place::metadata : Place::tensor;
      tensor_ = {};
    } else {
      return misplaced();
    }
    seen_.emplace_back();
    return true;
  }

  bool key(string_t& value) override {
    if (!seen_.back().insert(value).second) reject("header field '" + value + "' stands twice");
    if (place_ == Place::top) tensor_name_ = value;
    key_ = std::move(value);
    return true;
  }

  bool end_object() override {
    if (place_ == Place::tensor) {
      if (seen_.back().size() != 3) return misplaced();
      header.tensors.emplace(tensor_name_, tensor_);
    }
    has_metadata_ = has_metadata_ || place_ == Place::metadata;
    seen_.pop_back();
    place_ = place_ == Place::top ? Place::after : Place::top;
    return true;
  }

  bool string(string_t& value) override {
    if (place_ == Place::metadata) {
      header.metadata.emplace(std::move(key_), std::move(value));
      return true;
    }
    if (place_ != Place::tensor || key_ != "dtype") return misplaced();
    if (value != "F32" && value != "F64")
      reject("tensor '" + tensor_name_ + "': dtype must be F32 or F64");
    tensor_.is_double = value == "F64";
    return true;
  }

  bool start_array(std::size_t /*size*/) override {
    if (place_ != Place::tensor || (key_ != "shape" && key_ != "data_offsets")) return misplaced();
    place_ = Place::list;
    count_ = 0;
    return true;
  }

  bool number_unsigned(number_unsigned_t value) override {
    if (place_ != Place::list || count_ == 2) return misplaced();
    std::uint64_t& first = key_ == "shape" ? tensor_.rows : tensor_.begin;
    std::uint64_t& second = key_ == "shape" ? tensor_.cols : tensor_.end;
    (count_++ == 0 ? first : second) = value;
    return true;
  }

  bool end_array() override {
    if (count_ != 2) return misplaced();
    place_ = Place::tensor;
    return true;
  }

  // To be called at the end.
  void require_whole(bool parsed) const {
    if (!parsed || place_ != Place::after) reject("header is not a JSON object");
    if (!has_metadata_) reject("field '__metadata__' is missing");
  }

 private:
  enum class Place : std::uint8_t { before, top, metadata, tensor, list, after };

  bool misplaced() override {
    const std::string& tensor = tensor_name_;
    switch (place_) {
      case Place::metadata:
        reject("metadata field '" + key_ + "' is not a text");
      case Place::list:
        reject("field '" + tensor + "." + key_ + "' must be two whole numbers");
      case Place::tensor:
        if (key_ == "dtype") reject("tensor '" + tensor + "': dtype must be F32 or F64");
        if (key_ == "shape" || key_ == "data_offsets")
          reject("field '" + tensor + "." + key_ + "' must be two whole numbers");
        [[fallthrough]];
      case Place::top:
        if (key_ == "__metadata__") reject("field '__metadata__' is missing");
        reject("tensor '" + tensor + "' needs dtype, shape and data_offsets, and nothing else");
      default:
        return false;
    }
  }

  [[noreturn]] void reject(const std::string& why) const {
    fail(ErrorKind::format, name_ + ": " + why);
  }

  const std::string& name_;
  Place place_ = Place::before;
  std::vector<std::set<std::string>> seen_;  // the keys of every open object
  std::string key_;
  std::string tensor_name_;
  TensorEntry tensor_;
  int count_ = 0;
  bool has_metadata_ = false;
};

class TextListReader : public StrictReader {
 public:
  std::vector<std::string> texts;

  bool start_array(std::size_t /*size*/) override { return !std::exchange(open_, true); }
  bool string(string_t& value) override {
    if (open_) texts.push_back(std::move(value));
    return open_;
  }
  bool end_array() override { return true; }

 private:
  bool misplaced() override { return false; }

  bool open_ = false;
};

}  // namespace

ModelHeader read_model_header(Span<const std::uint8_t> text, const std::string& name) {
  HeaderReader reader(name);
  reader.require_whole(json::sax_parse(text.begin(), text.end(), &reader));
  return std::move(reader.header);
}

std::optional<std::vector<std::string>> read_text_list(const std::string& text) {
  TextListReader reader;
  if (!json::sax_parse(text, &reader)) return std::nullopt;
  return std::move(reader.texts);
}

}  // namespace hri::detail
