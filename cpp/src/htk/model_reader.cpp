// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// ModelSet from the text of files.
#include <cmath>
#include <map>
#include <utility>

#include "hri/core/error.hpp"
#include "hri/htk/model_set.hpp"
#include "htk/model_text.hpp"
#include "htk/text_lines.hpp"

namespace hri::htk {
namespace {

using detail::ModelToken;
using detail::ModelTokens;

using detail::kMostMixtures;
using detail::kMostStates;
constexpr int kMostColumns = 65536;
constexpr double kSumTolerance = 1e-2;  // of probabilities in a few digits
// Values of all definitions, and of all uses of macros: a file could name one macro a million
// times.
constexpr std::int64_t kMostValues = std::int64_t{1} << 24U;

class ModelReader {
 public:
  ModelReader(const std::string& text, const std::string& name, ModelSet* set)
      : tokens_(text, name), set_(set) {
    num_codewords_ = set->num_codewords();
    for (std::size_t i = 0; i < set->macros.size(); ++i) {
      const char type = set->macros[i].type;
      has_gaussians_ = has_gaussians_ || (type != 't' && num_codewords_ == 0);
      index_.emplace(key(type, set->macros[i].name), i);
    }
  }

  void read() {
    while (tokens_.now().kind != ModelToken::Kind::end) {
      if (tokens_.now().kind != ModelToken::Kind::macro)
        tokens_.refuse("expected a macro, such as ~h");
      const char type = tokens_.now().text[0];
      tokens_.advance();
      if (type == 'o') {
        read_options();
      } else {
        read_macro(type);
      }
    }
  }

 private:
  static std::string key(char type, const std::string& name) { return type + name; }

  void read_macro(char type) {
    if (std::string("hsmuvt").find(type) == std::string::npos)
      tokens_.refuse(std::string("macros ~") + type + " are not read");
    MacroDefinition macro;
    macro.type = type;
    macro.name = tokens_.take_name();
    if (index_.count(key(type, macro.name)) > 0)
      tokens_.refuse_taken(std::string("~") + type + " \"" + macro.name + "\" is defined already");
    switch (type) {
      case 'h':
        macro.hmm = hmm();
        break;
      case 's':
        macro.state = state();
        break;
      case 'm':
        macro.component = component();
        break;
      case 'u':
        macro.vector = vector("MEAN", 'u');
        break;
      case 'v':
        macro.vector = vector("VARIANCE", 'v');
        break;
      default:
        macro.transitions = transitions(0);
        break;
    }
    index_.emplace(key(type, macro.name), set_->macros.size());
    set_->macros.push_back(std::move(macro));
  }

  // The macro that is used here, if one is.
  const MacroDefinition* used(char type) {
    if (!tokens_.is_macro(type)) return nullptr;
    tokens_.advance();
    const std::string name = tokens_.now().text;
    const auto found = index_.find(key(type, name));
    if (found == index_.end())
      tokens_.refuse(std::string("~") + type + " \"" + name + "\" is not defined above");
    tokens_.advance();
    return &set_->macros[found->second];
  }

  void count_values(std::int64_t count) {
    num_values_ += count;
    if (num_values_ > kMostValues) tokens_.refuse("the definitions have too many values");
  }

  void read_options() {
    while (tokens_.now().kind == ModelToken::Kind::keyword && tokens_.now().text != "BEGINHMM") {
      if (!option()) tokens_.refuse("<" + tokens_.now().text + "> is not read");
    }
  }

  // Whether an option for all models stands here; it is read then.
  bool option() {
    if (tokens_.skip("STREAMINFO")) {
      if (tokens_.take_whole(1, 1000) != 1) refuse_streams();
      set_size(tokens_.take_whole(1, kMostColumns));
    } else if (tokens_.skip("VECSIZE")) {
      set_size(tokens_.take_whole(1, kMostColumns));
    } else if (tokens_.skip("HMMSETID")) {
      tokens_.take_name();
    } else if (tokens_.is("NULLD") || tokens_.is("DIAGC")) {
      tokens_.advance();
    } else {
      ParameterKind kind;
      if (!ParameterKind::try_parse(tokens_.now().text, &kind).empty()) return false;
      set_kind(kind);
      tokens_.advance();
    }
    return true;
  }

  void set_size(int size) {
    if (set_->vector_size != 0 && set_->vector_size != size)
      tokens_.refuse_taken("vectors had " + std::to_string(set_->vector_size) + " values above");
    set_->vector_size = size;
  }

  void set_kind(ParameterKind kind) {
    if (set_->kind != ParameterKind() && set_->kind != kind)
      tokens_.refuse("the parameter kind was " + set_->kind.text() + " above");
    set_->kind = kind;
  }

