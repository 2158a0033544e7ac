// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/language/lattice.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "hri/core/error.hpp"
#include "language/search_network.hpp"

namespace hri {
namespace {

using detail::kImpossible;

// log(sum of exp(terms)), -inf of none.
double log_sum(const std::vector<double>& terms) {
  double top = kImpossible;
  for (const double term : terms) top = std::max(top, term);
  if (top == kImpossible) return kImpossible;
  double sum = 0;
  for (const double term : terms) sum += std::exp(term - top);
  return top + std::log(sum);
}

// By where they lead, then by where they come from; others stay in their order.
std::vector<Lattice::Arc> ordered(const std::vector<Lattice::Arc>& arcs, std::size_t num_nodes) {
  std::vector<std::size_t> places(num_nodes + 1);
  for (const Lattice::Arc& arc : arcs) ++places[static_cast<std::size_t>(arc.to) + 1];
  for (std::size_t n = 0; n < num_nodes; ++n) places[n + 1] += places[n];
  std::vector<Lattice::Arc> result(arcs.size());
  for (const Lattice::Arc& arc : arcs) result[places[static_cast<std::size_t>(arc.to)]++] = arc;
  const auto comes_before = [](const Lattice::Arc& a, const Lattice::Arc& b) {
    return a.from < b.from;
  };
  auto first = result.begin();
  for (std::size_t n = 0; n < num_nodes; ++n) {
    const auto last = result.begin() + static_cast<std::ptrdiff_t>(places[n]);
    if (!std::is_sorted(first, last, comes_before)) std::stable_sort(first, last, comes_before);
    first = last;
  }
  return result;
}

// An arc of a word, and the probability that the sentence has it.
struct WordSpan {
  std::int64_t first_frame;
  std::int64_t last_frame;
  double probability;
};

void check_scale(double scale) {
  require(scale > 0 && scale <= 1, "scale must lie above 0, up to 1");
}

}  // namespace

Lattice::Lattice(std::vector<Node> nodes, std::vector<Arc> arcs)
    : nodes_(std::move(nodes)), arcs_(std::move(arcs)) {
  const auto size = static_cast<int>(nodes_.size());
  std::vector<bool> has_before(nodes_.size());
  first_out_.assign(nodes_.size() + 1, 0);
  for (const Arc& arc : arcs_) {
    require(arc.from >= 0 && arc.from < arc.to && arc.to < size,
            "an arc does not lead to a node of a higher number");
    const Node& from = nodes_[static_cast<std::size_t>(arc.from)];
    const Node& to = nodes_[static_cast<std::size_t>(arc.to)];
    require(from.frame >= 0 && from.frame <= to.frame, "an arc leads back in time");
    require(to.model == WordNetwork::kNull || from.frame < to.frame, "a word has no frame");
    require(std::isfinite(arc.log_acoustic) && std::isfinite(arc.log_weight),
            "the score of an arc is not finite");
    has_before[static_cast<std::size_t>(arc.to)] = true;
    ++first_out_[static_cast<std::size_t>(arc.from) + 1];
  }
  for (int n = 0; n < size; ++n) {
    require(nodes_[static_cast<std::size_t>(n)].model >= WordNetwork::kNull,
            "a node has a model below -1");
    require((n == 0) != has_before[static_cast<std::size_t>(n)],
            "a node that is not the first is without arcs to it");
    require((n + 1 == size) == (first_out_[static_cast<std::size_t>(n) + 1] == 0),
            "a node that is not the last is without arcs from it");
  }
  arcs_ = ordered(arcs_, nodes_.size());
  for (std::size_t n = 0; n < nodes_.size(); ++n) first_out_[n + 1] += first_out_[n];
  std::vector<int> next(first_out_.begin(), first_out_.end());
  out_.resize(arcs_.size());
  for (std::size_t a = 0; a < arcs_.size(); ++a) {
    int& place = next[static_cast<std::size_t>(arcs_[a].from)];
    out_[static_cast<std::size_t>(place++)] = static_cast<int>(a);
  }
}

VectorD Lattice::best_to_end() const {
  VectorD best = VectorD::Constant(static_cast<Eigen::Index>(nodes_.size()), kImpossible);
  if (!empty()) best[best.size() - 1] = 0;
  for (auto arc = arcs_.rbegin(); arc != arcs_.rend(); ++arc)
    best[arc->from] = std::max(best[arc->from], best[arc->to] + arc->log_score());
  return best;
}

DecodedSentence Lattice::best() const {
  std::vector<DecodedSentence> found = n_best(1);
  return found.empty() ? DecodedSentence() : std::move(found.front());
}

VectorD Lattice::posteriors(double scale) const {
  check_scale(scale);
  VectorD result(static_cast<Eigen::Index>(arcs_.size()));
  if (empty()) return result;
  const auto size = static_cast<Eigen::Index>(nodes_.size());
  VectorD before = VectorD::Constant(size, kImpossible);
  VectorD after = before;
  before[0] = 0;
  after[size - 1] = 0;
  std::vector<double> terms;  // of a node
  for (std::size_t a = 0; a < arcs_.size();) {
    const int to = arcs_[a].to;
    terms.clear();
    for (; a < arcs_.size() && arcs_[a].to == to; ++a)
      terms.push_back(before[arcs_[a].from] + scale * arcs_[a].log_score());
    before[to] = log_sum(terms);
  }
  for (Eigen::Index n = size - 1; n-- > 0;) {
    terms.clear();
    const auto node = static_cast<std::size_t>(n);
    for (int o = first_out_[node]; o < first_out_[node + 1]; ++o) {
      const Arc& arc = arcs_[static_cast<std::size_t>(out_[static_cast<std::size_t>(o)])];
      terms.push_back(after[arc.to] + scale * arc.log_score());
    }
    after[n] = log_sum(terms);
  }
  for (Eigen::Index a = 0; a < result.size(); ++a) {
    const Arc& arc = arcs_[static_cast<std::size_t>(a)];
    result[a] = std::min(
        1.0, std::exp(before[arc.from] + scale * arc.log_score() + after[arc.to] - after[0]));
  }
  return result;
}

std::vector<double> Lattice::confidences(const std::vector<DecodedWord>& sentence,
                                         double scale) const {
  const VectorD of_arcs = posteriors(scale);
  std::map<int, std::vector<WordSpan>> spans;  // by model
  for (const DecodedWord& word : sentence) spans[word.model];
  std::vector<std::vector<WordSpan>*> spans_to(nodes_.size());  // null: no word of the sentence
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    const auto found = spans.find(nodes_[n].model);
    if (found != spans.end()) spans_to[n] = &found->second;
  }
  for (std::size_t a = 0; a < arcs_.size(); ++a) {
    const auto to = static_cast<std::size_t>(arcs_[a].to);
    if (spans_to[to] == nullptr) continue;
    spans_to[to]->push_back({nodes_[static_cast<std::size_t>(arcs_[a].from)].frame,
                             nodes_[to].frame, of_arcs[static_cast<Eigen::Index>(a)]});
  }
  std::vector<double> result;
  for (const DecodedWord& word : sentence) {
    std::map<std::int64_t, double> changes;  // of the probability, by frame
    for (const WordSpan& span : spans[word.model]) {
      if (span.last_frame <= word.first_frame || span.first_frame >= word.last_frame) continue;
      changes[std::max(span.first_frame, word.first_frame)] += span.probability;
      changes[span.last_frame] -= span.probability;
    }
    double now = 0;
    double most = 0;
    for (const auto& [frame, change] : changes) {
      now += change;
      if (frame < word.last_frame) most = std::max(most, now);
    }
    result.push_back(std::min(1.0, most));
  }
  return result;
}

