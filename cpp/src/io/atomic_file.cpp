// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include <dirent.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <mutex>
#include <set>

#include "hri/io/file.hpp"
#include "io/system_errors.hpp"

namespace hri {
namespace {

using detail::fail_io;

constexpr const char* kMark = ".hri-part-";
constexpr std::size_t kMaxStem = 150;  // names may have 255 bytes
constexpr std::size_t kMaxSuffix = 16;
constexpr int kMaxLinks = 40;  // as Linux

// "a/b" into "a/" and "b".
std::size_t start_of_name(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  return slash == std::string::npos ? 0 : slash + 1;
}

// Where the last part of `path` leads through symbolic links, there or not.
std::string followed(std::string path) {
  for (int links = 0; links < kMaxLinks; ++links) {
    char text[4096];
    const ssize_t length = ::readlink(path.c_str(), text, sizeof text);
    if (length <= 0 || static_cast<std::size_t>(length) == sizeof text) return path;
    const std::string to(text, static_cast<std::size_t>(length));
    path.resize(to.front() == '/' ? 0 : start_of_name(path));
    path += to;
  }
  return path;
}

// ".NAME.hri-part-" and the suffix, of a target.
std::pair<std::string, std::string> part_name(const std::string& name) {
  std::size_t dot = name.rfind('.');
  if (dot == std::string::npos || dot == 0 || name.size() - dot > kMaxSuffix) dot = name.size();
  std::size_t stem = std::min(dot, kMaxStem);
  // Some file systems take UTF-8 only: no character is cut.
  while (stem < dot && stem > 0 && (static_cast<unsigned char>(name[stem]) & 0xC0U) == 0x80U)
    --stem;
  return {"." + name.substr(0, stem) + kMark, name.substr(dot)};
}

// Removes the parts in `folder` that no living process has locked; once for every folder, since
// what remains to be found then is only what dies later.
void clean(const std::string& folder) {
  static std::mutex mutex;
  static std::set<std::string> cleaned;
  {
    const std::lock_guard<std::mutex> lock(mutex);
    if (!cleaned.insert(folder).second) return;
  }
  DIR* const entries = ::opendir(folder.c_str());
  if (entries == nullptr) return;
  while (const dirent* const entry = ::readdir(entries)) {
    const std::string name = entry->d_name;
    if (name.front() != '.' || name.find(kMark) == std::string::npos) continue;
    // To write: over NFS an exclusive lock asks for that.
    const int part = ::openat(::dirfd(entries), name.c_str(),
                              O_RDWR | O_NONBLOCK | O_CLOEXEC | O_NOFOLLOW | O_NOCTTY);
    if (part < 0) continue;
    struct stat status {};
    if (::fstat(part, &status) == 0 && S_ISREG(status.st_mode) &&
        ::flock(part, LOCK_EX | LOCK_NB) == 0) {
      ::unlinkat(::dirfd(entries), name.c_str(), 0);
    }
    ::close(part);
  }
  ::closedir(entries);
}

std::string folder_of(const std::string& target) {
  const std::size_t start = start_of_name(target);
  return start == 0 ? "." : target.substr(0, start);
}

}  // namespace

AtomicFile::AtomicFile(const std::string& path) : path_(path) {
  detail::require_path(path);
  target_ = followed(path);
  if (start_of_name(target_) == target_.size()) fail_io(path_, "cannot write", EISDIR);
  struct stat status {};
  if (::stat(target_.c_str(), &status) == 0) {
    if (S_ISDIR(status.st_mode)) fail_io(path_, "cannot write", EISDIR);
    if (!S_ISREG(status.st_mode)) fail(ErrorKind::io, path_ + ": not a regular file");
    // A rename asks for no permission on the file that it replaces.
    if (::access(target_.c_str(), W_OK) != 0) fail_io(path_, "cannot write", errno);
    kept_mode_ = static_cast<int>(status.st_mode & 0777U);
  } else if (errno != ENOENT) {
    fail_io(path_, "cannot write", errno);
  }
  clean(folder_of(target_));
  // No user may read it whom the old file kept out; a new file has what the process's umask leaves.
  open_part(kept_mode_ < 0 ? 0666U : 0600U);
}

void AtomicFile::open_part(unsigned mode) {
  static std::atomic<unsigned> count{0};
  const std::size_t start = start_of_name(target_);
  const auto [name, suffix] = part_name(target_.substr(start));
  const std::string begin =
      target_.substr(0, start).append(name).append(std::to_string(::getpid()));
  for (;;) {
    part_ = begin;
    part_.append("-").append(std::to_string(count++)).append(suffix);
    descriptor_ = ::open(part_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, mode);
    if (descriptor_ < 0 && errno == EEXIST)
      continue;  // another machine's process, on a shared disk
    if (descriptor_ < 0) fail_io(path_, "cannot write", errno);
    // Between these two calls the part looks like one that was left: then it is gone, or about to.
    const bool locked = ::flock(descriptor_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
    struct stat status {};
    if (locked && ::fstat(descriptor_, &status) == 0 && status.st_nlink > 0) return;
    ::close(descriptor_);
  }
}

void AtomicFile::write(Span<const std::uint8_t> bytes) {
  std::size_t done = 0;
  while (done < bytes.size()) {
    const std::size_t wanted = std::min<std::size_t>(bytes.size() - done, std::size_t{1} << 30U);
    const ssize_t wrote = ::write(descriptor_, bytes.data() + done, wanted);
    if (wrote < 0 && errno == EINTR) continue;
    if (wrote < 0) fail_io(path_, "cannot write", errno);
    done += static_cast<std::size_t>(wrote);
  }
}

void AtomicFile::commit() {
  require(descriptor_ >= 0, "the file has been committed or discarded");
  int error = 0;
  if (kept_mode_ >= 0 && ::fchmod(descriptor_, static_cast<mode_t>(kept_mode_)) != 0) error = errno;
  if (error == 0 && ::fsync(descriptor_) != 0) error = errno;
  if (error == 0 && std::rename(part_.c_str(), target_.c_str()) != 0) error = errno;
  if (error != 0) {
    discard();
    fail_io(path_, "cannot write", error);
  }
  ::close(descriptor_);
  descriptor_ = -1;
}

void AtomicFile::discard() noexcept {
  if (descriptor_ < 0) return;
  ::unlink(part_.c_str());
  ::close(descriptor_);
  descriptor_ = -1;
}

}  // namespace hri
