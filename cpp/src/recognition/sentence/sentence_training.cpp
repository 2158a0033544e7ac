// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "recognition/sentence/sentence_training.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "hri/core/error.hpp"
#include "hri/features/speech/dynamics.hpp"

namespace hri::detail {
namespace {

constexpr double kLongestStay = 0.98;
constexpr std::size_t kEnough = 200;

// Whether the row shows a hand. Throws InvalidArgument for a value that is infinite, or NaN beside
// others that are not.
bool shows_hand(ConstMatrixRefF rows, Eigen::Index t) {
  const bool shown = !std::isnan(rows(t, 0));
  for (Eigen::Index c = 0; c < rows.cols(); ++c) {
    if (shown ? std::isfinite(rows(t, c)) : std::isnan(rows(t, c))) continue;
    fail(ErrorKind::invalid_argument, "rows: column " + std::to_string(c) + " of frame " +
                                          std::to_string(t) + " is " + std::to_string(rows(t, c)) +
                                          ", must be finite, or the whole frame NaN");
  }
  return shown;
}

MatrixF frames_of_rows(const TwoHandFeatureOptions& options, ConstMatrixRefF rows) {
  require(rows.rows() > 0 && rows.cols() > 0, "rows must have at least one row and one column");
  const Eigen::Index width = rows.cols();
  MatrixF frames(rows.rows(), width * (1 + options.delta_orders));
  Eigen::Index last = -1;
  for (Eigen::Index t = 0; t < rows.rows(); ++t) {
    if (!shows_hand(rows, t)) {
      if (last >= 0) frames.row(t).head(width) = rows.row(last);
      continue;
    }
    if (last < 0) frames.topLeftCorner(t, width).rowwise() = rows.row(t);
    frames.row(t).head(width) = rows.row(t);
    last = t;
  }
  require(last >= 0, "rows: no frame shows a hand");
  for (int order = 0; order < options.delta_orders; ++order)
    append_deltas(frames, order * width, width, options.delta_window);
  return frames;
}

}  // namespace

MultiStreamCodebook train_column_codebooks(ConstMatrixRefF frames, int num_codewords,
                                           const StopCheck& should_stop) {
  CodebookOptions options;
  options.num_codewords = num_codewords;
  options.should_stop = should_stop;
  const std::vector<int> widths(static_cast<std::size_t>(frames.cols()), 1);
  return MultiStreamCodebook::train_lbg(frames, widths, options);
}

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

MatrixF sentence_frames(const SentenceRecognizerOptions& options, ConstMatrixRefF input,
                        double scale_px) {
  if (options.input == SentenceInput::rows) {
    require(scale_px == 0, "scale_px is of tracks, rows have none");
    return frames_of_rows(options.features, input);
  }
  const TwoHandFeatureComputer features(options.features);
  return scale_px == 0 ? features.compute(input) : features.compute(input, scale_px);
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

std::pair<Eigen::Index, Eigen::Index> with_margin(const SignedWordSpan& span, int margin_frames,
                                                  Eigen::Index num_frames) {
  return {std::max<Eigen::Index>(0, span.first_frame - margin_frames),
          std::min<Eigen::Index>(num_frames, span.last_frame + margin_frames)};
}

}  // namespace hri::detail
