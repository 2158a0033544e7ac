// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Signed sentences from a stream of frames: where they begin and end, and what is found so far on
// the way. When a sentence has ended, its words are those of SentenceRecognizer::recognise over its
// frames.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/options.hpp"
#include "hri/core/types.hpp"
#include "hri/recognition/sentence/sentence_recognizer.hpp"

namespace hri {

struct SentenceStreamOptions {
  double appear_s = 0.1;
  double rest_s = 1.0;
  double leave_s = 1.5;
  double still_change = 0.25;
  double compare_s = 0.2;
  double context_s = 0.5;
  double max_sentence_s = 30;
  double partial_s = 0.3;
  double partial_share = 0.02;
  int num_agreeing = 2;
  double scale_px = 0;

  static constexpr const char* kName = "SentenceStreamOptions";
  template <class Self, class Visitor>
  static void visit(Self& o, Visitor&& v) {
    v("appear_s", o.appear_s, above(0, 1e6),
      "a sentence has begun when the hands have moved for so long");
    v("rest_s", o.rest_s, above(0, 1e6), "hands that are still for so long end it");
    v("leave_s", o.leave_s, above(0, 1e6), "and so do hands that were not seen for so long");
    v("still_change", o.still_change, above(0, 1e6),
      "hands are still while they have moved by less since compare_s ago, as a share of how much "
      "they move in the signs trained on");
    v("compare_s", o.compare_s, above(0, 1e6), "time between the frames that are compared");
    v("context_s", o.context_s, within(0, 10), "of the rest before and behind it is part of it");
    v("max_sentence_s", o.max_sentence_s, within(0.5, 300),
      "a longer sentence is cut, and one of more than 8192 frames");
    v("partial_s", o.partial_s, above(0, 1e6).or_infinity(),
      "a sentence is searched again when it has grown by this");
    v("partial_share", o.partial_share, within(0, 10),
      "and by this share of its length, so that long ones do not cost more and more");
    v("num_agreeing", o.num_agreeing, within(1, 100),
      "searches in a row that find a word which has ended, until it is stable");
    v("scale_px", o.scale_px, within(0, 1e6),
      "of the signer, as SentenceRecognizer takes it; 0: of each sentence");
  }
};

enum class SentenceEventKind : std::uint8_t {
  none,
  start,    ///< a sentence has begun
  partial,  ///< what was found in it so far
  end,      ///< what was found in the end
  dropped,  ///< what seemed to be a sentence was none
};
constexpr auto enum_names(SentenceEventKind) {
  return std::array{"none", "start", "partial", "end", "dropped"};
}

/// Why a sentence ended, or was dropped.
enum class SentenceEventReason : std::uint8_t {
  none,
  rested,   ///< the hands are still
  left,     ///< they are out of view
  cut,      ///< it reached max_sentence_s
  ended,    ///< the stream did
  stalled,  ///< dropped: the stream was interrupted
};
constexpr auto enum_names(SentenceEventReason) {
  return std::array{"none", "rested", "left", "cut", "ended", "stalled"};
}

/// A word of a sentence; frames are numbered from the beginning of the stream.
struct StreamedSign : RecognisedSign {
  double first_s = 0;  ///< times of its first frame and of its last
  double last_s = 0;
};

struct SentenceEvent {
  SentenceEventKind kind = SentenceEventKind::none;
  SentenceEventReason reason = SentenceEventReason::none;
  std::vector<StreamedSign> words;
  double log_score = 0;
  /// So many of the first words are kept until the sentence ends, where the whole of it may still
  /// correct them; in the end, all.
  int num_stable = 0;
  double first_s = 0;  ///< of the sentence; its end, so far
  double last_s = 0;
};

/// One stream, for one thread at a time. Memory is bounded by the longest sentence.
class HRI_API SentenceStream {
 public:
  static constexpr std::size_t kMostFrames = 8192;

  /// Throws InvalidArgument for options out of range, and a scale for rows, which have none.
  explicit SentenceStream(SentenceRecognizer recognizer, const SentenceStreamOptions& options = {});

  /// The next frame: a row of tracks or of features, as the recogniser takes them, and its time;
  /// what happened with it. Sentences in which no word is found are dropped. Tracks without a head
  /// begin no sentence. Throws InvalidArgument for another number of values, values that are
  /// infinite, NaN in part, or of tracks beyond 1e6, and a time that is not finite or runs
  /// backwards; then nothing has changed.
  SentenceEvent push(Span<const float> row, double time_s);

  /// The stream has ended, and with it any sentence. The next one may begin, at any time.
  SentenceEvent finish();

  /// The stream was interrupted: what had begun is dropped.
  SentenceEvent interrupt();

  [[nodiscard]] const SentenceRecognizer& recognizer() const { return recognizer_; }
  [[nodiscard]] const SentenceStreamOptions& options() const { return options_; }
  [[nodiscard]] bool in_sentence() const { return in_sentence_; }
  /// By how much the hands have moved, in units of still_change; 0 where that is not known.
  [[nodiscard]] double change() const { return change_; }
  [[nodiscard]] int num_columns() const { return static_cast<int>(held_.size()); }
  [[nodiscard]] std::size_t num_kept() const { return times_.size(); }  ///< frames in memory

 private:
  struct Settling {
    std::string label;
    int num_searches = 0;  // in a row that found it
  };

  void check(Span<const float> row, double time_s) const;
  [[nodiscard]] bool are_tracks() const;
  bool hold(Span<const float> row);
  void keep(Span<const float> row, double time_s);
  void append_place();
  [[nodiscard]] double change_since_compared() const;
  SentenceEvent wait(bool seen, bool still, double time_s);
  SentenceEvent follow(bool seen, bool still, double time_s);
  SentenceEvent search_so_far(double time_s);
  static bool same_label(const Settling& settling, const RecognisedSign& word);
  void settle(const std::vector<RecognisedSign>& words, std::int64_t num_frames);
  SentenceEvent end(SentenceEventReason reason, double last_s);
  [[nodiscard]] MatrixF rows_until(double last_s) const;
  [[nodiscard]] std::vector<StreamedSign> placed(const RecognisedSentence& found) const;
  [[nodiscard]] std::size_t num_before(double time_s) const;
  void drop(std::size_t count);
  void forget();

  SentenceRecognizer recognizer_;
  SentenceStreamOptions options_;
  std::vector<float> spreads_;  // of the columns that movement is measured by
  std::vector<float> rows_;     // those kept
  std::vector<double> times_;
  std::vector<float> places_;    // what movement is measured by, of the rows kept
  std::int64_t first_kept_ = 0;  // its number in the stream
  std::vector<float> held_;      // what was seen last, column by column
  std::vector<float> dropped_;   // the same before the first row kept
  double time_s_ = -std::numeric_limits<double>::infinity();
  double seen_s_ = -std::numeric_limits<double>::infinity();
  std::optional<double> moving_since_s_;
  std::optional<double> still_since_s_;
  double square_sum_ = 0;  // of distances of hands from the head
  double num_distances_ = 0;
  double change_ = 0;
  bool in_sentence_ = false;
  double first_s_ = 0;
  double next_search_s_ = 0;
  std::vector<Settling> settling_;  // words that have ended
  std::size_t num_stable_ = 0;      // of them, the first
};

}  // namespace hri
