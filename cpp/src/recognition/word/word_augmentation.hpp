// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// The training frames of a recording: its own and those of its augmented copies, by vocal-tract-
// length perturbation (a warped frequency axis), added noise and, for the embedding, other speeds.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "hri/core/random.hpp"
#include "hri/recognition/word/word_front_end.hpp"
#include "hri/recognition/word/word_recognizer.hpp"
#include "recognition/word/spectrogram_augmentation.hpp"

namespace hri::detail {

/// A recording of a word, at the rate of the front end.
struct TrainingWord {
  std::vector<float> clip;  ///< as recorded
  TrimmedWord word;

  [[nodiscard]] bool has_speech() const { return word.has_speech(); }
};

class WordAugmentation {
 public:
  /// Throws InvalidArgument naming the option of VTLP or noise that is out of range.
  explicit WordAugmentation(const WordRecognizerOptions& options,
                            const std::shared_ptr<const SpeechEmbedding>& embedding = nullptr);

  /// The front end without warp.
  [[nodiscard]] const WordFrontEnd& front_end() const { return front_end_; }

  /// A recording and the word in it; empty without speech. Throws InvalidArgument for audio that
  /// is not finite or too short, naming the sample or, if it has no name, `name`.
  [[nodiscard]] TrainingWord read(const WordSample& sample, const std::string& name) const;

  /// The frames of the word as it is, at every warp, of every copy for the embedding alone, whose
  /// streams are empty, and of every noisy copy. All that have noise are trimmed after it is added:
  /// end points in noise are others. The noise depends on the seed of the models and on `index`
  /// alone.
  [[nodiscard]] std::vector<StreamFrames> copies(const TrainingWord& word, std::size_t index) const;

  /// nullptr: there is no network.
  [[nodiscard]] const SpectrogramAugmentation* spectrograms() const { return spectrograms_.get(); }

 private:
  // Signal-to-noise ratio of the next copy.
  [[nodiscard]] double random_snr_db(Random* random) const;
  // The word in `clip` with noise of this power added; where noise hides it, `word` with noise.
  [[nodiscard]] TrimmedWord noisy(const std::vector<float>& clip, const TrimmedWord& word,
                                  double power, Random* random) const;
  [[nodiscard]] MatrixF vector_of(const TrimmedWord& word) const;
  void append_embedding_copies(const TrainingWord& word, std::size_t index,
                               std::vector<StreamFrames>* to) const;

  WordRecognizerOptions options_;
  WordFrontEnd front_end_;
  std::vector<WordFrontEnd> cepstra_;  // at every warp, the first of 1; none: there are no cepstra
  std::shared_ptr<const SpectrogramAugmentation> spectrograms_;
};

/// What errors call recording `index` of the argument `list`: its own name, or "list[index]".
std::string sample_name(const WordSample& sample, const char* list, std::size_t index);

}  // namespace hri::detail
