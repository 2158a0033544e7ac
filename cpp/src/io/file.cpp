// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/io/file.hpp"

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "hri/core/error.hpp"

#if defined(__unix__) || defined(__APPLE__)
#include <sys/stat.h>
#include <unistd.h>
#endif

namespace hri {
namespace {

struct CloseFile {
  void operator()(std::FILE* f) const { std::fclose(f); }
};
using FilePointer = std::unique_ptr<std::FILE, CloseFile>;

[[noreturn]] void fail_io(const std::string& path, const char* what, int error) {
  fail(ErrorKind::io, path + ": " + what + ": " + std::strerror(error));
}

int process_id() {
#if defined(__unix__) || defined(__APPLE__)
  return static_cast<int>(::getpid());
#else
  return 0;
#endif
}

// 0, or the error number of what went wrong.
int write_and_sync(const std::string& path, Span<const std::uint8_t> bytes) {
  FilePointer file(std::fopen(path.c_str(), "wb"));
  if (!file) return errno;
  if (!bytes.empty() && std::fwrite(bytes.data(), 1, bytes.size(), file.get()) != bytes.size()) {
    return errno != 0 ? errno : EIO;
  }
  if (std::fflush(file.get()) != 0) return errno;
#if defined(__unix__) || defined(__APPLE__)
  if (::fsync(::fileno(file.get())) != 0) return errno;
#endif
  return std::fclose(file.release()) == 0 ? 0 : errno;
}

}  // namespace

std::vector<std::uint8_t> read_file(const std::string& path, std::uint64_t max_bytes) {
  FilePointer file(std::fopen(path.c_str(), "rb"));
  if (!file) fail_io(path, "cannot open", errno);
#if defined(__unix__) || defined(__APPLE__)
  struct stat status {};
  if (::fstat(::fileno(file.get()), &status) != 0) fail_io(path, "cannot read", errno);
  if (!S_ISREG(status.st_mode)) fail(ErrorKind::io, path + ": not a regular file");
#endif
  if (std::fseek(file.get(), 0, SEEK_END) != 0) fail_io(path, "cannot read", errno);
  const long end = std::ftell(file.get());
  if (end < 0) fail_io(path, "cannot read", errno);
  const auto size = static_cast<std::uint64_t>(end);
  if (size > max_bytes) {
    fail(ErrorKind::format, path + ": has " + std::to_string(size) +
                                " bytes, more than the limit of " + std::to_string(max_bytes));
  }
  if (std::fseek(file.get(), 0, SEEK_SET) != 0) fail_io(path, "cannot read", errno);
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(size));
  if (!bytes.empty() && std::fread(bytes.data(), 1, bytes.size(), file.get()) != bytes.size()) {
    fail_io(path, "cannot read", errno != 0 ? errno : EIO);
  }
  return bytes;
}

void write_file_atomically(const std::string& path, Span<const std::uint8_t> bytes) {
  // Neither another process nor another thread that writes the same path gets the same name.
  static std::atomic<unsigned> count{0};
  const std::string temporary =
      path + ".part" + std::to_string(process_id()) + "_" + std::to_string(count++);
  int error = write_and_sync(temporary, bytes);
  if (error == 0 && std::rename(temporary.c_str(), path.c_str()) != 0) error = errno;
  if (error != 0) {
    std::remove(temporary.c_str());
    fail_io(path, "cannot write", error);
  }
}

}  // namespace hri
