// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// ModelSet to text, in HTK's layout.
#include <cmath>
#include <locale>
#include <sstream>

#include "hri/core/error.hpp"
#include "hri/htk/model_set.hpp"
#include "htk/model_text.hpp"
#include "htk/text_lines.hpp"

namespace hri::htk {
namespace {

// As C's %e has it.
std::string scientific(double value, int digits) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out.setf(std::ios::scientific, std::ios::floatfield);
  out.precision(digits);
  out << value;
  return out.str();
}

std::string number(double value) {
  require(std::isfinite(value) && std::fabs(value) <= 1e30, "a value of a model is not finite");
  constexpr int kOfHtk = 6;
  constexpr int kExact = 16;
  const std::string shorter = scientific(value, kOfHtk);
  double read = 0;
  return detail::parse_number(shorter, &read) && read == value ? shorter
                                                               : scientific(value, kExact);
}

class ModelWriter {
 public:
  std::string write(const ModelSet& set, std::size_t first, std::size_t last) {
    if (set.vector_size > 0 || set.kind != ParameterKind()) {
      const std::string size = std::to_string(set.vector_size);
      text_ += "~o\n";
      if (set.vector_size > 0)
        text_ += "<STREAMINFO> 1 " + size + "\n<VECSIZE> " + size + "<NULLD>";
      if (set.kind != ParameterKind()) text_ += "<" + set.kind.text() + ">";
      text_ += "<DIAGC>\n";
    }
    for (std::size_t i = first; i < last; ++i) add(set.macros[i]);
    return text_;
  }

 private:
  static std::string name_text(const std::string& name) {
    detail::require_name(name, "the name of a macro");
    return detail::in_quotes(name);
  }

  void add_use(char type, const std::string& name) {
    text_ += std::string("~") + type + " " + name_text(name) + "\n";
  }

  void add(const MacroDefinition& macro) {
    add_use(macro.type, macro.name);
    switch (macro.type) {
      case 'h':
        add_hmm(macro.hmm);
        break;
      case 's':
        add_state(macro.state);
        break;
      case 'm':
        add_component(macro.component);
        break;
      case 'u':
        add_vector("MEAN", 'u', macro.vector);
        break;
      case 'v':
        add_vector("VARIANCE", 'v', macro.vector);
        break;
      case 't':
        add_transitions(macro.transitions);
        break;
      default:
        fail(ErrorKind::invalid_argument, "a macro has a type that there is not");
    }
  }

  void add_hmm(const HmmDefinition& hmm) {
    text_ += "<BEGINHMM>\n<NUMSTATES> " + std::to_string(hmm.states.size() + 2) + "\n";
    for (std::size_t i = 0; i < hmm.states.size(); ++i) {
      text_ += "<STATE> " + std::to_string(i + 2) + "\n";
      add_state(hmm.states[i]);
    }
    add_transitions(hmm.transitions);
    text_ += "<ENDHMM>\n";
  }

  void add_state(const StateDefinition& state) {
    if (!state.macro.empty()) {
      add_use('s', state.macro);
      return;
    }
    if (state.discrete.size() > 0) {
      add_discrete(state);
      return;
    }
    require(!state.components.empty(), "a state of a model has no Gaussian");
    if (is_tied(state)) {
      add_tied(state);
      return;
    }
    const bool plain = state.num_mixtures == 1 && state.components.front().weight == 1;
    if (state.num_mixtures != 1) text_ += "<NUMMIXES> " + std::to_string(state.num_mixtures) + "\n";
    for (const WeightedComponent& one : state.components) {
      if (!plain)
        text_ += "<MIXTURE> " + std::to_string(one.number) + " " + number(one.weight) + "\n";
      add_component(one.component);
    }
  }

  void add_discrete(const StateDefinition& state) {
    text_ += "<NUMMIXES> " + std::to_string(state.discrete.size()) + "\n<DPROB>";
    for (Eigen::Index c = 0; c < state.discrete.size();) {
      const double probability = state.discrete[c];
      require(probability >= 0 && probability <= 1, "a probability of a codeword is outside 0..1");
      const int value = detail::to_scaled_log(probability);
      Eigen::Index end = c + 1;
      while (end < state.discrete.size() && detail::to_scaled_log(state.discrete[end]) == value)
        ++end;
      text_ += " " + std::to_string(value);
      if (end - c > 1) text_ += "*" + std::to_string(end - c);
      c = end;
    }
    text_ += '\n';
  }

  // Whether its Gaussians are still those that <TMix> names.
  static bool is_tied(const StateDefinition& state) {
    if (state.tied.empty() ||
        state.components.size() != static_cast<std::size_t>(state.num_mixtures))
      return false;
    for (std::size_t c = 0; c < state.components.size(); ++c) {
      const WeightedComponent& one = state.components[c];
      const std::string number = std::to_string(c + 1);
      if (one.number != static_cast<int>(c) + 1 || one.component.macro != state.tied + number)
        return false;
    }
    return true;
  }

  void add_tied(const StateDefinition& state) {
    text_ += "<NUMMIXES> " + std::to_string(state.num_mixtures) + "\n<TMIX> " +
             name_text(state.tied) + "\n";
    for (std::size_t c = 0; c < state.components.size();) {
      std::size_t end = c + 1;
      while (end < state.components.size() &&
             state.components[end].weight == state.components[c].weight)
        ++end;
      text_ += " " + number(state.components[c].weight);
      if (end - c > 1) text_ += "*" + std::to_string(end - c);
      c = end;
    }
    text_ += '\n';
  }

  void add_component(const ComponentDefinition& component) {
    if (!component.macro.empty()) {
      add_use('m', component.macro);
      return;
    }
    add_vector("MEAN", 'u', component.mean);
    add_vector("VARIANCE", 'v', component.variance);
    if (component.has_gconst) text_ += "<GCONST> " + number(component.gconst) + "\n";
  }

  void add_vector(const char* keyword, char type, const VectorDefinition& vector) {
    if (!vector.macro.empty()) {
      add_use(type, vector.macro);
      return;
    }
    text_ += std::string("<") + keyword + "> " + std::to_string(vector.values.size()) + "\n";
    for (Eigen::Index i = 0; i < vector.values.size(); ++i) text_ += " " + number(vector.values[i]);
    text_ += '\n';
  }

  void add_transitions(const TransitionDefinition& transitions) {
    if (!transitions.macro.empty()) {
      add_use('t', transitions.macro);
      return;
    }
    text_ += "<TRANSP> " + std::to_string(transitions.values.rows()) + "\n";
    for (Eigen::Index i = 0; i < transitions.values.rows(); ++i) {
      for (Eigen::Index j = 0; j < transitions.values.cols(); ++j)
        text_ += " " + number(transitions.values(i, j));
      text_ += '\n';
    }
  }

  std::string text_;
};

}  // namespace

std::string ModelSet::to_text() const {
  std::string text = ModelWriter().write(*this, 0, macros.size());
  // What is written can be read: a set that was made by hand is checked here.
  ModelSet again;
  again.parse(text, "the models");
  return text;
}

std::string ModelSet::to_text(std::size_t first, std::size_t last) const {
  require(first <= last && last <= macros.size(), "the set has not as many definitions");
  std::string all = to_text();
  return first == 0 && last == macros.size() ? all : ModelWriter().write(*this, first, last);
}

void ModelSet::write(const std::string& path) const { detail::write_text(path, to_text()); }

void ModelSet::write(const std::string& path, std::size_t first, std::size_t last) const {
  detail::write_text(path, to_text(first, last));
}

}  // namespace hri::htk
