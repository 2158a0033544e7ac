// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/io/model_file.hpp"

#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <iomanip>
#include <locale>
#include <nlohmann/json.hpp>
#include <sstream>

#include "hri/core/error.hpp"
#include "hri/io/crc32.hpp"
#include "hri/io/file.hpp"
#include "io/model_header.hpp"

namespace hri {
namespace {

constexpr const char* kVersionKey = "format_version";
constexpr const char* kChecksumKey = "checksum";

// "" or what is wrong with the values. A comparison that NaN fails.
template <class M>
std::string values_fault(const M& values) {
  constexpr double kLargest = sizeof(typename M::Scalar) == sizeof(float)
                                  ? ModelFile::kLargestFloat
                                  : ModelFile::kLargestNumber;
  const auto largest = static_cast<typename M::Scalar>(kLargest);
  if ((values.array().abs() <= largest).all()) return {};
  if (!values.allFinite()) return "holds a value that is not finite";
  return std::string("holds a value beyond ") +
         (sizeof(largest) == sizeof(float) ? "1e15" : "1e30");
}

template <class T>
Matrix<T> from_bytes(const std::vector<std::uint8_t>& bytes, std::int64_t rows, std::int64_t cols) {
  Matrix<T> m(rows, cols);
  if (!bytes.empty()) std::memcpy(m.data(), bytes.data(), bytes.size());
  return m;
}

template <class M>
std::vector<std::uint8_t> to_bytes(const std::string& name, const M& values) {
  using T = typename M::Scalar;
  const Matrix<T> dense = values;
  // Refused here, where the model still exists, and not when its file is read.
  if (const std::string wrong = values_fault(dense); !wrong.empty())
    fail(ErrorKind::invalid_argument, "field '" + name + "' " + wrong);
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(dense.size()) * sizeof(T));
  if (!bytes.empty()) std::memcpy(bytes.data(), dense.data(), bytes.size());
  return bytes;
}

// JSON knows no other text; what is not UTF-8 does not come back from it as it went in.
void require_utf8(const std::string& field, const std::string& text) {
  const nlohmann::json json = text;
  if (nlohmann::json::parse(json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)) !=
      json)
    fail(ErrorKind::invalid_argument, "field '" + field + "' holds text that is not UTF-8");
}

std::string quoted(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string hex(std::uint32_t value) {
  char text[9];
  std::snprintf(text, sizeof text, "%08x", static_cast<unsigned>(value));
  return text;
}

}  // namespace

void ModelFile::refuse(const std::string& field, const std::string& why) const {
  fail(ErrorKind::format, name_ + ": field '" + field + "' " + why);
}

bool ModelFile::has(const std::string& name) const {
  return tensors_.count(name) != 0 || metadata_.count(name) != 0;
}

std::map<std::string, std::pair<std::int64_t, std::int64_t>> ModelFile::tensor_shapes() const {
  std::map<std::string, std::pair<std::int64_t, std::int64_t>> shapes;
  for (const auto& [name, t] : tensors_) shapes[name] = {t.rows, t.cols};
  return shapes;
}

const std::string& ModelFile::text(const std::string& key) const {
  const auto found = metadata_.find(key);
  if (found == metadata_.end()) refuse(key, "is missing");
  read_.insert(key);
  return found->second;
}

std::int64_t ModelFile::integer(const std::string& key) const {
  const std::string& value = text(key);
  const char* const end = value.data() + value.size();
  std::int64_t parsed = 0;
  const auto [stopped, error] = std::from_chars(value.data(), end, parsed);
  if (error != std::errc() || stopped != end) refuse(key, "is not an integer: '" + value + "'");
  return parsed;
}

double ModelFile::number(const std::string& key) const {
  const std::string& value = text(key);
  std::istringstream in(value);
  in.imbue(std::locale::classic());      // a program may have set a locale with decimal commas
  in.exceptions(std::ios_base::badbit);  // else a lack of memory would look like a bad number
  double parsed = 0;
  in >> std::noskipws;
  if (!(in >> parsed) || in.peek() != std::istringstream::traits_type::eof() ||
      !std::isfinite(parsed))
    refuse(key, "is not a finite number: '" + value + "'");
  if (std::fabs(parsed) > kLargestNumber) refuse(key, "is beyond 1e30: " + value);
  return parsed;
}

std::vector<std::string> ModelFile::text_list(const std::string& key) const {
  auto values = detail::read_text_list(text(key));
  if (!values) refuse(key, "is not a list of texts");
  return *std::move(values);
}

void ModelFile::require_all_read() const {
  const auto check = [this](const std::string& name) {
    if (read_.count(name) == 0) refuse(name, "is unknown to this library");
  };
  for (const auto& entry : metadata_) check(entry.first);
  for (const auto& entry : tensors_) check(entry.first);
}

void ModelFile::set_text(const std::string& key, const std::string& value) {
  require_utf8(key, value);
  metadata_[key] = value;
}

void ModelFile::set_integer(const std::string& key, std::int64_t value) {
  metadata_[key] = std::to_string(value);
}

void ModelFile::set_number(const std::string& key, double value) {
  if (!std::isfinite(value)) fail(ErrorKind::invalid_argument, "field '" + key + "' is not finite");
  if (std::fabs(value) > kLargestNumber)
    fail(ErrorKind::invalid_argument, "field '" + key + "' is beyond 1e30");
  std::ostringstream out;
  out.exceptions(std::ios_base::badbit);
  out.imbue(std::locale::classic());
  out << std::setprecision(17) << value;
  metadata_[key] = out.str();
}

