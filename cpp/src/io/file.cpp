// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/io/file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

#include "io/open_file.hpp"
#include "io/system_errors.hpp"

namespace hri {
namespace detail {

OpenFile::OpenFile(const std::string& path) : path_(path) {
  require_path(path);
  // O_NONBLOCK: a pipe without a writer would be waited for before it can be seen to be one; on
  // regular files it means nothing.
  descriptor_ = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY);
  if (descriptor_ < 0) fail_io(path, "cannot open", errno);
  struct stat status {};
  const int error = ::fstat(descriptor_, &status) == 0 ? 0 : errno;
  size_ = static_cast<std::uint64_t>(status.st_size);
  if (error == 0 && S_ISREG(status.st_mode)) return;
  ::close(descriptor_);
  if (error != 0) fail_io(path, "cannot read", error);
  fail(ErrorKind::io, path + (S_ISDIR(status.st_mode) ? ": is a folder" : ": not a regular file"));
}

OpenFile::~OpenFile() { ::close(descriptor_); }

std::size_t OpenFile::read_at(std::uint64_t offset, Span<std::uint8_t> out) const {
  std::size_t done = 0;
  while (done < out.size()) {
    const std::size_t wanted = std::min<std::size_t>(out.size() - done, std::size_t{1} << 30U);
    const ssize_t got =
        ::pread(descriptor_, out.data() + done, wanted, static_cast<off_t>(offset + done));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail_io(path_, "cannot read", errno);
    if (got == 0) break;
    done += static_cast<std::size_t>(got);
  }
  return done;
}

}  // namespace detail

void require_regular_file(const std::string& path) { const detail::OpenFile file(path); }

std::vector<std::uint8_t> read_file(const std::string& path, std::uint64_t max_bytes) {
  const detail::OpenFile file(path);
  if (file.size() > max_bytes) {
    fail(ErrorKind::format, path + ": has " + std::to_string(file.size()) +
                                " bytes, more than the limit of " + std::to_string(max_bytes));
  }
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(file.size()));
  bytes.resize(file.read_at(0, {bytes.data(), bytes.size()}));  // less if it is cut meanwhile
  return bytes;
}

void write_file_atomically(const std::string& path, Span<const std::uint8_t> bytes) {
  AtomicFile file(path);
  file.write(bytes);
  file.commit();
}

}  // namespace hri
