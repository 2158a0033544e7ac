// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Whole files in and out. Errors are IoError and name the path and the operating system's reason; a
// path with a NUL character, which the system would read as a shorter one, is an InvalidArgument.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/types.hpp"

namespace hri {

/// Throws IoError for anything but a regular file that may be read. A pipe or a device is refused
/// at once, where reading it could wait for ever. For libraries that open a path themselves.
HRI_API void require_regular_file(const std::string& path);

/// The bytes of a regular file. Throws IoError, and FormatError for a file larger than `max_bytes`.
HRI_API std::vector<std::uint8_t> read_file(const std::string& path,
                                            std::uint64_t max_bytes = std::uint64_t{1} << 31U);

/// `bytes` through an AtomicFile.
HRI_API void write_file_atomically(const std::string& path, Span<const std::uint8_t> bytes);

/// A file that appears whole or not at all. It is written under a temporary name in the same
/// folder, `.NAME.hri-part-...`, synced to the disk and renamed: readers see the old file or the
/// new one, never half of one. A file that is replaced keeps its permissions, a symbolic link stays
/// one and what it points to is replaced. Any number of threads and processes may write one path;
/// the last to commit wins.
///
/// What killed processes left in the folder is removed by the first AtomicFile there of the next
/// process. The temporary file is locked (flock) while its writer lives, so that no living
/// process's file counts as one of these.
class HRI_API AtomicFile {
 public:
  /// Throws IoError where there is no such folder, where it or an existing file may not be written,
  /// and for a target that is no regular file.
  explicit AtomicFile(const std::string& path);
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  ~AtomicFile() { discard(); }

  /// Ends in the suffix of the path. Another library may write the file by this name.
  [[nodiscard]] const std::string& temporary_path() const { return part_; }

  /// Appends.
  void write(Span<const std::uint8_t> bytes);
  /// Gives the file its name; nothing may be written after it.
  void commit();
  /// Leaves nothing behind; after `commit` this does nothing.
  void discard() noexcept;

 private:
  void open_part(unsigned mode);

  std::string path_;    ///< as given, for messages
  std::string target_;  ///< what `path_` leads to
  std::string part_;
  int descriptor_ = -1;
  int kept_mode_ = -1;  ///< permissions of the file to be replaced
};

}  // namespace hri
