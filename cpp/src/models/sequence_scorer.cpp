// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/sequence_scorer.hpp"

#include "hri/core/error.hpp"
#include "models/scorer_kinds.hpp"

namespace hri {

PathFit SequenceScorer::path_fit(ConstMatrixRefF /*frames*/, int /*index*/,
                                 int /*left_out*/) const {
  fail(ErrorKind::invalid_argument, "these models do not align frames with states");
}

std::shared_ptr<const SequenceScorer> SequenceScorer::adapted(
    const ClassSequences& sequences, const AdaptationOptions& options) const {
  require(kind() == SequenceModelKind::hmm, "only models of the kind hmm adapt, these are ptbhmm");
  return detail::adapt_hmm_scorer(*this, sequences, options);
}

std::shared_ptr<const SequenceScorer> SequenceScorer::with_class(
    int index, const std::vector<MatrixF>& sequences, int num_recordings,
    const StopCheck& should_stop) const {
  const auto extend =
      kind() == SequenceModelKind::hmm ? detail::extend_hmm_scorer : detail::extend_ptbhmm_scorer;
  return extend(*this, index, sequences, num_recordings, should_stop);
}

std::shared_ptr<const SequenceScorer> train_sequence_scorer(const ClassSequences& sequences,
                                                            const SequenceModelOptions& options,
                                                            const StopCheck& should_stop,
                                                            const FillerModels& fillers) {
  validate(options);
  if (options.model == SequenceModelKind::hmm)
    return detail::train_hmm_scorer(sequences, options, should_stop, fillers);
  require(fillers.empty(), "only models of the kind hmm compare with fillers, these are ptbhmm");
  return detail::train_ptbhmm_scorer(sequences, options, should_stop);
}

FillerModels train_fillers(const ClassSequences& sequences, const SequenceModelOptions& options,
                           const StopCheck& should_stop) {
  validate(options);
  SequenceModelOptions of_fillers = options;
  of_fillers.num_mixtures = 1;  // they stand for words in general, by few recordings each
  return detail::train_hmms(sequences, of_fillers, should_stop);
}

std::shared_ptr<const SequenceScorer> read_sequence_scorer(const ModelFile& file,
                                                           const std::string& prefix,
                                                           const SequenceModelOptions& options,
                                                           int num_classes, int dim) {
  validate(options);
  return options.model == SequenceModelKind::hmm
             ? detail::read_hmm_scorer(file, prefix, options, num_classes, dim)
             : detail::read_ptbhmm_scorer(file, prefix, options, num_classes, dim);
}

namespace detail {

MatrixF stack_frames(const ClassSequences& sequences, Eigen::Index max_frames) {
  Eigen::Index rows = 0;
  for (const auto& list : sequences) {
    for (const MatrixF& m : list) rows += m.rows();
  }
  const Eigen::Index every = rows <= max_frames ? 1 : (rows + max_frames - 1) / max_frames;
  MatrixF all((rows + every - 1) / every, sequences.front().front().cols());
  Eigen::Index frame = 0;
  for (const auto& list : sequences) {
    for (const MatrixF& m : list) {
      for (Eigen::Index t = 0; t < m.rows(); ++t, ++frame) {
        if (frame % every == 0) all.row(frame / every) = m.row(t);
      }
    }
  }
  return all;
}

Topology left_right(int num_states) {
  Topology topology;
  topology.kind = Topology::Kind::left_right;
  topology.num_states = num_states;
  return topology;
}

void check_width(const ModelFile& file, const std::string& field, Eigen::Index width, int dim) {
  if (width == dim) return;
  fail(ErrorKind::format, file.name() + ": field '" + field + "': has " + std::to_string(width) +
                              " features, the front end gives " + std::to_string(dim));
}

}  // namespace detail
}  // namespace hri
