// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/parallel_for.hpp"

#include <algorithm>
#include <atomic>

#include "hri/core/error.hpp"
#include "hri/core/threads.hpp"

#if defined(__cpp_exceptions)
#include <exception>
#include <mutex>
#include <thread>
#include <vector>
#endif

namespace hri {
namespace {

std::atomic<int> wanted_threads{0};

}  // namespace

void set_num_threads(int count) {
  require(count >= 0, "num_threads must be at least 0");
  wanted_threads = count;
}

int num_threads() {
#if defined(__cpp_exceptions)
  const int wanted = wanted_threads;
  return wanted > 0 ? wanted : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
#else
  return 1;
#endif
}

namespace detail {
namespace {

using Task = std::function<void(std::size_t, const StopCheck&)>;

void run_in_order(std::size_t count, const StopCheck& should_stop, const Task& task) {
  for (std::size_t i = 0; i < count; ++i) {
    poll(should_stop);
    task(i, should_stop);
  }
}

#if defined(__cpp_exceptions)
thread_local bool within_task = false;

// Tasks are taken in order, so that those before one that throws have begun already, and are ended.
class Loop {
 public:
  Loop(std::size_t count, const StopCheck& should_stop, const Task& task)
      : count_(count), should_stop_(should_stop), task_(task) {}

  void run(std::size_t threads) {
    std::vector<std::thread> others;
    others.reserve(threads - 1);
    while (others.size() + 1 < threads && begin_another(&others)) {
    }
    work(asked());
    for (std::thread& other : others) other.join();
    if (error_) std::rethrow_exception(error_);
  }

 private:
  [[nodiscard]] StopCheck flag() const {
    return [this] { return stopped_.load(); };
  }
  [[nodiscard]] StopCheck asked() {
    return [this] {
      if (!stopped_ && should_stop_ && should_stop_()) stopped_ = true;
      return stopped_.load();
    };
  }

  // False without threads or memory for one: fewer do it, too.
  bool begin_another(std::vector<std::thread>* others) {
    try {
      others->emplace_back([this] { work(flag()); });
      return true;
    } catch (const std::exception&) {
      return false;
    }
  }

  void work(const StopCheck& stop) noexcept {
    within_task = true;
    for (;;) {
      const std::size_t i = next_++;
      if (i >= count_ || failed_) break;
      try {
        poll(stop);
        task_(i, stop);
      } catch (...) {
        keep(i);
        break;
      }
    }
    within_task = false;
  }

  void keep(std::size_t i) {
    const std::lock_guard<std::mutex> lock(mutex_);
    failed_ = true;
    if (error_ && first_ < i) return;
    first_ = i;
    error_ = std::current_exception();
  }

  const std::size_t count_;
  const StopCheck& should_stop_;
  const Task& task_;
  std::atomic<std::size_t> next_{0};
  std::atomic<bool> stopped_{false};
  std::atomic<bool> failed_{false};
  std::mutex mutex_;
  std::size_t first_ = 0;
  std::exception_ptr error_;
};
#endif

}  // namespace

void parallel_for(std::size_t count, const StopCheck& should_stop, const Task& task) {
#if defined(__cpp_exceptions)
  const std::size_t threads = std::min(count, static_cast<std::size_t>(num_threads()));
  if (threads > 1 && !within_task) {
    Loop(count, should_stop, task).run(threads);
    return;
  }
#endif
  run_in_order(count, should_stop, task);
}

}  // namespace detail
}  // namespace hri
