// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Word networks as files: HTK's standard lattice format (HTK Book, chapter 20), and grammars in
// HParse's extended Backus-Naur form (section 12.3), which become such networks. Lattices of
// recognition are such files, too, with times and acoustic scores.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/language/lattice.hpp"
#include "hri/language/ngram_model.hpp"

namespace hri::htk {

/// Words on nodes, weights on arcs. A node without predecessors begins sentences, one without
/// successors ends them; where there is not one of each, `start` and `end` name them.
struct HRI_API WordLattice {
  static constexpr const char* kNull = "!NULL";  ///< the word of a node that stands for none
  static constexpr int kByArcs = -1;  ///< the one node without predecessors, or successors

  struct Arc {
    int from = 0;
    int to = 0;
    double log_weight = 0;    ///< natural log, without scale and penalty: l=
    double log_acoustic = 0;  ///< natural log, of the word that the arc leads to: a=
  };
  std::vector<std::string> words;   ///< of the nodes
  std::vector<double> times_s;      ///< where the words end: t=; empty: not known of all
  std::vector<int> variants;        ///< which pronunciation, from 1: v=; 0: any; empty: any of all
  std::vector<std::int64_t> lines;  ///< of the file that the nodes were read from; empty: of none
  std::vector<Arc> arcs;
  int start = kByArcs;           ///< where sentences begin: start=
  int end = kByArcs;             ///< where they end: end=
  double language_scale = 1;     ///< that weights had in recognition: lmscale=
  double insertion_penalty = 0;  ///< that every word had there, natural log: wdpenalty=

  /// Reads a lattice; a word on an arc becomes a node of its own on it, behind all nodes of the
  /// file. Throws IoError, and FormatError naming file and line for counts that differ from what is
  /// there, nodes that there are not, no or several ends, cycles without words, words both on nodes
  /// and on arcs, and sub-lattices.
  static WordLattice read(const std::string& path);
  /// The same from memory; `name` stands for the path in messages.
  static WordLattice parse(const std::string& text, const std::string& name);

  /// The network of a grammar: `$name = ...;` defines, the sentence stands in ( ); | alternatives,
  /// [ ] may be left out, { } none or more, < > one or more; comments in /* */. Throws FormatError
  /// naming file and line for another form, outputs of words (`word%output`), which only the
  /// dictionary says, names that are not defined above (so that none can hold itself), repetitions
  /// of what may be empty, and networks of more than a million nodes.
  static WordLattice of_grammar(const std::string& text, const std::string& name);
  static WordLattice read_grammar(const std::string& path);
  /// The one sentence, for forced alignment.
  static WordLattice of_words(const std::vector<std::string>& sentence);

  /// The words in any order, weighted by a model of order 1 or 2: arcs for the bigrams that it has,
  /// and a node without a word that the others back off over. Sentences begin and end where the
  /// model says, which its markers, or others of these names, stand for. Throws InvalidArgument for
  /// models of higher order, no word, a word twice, one that is a marker, and for words that the
  /// model does not know.
  static WordLattice of_bigram(const NGramModel& language, const std::vector<std::string>& words,
                               const std::string& start = NGramModel::kStart,
                               const std::string& end = NGramModel::kEnd);

  /// A lattice of recognition: `labels` are the words of its models, and frame n begins at
  /// first_s + n frame_s. Scale and penalty that its weights hold are taken out, so that it can be
  /// recognised with again; at a scale of 0 no weights are left. Throws InvalidArgument for models
  /// without a label, empty lattices, and a scale or penalty that ConnectedDecoderOptions refuse.
  static WordLattice of_lattice(const Lattice& lattice, const std::vector<std::string>& labels,
                                double first_s, double frame_s, double language_scale = 1,
                                double insertion_penalty = 0);
  /// The same back, weighed by scale and penalty again: words of `silences` are silence, without
  /// penalty. Throws InvalidArgument for a lattice without times, with a cycle, with words that
  /// labels do not have, and what Lattice refuses.
  [[nodiscard]] Lattice to_lattice(const std::vector<std::string>& labels,
                                   const std::vector<std::string>& silences, double first_s,
                                   double frame_s) const;

  /// The text that was read, byte for byte, while it says the same and has at most 64 MiB; else a
  /// line a node and arc. Throws InvalidArgument for what parse() would refuse.
  [[nodiscard]] std::string to_text() const;
  void write(const std::string& path) const;

  /// The node that begins sentences, and the one that ends them.
  [[nodiscard]] int first() const;
  [[nodiscard]] int last() const;
  /// "", or what is wrong with the network.
  [[nodiscard]] std::string fault() const;

 private:
  std::string text_;  // that it was read from; what it says is compared when it is written
};

}  // namespace hri::htk
