// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/recognition/word/word_verifier.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "hri/core/error.hpp"

namespace hri {
namespace {

constexpr const char* kFeatures = "verifier.features";
constexpr const char* kWords = "verifier.words.";
constexpr const char* kSounds = "verifier.sounds.";
constexpr std::size_t kTopStates = 5;   // that a frame is compared with
constexpr std::size_t kRivals = 3;      // words that the best one is compared with
constexpr std::size_t kBackground = 5;  // background words that the best one is compared with
constexpr double kPenalty = 10;         // of the regression; few people speak in a training set
// Logs of deviations stay finite where a word is spoken exactly as long as usual.
constexpr double kLeastLength = 0.006;
constexpr double kLeastPace = 0.06;

using Top = std::array<float, kTopStates>;  // falling

void insert(float value, Top* top) {
  if (value <= top->back()) return;
  std::size_t at = kTopStates - 1;
  for (; at > 0 && (*top)[at - 1] < value; --at) (*top)[at] = (*top)[at - 1];
  (*top)[at] = value;
}

// How well the aligned states of word `best` fit every frame, against the mean of the states of
// all words that fit the frame best; summed over frames.
double against_states(const std::vector<GaussianMixtureHmm>& hmms, ConstMatrixRefF frames,
                      std::size_t best, int left_out, const std::vector<int>& path) {
  Top lowest;
  lowest.fill(-std::numeric_limits<float>::infinity());
  std::vector<Top> tops(path.size(), lowest);
  double own = 0;
  std::size_t num_states = 0;
  for (std::size_t c = 0; c < hmms.size(); ++c) {
    if (static_cast<int>(c) == left_out) continue;
    MatrixF densities(frames.rows(), hmms[c].num_states());
    hmms[c].bank().log_densities(frames, densities);
    num_states += static_cast<std::size_t>(densities.cols());
    for (std::size_t t = 0; t < path.size(); ++t) {
      const auto row = static_cast<Eigen::Index>(t);
      for (Eigen::Index s = 0; s < densities.cols(); ++s) insert(densities(row, s), &tops[t]);
      if (c == best) own += static_cast<double>(densities(row, path[t]));
    }
  }
  const std::size_t count = std::min(kTopStates, num_states);
  double sum = 0;
  for (const Top& top : tops) {
    for (std::size_t k = 0; k < count; ++k) sum += static_cast<double>(top[k]);
  }
  return own - sum / static_cast<double>(count);
}

// How long the states of a path last, against what the chain expects. The last state has no way
// out, so that nothing says how long it should last.
struct Timing {
  double length = 0;     // log of the length before the last state, against its expectation
  double deviation = 0;  // sum over states of |log of their length against its expectation|
  int num_states = 0;
};

Timing timing(const MarkovChain& chain, const std::vector<int>& path) {
  constexpr double kHalf = 0.5;  // a state that was skipped lasted half a frame
  Timing result;
  result.num_states = chain.num_states() - 1;
  if (result.num_states == 0) return result;
  std::vector<double> count(static_cast<std::size_t>(chain.num_states()), 0.0);
  for (const int state : path) count[static_cast<std::size_t>(state)] += 1;
  double spent = 0;
  double expected = 0;
  for (int s = 0; s < result.num_states; ++s) {
    const double usual = 1.0 / std::max(1e-3, 1.0 - chain.transition()(s, s));
    const double lasted = count[static_cast<std::size_t>(s)];
    result.deviation += std::abs(std::log((lasted + kHalf) / (usual + kHalf)));
    spent += lasted;
    expected += usual;
  }
  result.length = std::log((spent + kHalf) / (expected + kHalf));
  return result;
}

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

// The mean score of the background words that fit best: one that sounds like a word of the
// vocabulary by chance does not decide alone.
double background_score(const std::vector<const SequenceModels*>& streams,
                        const std::vector<MatrixF>& frames) {
  VectorF sums = streams.front()->background_scores(frames.front());
  for (std::size_t i = 1; i < streams.size(); ++i) sums += streams[i]->background_scores(frames[i]);
  const auto count = std::min<Eigen::Index>(kBackground, sums.size());
  std::partial_sort(sums.data(), sums.data() + count, sums.data() + sums.size(), std::greater<>());
  return static_cast<double>(sums.head(count).sum()) / static_cast<double>(count);
}

// Tells words from trials of the kind `no` by their last `num_columns` features (0: all); empty
// without trials of both kinds.
LogisticRegression regression(const std::vector<VerifierTrial>& trials, TrialKind no,
                              Eigen::Index num_columns) {
  std::array<double, 2> counts{};
  for (const VerifierTrial& t : trials) {
    if (t.kind == TrialKind::word || t.kind == no) counts[t.kind == no ? 1 : 0] += 1;
  }
  if (counts[0] == 0 || counts[1] == 0) return {};
  if (num_columns == 0) num_columns = trials.front().features.size();
  MatrixD rows(static_cast<Eigen::Index>(counts[0] + counts[1]), num_columns);
  std::vector<int> yes;
  std::vector<double> weights;
  for (const VerifierTrial& t : trials) {
    if (t.kind != TrialKind::word && t.kind != no) continue;
    rows.row(static_cast<Eigen::Index>(yes.size())) = t.features.tail(num_columns).transpose();
    yes.push_back(t.kind == no ? 0 : 1);
    weights.push_back(static_cast<double>(rows.rows()) / 2 / counts[t.kind == no ? 1 : 0]);
  }
  LogisticRegressionOptions options;
  options.penalty = kPenalty;
  return LogisticRegression::train(rows, yes, weights, options);
}

double log_odds(const LogisticRegression& model, const VectorD& features) {
  const VectorD used = features.tail(model.dim());
  return model.log_odds({used.data(), static_cast<std::size_t>(used.size())});
}

}  // namespace

std::vector<std::string> WordVerifier::feature_names(SequenceModelKind kind, bool background) {
  if (kind == SequenceModelKind::ptbhmm) return {"ratio", "rivals"};
  std::vector<std::string> names{"ratio", "rivals", "states", "length", "pace"};
  if (background) names.emplace_back("background");
  return names;
}

VectorD WordVerifier::features(const std::vector<const SequenceModels*>& streams,
                               const std::vector<MatrixF>& frames, const VectorF& scores,
                               int left_out) {
  const auto num_frames = static_cast<double>(frames.front().rows());
  const Ranking ranks = ranking(scores, left_out);
  const auto top = static_cast<double>(scores[static_cast<Eigen::Index>(ranks.best)]);
  double garbage = 0;
  for (std::size_t i = 0; i < streams.size(); ++i)
    garbage += static_cast<double>(streams[i]->garbage_score(frames[i]));
  const std::size_t num_rivals = std::min(kRivals, ranks.others.size());
  double rivals = 0;
  for (std::size_t k = 0; k < num_rivals; ++k) rivals += static_cast<double>(ranks.others[k]);
  rivals = num_rivals == 0 ? top : rivals / static_cast<double>(num_rivals);

  const bool aligned = !streams.front()->hmms().empty();
  const bool background = streams.front()->num_background() > 0;
  VectorD result = VectorD::Zero(static_cast<Eigen::Index>(
      feature_names(aligned ? SequenceModelKind::hmm : SequenceModelKind::ptbhmm, background)
          .size()));
  result[0] = (top - garbage) / num_frames;
  result[1] = (top - rivals) / num_frames;
  if (!aligned) return result;
  double length = 0;
  double deviation = 0;
  int num_states = 0;
  for (std::size_t i = 0; i < streams.size(); ++i) {
    const std::vector<GaussianMixtureHmm>& hmms = streams[i]->hmms();
    std::vector<int> path;
    hmms[ranks.best].viterbi(frames[i], &path);
    result[2] += against_states(hmms, frames[i], ranks.best, left_out, path) / num_frames;
    const Timing time = timing(hmms[ranks.best].chain(), path);
    length += time.length / static_cast<double>(streams.size());
    deviation += time.deviation;
    num_states += time.num_states;
  }
  result[3] = std::log(length * length + kLeastLength);
  result[4] = std::log(deviation / std::max(1, num_states) + kLeastPace);
  if (background) result[5] = (top - background_score(streams, frames)) / num_frames;
  return result;
}

WordVerifier WordVerifier::fit(const std::vector<VerifierTrial>& trials, bool background) {
  WordVerifier result;
  result.words_ = regression(trials, TrialKind::other_word, background ? 1 : 0);
  result.sounds_ = regression(trials, TrialKind::sound, 0);
  return result;
}

float WordVerifier::verification_score(const VectorD& features) const {
  if (words_.dim() == 0 && sounds_.dim() == 0) return static_cast<float>(features[0]);
  if (words_.dim() == 0) return static_cast<float>(log_odds(sounds_, features));
  if (sounds_.dim() == 0) return static_cast<float>(log_odds(words_, features));
  // The odds against it add up.
  const double a = log_odds(words_, features);
  const double b = log_odds(sounds_, features);
  return static_cast<float>(std::min(a, b) - std::log1p(std::exp(-std::abs(a - b))));
}

void WordVerifier::write(ModelFile& file, SequenceModelKind kind, bool background) const {
  if (words_.dim() == 0 && sounds_.dim() == 0) return;
  file.set_text_list(kFeatures, feature_names(kind, background));
  for (const auto& [model, prefix] : {std::pair(&words_, kWords), std::pair(&sounds_, kSounds)}) {
    if (model->dim() > 0) model->write(file, prefix);
  }
}

WordVerifier WordVerifier::read(const ModelFile& file, SequenceModelKind kind, bool background) {
  WordVerifier result;
  if (!file.has(kFeatures)) return result;
  const std::vector<std::string> names = feature_names(kind, background);
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
  result.words_ = read_model(kWords, background ? 1 : names.size());
  result.sounds_ = read_model(kSounds, names.size());
  return result;
}

}  // namespace hri
