// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/core/error.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>
#include <type_traits>

namespace hri {
namespace {

TEST(Error, EveryClassIsAnErrorAndNoneIsAnother) {
  const auto caught_as = [](ErrorKind kind) -> std::string {
    try {
      fail(kind, "message");
    } catch (const InvalidArgument&) {
      return "invalid";
    } catch (const FormatError&) {
      return "format";
    } catch (const IoError&) {
      return "io";
    } catch (const Interrupted&) {
      return "interrupted";
    } catch (const Error&) {
      return "other";
    }
  };
  EXPECT_EQ(caught_as(ErrorKind::invalid_argument), "invalid");
  EXPECT_EQ(caught_as(ErrorKind::format), "format");
  EXPECT_EQ(caught_as(ErrorKind::io), "io");
  EXPECT_EQ(caught_as(ErrorKind::interrupted), "interrupted");
  static_assert(std::is_base_of_v<std::runtime_error, Error>);
  static_assert(std::is_base_of_v<Error, Interrupted>);
  static_assert(std::is_nothrow_copy_constructible_v<FormatError>);
}

TEST(Error, KeepsItsMessageToTheEnd) {
  const std::string long_message(5000, 'x');
  try {
    fail(ErrorKind::format, long_message + "य");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.what(), long_message + "य");
  }
}

// The handler is for builds without exceptions; where there are exceptions it stays out of the way.
TEST(Error, HandlerIsNotCalledWhereThereAreExceptions) {
  set_failure_handler([](ErrorKind, const char*) { std::abort(); });
  EXPECT_THROW(fail(ErrorKind::io, "x"), IoError);
  set_failure_handler(nullptr);
  EXPECT_THROW(require(false, "x"), InvalidArgument);
}

}  // namespace
}  // namespace hri
