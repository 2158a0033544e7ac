// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Training of SequenceNetwork. A batch is cut into parts of 16 examples, each with batch statistics
// and slopes of its own, which are added up in order: however many threads take them, the result is
// the same.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/parallel_for.hpp"
#include "hri/core/error.hpp"
#include "hri/core/kernels.hpp"
#include "hri/models/network/sequence_network.hpp"
#include "models/network/network_part.hpp"
#include "models/network/product_kernels.hpp"

namespace hri {
namespace {

using detail::NetworkLayout;
using detail::NetworkPart;
using detail::Slot;

constexpr std::size_t kPartSize = 16;  // examples that batch statistics are taken over
constexpr double kWarmUp = 0.2;        // of all steps, over which the learning rate rises
constexpr double kFirstRate = 0.04;    // of the largest one
constexpr double kBeta1 = 0.9;
constexpr double kBeta2 = 0.999;
constexpr double kEpsilon = 1e-8;

// A number of its own for every use of random numbers.
std::uint64_t seed_of(std::uint64_t seed, std::uint64_t step, std::uint64_t place) {
  return Random(Random(seed + 0x9E3779B97F4A7C15ULL * (step + 1)).next_u64() + place).next_u64();
}

// One cycle of the learning rate by halves of a cosine (Smith and Topin, 2019).
double rate_at(double done) {
  const auto between = [](double from, double to, double share) {
    return to + (from - to) * 0.5 * (1 + std::cos(3.14159265358979323846 * share));
  };
  return done < kWarmUp ? between(kFirstRate, 1, done / kWarmUp)
                        : between(1, 0, (done - kWarmUp) / (1 - kWarmUp));
}

class NetworkTrainer {
 public:
  NetworkTrainer(const SequenceNetwork::Examples& examples, Span<const int> classes,
                 int num_classes, const SequenceNetworkOptions& options, StopCheck should_stop)
      : examples_(examples),
        classes_(classes),
        options_(options),
        should_stop_(std::move(should_stop)),
        dim_(dim_of_first()),
        layout_(dim_, num_classes, options),
        values_(layout_.initial(options.seed)),
        first_moment_(VectorF::Zero(values_.size())),
        second_moment_(VectorF::Zero(values_.size())) {}

