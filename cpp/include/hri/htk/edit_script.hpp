// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// HHEd's scripts, which change the structure of models: mixtures are split, parameters tied, states
// clustered, transitions added and removed (HTK Book, sections 10.2 to 10.6 and 17.8).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/htk/decision_trees.hpp"
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
  enum class Kind : std::uint8_t {
    split_mixtures,
    tie,
    add_transition,
    remove_transition,
    clone,
    tie_by_tree,
    tie_clusters,
    question,
    statistics,
    add_unseen,
    merge_equal,
    save_trees,
    load_trees
  };

  Kind kind = Kind::split_mixtures;
  std::int64_t line = 1;
  std::vector<EditItem> items;
  int num_mixtures = 0;          ///< of MU
  bool is_more = false;          ///< of MU: so many more than there are
  std::string macro;             ///< of TI, TB and TC
  std::string path;              ///< of CL, AU, CO, LS, RO, ST and LT; of RO "": none
  double threshold = 0;          ///< of TB and TC
  double least_occupation = -1;  ///< of RO, in frames; below 0: LS
  ContextQuestion question;      ///< of QS
  int from = 0;                  ///< of AT and RT
  int to = 0;
  double probability = 0;  ///< of AT
};

/// A file that a script wants written.
struct EditedFile {
  std::string path;
  std::string text;
};

/// Commands in the order of the file.
struct HRI_API EditScript {
  std::string name;  ///< what errors call it
  std::vector<EditCommand> commands;

  /// Reads MU, TI, AT, RT, CL, RO, LS, QS, TB, TC, AU, CO, ST and LT; comments stand behind # or
  /// //, and TR n changes nothing. Throws IoError, and FormatError naming file and line for other
  /// commands, item lists of another form, and items that a command does not take.
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
  /// RO and LS read how many frames each state was met in, as HERest writes it. TB ties states of
  /// one Gaussian, one of every model of a unit, by a decision tree of the questions (QS) before it
  /// to the mean and variance of their frames; a question must gain the threshold in log likelihood
  /// and leave the frames of RO on both sides, and leaves that lose less are merged. TC ties states
  /// of one Gaussian whose distance is at most the threshold, then groups with fewer frames than
  /// RO says to the nearest. Both number their ~s from 1. AU adds the models of a list that there
  /// are not, by trees. CO keeps one of those that share all they have and writes the list of all.
  /// ST writes the trees, LT reads them.
  ///
  /// What CO and ST write is added to `files`, and not written here; nullptr: not wanted.
  /// Throws IoError for a list that cannot be read; FormatError naming file and line for items that
  /// no model has, a macro that there is already, parameters of different sizes, a row that would
  /// be left empty, states without statistics and units without a tree.
  [[nodiscard]] ModelSet apply(ModelSet models, std::vector<EditedFile>* files = nullptr) const;
};

}  // namespace hri::htk
