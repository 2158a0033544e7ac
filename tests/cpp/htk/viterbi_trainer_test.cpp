// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/htk/viterbi_trainer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "hri/core/error.hpp"
#include "hri/core/random.hpp"

namespace hri::htk {
namespace {

std::string gaussian(double mean) {
  return "<MEAN> 1 " + std::to_string(mean) + " <VARIANCE> 1 1 ";
}

// Two states of two Gaussians, the first of which may be skipped, and a floor.
ModelSet skipping(double low = 0, double high = 0) {
  ModelSet set;
  std::string text =
      "~o <VECSIZE> 1 <USER>\n~v varFloor1 <VARIANCE> 1 0.5\n~h x <BEGINHMM> "
      "<NUMSTATES> 4 ";
  for (const char* state : {"2", "3"}) {
    text += std::string("<STATE> ") + state + " <NUMMIXES> 2 <MIXTURE> 1 0.5 " +
            gaussian(*state == '2' ? low : 50 + low) + "<MIXTURE> 2 0.5 " +
            gaussian(*state == '2' ? high : 50 + high);
  }
  set.parse(text + "<TRANSP> 4 0 0.7 0.3 0 0 0.5 0.5 0 0 0 0.5 0.5 0 0 0 0 <ENDHMM>", "models");
  return set;
}

std::vector<MatrixF> recordings(bool first_is_there) {
  std::vector<MatrixF> all;
  Random rng(3);
  for (int r = 0; r < 12; ++r) {
    const int others = r % 3 != 0 ? 6 : 0;
    const int skipped = first_is_there ? 8 : others;
    MatrixF frames(skipped + 8, 1);
    for (Eigen::Index t = 0; t < frames.rows(); ++t) {
      const double heap = rng.uniform() < 0.5 ? -1.0 : 1.0;
      const double centre = t < skipped ? 4 * heap : 50 + 3 * heap;
      frames(t, 0) = static_cast<float>(centre + 0.1 * rng.normal());
    }
    all.push_back(std::move(frames));
  }
  return all;
}

TEST(ViterbiTrainer, KeepsTopologyMixturesAndFloors) {
  // From equal parts, a recording that skips a state would be cut in two.
  ViterbiTrainerOptions options;
  options.uniform_start = false;
  const ViterbiTraining made = train_by_viterbi(skipping(-1, 1), "x", recordings(false), options);
  EXPECT_TRUE(made.converged);
  for (std::size_t i = 1; i < made.log_probabilities.size(); ++i)
    EXPECT_GE(made.log_probabilities[i], made.log_probabilities[i - 1] - 1e-6);
  const HmmDefinition& hmm = made.models.find('h', "x")->hmm;
  // A third of the recordings skip the first state; six frames there, eight in the second.
  const MatrixD& steps = hmm.transitions.values;
  EXPECT_NEAR(steps(0, 2), 1.0 / 3, 1e-9);
  EXPECT_NEAR(steps(1, 1), 5.0 / 6, 1e-9);
  EXPECT_NEAR(steps(2, 3), 1.0 / 8, 1e-9);
  EXPECT_EQ(steps(1, 3), 0);
  for (std::size_t s = 0; s < 2; ++s) {
    ASSERT_EQ(hmm.states[s].components.size(), 2U);
    std::vector<double> means;
    for (const WeightedComponent& one : hmm.states[s].components) {
      means.push_back(one.component.mean.values[0]);
      EXPECT_EQ(one.component.variance.values[0], 0.5);
    }
    std::sort(means.begin(), means.end());
    EXPECT_NEAR(means[0], s == 0 ? -4 : 47, 0.1);
    EXPECT_NEAR(means[1], s == 0 ? 4 : 53, 0.1);
  }
  ASSERT_NE(made.models.find('v', "varFloor1"), nullptr);
}

TEST(ViterbiTrainer, BeginsWithEqualPartsAndTheirClusters) {
  const ViterbiTraining made = train_by_viterbi(skipping(), "x", recordings(true));
  const HmmDefinition& hmm = made.models.find('h', "x")->hmm;
  for (std::size_t s = 0; s < 2; ++s) {
    std::vector<double> means;
    for (const WeightedComponent& one : hmm.states[s].components)
      means.push_back(one.component.mean.values[0]);
    std::sort(means.begin(), means.end());
    EXPECT_NEAR(means[0], s == 0 ? -4 : 47, 0.1);
    EXPECT_NEAR(means[1], s == 0 ? 4 : 53, 0.1);
  }
  EXPECT_EQ(hmm.transitions.values(0, 2), 0);
}

TEST(ViterbiTrainer, KeepsWhatIsTiedTied) {
  ModelSet set;
  set.parse(
      "~o <VECSIZE> 1 <USER>\n~v all <VARIANCE> 1 1\n~h x <BEGINHMM> <NUMSTATES> 4 <STATE> 2 "
      "<MEAN> 1 0 ~v all <STATE> 3 <MEAN> 1 11 ~v all <TRANSP> 4 0 1 0 0 0 0.5 0.5 0 0 0.2 "
      "0.4 0.4 0 0 0 0 <ENDHMM>",
      "models");
  MatrixF frames(8, 1);
  frames << 0, 2, 10, 14, 0, 2, 10, 14;
  ViterbiTrainerOptions options;
  options.uniform_start = false;
  const ViterbiTraining made = train_by_viterbi(set, "x", {frames, frames}, options);
  const HmmDefinition& hmm = made.models.find('h', "x")->hmm;
  EXPECT_NEAR(hmm.states[0].components[0].component.mean.values[0], 1, 1e-9);
  EXPECT_NEAR(hmm.states[1].components[0].component.mean.values[0], 12, 1e-9);
  // Of all deviations together: 1 and 2.
  EXPECT_NEAR(made.models.find('v', "all")->vector.values[0], 2.5, 1e-9);
  EXPECT_EQ(hmm.states[1].components[0].component.variance.macro, "all");
  // Back to the first state, once a recording.
  EXPECT_NEAR(hmm.transitions.values(2, 1), 0.25, 1e-9);
}

TEST(ViterbiTrainer, EstimatesWhatIsWanted) {
  ViterbiTrainerOptions options;
  options.update_means = options.update_variances = options.update_weights = false;
  const ModelSet models = skipping();
  const ViterbiTraining made = train_by_viterbi(models, "x", recordings(true), options);
  EXPECT_EQ(made.models.find('h', "x")->hmm.states[0].components[0].component.mean.values[0], 0);
  EXPECT_NE(made.models.find('h', "x")->hmm.transitions.values,
            models.find('h', "x")->hmm.transitions.values);
}

TEST(ViterbiTrainer, Refuses) {
  EXPECT_EQ(min_frames_of(skipping(), "x"), 1);
  EXPECT_THROW(train_by_viterbi(skipping(), "y", recordings(true)), InvalidArgument);
  EXPECT_THROW(train_by_viterbi(skipping(), "x", {}), InvalidArgument);
  EXPECT_THROW(train_by_viterbi(skipping(), "x", {MatrixF(0, 1)}), InvalidArgument);
  EXPECT_THROW(train_by_viterbi(skipping(), "x", {MatrixF::Zero(4, 2)}), InvalidArgument);
  MatrixF bad = MatrixF::Zero(4, 1);
  bad(2, 0) = std::nanf("");
  EXPECT_THROW(train_by_viterbi(skipping(), "x", {bad}), InvalidArgument);
  ViterbiTrainerOptions options;
  options.max_iterations = -1;
  EXPECT_THROW(train_by_viterbi(skipping(), "x", recordings(true), options), InvalidArgument);
}

}  // namespace
}  // namespace hri::htk
