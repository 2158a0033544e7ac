// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Connected words from a stream: utterance by utterance, with what is found so far on the way.
// Cepstra are normalised over the utterance, so that what was said at its beginning is scored anew
// as it grows; when it has ended, its words are those of ConnectedWordRecognizer::recognise.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/options.hpp"
#include "hri/core/types.hpp"
#include "hri/recognition/sentence/connected_word_recognizer.hpp"
#include "hri/signal/stream/endpointer.hpp"

namespace hri {

struct ConnectedWordStreamOptions {
  EndpointerOptions endpointer = default_endpointer();
  double partial_ms = 300;
  double partial_share = 0.1;
  int num_alternatives = 0;

  static EndpointerOptions default_endpointer() {
    EndpointerOptions options;
    options.hangover_ms = 700;
    options.max_utterance_ms = 30000;
    return options;
  }

  static constexpr const char* kName = "ConnectedWordStreamOptions";
  template <class Self, class Visitor>
  static void visit(Self& o, Visitor&& v) {
    v("endpointer", o.endpointer, any_value,
      "how utterances are found: pauses between words must not end them, so that hangover_ms is "
      "longer than for single words");
    v("partial_ms", o.partial_ms, within(50, 60000),
      "an utterance is searched again when it has grown by this");
    v("partial_share", o.partial_share, within(0, 10),
      "and by this share of its length, so that long ones do not cost more and more");
    v("num_alternatives", o.num_alternatives, within(0, 1000),
      "sentences to give at the end of an utterance");
  }
};

/// What was found in an utterance, so far or in the end.
struct ConnectedWordResult {
  /// Times from the beginning of the stream. Before the end without confidences.
  Transcript transcript;
  /// So many of the first words are on every path of the search, and were so the last time; they
  /// are kept until the end, where the whole utterance may still correct them.
  int num_stable = 0;
  bool is_final = false;
  double first_s = 0;  ///< of the utterance
  double last_s = 0;
};

/// One stream, for one thread at a time. Memory is bounded by the longest utterance. Block sizes do
/// not matter.
class HRI_API ConnectedWordStream {
 public:
  /// With a `wake_word`, which must be a label, only what is said behind it in an utterance counts,
  /// in alternatives too; there may be fewer of these than were asked for then. Throws
  /// InvalidArgument for options and a rate out of range, and another wake word.
  ConnectedWordStream(ConnectedWordRecognizer recognizer, int sample_rate_hz,
                      const ConnectedWordStreamOptions& options = {}, std::string wake_word = "");

  /// Results up to the end of `samples`, in their order; utterances without a word (behind the wake
  /// word) give none. Throws InvalidArgument for a sample that is not finite, by its number in the
  /// stream.
  std::vector<ConnectedWordResult> process(Span<const float> samples);
  /// The stream has ended: what is left. Then the next one may begin.
  std::vector<ConnectedWordResult> finish();

  [[nodiscard]] const ConnectedWordStreamOptions& options() const { return options_; }
  [[nodiscard]] std::size_t num_samples() const { return endpointer_.num_samples(); }
  [[nodiscard]] std::size_t num_kept() const { return kept_.size(); }  ///< samples in memory

 private:
  void handle(const Endpoint& event, std::vector<ConnectedWordResult>* results);
  void search_so_far(std::vector<ConnectedWordResult>* results);
  [[nodiscard]] Span<const float> kept(std::size_t first, std::size_t last) const;
  // Times of the stream; false where nothing is said behind the wake word.
  bool place(std::size_t first, ConnectedWordResult* result) const;
  // How many words there are up to the wake word and with it: all where it was not said.
  [[nodiscard]] std::size_t num_to_wake_word(const std::vector<TranscribedWord>& words) const;
  // Of alternatives that differ before the wake word only, the best remains.
  void keep_behind_wake_word(std::size_t num_dropped_of_best,
                             std::vector<TranscriptAlternative>* alternatives) const;
  void drop_old();

  ConnectedWordRecognizer recognizer_;
  int sample_rate_hz_;
  ConnectedWordStreamOptions options_;
  std::string wake_word_;
  Endpointer endpointer_;
  std::vector<float> kept_;
  std::size_t first_kept_ = 0;  // its number in the stream
  bool in_speech_ = false;
  std::size_t speech_first_ = 0;
  std::size_t next_search_ = 0;
  std::vector<std::string> last_decided_;
  std::vector<std::string> stable_;
};

}  // namespace hri
