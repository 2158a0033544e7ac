// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// EditScript on models.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include "hri/core/error.hpp"
#include "hri/htk/edit_script.hpp"
#include "hri/htk/labels.hpp"
#include "htk/model_text.hpp"
#include "htk/shared_parameters.hpp"
#include "htk/state_tying.hpp"
#include "htk/text_lines.hpp"

namespace hri::htk {
namespace {

constexpr double kPerturbation = 0.2;  // standard deviations
using detail::kMostMixtures;

// Where something stands in a set: the model, and what of it the item names.
struct Place {
  std::size_t macro = 0;
  std::size_t state = 0;
  std::size_t component = 0;
};

bool holds(const std::vector<EditItem::Numbers>& ranges, int number) {
  return std::any_of(ranges.begin(), ranges.end(), [number](const EditItem::Numbers& r) {
    return number >= r.low && number <= r.high;
  });
}

// The two Gaussians that one is split into share nothing with others any more.
void split(std::size_t heaviest, std::vector<WeightedComponent>* components) {
  WeightedComponent& one = (*components)[heaviest];
  one.weight /= 2;
  one.component.macro.clear();
  one.component.mean.macro.clear();
  one.component.variance.macro.clear();
  WeightedComponent other = one;
  const VectorD shift = kPerturbation * one.component.variance.values.cwiseSqrt();
  one.component.mean.values += shift;
  other.component.mean.values -= shift;
  components->push_back(std::move(other));
}

void split_up_to(std::size_t count, std::vector<WeightedComponent>* components) {
  std::vector<double> scores;
  for (const WeightedComponent& one : *components) scores.push_back(one.weight);
  while (components->size() < count) {
    const auto heaviest =
        static_cast<std::size_t>(std::max_element(scores.begin(), scores.end()) - scores.begin());
    split(heaviest, components);
    // Every split costs 1, more than any weight: those split before come last.
    scores[heaviest] = std::floor(scores[heaviest]) - 1 + (*components)[heaviest].weight;
    scores.push_back(scores[heaviest]);
  }
}

double breadth(const ComponentDefinition& component) {
  return component.variance.values.array().log().sum();
}

double breadth(const StateDefinition& state) {
  double sum = 0;
  for (const WeightedComponent& one : state.components) sum += one.weight * breadth(one.component);
  return sum;
}

using detail::without_contexts;
constexpr std::int64_t kMostCloned = std::int64_t{1} << 24U;  // values of all copies

std::int64_t size_of(const HmmDefinition& hmm) {
  std::int64_t size = hmm.transitions.values.size();
  for (const StateDefinition& state : hmm.states) {
    for (const WeightedComponent& one : state.components)
      size += 2 * one.component.mean.values.size();
    size += state.discrete.size();
  }
  return size;
}

class Editor {
 public:
  Editor(ModelSet* set, const std::string& name, std::vector<EditedFile>* files)
      : set_(set), name_(name), files_(files) {}

  void run(const EditCommand& command) {
    line_ = command.line;
    if (run_without_items(command)) return;
    const std::vector<Place> places = find(command.items);
    if (places.empty()) refuse("no model has what the items name");
    switch (command.kind) {
      case EditCommand::Kind::split_mixtures:
        split_mixtures(command, places);
        break;
      case EditCommand::Kind::tie:
        tie(command.macro, command.items.front().kind, places);
        break;
      case EditCommand::Kind::tie_by_tree:
        tying_.tie_by_tree(where(), command, states_of(places), set_);
        break;
      case EditCommand::Kind::tie_clusters:
        tying_.tie_clusters(where(), command, states_of(places), set_);
        break;
      default:
        change_transitions(command, places);
        break;
    }
  }

