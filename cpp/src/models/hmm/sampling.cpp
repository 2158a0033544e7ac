// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/hmm/sampling.hpp"

#include <cmath>

#include "hri/core/error.hpp"
#include "hri/core/random.hpp"

namespace hri {
namespace {

// The index that a uniform number falls on; the last with a probability where rounding left a gap.
template <class Probabilities>
int draw(const Probabilities& probabilities, Random* random) {
  double left = random->uniform();
  int last = 0;
  for (Eigen::Index i = 0; i < probabilities.size(); ++i) {
    if (probabilities[i] <= 0) continue;
    last = static_cast<int>(i);
    left -= probabilities[i];
    if (left < 0) break;
  }
  return last;
}

template <class Emit>
std::vector<int> walk(const MarkovChain& chain, int count, Random* random, const Emit& emit) {
  require(count >= 0, "the number of samples must not be negative");
  std::vector<int> states(static_cast<std::size_t>(count));
  int state = 0;
  for (int t = 0; t < count; ++t) {
    state = t == 0 ? draw(chain.start(), random) : draw(chain.transition().row(state), random);
    states[static_cast<std::size_t>(t)] = state;
    emit(t, state);
  }
  return states;
}

}  // namespace

SampledSymbols sample(const DiscreteHmm& model, int count, std::uint64_t seed) {
  Random random(seed);
  SampledSymbols result;
  result.states = walk(model.chain(), count, &random, [&](int, int state) {
    result.symbols.push_back(draw(model.emission().row(state), &random));
  });
  return result;
}

SampledFrames sample(const GaussianMixtureHmm& model, int count, std::uint64_t seed) {
  require(count >= 0, "the number of samples must not be negative");
  Random random(seed);
  const MixtureBank& bank = model.bank();
  SampledFrames result;
  result.frames.resize(count, model.dim());
  result.states = walk(model.chain(), count, &random, [&](int t, int state) {
    const Eigen::Index row =
        state * bank.weights().cols() + draw(bank.weights().row(state), &random);
    for (Eigen::Index d = 0; d < result.frames.cols(); ++d) {
      const double deviation = std::sqrt(bank.variances()(row, d));
      result.frames(t, d) = static_cast<float>(bank.means()(row, d) + deviation * random.normal());
    }
  });
  return result;
}

}  // namespace hri
