// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Any bytes as a grammar in JSGF. Sentences drawn from its network are sentences of the grammar,
// and those that it lists too.
#include <algorithm>

#include "fuzzing.hpp"
#include "hri/language/grammar.hpp"

namespace {

constexpr int kMostNodes = 20000;  // of networks that sentences are drawn from: time is bounded
constexpr int kMostSteps = 2000;
constexpr int kNumSentences = 4;

// A path from the first node to the last one; false where it is too long. Loops are left in the
// end, as the last arc that leaves a node is taken then.
bool draw(const hri::WordNetwork& network, const std::vector<std::vector<int>>& next,
          const std::vector<std::string>& words, hri::fuzzing::Bytes& bytes,
          std::vector<std::string>* sentence) {
  int node = network.initial();
  for (int step = 0; step < kMostSteps; ++step) {
    const int model = network.models()[static_cast<std::size_t>(node)];
    if (model != hri::WordNetwork::kNull)
      sentence->push_back(words[static_cast<std::size_t>(model)]);
    if (node == network.final()) return true;
    const auto& to = next[static_cast<std::size_t>(node)];
    const auto chosen =
        step < kMostSteps / 4 ? static_cast<std::size_t>(bytes.byte()) % to.size() : to.size() - 1;
    node = to[chosen];
  }
  return false;
}

void check(const hri::Grammar& grammar, hri::fuzzing::Bytes& bytes) {
  const hri::WordNetwork network = grammar.network(grammar.words());
  if (network.num_nodes() > kMostNodes) return;
  std::vector<std::vector<int>> next(network.models().size());
  for (const auto& arc : network.arcs()) next[static_cast<std::size_t>(arc.from)].push_back(arc.to);
  for (int i = 0; i < kNumSentences; ++i) {
    std::vector<std::string> sentence;
    if (draw(network, next, grammar.words(), bytes, &sentence) && !grammar.slots_of(sentence))
      std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  hri::fuzzing::expect_typed_errors([&] {
    const std::string text(data, data + size);
    const hri::Grammar grammar = hri::Grammar::parse(text, "input");
    if (grammar.text() != text || !std::is_sorted(grammar.words().begin(), grammar.words().end()))
      std::abort();
    hri::fuzzing::Bytes bytes(data, size);
    check(grammar, bytes);
    try {
      for (const auto& sentence : grammar.sentences(50)) {
        if (!grammar.slots_of(sentence)) std::abort();
      }
    } catch (const hri::InvalidArgument&) {  // too many
    }
  });
  return 0;
}
