// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "recognition/subword/unit_training.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "hri/core/error.hpp"
#include "hri/htk/edit_script.hpp"
#include "hri/htk/embedded_trainer.hpp"
#include "hri/htk/flat_start.hpp"

namespace hri::detail {
namespace {

constexpr double kStay = 0.6;  // before training
constexpr double kLongestStay = 0.999;
constexpr int kWeightFloor = 100;  // of EmbeddedTrainerOptions
constexpr double kFewFrames = 1e-6;

std::vector<std::string> between_silences(const std::vector<std::string>& units) {
  std::vector<std::string> all{UnitModels::kSilence};
  all.insert(all.end(), units.begin(), units.end());
  all.emplace_back(UnitModels::kSilence);
  return all;
}

MarkovChain chain_of(int num_states) {
  Topology topology;
  topology.num_states = num_states;
  topology.max_jump = 1;
  return {topology, initial_start(topology), initial_transition(topology, kStay)};
}

// Sums of the frames that a segmentation gives to a state.
struct StateSums {
  double count = 0;
  VectorD sum;
  VectorD squares;
};

// Means and variances of the states of every unit where the frames of each utterance are dealt out
// evenly: the edges to silence, the rest to the units.
class UniformSegments {
 public:
  UniformSegments(int num_states, Eigen::Index dim) : num_states_(num_states), dim_(dim) {}

  // False, and nothing added, for too few frames.
  bool add(const UnitUtterance& utterance) {
    const auto num_units = static_cast<Eigen::Index>(utterance.units.size());
    const Eigen::Index edge = utterance.num_edge;
    const Eigen::Index inner = utterance.frames.rows() - 2 * edge;
    if (edge < num_states_ || inner < num_units * num_states_) return false;
    add(UnitModels::kSilence, utterance.frames.topRows(edge));
    add(UnitModels::kSilence, utterance.frames.bottomRows(edge));
    for (Eigen::Index u = 0; u < num_units; ++u) {
      const Eigen::Index first = edge + u * inner / num_units;
      const Eigen::Index last = edge + (u + 1) * inner / num_units;
      add(utterance.units[static_cast<std::size_t>(u)],
          utterance.frames.middleRows(first, last - first));
    }
    return true;
  }

  // Of one Gaussian a state.
  [[nodiscard]] htk::ModelSet models(const VectorD& floor) const {
    htk::ModelSet set;
    for (const auto& [name, states] : states_) {
      MatrixD means(num_states_, dim_);
      MatrixD variances(num_states_, dim_);
      for (Eigen::Index s = 0; s < num_states_; ++s) {
        const StateSums& sums = states[static_cast<std::size_t>(s)];
        const VectorD mean = sums.sum / sums.count;
        means.row(s) = mean.transpose();
        variances.row(s) =
            (sums.squares / sums.count - mean.cwiseAbs2()).cwiseMax(floor).transpose();
      }
      set.add(name, {chain_of(num_states_), {MatrixD::Ones(num_states_, 1), means, variances}},
              kStay);
    }
    return set;
  }

  [[nodiscard]] bool has(const std::string& unit) const { return states_.count(unit) > 0; }

 private:
  void add(const std::string& unit, const MatrixF& frames) {
    std::vector<StateSums>& states = states_[unit];
    if (states.empty())
      states.resize(static_cast<std::size_t>(num_states_),
                    {0, VectorD::Zero(dim_), VectorD::Zero(dim_)});
    for (Eigen::Index t = 0; t < frames.rows(); ++t) {
      StateSums& state = states[static_cast<std::size_t>(t * num_states_ / frames.rows())];
      const VectorD frame = frames.row(t).transpose().cast<double>();
      state.count += 1;
      state.sum += frame;
      state.squares += frame.cwiseAbs2();
    }
  }

