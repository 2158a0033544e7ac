// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/recognition/word/multi_stream_scorer.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "hri/core/error.hpp"

namespace hri {
namespace {

constexpr const char* kVectors = "vectors.";
constexpr const char* kNetwork = "network.";
constexpr double kMaxWeight = 1e6;
constexpr double kPriorVectors = 10;  // imagined words that hold adaptation of the vectors back

using Streams = std::vector<std::shared_ptr<const SequenceScorer>>;

std::string prefix_of(std::size_t stream) { return "stream." + std::to_string(stream) + "."; }

// Matrix `place` of the sequences that have one.
std::vector<MatrixF> present(const std::vector<const StreamFrames*>& sequences, std::size_t place) {
  std::vector<MatrixF> result;
  result.reserve(sequences.size());
  for (const StreamFrames* frames : sequences) {
    if (frames->size() > place && (*frames)[place].rows() > 0) result.push_back((*frames)[place]);
  }
  return result;
}

ClassSequences present(const ClassStreams& sequences, std::size_t place) {
  ClassSequences result;
  result.reserve(sequences.size());
  for (const auto& list : sequences) result.push_back(present(list, place));
  return result;
}

std::size_t num_streams_of(const ClassStreams& sequences) {
  for (const auto& list : sequences) {
    if (!list.empty()) return list.front()->size();
  }
  fail(ErrorKind::invalid_argument, "training needs at least one sequence");
}

}  // namespace

MultiStreamScorer::MultiStreamScorer(Streams streams, std::shared_ptr<const VectorScorer> vectors,
                                     std::shared_ptr<const WeightedNetwork> network)
    : streams_(std::move(streams)), vectors_(std::move(vectors)), network_(std::move(network)) {
  require(!streams_.empty() || vectors_ != nullptr, "a scorer needs a stream or vectors");
  for (const auto& stream : streams_) {
    require(stream->kind() == streams_.front()->kind() && stream->num_classes() == num_classes(),
            "streams differ in their models");
    require(stream->num_fillers() == num_fillers(), "streams differ in their filler words");
  }
  require(vectors_ == nullptr || vectors_->num_classes() == num_classes(),
          "streams and vectors differ in their classes");
  require(network_ == nullptr || network_->network.num_classes() == num_classes(),
          "streams and the network differ in their classes");
  require(network_ == nullptr || (network_->weight >= 0 && network_->weight <= kMaxWeight),
          "the weight of a network must lie in 0..1e6");
}

MultiStreamScorer MultiStreamScorer::train(const ClassStreams& sequences,
                                           const SequenceModelOptions& options,
                                           const std::vector<FillerModels>& fillers,
                                           const StopCheck& should_stop,
                                           const VectorTraining* vectors,
                                           const NetworkTraining* network) {
  const std::size_t num_streams =
      num_streams_of(sequences) - (vectors == nullptr ? 0 : 1) - (network == nullptr ? 0 : 1);
  require(fillers.empty() || fillers.size() == num_streams, "fillers needs one list a stream");
  Streams streams;
  for (std::size_t s = 0; s < num_streams; ++s) {
    streams.push_back(train_sequence_scorer(present(sequences, s), options, should_stop,
                                            fillers.empty() ? FillerModels{} : fillers[s]));
  }
  std::shared_ptr<const VectorScorer> of_vectors;
  if (vectors != nullptr) {
    of_vectors = std::make_shared<const VectorScorer>(VectorScorer::train(
        present(sequences, num_streams), vectors->fillers, vectors->options, should_stop));
  }
  std::shared_ptr<const WeightedNetwork> trained;
  if (network != nullptr) {
    trained = std::make_shared<const WeightedNetwork>(WeightedNetwork{SequenceNetwork::train(
        network->examples, network->classes, static_cast<int>(sequences.size()), network->options,
        network->progress, should_stop)});
  }
  return MultiStreamScorer(std::move(streams), std::move(of_vectors), std::move(trained));
}

VectorF MultiStreamScorer::scores(const StreamFrames& frames) const {
  VectorF sum = stream_scores(frames);
  if (vectors_ != nullptr) sum += vector_scores(frames);
  if (network_ != nullptr) sum += network_scores(frames);
  return sum;
}

const MatrixF& MultiStreamScorer::vector_of(const StreamFrames& frames) const {
  require(vectors_ != nullptr && frames.size() > streams_.size(), "the sequence has no vector");
  return frames[streams_.size()];
}

VectorF MultiStreamScorer::vector_scores(const StreamFrames& frames) const {
  return vectors_->scores(vector_of(frames));
}

VectorF MultiStreamScorer::network_scores(const StreamFrames& frames) const {
  const std::size_t place = streams_.size() + (vectors_ == nullptr ? 0 : 1);
  require(network_ != nullptr && frames.size() > place, "the sequence has nothing for the network");
  return static_cast<float>(network_->weight) * network_->network.scores(frames[place]);
}

VectorF MultiStreamScorer::stream_scores(const StreamFrames& frames) const {
  if (streams_.empty()) return VectorF::Zero(num_classes());
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
  if (streams_.empty()) return {};
  VectorF sum = streams_.front()->filler_scores(frames.front());
  for (std::size_t s = 1; s < streams_.size(); ++s) sum += streams_[s]->filler_scores(frames[s]);
  return sum;
}

bool MultiStreamScorer::adapts() const {
  return std::none_of(streams_.begin(), streams_.end(), [](const auto& stream) {
    return stream->kind() == SequenceModelKind::ptbhmm;
  });
}

int MultiStreamScorer::num_classes() const {
  return streams_.empty() ? vectors_->num_classes() : streams_.front()->num_classes();
}

int MultiStreamScorer::num_fillers() const {
  return streams_.empty() ? vectors_->num_fillers() : streams_.front()->num_fillers();
}

MultiStreamScorer MultiStreamScorer::adapted(const ClassStreams& sequences,
                                             const AdaptationOptions& options) const {
  Streams streams;
  for (std::size_t s = 0; s < streams_.size(); ++s)
    streams.push_back(streams_[s]->adapted(present(sequences, s), options));
  std::shared_ptr<const VectorScorer> moved;
  if (vectors_ != nullptr) {
    moved = std::make_shared<const VectorScorer>(
        vectors_->adapted(present(sequences, streams_.size()), kPriorVectors));
  }
  return MultiStreamScorer(std::move(streams), std::move(moved), network_);
}

MultiStreamScorer MultiStreamScorer::with_class(int index,
                                                const std::vector<const StreamFrames*>& sequences,
                                                int num_recordings,
                                                const StopCheck& should_stop) const {
  Streams streams;
  for (std::size_t s = 0; s < streams_.size(); ++s) {
    streams.push_back(
        streams_[s]->with_class(index, present(sequences, s), num_recordings, should_stop));
  }
  std::size_t place = streams_.size();
  std::shared_ptr<const VectorScorer> vectors;
  if (vectors_ != nullptr) {
    vectors = std::make_shared<const VectorScorer>(
        vectors_->with_class(index, present(sequences, place++), should_stop));
  }
  std::shared_ptr<const WeightedNetwork> network;
  if (network_ != nullptr) {
    network = std::make_shared<const WeightedNetwork>(
        WeightedNetwork{network_->network.with_class(index, present(sequences, place), should_stop),
                        network_->weight});
  }
  return MultiStreamScorer(std::move(streams), std::move(vectors), std::move(network));
}

MultiStreamScorer MultiStreamScorer::without_class(int index) const {
  Streams streams;
  for (const auto& stream : streams_) streams.push_back(stream->without_class(index));
  std::shared_ptr<const VectorScorer> vectors;
  if (vectors_ != nullptr)
    vectors = std::make_shared<const VectorScorer>(vectors_->without_class(index));
  std::shared_ptr<const WeightedNetwork> network;
  if (network_ != nullptr) {
    network = std::make_shared<const WeightedNetwork>(
        WeightedNetwork{network_->network.without_class(index), network_->weight});
  }
  return MultiStreamScorer(std::move(streams), std::move(vectors), std::move(network));
}

MultiStreamScorer MultiStreamScorer::with_vector_weight(double weight) const {
  require(vectors_ != nullptr, "there are no vectors to weigh");
  return MultiStreamScorer(
      streams_, std::make_shared<const VectorScorer>(vectors_->with_weight(weight)), network_);
}

MultiStreamScorer MultiStreamScorer::with_network_weight(double weight) const {
  require(network_ != nullptr, "there is no network to weigh");
  return MultiStreamScorer(
      streams_, vectors_,
      std::make_shared<const WeightedNetwork>(WeightedNetwork{network_->network, weight}));
}

void MultiStreamScorer::write(ModelFile& file) const {
  for (std::size_t s = 0; s < streams_.size(); ++s) streams_[s]->write(file, prefix_of(s));
  if (vectors_ != nullptr) vectors_->write(file, kVectors);
  if (network_ == nullptr) return;
  network_->network.write(file, kNetwork);
  file.set_number(std::string(kNetwork) + "weight", network_->weight);
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
  std::shared_ptr<const VectorScorer> vectors;
  if (file.has(std::string(kVectors) + "weight"))
    vectors = std::make_shared<const VectorScorer>(VectorScorer::read(file, kVectors, num_classes));
  std::shared_ptr<const WeightedNetwork> network;
  const std::string weight = std::string(kNetwork) + "weight";
  if (file.has(weight)) {
    WeightedNetwork read{SequenceNetwork::read(file, kNetwork), file.number(weight)};
    if (!(read.weight >= 0 && read.weight <= kMaxWeight))
      fail(ErrorKind::format, file.name() + ": field '" + weight + "' is out of range");
    if (read.network.num_classes() != num_classes)
      fail(ErrorKind::format, file.name() + ": the network differs in its classes");
    network = std::make_shared<const WeightedNetwork>(std::move(read));
  }
  return MultiStreamScorer(std::move(streams), std::move(vectors), std::move(network));
}

std::vector<FillerModels> train_fillers(const ClassStreams& sequences, int num_streams,
                                        const SequenceModelOptions& options,
                                        const StopCheck& should_stop) {
  std::vector<FillerModels> result;
  result.reserve(static_cast<std::size_t>(num_streams));
  for (int s = 0; s < num_streams; ++s) {
    result.push_back(
        train_fillers(present(sequences, static_cast<std::size_t>(s)), options, should_stop));
  }
  return result;
}

}  // namespace hri
