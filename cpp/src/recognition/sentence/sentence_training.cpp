// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "recognition/sentence/sentence_training.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

#include "hri/core/error.hpp"
#include "hri/features/speech/dynamics.hpp"
#include "recognition/sentence/naming.hpp"

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

// Whether any frame shows the point whose first column this is.
bool shows(ConstMatrixRefF tracks, Eigen::Index column) {
  return !tracks.col(column).array().isNaN().all();
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

// The distance from the origin that all but a twentieth of the points keep within. A hand that
// rests is about as far from the head as it gets: unlike the mean distance this hardly depends on
// the signs.
double reach(std::vector<double> distances) {
  if (distances.empty()) return 0;
  const auto place = distances.begin() +
                     static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(distances.size() - 1));
  std::nth_element(distances.begin(), place, distances.end());
  return *place;
}

// Of the point in the columns from `column` on, from that in those from `origin` on.
double reach_px(ConstMatrixRefF tracks, Eigen::Index column, Eigen::Index origin) {
  std::vector<double> distances;
  for (Eigen::Index t = 0; t < tracks.rows(); ++t) {
    const double distance =
        std::hypot(static_cast<double>(tracks(t, column)) - tracks(t, origin),
                   static_cast<double>(tracks(t, column + 1)) - tracks(t, origin + 1));
    if (!std::isnan(distance)) distances.push_back(distance);
  }
  return reach(std::move(distances));
}

// What is not looked at does not count.
double scale_of(const TwoHandFeatureOptions& options, ConstMatrixRefF tracks,
                const HandReaches& reaches) {
  constexpr Eigen::Index kLeft = 0;
  constexpr Eigen::Index kRight = 2;
  constexpr Eigen::Index kReference = 4;
  if (!options.use_left) {
    MatrixF of_right = tracks;
    of_right.leftCols(2).setConstant(std::numeric_limits<float>::quiet_NaN());
    return hand_scale_px(of_right);
  }
  const double scale = hand_scale_px(tracks);
  const bool left = shows(tracks, kLeft);
  if (left && shows(tracks, kRight)) return scale;
  const double usual = left ? reaches.left : reaches.right;
  const double own = reach_px(tracks, left ? kLeft : kRight, kReference);
  return usual > 0 && own > 0 ? own / usual : scale;
}

bool knows(const SentenceFrames& frames, int column) {
  return std::binary_search(frames.known_columns.begin(), frames.known_columns.end(), column);
}

// The first features of tracks are x and y of the right hand, then of the left one.
bool shows_right(const SentenceFrames& frames) { return knows(frames, 0); }
bool shows_left(const SentenceFrames& frames) { return knows(frames, 2); }

std::vector<SentenceFrames> frames_of_all(const std::vector<SignedSample>& samples,
                                          const SentenceRecognizerOptions& options) {
  std::vector<SentenceFrames> frames;
  for (const SignedSample& sample : samples) {
    naming(sample.name, [&] {
      frames.push_back(sentence_frames(options, sample.tracks, sample.scale_px, {}));
      require(frames.back().features.cols() == frames.front().features.cols(),
              "rows do not have as many columns as those of the first sentence");
      check_spans(sample.words, frames.back().features.rows());
    });
  }
  return frames;
}

// By the sentences that show both hands, in the units of the features.
HandReaches reaches_of(const std::vector<SentenceFrames>& frames) {
  std::vector<double> right;
  std::vector<double> left;
  for (const SentenceFrames& one : frames) {
    if (!shows_right(one) || !shows_left(one)) continue;
    for (Eigen::Index t = 0; t < one.features.rows(); ++t) {
      right.push_back(std::hypot(one.features(t, 0), one.features(t, 1)));
      left.push_back(std::hypot(one.features(t, 2), one.features(t, 3)));
    }
  }
  return {reach(std::move(right)), reach(std::move(left))};
}

// Of every column over the frames of the sentences that know it.
VectorD column_means(const std::vector<SentenceFrames>& frames) {
  VectorD sums = VectorD::Zero(frames.front().features.cols());
  VectorD counts = VectorD::Zero(sums.size());
  for (const SentenceFrames& one : frames) {
    for (const int c : one.known_columns) {
      sums[c] += one.features.col(c).cast<double>().sum();
      counts[c] += static_cast<double>(one.features.rows());
    }
  }
  return sums.cwiseQuotient(counts.cwiseMax(1));
}

}  // namespace

SentencesToTrainOn frames_to_train_on(const std::vector<SignedSample>& samples,
                                      SentenceRecognizerOptions* options) {
  SentencesToTrainOn result;
  std::vector<SentenceFrames> frames = frames_of_all(samples, *options);
  if (options->input == SentenceInput::tracks && !frames.empty()) {
    require(std::any_of(frames.begin(), frames.end(), shows_right),
            "tracks: no sentence shows the right hand; where signers sign with the left one alone, "
            "give it as the right one, its x mirrored");
    if (options->features.use_left && std::none_of(frames.begin(), frames.end(), shows_left)) {
      options->features.use_left = options->features.use_relation = false;
      frames = frames_of_all(samples, *options);
    }
    if (options->features.use_left) result.reaches = reaches_of(frames);
  }
  if (!std::all_of(frames.begin(), frames.end(), [](const auto& one) { return one.are_known(); })) {
    for (std::size_t i = 0; i < samples.size(); ++i) {
      if (!frames[i].are_known())
        frames[i] =
            sentence_frames(*options, samples[i].tracks, samples[i].scale_px, result.reaches);
    }
    const VectorD means = column_means(frames);
    for (SentenceFrames& one : frames) {
      for (Eigen::Index c = 0; c < means.size(); ++c) {
        if (!knows(one, static_cast<int>(c)))
          one.features.col(c).setConstant(static_cast<float>(means[c]));
      }
    }
  }
  for (SentenceFrames& one : frames) result.frames.push_back(std::move(one.features));
  return result;
}

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

SentenceFrames sentence_frames(const SentenceRecognizerOptions& options, ConstMatrixRefF input,
                               double scale_px, const HandReaches& reaches) {
  SentenceFrames result;
  if (options.input == SentenceInput::rows) {
    require(scale_px == 0, "scale_px is of tracks, rows have none");
    result.features = frames_of_rows(options.features, input);
    result.known_columns.resize(static_cast<std::size_t>(result.features.cols()));
    std::iota(result.known_columns.begin(), result.known_columns.end(), 0);
    return result;
  }
  const TwoHandFeatureComputer computer(options.features);
  result.known_columns = computer.known_columns(input);
  require(!result.known_columns.empty(), "tracks: no frame shows the right hand");
  const double scale = scale_px == 0 ? scale_of(options.features, input, reaches) : scale_px;
  result.features = computer.compute(input, scale);
  return result;
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