  void run(const SequenceNetwork::Progress& progress) {
    const auto batch = static_cast<std::size_t>(options_.batch_size);
    const std::size_t num_batches = (classes_.size() + batch - 1) / batch;
    const auto num_steps =
        static_cast<double>(num_batches) * static_cast<double>(options_.num_epochs);
    std::vector<std::size_t> order(classes_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    for (int epoch = 0; epoch < options_.num_epochs; ++epoch) {
      Random random(seed_of(options_.seed, static_cast<std::uint64_t>(epoch), 0));
      for (std::size_t i = order.size(); i > 1; --i)
        std::swap(order[i - 1], order[static_cast<std::size_t>(random.below(i))]);
      for (std::size_t b = 0; b < num_batches; ++b) {
        // Batches of nearly equal size, so that the last one is none of a few.
        const std::size_t first = classes_.size() * b / num_batches;
        const std::size_t last = classes_.size() * (b + 1) / num_batches;
        take_step({order.data() + first, last - first},
                  rate_at(static_cast<double>(num_steps_done_) / num_steps));
      }
      if (progress) progress(epoch + 1);
    }
    measure();
  }

  [[nodiscard]] int dim() const { return dim_; }

  // Batch statistics and what is made of them become part of the weights.
  [[nodiscard]] std::vector<SeparableConvolution> layers() const {
    std::vector<SeparableConvolution> result;
    for (const auto& unit : layout_.units()) {
      const VectorF scale =
          (Slot::vector(values_, unit.scale).array() /
           (variance_.segment(unit.statistics, unit.out).array() + detail::kVarianceFloor).sqrt())
              .matrix();
      const VectorF mean = mean_.segment(unit.statistics, unit.out);
      SeparableConvolution layer;
      layer.kernel = Slot::matrix(values_, unit.kernel);
      layer.weights = Slot::matrix(values_, unit.weights) * scale.asDiagonal();
      layer.bias = Slot::vector(values_, unit.shift) - mean.cwiseProduct(scale);
      result.push_back(std::move(layer));
    }
    return result;
  }

  [[nodiscard]] SoftmaxRegression head() const {
    return SoftmaxRegression::of(Slot::matrix(values_, layout_.head_weights()).transpose(),
                                 Slot::vector(values_, layout_.head_bias()));
  }

 private:
  [[nodiscard]] int dim_of_first() const {
    Random random(options_.seed);
    MatrixF frames;
    examples_(0, &random, &frames);
    require(frames.size() > 0, "an example has no frame");
    return static_cast<int>(frames.cols());
  }

  void take_step(Span<const std::size_t> batch, double rate) {
    const std::size_t num_parts = std::max<std::size_t>(1, batch.size() / kPartSize);
    if (parts_.size() < num_parts) parts_.resize(num_parts, NetworkPart(layout_));
    const std::uint64_t step = num_steps_done_++;
    detail::parallel_for(num_parts, should_stop_, [&](std::size_t p, const StopCheck&) {
      const std::size_t first = batch.size() * p / num_parts;
      const std::size_t last = batch.size() * (p + 1) / num_parts;
      fill(batch.data() + first, last - first, step, &parts_[p]);
      Random dropout(seed_of(options_.seed + 1, step, p));
      parts_[p].run(values_, options_, &dropout);
    });
    VectorF slopes = parts_.front().slopes();
    for (std::size_t p = 1; p < num_parts; ++p) slopes += parts_[p].slopes();
    slopes /= static_cast<float>(batch.size());
    follow(slopes, rate * options_.learning_rate);
  }

  // Mean and variance of every channel over all examples, with the values that were learned.
  void measure() {
    std::vector<std::size_t> order(classes_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const std::size_t num_parts = std::max<std::size_t>(1, order.size() / kPartSize);
    std::vector<VectorD> means(num_parts);
    std::vector<VectorD> squares(num_parts);
    detail::parallel_for(num_parts, should_stop_, [&](std::size_t p, const StopCheck&) {
      const std::size_t first = order.size() * p / num_parts;
      const std::size_t last = order.size() * (p + 1) / num_parts;
      NetworkPart part(layout_);
      fill(order.data() + first, last - first, num_steps_done_, &part);
      part.measure(values_);
      means[p] = part.means().cast<double>();
      squares[p] = part.variances().cast<double>() + means[p].cwiseAbs2();
    });
    VectorD mean = VectorD::Zero(layout_.num_statistics());
    VectorD square = mean;
    for (std::size_t p = 0; p < num_parts; ++p) {
      mean += means[p] / static_cast<double>(num_parts);
      square += squares[p] / static_cast<double>(num_parts);
    }
    mean_ = mean.cast<float>();
    variance_ = (square - mean.cwiseAbs2()).cwiseMax(0.0).cast<float>();
  }

  void fill(const std::size_t* indices, std::size_t count, std::uint64_t step, NetworkPart* part) {
    part->clear();
    MatrixF frames;
    for (std::size_t i = 0; i < count; ++i) {
      Random random(seed_of(options_.seed + 2, step, indices[i]));
      examples_(indices[i], &random, &frames);
      require(frames.rows() > 0 && frames.cols() == dim_, "examples differ in dim, or have none");
      require(first_not_finite(frames.data(), static_cast<std::size_t>(frames.size())) ==
                  static_cast<std::size_t>(frames.size()),
              "an example is not finite");
      part->add(frames, classes_[indices[i]]);
    }
  }

  // One step of AdamW.
  void follow(const VectorF& slopes, double rate) {
    first_moment_ += static_cast<float>(1 - kBeta1) * (slopes - first_moment_);
    second_moment_ += static_cast<float>(1 - kBeta2) * (slopes.cwiseAbs2() - second_moment_);
    const auto steps = static_cast<double>(num_steps_done_);
    const auto by_first = static_cast<float>(rate / (1 - std::pow(kBeta1, steps)));
    const auto by_second = static_cast<float>(1 / (1 - std::pow(kBeta2, steps)));
    for (const Slot& slot : layout_.decaying()) {
      values_.segment(slot.first, slot.size()) *=
          1 - static_cast<float>(rate * options_.weight_decay);
    }
    values_.array() -= by_first * first_moment_.array() /
                       ((by_second * second_moment_.array()).sqrt() + static_cast<float>(kEpsilon));
  }

  const SequenceNetwork::Examples& examples_;
  Span<const int> classes_;
  SequenceNetworkOptions options_;
  StopCheck should_stop_;
  int dim_;
  NetworkLayout layout_;
  VectorF values_;
  VectorF mean_, variance_;  // of every channel behind a matrix
  VectorF first_moment_, second_moment_;
  std::vector<NetworkPart> parts_;
  std::uint64_t num_steps_done_ = 0;
};

}  // namespace

SequenceNetwork SequenceNetwork::train(const Examples& examples, Span<const int> classes,
                                       int num_classes, const SequenceNetworkOptions& options,
                                       const Progress& progress, const StopCheck& should_stop) {
  validate(options);
  require(num_classes >= 2, "training needs two classes at least");
  std::vector<int> counts(static_cast<std::size_t>(num_classes), 0);
  for (const int c : classes) {
    require(c >= 0 && c < num_classes, "a class is out of range");
    ++counts[static_cast<std::size_t>(c)];
  }
  require(std::find(counts.begin(), counts.end(), 0) == counts.end(), "a class has no example");
  NetworkTrainer trainer(examples, classes, num_classes, options, should_stop);
  trainer.run(progress);
  SequenceNetwork result(trainer.layers(), trainer.dim(), trainer.head(), MatrixF());
  std::vector<VectorF> pooled(classes.size());
  detail::parallel_for(classes.size(), should_stop, [&](std::size_t i, const StopCheck&) {
    Random random(seed_of(options.seed + 3, 0, i));
    MatrixF frames;
    examples(i, &random, &frames);
    pooled[i] = result.pooled(frames);
  });
  result.means_ = MatrixF::Zero(num_classes, result.head_.dim());
  for (std::size_t i = 0; i < classes.size(); ++i) {
    result.means_.row(classes[i]) +=
        pooled[i].transpose() / static_cast<float>(counts[static_cast<std::size_t>(classes[i])]);
  }
  return result;
}

}  // namespace hri
