// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// The options structs of vision alone; tests/py/test_options.py checks that none is left out.
#include <gtest/gtest.h>

#include "hri/vision/face_finder.hpp"
#include "hri/vision/person_hands.hpp"
#include "option_checks.hpp"

namespace hri {
namespace {

template <class O>
class PeopleOptions : public testing::Test {};

using All = testing::Types<FaceFinderOptions, PersonOptions>;
TYPED_TEST_SUITE(PeopleOptions, All);

TYPED_TEST(PeopleOptions, RefusesWhatLiesOutsideARange) {
  hri_test::expect_ranges_hold<TypeParam>();
}

TYPED_TEST(PeopleOptions, GoesThroughAModelFile) { hri_test::expect_model_file_keeps<TypeParam>(); }

}  // namespace
}  // namespace hri
