// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Every allocation and every file operation fails once in turn: an error of a known type, no leak,
// nothing half-written, and the next attempt works.
#include <gtest/gtest.h>

#include <new>
#include <string>
#include <vector>

#include "faults/failing_calls.hpp"
#include "hri/core/error.hpp"
#include "hri/core/threads.hpp"
#include "hri/io/file.hpp"
#include "hri/io/wav.hpp"
#include "hri/recognition/gesture/gesture_recognizer.hpp"
#include "hri/recognition/word/word_recognizer.hpp"
#include "recognition/tone_words.hpp"
#include "test_folder.hpp"

namespace hri {
namespace {

using testing_data::Call;

enum class Outcome : std::uint8_t { worked, no_memory, refused };

// What `action` ended in; anything but these errors fails the test by itself.
template <class Action>
Outcome outcome_of(const Action& action) {
  try {
    action();
    return Outcome::worked;
  } catch (const std::bad_alloc&) {
    return Outcome::no_memory;
  } catch (const IoError&) {
    return Outcome::refused;
  }
}

// Every allocation of `action` fails once, and leaves nothing behind.
template <class Action>
void expect_no_leak(int max_tries, const Action& action) {
  Outcome outcome = Outcome::worked;
  int failed = 0;
  outcome = outcome_of(action);  // fills what is kept between calls
  const std::int64_t before = testing_data::num_blocks();
  testing_data::with_every_failure(
      Call::allocation, max_tries, [&] { outcome = outcome_of(action); },
      [&](std::int64_t n) {
        EXPECT_NE(outcome, Outcome::refused) << n;
        failed += outcome == Outcome::no_memory ? 1 : 0;
        EXPECT_EQ(testing_data::num_blocks(), before) << "allocation " << n;
      });
  EXPECT_GT(failed, 3);
  EXPECT_EQ(outcome_of(action), Outcome::worked);
}

std::string model(const char* name) { return std::string(HRI_MODELS_DIR) + "/" + name + ".hri"; }

// A folder of its own, empty at first.
class Faults : public ::testing::Test {
 protected:
  // `write` replaces a file: whatever fails, the file holds what it held or what it shall hold, and
  // nothing else is left in the folder.
  template <class Write>
  void expect_whole_file(const Write& write) {
    const std::string path = folder_ / "file";
    write(path);
    const std::vector<std::uint8_t> wanted = read_file(path);
    const std::vector<std::uint8_t> old = {1, 2, 3};
    Outcome outcome = Outcome::worked;
    for (const Call kind : {Call::file, Call::allocation}) {
      int failed = 0;
      testing_data::with_every_failure(
          kind, 300, [&] { outcome = outcome_of([&] { write(path); }); },
          [&](std::int64_t n) {
            failed += outcome == Outcome::worked ? 0 : 1;
            const std::vector<std::uint8_t> now = read_file(path);
            EXPECT_TRUE(now == wanted || (outcome != Outcome::worked && now == old)) << n;
            EXPECT_EQ(folder_.names(), std::vector<std::string>{"file"}) << n;
            write_file_atomically(path, {old.data(), old.size()});
          });
      EXPECT_GT(failed, 1);
    }
  }

  TestFolder folder_;
};

TEST_F(Faults, LoadingLeavesNothing) {
  for (const char* name : {"words_one_stream", "words_ptbhmm"})
    expect_no_leak(400, [&] { WordRecognizer::load(model(name)); });
  for (const char* name : {"gestures_knn", "gestures_path", "gestures_ptbhmm"})
    expect_no_leak(400, [&] { GestureRecognizer::load(model(name)); });
}

TEST_F(Faults, RecognisingLeavesNothing) {
  const auto tone = testing_data::tone(500, 800, 1);
  for (const char* name : {"words_one_stream", "words_ptbhmm"}) {
    const WordRecognizer words = WordRecognizer::load(model(name));
    expect_no_leak(400, [&] { (void)words.recognise(tone, testing_data::kRateHz); });
  }
}

TEST_F(Faults, TrainingLeavesNothing) {
  const testing_data::Clips clips = testing_data::tone_clips();
  for (const SequenceModelKind kind : {SequenceModelKind::hmm, SequenceModelKind::ptbhmm}) {
    WordRecognizerOptions options;
    options.model = kind;
    options.num_states = 3;
    options.num_codewords = 8;
    options.max_iterations = 2;
    options.garbage_mixtures = 2;
    options.num_vtlp_factors = 1;
    options.num_noisy_copies = 0;
    for (const int threads : {1, 2}) {
      set_num_threads(threads);
      expect_no_leak(40, [&] { WordRecognizer::train(clips.samples, options); });
    }
  }
  set_num_threads(0);
}

TEST_F(Faults, SavingKeepsAWholeFile) {
  const WordRecognizer words = WordRecognizer::load(model("words_one_stream"));
  expect_whole_file([&](const std::string& path) { words.save(path); });
  const GestureRecognizer gestures = GestureRecognizer::load(model("gestures_knn"));
  expect_whole_file([&](const std::string& path) { gestures.save(path); });
}

TEST_F(Faults, WritingAWavKeepsAWholeFile) {
  const auto tone = testing_data::tone(500, 800, 1);
  expect_whole_file([&](const std::string& path) { write_wav_pcm16(path, tone, 16000); });
}

TEST_F(Faults, ReadingTellsWhichFileFailed) {
  const std::string path = model("words_one_stream");
  Outcome outcome = Outcome::worked;
  int refused = 0;
  testing_data::with_every_failure(
      Call::file, 100, [&] { outcome = outcome_of([&] { WordRecognizer::load(path); }); },
      [&](std::int64_t n) {
        EXPECT_EQ(outcome, Outcome::refused) << n;
        ++refused;
      });
  EXPECT_GE(refused, 2);  // opening and reading
}

}  // namespace
}  // namespace hri
