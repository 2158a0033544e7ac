// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "allocations/allocation_counter.hpp"

#include <cstdlib>
#include <new>

namespace {

thread_local std::int64_t g_count = 0;

void* counted(void* memory) {
  ++g_count;
  return memory;
}

void* taken(std::size_t size) {
  void* memory = counted(std::malloc(size == 0 ? 1 : size));
  if (memory == nullptr) std::abort();
  return memory;
}

void* taken(std::size_t size, std::align_val_t alignment) {
  const auto line = static_cast<std::size_t>(alignment);
  void* memory = counted(std::aligned_alloc(line, (size + line - 1) / line * line));
  if (memory == nullptr) std::abort();
  return memory;
}

}  // namespace

extern "C" {
void* __real_malloc(std::size_t size);
void* __real_calloc(std::size_t count, std::size_t size);
void* __real_realloc(void* memory, std::size_t size);
void* __wrap_malloc(std::size_t size) { return counted(__real_malloc(size)); }
void* __wrap_calloc(std::size_t count, std::size_t size) {
  return counted(__real_calloc(count, size));
}
void* __wrap_realloc(void* memory, std::size_t size) {
  return counted(__real_realloc(memory, size));
}
}

void* operator new(std::size_t size) { return taken(size); }
void* operator new[](std::size_t size) { return taken(size); }
void* operator new(std::size_t size, std::align_val_t alignment) { return taken(size, alignment); }
void* operator new[](std::size_t size, std::align_val_t alignment) {
  return taken(size, alignment);
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t /*size*/) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t /*size*/) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t /*alignment*/) noexcept { std::free(memory); }
void operator delete[](void* memory, std::align_val_t /*alignment*/) noexcept { std::free(memory); }

namespace hri::testing_data {

std::int64_t num_allocations() { return g_count; }

}  // namespace hri::testing_data