 private:
  // Whether it was a command of this kind.
  bool run_without_items(const EditCommand& command) {
    switch (command.kind) {
      case EditCommand::Kind::clone:
        clone(command.path);
        return true;
      case EditCommand::Kind::question:
        tying_.add_question(where(), command.question);
        return true;
      case EditCommand::Kind::statistics:
        if (command.least_occupation >= 0) tying_.set_least_occupation(command.least_occupation);
        if (!command.path.empty()) tying_.read_statistics(command.path);
        return true;
      case EditCommand::Kind::add_unseen:
        tying_.add_unseen(where(), command.path, set_);
        return true;
      case EditCommand::Kind::merge_equal:
        write(command.path, detail::merge_equal_models(set_));
        return true;
      case EditCommand::Kind::save_trees:
        write(command.path, tying_.trees_text());
        return true;
      case EditCommand::Kind::load_trees:
        tying_.read_trees(where(), command.path);
        return true;
      default:
        return false;
    }
  }

  void write(const std::string& path, std::string text) {
    if (files_ != nullptr) files_->push_back({path, std::move(text)});
  }

  static std::vector<detail::StatePlace> states_of(const std::vector<Place>& places) {
    std::vector<detail::StatePlace> states;
    states.reserve(places.size());
    for (const Place& place : places) states.push_back({place.macro, place.state});
    return states;
  }

  // Models of a list in place of those that there are: these, or copies of those without contexts.
  void clone(const std::string& list) {
    std::map<std::string, const MacroDefinition*> known;
    for (const MacroDefinition& macro : set_->macros) {
      if (macro.type == 'h') known.emplace(macro.name, &macro);
    }
    std::vector<MacroDefinition> made;
    std::set<std::string> names;
    std::int64_t num_values = 0;
    for (const auto& [name, line] : detail::parse_model_list(detail::read_text(list), list)) {
      const auto refuse_name = [&list, number = line](const std::string& why) {
        std::string text = list;
        text.append(": line ").append(std::to_string(number)).append(": ").append(why);
        fail(ErrorKind::format, text);
      };
      if (!names.insert(name).second) refuse_name("'" + name + "' stands here again");
      auto found = known.find(name);
      if (found == known.end()) found = known.find(without_contexts(name));
      if (found == known.end())
        refuse_name("there is no model '" + name + "', and no '" + without_contexts(name) + "'");
      made.push_back(*found->second);
      made.back().name = name;
      num_values += size_of(made.back().hmm);
      if (num_values > kMostCloned) refuse_name("the copies have too many values");
    }
    if (made.empty()) refuse("the list '" + list + "' has no model");
    const auto is_model = [](const MacroDefinition& macro) { return macro.type == 'h'; };
    set_->macros.erase(std::remove_if(set_->macros.begin(), set_->macros.end(), is_model),
                       set_->macros.end());
    std::move(made.begin(), made.end(), std::back_inserter(set_->macros));
  }

  [[noreturn]] void refuse(const std::string& why) const {
    fail(ErrorKind::format, where() + ": " + why);
  }
  [[nodiscard]] std::string where() const { return name_ + ": line " + std::to_string(line_); }

  [[nodiscard]] HmmDefinition& hmm(const Place& place) { return set_->macros[place.macro].hmm; }
  [[nodiscard]] StateDefinition& state(const Place& place) {
    return hmm(place).states[place.state];
  }
  [[nodiscard]] ComponentDefinition& component(const Place& place) {
    return state(place).components[place.component].component;
  }

  std::vector<Place> find(const std::vector<EditItem>& items) {
    std::vector<Place> places;
    std::set<std::vector<std::size_t>> known;
    const auto add = [&](const Place& place) {
      if (known.insert({place.macro, place.state, place.component}).second) places.push_back(place);
    };
    for (const EditItem& item : items) {
      for (std::size_t m = 0; m < set_->macros.size(); ++m) {
        const MacroDefinition& macro = set_->macros[m];
        const auto fits = [&](const std::string& pattern) { return matches(pattern, macro.name); };
        if (macro.type == 'h' && std::any_of(item.models.begin(), item.models.end(), fits))
          find_in(macro.hmm, m, item, add);
      }
    }
    return places;
  }

