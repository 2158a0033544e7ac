// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// HTK's model definitions in text form: HMMs of Gaussian mixtures with diagonal covariance, or of
// codewords, in one stream, and macros that they share (HTK Book, chapter 7).
#pragma once

#include <string>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/types.hpp"
#include "hri/htk/parameter_kind.hpp"
#include "hri/language/connected_decoder.hpp"
#include "hri/models/hmm/gaussian_mixture_hmm.hpp"

namespace hri::htk {

/// A mean or a variance.
struct VectorDefinition {
  std::string macro;  ///< the name of the ~u or ~v that it is; "": its own
  VectorD values;
};

struct ComponentDefinition {
  std::string macro;  ///< of a ~m
  VectorDefinition mean;
  VectorDefinition variance;
  bool has_gconst = false;
  double gconst = 0;  ///< D ln 2 pi + sum of ln variance, as in the file
};

/// One Gaussian of a state's mixture; numbers count from 1, those without weight may be missing.
struct WeightedComponent {
  int number = 1;
  double weight = 1;
  ComponentDefinition component;
};

struct StateDefinition {
  std::string macro;  ///< of a ~s
  int num_mixtures = 1;
  std::vector<WeightedComponent> components;
  std::string tied;  ///< of TMix: its Gaussians are the ~m of this name and a number from 1
  /// Of a discrete state, which has no Gaussian: the probability of every codeword. Files hold
  /// -2371.8 ln of them, rounded, where 32767 stands for 0.
  VectorD discrete;
};

struct TransitionDefinition {
  std::string macro;  ///< of a ~t
  MatrixD values;     ///< entry and exit state included
};

struct HmmDefinition {
  std::vector<StateDefinition> states;  ///< those that emit
  TransitionDefinition transitions;
};

/// A definition of a file; which of the fields it fills depends on its type.
struct MacroDefinition {
  char type = 'h';  ///< h, s, m, u, v or t
  std::string name;
  HmmDefinition hmm;
  StateDefinition state;
  ComponentDefinition component;
  VectorDefinition vector;
  TransitionDefinition transitions;
};

/// What one or more files define, in their order. Every use of a macro holds its values.
struct HRI_API ModelSet {
  int vector_size = 0;
  ParameterKind kind;
  std::vector<MacroDefinition> macros;

  /// Adds what a file defines; macros of files before may be used. Throws IoError; FormatError
  /// naming file and line for whatever is no such definition, for discrete states beside Gaussians
  /// or of another number of codewords, and for what is not read: binary files, several streams,
  /// full covariances, durations. States of tied mixtures (TMix) have all Gaussians of the set.
  void read(const std::string& path);
  /// The same from memory; `name` stands for the path in messages.
  void parse(const std::string& text, const std::string& name);

  /// The text of a file, laid out as HTK does. Numbers have 7 digits where these read back equal,
  /// and as many as it takes elsewhere. Throws InvalidArgument for what parse() would refuse.
  [[nodiscard]] std::string to_text() const;
  void write(const std::string& path) const;
  /// The same of the definitions first..last - 1, which may use those before them: a file of
  /// several.
  [[nodiscard]] std::string to_text(std::size_t first, std::size_t last) const;
  void write(const std::string& path, std::size_t first, std::size_t last) const;

  /// nullptr where there is none of this type and name.
  [[nodiscard]] const MacroDefinition* find(char type, const std::string& name) const;
  [[nodiscard]] std::vector<std::string> hmm_names() const;

  /// Codewords of its discrete states, which count from 1 in frames of one column; 0: its states,
  /// if any, are of Gaussians.
  [[nodiscard]] int num_codewords() const;

  /// Adds an HMM whose left-right chain is left from its last state with probability
  /// 1 - final_stay. Throws InvalidArgument for other topologies, another dimension, a name that
  /// there is already, and final_stay outside 0..1, 1 excluded.
  void add(const std::string& name, const GaussianMixtureHmm& model, double final_stay);

  /// The definitions in another order: `order` has the number of each, once. Throws InvalidArgument
  /// for other numbers.
  void reorder(const std::vector<std::size_t>& order);

  /// Throws InvalidArgument for an HMM that there is not, and a name that there is already.
  void rename_hmm(const std::string& hmm, const std::string& name);
};

/// The Gaussians of an HMM, and a chain without its entry and exit: what leaves a state for the
/// exit is shared by its other steps, and by none where it has none. States with fewer Gaussians
/// than others have some of weight 0. Throws InvalidArgument for a discrete model.
HRI_API GaussianMixtureHmm to_hmm(const HmmDefinition& definition);

/// The chain with entry and exit, as decoders pass it. `log_skip`: the log probability to pass from
/// the entry to the exit, which takes no frame; -inf for most models.
HRI_API WordChain to_chain(const HmmDefinition& definition, double* log_skip);

}  // namespace hri::htk