  HmmDefinition hmm() {
    tokens_.expect("BEGINHMM");
    while (tokens_.now().kind == ModelToken::Kind::keyword && option()) {
    }
    tokens_.expect("NUMSTATES");
    const int num_states = tokens_.take_whole(3, kMostStates);
    HmmDefinition definition;
    std::map<int, StateDefinition> states;
    while (tokens_.skip("STATE")) {
      const int number = tokens_.take_whole(2, num_states - 1);
      if (!states.emplace(number, state()).second)
        tokens_.refuse_taken("state " + std::to_string(number) + " is defined twice");
    }
    if (static_cast<int>(states.size()) != num_states - 2)
      tokens_.refuse_taken(std::to_string(states.size()) +
                           " states are defined, <NUMSTATES> says " +
                           std::to_string(num_states - 2) + " beside entry and exit");
    for (auto& [number, one] : states) definition.states.push_back(std::move(one));
    definition.transitions = transitions(num_states);
    tokens_.expect("ENDHMM");
    return definition;
  }

  [[noreturn]] void refuse_streams() const {
    tokens_.refuse_taken("models of several streams are not read");
  }

  StateDefinition state() {
    if (const MacroDefinition* macro = used('s'); macro != nullptr) {
      StateDefinition shared = macro->state;
      shared.macro = macro->name;
      for (const WeightedComponent& c : shared.components)
        count_values(2 * c.component.mean.values.size());
      count_values(shared.discrete.size());
      return shared;
    }
    StateDefinition definition;
    if (tokens_.skip("NUMMIXES")) {
      definition.num_mixtures = tokens_.take_whole(1, kMostMixtures);
      // There is one number for each stream.
      if (tokens_.now().kind == ModelToken::Kind::word) refuse_streams();
    }
    if (tokens_.skip("SWEIGHTS")) {
      if (tokens_.take_whole(1, 1000) != 1 || tokens_.take_number() != 1) refuse_streams();
    }
    if (tokens_.skip("STREAM") && tokens_.take_whole(1, 1000) != 1) refuse_streams();
    if (tokens_.is("DPROB")) {
      discrete_state(&definition);
      return definition;
    }
    if (tokens_.skip("TMIX")) {
      tied_mixture(&definition);
      return definition;
    }
    if (definition.num_mixtures == 1 && !tokens_.is("MIXTURE")) {
      definition.components.push_back({1, 1, component()});
      return definition;
    }
    double sum = 0;
    int before = 0;
    while (tokens_.skip("MIXTURE")) {
      WeightedComponent one;
      one.number = tokens_.take_whole(before + 1, definition.num_mixtures);
      one.weight = tokens_.take_number();
      if (one.weight < 0 || one.weight > 1) tokens_.refuse_taken("a weight is outside 0..1");
      one.component = component();
      before = one.number;
      sum += one.weight;
      definition.components.push_back(std::move(one));
    }
    if (!(std::fabs(sum - 1) <= kSumTolerance))
      tokens_.refuse_taken("the weights of a state do not sum to 1");
    return definition;
  }

  // A value, or value*n for n of them, at most `left`; gives n, and leaves the token.
  int repeated(int left, double* value) {
    const std::string& text = tokens_.now().text;
    const std::size_t star = text.find('*');
    double count = 1;
    if (tokens_.now().kind != ModelToken::Kind::word ||
        !detail::parse_number(text.substr(0, star), value) ||
        (star != std::string::npos && !detail::parse_number(text.substr(star + 1), &count)))
      tokens_.refuse("expected a value, or value*times");
    if (count != std::floor(count) || count < 1 || count > left)
      tokens_.refuse("there are more values than <NUMMIXES> says");
    return static_cast<int>(count);
  }

  // The probabilities of codewords, in scaled logs.
  void discrete_state(StateDefinition* definition) {
    if (has_gaussians_) tokens_.refuse("a discrete state, where the others have Gaussians");
    if (set_->kind.base != BaseKind::discrete && set_->kind.base != BaseKind::anon)
      tokens_.refuse("a discrete state, where the parameter kind is " + set_->kind.text());
    if (num_codewords_ != 0 && num_codewords_ != definition->num_mixtures)
      tokens_.refuse("the states above have " + std::to_string(num_codewords_) +
                     " codewords, not " + std::to_string(definition->num_mixtures));
    tokens_.advance();
    num_codewords_ = definition->num_mixtures;
    set_size(1);
    count_values(num_codewords_);
    definition->discrete.resize(num_codewords_);
    for (int at = 0; at < num_codewords_;) {
      double value = 0;
      const int count = repeated(num_codewords_ - at, &value);
      if (value != std::floor(value) || value < 0 || value > 32767)
        tokens_.refuse("a scaled log probability is no whole number in 0..32767");
      definition->discrete.segment(at, count).setConstant(
          detail::from_scaled_log(static_cast<int>(value)));
      at += count;
      tokens_.advance();
    }
    if (!(std::fabs(definition->discrete.sum() - 1) <= kSumTolerance))
      tokens_.refuse_taken("the probabilities of a state do not sum to 1");
  }

