// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Files of possibility-theory sets that were damaged or made up: refused by the name of the field,
// never read as something else.
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <utility>

#include "hri/core/error.hpp"
#include "hri/models/possibility/possibilistic_gaussian_hmm.hpp"
#include "models/sequence_model_cases.hpp"

namespace hri {
namespace {

using namespace testing_data;

constexpr Topology kTopology{Kind::rank_one_plus_band, 3, 1};

struct DiscreteSet {
  using Set = PossibilisticHmmSet;
  static Set make(const Topology& topology) {
    return Set({DiscreteCase::make(topology, 1), DiscreteCase::make(topology, 2)});
  }
  static VectorF scores(const Set& set) {
    return set.log_possibilities(DiscreteCase::sequence(9, 3));
  }
  static const char* shape_field() { return "emission"; }
};

struct GaussianSet {
  using Set = PossibilisticGaussianHmmSet;
  static Set make(const Topology& topology) {
    return Set({GaussianCase::make(topology, 1), GaussianCase::make(topology, 2)});
  }
  static VectorF scores(const Set& set) {
    return set.log_possibilities(GaussianCase::sequence(9, 3));
  }
  static const char* shape_field() { return "means"; }
};

template <class T>
class PossibilisticFiles : public ::testing::Test {};
using Cases = ::testing::Types<DiscreteSet, GaussianSet>;
TYPED_TEST_SUITE(PossibilisticFiles, Cases);

TYPED_TEST(PossibilisticFiles, AreRefusedWhateverByteIsWrong) {
  const auto set = TypeParam::make(kTopology);
  ModelFile file;
  set.write(file, "p.");
  const VectorF expected = TypeParam::scores(set);
  const std::vector<std::uint8_t> bytes = file.serialise();
  int num_refused = 0;
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    for (const int change : {0x01, 0x20, 0x80}) {
      std::vector<std::uint8_t> damaged = bytes;
      damaged[at] = static_cast<std::uint8_t>(damaged[at] ^ change);
      try {
        // A blank between two words of the header may become another one.
        const auto read = TypeParam::Set::read(ModelFile::parse(damaged, "damaged"), "p.");
        EXPECT_EQ(TypeParam::scores(read), expected) << "byte " << at;
      } catch (const FormatError&) {
        ++num_refused;
      }
    }
  }
  EXPECT_GT(num_refused, 2.9 * static_cast<double>(bytes.size()));
}

TYPED_TEST(PossibilisticFiles, AreRefusedByTheNameOfTheFieldThatIsWrong) {
  ModelFile file;
  TypeParam::make(kTopology).write(file, "p.");
  const std::string shape = std::string("p.1.") + TypeParam::shape_field();
  const std::vector<std::pair<std::string, std::function<void(ModelFile*)>>> faults{
      {"conjunction", [](ModelFile* f) { f->set_integer("p.conjunction", 3); }},
      {"conjunction", [](ModelFile* f) { f->set_integer("p.conjunction", -1); }},
      {"conjunction", [](ModelFile* f) { f->set_text("p.conjunction", "sum"); }},
      {"conditioned", [](ModelFile* f) { f->set_integer("p.conditioned", 2); }},
      {"conditioned", [](ModelFile* f) { f->set_number("p.conditioned", 0.5); }},
      {"concentration", [](ModelFile* f) { f->set_number("p.concentration", 0.5); }},
      {"concentration", [](ModelFile* f) { f->set_text("p.concentration", "much"); }},
      {"num_classes", [](ModelFile* f) { f->set_integer("p.num_classes", 0); }},
      {"num_classes", [](ModelFile* f) { f->set_integer("p.num_classes", -2); }},
      {"num_classes", [](ModelFile* f) { f->set_integer("p.num_classes", std::int64_t{1} << 40); }},
      {"p.2.topology", [](ModelFile* f) { f->set_integer("p.num_classes", 3); }},
      {"p.2.topology", [](ModelFile* f) { f->set_integer("p.num_classes", 2147483647); }},
      {"p.1.topology", [](ModelFile* f) { f->set_integer("p.1.topology", 17); }},
      {"p.1.num_states", [](ModelFile* f) { f->set_integer("p.1.num_states", 1000000000); }},
      {"p.1.max_jump", [](ModelFile* f) { f->set_integer("p.1.max_jump", 0); }},
      {"p.0.start", [](ModelFile* f) { f->set_integer("p.0.num_states", 4); }},
      {"p.1.start", [](ModelFile* f) { f->set_vector("p.1.start", VectorD(VectorD::Zero(3))); }},
      {"p.1.start", [](ModelFile* f) { f->set_vector("p.1.start", VectorD(VectorD::Unit(2, 0))); }},
      {"p.1.leave",
       [](ModelFile* f) { f->set_vector("p.1.leave", VectorD(VectorD::Constant(3, -0.1))); }},
      {"p.1.land", [](ModelFile* f) { f->set_matrix("p.1.land", MatrixD(MatrixD::Ones(3, 3))); }},
      {shape, [&](ModelFile* f) { f->set_matrix(shape, MatrixD(MatrixD::Ones(3, 17))); }},
      {shape, [&](ModelFile* f) { f->set_matrix(shape, MatrixD(MatrixD(6, 4).setConstant(2.5))); }},
      // A fine model, but not of the shape of the others.
      {"p.1.",
       [](ModelFile* f) {
         TypeParam::make({Kind::rank_one_plus_band, 4, 1}).models()[0].write(*f, "p.1.");
       }},
      {"p.1.",
       [](ModelFile* f) {
         TypeParam::make({Kind::rank_one_plus_band, 3, 2}).models()[0].write(*f, "p.1.");
       }},
  };
  for (std::size_t i = 0; i < faults.size(); ++i) {
    ModelFile bad = file;
    faults[i].second(&bad);
    EXPECT_PRED_FORMAT2(::testing::IsSubstring, faults[i].first,
                        message_of<FormatError>([&] { return TypeParam::Set::read(bad, "p."); }))
        << "fault " << i;
  }
  EXPECT_THROW(TypeParam::Set::read(file, "q."), FormatError);
}

}  // namespace
}  // namespace hri
