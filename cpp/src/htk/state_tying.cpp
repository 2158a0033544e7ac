// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "htk/state_tying.hpp"

#include <algorithm>
#include <cstdint>
#include <set>
#include <utility>

#include "hri/core/error.hpp"
#include "htk/model_text.hpp"
#include "htk/text_lines.hpp"

namespace hri::htk::detail {
namespace {

constexpr double kMostOccupation = 1e15;
constexpr std::size_t kMostStatesOfCommand = 4096;            // whose distances are kept
constexpr std::int64_t kMostUnseen = std::int64_t{1} << 24U;  // values of models that AU adds

int rank(char type) { return type == 'h' ? 3 : type == 's' ? 2 : type == 'm' ? 1 : 0; }

[[noreturn]] void refuse_command(const std::string& where, const std::string& why) {
  fail(ErrorKind::format, where + ": " + why);
}

std::string both(const std::string& first, const std::string& second) {
  return "'" + first + "' and '" + second + "'";
}

StateDefinition& state_at(const StatePlace& place, ModelSet* set) {
  return set->macros[place.macro].hmm.states[place.state];
}

// Puts `state` in place of those of a group, under a name.
void tie_group(const std::string& where, const std::string& name, StateDefinition state,
               const std::vector<std::size_t>& group, const std::vector<StatePlace>& places,
               ModelSet* set) {
  if (set->find('s', name) != nullptr)
    refuse_command(where, "~s \"" + name + "\" is defined already");
  state.macro = name;
  for (const std::size_t member : group) state_at(places[member], set) = state;
  MacroDefinition made;
  made.type = 's';
  made.name = name;
  made.state = std::move(state);
  made.state.macro.clear();
  set->macros.push_back(std::move(made));
}

std::string names_text(const std::string& name, const std::string& physical) {
  require_name(name, "the name of a model");
  return name == physical ? quoted(name) + "\n" : quoted(name) + " " + quoted(physical) + "\n";
}

}  // namespace

std::string without_contexts(const std::string& name) {
  const std::size_t minus = name.rfind('-');
  const std::string rest = minus == std::string::npos ? name : name.substr(minus + 1);
  return rest.substr(0, rest.find('+'));
}

void sort_macros(ModelSet* set) {
  std::stable_sort(set->macros.begin(), set->macros.end(),
                   [](const MacroDefinition& a, const MacroDefinition& b) {
                     return rank(a.type) < rank(b.type);
                   });
}

Occupations parse_statistics(const std::string& text, const std::string& name) {
  TextLines lines(text, name);
  Occupations found;
  while (lines.next()) {
    const std::vector<std::string> fields = lines.fields();
    if (fields.empty()) continue;
    if (fields.size() < 4) lines.refuse("expected number, name, occurrences and frames of states");
    std::vector<double> frames;
    for (std::size_t f = 2; f < fields.size(); ++f) {
      const double value = lines.number_of(fields[f], kMostOccupation);
      if (value < 0) lines.refuse("a number of frames is below 0");
      if (f > 2) frames.push_back(value);
    }
    if (!found.emplace(fields[1], std::move(frames)).second)
      lines.refuse("'" + fields[1] + "' stands here again");
  }
  return found;
}

std::vector<ListedModel> parse_model_list(const std::string& text, const std::string& name) {
  TextLines lines(text, name);
  std::vector<ListedModel> listed;
  while (lines.next()) {
    const std::vector<std::string> fields = lines.fields();
    if (fields.empty()) continue;
    if (fields.size() > 1 || fields[0].empty()) lines.refuse("expected the name of a model");
    listed.push_back({fields[0], lines.number()});
  }
  return listed;
}

void StateTying::read_statistics(const std::string& path) {
  occupations_ = parse_statistics(read_text(path), path);
  statistics_path_ = path;
}

void StateTying::add_question(const std::string& where, const ContextQuestion& question) {
  for (const ContextQuestion& known : trees_.questions) {
    if (known.name == question.name)
      refuse_command(where, "the question '" + question.name + "' is defined already");
  }
  trees_.questions.push_back(question);
}

std::vector<StateStatistics> StateTying::statistics_of(const std::string& where,
                                                       const std::vector<StatePlace>& places,
                                                       const ModelSet& set) const {
  if (statistics_path_.empty()) refuse_command(where, "no RO or LS before it names statistics");
  if (places.size() > kMostStatesOfCommand)
    refuse_command(where,
                   "there are more than " + std::to_string(kMostStatesOfCommand) + " states");
  std::vector<StateStatistics> all;
  for (const StatePlace& place : places) {
    const MacroDefinition& macro = set.macros[place.macro];
    const StateDefinition& state = macro.hmm.states[place.state];
    const std::string what =
        "state " + std::to_string(place.state + 2) + " of '" + macro.name + "'";
    if (state.components.size() != 1) refuse_command(where, what + " is not of one Gaussian");
    const auto found = occupations_.find(macro.name);
    if (found == occupations_.end() || found->second.size() <= place.state)
      refuse_command(where, "the statistics " + statistics_path_ + " do not have " + what);
    const ComponentDefinition& gaussian = state.components.front().component;
    all.push_back(
        {macro.name, found->second[place.state], gaussian.mean.values, gaussian.variance.values});
    if (gaussian.mean.values.size() != all.front().mean.size() ||
        gaussian.variance.values.size() != all.front().mean.size())
      refuse_command(where, "the states have vectors of different sizes");
  }
  return all;
}

void StateTying::tie_by_tree(const std::string& where, const EditCommand& command,
                             const std::vector<StatePlace>& places, ModelSet* set) {
  const std::string unit = without_contexts(set->macros[places.front().macro].name);
  for (const StatePlace& place : places) {
    const std::string& name = set->macros[place.macro].name;
    if (without_contexts(name) != unit || place.state != places.front().state)
      refuse_command(where, "a tree is of one state of one unit: not of " + both(unit, name));
  }
  const std::vector<StateStatistics> states = statistics_of(where, places, *set);
  TiedByTree made =
      detail::tie_by_tree(states, trees_.questions, command.threshold, least_occupation_);
  made.tree.unit = unit;
  made.tree.state = static_cast<int>(places.front().state) + 2;
  for (DecisionTree::Node& node : made.tree.nodes) {
    if (node.question < 0) node.leaf = command.macro + node.leaf;
  }
  for (std::size_t g = 0; g < made.groups.size(); ++g) {
    const StateStatistics all = pooled(states, made.groups[g]);
    StateDefinition state;
    state.components.emplace_back();
    state.components.front().component.mean.values = all.mean;
    state.components.front().component.variance.values = all.variance;
    tie_group(where, command.macro + std::to_string(g + 1), std::move(state), made.groups[g],
              places, set);
  }
  trees_.trees.push_back(std::move(made.tree));
  sort_macros(set);
}

void StateTying::tie_clusters(const std::string& where, const EditCommand& command,
                              const std::vector<StatePlace>& places, ModelSet* set) const {
  // Without statistics no group is too small.
  StateTying counted;
  if (statistics_path_.empty()) {
    counted.statistics_path_ = "-";
    for (const StatePlace& place : places) {
      const MacroDefinition& macro = set->macros[place.macro];
      counted.occupations_[macro.name].assign(macro.hmm.states.size(), 1);
    }
  }
  const std::vector<StateStatistics> states =
      (statistics_path_.empty() ? counted : *this).statistics_of(where, places, *set);
  const auto groups =
      cluster(states, command.threshold, statistics_path_.empty() ? 0 : least_occupation_);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const std::size_t broadest =
        *std::max_element(groups[g].begin(), groups[g].end(), [&](std::size_t a, std::size_t b) {
          return states[a].variance.array().log().sum() < states[b].variance.array().log().sum();
        });
    tie_group(where, command.macro + std::to_string(g + 1), state_at(places[broadest], set),
              groups[g], places, set);
  }
  sort_macros(set);
}

