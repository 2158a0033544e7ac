// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/io/file.hpp"

#include <csignal>
#include <thread>

#include "hri/core/error.hpp"
#include "hri/io/crc32.hpp"
#include "io/io_testing.hpp"
#include "test_folder.hpp"

#if defined(__unix__) || defined(__APPLE__)
#include <sys/resource.h>
#include <unistd.h>
#endif

namespace hri {
namespace {

using io_testing::message_of;

const std::vector<std::uint8_t> kBytes{'1', '2', '3', '4', '5', '6', '7', '8', '9'};

TEST(Crc32, HasTheCheckValueAndContinues) {
  EXPECT_EQ(crc32(kBytes), 0xCBF43926U);  // the published check value of CRC-32
  const Span<const std::uint8_t> all(kBytes);
  EXPECT_EQ(crc32(all.subspan(4, 5), crc32(all.subspan(0, 4))), crc32(kBytes));
  EXPECT_EQ(crc32({}), 0U);
}

TEST(File, ComesBackAndLeavesNothingBeside) {
  const TestFolder folder;
  write_file_atomically(folder / "a", kBytes);
  write_file_atomically(folder / "a", Span<const std::uint8_t>(kBytes).subspan(0, 3));
  EXPECT_EQ(read_file(folder / "a"), (std::vector<std::uint8_t>{'1', '2', '3'}));
  EXPECT_EQ(folder.names(), std::vector<std::string>{"a"});
}

TEST(File, IsRefusedWithItsPath) {
  const TestFolder folder;
  write_file_atomically(folder / "a", kBytes);
  EXPECT_NE(message_of<FormatError>([&] { read_file(folder / "a", 8); }).find(folder / "a"),
            std::string::npos);
  EXPECT_NE(message_of<IoError>([&] { read_file(folder / "none"); }).find("none"),
            std::string::npos);
  EXPECT_THROW(read_file(folder / "."), IoError);
  EXPECT_THROW(write_file_atomically(folder / "no/such/folder", kBytes), IoError);
}

TEST(File, ThatCannotBeReplacedStays) {
  const TestFolder folder;
  std::filesystem::create_directory(folder / "taken");
  write_file_atomically(folder / "taken/inside", kBytes);
  EXPECT_THROW(write_file_atomically(folder / "taken", kBytes), IoError);
  EXPECT_EQ(read_file(folder / "taken/inside"), kBytes);
  EXPECT_EQ(folder.names(), std::vector<std::string>{"taken"});
}

TEST(File, IsReadUpToItsLimit) {
  const TestFolder folder;
  write_file_atomically(folder / "nine", kBytes);
  EXPECT_EQ(read_file(folder / "nine", 9), kBytes);
  EXPECT_THROW(read_file(folder / "nine", 8), FormatError);
  write_file_atomically(folder / "none", {});
  EXPECT_TRUE(read_file(folder / "none", 0).empty());
}

TEST(File, OfManyWritersIsWholeAndOneOfTheirs) {
  const TestFolder folder;
  std::vector<std::thread> writers;
  for (int w = 0; w < 4; ++w) {
    writers.emplace_back([&folder, w] {
      const std::vector<std::uint8_t> mine(10000, static_cast<std::uint8_t>(w));
      for (int i = 0; i < 10; ++i) EXPECT_NO_THROW(write_file_atomically(folder / "shared", mine));
    });
  }
  for (std::thread& t : writers) t.join();
  const std::vector<std::uint8_t> bytes = read_file(folder / "shared");
  ASSERT_EQ(bytes.size(), 10000U);
  EXPECT_EQ(bytes, std::vector<std::uint8_t>(10000, bytes[0]));
  EXPECT_EQ(folder.names(), std::vector<std::string>{"shared"});
}

#if defined(__unix__) || defined(__APPLE__)
// As on a full disk: the operating system takes the first bytes and no more.
TEST(File, StaysWholeWhenTheDiskTakesNoMore) {
  const TestFolder folder;
  write_file_atomically(folder / "model", kBytes);
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  rlimit small = before;
  small.rlim_cur = 4096;
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  std::string message;
  try {
    write_file_atomically(folder / "model", std::vector<std::uint8_t>(100000, 1));
  } catch (const IoError& error) {
    message = error.what();
  }
  setrlimit(RLIMIT_FSIZE, &before);
  (void)std::signal(SIGXFSZ, handler);
  EXPECT_NE(message.find(folder / "model"), std::string::npos) << message;
  EXPECT_EQ(read_file(folder / "model"), kBytes);
  EXPECT_EQ(folder.names(), std::vector<std::string>{"model"});
}

TEST(File, StaysWholeInAFolderThatMayNotBeWritten) {
  if (geteuid() == 0) GTEST_SKIP() << "the superuser may write everywhere";
  const TestFolder folder;
  write_file_atomically(folder / "model", kBytes);
  namespace fs = std::filesystem;
  fs::permissions(folder / ".", fs::perms::owner_write, fs::perm_options::remove);
  EXPECT_THROW(write_file_atomically(folder / "model", {}), IoError);
  fs::permissions(folder / ".", fs::perms::owner_write, fs::perm_options::add);
  EXPECT_EQ(read_file(folder / "model"), kBytes);
  EXPECT_EQ(folder.names(), std::vector<std::string>{"model"});
}
#endif

}  // namespace
}  // namespace hri
