// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/core/error.hpp"

#include <cstdio>
#include <cstdlib>

namespace hri {
namespace {

void print_and_abort(ErrorKind /*kind*/, const char* message) {
  std::fprintf(stderr, "hri: %s\n", message);
  std::abort();
}

FailureHandler g_handler = &print_and_abort;

}  // namespace

void set_failure_handler(FailureHandler handler) noexcept {
  g_handler = handler != nullptr ? handler : &print_and_abort;
}

void fail(ErrorKind kind, const std::string& message) {
#if defined(__cpp_exceptions)
  switch (kind) {
    case ErrorKind::invalid_argument:
      throw InvalidArgument(message);
    case ErrorKind::format:
      throw FormatError(message);
    case ErrorKind::io:
      throw IoError(message);
    case ErrorKind::interrupted:
      throw Interrupted(message);
  }
#endif
  g_handler(kind, message.c_str());
  std::abort();
}

}  // namespace hri
