// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// The kinds of SequenceScorer, and what they share.
#pragma once

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "hri/models/sequence_scorer.hpp"

namespace hri::detail {

constexpr float kImpossible = -1e30F;  // stands for log 0, so that differences stay finite

/// One HMM a class.
std::vector<GaussianMixtureHmm> train_hmms(const ClassSequences& sequences,
                                           const SequenceModelOptions& options,
                                           const StopCheck& should_stop);

std::shared_ptr<const SequenceScorer> train_hmm_scorer(const ClassSequences& sequences,
                                                       const SequenceModelOptions& options,
                                                       const StopCheck& should_stop,
                                                       const FillerModels& fillers);
std::shared_ptr<const SequenceScorer> read_hmm_scorer(const ModelFile& file,
                                                      const std::string& prefix,
                                                      const SequenceModelOptions& options,
                                                      int num_classes, int dim);

std::shared_ptr<const SequenceScorer> train_ptbhmm_scorer(const ClassSequences& sequences,
                                                          const SequenceModelOptions& options,
                                                          const StopCheck& should_stop);
std::shared_ptr<const SequenceScorer> read_ptbhmm_scorer(const ModelFile& file,
                                                         const std::string& prefix,
                                                         const SequenceModelOptions& options,
                                                         int num_classes, int dim);

/// SequenceScorer::adapted() and with_class() of a scorer of that kind.
std::shared_ptr<const SequenceScorer> adapt_hmm_scorer(const SequenceScorer& scorer,
                                                       const ClassSequences& sequences,
                                                       const AdaptationOptions& options);
std::shared_ptr<const SequenceScorer> extend_hmm_scorer(const SequenceScorer& scorer, int index,
                                                        const std::vector<MatrixF>& sequences,
                                                        int num_recordings,
                                                        const StopCheck& should_stop);
std::shared_ptr<const SequenceScorer> extend_ptbhmm_scorer(const SequenceScorer& scorer, int index,
                                                           const std::vector<MatrixF>& sequences,
                                                           int num_recordings,
                                                           const StopCheck& should_stop);

constexpr Eigen::Index kAllFrames = std::numeric_limits<Eigen::Index>::max();

/// The frames of all classes, one below the other; of more than `max_frames` as many, evenly
/// spaced.
MatrixF stack_frames(const ClassSequences& sequences, Eigen::Index max_frames);

Topology left_right(int num_states);

/// Throws FormatError that names the field where `width` is not `dim`.
void check_width(const ModelFile& file, const std::string& field, Eigen::Index width, int dim);

}  // namespace hri::detail
