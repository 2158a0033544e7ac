// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Word networks as files: HTK's standard lattice format (HTK Book, chapter 20), and grammars in
// HParse's extended Backus-Naur form (section 12.3), which become such networks. Lattices of
// recognition are such files, too, with times and acoustic scores.
#pragma once

#include <string>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/language/lattice.hpp"

namespace hri::htk {

/// Words on nodes, weights on arcs. Nodes without predecessors begin sentences, those without
/// successors end them; there is one of each.
struct HRI_API WordLattice {
  static constexpr const char* kNull = "!NULL";  ///< the word of a node that stands for none

  struct Arc {
    int from = 0;
    int to = 0;
    double log_weight = 0;    ///< natural log: l=
    double log_acoustic = 0;  ///< natural log, of the word that the arc leads to: a=
  };
  std::vector<std::string> words;  ///< of the nodes
  std::vector<double> times_s;     ///< where the words end: t=; empty: not known of all
  std::vector<Arc> arcs;

  /// Reads a lattice. Throws IoError, and FormatError naming file and line for counts that differ
  /// from what is there, nodes that there are not, no or several ends, cycles without words, and
  /// lattices of other kinds: with sub-lattices, or words on arcs.
  static WordLattice read(const std::string& path);
  /// The same from memory; `name` stands for the path in messages.
  static WordLattice parse(const std::string& text, const std::string& name);

  /// The network of a grammar: `$name = ...;` defines, the sentence stands in ( ); | alternatives,
  /// [ ] may be left out, { } none or more, < > one or more; comments behind # or in /* */.
  /// Throws FormatError naming file and line for another form, names that are not defined above (so
  /// that none can hold itself), repetitions of what may be empty, and networks of more than a
  /// million nodes.
  static WordLattice of_grammar(const std::string& text, const std::string& name);
  static WordLattice read_grammar(const std::string& path);
  /// The one sentence, for forced alignment.
  static WordLattice of_words(const std::vector<std::string>& sentence);

  /// A lattice of recognition: `labels` are the words of its models, and frame n begins at
  /// first_s + n frame_s. Throws InvalidArgument for models without a label, and empty lattices.
  static WordLattice of_lattice(const Lattice& lattice, const std::vector<std::string>& labels,
                                double first_s, double frame_s);
  /// The same back: words of `silences` are silence. Throws InvalidArgument for a lattice without
  /// times, with a cycle, with words that labels do not have, and what Lattice refuses.
  [[nodiscard]] Lattice to_lattice(const std::vector<std::string>& labels,
                                   const std::vector<std::string>& silences, double first_s,
                                   double frame_s) const;

  /// Throws InvalidArgument for what parse() would refuse.
  [[nodiscard]] std::string to_text() const;
  void write(const std::string& path) const;

  /// The node that begins sentences, and the one that ends them.
  [[nodiscard]] int first() const;
  [[nodiscard]] int last() const;
  /// "", or what is wrong with the network.
  [[nodiscard]] std::string fault() const;
};

}  // namespace hri::htk
