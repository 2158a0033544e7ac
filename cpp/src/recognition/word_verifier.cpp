// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/recognition/word_verifier.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "hri/core/error.hpp"

namespace hri {
namespace {

constexpr const char* kPrefix = "verifier.";
constexpr std::size_t kTopStates = 5;  // that a frame is compared with
constexpr std::size_t kRivals = 3;     // words that the best one is compared with
constexpr double kPenalty = 10;        // of the regression; few people speak in a training set
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

}  // namespace

std::vector<std::string> WordVerifier::feature_names(SequenceModelKind kind) {
  if (kind == SequenceModelKind::ptbhmm) return {"ratio", "rivals"};
  return {"ratio", "rivals", "states", "length", "pace"};
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
  VectorD result = VectorD::Zero(aligned ? 5 : 2);
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
  return result;
}

WordVerifier WordVerifier::fit(const std::vector<VerifierTrial>& trials) {
  std::array<double, 3> counts{};
  for (const VerifierTrial& t : trials) counts[static_cast<std::size_t>(t.kind)] += 1;
  const double num_sorts_of_no = (counts[1] > 0 ? 1 : 0) + (counts[2] > 0 ? 1 : 0);
  WordVerifier result;
  if (counts[0] == 0 || num_sorts_of_no == 0) return result;
  const auto half = 0.5 * static_cast<double>(trials.size());
  MatrixD rows(static_cast<Eigen::Index>(trials.size()), trials.front().features.size());
  std::vector<int> yes;
  std::vector<double> weights;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const TrialKind kind = trials[i].kind;
    rows.row(static_cast<Eigen::Index>(i)) = trials[i].features.transpose();
    yes.push_back(kind == TrialKind::word ? 1 : 0);
    weights.push_back(half / counts[static_cast<std::size_t>(kind)] /
                      (kind == TrialKind::word ? 1.0 : num_sorts_of_no));
  }
  LogisticRegressionOptions options;
  options.penalty = kPenalty;
  result.model_ = LogisticRegression::train(rows, yes, weights, options);
  return result;
}

float WordVerifier::evidence(const VectorD& features) const {
  if (model_.dim() == 0) return static_cast<float>(features[0]);
  return static_cast<float>(
      model_.log_odds({features.data(), static_cast<std::size_t>(features.size())}));
}

void WordVerifier::write(ModelFile& file, SequenceModelKind kind) const {
  if (model_.dim() == 0) return;
  file.set_text_list("verifier.features", feature_names(kind));
  model_.write(file, kPrefix);
}

WordVerifier WordVerifier::read(const ModelFile& file, SequenceModelKind kind) {
  WordVerifier result;
  if (!file.has("verifier.features")) return result;
  const std::vector<std::string> names = feature_names(kind);
  result.model_ = LogisticRegression::read(file, kPrefix);
  if (file.text_list("verifier.features") != names ||
      static_cast<std::size_t>(result.model_.dim()) != names.size()) {
    fail(ErrorKind::format,
         file.name() + ": field 'verifier.features' does not fit the models or the weights");
  }
  return result;
}

}  // namespace hri
