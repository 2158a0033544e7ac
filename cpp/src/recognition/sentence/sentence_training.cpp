// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "recognition/sentence/sentence_training.hpp"

#include <algorithm>
#include <limits>
#include <string>

#include "hri/core/error.hpp"

namespace hri::detail {
namespace {

constexpr double kLongestStay = 0.98;
constexpr std::size_t kEnough = 200;

}  // namespace

int num_word_errors(const std::vector<int>& truth, const std::vector<int>& found) {
  std::vector<int> row(found.size() + 1);
  for (std::size_t j = 0; j < row.size(); ++j) row[j] = static_cast<int>(j);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    int diagonal = row[0]++;
    for (std::size_t j = 0; j < found.size(); ++j) {
      const int substituted = diagonal + (truth[i] == found[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({substituted, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

double final_stay(const GaussianMixtureHmm& model, const std::vector<MatrixF>& sequences) {
  double frames = 0;
  double visits = 0;
  std::vector<int> path;
  for (std::size_t i = 0; i < std::min(sequences.size(), kEnough); ++i) {
    if (model.viterbi(sequences[i], &path) == -std::numeric_limits<double>::infinity()) continue;
    const auto last = std::count(path.begin(), path.end(), model.num_states() - 1);
    frames += static_cast<double>(last);
    visits += last > 0 ? 1 : 0;
  }
  return visits > 0 ? std::min(1 - visits / frames, kLongestStay) : 0.5;
}

MatrixF sentence_frames(const TwoHandFeatureComputer& features, ConstMatrixRefF tracks,
                        double scale_px) {
  return scale_px == 0 ? features.compute(tracks) : features.compute(tracks, scale_px);
}

void check_spans(const std::vector<SignedWordSpan>& spans, Eigen::Index num_frames) {
  std::int64_t before = 0;
  for (std::size_t i = 0; i < spans.size(); ++i) {
    const SignedWordSpan& span = spans[i];
    if (span.first_frame < before || span.last_frame <= span.first_frame ||
        span.last_frame > num_frames) {
      fail(ErrorKind::invalid_argument,
           "words: " + std::to_string(i) + " has frames " + std::to_string(span.first_frame) +
               ".." + std::to_string(span.last_frame) +
               ", must not be empty, begin before the word before it, or end after frame " +
               std::to_string(num_frames));
    }
    before = span.first_frame;
  }
}

}  // namespace hri::detail
