// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Model files in the safetensors layout: 8-byte little-endian header length, a JSON header that
// names every tensor (dtype, shape, byte range) and holds text metadata, then the tensor bytes. The
// format has its own version (newer files are refused) and a CRC-32 of the tensors (name, dtype,
// shape, bytes) and the metadata.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/types.hpp"

namespace hri {

/// A named set of matrices and metadata. Getters throw FormatError that names the file and the
/// field; every number they give is finite and not absurdly large. Not thread-safe: what was read
/// is kept.
class HRI_API ModelFile {
 public:
  static constexpr int kFormatVersion = 2;
  /// No model comes near to these; squares and sums of what is larger overflow, and decisions made
  /// of them mean nothing.
  static constexpr double kLargestFloat = 1e15;   ///< in tensors of float32
  static constexpr double kLargestNumber = 1e30;  ///< in tensors of float64, and of single numbers

  /// Reads a whole file. Throws IoError where it cannot be read and FormatError for anything but a
  /// sound model: sizes are bounded by the real file size before memory is taken, tensors must fill
  /// the data without gap or overlap.
  static ModelFile read(const std::string& path);
  /// The same from memory; `name` stands for the path in messages.
  static ModelFile parse(Span<const std::uint8_t> bytes, const std::string& name);

  /// Writes to a temporary file in the same folder, syncs, and renames: an old file stays whole if
  /// anything fails.
  void write(const std::string& path) const;
  [[nodiscard]] std::vector<std::uint8_t> serialise() const;

  /// What the file was read from, for messages; "model" for a new one.
  [[nodiscard]] const std::string& name() const { return name_; }

  /// Of the format that the file was written in.
  [[nodiscard]] int version() const { return version_; }

  [[nodiscard]] const std::string& kind() const { return text("kind"); }
  void set_kind(const std::string& kind) { set_text("kind", kind); }

  [[nodiscard]] bool has(const std::string& name) const;
  [[nodiscard]] const std::map<std::string, std::string>& metadata() const { return metadata_; }
  /// Rows and columns of every tensor by name.
  [[nodiscard]] std::map<std::string, std::pair<std::int64_t, std::int64_t>> tensor_shapes() const;
  [[nodiscard]] const std::string& text(const std::string& key) const;
  [[nodiscard]] std::int64_t integer(const std::string& key) const;
  [[nodiscard]] double number(const std::string& key) const;
  [[nodiscard]] std::vector<std::string> text_list(const std::string& key) const;
  /// Setters throw InvalidArgument for what the getters would refuse: text that is not UTF-8, a
  /// number that is not finite or too large.
  void set_text(const std::string& key, const std::string& value);
  void set_integer(const std::string& key, std::int64_t value);
  void set_number(const std::string& key,
                  double value);  ///< 17 digits: reads back equal to the bit
  void set_text_list(const std::string& key, const std::vector<std::string>& values);

  [[nodiscard]] MatrixD matrix_d(const std::string& name) const;
  [[nodiscard]] MatrixF matrix_f(const std::string& name) const;
  [[nodiscard]] VectorD vector_d(const std::string& name) const;  ///< a matrix of one row
  [[nodiscard]] VectorF vector_f(const std::string& name) const;
  void set_matrix(const std::string& name, ConstMatrixRefD values);
  void set_matrix(const std::string& name, ConstMatrixRefF values);
  void set_vector(const std::string& name, const VectorD& values);
  void set_vector(const std::string& name, const VectorF& values);

  /// Throws FormatError that names a field or tensor which no getter has given yet: a newer library
  /// wrote it, and what it means is not known here.
  void require_all_read() const;

 private:
  struct Tensor {
    bool is_double = false;
    std::int64_t rows = 0;
    std::int64_t cols = 0;
    std::vector<std::uint8_t> bytes;
  };
  [[noreturn]] void refuse(const std::string& field, const std::string& why) const;
  [[nodiscard]] const Tensor& tensor(const std::string& name, bool is_double) const;
  [[nodiscard]] std::uint32_t checksum() const;

  std::string name_ = "model";
  int version_ = kFormatVersion;
  mutable std::set<std::string> read_;
  std::map<std::string, Tensor> tensors_;
  std::map<std::string, std::string> metadata_;
};

}  // namespace hri
