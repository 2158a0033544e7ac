// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/vision/video.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>

#include "hri/core/error.hpp"
#include "io/io_testing.hpp"
#include "test_folder.hpp"

namespace hri {
namespace {

using io_testing::message_of;

TEST(VideoReader, RefusesAVideoThatEndsBeforeItsContainer) {
  const TestFolder folder;
  std::ofstream(folder / "cut.avi", std::ios::binary)
      << std::string("RIFF\x10\x27\0\0AVI LIST", 16);
  const auto message = message_of<FormatError>([&] { VideoReader reader(folder / "cut.avi"); });
  EXPECT_EQ(message, (folder / "cut.avi") + ": file ends early: 16 of 10008 bytes are there");
}

TEST(VideoReader, RefusesWhatIsNoFileWithoutWaiting) {
  const TestFolder folder;
  ASSERT_EQ(::mkfifo((folder / "pipe.avi").c_str(), 0600), 0);
  EXPECT_THROW(VideoReader reader(folder / "pipe.avi"), IoError);
  EXPECT_THROW(VideoReader reader("/dev/zero"), IoError);
  EXPECT_THROW(VideoReader reader(folder / "none.avi"), IoError);
  EXPECT_THROW(VideoReader reader(folder / "."), IoError);
}

}  // namespace
}  // namespace hri
