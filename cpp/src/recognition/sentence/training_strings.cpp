// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "recognition/sentence/training_strings.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "recognition/word/training_noise.hpp"

namespace hri::detail {
namespace {

constexpr double kNoPauseShare = 0.3;  // of pauses that are none: words run into each other

// What was recorded from `first` on, which may lie before the clip; zeros where nothing was.
void append(const std::vector<float>& clip, std::ptrdiff_t first, std::ptrdiff_t last,
            std::vector<float>* audio) {
  const auto size = static_cast<std::ptrdiff_t>(clip.size());
  for (std::ptrdiff_t n = first; n < last; ++n)
    audio->push_back(n >= 0 && n < size ? clip[static_cast<std::size_t>(n)] : 0.0F);
}

std::uint64_t mixed(std::uint64_t seed, std::uint64_t index) {
  return seed + (index + 1) * 0x9E3779B97F4A7C15ULL;
}

}  // namespace

StringMaker::StringMaker(const ConnectedWordRecognizerOptions& options) : options_(options) {
  const WordRecognizerOptions& words = options.words;
  front_ends_.emplace_back(words);
  for (int i = 1; static_cast<int>(front_ends_.size()) < words.num_vtlp_factors; ++i) {
    front_ends_.emplace_back(words, 1.0 - i * words.vtlp_step);
    front_ends_.emplace_back(words, 1.0 + i * words.vtlp_step);
  }
}

int StringMaker::num_copies() const {
  return static_cast<int>(front_ends_.size()) + options_.words.num_noisy_copies;
}

std::vector<WordString> StringMaker::join(const std::vector<const SpokenWord*>& words,
                                          std::uint64_t seed) const {
  std::map<std::string, std::vector<const SpokenWord*>> groups;
  for (const SpokenWord* word : words) groups[word->group].push_back(word);
  Random random(seed);
  std::vector<WordString> strings;
  for (auto& entry : groups) {
    std::vector<const SpokenWord*>& rest = entry.second;
    for (std::size_t i = rest.size(); i > 1; --i) std::swap(rest[i - 1], rest[random.below(i)]);
    while (!rest.empty()) {
      const std::size_t wanted = 1 + random.below(static_cast<std::uint64_t>(options_.max_words));
      const auto count = static_cast<std::ptrdiff_t>(std::min(wanted, rest.size()));
      strings.push_back(join_one({rest.end() - count, rest.end()}, &random));
      rest.erase(rest.end() - count, rest.end());
    }
  }
  return strings;
}

WordString StringMaker::join_one(const std::vector<const SpokenWord*>& words,
                                 Random* random) const {
  WordString string;
  const auto edge = static_cast<std::ptrdiff_t>(front_end().samples_of(SentenceFrontEnd::kEdgeMs));
  std::ptrdiff_t before = edge;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const SpokenWord& word = *words[i];
    const auto first = static_cast<std::ptrdiff_t>(word.first);
    const auto last = static_cast<std::ptrdiff_t>(word.last);
    append(word.clip, first - before, first, &string.audio);
    string.labels.push_back(word.label);
    string.words.push_back(&word);
    string.firsts.push_back(string.audio.size());
    append(word.clip, first, last, &string.audio);
    string.lasts.push_back(string.audio.size());
    const bool is_last = i + 1 == words.size();
    const double share = random->uniform();
    const double pause_ms = random->uniform() < kNoPauseShare ? 0 : share * options_.max_pause_ms;
    const auto pause = static_cast<std::ptrdiff_t>(front_end().samples_of(pause_ms));
    const std::ptrdiff_t after = is_last ? edge : pause / 2;
    append(word.clip, last, last + after, &string.audio);
    before = pause - after;
  }
  front_end().add_floor(&string.audio);
  return string;
}

std::vector<float> StringMaker::heard(const WordString& string, int copy,
                                      std::uint64_t seed) const {
  const auto num_clean = static_cast<int>(front_ends_.size());
  return copy < num_clean ? string.audio
                          : in_noise(string, mixed(seed, static_cast<std::uint64_t>(copy)));
}

std::vector<float> StringMaker::in_noise(const WordString& string, std::uint64_t seed) const {
  Random random(seed);
  const WordRecognizerOptions& words = options_.words;
  const double snr_db = words.min_snr_db + random.uniform() * (words.max_snr_db - words.min_snr_db);
  return with_noise(string.audio, mean_power(string.audio) * std::pow(10.0, -snr_db / 10), &random);
}

MatrixF StringMaker::frames(const WordString& string, int copy, std::uint64_t seed) const {
  const std::size_t warp = static_cast<std::size_t>(copy) < front_ends_.size()
                               ? static_cast<std::size_t>(copy)
                               : mixed(seed, 0) % front_ends_.size();
  return front_ends_[warp].frames(heard(string, copy, seed));
}

std::vector<DecodedWord> StringMaker::segments(const WordString& string, Eigen::Index num_frames,
                                               int silence) const {
  std::vector<DecodedWord> segments;
  Eigen::Index done = 0;
  const auto add = [&](int model, Eigen::Index last) {
    if (last > done) segments.push_back({model, done, last, 0});
    done = last;
  };
  const auto frames_before = [&](std::size_t sample) {
    Eigen::Index t = done;
    while (t < num_frames &&
           front_end().middle_of(static_cast<double>(t)) < static_cast<double>(sample))
      ++t;
    return t;
  };
  for (std::size_t i = 0; i < string.labels.size(); ++i) {
    add(silence, frames_before(string.firsts[i]));
    add(string.labels[i], frames_before(string.lasts[i]));
  }
  add(silence, num_frames);
  return segments;
}

}  // namespace hri::detail
