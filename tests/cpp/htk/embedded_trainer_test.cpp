// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/htk/embedded_trainer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "hri/core/error.hpp"
#include "hri/io/model_file.hpp"
#include "test_folder.hpp"

namespace hri::htk {
namespace {

using Names = std::vector<std::string>;

std::string gaussian(double mean, double variance) {
  return "<MEAN> 1 " + std::to_string(mean) + " <VARIANCE> 1 " + std::to_string(variance) + " ";
}

// Of two states each; sp has one, and may be skipped.
ModelSet models_to_train() {
  std::string text = "~o <VECSIZE> 1 <USER>\n";
  const auto add = [&](const std::string& name, double first, double second) {
    text += "~h \"" + name + "\" <BEGINHMM> <NUMSTATES> 4 <STATE> 2 <NUMMIXES> 2 <MIXTURE> 1 0.5 " +
            gaussian(first, 1) + "<MIXTURE> 2 0.5 " + gaussian(first + 1, 2) + "<STATE> 3 " +
            gaussian(second, 1) +
            "<TRANSP> 4 0 0.9 0.1 0 0 0.6 0.3 0.1 0 0 0.5 0.5 0 0 0 0 <ENDHMM>\n";
  };
  add("a", 0, 4);
  add("b", 6, 2);
  text += "~h \"sp\" <BEGINHMM> <NUMSTATES> 3 <STATE> 2 " + gaussian(9, 3) +
          "<TRANSP> 3 0 0.7 0.3 0 0.5 0.5 0 0 0 <ENDHMM>\n";
  ModelSet set;
  set.parse(text, "models");
  return set;
}

MatrixF frames(const std::vector<double>& centres, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<float> noise(0, 1);
  MatrixF made(static_cast<Eigen::Index>(5 * centres.size()), 1);
  for (Eigen::Index t = 0; t < made.rows(); ++t)
    made(t, 0) = static_cast<float>(centres[static_cast<std::size_t>(t / 5)]) + noise(random);
  return made;
}

EmbeddedTrainerOptions rare() {
  EmbeddedTrainerOptions options;
  options.min_examples = 1;
  return options;
}

void add_all(EmbeddedTrainer* trainer) {
  for (unsigned seed = 0; seed < 6; ++seed) {
    EXPECT_EQ(trainer->add(frames({1, 4, 9, 6, 3}, seed), {"a", "sp", "b", "sp"}),
              EmbeddedOutcome::added);
    EXPECT_EQ(trainer->add(frames({6, 3, 6, 3}, 50 + seed), {"b", "sp", "b"}),
              EmbeddedOutcome::added);
  }
}

void expect_proper(const ModelSet& set) {
  for (const MacroDefinition& macro : set.macros) {
    if (macro.type != 'h') continue;
    const MatrixD& steps = macro.hmm.transitions.values;
    for (Eigen::Index i = 0; i + 1 < steps.rows(); ++i)
      EXPECT_NEAR(steps.row(i).sum(), 1, 1e-12) << macro.name << " " << i;
    EXPECT_EQ(steps.row(steps.rows() - 1).sum(), 0);
    for (const StateDefinition& state : macro.hmm.states) {
      double sum = 0;
      for (const WeightedComponent& one : state.components) {
        sum += one.weight;
        const VectorD& variance = one.component.variance.values;
        EXPECT_GT(variance.minCoeff(), 0);
        EXPECT_NEAR(one.component.gconst, std::log(2 * 3.14159265358979324 * variance[0]), 1e-12);
      }
      EXPECT_NEAR(sum, 1, 1e-12);
    }
  }
}

TEST(EmbeddedTrainer, NeverMakesTheUtterancesLessLikely) {
  ModelSet set = models_to_train();
  double before = -std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < 12; ++iteration) {
    EmbeddedTrainer trainer(set, rare());
    add_all(&trainer);
    EXPECT_GE(trainer.log_likelihood(), before - 1e-9) << iteration;
    EXPECT_EQ(trainer.num_frames(), 6 * 45);
    before = trainer.log_likelihood();
    set = trainer.estimate();
    expect_proper(set);
  }
}

TEST(EmbeddedTrainer, AddsSumsOfPartsOfTheUtterances) {
  const TestFolder folder;
  const std::string path = folder / "HER1.acc";
  EmbeddedTrainer whole(models_to_train(), rare());
  EmbeddedTrainer part(models_to_train(), rare());
  EmbeddedTrainer rest(models_to_train(), rare());
  for (unsigned seed = 0; seed < 6; ++seed) {
    for (EmbeddedTrainer* trainer : {&whole, seed % 2 == 0 ? &part : &rest})
      trainer->add(frames({1, 4, 9, 6, 3}, seed), {"a", "sp", "b", "sp"});
  }
  part.write_sums(path);
  rest.add_sums(path);
  EXPECT_EQ(rest.num_frames(), whole.num_frames());
  EXPECT_NEAR(rest.log_likelihood(), whole.log_likelihood(), 1e-9);
  EXPECT_EQ(rest.occupations()[0].num_examples, 6);
  const ModelSet expected = whole.estimate();
  const ModelSet found = rest.estimate();
  for (const char* name : {"a", "b", "sp"}) {
    const HmmDefinition& one = expected.find('h', name)->hmm;
    const HmmDefinition& other = found.find('h', name)->hmm;
    EXPECT_LT((one.transitions.values - other.transitions.values).cwiseAbs().maxCoeff(), 1e-12);
    for (std::size_t s = 0; s < one.states.size(); ++s) {
      const ComponentDefinition& a = one.states[s].components[0].component;
      const ComponentDefinition& b = other.states[s].components[0].component;
      EXPECT_NEAR(a.mean.values[0], b.mean.values[0], 1e-12);
      EXPECT_NEAR(a.variance.values[0], b.variance.values[0], 1e-12);
    }
  }
}

TEST(EmbeddedTrainer, RefusesSumsOfOtherModelsAndDamagedOnes) {
  const TestFolder folder;
  const std::string path = folder / "HER1.acc";
  const auto refusal = [&path](const EmbeddedTrainer& written, const auto& change) {
    written.write_sums(path);
    ModelFile changed = ModelFile::read(path);
    change(&changed);
    changed.write(path);
    EmbeddedTrainer trainer(models_to_train(), rare());
    try {
      trainer.add_sums(path);
    } catch (const FormatError& error) {
      EXPECT_EQ(trainer.num_frames(), 0);
      return std::string(error.what()).substr(path.size());
    }
    return std::string("nothing thrown");
  };
  EmbeddedTrainer given(models_to_train(), rare());
  add_all(&given);
  const EmbeddedTrainer later(given.estimate(), rare());
  EXPECT_EQ(refusal(given, [](ModelFile*) {}), "nothing thrown");
  EXPECT_EQ(refusal(later, [](ModelFile*) {}), ": models: sums of other models");
  EXPECT_EQ(refusal(given, [](ModelFile* f) { f->set_kind("hmm"); }),
            ": kind: no sums of embedded training");
  EXPECT_EQ(refusal(given, [](ModelFile* f) { f->set_integer("num_frames", -1); }),
            ": num_frames: is below 0");
  EXPECT_EQ(
      refusal(given, [](ModelFile* f) { f->set_vector("examples", VectorD(VectorD::Zero(2))); }),
      ": examples: not as many as the models");
  EXPECT_EQ(
      refusal(given,
              [](ModelFile* f) { f->set_vector("examples", VectorD(VectorD::Constant(3, 0.5))); }),
      ": examples: one is no whole number");
  for (const char* field : {"transitions", "weights", "counts"}) {
    EXPECT_EQ(refusal(given,
                      [&](ModelFile* f) {
                        VectorD values = f->vector_d(field);
                        values[0] = -1;
                        f->set_vector(field, values);
                      }),
              std::string(": ") + field + ": one is below 0");
    EXPECT_EQ(
        refusal(given,
                [&](ModelFile* f) { f->set_vector(field, VectorD(f->vector_d(field).head(2))); }),
        std::string(": ") + field + ": not as many as the models have");
  }
  EXPECT_NE(refusal(given, [](ModelFile* f) { f->set_text("more", "x"); }), "nothing thrown");
}

TEST(EmbeddedTrainer, CountsEveryFrameOnce) {
  EmbeddedTrainer trainer(models_to_train(), rare());
  add_all(&trainer);
  double sum = 0;
  const std::vector<ModelOccupation> all = trainer.occupations();
  for (const ModelOccupation& one : all) {
    for (const double frames_of_state : one.states) sum += frames_of_state;
  }
  EXPECT_NEAR(sum, static_cast<double>(trainer.num_frames()), 1e-9);
  ASSERT_EQ(all.size(), 3U);
  EXPECT_EQ(all[0].num_examples, 6);
  EXPECT_EQ(all[1].num_examples, 18);
  EXPECT_EQ(all[2].name, "sp");
  EXPECT_EQ(all[2].num_examples, 18);
}

// What one frame through one model gives can be said by hand.
TEST(EmbeddedTrainer, SumsBothWaysPastASkippedModel) {
  EmbeddedTrainer trainer(models_to_train(), rare());
  MatrixF one(1, 1);
  one(0, 0) = 9;
  EXPECT_EQ(trainer.add(one, {"sp", "sp"}), EmbeddedOutcome::added);
  const double density = 1 / std::sqrt(2 * 3.14159265358979324 * 3);
  EXPECT_NEAR(trainer.log_likelihood(), std::log(2 * 0.7 * 0.5 * 0.3 * density), 1e-12);
  // In each of the two, half the time.
  const MatrixD steps = trainer.estimate().find('h', "sp")->hmm.transitions.values;
  EXPECT_NEAR(steps(0, 1), 0.5, 1e-12);
  EXPECT_NEAR(steps(0, 2), 0.5, 1e-12);
  EXPECT_NEAR(steps(1, 2), 1, 1e-12);
}

TEST(EmbeddedTrainer, LeavesOutWhatDoesNotFit) {
  EmbeddedTrainer trainer(models_to_train(), rare());
  const std::string before = trainer.estimate().to_text();
  EXPECT_EQ(trainer.add(frames({1}, 1).topRows(2), {"a", "b", "a"}), EmbeddedOutcome::too_short);
  EXPECT_EQ(trainer.add(MatrixF(0, 1), {"sp"}), EmbeddedOutcome::too_short);
  EXPECT_EQ(trainer.num_frames(), 0);
  EXPECT_EQ(trainer.occupations()[0].num_examples, 0);
  EXPECT_EQ(trainer.estimate().to_text(), before);
}

TEST(EmbeddedTrainer, BeamDropsPathsAndGrowsByItsStep) {
  const MatrixF utterance = frames({1, 4, 9, 6, 3}, 3);
  const Names units = {"a", "sp", "b", "sp"};
  EmbeddedTrainer whole(models_to_train(), rare());
  EXPECT_EQ(whole.add(utterance, units), EmbeddedOutcome::added);
  EmbeddedTrainerOptions options = rare();
  options.beam = 1000;
  EmbeddedTrainer wide(models_to_train(), options);
  EXPECT_EQ(wide.add(utterance, units), EmbeddedOutcome::added);
  EXPECT_NEAR(wide.log_likelihood(), whole.log_likelihood(), 1e-9);
  options.beam = 4;
  EmbeddedTrainer tight(models_to_train(), options);
  EXPECT_EQ(tight.add(utterance, units), EmbeddedOutcome::added);
  EXPECT_LT(tight.log_likelihood(), whole.log_likelihood());
  // Pruning leaves consistent sums: every frame counts once.
  double sum = 0;
  for (const ModelOccupation& one : tight.occupations()) {
    for (const double state : one.states) sum += state;
  }
  EXPECT_NEAR(sum, 25, 1e-9);
  // A beam in which the way through the transcript is lost.
  MatrixF odd(9, 1);
  odd << 0, 4, 300, 300, 300, 300, 300, 6, 2;
  options.beam = 0.1;
  EmbeddedTrainer narrow(models_to_train(), options);
  const Names many = {"a", "b", "a", "b"};
  EXPECT_EQ(narrow.add(odd, many), EmbeddedOutcome::impossible);
  options.beam_step = 50;
  options.beam_limit = 1e6;
  EmbeddedTrainer growing(models_to_train(), options);
  EXPECT_EQ(growing.add(odd, many), EmbeddedOutcome::added);
}

TEST(EmbeddedTrainer, EstimatesWhatIsAskedFor) {
  EmbeddedTrainerOptions options = rare();
  const auto changed = [&](const auto& of) {
    EmbeddedTrainer trainer(models_to_train(), options);
    add_all(&trainer);
    return of(trainer.estimate().find('h', "a")->hmm) != of(models_to_train().find('h', "a")->hmm);
  };
  const auto mean = [](const HmmDefinition& h) {
    return h.states[0].components[0].component.mean.values[0];
  };
  const auto variance = [](const HmmDefinition& h) {
    return h.states[1].components[0].component.variance.values[0];
  };
  const auto weight = [](const HmmDefinition& h) { return h.states[0].components[0].weight; };
  const auto step = [](const HmmDefinition& h) { return h.transitions.values(1, 1); };
  EXPECT_TRUE(changed(mean) && changed(variance) && changed(weight) && changed(step));
  options.update_means = false;
  EXPECT_TRUE(!changed(mean) && changed(variance) && changed(weight) && changed(step));
  options.update_variances = false;
  options.update_weights = false;
  options.update_transitions = false;
  EXPECT_FALSE(changed(mean) || changed(variance) || changed(weight) || changed(step));
  options = rare();
  options.min_examples = 7;  // a has 6
  EXPECT_FALSE(changed(mean) || changed(variance) || changed(weight) || changed(step));
}

TEST(EmbeddedTrainer, KeepsFloors) {
  ModelSet set = models_to_train();
  set.parse("~v varFloor1 <VARIANCE> 1 1.7\n", "floors");
  EmbeddedTrainerOptions options = rare();
  options.weight_floor = 40000;
  EmbeddedTrainer trainer(set, options);
  add_all(&trainer);
  const ModelSet made = trainer.estimate();
  EXPECT_EQ(made.find('v', "varFloor1")->vector.values[0], 1.7);
  bool at_floor = false;
  for (const StateDefinition& state : made.find('h', "b")->hmm.states) {
    for (const WeightedComponent& one : state.components) {
      EXPECT_GE(one.component.variance.values[0], 1.7);
      at_floor = at_floor || one.component.variance.values[0] == 1.7;
      EXPECT_GE(one.weight, 0.4 - 1e-12);
    }
  }
  EXPECT_TRUE(at_floor);
  options.min_variance = 2.5;
  EmbeddedTrainer higher(set, options);
  add_all(&higher);
  EXPECT_GE(
      higher.estimate().find('h', "b")->hmm.states[1].components[0].component.variance.values[0],
      2.5);
}

// Models that share all are estimated as the one model that they are.
TEST(EmbeddedTrainer, EstimatesWhatMacrosShareTogether) {
  const std::string parts =
      "~o <VECSIZE> 1 <USER>\n~t \"t\" <TRANSP> 3 0 1 0 0 0.6 0.4 0 0 0\n~v \"v\" <VARIANCE> 1 2\n"
      "~u \"u\" <MEAN> 1 1\n~m \"m\" ~u \"u\" ~v \"v\"\n~s \"s\" <NUMMIXES> 2 <MIXTURE> 1 0.4 ~m "
      "\"m\" <MIXTURE> 2 0.6 <MEAN> 1 5 ~v \"v\"\n";
  const auto hmm = [](const std::string& name) {
    return "~h " + name + " <BEGINHMM> <NUMSTATES> 3 <STATE> 2 ~s \"s\" ~t \"t\" <ENDHMM>\n";
  };
  ModelSet two;
  two.parse(parts + hmm("x") + hmm("y"), "two");
  ModelSet one;
  one.parse(parts + hmm("x"), "one");
  for (int iteration = 0; iteration < 3; ++iteration) {
    EmbeddedTrainer of_two(two, rare());
    EmbeddedTrainer of_one(one, rare());
    for (unsigned seed = 0; seed < 4; ++seed) {
      of_two.add(frames({1, 5}, seed), {"x", "y", "x"});
      of_one.add(frames({1, 5}, seed), {"x", "x", "x"});
    }
    EXPECT_NEAR(of_two.log_likelihood(), of_one.log_likelihood(), 1e-9);
    two = of_two.estimate();
    one = of_one.estimate();
    const std::string text = two.to_text();
    EXPECT_EQ(text.substr(0, text.find("~h")), one.to_text().substr(0, text.find("~h")));
    EXPECT_NE(text.find("~s \"s\""), std::string::npos);
  }
  // One variance of two Gaussians is about both of their means.
  const StateDefinition& state = one.find('h', "x")->hmm.states[0];
  EXPECT_EQ(state.components[0].component.variance.values,
            state.components[1].component.variance.values);
  EXPECT_LT(state.components[0].component.variance.values[0], 2);
}

TEST(EmbeddedTrainer, RefusesBadInput) {
  EXPECT_THROW(EmbeddedTrainer(ModelSet(), rare()), InvalidArgument);
  ModelSet no_way;
  no_way.parse("~h x <BEGINHMM> <NUMSTATES> 3 <STATE> 2 " + gaussian(0, 1) +
                   "<TRANSP> 3 0 1 0 0 1 0 0 0 0 <ENDHMM>\n",
               "m");
  EXPECT_THROW(EmbeddedTrainer(no_way, rare()), InvalidArgument);
  ModelSet floor = models_to_train();
  floor.macros.insert(floor.macros.begin(), MacroDefinition());
  floor.macros.front().type = 'v';
  floor.macros.front().name = "varFloor1";
  floor.macros.front().vector.values = VectorD::Ones(2);
  EXPECT_THROW(EmbeddedTrainer(floor, rare()), InvalidArgument);
  EmbeddedTrainer trainer(models_to_train(), rare());
  EXPECT_THROW(trainer.add(MatrixF::Zero(9, 1), {}), InvalidArgument);
  EXPECT_THROW(trainer.add(MatrixF::Zero(9, 1), {"a", "c"}), InvalidArgument);
  EXPECT_THROW(trainer.add(MatrixF::Zero(9, 2), {"a"}), InvalidArgument);
  EXPECT_THROW(trainer.add(MatrixF::Constant(9, 1, std::numeric_limits<float>::quiet_NaN()), {"a"}),
               InvalidArgument);
  EXPECT_EQ(trainer.num_frames(), 0);
}

}  // namespace
}  // namespace hri::htk
