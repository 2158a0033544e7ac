// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "recognition/word/filler_memo.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>

#include "io/option_fields.hpp"

#if defined(__cpp_exceptions)
#include <mutex>
#endif

namespace hri::detail {
#if defined(__cpp_exceptions)
namespace {

constexpr std::size_t kMostKept = 4;

// 128 bits of audio: two sums of 64 bits, each of a mix of its own.
class Digest {
 public:
  void add(std::uint64_t value) {
    first_ = (first_ ^ value) * 0x9E3779B97F4A7C15ULL;
    first_ ^= first_ >> 29U;
    second_ = (second_ + value) * 0xD6E8FEB86659FD93ULL;
    second_ ^= second_ >> 32U;
  }
  void add(Span<const float> samples) {
    add(samples.size());
    for (const float x : samples) {
      std::uint32_t bits = 0;
      std::memcpy(&bits, &x, sizeof(bits));
      add(bits);
    }
  }
  [[nodiscard]] std::string text() const {
    return std::to_string(first_) + " " + std::to_string(second_);
  }

 private:
  std::uint64_t first_ = 0;
  std::uint64_t second_ = 0;
};

void add_words(const std::vector<WordSample>& words, const std::string& name, ModelFile* file) {
  Digest digest;
  std::vector<std::string> labels;
  for (const WordSample& word : words) {
    labels.push_back(word.label);
    digest.add(static_cast<std::uint64_t>(word.sample_rate_hz));
    digest.add(word.samples);
  }
  file->set_text_list(name + ".labels", labels);
  file->set_text(name + ".audio", digest.text());
}

std::string key_of(const std::vector<WordSample>& fillers,
                   const std::vector<WordSample>& embedding_fillers,
                   const WordRecognizerOptions& options, const SpeechEmbedding* embedding) {
  ModelFile file;
  file.set_kind("fillers");
  write_options(options, file);
  if (embedding != nullptr) {
    file.set_text("embedding.checksum", embedding->checksum());
    write_options(embedding->options(), file, "embedding.");
  }
  add_words(fillers, "fillers", &file);
  add_words(embedding_fillers, "embedding_fillers", &file);
  const std::vector<std::uint8_t> bytes = file.serialise();
  return {bytes.begin(), bytes.end()};
}

struct Kept {
  std::string key;
  std::shared_ptr<const TrainedFillers> fillers;
};

class Memo {
 public:
  std::shared_ptr<const TrainedFillers> find(const std::string& key) {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto found =
        std::find_if(kept_.begin(), kept_.end(), [&](const Kept& k) { return k.key == key; });
    if (found == kept_.end()) return nullptr;
    std::rotate(kept_.begin(), found, found + 1);
    return kept_.front().fillers;
  }
  void keep(std::string key, std::shared_ptr<const TrainedFillers> fillers) {
    const std::lock_guard<std::mutex> lock(mutex_);
    kept_.insert(kept_.begin(), {std::move(key), std::move(fillers)});
    if (kept_.size() > kMostKept) kept_.pop_back();
  }

 private:
  std::mutex mutex_;
  std::vector<Kept> kept_;  // the last used first
};

}  // namespace
#endif

std::shared_ptr<const TrainedFillers> remembered_fillers(
    const std::vector<WordSample>& fillers, const std::vector<WordSample>& embedding_fillers,
    const WordRecognizerOptions& options, const SpeechEmbedding* embedding,
    const std::function<TrainedFillers()>& train) {
#if defined(__cpp_exceptions)
  static Memo memo;
  std::string key = key_of(fillers, embedding_fillers, options, embedding);
  if (auto known = memo.find(key)) return known;
  auto trained = std::make_shared<const TrainedFillers>(train());
  memo.keep(std::move(key), trained);
  return trained;
#else
  static_cast<void>(fillers);
  static_cast<void>(embedding_fillers);
  static_cast<void>(options);
  static_cast<void>(embedding);
  return std::make_shared<const TrainedFillers>(train());
#endif
}

}  // namespace hri::detail