void ModelFile::set_text_list(const std::string& key, const std::vector<std::string>& values) {
  for (const std::string& value : values) require_utf8(key, value);
  std::string list;
  for (const std::string& value : values) list += (list.empty() ? "" : ",") + quoted(value);
  metadata_[key] = "[" + list + "]";
}

const ModelFile::Tensor& ModelFile::tensor(const std::string& name, bool is_double) const {
  const auto found = tensors_.find(name);
  if (found == tensors_.end()) refuse(name, "is missing");
  read_.insert(name);
  if (found->second.is_double != is_double)
    refuse(name, is_double ? "is not of dtype F64" : "is not of dtype F32");
  return found->second;
}

MatrixD ModelFile::matrix_d(const std::string& name) const {
  const Tensor& t = tensor(name, true);
  MatrixD m = from_bytes<double>(t.bytes, t.rows, t.cols);
  if (const std::string wrong = values_fault(m); !wrong.empty()) refuse(name, wrong);
  return m;
}

MatrixF ModelFile::matrix_f(const std::string& name) const {
  const Tensor& t = tensor(name, false);
  MatrixF m = from_bytes<float>(t.bytes, t.rows, t.cols);
  if (const std::string wrong = values_fault(m); !wrong.empty()) refuse(name, wrong);
  return m;
}

VectorD ModelFile::vector_d(const std::string& name) const {
  const MatrixD m = matrix_d(name);
  if (m.rows() != 1) refuse(name, "is not a vector");
  return m.row(0);
}

VectorF ModelFile::vector_f(const std::string& name) const {
  const MatrixF m = matrix_f(name);
  if (m.rows() != 1) refuse(name, "is not a vector");
  return m.row(0);
}

void ModelFile::set_matrix(const std::string& name, ConstMatrixRefD values) {
  tensors_[name] = {true, values.rows(), values.cols(), to_bytes(name, values)};
}

void ModelFile::set_matrix(const std::string& name, ConstMatrixRefF values) {
  tensors_[name] = {false, values.rows(), values.cols(), to_bytes(name, values)};
}

void ModelFile::set_vector(const std::string& name, const VectorD& values) {
  tensors_[name] = {true, 1, values.size(), to_bytes(name, values)};
}

void ModelFile::set_vector(const std::string& name, const VectorF& values) {
  tensors_[name] = {false, 1, values.size(), to_bytes(name, values)};
}

std::uint32_t ModelFile::checksum() const {
  const auto add = [](const std::string& s, std::uint32_t crc) {
    // The terminating zero goes in too, so that ("ab", "c") and ("a", "bc") differ.
    return crc32({reinterpret_cast<const std::uint8_t*>(s.c_str()), s.size() + 1}, crc);
  };
  std::uint32_t crc = 0;
  for (const auto& [name, t] : tensors_) {
    crc = add(name, crc);
    crc = add(t.is_double ? "F64" : "F32", crc);
    crc = add(std::to_string(t.rows) + " " + std::to_string(t.cols), crc);
    crc = crc32(t.bytes, crc);
  }
  for (const auto& [key, value] : metadata_) {
    if (key != kChecksumKey) crc = add(value, add(key, crc));
  }
  return crc;
}

std::vector<std::uint8_t> ModelFile::serialise() const {
  ModelFile stamped = *this;
  stamped.set_integer(kVersionKey, version_);
  stamped.metadata_.erase(kChecksumKey);
  stamped.set_text(kChecksumKey, hex(stamped.checksum()));

  // Written piece by piece: nested values of the JSON library end the program when memory does.
  std::map<std::string, std::string> fields;
  std::string& metadata = fields["__metadata__"];
  for (const auto& [key, value] : stamped.metadata_)
    metadata += (metadata.empty() ? "{" : ",") + quoted(key) + ":" + quoted(value);
  metadata += '}';
  std::uint64_t offset = 0;
  for (const auto& [name, t] : tensors_) {
    fields[name] = "{\"data_offsets\":[" + std::to_string(offset) + "," +
                   std::to_string(offset + t.bytes.size()) + "],\"dtype\":\"" +
                   (t.is_double ? "F64" : "F32") + "\",\"shape\":[" + std::to_string(t.rows) + "," +
                   std::to_string(t.cols) + "]}";
    offset += t.bytes.size();
  }
  std::string text;
  for (const auto& [name, value] : fields)
    text += (text.empty() ? "{" : ",") + quoted(name) + ":" + value;
  text += '}';
  text.append((8 - text.size() % 8) % 8,
              ' ');  // tensors start on a multiple of 8, as the layout asks

  require(text.size() <= detail::kMaxHeaderBytes, "the names and texts of a model take too much");

  std::vector<std::uint8_t> out;
  out.reserve(8 + text.size() + offset);
  for (unsigned i = 0; i < 8; ++i)
    out.push_back(static_cast<std::uint8_t>((std::uint64_t{text.size()} >> (8 * i)) & 0xFFU));
  out.insert(out.end(), text.begin(), text.end());
  for (const auto& entry : tensors_)
    out.insert(out.end(), entry.second.bytes.begin(), entry.second.bytes.end());
  return out;
}

void ModelFile::write(const std::string& path) const { write_file_atomically(path, serialise()); }

ModelFile ModelFile::read(const std::string& path) { return parse(read_file(path), path); }

}  // namespace hri
