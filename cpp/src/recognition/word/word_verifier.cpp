// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/recognition/word/word_verifier.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>

#include "hri/core/error.hpp"

namespace hri {
namespace {

constexpr const char* kFeatures = "verifier.features";
constexpr const char* kWords = "verifier.words.";
constexpr const char* kSounds = "verifier.sounds.";
constexpr std::size_t kRivals = 3;    // words that the best one is compared with
constexpr Eigen::Index kFillers = 5;  // filler words that the best one is compared with
constexpr double kPenalty = 10;       // of the regression; few people speak in a training set
// Logs of deviations stay finite where a word is spoken exactly as long as usual.
constexpr double kLeastLength = 0.006;
constexpr double kLeastPace = 0.06;

// The best word, and the scores of the others in falling order.
struct Ranking {
  std::size_t best = 0;
  std::vector<float> others;
};

Ranking ranking(const VectorF& scores, int left_out) {
  Ranking result;
  bool found = false;
  for (Eigen::Index c = 0; c < scores.size(); ++c) {
    if (c == left_out) continue;
    if (!found || scores[c] > scores[static_cast<Eigen::Index>(result.best)])
      result.best = static_cast<std::size_t>(c);
    found = true;
  }
  for (Eigen::Index c = 0; c < scores.size(); ++c) {
    if (c != left_out && c != static_cast<Eigen::Index>(result.best))
      result.others.push_back(scores[c]);
  }
  std::sort(result.others.rbegin(), result.others.rend());
  return result;
}

// The mean score of the filler words that fit best: one that sounds like a word of the vocabulary
// by chance does not decide alone.
double filler_score(const MultiStreamScorer& scorer, const StreamFrames& frames) {
  VectorF sums = scorer.filler_scores(frames);
  const auto count = std::min<Eigen::Index>(kFillers, sums.size());
  std::partial_sort(sums.data(), sums.data() + count, sums.data() + sums.size(), std::greater<>());
  return static_cast<double>(sums.head(count).sum()) / static_cast<double>(count);
}

// The mean score of the best other words.
double rival_score(const Ranking& ranks, double top) {
  const std::size_t count = std::min(kRivals, ranks.others.size());
  if (count == 0) return top;
  double sum = 0;
  for (std::size_t k = 0; k < count; ++k) sum += static_cast<double>(ranks.others[k]);
  return sum / static_cast<double>(count);
}

// "states", "length" and "pace", over the best path of every stream.
void add_path_features(const MultiStreamScorer& scorer, const StreamFrames& frames,
                       std::size_t best, int left_out, VectorD* features) {
  const auto num_frames = static_cast<double>(frames.front().rows());
  const auto num_streams = static_cast<double>(frames.size());
  double length = 0;
  double deviation = 0;
  int num_states = 0;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const PathFit fit = scorer.streams()[i]->path_fit(frames[i], static_cast<int>(best), left_out);
    (*features)[2] += fit.state_margin / num_frames;
    length += fit.log_duration_ratio / num_streams;
    deviation += fit.duration_deviation;
    num_states += fit.num_states;
  }
  (*features)[3] = std::log(length * length + kLeastLength);
  (*features)[4] = std::log(deviation / std::max(1, num_states) + kLeastPace);
}

using Kind = VerifierExample::Kind;

// Separates words from examples of the kind `no` by their last `num_columns` features (0: all);
// untrained without examples of both kinds.
LogisticRegression regression(const std::vector<VerifierExample>& examples, Kind no,
                              Eigen::Index num_columns) {
  std::array<double, 2> counts{};
  for (const VerifierExample& e : examples) {
    if (e.kind == Kind::word || e.kind == no) counts[e.kind == no ? 1 : 0] += 1;
  }
  if (counts[0] == 0 || counts[1] == 0) return {};
  if (num_columns == 0) num_columns = examples.front().features.size();
  MatrixD rows(static_cast<Eigen::Index>(counts[0] + counts[1]), num_columns);
  std::vector<int> yes;
  std::vector<double> weights;
  for (const VerifierExample& e : examples) {
    if (e.kind != Kind::word && e.kind != no) continue;
    rows.row(static_cast<Eigen::Index>(yes.size())) = e.features.tail(num_columns).transpose();
    yes.push_back(e.kind == no ? 0 : 1);
    weights.push_back(static_cast<double>(rows.rows()) / 2 / counts[e.kind == no ? 1 : 0]);
  }
  LogisticRegressionOptions options;
  options.penalty = kPenalty;
  return LogisticRegression::train(rows, yes, weights, options);
}

double log_odds(const LogisticRegression& model, const VectorD& features) {
  const VectorD used = features.tail(model.dim());
  return model.log_odds({used.data(), static_cast<std::size_t>(used.size())});
}

// In files since format version 1.
std::vector<std::string> stored_names(const MultiStreamScorer& scorer) {
  std::vector<std::string> names =
      WordVerifier::feature_names(scorer.kind(), scorer.num_fillers() > 0);
  if (names.back() == "fillers") names.back() = "background";
  return names;
}

}  // namespace

