// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstring>
#include <string>

#include "hri/core/error.hpp"

namespace hri::detail {

[[noreturn]] inline void fail_io(const std::string& path, const char* what, int error) {
  fail(ErrorKind::io, path + ": " + what + ": " + std::strerror(error));
}

// The system ends a path at the first NUL: "model.hri\0.bak" would be model.hri.
inline void require_path(const std::string& path) {
  const std::size_t end = path.find('\0');
  if (end != std::string::npos)
    fail(ErrorKind::invalid_argument,
         path.substr(0, end) + ": the path goes on after a NUL character");
}

}  // namespace hri::detail