  int num_states_;
  Eigen::Index dim_;
  std::map<std::string, std::vector<StateSums>> states_;
};

htk::EmbeddedTrainer trainer_on(const htk::ModelSet& models,
                                const std::vector<UnitUtterance>& utterances,
                                const StopCheck& should_stop) {
  htk::EmbeddedTrainerOptions options;
  options.min_examples = 1;
  options.weight_floor = kWeightFloor;
  htk::EmbeddedTrainer trainer(models, options);
  for (const UnitUtterance& utterance : utterances) {
    poll(should_stop);
    trainer.add(utterance.frames, between_silences(utterance.units));
  }
  return trainer;
}

UnitModels units_of(const htk::ModelSet& set) {
  UnitModels units;
  for (const std::string& name : set.hmm_names()) {
    const htk::HmmDefinition& hmm = set.find('h', name)->hmm;
    const Eigen::Index last = hmm.transitions.values.rows() - 2;
    units.names.push_back(name);
    units.models.push_back(htk::to_hmm(hmm));
    units.final_stays.push_back(std::min(hmm.transitions.values(last, last), kLongestStay));
  }
  return units;
}

htk::ModelSet set_of(const UnitModels& units) {
  htk::ModelSet set;
  for (std::size_t u = 0; u < units.names.size(); ++u)
    set.add(units.names[u], units.models[u], units.final_stays[u]);
  return set;
}

// The prior's means, moved to those of `estimated` as their frames weigh: `occupation` of the
// states, which the estimated weights share.
GaussianMixtureHmm moved(const GaussianMixtureHmm& prior, const GaussianMixtureHmm& estimated,
                         const std::vector<double>& occupation, double prior_frames) {
  MatrixD means = prior.bank().means();
  const Eigen::Index num_mixtures = prior.bank().num_mixtures();
  for (Eigen::Index row = 0; row < means.rows(); ++row) {
    const Eigen::Index state = row / num_mixtures;
    const double frames = occupation[static_cast<std::size_t>(state)] *
                          estimated.bank().weights()(state, row % num_mixtures);
    if (frames < kFewFrames) continue;
    const double share = frames / (frames + prior_frames);
    means.row(row) += share * (estimated.bank().means().row(row) - means.row(row));
  }
  return {prior.chain(), {prior.bank().weights(), means, prior.bank().variances()}};
}

}  // namespace

UnitModels train_units(const std::vector<UnitUtterance>& utterances,
                       const SubwordRecognizerOptions& options, const StopCheck& should_stop) {
  require(!utterances.empty(), "there is no recording to train on");
  UniformSegments segments(options.num_states, utterances.front().frames.cols());
  htk::FlatStart all;
  std::vector<UnitUtterance> used;
  for (const UnitUtterance& utterance : utterances) {
    if (!segments.add(utterance)) continue;
    all.add(utterance.frames);
    used.push_back(utterance);
  }
  for (const UnitUtterance& utterance : utterances) {
    for (const std::string& unit : utterance.units) {
      if (!segments.has(unit))
        fail(ErrorKind::invalid_argument,
             "all recordings with the unit '" + unit + "' are too short for its word");
    }
  }
  const htk::ModelSet floors = all.variance_floors(options.variance_floor);
  htk::ModelSet models = segments.models(floors.macros.front().vector.values);
  models.macros.insert(models.macros.begin(), floors.macros.front());
  for (int mixtures = 1;; mixtures = std::min(2 * mixtures, options.num_mixtures)) {
    if (mixtures > 1) {
      const std::string last = std::to_string(options.num_states + 1);
      models = htk::EditScript::parse(
                   "MU " + std::to_string(mixtures) + " {*.state[2-" + last + "].mix}\n", "split")
                   .apply(std::move(models));
    }
    for (int pass = 0; pass < options.num_passes; ++pass)
      models = trainer_on(models, used, should_stop).estimate();
    if (mixtures == options.num_mixtures) return units_of(models);
  }
}

UnitModels adapt_units(const UnitModels& units, const std::vector<UnitUtterance>& utterances,
                       const SubwordRecognizerOptions& options, const StopCheck& should_stop) {
  UnitModels adapted = units;
  for (int pass = 0; pass < options.num_adaptations; ++pass) {
    const htk::EmbeddedTrainer trainer = trainer_on(set_of(adapted), utterances, should_stop);
    require(trainer.num_frames() > 0, "all recordings of the word are too short for its units");
    const UnitModels estimated = units_of(trainer.estimate());
    const std::vector<htk::ModelOccupation> occupations = trainer.occupations();
    for (std::size_t u = 0; u < units.names.size(); ++u) {
      if (units.names[u] == UnitModels::kSilence) continue;
      adapted.models[u] =
          moved(units.models[u], estimated.models[u], occupations[u].states, options.prior_frames);
    }
  }
  return adapted;
}

}  // namespace hri::detail