std::vector<std::string> WordVerifier::feature_names(SequenceModelKind kind, bool fillers) {
  if (kind == SequenceModelKind::ptbhmm) return {"ratio", "rivals"};
  std::vector<std::string> names{"ratio", "rivals", "states", "length", "pace"};
  if (fillers) names.emplace_back("fillers");
  return names;
}

VectorD WordVerifier::features(const MultiStreamScorer& scorer, const StreamFrames& frames,
                               const VectorF& scores, int left_out) {
  const bool fillers = scorer.num_fillers() > 0;
  VectorD result =
      VectorD::Zero(static_cast<Eigen::Index>(feature_names(scorer.kind(), fillers).size()));
  const auto num_frames = static_cast<double>(frames.front().rows());
  const Ranking ranks = ranking(scores, left_out);
  const auto top = static_cast<double>(scores[static_cast<Eigen::Index>(ranks.best)]);
  result[0] = (top - scorer.garbage_score(frames)) / num_frames;
  result[1] = (top - rival_score(ranks, top)) / num_frames;
  if (scorer.streams().front()->has_paths())
    add_path_features(scorer, frames, ranks.best, left_out, &result);
  if (fillers) result[5] = (top - filler_score(scorer, frames)) / num_frames;
  return result;
}

WordVerifier WordVerifier::fit(const std::vector<VerifierExample>& examples, bool fillers) {
  WordVerifier result;
  result.words_ = regression(examples, Kind::other_word, fillers ? 1 : 0);
  result.sounds_ = regression(examples, Kind::sound, 0);
  return result;
}

float WordVerifier::verification_score(const VectorD& features) const {
  if (words_.dim() == 0 && sounds_.dim() == 0) return static_cast<float>(features[0]);
  if (words_.dim() == 0) return static_cast<float>(log_odds(sounds_, features));
  if (sounds_.dim() == 0) return static_cast<float>(log_odds(words_, features));
  // The odds of both alternatives add up.
  const double a = log_odds(words_, features);
  const double b = log_odds(sounds_, features);
  return static_cast<float>(std::min(a, b) - std::log1p(std::exp(-std::abs(a - b))));
}

void WordVerifier::write(ModelFile& file, const MultiStreamScorer& scorer) const {
  if (words_.dim() == 0 && sounds_.dim() == 0) return;
  file.set_text_list(kFeatures, stored_names(scorer));
  for (const auto& [model, prefix] : {std::pair(&words_, kWords), std::pair(&sounds_, kSounds)}) {
    if (model->dim() > 0) model->write(file, prefix);
  }
}

WordVerifier WordVerifier::read(const ModelFile& file, const MultiStreamScorer& scorer) {
  WordVerifier result;
  if (!file.has(kFeatures)) return result;
  const std::vector<std::string> names = stored_names(scorer);
  if (file.text_list(kFeatures) != names)
    fail(ErrorKind::format, file.name() + ": field '" + kFeatures + "' does not fit the models");
  const auto read_model = [&](const char* prefix, std::size_t dim) {
    if (!file.has(std::string(prefix) + "weights")) return LogisticRegression();
    LogisticRegression model = LogisticRegression::read(file, prefix);
    if (static_cast<std::size_t>(model.dim()) != dim) {
      fail(ErrorKind::format, file.name() + ": field '" + prefix + "weights' has " +
                                  std::to_string(model.dim()) + " values, expected " +
                                  std::to_string(dim));
    }
    return model;
  };
  result.words_ = read_model(kWords, scorer.num_fillers() > 0 ? 1 : names.size());
  result.sounds_ = read_model(kSounds, names.size());
  return result;
}

}  // namespace hri
