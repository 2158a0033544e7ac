// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/recognition/word/speech_embedding.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>
#include <vector>

#include "hri/core/error.hpp"
#include "hri/core/kernels.hpp"
#include "hri/io/crc32.hpp"
#include "hri/io/file.hpp"
#include "hri/models/network/onnx_network.hpp"
#include "hri/signal/resample.hpp"
#include "recognition/word/word_trimming.hpp"

namespace hri {
namespace {

constexpr std::uint64_t kMaxBytes = std::uint64_t{1} << 25U;
// The network's input from decibels, as it was trained.
constexpr float kDecibelsPerUnit = 10;
constexpr float kOffset = 2;

std::string hexadecimal(std::uint32_t value) {
  char text[9];
  std::snprintf(text, sizeof(text), "%08x", static_cast<unsigned>(value));
  return text;
}

}  // namespace

SpeechEmbedding::SpeechEmbedding(const ConvNetwork& network, std::string checksum,
                                 const SpeechEmbeddingOptions& options)
    : options_(validated(options)),
      mel_(LogMel::speech_embedding()),
      network_(network),
      checksum_(std::move(checksum)) {
  require(network_.step_frames() % options_.rows_per_step == 0,
          "rows_per_step must divide the frames from one embedding to the next");
}

SpeechEmbedding SpeechEmbedding::load(const std::string& path,
                                      const SpeechEmbeddingOptions& options) {
  const std::vector<std::uint8_t> bytes = read_file(path, kMaxBytes);
  return parse({bytes.data(), bytes.size()}, path, options);
}

SpeechEmbedding SpeechEmbedding::parse(Span<const std::uint8_t> bytes, const std::string& name,
                                       const SpeechEmbeddingOptions& options) {
  SpeechEmbedding embedding(parse_onnx_network(bytes, name), hexadecimal(crc32(bytes)), options);
  const int bands = embedding.mel_.options().num_filters;
  if (embedding.network_.num_bands() != bands) {
    fail(ErrorKind::format, name + ": the network takes " +
                                std::to_string(embedding.network_.num_bands()) +
                                " bands, a speech embedding takes " + std::to_string(bands));
  }
  if (!embedding.fits_padding()) {
    fail(ErrorKind::format, name + ": its windows of " + std::to_string(embedding.window_s()) +
                                " s are longer than twice padding_s");
  }
  return embedding;
}

SpeechEmbedding SpeechEmbedding::with_options(const SpeechEmbeddingOptions& options) const {
  SpeechEmbedding embedding(network_, checksum_, options);
  require(embedding.fits_padding(), "padding_s must be at least half of a window of the network");
  return embedding;
}

bool SpeechEmbedding::fits_padding() const { return window_s() <= 2 * options_.padding_s; }

double SpeechEmbedding::window_s() const {
  const CepstraOptions& mel = mel_.options();
  return ((network_.window_frames() - 1) * mel.frame_shift_ms + mel.frame_length_ms) / 1000;
}

double SpeechEmbedding::step_s() const {
  return network_.step_frames() * mel_.options().frame_shift_ms / options_.rows_per_step / 1000;
}

MatrixF SpeechEmbedding::compute(Span<const float> audio, int sample_rate_hz) const {
  std::vector<float> resampled;
  if (sample_rate_hz != kSampleRateHz) {
    resampled = resample(audio, sample_rate_hz, kSampleRateHz);
    audio = {resampled.data(), resampled.size()};
  }
  MatrixF mel = mel_.compute(audio);
  mel = (mel.array() / kDecibelsPerUnit + kOffset).matrix().eval();
  return network_.compute(mel, options_.rows_per_step);
}

std::vector<float> SpeechEmbedding::prepared(Span<const float> word) const {
  const auto padding = static_cast<std::size_t>(std::lround(options_.padding_s * kSampleRateHz));
  float peak = 0;
  for (const float x : word) peak = std::max(peak, std::abs(x));
  if (peak == 0) peak = 1;
  const auto level = static_cast<float>(options_.level);
  std::vector<float> result(word.size() + 2 * padding, 0.0F);
  for (std::size_t n = 0; n < word.size(); ++n) result[padding + n] = word[n] / peak * level;
  detail::add_noise_floor(options_.level * std::pow(10.0, -options_.noise_floor_db / 20), &result);
  return result;
}

VectorF SpeechEmbedding::word(Span<const float> audio, int sample_rate_hz) const {
  std::vector<float> resampled;
  if (sample_rate_hz != kSampleRateHz) {
    resampled = resample(audio, sample_rate_hz, kSampleRateHz);
    audio = {resampled.data(), resampled.size()};
  }
  const std::size_t bad = first_not_finite(audio.data(), audio.size());
  if (bad < audio.size())
    fail(ErrorKind::invalid_argument, "audio is not finite at sample " + std::to_string(bad));
  const SpeechBounds speech = find_speech(audio, kSampleRateHz, options_.activity);
  if (!speech.found) return {};
  if (options_.trim) audio = {audio.data() + speech.first, speech.last - speech.first};
  return vector_of(audio, kSampleRateHz);
}

VectorF SpeechEmbedding::vector_of(Span<const float> word, int sample_rate_hz) const {
  std::vector<float> resampled;
  if (sample_rate_hz != kSampleRateHz) {
    resampled = resample(word, sample_rate_hz, kSampleRateHz);
    word = {resampled.data(), resampled.size()};
  }
  const std::vector<float> samples = prepared(word);
  const MatrixF rows = compute({samples.data(), samples.size()}, kSampleRateHz);
  const int pieces = options_.num_pieces;
  VectorF result(vector_size());
  for (int p = 0; p < pieces; ++p) {
    const Eigen::Index first = rows.rows() * p / pieces;
    const Eigen::Index last = std::max(first + 1, rows.rows() * (p + 1) / pieces);
    result.segment(static_cast<Eigen::Index>(p) * num_outputs(), num_outputs()) =
        rows.middleRows(first, last - first).colwise().mean();
  }
  return result;
}

}  // namespace hri
