// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "hri/core/types.hpp"

namespace hri::detail {

// A regular file that is open for reading. Throws IoError for anything else; a pipe or a device is
// refused without waiting for what may never come.
class OpenFile {
 public:
  explicit OpenFile(const std::string& path);
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  ~OpenFile();

  [[nodiscard]] std::uint64_t size() const { return size_; }
  // Fills `out` from byte `offset` on; gives the number of bytes, fewer only at the end of the
  // file.
  std::size_t read_at(std::uint64_t offset, Span<std::uint8_t> out) const;

 private:
  std::string path_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
};

}  // namespace hri::detail
