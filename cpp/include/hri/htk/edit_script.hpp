// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// HHEd's scripts, which change the structure of models: mixtures are split, parameters tied,
// transitions added and removed (HTK Book, sections 10.2 to 10.6 and 17.8).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/htk/model_set.hpp"

namespace hri::htk {

/// What an item of a list is: {a.transP}, {(a,b).state[2,4-5]}, {*.state[2].mix[1].mean}, ...
struct EditItem {
  enum class Kind : std::uint8_t { transitions, state, mixtures, mixture, mean, variance };
  struct Numbers {
    int low = 0;
    int high = 0;
  };

  Kind kind = Kind::transitions;
  std::vector<std::string> models;  ///< patterns: * stands for any characters, ? for one
  std::vector<Numbers> states;      ///< entry state is 1
  std::vector<Numbers> mixtures;    ///< from 1
};

struct EditCommand {
  enum class Kind : std::uint8_t { split_mixtures, tie, add_transition, remove_transition, clone };

  Kind kind = Kind::split_mixtures;
  std::int64_t line = 1;
  std::vector<EditItem> items;
  int num_mixtures = 0;  ///< of MU
  bool is_more = false;  ///< of MU: so many more than there are
  std::string macro;     ///< of TI
  std::string list;      ///< of CL: the path of a list of models
  int from = 0;          ///< of AT and RT
  int to = 0;
  double probability = 0;  ///< of AT
};

/// Commands in the order of the file.
struct HRI_API EditScript {
  std::string name;  ///< what errors call it
  std::vector<EditCommand> commands;

  /// Reads MU, TI, AT, RT and CL; comments stand behind # or //, and TR n changes nothing. Throws
  /// IoError, and FormatError naming file and line for other commands, item lists of another form,
  /// and items that a command does not take.
  static EditScript read(const std::string& path);
  /// The same from memory; `name` stands for the path in messages.
  static EditScript parse(const std::string& text, const std::string& name);

  /// The models after all commands.
  ///
  /// MU splits the heaviest Gaussian of a mixture, less what it was split before in the command,
  /// into two of half its weight, 0.2 standard deviations above and below, until there are as many
  /// as it says; Gaussians without weight are dropped first. TI ties to the mean of means, to the
  /// largest of variances, to the state or the Gaussian that is broadest, to the first of
  /// transitions. AT sets a transition, RT removes one; the others of its row are rescaled. What
  /// macros share is changed for all that use it. CL leaves the models of a list, each line of
  /// which is a name, in its order: those that there are, and copies of the model b for others such
  /// as a-b+c; copies share what is a macro. Macros stand before all models.
  ///
  /// Throws IoError for a list that cannot be read; FormatError naming file and line for items that
  /// no model has, a macro that there is already, parameters of different sizes, and a row that
  /// would be left empty.
  [[nodiscard]] ModelSet apply(ModelSet models) const;
};

}  // namespace hri::htk
