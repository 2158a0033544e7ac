// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Whole files in and out. Errors are IoError and name the path and the operating system's reason.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/types.hpp"

namespace hri {

/// The bytes of a regular file. Throws IoError, and FormatError for a file larger than `max_bytes`.
HRI_API std::vector<std::uint8_t> read_file(const std::string& path,
                                            std::uint64_t max_bytes = std::uint64_t{1} << 31U);

/// Writes to a temporary file beside `path`, syncs it to the disk and renames it: readers see the
/// old file or the new one, never half of one. The temporary file is removed on failure.
HRI_API void write_file_atomically(const std::string& path, Span<const std::uint8_t> bytes);

}  // namespace hri
