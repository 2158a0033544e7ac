// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/possibility/possibilistic_gaussian_hmm.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "hri/core/error.hpp"
#include "models/possibility/possibilistic_path.hpp"
#include "models/possibility/possibilistic_rule.hpp"
#include "models/possibility/possibility_chains.hpp"
#include "models/possibility/state_possibilities.hpp"

namespace hri {
namespace {

constexpr float kImpossible = -std::numeric_limits<float>::infinity();

bool same_shape(const GaussianMixtureHmm& a, const GaussianMixtureHmm& b) {
  return detail::same_topology(a.chain().topology(), b.chain().topology()) && a.dim() == b.dim();
}

// Buffers of one thread.
struct Scratch {
  std::vector<float> densities;  // (num_classes, num_frames, num_states)
  std::vector<float> best;       // (num_frames): of all classes and states
  std::vector<float> rows;       // (num_frames, block_size)
  std::vector<float> levels;     // (num_frames, num_lanes)
  detail::ChainWorkspace<float> workspace;
};

// Emissions of one frame and class, in the layout of the block: log possibilities, conditioned
// within the class where `level` is wanted.
void place(const float* densities, float best, const detail::ChainLayout& layout, int c,
           const float* shift, float* row, float* level) {
  float top = 0;
  if (level != nullptr) {
    top = *std::max_element(densities, densities + layout.num_states) - best;
    if (!(top > kImpossible)) top = 0;  // impossible in all its states, and stays so
    level[c % layout.num_lanes] = top;
  }
  for (int j = 0; j < layout.num_states; ++j) {
    const int x = layout.position(c, j);
    row[x] = densities[j] - best - top + shift[x];
  }
}

}  // namespace

PossibilisticGaussianHmmSet::PossibilisticGaussianHmmSet(std::vector<GaussianMixtureHmm> models,
                                                         const PossibilisticRule& rule)
    : models_(std::move(models)), rule_(rule) {
  require(!models_.empty(), "a set needs at least one model");
  validate(rule_);
  for (const GaussianMixtureHmm& m : models_) {
    require(same_shape(m, models_.front()),
            "all models of a set need the same topology and dimension");
  }
  chains_ = std::make_shared<const detail::PossibilityChains<float>>(
      detail::scaled_together(detail::chains_of(models_)), detail::chain_rule<float>(rule_));
}

PossibilisticGaussianHmmSet PossibilisticGaussianHmmSet::train(
    const std::vector<std::vector<MatrixF>>& per_class, const GaussianMixtureHmmOptions& options,
    const PossibilisticRule& rule) {
  require(!per_class.empty(), "training needs at least one class");
  validate(rule);
  for (std::size_t c = 0; c < per_class.size(); ++c) {
    if (per_class[c].empty())
      fail(ErrorKind::invalid_argument, "class " + std::to_string(c) + " has no sequence");
  }
  std::vector<GaussianMixtureHmm> models;
  models.reserve(per_class.size());
  for (const std::vector<MatrixF>& sequences : per_class)
    models.push_back(GaussianMixtureHmm::train(sequences, options));
  return PossibilisticGaussianHmmSet(std::move(models), rule);
}

PossibilisticGaussianHmmSet PossibilisticGaussianHmmSet::with_class(
    GaussianMixtureHmm model) const {
  std::vector<GaussianMixtureHmm> models = models_;
  models.push_back(std::move(model));
  return PossibilisticGaussianHmmSet(std::move(models), rule_);
}

VectorF PossibilisticGaussianHmmSet::log_possibilities(ConstMatrixRefF frames) const {
  VectorF result(num_classes());
  log_possibilities(frames, {result.data(), static_cast<std::size_t>(result.size())});
  return result;
}

void PossibilisticGaussianHmmSet::log_possibilities(ConstMatrixRefF frames, Span<float> out) const {
  require(frames.rows() > 0, "frames must have at least one row");
  require(out.size() == models_.size(), "out must have one value a class");
  thread_local Scratch scratch;
  const detail::ChainLayout& layout = chains_->layout();
  const Eigen::Index num_frames = frames.rows();
  const std::ptrdiff_t n = layout.num_states;
  const auto count = [](std::ptrdiff_t a, std::ptrdiff_t b) {
    return static_cast<std::size_t>(a * b);
  };
  scratch.densities.resize(count(num_classes() * num_frames, n));
  scratch.best.assign(static_cast<std::size_t>(num_frames), kImpossible);
  for (int c = 0; c < num_classes(); ++c) {
    float* densities = scratch.densities.data() + c * num_frames * n;
    Eigen::Map<MatrixF> map(densities, num_frames, n);
    models_[static_cast<std::size_t>(c)].bank().log_densities(frames, map);
    for (Eigen::Index t = 0; t < num_frames; ++t) {
      float& best = scratch.best[static_cast<std::size_t>(t)];
      best = std::max(best, *std::max_element(densities + t * n, densities + (t + 1) * n));
    }
  }
  // A frame that no class can explain is impossible for all.
  std::replace(scratch.best.begin(), scratch.best.end(), kImpossible, 0.0F);
  const bool conditioned = detail::is_conditioned(rule_);
  scratch.rows.assign(count(num_frames, layout.block_size()), kImpossible);
  scratch.levels.assign(count(num_frames, layout.num_lanes), 0.0F);
  detail::FrameTable<float> table;
  table.rows = scratch.rows.data();
  table.row_size = layout.block_size();
  table.levels = conditioned ? scratch.levels.data() : nullptr;
  std::array<double, detail::ChainLayout::kMaxLanes> scores;
  for (int block = 0; block < layout.num_blocks; ++block) {
    const int first = block * layout.classes_a_block();
    const int end = std::min(first + layout.classes_a_block(), num_classes());
    for (int c = first; c < end; ++c) {
      for (Eigen::Index t = 0; t < num_frames; ++t) {
        place(scratch.densities.data() + (c * num_frames + t) * n,
              scratch.best[static_cast<std::size_t>(t)], layout, c, chains_->shift(block),
              scratch.rows.data() + t * layout.block_size(),
              conditioned ? scratch.levels.data() + t * layout.num_lanes : nullptr);
      }
    }
    chains_->reset(block, &scratch.workspace);
    chains_->advance(block, table, num_frames, &scratch.workspace);
    chains_->scores(block, scratch.workspace, scores.data());
    for (int c = first; c < end; ++c) {
      out[static_cast<std::size_t>(c)] =
          static_cast<float>(scores[static_cast<std::size_t>(c - first)]);
    }
  }
}

Possibilities PossibilisticGaussianHmmSet::classify(ConstMatrixRefF frames) const {
  return possibilities(log_possibilities(frames));
}

double PossibilisticGaussianHmmSet::viterbi(int class_index, ConstMatrixRefF frames,
                                            std::vector<int>* path) const {
  MatrixD log_b = log_emissions(class_index, frames);
  return detail::most_possible_path(
      detail::scaled_together(detail::chains_of(models_))[static_cast<std::size_t>(class_index)],
      rule_, std::move(log_b), path);
}

StatePossibilities PossibilisticGaussianHmmSet::state_possibilities(int class_index,
                                                                    ConstMatrixRefF frames) const {
  MatrixD log_b = log_emissions(class_index, frames);
  return detail::state_possibilities(models_[static_cast<std::size_t>(class_index)].chain(),
                                     detail::ChainScale(detail::chains_of(models_)), rule_,
                                     std::move(log_b));
}

// Of one class in double, scaled over all classes, after checking both arguments.
MatrixD PossibilisticGaussianHmmSet::log_emissions(int class_index, ConstMatrixRefF frames) const {
  require(class_index >= 0 && class_index < num_classes(), "class_index out of range");
  require(frames.rows() > 0, "frames must have at least one row");
  if (frames.cols() != dim()) {
    fail(ErrorKind::invalid_argument, "frames have " + std::to_string(frames.cols()) +
                                          " columns, the model has " + std::to_string(dim()));
  }
  VectorD best = VectorD::Constant(frames.rows(), -std::numeric_limits<double>::infinity());
  MatrixD wanted;
  for (int c = 0; c < num_classes(); ++c) {
    MatrixD log_b;
    models_[static_cast<std::size_t>(c)].bank().log_densities(frames, &log_b, nullptr);
    best = best.cwiseMax(log_b.rowwise().maxCoeff());
    if (c == class_index) wanted = std::move(log_b);
  }
  for (Eigen::Index t = 0; t < wanted.rows(); ++t) {
    if (best[t] > -std::numeric_limits<double>::infinity()) wanted.row(t).array() -= best[t];
  }
  return wanted;
}

void PossibilisticGaussianHmmSet::write(ModelFile& file, const std::string& prefix) const {
  detail::write_rule(rule_, num_classes(), file, prefix);
  for (std::size_t c = 0; c < models_.size(); ++c)
    models_[c].write(file, prefix + std::to_string(c) + ".");
}

PossibilisticGaussianHmmSet PossibilisticGaussianHmmSet::read(const ModelFile& file,
                                                              const std::string& prefix) {
  int num_classes = 0;
  const PossibilisticRule rule = detail::read_rule(file, prefix, &num_classes);
  std::vector<GaussianMixtureHmm> models;
  // A class that is not there ends this, however large the number.
  for (int c = 0; c < num_classes; ++c) {
    const std::string name = prefix + std::to_string(c) + ".";
    models.push_back(GaussianMixtureHmm::read(file, name));
    if (!same_shape(models.back(), models.front())) {
      fail(ErrorKind::format,
           file.name() + ": field '" + name + "means': differs in shape from class 0");
    }
  }
  return PossibilisticGaussianHmmSet(std::move(models), rule);
}

}  // namespace hri
