// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/hmm/topology.hpp"

#include <gtest/gtest.h>

#include "hri/core/error.hpp"
#include "models/model_testing.hpp"

namespace hri {
namespace {

using Kind = Topology::Kind;
using namespace testing_data;

TEST(Topology, AllowsWhatItsKindSays) {
  EXPECT_TRUE((Topology{Kind::left_right, 4, 1}.allows(1, 2)));
  EXPECT_FALSE((Topology{Kind::left_right, 4, 1}.allows(1, 3)));
  EXPECT_FALSE((Topology{Kind::left_right, 4, 1}.allows(2, 1)));
  EXPECT_TRUE((Topology{Kind::banded, 4, 1}.allows(2, 1)));
  EXPECT_FALSE((Topology{Kind::banded, 4, 1}.allows(3, 1)));
  EXPECT_TRUE((Topology{Kind::ergodic, 4, 1}.allows(3, 0)));
}

TEST(Topology, StartsAsADistributionOnAllowedTransitions) {
  for (const Kind kind : {Kind::left_right, Kind::banded, Kind::ergodic}) {
    for (const int num_states : {1, 2, 5}) {
      for (const int max_jump : {1, 2}) {
        const Topology topology{kind, num_states, max_jump};
        const MatrixD a = initial_transition(topology);
        EXPECT_NEAR(initial_start(topology).sum(), 1.0, 1e-12);
        for (int i = 0; i < num_states; ++i) {
          EXPECT_NEAR(a.row(i).sum(), 1.0, 1e-12);
          for (int j = 0; j < num_states; ++j) EXPECT_EQ(a(i, j) > 0, topology.allows(i, j));
        }
      }
    }
  }
}

TEST(Topology, RefusesFieldsOutOfRangeByName) {
  const auto refused = [](const Topology& t) {
    return message_of<InvalidArgument>([&] { validate(t); });
  };
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "num_states", refused({Kind::left_right, 0, 1}));
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "num_states", refused({Kind::left_right, 5000, 1}));
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "max_jump", refused({Kind::left_right, 5, 0}));
}

TEST(Topology, ComesBackFromAFile) {
  ModelFile file;
  write_topology({Kind::banded, 7, 2}, file, "t.");
  const Topology t = read_topology(through_bytes(file), "t.");
  EXPECT_EQ(t.kind, Kind::banded);
  EXPECT_EQ(t.num_states, 7);
  EXPECT_EQ(t.max_jump, 2);
  file.set_integer("t.num_states", -1);
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "t.num_states",
                      message_of<FormatError>([&] { return read_topology(file, "t."); }));
}

}  // namespace
}  // namespace hri
