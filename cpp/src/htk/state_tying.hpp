// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// HHEd's commands on states of models in context: RO, LS, QS, TB, TC, AU, CO, ST and LT.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "hri/htk/decision_trees.hpp"
#include "hri/htk/edit_script.hpp"
#include "hri/htk/model_set.hpp"
#include "htk/state_clustering.hpp"

namespace hri::htk::detail {

/// b of a-b+c.
std::string without_contexts(const std::string& name);

/// Macros before all models: what a definition uses stands before it.
void sort_macros(ModelSet* set);

/// Frames in which the states of a model were met, by its name.
using Occupations = std::map<std::string, std::vector<double>>;

/// Statistics as HERest writes them. Throws FormatError naming file and line; `name` stands for the
/// path.
Occupations parse_statistics(const std::string& text, const std::string& name);

/// A name that a list of models has, and where.
struct ListedModel {
  std::string name;
  std::int64_t line = 1;
};

/// A list of models, one a line; throws as parse_statistics() does.
std::vector<ListedModel> parse_model_list(const std::string& text, const std::string& name);

/// A state of a model.
struct StatePlace {
  std::size_t macro = 0;
  std::size_t state = 0;  ///< of those that emit, from 0
};

/// What commands leave for those behind them. Errors begin with `where`: file and line of a
/// command.
class StateTying {
 public:
  /// RO and LS: the least number of frames of a group of states, and frames of every state.
  void set_least_occupation(double num_frames) { least_occupation_ = num_frames; }
  void read_statistics(const std::string& path);

  void add_question(const std::string& where, const ContextQuestion& question);

  /// TB: ties states of one Gaussian by a decision tree to the mean and variance of their frames.
  void tie_by_tree(const std::string& where, const EditCommand& command,
                   const std::vector<StatePlace>& places, ModelSet* set);
  /// TC: ties states of one Gaussian that are near one another to the broadest of each group.
  void tie_clusters(const std::string& where, const EditCommand& command,
                    const std::vector<StatePlace>& places, ModelSet* set) const;

  /// AU: adds the models of a list that there are not, of the states that the trees find.
  void add_unseen(const std::string& where, const std::string& list, ModelSet* set) const;

  void read_trees(const std::string& where, const std::string& path);
  [[nodiscard]] std::string trees_text() const { return trees_.to_text(); }

 private:
  [[nodiscard]] std::vector<StateStatistics> statistics_of(const std::string& where,
                                                           const std::vector<StatePlace>& places,
                                                           const ModelSet& set) const;

  double least_occupation_ = 0;
  std::string statistics_path_;
  Occupations occupations_;
  DecisionTrees trees_;
};

/// CO: of models that share all states and transitions, the first stays. Gives the list of models:
/// names, each with that of the model that stays where it is another one.
std::string merge_equal_models(ModelSet* set);

}  // namespace hri::htk::detail
