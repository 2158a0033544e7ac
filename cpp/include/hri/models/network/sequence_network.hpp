// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// A small convolutional network that classifies sequences of frames, trained here: residual blocks
// of time-channel separable convolutions (Majumdar and Ginsburg, "MatchboxNet", Interspeech 2020),
// mean and maximum over time, softmax.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/options.hpp"
#include "hri/core/random.hpp"
#include "hri/core/stop_check.hpp"
#include "hri/core/types.hpp"
#include "hri/io/model_file.hpp"
#include "hri/models/classifiers/softmax_regression.hpp"

namespace hri {

struct SequenceNetworkOptions {
  int num_channels = 96;
  int num_blocks = 3;
  int num_epochs = 60;
  int batch_size = 64;
  double learning_rate = 0.004;
  double weight_decay = 0.01;
  double dropout = 0.1;
  double label_smoothing = 0.1;
  std::uint64_t seed = 1;

  static constexpr const char* kName = "SequenceNetworkOptions";
  template <class Self, class Visitor>
  static void visit(Self& o, Visitor&& v) {
    v("num_channels", o.num_channels, within(8, 1024), "of every block; a multiple of 8");
    v("num_blocks", o.num_blocks, within(1, 16), "residual blocks, of two convolutions each");
    v("num_epochs", o.num_epochs, within(1, 10000), "how often training goes through all examples");
    v("batch_size", o.batch_size, within(2, 4096), "examples of one step of training");
    v("learning_rate", o.learning_rate, above(0, 1),
      "largest step of AdamW; it rises over a fifth of the training and falls to none");
    v("weight_decay", o.weight_decay, within(0, 1),
      "share of the weights that each step takes off");
    v("dropout", o.dropout, within(0, 0.9),
      "share of the values behind each convolution that training leaves out; twice that, at most "
      "0.9, before the softmax");
    v("label_smoothing", o.label_smoothing, within(0, 0.9),
      "share of the probability asked for that is spread over all classes");
    v("seed", o.seed, any_seed, "of everything random in training");
  }
  /// nullptr, or which field is no multiple of what it has to be.
  [[nodiscard]] const char* conflict() const;
};

/// One convolution as it is applied: filter along time, matrix and bias.
struct SeparableConvolution {
  MatrixF kernel;   ///< shape (taps, in_channels); odd number of taps
  MatrixF weights;  ///< shape (in_channels, out_channels); a multiple of 8 channels
  VectorF bias;     ///< shape (out_channels,)
};

/// Immutable; const calls are safe from several threads, and give the same bits on every processor.
class HRI_API SequenceNetwork {
 public:
  /// Makes `frames`, shape (num_frames, dim), from example `index` for one step of training, with
  /// whatever augmentation by `random`; called from several threads at a time.
  using Examples = std::function<void(std::size_t index, Random* random, MatrixF* frames)>;
  /// Called behind every epoch with how many are done.
  using Progress = std::function<void(int epochs)>;

  /// On examples whose classes lie in 0..num_classes - 1, by cross-entropy and AdamW
  /// (Loshchilov and Hutter, ICLR 2019). Batch statistics are taken over 16 examples. Equal to the
  /// bit for any number of threads. Throws InvalidArgument for options out of range, fewer than two
  /// classes, a class without an example, and examples that differ in dim, have no frame or are not
  /// finite; Interrupted.
  static SequenceNetwork train(const Examples& examples, Span<const int> classes, int num_classes,
                               const SequenceNetworkOptions& options, const Progress& progress = {},
                               const StopCheck& should_stop = {});

  [[nodiscard]] int num_classes() const { return head_.num_classes(); }
  [[nodiscard]] int dim() const { return dim_; }

  /// What the softmax reads: mean and maximum over time of the last convolution.
  [[nodiscard]] VectorF pooled(ConstMatrixRefF frames) const;
  /// log P(c | frames) but for a constant, which does not depend on what other classes there are;
  /// shape (num_classes,).
  [[nodiscard]] VectorF scores(ConstMatrixRefF frames) const;
  /// log P(c | frames), shape (num_classes,). All throw InvalidArgument for frames of another dim,
  /// none, or values that are not finite.
  [[nodiscard]] VectorF log_posteriors(ConstMatrixRefF frames) const;

  /// With one class more, of number `index`: its weights in the softmax alone are fitted, as
  /// SoftmaxRegression::with_class() does.
  [[nodiscard]] SequenceNetwork with_class(int index, const std::vector<MatrixF>& sequences,
                                           const StopCheck& should_stop = {}) const;
  [[nodiscard]] SequenceNetwork without_class(int index) const;

  void write(ModelFile& file, const std::string& prefix) const;
  /// Throws FormatError where the sizes do not fit.
  static SequenceNetwork read(const ModelFile& file, const std::string& prefix);

 private:
  SequenceNetwork(std::vector<SeparableConvolution> layers, int dim, SoftmaxRegression head,
                  MatrixF means);

  std::vector<SeparableConvolution> layers_;  // the first thins frames, the last is in no block
  int dim_;
  SoftmaxRegression head_;
  MatrixF means_;  // of what is pooled, of every class; shape (num_classes, head_.dim())
};

}  // namespace hri
