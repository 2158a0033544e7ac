// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Which of many recordings an error is about.
#pragma once

#include <string>
#include <utility>

#include "hri/core/error.hpp"

namespace hri::detail {

/// Calls `read`; the message of an InvalidArgument that it throws begins with `name`.
template <class Read>
void naming(const std::string& name, Read&& read) {
#if defined(__cpp_exceptions)
  try {
    std::forward<Read>(read)();
  } catch (const InvalidArgument& error) {
    fail(ErrorKind::invalid_argument, name + ": " + error.what());
  }
#else
  (void)name;
  std::forward<Read>(read)();
#endif
}

}  // namespace hri::detail