std::vector<ConfusionSlot> Lattice::confusion_network(double scale) const {
  const VectorD of_arcs = posteriors(scale);
  if (empty()) return {};
  std::vector<ConfusionSlot> slots;
  const auto add_slot = [&slots](std::int64_t first, std::int64_t last) {
    slots.push_back({first, last, {}});
  };
  std::int64_t frame = 0;
  std::vector<bool> is_silence;
  for (const Node& node : nodes_) {
    if (node.model < 0) continue;
    if (static_cast<std::size_t>(node.model) >= is_silence.size())
      is_silence.resize(static_cast<std::size_t>(node.model) + 1);
    is_silence[static_cast<std::size_t>(node.model)] = node.is_silence;
  }
  for (const DecodedWord& word : best().words) {
    if (is_silence[static_cast<std::size_t>(word.model)]) continue;
    if (frame < word.first_frame) add_slot(frame, word.first_frame);
    add_slot(word.first_frame, word.last_frame);
    frame = word.last_frame;
  }
  if (frame < nodes_.back().frame) add_slot(frame, nodes_.back().frame);
  std::vector<std::map<int, double>> shares(slots.size());
  for (std::size_t a = 0; a < arcs_.size(); ++a) {
    const Node& to = nodes_[static_cast<std::size_t>(arcs_[a].to)];
    if (to.model == WordNetwork::kNull || to.is_silence) continue;
    const std::int64_t first = nodes_[static_cast<std::size_t>(arcs_[a].from)].frame;
    std::size_t best_slot = 0;
    std::int64_t most = 0;
    for (std::size_t s = 0; s < slots.size(); ++s) {
      const std::int64_t shared =
          std::min(to.frame, slots[s].last_frame) - std::max(first, slots[s].first_frame);
      if (shared > most) {
        most = shared;
        best_slot = s;
      }
    }
    shares[best_slot][to.model] += of_arcs[static_cast<Eigen::Index>(a)];
  }
  std::vector<ConfusionSlot> result;
  for (std::size_t s = 0; s < slots.size(); ++s) {
    double sum = 0;
    for (const auto& [model, share] : shares[s]) sum += share;
    if (sum <= 0) continue;
    // Of two words of one sentence in a slot both count.
    const double norm = std::max(1.0, sum);
    for (const auto& [model, share] : shares[s]) slots[s].entries.push_back({model, share / norm});
    slots[s].entries.push_back({WordNetwork::kNull, 1 - sum / norm});
    std::stable_sort(slots[s].entries.begin(), slots[s].entries.end(),
                     [](const auto& a, const auto& b) { return a.probability > b.probability; });
    result.push_back(std::move(slots[s]));
  }
  return result;
}

}  // namespace hri
