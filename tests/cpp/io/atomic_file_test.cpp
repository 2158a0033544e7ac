// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <set>
#include <thread>

#include "hri/core/error.hpp"
#include "hri/io/file.hpp"
#include "io/io_testing.hpp"
#include "test_folder.hpp"

namespace hri {
namespace {

namespace fs = std::filesystem;
using io_testing::message_of;
using Bytes = std::vector<std::uint8_t>;

const Bytes kOld{'o', 'l', 'd'};
const Bytes kNew{'n', 'e', 'w'};

unsigned mode_of(const std::string& path) {
  return static_cast<unsigned>(fs::status(path).permissions());
}

TEST(AtomicFile, KeepsThePermissionsOfWhatItReplaces) {
  const TestFolder folder;
  for (const unsigned mode : {0600U, 0640U, 0666U, 0755U}) {
    write_file_atomically(folder / "a", kOld);
    fs::permissions(folder / "a", static_cast<fs::perms>(mode));
    write_file_atomically(folder / "a", kNew);
    EXPECT_EQ(mode_of(folder / "a"), mode);
  }
}

TEST(AtomicFile, HasWhatTheUmaskLeavesWhereItIsNew) {
  const TestFolder folder;
  const mode_t before = ::umask(027);
  write_file_atomically(folder / "a", kNew);
  ::umask(before);
  EXPECT_EQ(mode_of(folder / "a"), 0640U);
}

TEST(AtomicFile, OfWhatMayBeReadByFewIsNotReadByOthersMeanwhile) {
  const TestFolder folder;
  write_file_atomically(folder / "a", kOld);
  fs::permissions(folder / "a", static_cast<fs::perms>(0600));
  const AtomicFile file(folder / "a");
  EXPECT_EQ(mode_of(file.temporary_path()), 0600U);
}

TEST(AtomicFile, ReplacesWhatALinkPointsTo) {
  const TestFolder folder;
  fs::create_directory(folder / "store");
  write_file_atomically(folder / "store/a", kOld);
  fs::create_symlink("store/a", folder / "link");
  fs::create_symlink("link", folder / "link to the link");
  write_file_atomically(folder / "link to the link", kNew);
  EXPECT_TRUE(fs::is_symlink(folder / "link to the link"));
  EXPECT_TRUE(fs::is_symlink(folder / "link"));
  EXPECT_EQ(read_file(folder / "store/a"), kNew);

  fs::create_symlink(folder / "store/b", folder / "to nothing yet");
  write_file_atomically(folder / "to nothing yet", kNew);
  EXPECT_EQ(read_file(folder / "store/b"), kNew);

  fs::create_symlink("round", folder / "round");
  EXPECT_THROW(write_file_atomically(folder / "round", kNew), IoError);
}

TEST(AtomicFile, DoesNotReplaceAPipeOrAFolder) {
  const TestFolder folder;
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  EXPECT_THROW(write_file_atomically(folder / "pipe", kNew), IoError);
  EXPECT_THROW(write_file_atomically("/dev/null", kNew), IoError);
  EXPECT_THROW(write_file_atomically(folder / "", kNew), IoError);
  EXPECT_THROW(write_file_atomically("", kNew), IoError);
  EXPECT_EQ(folder.names(), std::vector<std::string>{"pipe"});
}

TEST(AtomicFile, EndsInItsSuffixAndCanBeWrittenByName) {
  const TestFolder folder;
  AtomicFile file(folder / "clip.webm");
  EXPECT_EQ(fs::path(file.temporary_path()).extension(), ".webm");
  fs::copy_file("/proc/self/exe", file.temporary_path(), fs::copy_options::overwrite_existing);
  EXPECT_FALSE(fs::exists(folder / "clip.webm"));
  file.commit();
  EXPECT_EQ(fs::file_size(folder / "clip.webm"), fs::file_size("/proc/self/exe"));
  EXPECT_EQ(folder.names(), std::vector<std::string>{"clip.webm"});
}

TEST(AtomicFile, LeavesTheOldFileWhereItIsNotCommitted) {
  const TestFolder folder;
  write_file_atomically(folder / "a", kOld);
  {
    AtomicFile file(folder / "a");
    file.write(kNew);
  }
  EXPECT_EQ(read_file(folder / "a"), kOld);
  EXPECT_EQ(folder.names(), std::vector<std::string>{"a"});
  AtomicFile file(folder / "a");
  file.commit();
  EXPECT_THROW(file.commit(), InvalidArgument);
}

TEST(AtomicFile, MayHaveANameAsLongAsTheSystemTakes) {
  const TestFolder folder;
  std::string name;
  while (name.size() < 250) name += "हा";
  name = name.substr(0, 246) + ".webm";
  write_file_atomically(folder / name, kNew);
  EXPECT_EQ(read_file(folder / name), kNew);
}

// Runs `action` in a process of its own; false where it was killed or failed.
template <class Action>
bool in_another_process(const Action& action) {
  const pid_t child = ::fork();
  if (child == 0) {
    action();
    ::_exit(0);
  }
  int status = 0;
  return ::waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

TEST(AtomicFile, OfAKilledProcessIsRemovedByTheNextAndOfALivingOneIsNot) {
  const TestFolder folder;
  std::set<std::string> kept{"notes", ".hri-parts"};
  for (const std::string& name : kept) std::ofstream(folder / name) << "a user's own";
  for (int i = 0; i < 3; ++i) {
    EXPECT_FALSE(in_another_process([&] {
      AtomicFile file(folder / "killed.txt");
      file.write(kOld);
      ::raise(SIGKILL);
    }));
  }
  // The second removed what the first had left, and the third what the second had.
  EXPECT_EQ(folder.names().size(), kept.size() + 1);

  const AtomicFile alive(folder / "alive.txt");
  EXPECT_TRUE(in_another_process([&] { write_file_atomically(folder / "next", kNew); }));
  kept.insert({"next", fs::path(alive.temporary_path()).filename().string()});
  const auto names = folder.names();
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()), kept);
}

TEST(AtomicFile, OfManyThreadsHasManyNames) {
  const TestFolder folder;
  std::vector<std::thread> threads;
  std::vector<std::string> names(60);
  threads.reserve(names.size());
  for (std::size_t i = 0; i < names.size(); ++i) {
    threads.emplace_back([&, i] {
      AtomicFile file(folder / "shared");
      names[i] = file.temporary_path();
      file.write(Bytes(100, static_cast<std::uint8_t>(i)));
      EXPECT_NO_THROW(file.commit());
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
  const Bytes bytes = read_file(folder / "shared");
  EXPECT_EQ(bytes, Bytes(100, bytes.at(0)));
  EXPECT_EQ(folder.names(), std::vector<std::string>{"shared"});
}

TEST(ReadFile, RefusesAtOnceWhatIsNoFile) {
  const TestFolder folder;
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  EXPECT_NE(message_of<IoError>([&] { read_file(folder / "pipe"); }).find("not a regular file"),
            std::string::npos);
  EXPECT_THROW(require_regular_file(folder / "pipe"), IoError);
  EXPECT_THROW(read_file("/dev/zero"), IoError);
  EXPECT_THROW(read_file(folder / "."), IoError);
}

TEST(ReadFile, RefusesAPathThatTheSystemWouldCut) {
  const TestFolder folder;
  write_file_atomically(folder / "a", kOld);
  const std::string path = (folder / "a") + std::string("\0.txt", 5);
  EXPECT_NE(message_of<InvalidArgument>([&] { read_file(path); }).find(folder / "a"),
            std::string::npos);
  EXPECT_THROW(write_file_atomically(path, kNew), InvalidArgument);
  EXPECT_EQ(read_file(folder / "a"), kOld);
}

}  // namespace
}  // namespace hri
