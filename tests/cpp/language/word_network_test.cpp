// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/language/word_network.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "hri/core/error.hpp"

namespace hri {
namespace {

// Arcs against the order of the nodes, as a file may have them: too many for a pass over all arcs
// for every node.
std::vector<WordNetwork::Arc> backward_chain(int num_nodes) {
  std::vector<WordNetwork::Arc> arcs;
  for (int n = 0; n + 1 < num_nodes; ++n) arcs.push_back({n + 1, n, 0});
  return arcs;
}

TEST(WordNetwork, OrdersALongChainOfNullNodes) {
  constexpr int kNodes = 300000;
  const WordNetwork network(std::vector<int>(kNodes, WordNetwork::kNull), backward_chain(kNodes),
                            kNodes - 1, 0);
  for (int k = 0; k + 1 < kNodes; ++k)
    ASSERT_EQ(network.arcs()[static_cast<std::size_t>(k)].from, kNodes - 1 - k);
}

TEST(WordNetwork, OrdersByTheLongestWay) {
  // Node 3 follows 0 at once, and by way of 1 and 2.
  const WordNetwork network({-1, -1, -1, -1, -1},
                            {{3, 4, 0}, {0, 3, 0}, {2, 3, 0}, {0, 1, 0}, {1, 2, 0}}, 0, 4);
  std::vector<int> from;
  for (const WordNetwork::Arc& arc : network.arcs()) from.push_back(arc.from);
  EXPECT_EQ(from, (std::vector<int>{0, 0, 1, 2, 3}));
}

TEST(WordNetwork, RefusesCyclesOfNullNodes) {
  std::vector<WordNetwork::Arc> arcs = backward_chain(5);
  arcs.push_back({1, 3, 0});
  EXPECT_THROW(WordNetwork(std::vector<int>(5, WordNetwork::kNull), arcs, 4, 0), InvalidArgument);
  arcs.back() = {2, 2, 0};
  EXPECT_THROW(WordNetwork(std::vector<int>(5, WordNetwork::kNull), arcs, 4, 0), InvalidArgument);
}

TEST(WordNetwork, TakesVariantsInPlaceOfAModel) {
  const WordNetwork network = WordNetwork::loop(2, 2).with_variants({{0, 1, 2}, {3}, {4}});
  // The middle, and where words are entered, in a row; the end of the first, and its variants.
  EXPECT_EQ(network.models(), (std::vector<int>{-1, -1, 3, 4, -1, 0, 1, 2}));
  // Every variant lies between the null nodes of its word; the weight of the word counts once.
  const WordNetwork weighted({-1, 0, -1}, {{0, 1, -3}, {1, 2, -2}}, 0, 2);
  double sum = 0;
  const WordNetwork two = weighted.with_variants({{5, 6}});
  for (const WordNetwork::Arc& arc : two.arcs()) sum += arc.log_weight;
  EXPECT_EQ(sum, -5);
  EXPECT_THROW(network.with_variants({{0}}), InvalidArgument);
  EXPECT_THROW(weighted.with_variants({{}}), InvalidArgument);
  EXPECT_THROW(weighted.with_variants({{1, -1}}), InvalidArgument);
}

}  // namespace
}  // namespace hri
