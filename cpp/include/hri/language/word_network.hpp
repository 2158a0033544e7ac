// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Which words may follow which: a network whose nodes are words, as in HTK's standard lattice
// format.
#pragma once

#include <string>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/language/ngram_model.hpp"

namespace hri {

/// Immutable; const calls are safe from several threads. Invariants: a sentence is a path from
/// initial() to final(), which are null nodes; null nodes alone make no cycle.
class HRI_API WordNetwork {
 public:
  static constexpr int kNull = -1;       ///< model of a node that stands for no word
  static constexpr int kNoSilence = -1;  ///< of the functions below: none between the words

  struct Arc {
    int from = 0;
    int to = 0;
    double log_weight = 0;  ///< natural log
  };

  /// `models[n]` is the number of the model of node n, or kNull. Throws InvalidArgument for numbers
  /// out of range, weights not finite, a cycle of null nodes, and where no path leads from the
  /// initial to the final node.
  WordNetwork(std::vector<int> models, std::vector<Arc> arcs, int initial, int final);

  /// Any number of words, none included, in any order: models 0 .. num_words - 1. With the number
  /// of a `silence` model it may stand before, between and after them.
  static WordNetwork loop(int num_words, int silence = kNoSilence);
  /// The same of the models `words`.
  static WordNetwork loop(const std::vector<int>& words, int silence = kNoSilence);
  /// `length` words, 1..1000, in any order.
  static WordNetwork sequence(int num_words, int length, int silence = kNoSilence);
  /// The given words in this order: for forced alignment. Throws InvalidArgument for none.
  static WordNetwork transcript(const std::vector<int>& words, int silence = kNoSilence);
  /// Any number of words, weighted by a model of order 1 or 2; model i is the word labels[i].
  /// Throws InvalidArgument for other orders and for labels that the model does not know.
  static WordNetwork bigram(const NGramModel& language, const std::vector<std::string>& labels,
                            int silence = kNoSilence);

  /// The same network with other models: in place of model i any one of variants[i], as with
  /// several pronunciations of a word. Throws InvalidArgument where a model has no variant, and for
  /// numbers below 0.
  [[nodiscard]] WordNetwork with_variants(const std::vector<std::vector<int>>& variants) const;

  [[nodiscard]] const std::vector<int>& models() const { return models_; }
  /// In the order in which scores pass on: those from words first, then those from null nodes, a
  /// null node after all that lead to it.
  [[nodiscard]] const std::vector<Arc>& arcs() const { return arcs_; }
  [[nodiscard]] int num_nodes() const { return static_cast<int>(models_.size()); }
  [[nodiscard]] int initial() const { return initial_; }
  [[nodiscard]] int final() const { return final_; }

 private:
  void check() const;
  void sort_arcs();

  std::vector<int> models_;
  std::vector<Arc> arcs_;
  int initial_;
  int final_;
};

}  // namespace hri
