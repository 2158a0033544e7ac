// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/recognition/word/word_verifier.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
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
constexpr double kLeastDistance = 1e-3;  // of the distance that it is compared with

// The word of the highest score.
std::size_t best_word(const VectorF& scores, int left_out) {
  Eigen::Index best = left_out == 0 ? 1 : 0;
  for (Eigen::Index c = best + 1; c < scores.size(); ++c) {
    if (c != left_out && scores[c] > scores[best]) best = c;
  }
  return static_cast<std::size_t>(best);
}

// The mean score of the filler words that fit best: one that sounds like a word of the vocabulary
// by chance does not decide alone.
double best_fillers(VectorF sums) {
  const auto count = std::min<Eigen::Index>(kFillers, sums.size());
  std::partial_sort(sums.data(), sums.data() + count, sums.data() + sums.size(), std::greater<>());
  return static_cast<double>(sums.head(count).sum()) / static_cast<double>(count);
}

// The mean score of the best words other than `best`.
double rival_score(const VectorF& scores, std::size_t best, int left_out) {
  std::vector<float> others;
  for (Eigen::Index c = 0; c < scores.size(); ++c) {
    if (c != left_out && c != static_cast<Eigen::Index>(best)) others.push_back(scores[c]);
  }
  const std::size_t count = std::min(kRivals, others.size());
  if (count == 0) return static_cast<double>(scores[static_cast<Eigen::Index>(best)]);
  std::sort(others.rbegin(), others.rend());
  double sum = 0;
  for (std::size_t k = 0; k < count; ++k) sum += static_cast<double>(others[k]);
  return sum / static_cast<double>(count);
}

// Of squared distances. Noise draws all vectors towards one another; their ratio stays about the
// same, where their difference does not.
double log_ratio(double distance, double other) {
  if (!(other > 0)) return distance > 0 ? -std::log(kLeastDistance) : 0;
  return std::log(std::clamp(distance / other, kLeastDistance, 1 / kLeastDistance));
}

bool has_paths(const MultiStreamScorer& scorer) {
  return !scorer.streams().empty() && scorer.streams().front()->has_paths();
}

// "states", "length" and "pace", over the best path of every stream.
void add_path_features(const MultiStreamScorer& scorer, const StreamFrames& frames,
                       std::size_t best, int left_out, std::vector<double>* features) {
  const auto num_frames = static_cast<double>(frames.front().rows());
  const auto num_streams = static_cast<double>(scorer.streams().size());
  double margin = 0;
  double length = 0;
  double deviation = 0;
  int num_states = 0;
  for (std::size_t i = 0; i < scorer.streams().size(); ++i) {
    const PathFit fit = scorer.streams()[i]->path_fit(frames[i], static_cast<int>(best), left_out);
    margin += fit.state_margin / num_frames;
    length += fit.log_duration_ratio / num_streams;
    deviation += fit.duration_deviation;
    num_states += fit.num_states;
  }
  features->push_back(margin);
  features->push_back(std::log(length * length + kLeastLength));
  features->push_back(std::log(deviation / std::max(1, num_states) + kLeastPace));
}

using Kind = VerifierExample::Kind;

VectorD picked(const VectorD& features, const std::vector<int>& columns) {
  VectorD result(static_cast<Eigen::Index>(columns.size()));
  for (std::size_t i = 0; i < columns.size(); ++i)
    result[static_cast<Eigen::Index>(i)] = features[columns[i]];
  return result;
}

std::vector<int> all_columns(Eigen::Index count) {
  std::vector<int> columns(static_cast<std::size_t>(count));
  std::iota(columns.begin(), columns.end(), 0);
  return columns;
}

// Separates words from examples of the kind `no` by some features; untrained without examples of
// both kinds.
LogisticRegression regression(const std::vector<VerifierExample>& examples, Kind no,
                              const std::vector<int>& columns) {
  std::array<double, 2> counts{};
  for (const VerifierExample& e : examples) {
    if (e.kind == Kind::word || e.kind == no) counts[e.kind == no ? 1 : 0] += 1;
  }
  if (counts[0] == 0 || counts[1] == 0) return {};
  MatrixD rows(static_cast<Eigen::Index>(counts[0] + counts[1]),
               static_cast<Eigen::Index>(columns.size()));
  std::vector<int> yes;
  std::vector<double> weights;
  for (const VerifierExample& e : examples) {
    if (e.kind != Kind::word && e.kind != no) continue;
    rows.row(static_cast<Eigen::Index>(yes.size())) = picked(e.features, columns).transpose();
    yes.push_back(e.kind == no ? 0 : 1);
    weights.push_back(static_cast<double>(rows.rows()) / 2 / counts[e.kind == no ? 1 : 0]);
  }
  LogisticRegressionOptions options;
  options.penalty = kPenalty;
  return LogisticRegression::train(rows, yes, weights, options);
}

double log_odds(const LogisticRegression& model, const VectorD& features) {
  return model.log_odds({features.data(), static_cast<std::size_t>(features.size())});
}

// In files since format version 1.
std::vector<std::string> stored_names(const MultiStreamScorer& scorer) {
  std::vector<std::string> names = WordVerifier::feature_names(scorer);
  std::replace(names.begin(), names.end(), std::string("fillers"), std::string("background"));
  return names;
}

}  // namespace

