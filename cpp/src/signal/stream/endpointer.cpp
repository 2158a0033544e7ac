// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/signal/stream/endpointer.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "hri/core/error.hpp"
#include "hri/core/kernels.hpp"
#include "hri/signal/activity_meter.hpp"
#include "signal/word_bounds.hpp"

namespace hri {
namespace {

// How the noise floor follows a band: down at once, up by a share of the difference. In speech
// it rises slowly, so that a word is not mistaken for noise; a fan that starts becomes noise
// within seconds.
constexpr float kFall = 0.1F;
constexpr float kRise = 0.02F;
constexpr float kMaxRiseDbPerS = 10;
constexpr float kMaxRiseInSpeechDbPerS = 2;
// Fewest successive frames of a sound: a single one is a click.
constexpr std::size_t kOnsetFrames = 2;

}  // namespace

class Endpointer::Stream {
 public:
  Stream(int sample_rate_hz, const EndpointerOptions& options)
      : options_(validated(options)),
        sample_rate_hz_(sample_rate_hz),
        meter_(sample_rate_hz, options.activity),
        finder_(meter_, options_.activity) {
    hangover_ = frames_in(options.hangover_ms);
    if (options.pause_ms > 0) pause_ = frames_in(options.pause_ms);
    context_ = frames_in(options.context_ms);
    longest_ = frames_in(options.max_utterance_ms);
    capacity_ = context_ + longest_ + hangover_;
    frames_.reserve(2 * capacity_);
    finder_.reserve(2 * capacity_);
  }

  std::size_t consume(Span<const float> samples, Endpoint* event) {
    *event = {};
    const std::size_t bad = first_not_finite(samples.data(), samples.size());
    if (bad < samples.size()) {
      fail(ErrorKind::invalid_argument,
           "audio is not finite at sample " + std::to_string(num_samples_ + bad));
    }
    std::size_t used = 0;
    while (used < samples.size() && event->kind == EndpointKind::none) {
      ActivityFrame frame;
      bool complete = false;
      const std::size_t taken =
          meter_.take(samples.subspan(used, samples.size() - used), &frame, &complete);
      used += taken;
      num_samples_ += taken;
      if (complete) hear(frame, event);
    }
    return used;
  }

  Endpoint finish() {
    Endpoint event;
    if (state_ == State::speech) {
      end(&event, false);
      return event;
    }
    // What has not been reported is judged as a clip: a recording may begin in the middle of a
    // word.
    const std::size_t begin = std::max(oldest(), reported_);
    if (!frames_.empty() && begin < num_frames_) {
      onset_ = begin;
      const Endpoint found = judge(begin);
      if (found.kind == EndpointKind::speech_end) {
        state_ = State::speech;
        return start_event(found.first);
      }
    }
    reset();
    return event;
  }

  const EndpointerOptions& options() const { return options_; }
  std::size_t num_samples() const { return num_samples_; }
  bool in_speech() const { return state_ == State::speech; }
  float level_db() const { return frames_.empty() ? -120.0F : frames_.back().level_db; }
  float excess_db() const { return over_.all_db; }

 private:
  enum class State : std::uint8_t { silence, sound, speech };

  std::size_t frames_in(double ms) const {
    return static_cast<std::size_t>(std::max(1L, std::lround(ms / options_.activity.shift_ms)));
  }
  std::size_t oldest() const { return num_frames_ - frames_.size(); }

  void hear(const ActivityFrame& frame, Endpoint* event) {
    if (frames_.size() == 2 * capacity_) {
      std::copy(frames_.end() - static_cast<std::ptrdiff_t>(capacity_), frames_.end(),
                frames_.begin());
      frames_.resize(capacity_);
    }
    frames_.push_back(frame);
    if (num_frames_++ == 0) noise_ = frame.band_db;
    over_ = detail::excess(frame, noise_, meter_);
    follow_noise(frame);
    count(frame);
    if (state_ == State::silence && loud_ >= kOnsetFrames) {
      state_ = State::sound;
      onset_ = num_frames_ - loud_;
      voiced_ = 0;
      peak_db_ = -120;
    }
    if (state_ == State::silence) return;
    const float sum = detail::add_voicing(voiced_, frame, over_.low_db);
    if (sum > voiced_) peak_db_ = std::max(peak_db_, frame.level_db);
    voiced_ = sum;
    if (state_ == State::sound) {
      if (voiced_ >= static_cast<float>(options_.activity.min_voicing)) {
        state_ = State::speech;
        *event = start_event(onset_ * meter_.frame_shift());
      } else if (quiet_ >= hangover_) {
        state_ = State::silence;
      } else if (num_frames_ - onset_ > longest_ / 2) {
        onset_ = num_frames_ - longest_ / 2;  // continuing noise: a word may follow within it
      }
    } else if (quiet_ >= hangover_ || num_frames_ - onset_ >= longest_) {
      end(event, quiet_ < hangover_);
    } else if (pause_ > 0 && quiet_ == pause_) {  // once, however long it lasts
      const Endpoint so_far = judge(begin());
      if (so_far.kind != EndpointKind::speech_end) return;
      *event = so_far;
      event->kind = EndpointKind::speech_pause;
    }
  }