  template <class Add>
  static void find_in(const HmmDefinition& hmm, std::size_t macro, const EditItem& item,
                      const Add& add) {
    if (item.kind == EditItem::Kind::transitions) {
      add({macro, 0, 0});
      return;
    }
    for (std::size_t s = 0; s < hmm.states.size(); ++s) {
      if (!holds(item.states, static_cast<int>(s) + 2)) continue;
      const auto& components = hmm.states[s].components;
      if (item.kind == EditItem::Kind::state || item.kind == EditItem::Kind::mixtures)
        add({macro, s, 0});
      for (std::size_t c = 0; c < components.size(); ++c) {
        if (holds(item.mixtures, components[c].number)) add({macro, s, c});
      }
    }
  }

  // Every state of the set, those that macros define among them; also the name of that macro.
  template <class F>
  void each_state(const F& f) {
    for (MacroDefinition& macro : set_->macros) {
      if (macro.type == 's') f(macro.state, macro.name);
      for (StateDefinition& one : macro.hmm.states) f(one, one.macro);
    }
  }

  // Calls f for the state of a place, wherever it stands.
  template <class F>
  void with_state(const Place& place, const F& f) {
    const std::string shared = state(place).macro;
    if (shared.empty()) {
      f(state(place));
      return;
    }
    each_state([&](StateDefinition& one, const std::string& macro) {
      if (macro == shared) f(one);
    });
  }

  template <class F>
  void with_component(const Place& place, const F& f) {
    const std::string shared = component(place).macro;
    if (shared.empty()) {
      with_state(place,
                 [&](StateDefinition& one) { f(one.components[place.component].component); });
      return;
    }
    for (MacroDefinition& macro : set_->macros) {
      if (macro.type == 'm' && macro.name == shared) f(macro.component);
    }
    each_state([&](StateDefinition& one, const std::string&) {
      for (WeightedComponent& of : one.components) {
        if (of.component.macro == shared) f(of.component);
      }
    });
  }

  void split_mixtures(const EditCommand& command, const std::vector<Place>& places) {
    std::set<std::string> done;
    for (const Place& place : places) {
      if (!state(place).macro.empty() && !done.insert(state(place).macro).second) continue;
      std::vector<WeightedComponent> made;
      for (const WeightedComponent& one : state(place).components) {
        if (one.weight > 0) made.push_back(one);
      }
      if (made.empty()) refuse("a mixture has no Gaussian with weight");
      const std::size_t count =
          static_cast<std::size_t>(command.num_mixtures) + (command.is_more ? made.size() : 0);
      if (count > std::size_t{kMostMixtures})
        refuse("a mixture would have more than " + std::to_string(kMostMixtures) + " Gaussians");
      split_up_to(count, &made);
      for (std::size_t c = 0; c < made.size(); ++c) made[c].number = static_cast<int>(c) + 1;
      with_state(place, [&](StateDefinition& one) {
        one.components = made;
        one.num_mixtures = static_cast<int>(made.size());
      });
    }
  }

  void tie(const std::string& name, EditItem::Kind kind, const std::vector<Place>& places) {
    MacroDefinition made;
    made.name = name;
    switch (kind) {
      case EditItem::Kind::transitions:
        made.type = 't';
        tie_transitions(places, &made);
        break;
      case EditItem::Kind::state:
        made.type = 's';
        tie_states(places, &made);
        break;
      case EditItem::Kind::mixture:
        made.type = 'm';
        tie_components(places, &made);
        break;
      default:
        made.type = kind == EditItem::Kind::mean ? 'u' : 'v';
        tie_vectors(places, &made);
        break;
    }
    if (set_->find(made.type, name) != nullptr)
      refuse(std::string("~") + made.type + " \"" + name + "\" is defined already");
    set_->macros.push_back(std::move(made));
    detail::sort_macros(set_);
  }

