// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Words added to a trained WordRecognizer, and removed.
#include <algorithm>
#include <utility>

#include "hri/core/error.hpp"
#include "hri/recognition/word/word_recognizer.hpp"
#include "recognition/word/word_augmentation.hpp"

namespace hri {
namespace {

using detail::sample_name;

// The label that all samples share, checked to be new.
std::string new_label(const std::vector<std::string>& labels,
                      const std::vector<WordSample>& samples) {
  require(!samples.empty(), "a new word needs at least one recording");
  const std::string& label = samples.front().label;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (samples[i].label == label) continue;
    fail(ErrorKind::invalid_argument, sample_name(samples[i], "samples", i) + ": label '" +
                                          samples[i].label + "' differs from '" + label + "'");
  }
  if (std::binary_search(labels.begin(), labels.end(), label))
    fail(ErrorKind::invalid_argument, "label '" + label + "' is in the vocabulary already");
  return label;
}

// The frames of every sample and of its augmented copies.
std::vector<StreamFrames> augmented(const std::vector<WordSample>& samples,
                                    const WordRecognizerOptions& options,
                                    const std::shared_ptr<const SpeechEmbedding>& embedding,
                                    const StopCheck& should_stop) {
  const detail::WordAugmentation augmentation(options, embedding);
  std::vector<StreamFrames> result;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    poll(should_stop);
    const std::string name = sample_name(samples[i], "samples", i);
    const detail::TrainingWord word = augmentation.read(samples[i], name);
    // Of three recordings none may be dropped silently.
    if (!word.has_speech()) fail(ErrorKind::invalid_argument, name + ": audio has no speech in it");
    for (StreamFrames& copy : augmentation.copies(word, i)) result.push_back(std::move(copy));
  }
  return result;
}

}  // namespace

WordRecognizer WordRecognizer::with_word(const std::vector<WordSample>& samples,
                                         const StopCheck& should_stop) const {
  const std::string label = new_label(labels_, samples);
  std::vector<std::string> labels = labels_;
  labels.push_back(label);
  labels = sorted_labels(labels);
  const std::vector<StreamFrames> frames =
      augmented(samples, options_, front_end_.embedding(), should_stop);
  std::vector<const StreamFrames*> sequences;
  sequences.reserve(frames.size());
  for (const StreamFrames& copy : frames) sequences.push_back(&copy);
  const int index = label_index(labels, label);
  MultiStreamScorer scorer =
      scorer_.with_class(index, sequences, static_cast<int>(samples.size()), should_stop);
  return {options_,
          std::move(labels),
          std::move(scorer),
          verifier_,
          calibration_.with_class(index),
          front_end_.embedding(),
          held_out_};
}

WordRecognizer WordRecognizer::without_word(const std::string& label) const {
  if (!std::binary_search(labels_.begin(), labels_.end(), label))
    fail(ErrorKind::invalid_argument, "label '" + label + "' is not in the vocabulary");
  require(labels_.size() > 2,
          "labels: a recogniser needs at least 2 words, so none can be removed");
  const int index = label_index(labels_, label);
  std::vector<std::string> labels = labels_;
  labels.erase(labels.begin() + index);
  return {options_,
          std::move(labels),
          scorer_.without_class(index),
          verifier_,
          calibration_.without_class(index),
          front_end_.embedding(),
          held_out_.without(label)};
}

}  // namespace hri
