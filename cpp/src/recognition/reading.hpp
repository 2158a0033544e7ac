// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// What a model file holds is judged by the same constructors as what a caller passes; but then the
// file is at fault, and the message has to name it.
#pragma once

#include <utility>

#include "hri/core/error.hpp"
#include "hri/io/model_file.hpp"

namespace hri::detail {

template <class Read>
auto with_context(const ModelFile& file, Read&& read) {
#if defined(__cpp_exceptions)
  try {
    return std::forward<Read>(read)();
  } catch (const InvalidArgument& error) {
    fail(ErrorKind::format, file.name() + ": " + error.what());
  }
#else
  (void)file;
  return std::forward<Read>(read)();
#endif
}

}  // namespace hri::detail
