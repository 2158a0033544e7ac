// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// CRC-32 as in zlib, PNG and Ethernet (reflected polynomial 0xEDB88320), to find damaged model
// files.
#pragma once

#include <cstdint>

#include "hri/core/export.hpp"
#include "hri/core/types.hpp"

namespace hri {

/// The checksum of `bytes`, continuing from `previous` (0 to begin): crc32(b, crc32(a)) == crc32(a
/// + b).
HRI_API std::uint32_t crc32(Span<const std::uint8_t> bytes, std::uint32_t previous = 0);

}  // namespace hri
