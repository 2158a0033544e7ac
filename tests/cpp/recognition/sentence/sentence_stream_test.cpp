// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/recognition/sentence/sentence_stream.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "hri/core/error.hpp"
#include "recognition/sentence/signing.hpp"

namespace hri {
namespace {

using testing_data::kRest;
using testing_data::signed_sentence;
using testing_data::signed_sentences;

constexpr double kFps = 25;
constexpr float kGone = std::numeric_limits<float>::quiet_NaN();

const SentenceRecognizer& streamed_signs() {
  static const SentenceRecognizer recognizer = [] {
    SentenceRecognizerOptions options;
    options.choose_weights = false;
    return SentenceRecognizer::train(signed_sentences(24, 1), options);
  }();
  return recognizer;
}

// Frames of synthetic streams, one part after the other.
struct Filmed {
  MatrixF tracks{0, kNumTwoHandTrackColumns};

  Filmed& add(const MatrixF& more) {
    MatrixF both(tracks.rows() + more.rows(), kNumTwoHandTrackColumns);
    both << tracks, more;
    tracks = both;
    return *this;
  }
  Filmed& rest(double seconds) {
    Random random(3);
    MatrixF still(static_cast<Eigen::Index>(seconds * kFps), kNumTwoHandTrackColumns);
    for (Eigen::Index t = 0; t < still.rows(); ++t) {
      for (int i = 0; i < kNumTwoHandTrackColumns; ++i) {
        const double head = i % 2 == 0 ? 160 : 60;
        const double place = i < 4 ? kRest[static_cast<std::size_t>(i)] : 0;
        still(t, i) = static_cast<float>(head + place + random.normal());
      }
    }
    return add(still);
  }
  Filmed& gone(double seconds, int first_column, int num_columns) {
    MatrixF row = tracks.bottomRows(1);
    row.middleCols(first_column, num_columns).setConstant(kGone);
    return add(row.replicate(static_cast<Eigen::Index>(seconds * kFps), 1));
  }
  Filmed& sign(const std::vector<std::string>& words, std::uint64_t seed) {
    return add(signed_sentence(words, seed).tracks);
  }
};

std::vector<SentenceEvent> events_of(SentenceStream* stream, const MatrixF& rows) {
  std::vector<SentenceEvent> events;
  for (Eigen::Index t = 0; t < rows.rows(); ++t) {
    SentenceEvent event = stream->push(row_span(rows, t), static_cast<double>(t) / kFps);
    if (event.kind != SentenceEventKind::none) events.push_back(std::move(event));
  }
  SentenceEvent last = stream->finish();
  if (last.kind != SentenceEventKind::none) events.push_back(std::move(last));
  return events;
}

std::string text_of_event(const SentenceEvent& event) {
  std::string text;
  for (const StreamedSign& word : event.words) text += (text.empty() ? "" : " ") + word.label;
  return text;
}

std::vector<SentenceEvent> ends_of(const std::vector<SentenceEvent>& events) {
  std::vector<SentenceEvent> ends;
  for (const SentenceEvent& event : events) {
    if (event.kind == SentenceEventKind::end) ends.push_back(event);
  }
  return ends;
}

TEST(SentenceStream, EndsSentencesAsTheirFramesAreRecognised) {
  SentenceStream stream(streamed_signs());
  const MatrixF tracks = signed_sentence({"dog", "cat", "cat", "ball"}, 99).tracks;
  const std::vector<SentenceEvent> events = events_of(&stream, tracks);
  const std::vector<SentenceEvent> ends = ends_of(events);
  ASSERT_EQ(ends.size(), 1);
  EXPECT_EQ(events.front().kind, SentenceEventKind::start);
  EXPECT_EQ(text_of_event(ends[0]), "dog cat cat ball");
  EXPECT_EQ(ends[0].reason, SentenceEventReason::ended);
  const RecognisedSentence whole = streamed_signs().recognise(tracks);
  ASSERT_EQ(whole.words.size(), ends[0].words.size());
  for (std::size_t i = 0; i < whole.words.size(); ++i) {
    EXPECT_EQ(whole.words[i].first_frame, ends[0].words[i].first_frame);
    EXPECT_NEAR(ends[0].words[i].first_s, static_cast<double>(whole.words[i].first_frame) / kFps,
                1e-9);
  }
}

TEST(SentenceStream, EndsASentenceWithARest) {
  SentenceStream stream(streamed_signs());
  Filmed film;
  film.rest(2).sign({"dog", "cat"}, 5).rest(2).sign({"ball"}, 6).rest(2);
  const std::vector<SentenceEvent> ends = ends_of(events_of(&stream, film.tracks));
  ASSERT_EQ(ends.size(), 2);
  EXPECT_EQ(text_of_event(ends[0]), "dog cat");
  EXPECT_EQ(text_of_event(ends[1]), "ball");
  for (const SentenceEvent& end : ends) EXPECT_EQ(end.reason, SentenceEventReason::rested);
  EXPECT_NEAR(ends[0].first_s, 2.3, 0.3);
  EXPECT_GT(ends[1].words[0].first_s, ends[0].last_s);
}

TEST(SentenceStream, SaysWhatItHasSoFarAndKeepsWhatIsStable) {
  SentenceStream stream(streamed_signs());
  const MatrixF tracks = signed_sentence({"dog", "cat", "ball", "dog", "cat"}, 12).tracks;
  std::string stable;
  int num_partial = 0;
  for (const SentenceEvent& event : events_of(&stream, tracks)) {
    if (event.kind != SentenceEventKind::partial) continue;
    ++num_partial;
    std::string now;
    for (int i = 0; i < event.num_stable; ++i)
      now += event.words[static_cast<std::size_t>(i)].label + " ";
    EXPECT_EQ(now.substr(0, stable.size()), stable);
    stable = now;
  }
  EXPECT_GE(num_partial, 5);
  EXPECT_EQ(stable.substr(0, 8), "dog cat ");
}

TEST(SentenceStream, TakesHandsThatVanish) {
  SentenceStream stream(streamed_signs());
  Filmed film;
  film.rest(1).sign({"dog"}, 5).gone(1, 0, 4).sign({"ball"}, 6).rest(2);
  std::vector<SentenceEvent> ends = ends_of(events_of(&stream, film.tracks));
  ASSERT_EQ(ends.size(), 1) << "a second is no end";
  EXPECT_EQ(text_of_event(ends[0]), "dog ball");
  Filmed longer;
  longer.rest(1).sign({"dog"}, 5).gone(2, 0, 4).sign({"ball"}, 6).rest(2);
  ends = ends_of(events_of(&stream, longer.tracks));
  ASSERT_EQ(ends.size(), 2);
  EXPECT_EQ(ends[0].reason, SentenceEventReason::left);
  EXPECT_EQ(text_of_event(ends[0]), "dog");
  EXPECT_EQ(text_of_event(ends[1]), "ball");
}

TEST(SentenceStream, BeginsNoneWithoutHandsOrHead) {
  SentenceStream stream(streamed_signs());
  MatrixF tracks = signed_sentence({"dog", "cat"}, 5).tracks;
  MatrixF no_head = tracks;
  no_head.rightCols(2).setConstant(kGone);
  EXPECT_TRUE(events_of(&stream, no_head).empty());
  tracks.leftCols(4).setConstant(kGone);
  EXPECT_TRUE(events_of(&stream, tracks).empty());
  Filmed film;
  film.rest(20);
  EXPECT_TRUE(events_of(&stream, film.tracks).empty()) << "nothing moves";
}

TEST(SentenceStream, TakesAHeadThatWasSeenBefore) {
  SentenceStream stream(streamed_signs());
  Filmed film;
  film.rest(3);
  MatrixF later = signed_sentence({"dog", "cat"}, 5).tracks;
  later.rightCols(2).setConstant(kGone);
  film.gone(1, 4, 2).add(later).rest(2);
  const std::vector<SentenceEvent> ends = ends_of(events_of(&stream, film.tracks));
  ASSERT_EQ(ends.size(), 1);
  EXPECT_EQ(text_of_event(ends[0]), "dog cat");
}

TEST(SentenceStream, DropsWhatWasInterrupted) {
  SentenceStream stream(streamed_signs());
  const MatrixF tracks = signed_sentence({"dog", "cat"}, 5).tracks;
  for (Eigen::Index t = 0; t < 30; ++t)
    stream.push(row_span(tracks, t), static_cast<double>(t) / kFps);
  ASSERT_TRUE(stream.in_sentence());
  const SentenceEvent event = stream.interrupt();
  EXPECT_EQ(event.kind, SentenceEventKind::dropped);
  EXPECT_EQ(event.reason, SentenceEventReason::stalled);
  EXPECT_FALSE(stream.in_sentence());
  EXPECT_EQ(stream.interrupt().kind, SentenceEventKind::none);
}

TEST(SentenceStream, KeepsItsMemoryForTenMinutes) {
  SentenceStreamOptions options;
  options.partial_s = std::numeric_limits<double>::infinity();
  options.max_sentence_s = 8;
  SentenceStream stream(streamed_signs(), options);
  Filmed film;  // hands that never rest
  film.sign({"dog", "cat", "ball"}, 5);
  const MatrixF moving = film.tracks.middleRows(8, film.tracks.rows() - 16);
  std::size_t most = 0;
  int num_cut = 0;
  for (int t = 0; t < 600 * kFps; ++t) {
    const SentenceEvent event = stream.push(row_span(moving, t % moving.rows()), t / kFps);
    num_cut += event.kind == SentenceEventKind::end ? 1 : 0;
    if (event.kind == SentenceEventKind::end) {
      EXPECT_EQ(event.reason, SentenceEventReason::cut);
    }
    most = std::max(most, stream.num_kept());
  }
  EXPECT_GE(num_cut, 70);
  EXPECT_LE(most, 8 * kFps + 25);
  SentenceStream idle(streamed_signs());
  Filmed still;
  still.rest(100);
  most = 0;
  for (Eigen::Index t = 0; t < still.tracks.rows(); ++t) {
    idle.push(row_span(still.tracks, t), static_cast<double>(t) / kFps);
    most = std::max(most, idle.num_kept());
  }
  EXPECT_LE(most, 50);
}

TEST(SentenceStream, RefusesFramesAndOptions) {
  SentenceStream stream(streamed_signs());
  const std::vector<float> row{100, 180, 190, 180, 160, 60};
  const auto refused = [&stream](const std::vector<float>& values, double time_s) {
    EXPECT_THROW(stream.push(values, time_s), InvalidArgument);
  };
  stream.push(row, 1);
  refused({1, 2, 3}, 1);
  refused({100, kGone, 190, 180, 160, 60}, 1);
  refused({100, std::numeric_limits<float>::infinity(), 190, 180, 160, 60}, 1);
  refused({2e6F, 180, 190, 180, 160, 60}, 1);
  refused(row, 0.5);
  refused(row, std::nan(""));
  EXPECT_EQ(stream.num_kept(), 1);
  SentenceStreamOptions options;
  options.rest_s = 0;
  EXPECT_THROW(SentenceStream(streamed_signs(), options), InvalidArgument);
}

TEST(SentenceStream, TakesRowsOfFeatures) {
  std::vector<SignedSample> samples = signed_sentences(24, 1);
  const auto as_rows = [](const MatrixF& tracks) -> MatrixF {
    MatrixF rows(tracks.rows(), 2);
    rows = (tracks.middleCols(2, 2) - tracks.rightCols(2)) / 100;
    return rows;
  };
  for (SignedSample& sample : samples) sample.tracks = as_rows(sample.tracks);
  SentenceRecognizerOptions options;
  options.input = SentenceInput::rows;
  options.language_order = 0;
  options.choose_weights = false;
  const SentenceRecognizer signs = SentenceRecognizer::train(samples, options);
  SentenceStream stream(signs);
  EXPECT_EQ(stream.num_columns(), 2);
  Filmed film;
  film.rest(1).sign({"dog", "cat"}, 5).rest(2);
  const std::vector<SentenceEvent> ends = ends_of(events_of(&stream, as_rows(film.tracks)));
  ASSERT_EQ(ends.size(), 1);
  EXPECT_EQ(text_of_event(ends[0]), "dog cat");
  EXPECT_THROW(stream.push(std::vector<float>{1, kGone}, 100), InvalidArgument);
  SentenceStreamOptions scaled;
  scaled.scale_px = 100;
  EXPECT_THROW(SentenceStream(signs, scaled), InvalidArgument);
}

}  // namespace
}  // namespace hri