  // Counts successive frames above the noise floor, and those since the last one.
  void count(const ActivityFrame& frame) {
    const ActivityOptions& o = options_.activity;
    float lowest = static_cast<float>(o.silence_dbfs);
    if (state_ == State::speech)
      lowest = std::max(lowest, peak_db_ - static_cast<float>(o.max_depth_db));
    const bool active = over_.all_db > static_cast<float>(o.margin_db) && frame.level_db > lowest;
    loud_ = active ? loud_ + 1 : 0;
    quiet_ = loud_ >= kOnsetFrames ? 0 : quiet_ + 1;
  }

  void follow_noise(const ActivityFrame& frame) {
    const float per_s = state_ == State::speech ? kMaxRiseInSpeechDbPerS : kMaxRiseDbPerS;
    const float most = per_s * static_cast<float>(options_.activity.shift_ms / 1000);
    for (std::size_t b = 0; b < static_cast<std::size_t>(meter_.num_bands()); ++b) {
      const float over = frame.band_db[b] - noise_[b];
      noise_[b] += over < 0 ? kFall * over : std::min(kRise * over, most);
    }
  }

  Endpoint start_event(std::size_t first) const {
    Endpoint event;
    event.kind = EndpointKind::speech_start;
    event.at = num_samples_;
    event.first = event.segment_first = first;
    event.last = event.segment_last = num_samples_;
    return event;
  }

  // The end points within the frames since `begin`.
  Endpoint judge(std::size_t begin) {
    const std::size_t skipped = begin - oldest();
    const std::size_t shift = meter_.frame_shift();
    const detail::WordFrames word =
        finder_.find({frames_.data() + skipped, frames_.size() - skipped});
    judged_ = begin + word.last;
    Endpoint event;
    event.at = num_samples_;
    event.segment_first = begin * shift;
    event.segment_last = num_samples_;
    event.kind = word.found ? EndpointKind::speech_end : EndpointKind::speech_dropped;
    const SpeechBounds bounds = detail::to_samples(word, meter_, options_.activity, sample_rate_hz_,
                                                   event.segment_last - event.segment_first);
    event.first = event.segment_first + bounds.first;
    event.last = event.segment_first + bounds.last;
    return event;
  }

  // The frame where the utterance and the noise before it begin.
  std::size_t begin() const {
    const std::size_t earliest = std::max(oldest(), reported_);
    return onset_ > earliest + context_ ? onset_ - context_ : earliest;
  }

  void end(Endpoint* event, bool cut) {
    *event = judge(begin());
    event->cut = cut;
    // The silence after this utterance is also the silence before the next one. Where frames are
    // shorter than their shift, the last one ends before the next begins.
    reported_ = event->kind == EndpointKind::speech_end
                    ? std::max(judged_, event->last / meter_.frame_shift())
                    : num_frames_;
    state_ = State::silence;
    loud_ = 0;
  }

  void reset() {
    meter_.reset();
    frames_.clear();
    num_samples_ = num_frames_ = onset_ = reported_ = judged_ = loud_ = quiet_ = 0;
    voiced_ = 0;
    over_ = {};
    state_ = State::silence;
  }

  EndpointerOptions options_;
  int sample_rate_hz_;
  ActivityMeter meter_;
  detail::WordFinder finder_;
  std::size_t hangover_ = 0;
  std::size_t pause_ = 0;
  std::size_t context_ = 0;
  std::size_t longest_ = 0;
  std::size_t capacity_ = 0;
  std::vector<ActivityFrame> frames_;  // the most recent frames
  detail::NoiseFloor noise_{};
  detail::Excess over_;
  State state_ = State::silence;
  std::size_t num_samples_ = 0;
  std::size_t num_frames_ = 0;
  std::size_t onset_ = 0;     // the frame where the sound began
  std::size_t reported_ = 0;  // frames before this belong to utterances that were reported
  std::size_t judged_ = 0;    // the frame behind the word that was judged last
  std::size_t loud_ = 0;
  std::size_t quiet_ = 0;
  float voiced_ = 0;
  float peak_db_ = -120;
};

Endpointer::Endpointer(int sample_rate_hz, const EndpointerOptions& options)
    : stream_(std::make_unique<Stream>(sample_rate_hz, options)) {}
Endpointer::~Endpointer() = default;
Endpointer::Endpointer(Endpointer&&) noexcept = default;
Endpointer& Endpointer::operator=(Endpointer&&) noexcept = default;

std::size_t Endpointer::consume(Span<const float> samples, Endpoint* event) {
  return stream_->consume(samples, event);
}
Endpoint Endpointer::finish() { return stream_->finish(); }
const EndpointerOptions& Endpointer::options() const { return stream_->options(); }
std::size_t Endpointer::num_samples() const { return stream_->num_samples(); }
bool Endpointer::in_speech() const { return stream_->in_speech(); }
float Endpointer::level_db() const { return stream_->level_db(); }
float Endpointer::excess_db() const { return stream_->excess_db(); }

}  // namespace hri
