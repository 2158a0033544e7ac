// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Errors. Bad input from a caller is an InvalidArgument, bad outside data a FormatError; both are
// raised through one function each, so that the core also builds without exceptions (installable
// handler, then abort).
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>

#include "hri/core/export.hpp"

namespace hri {

/// Root of everything libhri throws.
class HRI_API Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A caller passed a value outside its documented range (Python: also a ValueError).
class HRI_API InvalidArgument : public Error {
 public:
  using Error::Error;
};

/// A file or byte stream breaks its format; the message names the file and the field (Python: also
/// a ValueError).
class HRI_API FormatError : public Error {
 public:
  using Error::Error;
};

/// The operating system refused a file operation; the message names the path (Python: also an
/// OSError).
class HRI_API IoError : public Error {
 public:
  using Error::Error;
};

/// Training was interrupted by its `should_stop` callback; nothing was kept (Python:
/// KeyboardInterrupt).
class HRI_API Interrupted : public Error {
 public:
  using Error::Error;
};

enum class ErrorKind : std::uint8_t { invalid_argument, format, io, interrupted };

/// Called instead of `throw` when the library is built with -fno-exceptions; must not return.
using FailureHandler = void (*)(ErrorKind kind, const char* message);

/// Installs `handler` (nullptr restores the default, which prints to stderr and aborts). Not
/// thread-safe.
HRI_API void set_failure_handler(FailureHandler handler) noexcept;

/// The one way out for errors: throws the class that belongs to `kind`, or calls the failure
/// handler.
[[noreturn]] HRI_API void fail(ErrorKind kind, const std::string& message);

/// fail(invalid_argument, message) unless `condition`.
inline void require(bool condition, const char* message) {
  if (!condition) fail(ErrorKind::invalid_argument, message);
}

}  // namespace hri
