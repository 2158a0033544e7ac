// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/parallel_for.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "hri/core/error.hpp"
#include "hri/core/threads.hpp"

namespace hri {
namespace {

using detail::parallel_for;

class Threads : public testing::TestWithParam<int> {
 protected:
  void SetUp() override { set_num_threads(GetParam()); }
  void TearDown() override { set_num_threads(0); }
};

TEST_P(Threads, DoEveryTaskOnce) {
  std::vector<int> done(1000, 0);
  parallel_for(done.size(), {}, [&](std::size_t i, const StopCheck&) { ++done[i]; });
  EXPECT_EQ(done, std::vector<int>(1000, 1));
  parallel_for(0, {}, [&](std::size_t, const StopCheck&) { FAIL(); });
}

TEST_P(Threads, ThrowWhatTheFirstTaskInOrderThrows) {
  for (int repeat = 0; repeat < 20; ++repeat) {
    try {
      parallel_for(50, {}, [&](std::size_t i, const StopCheck&) {
        if (i == 7) std::this_thread::yield();
        if (i >= 7) throw std::runtime_error(std::to_string(i));
      });
      FAIL();
    } catch (const std::runtime_error& error) {
      EXPECT_EQ(std::string(error.what()), "7");
    }
  }
}

// The other threads wait within their first task, or they would end them all where the caller has
// no processor to ask from.
TEST_P(Threads, EndWhenTheCallerIsToldToStop) {
  const std::thread::id caller = std::this_thread::get_id();
  std::atomic<int> begun{0};
  const StopCheck should_stop = [&] {
    EXPECT_EQ(std::this_thread::get_id(), caller);
    return begun > 3;
  };
  EXPECT_THROW(parallel_for(1000000, should_stop,
                            [&](std::size_t, const StopCheck& stop) {
                              ++begun;
                              while (std::this_thread::get_id() != caller && !stop()) {
                                std::this_thread::yield();
                              }
                              poll(stop);
                            }),
               Interrupted);
  EXPECT_LT(begun, 1000000);
}

TEST_P(Threads, DoTasksWithinTasksThemselves) {
  std::atomic<int> sum{0};
  std::atomic<bool> moved{false};
  parallel_for(8, {}, [&](std::size_t, const StopCheck& stop) {
    const std::thread::id own = std::this_thread::get_id();
    parallel_for(16, stop, [&](std::size_t i, const StopCheck&) {
      sum += static_cast<int>(i);
      if (std::this_thread::get_id() != own) moved = true;
    });
  });
  EXPECT_EQ(sum, 8 * 120);
  EXPECT_FALSE(moved);
}

INSTANTIATE_TEST_SUITE_P(, Threads, testing::Values(1, 2, 5));

TEST(NumThreads, IsOneAProcessorUnlessItIsSet) {
  EXPECT_GE(num_threads(), 1);
  set_num_threads(3);
  EXPECT_EQ(num_threads(), 3);
  EXPECT_THROW(set_num_threads(-1), InvalidArgument);
  EXPECT_EQ(num_threads(), 3);
  set_num_threads(0);
  EXPECT_GE(num_threads(), 1);
}

}  // namespace
}  // namespace hri