  // The weights of Gaussians that are macros of one name and a number: w, or w*n for n of them.
  void tied_mixture(StateDefinition* definition) {
    definition->tied = tokens_.take_name();
    double sum = 0;
    while (static_cast<int>(definition->components.size()) < definition->num_mixtures) {
      double weight = 0;
      const int count = repeated(
          definition->num_mixtures - static_cast<int>(definition->components.size()), &weight);
      if (weight < 0 || weight > 1) tokens_.refuse("a weight is outside 0..1");
      for (int n = 0; n < count; ++n) {
        WeightedComponent one;
        one.number = static_cast<int>(definition->components.size()) + 1;
        one.weight = weight;
        const std::string name = definition->tied + std::to_string(one.number);
        const auto found = index_.find(key('m', name));
        if (found == index_.end()) tokens_.refuse("~m \"" + name + "\" is not defined above");
        one.component = set_->macros[found->second].component;
        one.component.macro = name;
        count_values(2 * one.component.mean.values.size());
        sum += weight;
        definition->components.push_back(std::move(one));
      }
      tokens_.advance();
    }
    if (!(std::fabs(sum - 1) <= kSumTolerance))
      tokens_.refuse_taken("the weights of a state do not sum to 1");
  }

  ComponentDefinition component() {
    if (const MacroDefinition* macro = used('m'); macro != nullptr) {
      ComponentDefinition shared = macro->component;
      shared.macro = macro->name;
      count_values(2 * shared.mean.values.size());
      return shared;
    }
    ComponentDefinition definition;
    if (tokens_.skip("RCLASS")) tokens_.take_whole(0, 1000000000);
    definition.mean = vector("MEAN", 'u');
    definition.variance = vector("VARIANCE", 'v');
    if (tokens_.skip("GCONST")) {
      definition.has_gconst = true;
      definition.gconst = tokens_.take_number();
    }
    return definition;
  }

  VectorDefinition vector(const char* keyword, char type) {
    if (const MacroDefinition* macro = used(type); macro != nullptr) {
      count_values(macro->vector.values.size());
      return {macro->name, macro->vector.values};
    }
    tokens_.expect(keyword);
    if (num_codewords_ != 0 || set_->kind.base == BaseKind::discrete)
      tokens_.refuse_taken("a Gaussian, where the models are discrete");
    has_gaussians_ = true;
    const int size = tokens_.take_whole(1, kMostColumns);
    set_size(size);
    VectorDefinition definition;
    count_values(size);
    definition.values.resize(size);
    for (int i = 0; i < size; ++i) {
      definition.values[i] = tokens_.take_number();
      if (type == 'v' && !(definition.values[i] > 0))
        tokens_.refuse_taken("a variance is not above 0");
    }
    return definition;
  }

  // Of `num_states`, or of any number: 0.
  TransitionDefinition transitions(int num_states) {
    if (const MacroDefinition* macro = used('t'); macro != nullptr) {
      if (macro->transitions.values.rows() != num_states)
        tokens_.refuse_taken("~t \"" + macro->name + "\" has another number of states");
      count_values(macro->transitions.values.size());
      return {macro->name, macro->transitions.values};
    }
    tokens_.expect("TRANSP");
    const int size = tokens_.take_whole(3, kMostStates);
    if (num_states != 0 && size != num_states)
      tokens_.refuse_taken("<TRANSP> has another number of states than <NUMSTATES>");
    TransitionDefinition definition;
    count_values(std::int64_t{size} * size);
    definition.values.resize(size, size);
    for (int i = 0; i < size; ++i) {
      double sum = 0;
      for (int j = 0; j < size; ++j) {
        const double value = tokens_.take_number();
        if (value < 0 || value > 1) tokens_.refuse_taken("a transition is outside 0..1");
        if (value > 0 && (j == 0 || i == size - 1))
          tokens_.refuse_taken("a transition leads to the entry or from the exit");
        definition.values(i, j) = value;
        sum += value;
      }
      if (i < size - 1 && !(std::fabs(sum - 1) <= kSumTolerance))
        tokens_.refuse_taken("the transitions from state " + std::to_string(i + 1) +
                             " do not sum to 1");
    }
    return definition;
  }

  ModelTokens tokens_;
  ModelSet* set_;
  std::map<std::string, std::size_t> index_;
  std::int64_t num_values_ = 0;
  int num_codewords_ = 0;       // of the discrete states above
  bool has_gaussians_ = false;  // or macros for them
};

}  // namespace

void ModelSet::parse(const std::string& text, const std::string& name) {
  detail::require_text(text, name);
  ModelSet changed = *this;
  ModelReader(text, name, &changed).read();
  *this = std::move(changed);
}

void ModelSet::read(const std::string& path) { parse(detail::read_text(path), path); }

}  // namespace hri::htk
