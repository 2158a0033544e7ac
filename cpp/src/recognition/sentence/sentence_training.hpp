// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// What the training of SentenceRecognizer and of ConnectedWordRecognizer share, and what the former
// shares with recognition.
#pragma once

#include <utility>
#include <vector>

#include "hri/recognition/sentence/sentence_recognizer.hpp"

namespace hri::detail {

/// Fewest words substituted, deleted and inserted between two label sequences (Levenshtein).
int num_word_errors(const std::vector<int>& truth, const std::vector<int>& found);

/// The probability to stay in the last state, from how long this lasts on average along the best
/// paths of the sequences.
double final_stay(const GaussianMixtureHmm& model, const std::vector<MatrixF>& sequences);

/// One codebook a column of `frames`, by LBG.
MultiStreamCodebook train_column_codebooks(ConstMatrixRefF frames, int num_codewords,
                                           const StopCheck& should_stop);

/// Features of a sentence, and the numbers of those that depend on no hand out of view.
struct SentenceFrames {
  MatrixF features;
  std::vector<int> known_columns;

  [[nodiscard]] bool are_known() const {
    return known_columns.size() == static_cast<std::size_t>(features.cols());
  }
};

/// Features of tracks by the scale, 0: that of the tracks, where these show one hand alone by how
/// far it reaches; or rows with their deltas. Throws InvalidArgument as SentenceRecognizer::train()
/// does.
SentenceFrames sentence_frames(const SentenceRecognizerOptions& options, ConstMatrixRefF input,
                               double scale_px, const HandReaches& reaches);

/// What SentenceRecognizer is trained on.
struct SentencesToTrainOn {
  std::vector<MatrixF> frames;
  HandReaches reaches;
};

/// Features of all samples, whose words are checked, too. A hand that a sentence never shows is
/// where it is on average in the others; where none shows the left one, use_left of the options is
/// cleared. Throws InvalidArgument as SentenceRecognizer::train() does.
SentencesToTrainOn frames_to_train_on(const std::vector<SignedSample>& samples,
                                      SentenceRecognizerOptions* options);

/// Throws InvalidArgument for words that are empty, beyond the frames or not in the order of time.
void check_spans(const std::vector<SignedWordSpan>& spans, Eigen::Index num_frames);

/// The first frame of a word and one past the last, widened by so many frames within the sentence.
std::pair<Eigen::Index, Eigen::Index> with_margin(const SignedWordSpan& span, int margin_frames,
                                                  Eigen::Index num_frames);

}  // namespace hri::detail
