// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Streams of features that vote: one SequenceScorer a stream, whose log scores add up, and where
// there are such a VectorScorer of a vector for the whole sequence and a SequenceNetwork. Where
// there are vectors there may be no stream.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/models/network/sequence_network.hpp"
#include "hri/models/sequence_scorer.hpp"
#include "hri/recognition/word/vector_scorer.hpp"

namespace hri {

/// The frames of one sequence, one matrix a stream; behind them a row for the whole sequence, where
/// there is a VectorScorer, and what the network reads, where there is one. Training sequences
/// may lack any of these, which is empty then or, at the end, not there; the first of a class has
/// all.
using StreamFrames = std::vector<MatrixF>;

/// Training sequences of every class; pointers, since folds share them.
using ClassStreams = std::vector<std::vector<const StreamFrames*>>;

/// What the vectors of sequences are trained with.
struct VectorTraining {
  VectorScoring options;
  ClassSequences fillers;  ///< vectors of words outside the vocabulary, one list a word
};

/// What a network is trained with.
struct NetworkTraining {
  SequenceNetworkOptions options;
  std::vector<int> classes;  ///< of every example
  SequenceNetwork::Examples examples;
  SequenceNetwork::Progress progress = {};
};

/// A network that votes.
struct WeightedNetwork {
  SequenceNetwork network;
  double weight = 1;  ///< on its log posteriors, 0..1e6
};

/// Immutable; const calls are safe from several threads. Copies share their models.
class HRI_API MultiStreamScorer {
 public:
  /// Throws InvalidArgument for neither a stream nor vectors, and for streams that differ in kind,
  /// classes or fillers.
  explicit MultiStreamScorer(std::vector<std::shared_ptr<const SequenceScorer>> streams,
                             std::shared_ptr<const VectorScorer> vectors = nullptr,
                             std::shared_ptr<const WeightedNetwork> network = nullptr);

  /// Trains every stream, as train_sequence_scorer() does; `fillers` holds the models of each
  /// stream, or nothing. With `vectors` and with `network`, there is one matrix more than streams
  /// for each, wherever a sequence has them, first of all in the first one.
  static MultiStreamScorer train(const ClassStreams& sequences, const SequenceModelOptions& options,
                                 const std::vector<FillerModels>& fillers,
                                 const StopCheck& should_stop,
                                 const VectorTraining* vectors = nullptr,
                                 const NetworkTraining* network = nullptr);

  /// The sums over streams of what SequenceScorer gives, and VectorScorer and the network.
  [[nodiscard]] VectorF scores(const StreamFrames& frames) const;
  /// Those of streams alone; zeros where there are none.
  [[nodiscard]] VectorF stream_scores(const StreamFrames& frames) const;
  /// Those of vectors alone, and of the network alone, for sequences that have them.
  [[nodiscard]] VectorF vector_scores(const StreamFrames& frames) const;
  [[nodiscard]] VectorF network_scores(const StreamFrames& frames) const;
  /// The vector of a sequence that has one.
  [[nodiscard]] const MatrixF& vector_of(const StreamFrames& frames) const;
  /// Of streams alone: 0 and no filler where there are none.
  [[nodiscard]] double garbage_score(const StreamFrames& frames) const;
  [[nodiscard]] VectorF filler_scores(const StreamFrames& frames) const;

  /// Throws InvalidArgument where the models do not adapt, see adapts().
  [[nodiscard]] MultiStreamScorer adapted(const ClassStreams& sequences,
                                          const AdaptationOptions& options) const;
  [[nodiscard]] MultiStreamScorer with_class(int index,
                                             const std::vector<const StreamFrames*>& sequences,
                                             int num_recordings,
                                             const StopCheck& should_stop) const;
  [[nodiscard]] MultiStreamScorer without_class(int index) const;
  /// The same with another weight of its vectors, see VectorScorer::with_weight(). Throws
  /// InvalidArgument where there are no vectors.
  [[nodiscard]] MultiStreamScorer with_vector_weight(double weight) const;
  /// The same with another weight of its network. Throws InvalidArgument where there is none, and
  /// for a weight out of range.
  [[nodiscard]] MultiStreamScorer with_network_weight(double weight) const;

  [[nodiscard]] const std::vector<std::shared_ptr<const SequenceScorer>>& streams() const {
    return streams_;
  }
  /// nullptr: there are no vectors.
  [[nodiscard]] const std::shared_ptr<const VectorScorer>& vectors() const { return vectors_; }
  /// nullptr: there is none.
  [[nodiscard]] const std::shared_ptr<const WeightedNetwork>& network() const { return network_; }
  /// Whether the models of all streams adapt, which those of kind ptbhmm do not.
  [[nodiscard]] bool adapts() const;
  [[nodiscard]] int num_classes() const;
  /// Of streams; of vectors, which may have more of them, where there is no stream.
  [[nodiscard]] int num_fillers() const;

  void write(ModelFile& file) const;
  /// Throws FormatError as read_sequence_scorer() does, and for streams that differ.
  static MultiStreamScorer read(const ModelFile& file, const SequenceModelOptions& options,
                                int num_streams, int num_classes, int dim);

 private:
  std::vector<std::shared_ptr<const SequenceScorer>> streams_;
  std::shared_ptr<const VectorScorer> vectors_;
  std::shared_ptr<const WeightedNetwork> network_;
};

/// Trains the fillers of every stream, as train_fillers() does.
HRI_API std::vector<FillerModels> train_fillers(const ClassStreams& sequences, int num_streams,
                                                const SequenceModelOptions& options,
                                                const StopCheck& should_stop);

}  // namespace hri
