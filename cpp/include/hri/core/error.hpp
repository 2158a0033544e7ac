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

namespace hri {

/// Root of everything libhri throws.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A caller passed a value outside its documented range (Python: also a ValueError).
class InvalidArgument : public Error {
 public:
  using Error::Error;
};

/// A file or byte stream breaks its format; the message names the file and the field (Python: also
/// a ValueError).
class FormatError : public Error {
 public:
  using Error::Error;
};

/// The operating system refused a file operation; the message names the path (Python: also an
/// OSError).
class IoError : public Error {
 public:
  using Error::Error;
};

/// Training was interrupted by its `should_stop` callback; nothing was kept (Python:
/// KeyboardInterrupt).
class Interrupted : public Error {
 public:
  using Error::Error;
};

enum class ErrorKind : std::uint8_t { invalid_argument, format, io, interrupted };

/// Called instead of `throw` when the library is built with -fno-exceptions; must not return.
using FailureHandler = void (*)(ErrorKind kind, const char* message);

/// Installs `handler` (nullptr restores the default, which prints to stderr and aborts). Not
/// thread-safe.
void set_failure_handler(FailureHandler handler) noexcept;

/// The one way out for errors: throws the class that belongs to `kind`, or calls the failure
/// handler.
[[noreturn]] void fail(ErrorKind kind, const std::string& message);

/// fail(invalid_argument, message) unless `condition`.
inline void require(bool condition, const char* message) {
  if (!condition) fail(ErrorKind::invalid_argument, message);
}

}  // namespace hri
