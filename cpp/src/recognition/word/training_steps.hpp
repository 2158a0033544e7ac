// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// How far a training is, counted by several threads.
#pragma once

#include <atomic>
#include <thread>
#include <utility>

#include "hri/recognition/training.hpp"

namespace hri::detail {

/// Made by the thread that trains, which alone calls the progress.
class TrainingSteps {
 public:
  TrainingSteps(TrainingProgress progress, int num_steps)
      : progress_(std::move(progress)),
        num_steps_(num_steps),
        trainer_(std::this_thread::get_id()) {
    report(0);
  }

  /// From any thread; steps of others are reported with the next of the one that trains.
  void add(int count) {
    const int done = done_.fetch_add(count) + count;
    if (std::this_thread::get_id() == trainer_) report(done);
  }

  /// `done` steps at least are done, between tasks.
  void reach(int done) {
    if (done_ < done) done_ = done;
    report(done_);
  }

 private:
  void report(int done) const {
    if (progress_) progress_(done < num_steps_ ? done : num_steps_, num_steps_);
  }

  TrainingProgress progress_;
  int num_steps_;
  std::thread::id trainer_;
  std::atomic<int> done_{0};
};

}  // namespace hri::detail