  void tie_transitions(const std::vector<Place>& places, MacroDefinition* made) {
    made->transitions.values = hmm(places.front()).transitions.values;
    for (const Place& place : places) {
      if (hmm(place).transitions.values.rows() != made->transitions.values.rows())
        refuse("the models have different numbers of states");
      hmm(place).transitions = {made->name, made->transitions.values};
    }
  }

  void tie_states(const std::vector<Place>& places, MacroDefinition* made) {
    const Place& broadest = *std::max_element(
        places.begin(), places.end(),
        [&](const Place& a, const Place& b) { return breadth(state(a)) < breadth(state(b)); });
    made->state = state(broadest);
    made->state.macro.clear();
    for (const Place& place : places) {
      state(place) = made->state;
      state(place).macro = made->name;
    }
  }

  void tie_components(const std::vector<Place>& places, MacroDefinition* made) {
    const Place& broadest =
        *std::max_element(places.begin(), places.end(), [&](const Place& a, const Place& b) {
          return breadth(component(a)) < breadth(component(b));
        });
    made->component = component(broadest);
    made->component.macro.clear();
    for (const Place& place : places) {
      with_state(place, [&](StateDefinition& one) {
        one.components[place.component].component = made->component;
        one.components[place.component].component.macro = made->name;
      });
    }
  }

  void tie_vectors(const std::vector<Place>& places, MacroDefinition* made) {
    const bool means = made->type == 'u';
    VectorD values =
        means ? component(places.front()).mean.values : component(places.front()).variance.values;
    for (std::size_t p = 1; p < places.size(); ++p) {
      const ComponentDefinition& one = component(places[p]);
      if (means) {
        values += one.mean.values;
      } else {
        values = values.cwiseMax(one.variance.values);
      }
    }
    if (means) values /= static_cast<double>(places.size());
    made->vector.values = values;
    for (const Place& place : places) {
      with_component(place, [&](ComponentDefinition& one) {
        (means ? one.mean : one.variance) = {made->name, values};
        if (!means) one.has_gconst = false;  // computed anew below
      });
    }
  }

  void change_transitions(const EditCommand& command, const std::vector<Place>& places) {
    std::set<std::string> done;
    for (const Place& place : places) {
      const std::string shared = hmm(place).transitions.macro;
      if (!shared.empty() && !done.insert(shared).second) continue;
      MatrixD values = hmm(place).transitions.values;
      change_row(command, set_->macros[place.macro].name, &values);
      for (MacroDefinition& macro : set_->macros) {
        if (macro.type == 't' && macro.name == shared) macro.transitions.values = values;
        if (macro.type == 'h' && !shared.empty() && macro.hmm.transitions.macro == shared)
          macro.hmm.transitions.values = values;
      }
      hmm(place).transitions.values = values;
    }
  }

  void change_row(const EditCommand& command, const std::string& model, MatrixD* values) const {
    if (command.from >= values->rows() || command.to > values->rows())
      refuse("the model '" + model + "' has " + std::to_string(values->rows()) + " states");
    const bool added = command.kind == EditCommand::Kind::add_transition;
    auto row = values->row(command.from - 1);
    if (!added && row[command.to - 1] == 0)
      refuse("the model '" + model + "' has no such transition");
    row[command.to - 1] = 0;
    const double others = row.sum();
    const double left = added ? 1 - command.probability : 1;
    if (left > 0 && !(others > 0))
      refuse("the model '" + model + "' has no other transition from the state");
    if (others > 0) row *= left / others;
    row[command.to - 1] = added ? command.probability : 0;
  }

  ModelSet* set_;
  const std::string& name_;
  std::vector<EditedFile>* files_;
  std::int64_t line_ = 0;
  detail::StateTying tying_;
};

}  // namespace

ModelSet EditScript::apply(ModelSet models, std::vector<EditedFile>* files) const {
  Editor editor(&models, name, files);
  for (const EditCommand& command : commands) editor.run(command);
  return detail::SharedParameters(models).applied_to(models);
}

}  // namespace hri::htk
