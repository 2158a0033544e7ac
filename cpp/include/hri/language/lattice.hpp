// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Lattice: all sentences of a recording whose score comes near the best, with their times
// (Ortmanns, Ney and Aubert, "A word graph algorithm for large vocabulary continuous speech
// recognition", Computer Speech and Language 11, 1997). Of it the n best sentences, posterior
// probabilities of words (Wessel, Schlueter, Macherey and Ney, IEEE Trans. SAP 9(3), 2001), and a
// confusion network along the best path (Hakkani-Tuer, Bechet, Riccardi and Tur, Computer Speech
// and Language 20, 2006).
#pragma once

#include <cstdint>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/options.hpp"
#include "hri/core/types.hpp"
#include "hri/language/connected_decoder.hpp"
#include "hri/language/word_network.hpp"

namespace hri {

struct LatticeOptions {
  double beam = 200;
  int max_arcs = 200000;

  static constexpr const char* kName = "LatticeOptions";
  template <class Self, class Visitor>
  static void visit(Self& o, Visitor&& v) {
    v("beam", o.beam, within(0, 1e12),
      "words through which no sentence comes as near as this to the best (natural log) are left "
      "out");
    v("max_arcs", o.max_arcs, within(1, 100000000),
      "arcs at most; where there would be more, the beam is halved until there are not");
  }
};

/// What may have been said where a word of the best sentence stands, or between two of them.
struct ConfusionSlot {
  struct Entry {
    int model = 0;  ///< WordNetwork::kNull: no word
    double probability = 0;
  };
  std::int64_t first_frame = 0;
  std::int64_t last_frame = 0;  ///< one past the last
  std::vector<Entry> entries;   ///< the most probable first; they sum up to 1
};

/// Immutable; const calls are safe from several threads. Invariants: arcs lead to nodes of higher
/// numbers and never back in time, every node lies on a path from the first to the last.
class HRI_API Lattice {
 public:
  /// Words end in nodes.
  struct Node {
    int model = WordNetwork::kNull;  ///< of the word that ends here, kNull: none
    std::int64_t frame = 0;          ///< one past its last
    bool is_silence = false;
  };
  /// Into a node of a word: this word, from the frame of `from` on.
  struct Arc {
    int from = 0;
    int to = 0;
    double log_acoustic = 0;  ///< of the word's states
    double log_weight = 0;    ///< of the network, as it was weighed, and the insertion penalty

    [[nodiscard]] double log_score() const { return log_acoustic + log_weight; }
  };

  /// Arcs are sorted. Throws InvalidArgument for what contradicts the invariants, and scores that
  /// are not finite; no node at all is the lattice without a sentence.
  Lattice(std::vector<Node> nodes, std::vector<Arc> arcs);

  /// Of frames (num_frames, states of all chains): every sentence of the network that covers all
  /// frames and comes within the beam of the best, each word in all its places; empty where there
  /// is none. Exact, in two passes: from the last frame back for what follows at best, then words
  /// from each frame on which they may begin. Without a beam (options.beam is not used). Throws
  /// InvalidArgument as ConnectedDecoder does, and for more than 64 million states times frames.
  static Lattice decode(const std::vector<WordChain>& chains, const WordNetwork& network,
                        ConstMatrixRefF log_emissions, const ConnectedDecoderOptions& options = {},
                        const LatticeOptions& lattice_options = {});

  /// Whether decode() takes so many frames of the network.
  static bool fits(const std::vector<WordChain>& chains, const WordNetwork& network,
                   std::int64_t num_frames);

  [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }
  [[nodiscard]] const std::vector<Arc>& arcs() const { return arcs_; }  ///< by where they lead
  [[nodiscard]] bool empty() const { return nodes_.empty(); }

  /// The best sentence; not complete where the lattice is empty.
  [[nodiscard]] DecodedSentence best() const;
  /// At most `count` (1..1000) sentences that differ in their words, the best first, each on its
  /// best path. Silences make no difference. Exact, but for the sentences behind a million that
  /// were begun.
  [[nodiscard]] std::vector<DecodedSentence> n_best(int count) const;

  /// The share of the arcs in all paths, each weighted by exp(scale log_score). `scale`, above 0 to
  /// 1, makes up for frames that are scored as though they were independent.
  [[nodiscard]] VectorD posteriors(double scale) const;
  /// For every word of `sentence` the largest probability over its frames that this word is said
  /// there, wherever it begins and ends; 0..1.
  [[nodiscard]] std::vector<double> confidences(const std::vector<DecodedWord>& sentence,
                                                double scale) const;
  /// A slot for every word of the best sentence and for the time between two of them. A word of
  /// another sentence belongs to the slot that it shares most frames with. Slots where no word is
  /// probable at all are left out.
  [[nodiscard]] std::vector<ConfusionSlot> confusion_network(double scale) const;

 private:
  [[nodiscard]] VectorD best_to_end() const;
  // The best way to say these words, which the lattice has.
  [[nodiscard]] DecodedSentence best_path(const std::vector<int>& words) const;

  std::vector<Node> nodes_;
  std::vector<Arc> arcs_;
  std::vector<int> first_out_;  // numbers into out_, of every node and one past the last
  std::vector<int> out_;        // arcs by where they come from
};

}  // namespace hri