std::vector<std::string> WordVerifier::feature_names(const MultiStreamScorer& scorer) {
  const bool streams = !scorer.streams().empty();
  std::vector<std::string> names;
  if (streams) names.emplace_back("ratio");
  names.emplace_back("rivals");
  if (has_paths(scorer)) {
    for (const char* name : {"states", "length", "pace"}) names.emplace_back(name);
  }
  const bool vectors = scorer.vectors() != nullptr;
  if (vectors) names.emplace_back("vector_rivals");
  if (scorer.network() != nullptr) names.emplace_back("network_rivals");
  if (scorer.num_fillers() > 0) {
    if (streams) names.emplace_back("fillers");
    if (vectors) names.emplace_back("vector_fillers");
  }
  return names;
}

WordEvidence WordVerifier::evidence(const MultiStreamScorer& scorer, const StreamFrames& frames,
                                    const VectorF& scores) {
  WordEvidence result;
  result.scores = scores;
  result.of_streams = scores;
  const VectorScorer* vectors = scorer.vectors().get();
  if (vectors != nullptr) {
    if (!scorer.streams().empty()) result.of_streams -= scorer.vector_scores(frames);
    result.nearness = -vectors->squared_distances(scorer.vector_of(frames));
  }
  if (scorer.network() != nullptr) {
    result.of_network = scorer.network_scores(frames);
    result.of_streams -= result.of_network;
  }
  result.garbage = static_cast<double>(scorer.garbage_score(frames));
  if (scorer.num_fillers() == 0) return result;
  if (!scorer.streams().empty()) result.fillers = best_fillers(scorer.filler_scores(frames));
  if (vectors != nullptr) {
    const VectorF distances = vectors->filler_squared_distances(scorer.vector_of(frames));
    result.nearness_of_fillers = best_fillers(-distances);
  }
  return result;
}

VectorD WordVerifier::features(const MultiStreamScorer& scorer, const StreamFrames& frames,
                               const WordEvidence& evidence, int left_out) {
  std::vector<double> result;
  const bool streams = !scorer.streams().empty();
  // Without streams the first matrix is the vector: one row, and margins are whole.
  const auto num_frames = static_cast<double>(frames.front().rows());
  const bool vectors = scorer.vectors() != nullptr;
  const std::size_t best = best_word(evidence.scores, left_out);
  const auto at = static_cast<Eigen::Index>(best);
  const auto top = static_cast<double>(evidence.of_streams[at]);
  if (streams) result.push_back((top - evidence.garbage) / num_frames);
  result.push_back((top - rival_score(evidence.of_streams, best, left_out)) / num_frames);
  if (has_paths(scorer)) add_path_features(scorer, frames, best, left_out, &result);
  const double distance = vectors ? -static_cast<double>(evidence.nearness[at]) : 0.0;
  if (vectors)
    result.push_back(log_ratio(distance, -rival_score(evidence.nearness, best, left_out)));
  if (scorer.network() != nullptr) {
    result.push_back(static_cast<double>(evidence.of_network[at]) -
                     rival_score(evidence.of_network, best, left_out));
  }
  if (scorer.num_fillers() > 0) {
    if (streams) result.push_back((top - evidence.fillers) / num_frames);
    if (vectors) result.push_back(log_ratio(distance, -evidence.nearness_of_fillers));
  }
  return Eigen::Map<const VectorD>(result.data(), static_cast<Eigen::Index>(result.size()));
}

std::vector<int> WordVerifier::features_of_words(const MultiStreamScorer& scorer, int num_words) {
  const std::vector<std::string> names = feature_names(scorer);
  const auto count = static_cast<Eigen::Index>(names.size());
  if (scorer.num_fillers() == 0) return all_columns(count);
  const auto decides = [&](const std::string& name) {
    if (name == "fillers" || name == "vector_fillers" || name == "network_rivals") return true;
    return num_words >= kManyWords && has_paths(scorer) && (name == "rivals" || name == "states");
  };
  std::vector<int> columns;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (decides(names[i])) columns.push_back(static_cast<int>(i));
  }
  return columns;
}

WordVerifier WordVerifier::fit(const std::vector<VerifierExample>& examples,
                               std::vector<int> of_words) {
  WordVerifier result;
  if (examples.empty()) return result;
  result.words_ = regression(examples, Kind::other_word, of_words);
  result.of_words_ = std::move(of_words);
  result.sounds_ = regression(examples, Kind::sound, all_columns(examples.front().features.size()));
  return result;
}

float WordVerifier::verification_score(const VectorD& features) const {
  if (words_.dim() == 0 && sounds_.dim() == 0) return static_cast<float>(features[0]);
  if (words_.dim() == 0) return static_cast<float>(log_odds(sounds_, features));
  const double a = log_odds(words_, picked(features, of_words_));
  if (sounds_.dim() == 0) return static_cast<float>(a);
  // The odds of both alternatives add up.
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
  const auto read_model = [&](const char* prefix, std::size_t fewest, std::size_t most) {
    if (!file.has(std::string(prefix) + "weights")) return LogisticRegression();
    LogisticRegression model = LogisticRegression::read(file, prefix);
    const auto dim = static_cast<std::size_t>(model.dim());
    if (dim != fewest && dim != most) {
      fail(ErrorKind::format, file.name() + ": field '" + prefix + "weights' has " +
                                  std::to_string(dim) + " values, expected " +
                                  std::to_string(fewest) +
                                  (most == fewest ? "" : " or " + std::to_string(most)));
    }
    return model;
  };
  std::vector<int> few = features_of_words(scorer, 0);
  std::vector<int> many = features_of_words(scorer, kManyWords);
  result.words_ = read_model(kWords, few.size(), many.size());
  // How many weights there are says which features they belong to.
  const bool has_few = static_cast<std::size_t>(result.words_.dim()) == few.size();
  result.of_words_ = std::move(has_few ? few : many);
  result.sounds_ = read_model(kSounds, names.size(), names.size());
  return result;
}

}  // namespace hri
