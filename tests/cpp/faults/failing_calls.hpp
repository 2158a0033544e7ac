// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Makes the n-th allocation or the n-th call of the operating system's file functions fail, in this
// program alone: operator new is replaced, and the linker redirects the rest (--wrap).
#pragma once

#include <algorithm>
#include <cstdint>

namespace hri::testing_data {

enum class Call : std::uint8_t { allocation, file };

/// Calls of this kind since the last reset; from then on the `fails`-th fails, 0 for none.
void reset_calls(Call kind, std::int64_t fails = 0);
std::int64_t num_calls(Call kind);
/// Blocks of memory that are not freed yet.
std::int64_t num_blocks();

/// Runs `action` with every call failing in turn, or with `max_tries` of them spread evenly where
/// there are more; `check` says what has to hold after each.
template <class Action, class Check>
void with_every_failure(Call kind, int max_tries, const Action& action, const Check& check) {
  reset_calls(kind);
  action();  // also fills what is kept between calls
  reset_calls(kind);
  action();
  const std::int64_t total = num_calls(kind);
  const std::int64_t step = std::max<std::int64_t>(1, total / max_tries);
  for (std::int64_t n = 1; n <= total; n += step) {
    reset_calls(kind, n);
    action();
    reset_calls(kind);
    check(n);
  }
}

}  // namespace hri::testing_data
