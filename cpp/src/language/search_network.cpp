// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "language/search_network.hpp"

#include <algorithm>
#include <string>

#include "hri/core/error.hpp"

namespace hri::detail {
namespace {

void check_logs(const VectorD& logs, int size, const std::string& name) {
  if (logs.size() != size) {
    fail(ErrorKind::invalid_argument, name + " has " + std::to_string(logs.size()) +
                                          " values, the chain " + std::to_string(size) + " states");
  }
  for (int i = 0; i < size; ++i) {
    if (!(logs[i] <= 0))
      fail(ErrorKind::invalid_argument, name + " has a value that is no log probability");
  }
}

SearchChain search_chain_of(const WordChain& chain, int first_emission, const std::string& name) {
  const auto size = static_cast<int>(chain.log_start.size());
  if (size == 0) fail(ErrorKind::invalid_argument, name + " has no state");
  check_logs(chain.log_start, size, name + ".log_start");
  check_logs(chain.log_exit, size, name + ".log_exit");
  if (chain.log_transition.rows() != size)
    fail(ErrorKind::invalid_argument, name + ".log_transition has another number of rows");
  for (int i = 0; i < size; ++i)
    check_logs(chain.log_transition.row(i), size, name + ".log_transition");
  SearchChain model{first_emission,  size,          chain.is_silence, {}, {},
                    chain.log_start, chain.log_exit};
  for (int to = 0; to < size; ++to) {
    if (model.log_start[to] > kImpossible) model.end_of_start = to + 1;
    model.first_step.push_back(static_cast<int>(model.steps.size()));
    for (int from = 0; from < size; ++from) {
      const double log_weight = chain.log_transition(from, to);
      if (!(log_weight > kImpossible)) continue;
      model.steps.push_back({from, log_weight});
      model.most_back = std::max(model.most_back, from - to);
      model.most_on = std::max(model.most_on, to - from);
    }
  }
  model.first_step.push_back(static_cast<int>(model.steps.size()));
  return model;
}

}  // namespace

SearchNetwork::SearchNetwork(const std::vector<WordChain>& chains, const WordNetwork& network,
                             const ConnectedDecoderOptions& options)
    : initial(network.initial()), final(network.final()) {
  for (std::size_t m = 0; m < chains.size(); ++m) {
    models.push_back(
        search_chain_of(chains[m], num_emissions, "chains[" + std::to_string(m) + "]"));
    num_emissions += models.back().num_states;
  }
  word_of_node.assign(static_cast<std::size_t>(network.num_nodes()), -1);
  for (int n = 0; n < network.num_nodes(); ++n) {
    const int model = network.models()[static_cast<std::size_t>(n)];
    if (model == WordNetwork::kNull) continue;
    require(model < static_cast<int>(models.size()), "the network names a model that there is not");
    word_of_node[static_cast<std::size_t>(n)] = static_cast<int>(words.size());
    words.push_back({model, n, num_states});
    num_states += models[static_cast<std::size_t>(model)].num_states;
  }
  for (WordNetwork::Arc arc : network.arcs()) {
    const int word = word_of_node[static_cast<std::size_t>(arc.to)];
    arc.log_weight *= options.language_scale;
    if (word >= 0 && !chain_of(words[static_cast<std::size_t>(word)]).is_silence)
      arc.log_weight += options.insertion_penalty;
    arcs.push_back(arc);
  }
}

}  // namespace hri::detail
