// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// A pretrained speech embedding: log mel energies through a convolutional network that was trained
// on very many words of very many people (Lin et al., "Training keyword spotters with limited and
// synthesized speech data", ICASSP 2020). Its weights are an ONNX file that does not come with
// libhri.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/options.hpp"
#include "hri/core/types.hpp"
#include "hri/features/speech/log_mel.hpp"
#include "hri/models/network/conv_network.hpp"
#include "hri/signal/activity.hpp"

namespace hri {

/// How one word becomes one vector.
struct SpeechEmbeddingOptions {
  bool trim = true;
  ActivityOptions activity = default_activity();
  double level = 0.1;
  double noise_floor_db = 50;
  double padding_s = 0.6;
  int rows_per_step = 2;
  int num_pieces = 6;

  static constexpr const char* kName = "SpeechEmbeddingOptions";
  template <class Self, class Visitor>
  static void visit(Self& o, Visitor&& v) {
    v("trim", o.trim, any_value,
      "trim the clip to the word, and activity.padding_ms before and after it");
    v("activity", o.activity, any_value, "how the word is found in the clip");
    v("level", o.level, within(0.001, 1), "peak that the word is brought to");
    v("noise_floor_db", o.noise_floor_db, within(20, 120),
      "level of the noise added under and around the word, below its peak");
    v("padding_s", o.padding_s, within(0.4, 10), "noise before and after the word");
    v("rows_per_step", o.rows_per_step, within(1, 8),
      "1, 2, 4 or 8: windows begin so many times as often as every 80 ms");
    v("num_pieces", o.num_pieces, within(1, 10),
      "pieces of equal length whose mean embeddings make up the vector");
  }

 private:
  static ActivityOptions default_activity() {
    ActivityOptions activity;
    activity.padding_ms = 100;
    return activity;
  }
};

/// Immutable; const calls are safe from several threads.
class HRI_API SpeechEmbedding {
 public:
  /// Of the audio that the network takes; other rates are resampled.
  static constexpr int kSampleRateHz = 16000;

  /// Throws IoError where the file cannot be read, FormatError, naming it, for anything but a
  /// network over windows of 32 mel bands, and InvalidArgument for options out of range.
  static SpeechEmbedding load(const std::string& path, const SpeechEmbeddingOptions& options = {});
  /// The same from memory; `name` is what errors call it.
  static SpeechEmbedding parse(Span<const std::uint8_t> bytes, const std::string& name,
                               const SpeechEmbeddingOptions& options = {});

  [[nodiscard]] const SpeechEmbeddingOptions& options() const { return options_; }
  /// The same weights with other options. Throws InvalidArgument for options out of range.
  [[nodiscard]] SpeechEmbedding with_options(const SpeechEmbeddingOptions& options) const;
  /// Values of an embedding: 96 of the published network.
  [[nodiscard]] int num_outputs() const { return network_.num_outputs(); }
  /// Values of a word's vector.
  [[nodiscard]] int vector_size() const { return options_.num_pieces * num_outputs(); }
  /// The audio that one embedding is computed from: 0.775 s of the published network.
  [[nodiscard]] double window_s() const;
  /// From one embedding to the next: 0.04 s of the published network, by default.
  [[nodiscard]] double step_s() const;
  /// CRC-32 of the weights, in hexadecimal: models that were trained with them ask for the same.
  [[nodiscard]] const std::string& checksum() const { return checksum_; }

  /// The embeddings of all windows of mono audio, shape (num_windows, num_outputs), as often as
  /// options().rows_per_step says; no row where the audio is shorter than one window. Throws
  /// InvalidArgument for audio that is not finite and for rates out of range.
  [[nodiscard]] MatrixF compute(Span<const float> audio, int sample_rate_hz) const;

  /// One vector of vector_size() values for a word in a recording: trimmed, brought to
  /// one level, padded, and its embeddings averaged piece by piece. Empty without speech. Throws
  /// InvalidArgument as compute() does.
  [[nodiscard]] VectorF word(Span<const float> audio, int sample_rate_hz) const;
  /// The same of a word that is trimmed already, with speech in it or without.
  [[nodiscard]] VectorF vector_of(Span<const float> word, int sample_rate_hz) const;

 private:
  SpeechEmbedding(const ConvNetwork& network, std::string checksum,
                  const SpeechEmbeddingOptions& options);
  [[nodiscard]] bool fits_padding() const;
  [[nodiscard]] std::vector<float> prepared(Span<const float> word) const;

  SpeechEmbeddingOptions options_;
  LogMel mel_;
  ConvNetwork network_;
  std::string checksum_;
};

}  // namespace hri