void StateTying::add_unseen(const std::string& where, const std::string& list,
                            ModelSet* set) const {
  std::map<std::string, std::size_t> of_unit;  // the first model of every unit
  std::set<std::string> names;
  std::map<std::string, std::size_t> leaves;
  for (std::size_t m = 0; m < set->macros.size(); ++m) {
    const MacroDefinition& macro = set->macros[m];
    if (macro.type == 's') leaves.emplace(macro.name, m);
    if (macro.type != 'h') continue;
    names.insert(macro.name);
    of_unit.emplace(without_contexts(macro.name), m);
  }
  std::int64_t num_values = 0;
  for (const auto& [name, line] : parse_model_list(read_text(list), list)) {
    const std::string listed = list + ": line " + std::to_string(line);
    if (!names.insert(name).second) continue;
    const std::string unit = without_contexts(name);
    const auto found = of_unit.find(unit);
    if (found == of_unit.end())
      refuse_command(listed, "there is no model of the same unit: of " + both(unit, name));
    MacroDefinition made = set->macros[found->second];
    made.name = name;
    for (std::size_t s = 0; s < made.hmm.states.size(); ++s) {
      StateDefinition& state = made.hmm.states[s];
      const int number = static_cast<int>(s) + 2;
      if (const DecisionTree* tree = trees_.find(unit, number); tree != nullptr) {
        const auto leaf = leaves.find(trees_.leaf_of(*tree, name));
        if (leaf == leaves.end())
          refuse_command(where, "there is no ~s \"" + trees_.leaf_of(*tree, name) + "\" of a tree");
        state = set->macros[leaf->second].state;
        state.macro = leaf->first;
      } else if (state.macro.empty()) {
        refuse_command(
            listed, "there is no tree for state " + std::to_string(number) + " of '" + unit + "'");
      }
      num_values += 2 * set->vector_size;
    }
    num_values += made.hmm.transitions.values.size();
    if (num_values > kMostUnseen) refuse_command(listed, "the models have too many values");
    set->macros.push_back(std::move(made));
  }
}

void StateTying::read_trees(const std::string& where, const std::string& path) {
  if (!trees_.questions.empty() || !trees_.trees.empty())
    refuse_command(where, "LT stands before all questions and trees");
  trees_ = DecisionTrees::read(path);
}

std::string merge_equal_models(ModelSet* set) {
  std::string text;
  std::map<std::vector<std::string>, std::string> known;
  std::vector<MacroDefinition> kept;
  for (MacroDefinition& macro : set->macros) {
    if (macro.type == 'h') {
      std::vector<std::string> parts{macro.hmm.transitions.macro};
      for (const StateDefinition& state : macro.hmm.states) parts.push_back(state.macro);
      const bool is_shared = std::none_of(parts.begin(), parts.end(),
                                          [](const std::string& part) { return part.empty(); });
      const auto found =
          is_shared ? known.emplace(std::move(parts), macro.name).first : known.end();
      const std::string physical = is_shared ? found->second : macro.name;
      text += names_text(macro.name, physical);
      if (physical != macro.name) continue;
    }
    kept.push_back(std::move(macro));
  }
  set->macros = std::move(kept);
  return text;
}

}  // namespace hri::htk::detail
