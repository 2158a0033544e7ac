// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Any bytes as the container of a video.
#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include "fuzzing.hpp"
#include "hri/io/video_container.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const int file = ::memfd_create("video", MFD_CLOEXEC);
  static const std::string path = "/proc/self/fd/" + std::to_string(file);
  if (::ftruncate(file, 0) != 0 || ::pwrite(file, data, size, 0) != static_cast<ssize_t>(size))
    std::abort();
  hri::fuzzing::expect_typed_errors([&] { hri::require_whole_video(path); });
  return 0;
}
