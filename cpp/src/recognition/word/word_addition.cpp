// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Words added to a trained WordRecognizer, and taken away.
#include <algorithm>
#include <utility>

#include "hri/core/error.hpp"
#include "hri/recognition/word/word_recognizer.hpp"
#include "recognition/word/word_frames.hpp"

namespace hri {
namespace {

// The label of the new word, which is no label yet.
std::string new_label(const std::vector<std::string>& labels,
                      const std::vector<WordSample>& samples) {
  require(!samples.empty(), "a new word needs at least one recording");
  const std::string& label = samples.front().label;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (samples[i].label == label) continue;
    fail(ErrorKind::invalid_argument, "sample " + std::to_string(i) + ": label '" +
                                          samples[i].label + "' is another word than '" + label +
                                          "'");
  }
  if (std::binary_search(labels.begin(), labels.end(), label))
    fail(ErrorKind::invalid_argument, "label '" + label + "': the recogniser has this word");
  return label;
}

}  // namespace

WordRecognizer WordRecognizer::with_word(const std::vector<WordSample>& samples,
                                         const StopCheck& should_stop) const {
  std::vector<std::string> labels = labels_;
  labels.push_back(new_label(labels_, samples));
  const std::string label = labels.back();
  WordRecognizer result = *this;
  result.labels_ = sorted_labels(labels);
  const int index = label_index(result.labels_, label);
  result.calibration_ = calibration_.with_class(index);

  const WordFrames frames(*this);
  std::vector<std::vector<MatrixF>> per_stream(streams_.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    poll(should_stop);
    const std::vector<float> word = frames.locate(samples[i], "sample " + std::to_string(i));
    // Of three recordings none may be lost without a word.
    if (word.empty())
      fail(ErrorKind::invalid_argument, "sample " + std::to_string(i) + ": nobody speaks in it");
    for (std::vector<MatrixF>& streams : frames.of(word, i)) {
      for (std::size_t s = 0; s < per_stream.size(); ++s)
        per_stream[s].push_back(std::move(streams[s]));
    }
  }
  for (std::size_t s = 0; s < per_stream.size(); ++s) {
    result.streams_[s].models = streams_[s].models.with_class(
        index, per_stream[s], static_cast<int>(samples.size()), should_stop);
  }
  return result;
}

WordRecognizer WordRecognizer::without_word(const std::string& label) const {
  if (!std::binary_search(labels_.begin(), labels_.end(), label))
    fail(ErrorKind::invalid_argument, "label '" + label + "': the recogniser has no such word");
  require(labels_.size() > 2,
          "labels: a recogniser needs at least 2 words, so none can be removed");
  const int index = label_index(labels_, label);
  WordRecognizer result = *this;
  result.labels_.erase(result.labels_.begin() + index);
  result.calibration_ = calibration_.without_class(index);
  for (WordStream& stream : result.streams_) stream.models = stream.models.without_class(index);
  return result;
}

}  // namespace hri
