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

/// Features of tracks by the scale, 0: that of the tracks; or rows with their deltas. Throws
/// InvalidArgument as SentenceRecognizer::train() does.
MatrixF sentence_frames(const SentenceRecognizerOptions& options, ConstMatrixRefF input,
                        double scale_px);

/// Throws InvalidArgument for words that are empty, beyond the frames or not in the order of time.
void check_spans(const std::vector<SignedWordSpan>& spans, Eigen::Index num_frames);

/// The first frame of a word and one past the last, widened by so many frames within the sentence.
std::pair<Eigen::Index, Eigen::Index> with_margin(const SignedWordSpan& span, int margin_frames,
                                                  Eigen::Index num_frames);

}  // namespace hri::detail
