// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/io/file.hpp"

#include "hri/core/error.hpp"
#include "hri/io/crc32.hpp"
#include "io/io_testing.hpp"

namespace hri {
namespace {

using io_testing::Folder;
using io_testing::message_of;

const std::vector<std::uint8_t> kBytes{'1', '2', '3', '4', '5', '6', '7', '8', '9'};

TEST(Crc32, HasTheCheckValueAndContinues) {
  EXPECT_EQ(crc32(kBytes), 0xCBF43926U);  // the published check value of CRC-32
  const Span<const std::uint8_t> all(kBytes);
  EXPECT_EQ(crc32(all.subspan(4, 5), crc32(all.subspan(0, 4))), crc32(kBytes));
  EXPECT_EQ(crc32({}), 0U);
}

TEST(File, ComesBackAndLeavesNothingBeside) {
  const Folder folder;
  write_file_atomically(folder / "a", kBytes);
  write_file_atomically(folder / "a", Span<const std::uint8_t>(kBytes).subspan(0, 3));
  EXPECT_EQ(read_file(folder / "a"), (std::vector<std::uint8_t>{'1', '2', '3'}));
  EXPECT_EQ(folder.names(), std::vector<std::string>{"a"});
}

TEST(File, IsRefusedWithItsPath) {
  const Folder folder;
  write_file_atomically(folder / "a", kBytes);
  EXPECT_NE(message_of<FormatError>([&] { read_file(folder / "a", 8); }).find(folder / "a"),
            std::string::npos);
  EXPECT_NE(message_of<IoError>([&] { read_file(folder / "none"); }).find("none"),
            std::string::npos);
  EXPECT_THROW(read_file(folder / "."), IoError);
  EXPECT_THROW(write_file_atomically(folder / "no/such/folder", kBytes), IoError);
}

TEST(File, ThatCannotBeReplacedStays) {
  const Folder folder;
  std::filesystem::create_directory(folder / "taken");
  write_file_atomically(folder / "taken/inside", kBytes);
  EXPECT_THROW(write_file_atomically(folder / "taken", kBytes), IoError);
  EXPECT_EQ(read_file(folder / "taken/inside"), kBytes);
  EXPECT_EQ(folder.names(), std::vector<std::string>{"taken"});
}

}  // namespace
}  // namespace hri
