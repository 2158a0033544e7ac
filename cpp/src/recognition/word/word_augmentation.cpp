// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "recognition/word/word_augmentation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "hri/core/error.hpp"
#include "hri/core/kernels.hpp"
#include "hri/core/random.hpp"
#include "hri/signal/resample.hpp"
#include "recognition/word/training_noise.hpp"

namespace hri::detail {
namespace {

// 1, 1 - step, 1 + step, 1 - 2 step, 1 + 2 step: as many as asked for.
std::vector<double> warp_factors(const WordRecognizerOptions& options) {
  std::vector<double> factors{1.0};
  for (int i = 1; static_cast<int>(factors.size()) < options.num_vtlp_factors; ++i) {
    factors.push_back(1.0 - i * options.vtlp_step);
    factors.push_back(1.0 + i * options.vtlp_step);
  }
  return factors;
}

void check(const WordSample& sample, const std::string& name, double frame_ms) {
  const std::size_t bad = first_not_finite(sample.samples.data(), sample.samples.size());
  if (bad < sample.samples.size()) {
    fail(ErrorKind::invalid_argument,
         name + ": audio is not finite at index " + std::to_string(bad));
  }
  const double duration_ms =
      1000.0 * static_cast<double>(sample.samples.size()) / std::max(1, sample.sample_rate_hz);
  if (duration_ms < frame_ms) {
    fail(ErrorKind::invalid_argument, name + ": audio is too short: " +
                                          std::to_string(duration_ms) + " ms, less than one frame");
  }
}

// Speeds of the copies for the embedding, in twentieths.
constexpr std::array<int, 7> kSpeeds{20, 18, 22, 17, 23, 19, 21};

std::vector<float> at_speed(const std::vector<float>& audio, int twentieths) {
  constexpr int kUnitHz = 1000;
  if (twentieths == 20) return audio;
  return resample(audio, twentieths * kUnitHz, 20 * kUnitHz);
}

// Of noise this far below the word.
double noise_power(const TrainingWord& word, double snr_db) {
  return mean_power(word.word.samples) * std::pow(10.0, -snr_db / 10);
}

}  // namespace

WordAugmentation::WordAugmentation(const WordRecognizerOptions& options,
                                   const std::shared_ptr<const SpeechEmbedding>& embedding)
    : options_(validated(options)), front_end_(options, 1, embedding) {
  // The embedding has no filters to warp, and the network's training warps by itself: warped copies
  // have neither of their own.
  if (has_cepstra(options.front_end)) {
    WordRecognizerOptions cepstra_only = options;
    cepstra_only.front_end = FrontEndKind::cepstra;
    cepstra_only.use_network = false;
    for (const double factor : warp_factors(options)) cepstra_.emplace_back(cepstra_only, factor);
  }
  if (const WordSpectrogram* spectrogram = front_end().spectrogram().get())
    spectrograms_ = std::make_shared<const SpectrogramAugmentation>(*spectrogram, options.seed);
}

TrainingWord WordAugmentation::read(const WordSample& sample, const std::string& name) const {
  const double of_cepstra_ms = cepstra_.empty() ? 0.0 : options_.cepstra.frame_length_ms;
  check(sample, name, std::max(options_.activity.frame_ms, of_cepstra_ms));
  TrainingWord result;
  result.word = front_end().trim(sample.samples, sample.sample_rate_hz);
  if (!result.has_speech()) return result;
  if (sample.sample_rate_hz == front_end().sample_rate_hz()) {
    result.clip.assign(sample.samples.begin(), sample.samples.end());
  } else {
    result.clip = resample(sample.samples, sample.sample_rate_hz, front_end().sample_rate_hz());
  }
  return result;
}

double WordAugmentation::random_snr_db(Random* random) const {
  return options_.min_snr_db + random->uniform() * (options_.max_snr_db - options_.min_snr_db);
}

TrimmedWord WordAugmentation::noisy(const std::vector<float>& clip, const TrimmedWord& word,
                                    double power, Random* random) const {
  TrimmedWord result =
      front_end().trim(with_noise(clip, power, random), front_end().sample_rate_hz());
  if (result.has_speech()) return result;
  result.samples = with_noise(word.samples, power, random);
  if (!word.wide.empty()) result.wide = with_noise(word.wide, power, random);
  return result;
}

MatrixF WordAugmentation::vector_of(const TrimmedWord& word) const {
  return front_end().embedding()->vector_of(word.wide, front_end().sample_rate_hz()).transpose();
}

void WordAugmentation::append_embedding_copies(const TrainingWord& word, std::size_t index,
                                               std::vector<StreamFrames>* to) const {
  const auto num_copies = static_cast<std::size_t>(options_.num_embedding_copies);
  Random random(options_.seed + (index + 1) * 0xD6E8FEB86659FD93ULL);
  for (std::size_t copy = 0; copy < num_copies; ++copy) {
    const int speed = kSpeeds[(index * num_copies + copy) % kSpeeds.size()];
    const double power = noise_power(word, random_snr_db(&random));
    const std::vector<float> clip = at_speed(word.clip, speed);
    TrimmedWord said;
    said.samples = at_speed(word.word.samples, speed);
    said.wide = at_speed(word.word.wide, speed);
    to->emplace_back(static_cast<std::size_t>(front_end().num_streams()));
    to->back().push_back(vector_of(noisy(clip, said, power, &random)));
  }
}

std::vector<StreamFrames> WordAugmentation::copies(const TrainingWord& word,
                                                   std::size_t index) const {
  std::vector<StreamFrames> result;
  const bool embedded = front_end().embedding() != nullptr;
  result.push_back(front_end().frames(word.word));
  for (std::size_t warp = 1; warp < cepstra_.size(); ++warp)
    result.push_back(cepstra_[warp].frames(word.word));
  if (embedded) append_embedding_copies(word, index, &result);
  Random random(options_.seed + (index + 1) * 0x9E3779B97F4A7C15ULL);
  for (int copy = 0; copy < options_.num_noisy_copies; ++copy) {
    const double snr_db = random_snr_db(&random);
    const TrimmedWord in_noise = noisy(word.clip, word.word, noise_power(word, snr_db), &random);
    result.emplace_back();
    if (!cepstra_.empty()) {
      const std::size_t warp = (index + static_cast<std::size_t>(copy)) % cepstra_.size();
      result.back() = cepstra_[warp].frames(in_noise);
    }
    if (embedded) result.back().push_back(vector_of(in_noise));
    if (spectrograms_ != nullptr)
      result.back().push_back(spectrograms_->noisy_input(word.word.window, snr_db, &random));
  }
  return result;
}

std::string sample_name(const WordSample& sample, const char* list, std::size_t index) {
  return sample.name.empty() ? std::string(list) + "[" + std::to_string(index) + "]" : sample.name;
}

}  // namespace hri::detail
