// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Endpointing of a stream. A sound above the noise floor becomes speech when it is voiced, and ends
// after enough silence; its end points are then those that find_speech gives for the utterance and
// the silence around it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>

#include "hri/core/export.hpp"
#include "hri/core/options.hpp"
#include "hri/core/types.hpp"
#include "hri/signal/activity.hpp"

namespace hri {

struct EndpointerOptions {
  ActivityOptions activity;
  double hangover_ms = 300;
  double pause_ms = 0;
  double context_ms = 300;
  double max_utterance_ms = 5000;

  static constexpr const char* kName = "EndpointerOptions";
  template <class Self, class Visitor>
  static void visit(Self& o, Visitor&& v) {
    v("activity", o.activity, any_value, "how speech is found");
    v("hangover_ms", o.hangover_ms, within(50, 5000), "silence that ends an utterance");
    v("pause_ms", o.pause_ms, within(0, 5000),
      "silence in an utterance after which what was said so far is reported, as if it ended there; "
      "0: never, as where that is not shorter than hangover_ms");
    v("context_ms", o.context_ms, within(50, 5000),
      "noise kept from before an utterance, to estimate its level");
    v("max_utterance_ms", o.max_utterance_ms, within(500, 60000),
      "longest utterance; a longer one is cut");
  }
};

enum class EndpointKind : std::uint8_t {
  none,
  speech_start,    ///< speech began at `first`
  speech_end,      ///< and has ended: [first, last) is the utterance
  speech_dropped,  ///< rejected: the sound was not speech
  speech_pause,    ///< and goes on, or ends here: [first, last) is the utterance so far
};
constexpr auto enum_names(EndpointKind) {
  return std::array{"none", "speech_start", "speech_end", "speech_dropped", "speech_pause"};
}

/// An event in the stream; all positions are samples since its beginning.
struct Endpoint {
  EndpointKind kind = EndpointKind::none;
  std::size_t at = 0;  ///< samples processed when this was decided
  std::size_t first = 0;
  std::size_t last = 0;
  std::size_t segment_first = 0;  ///< the utterance with the noise around it, for a recogniser that
  std::size_t segment_last = 0;   ///< finds the end points itself
  bool cut = false;               ///< it reached max_utterance_ms
};

/// One stream. Block sizes do not matter: the same samples give the same events at the same places.
/// Nothing is allocated after construction. Not to be shared by threads.
class HRI_API Endpointer {
 public:
  /// Throws InvalidArgument for options out of range and a rate outside 1000..384000 Hz.
  Endpointer(int sample_rate_hz, const EndpointerOptions& options);
  ~Endpointer();
  Endpointer(Endpointer&&) noexcept;
  Endpointer& operator=(Endpointer&&) noexcept;

  /// Processes samples up to the next event, and returns how many; call again with the rest. Throws
  /// InvalidArgument for a sample that is not finite, by its number in the stream, before any is
  /// processed.
  std::size_t consume(Span<const float> samples, Endpoint* event);

  /// The stream has ended: an event if there is another one; call until there is none. Then the
  /// next stream may begin.
  Endpoint finish();

  [[nodiscard]] const EndpointerOptions& options() const;
  [[nodiscard]] std::size_t num_samples() const;  ///< processed so far
  [[nodiscard]] bool in_speech() const;
  [[nodiscard]] float level_db() const;   ///< of the last frame, relative to full scale
  [[nodiscard]] float excess_db() const;  ///< its excess over the noise floor

 private:
  class Stream;
  std::unique_ptr<Stream> stream_;
};

}  // namespace hri
