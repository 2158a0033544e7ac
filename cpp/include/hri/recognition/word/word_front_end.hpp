// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// From a recording of one word to what is scored: resampling, endpointing, trimming to the word
// over a noise floor, cepstra (thesis section 6.2), and where asked for the vector of a speech
// embedding beside them or in their place.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/types.hpp"
#include "hri/features/speech/cepstra.hpp"
#include "hri/recognition/word/multi_stream_scorer.hpp"
#include "hri/recognition/word/speech_embedding.hpp"
#include "hri/recognition/word/word_spectrogram.hpp"
#include "hri/signal/activity.hpp"

namespace hri {

struct WordRecognizerOptions;

/// A word trimmed out of a recording, at the rate of the front end.
struct TrimmedWord {
  std::vector<float> samples;      ///< empty without speech
  std::vector<float> wide;         ///< what the embedding reads, where there is one
  MatrixF window;                  ///< WordSpectrogram::window() around it, where that is read
  std::vector<std::string> notes;  ///< what was converted or assumed on the way

  [[nodiscard]] bool has_speech() const { return !samples.empty(); }
};

/// What a recogniser scores.
struct WordFeatures {
  StreamFrames streams;            ///< WordFrontEnd::frames(); empty without speech
  std::vector<std::string> notes;  ///< as of TrimmedWord

  [[nodiscard]] bool has_speech() const { return !streams.empty(); }
};

/// Immutable; const calls are safe from several threads.
class HRI_API WordFrontEnd {
 public:
  /// Every filter bank has its frequency axis warped by `warp_factor`, on top of
  /// options.cepstra.warp. Throws InvalidArgument naming the option that is out of range, and where
  /// options.front_end asks for an embedding that is not given, or does not.
  explicit WordFrontEnd(const WordRecognizerOptions& options, double warp_factor = 1,
                        std::shared_ptr<const SpeechEmbedding> embedding = nullptr);

  /// trim(), then frames().
  [[nodiscard]] WordFeatures process(Span<const float> audio, int sample_rate_hz) const;

  /// Finds the word in `audio` and trims to it; other sample rates are resampled, which a note
  /// says, as one does of several utterances. Throws InvalidArgument for a sample that is not
  /// finite, for audio shorter than one frame and for a sample rate out of range. The embedding
  /// reads the word with padding of its own: that of SpeechEmbeddingOptions::activity.
  [[nodiscard]] TrimmedWord trim(Span<const float> audio, int sample_rate_hz) const;

  /// The cepstra of every stream of a trimmed word, where there are such, and behind them, where
  /// they are used, its embedding, one row, and WordSpectrogram::input().
  [[nodiscard]] StreamFrames frames(const TrimmedWord& word) const;
  /// `audio` as it is, as if it were trimmed, in the middle of silence.
  [[nodiscard]] TrimmedWord untrimmed(std::vector<float> audio) const;
  /// Whether a word of so many samples is long enough for frames(): the embedding takes any.
  [[nodiscard]] bool is_long_enough(std::size_t num_samples) const;

  /// nullptr: there is none.
  [[nodiscard]] const std::shared_ptr<const SpeechEmbedding>& embedding() const {
    return embedding_;
  }
  /// nullptr: none is read.
  [[nodiscard]] const std::shared_ptr<const WordSpectrogram>& spectrogram() const {
    return spectrogram_;
  }
  [[nodiscard]] int sample_rate_hz() const { return sample_rate_hz_; }
  /// Of cepstra; 0: the embedding is alone.
  [[nodiscard]] int num_streams() const { return static_cast<int>(streams_.size()); }
  /// Of a frame of every stream; 0 where there are none.
  [[nodiscard]] int num_features() const {
    return streams_.empty() ? 0 : streams_.front().num_features();
  }

 private:
  [[nodiscard]] std::vector<float> cut(Span<const float> audio, const SpeechBounds& speech,
                                       double padding_ms) const;

  int sample_rate_hz_;
  ActivityOptions activity_;
  bool trim_;
  double noise_floor_db_;
  std::vector<CepstraComputer> streams_;
  std::shared_ptr<const SpeechEmbedding> embedding_;
  std::shared_ptr<const WordSpectrogram> spectrogram_;
};

}  // namespace hri
