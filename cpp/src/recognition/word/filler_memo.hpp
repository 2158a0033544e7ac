// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Filler models depend on the filler words and the options alone, not on the vocabulary: trainings
// of one process, such as the folds of a study, share them.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "hri/recognition/word/word_recognizer.hpp"

namespace hri::detail {

/// What training makes of filler words.
struct TrainedFillers {
  std::vector<FillerModels> models;  ///< of every stream
  ClassSequences vectors;            ///< of every word, where there is a speech embedding
};

/// What `train` gives, or gave for equal words, options and embedding a while ago: the last few
/// results are kept. Safe from several threads, which may then train the same at once.
std::shared_ptr<const TrainedFillers> remembered_fillers(
    const std::vector<WordSample>& fillers, const std::vector<WordSample>& embedding_fillers,
    const WordRecognizerOptions& options, const SpeechEmbedding* embedding,
    const std::function<TrainedFillers()>& train);

}  // namespace hri::detail
