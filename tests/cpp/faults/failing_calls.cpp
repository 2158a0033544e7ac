// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "faults/failing_calls.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <new>

namespace {

std::atomic<std::int64_t> g_calls[2] = {0, 0};
std::atomic<std::int64_t> g_fails[2] = {0, 0};
std::atomic<std::int64_t> g_blocks = 0;

bool fails(hri::testing_data::Call kind) {
  const auto k = static_cast<std::size_t>(kind);
  return ++g_calls[k] == g_fails[k];
}
bool no_memory() { return fails(hri::testing_data::Call::allocation); }

// A full disk, or one that breaks.
bool no_disk() {
  if (!fails(hri::testing_data::Call::file)) return false;
  errno = ENOSPC;
  return true;
}

void* kept(void* memory) {
  if (memory == nullptr) throw std::bad_alloc();
  ++g_blocks;
  return memory;
}

void* taken(std::size_t size) {
  return kept(no_memory() ? nullptr : std::malloc(size == 0 ? 1 : size));
}

void* taken(std::size_t size, std::align_val_t alignment) {
  const auto line = static_cast<std::size_t>(alignment);
  return kept(no_memory() ? nullptr : std::aligned_alloc(line, (size + line - 1) / line * line));
}

void given_back(void* memory) {
  if (memory != nullptr) --g_blocks;
  std::free(memory);
}

}  // namespace

extern "C" {
void* __real_malloc(std::size_t size);
void* __real_calloc(std::size_t count, std::size_t size);
void* __real_realloc(void* memory, std::size_t size);
// What Eigen calls. It frees by std::free, which is not counted.
void* __wrap_malloc(std::size_t size) { return no_memory() ? nullptr : __real_malloc(size); }
void* __wrap_calloc(std::size_t count, std::size_t size) {
  return no_memory() ? nullptr : __real_calloc(count, size);
}
void* __wrap_realloc(void* memory, std::size_t size) {
  return no_memory() ? nullptr : __real_realloc(memory, size);
}

int __real_open(const char* path, int flags, ...);
ssize_t __real_write(int file, const void* data, std::size_t size);
ssize_t __real_pread(int file, void* data, std::size_t size, off_t offset);
int __real_fsync(int file);
int __real_fchmod(int file, mode_t mode);
int __real_rename(const char* from, const char* to);

int __wrap_open(const char* path, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const int mode = (flags & O_CREAT) != 0 ? va_arg(rest, int) : 0;
  va_end(rest);
  return no_disk() ? -1 : __real_open(path, flags, mode);
}
// Half of what was asked for is written first, as on a disk that fills.
ssize_t __wrap_write(int file, const void* data, std::size_t size) {
  if (!no_disk()) return __real_write(file, data, size);
  if (__real_write(file, data, size / 2) < 0) std::abort();
  errno = ENOSPC;
  return -1;
}
ssize_t __wrap_pread(int file, void* data, std::size_t size, off_t offset) {
  return no_disk() ? -1 : __real_pread(file, data, size, offset);
}
int __wrap_fsync(int file) { return no_disk() ? -1 : __real_fsync(file); }
int __wrap_fchmod(int file, mode_t mode) { return no_disk() ? -1 : __real_fchmod(file, mode); }
int __wrap_rename(const char* from, const char* to) {
  return no_disk() ? -1 : __real_rename(from, to);
}
}

void* operator new(std::size_t size) { return taken(size); }
void* operator new[](std::size_t size) { return taken(size); }
void* operator new(std::size_t size, std::align_val_t alignment) { return taken(size, alignment); }
void* operator new[](std::size_t size, std::align_val_t alignment) {
  return taken(size, alignment);
}
void operator delete(void* memory) noexcept { given_back(memory); }
void operator delete[](void* memory) noexcept { given_back(memory); }
void operator delete(void* memory, std::size_t /*size*/) noexcept { given_back(memory); }
void operator delete[](void* memory, std::size_t /*size*/) noexcept { given_back(memory); }
void operator delete(void* memory, std::align_val_t /*alignment*/) noexcept { given_back(memory); }
void operator delete[](void* memory, std::align_val_t /*alignment*/) noexcept {
  given_back(memory);
}

namespace hri::testing_data {

void reset_calls(Call kind, std::int64_t fails) {
  g_calls[static_cast<std::size_t>(kind)] = 0;
  g_fails[static_cast<std::size_t>(kind)] = fails;
}

std::int64_t num_calls(Call kind) { return g_calls[static_cast<std::size_t>(kind)]; }

std::int64_t num_blocks() { return g_blocks; }

}  // namespace hri::testing_data
