// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/multi_stream_scorer.hpp"

#include <string>
#include <utility>

#include "hri/core/error.hpp"

namespace hri {
namespace {

constexpr const char* kVectors = "vectors.";
constexpr double kPriorVectors = 10;  // imagined words that hold adaptation of the vectors back

using Streams = std::vector<std::shared_ptr<const SequenceScorer>>;

std::string prefix_of(std::size_t stream) { return "stream." + std::to_string(stream) + "."; }

std::vector<MatrixF> of_stream(const std::vector<const StreamFrames*>& sequences,
                               std::size_t stream) {
  std::vector<MatrixF> result;
  result.reserve(sequences.size());
  for (const StreamFrames* frames : sequences) result.push_back((*frames)[stream]);
  return result;
}

ClassSequences of_stream(const ClassStreams& sequences, std::size_t stream) {
  ClassSequences result;
  result.reserve(sequences.size());
  for (const auto& list : sequences) result.push_back(of_stream(list, stream));
  return result;
}

// Of the sequences that have one.
std::vector<MatrixF> vectors_of(const std::vector<const StreamFrames*>& sequences,
                                std::size_t num_streams) {
  std::vector<MatrixF> result;
  for (const StreamFrames* frames : sequences) {
    if (frames->size() > num_streams) result.push_back(frames->back());
  }
  return result;
}

ClassSequences vectors_of(const ClassStreams& sequences, std::size_t num_streams) {
  ClassSequences result;
  result.reserve(sequences.size());
  for (const auto& list : sequences) result.push_back(vectors_of(list, num_streams));
  return result;
}

std::size_t num_streams_of(const ClassStreams& sequences) {
  for (const auto& list : sequences) {
    if (!list.empty()) return list.front()->size();
  }
  fail(ErrorKind::invalid_argument, "training needs at least one sequence");
}

}  // namespace

MultiStreamScorer::MultiStreamScorer(Streams streams, std::shared_ptr<const VectorScorer> vectors)
    : streams_(std::move(streams)), vectors_(std::move(vectors)) {
  require(!streams_.empty(), "a scorer needs at least one stream");
  for (const auto& stream : streams_) {
    require(stream->kind() == kind() && stream->num_classes() == num_classes(),
            "streams differ in their models");
    require(stream->num_fillers() == num_fillers(), "streams differ in their filler words");
  }
  require(vectors_ == nullptr || vectors_->num_classes() == num_classes(),
          "streams and vectors differ in their classes");
}

MultiStreamScorer MultiStreamScorer::train(const ClassStreams& sequences,
                                           const SequenceModelOptions& options,
                                           const std::vector<FillerModels>& fillers,
                                           const StopCheck& should_stop,
                                           const VectorTraining* vectors) {
  const std::size_t num_streams = num_streams_of(sequences) - (vectors == nullptr ? 0 : 1);
  require(fillers.empty() || fillers.size() == num_streams, "fillers needs one list a stream");
  Streams streams;
  for (std::size_t s = 0; s < num_streams; ++s) {
    streams.push_back(train_sequence_scorer(of_stream(sequences, s), options, should_stop,
                                            fillers.empty() ? FillerModels{} : fillers[s]));
  }
  if (vectors == nullptr) return MultiStreamScorer(std::move(streams));
  auto scorer = std::make_shared<const VectorScorer>(VectorScorer::train(
      vectors_of(sequences, num_streams), vectors->fillers, vectors->options, should_stop));
  return MultiStreamScorer(std::move(streams), std::move(scorer));
}

VectorF MultiStreamScorer::scores(const StreamFrames& frames) const {
  VectorF sum = stream_scores(frames);
  if (vectors_ != nullptr) sum += vectors_->scores(frames.back());
  return sum;
}

VectorF MultiStreamScorer::stream_scores(const StreamFrames& frames) const {
  VectorF sum = streams_.front()->scores(frames.front());
  for (std::size_t s = 1; s < streams_.size(); ++s) sum += streams_[s]->scores(frames[s]);
  return sum;
}

double MultiStreamScorer::garbage_score(const StreamFrames& frames) const {
  double sum = 0;
  for (std::size_t s = 0; s < streams_.size(); ++s)
    sum += static_cast<double>(streams_[s]->garbage_score(frames[s]));
  return sum;
}

VectorF MultiStreamScorer::filler_scores(const StreamFrames& frames) const {
  VectorF sum = streams_.front()->filler_scores(frames.front());
  for (std::size_t s = 1; s < streams_.size(); ++s) sum += streams_[s]->filler_scores(frames[s]);
  return sum;
}

MultiStreamScorer MultiStreamScorer::adapted(const ClassStreams& sequences,
                                             const AdaptationOptions& options) const {
  Streams streams;
  for (std::size_t s = 0; s < streams_.size(); ++s)
    streams.push_back(streams_[s]->adapted(of_stream(sequences, s), options));
  if (vectors_ == nullptr) return MultiStreamScorer(std::move(streams));
  auto moved = std::make_shared<const VectorScorer>(
      vectors_->adapted(vectors_of(sequences, streams_.size()), kPriorVectors));
  return MultiStreamScorer(std::move(streams), std::move(moved));
}

MultiStreamScorer MultiStreamScorer::with_class(int index,
                                                const std::vector<const StreamFrames*>& sequences,
                                                int num_recordings,
                                                const StopCheck& should_stop) const {
  Streams streams;
  for (std::size_t s = 0; s < streams_.size(); ++s) {
    streams.push_back(
        streams_[s]->with_class(index, of_stream(sequences, s), num_recordings, should_stop));
  }
  if (vectors_ == nullptr) return MultiStreamScorer(std::move(streams));
  auto more = std::make_shared<const VectorScorer>(
      vectors_->with_class(index, vectors_of(sequences, streams_.size()), should_stop));
  return MultiStreamScorer(std::move(streams), std::move(more));
}

MultiStreamScorer MultiStreamScorer::without_class(int index) const {
  Streams streams;
  for (const auto& stream : streams_) streams.push_back(stream->without_class(index));
  if (vectors_ == nullptr) return MultiStreamScorer(std::move(streams));
  auto fewer = std::make_shared<const VectorScorer>(vectors_->without_class(index));
  return MultiStreamScorer(std::move(streams), std::move(fewer));
}

MultiStreamScorer MultiStreamScorer::with_vector_weight(double weight) const {
  require(vectors_ != nullptr, "there are no vectors to weigh");
  return MultiStreamScorer(streams_,
                           std::make_shared<const VectorScorer>(vectors_->with_weight(weight)));
}

void MultiStreamScorer::write(ModelFile& file) const {
  for (std::size_t s = 0; s < streams_.size(); ++s) streams_[s]->write(file, prefix_of(s));
  if (vectors_ != nullptr) vectors_->write(file, kVectors);
}

MultiStreamScorer MultiStreamScorer::read(const ModelFile& file,
                                          const SequenceModelOptions& options, int num_streams,
                                          int num_classes, int dim) {
  Streams streams;
  for (int s = 0; s < num_streams; ++s) {
    streams.push_back(read_sequence_scorer(file, prefix_of(static_cast<std::size_t>(s)), options,
                                           num_classes, dim));
    if (streams.back()->num_fillers() != streams.front()->num_fillers())
      fail(ErrorKind::format, file.name() + ": streams differ in their filler words");
  }
  if (!file.has(std::string(kVectors) + "weight")) return MultiStreamScorer(std::move(streams));
  auto vectors =
      std::make_shared<const VectorScorer>(VectorScorer::read(file, kVectors, num_classes));
  return MultiStreamScorer(std::move(streams), std::move(vectors));
}

std::vector<FillerModels> train_fillers(const ClassStreams& sequences, int num_streams,
                                        const SequenceModelOptions& options,
                                        const StopCheck& should_stop) {
  std::vector<FillerModels> result;
  result.reserve(static_cast<std::size_t>(num_streams));
  for (int s = 0; s < num_streams; ++s) {
    result.push_back(
        train_fillers(of_stream(sequences, static_cast<std::size_t>(s)), options, should_stop));
  }
  return result;
}

}  // namespace hri
