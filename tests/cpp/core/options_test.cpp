// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/core/options.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <limits>

#include "option_checks.hpp"

namespace hri {

enum class Colour : std::uint8_t { red, green };
constexpr auto enum_names(Colour) { return std::array{"red", "green"}; }

struct LampOptions {
  double power = 10;

  static constexpr const char* kName = "LampOptions";
  template <class Self, class Visitor>
  static void visit(Self& o, Visitor&& v) {
    v("power", o.power, above(0, 100), "of the lamp");
  }
};

struct RoomOptions {
  LampOptions lamp;
  Colour colour = Colour::green;
  int num_walls = 4;
  double width_s = 2;
  double old_width = 1;
  bool open = false;

  static constexpr const char* kName = "RoomOptions";
  template <class Self, class Visitor>
  static void visit(Self& o, Visitor&& v) {
    v("lamp", o.lamp, any_value, "what gives light");
    v("colour", o.colour, any_value, "of the walls");
    v("num_walls", o.num_walls, within(2, 8).even().or_zero(), "how many walls", formerly("walls"));
    v("width_s", o.width_s, below(0, 5), "how wide");
    v("old_width", o.old_width, within(0, 9), "how wide it was", older_default(3.0));
    v("open", o.open, any_value, "whether it has a door");
  }
  [[nodiscard]] const char* conflict() const {
    return open && num_walls == 0 ? "open needs num_walls" : nullptr;
  }
};

namespace {

TEST(Options, EveryFieldOfAStructIsChecked) {
  hri_test::expect_ranges_hold<RoomOptions>();
  hri_test::expect_model_file_keeps<RoomOptions>();
}

TEST(Options, RangesHoldTheirEndsAndNeverNan) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const Range& range : {within(0, 1), above(0, 1), below(0, 1), within(1, 9).odd(),
                             above(0, 1).or_infinity(), within(2, 3).or_zero()}) {
    EXPECT_FALSE(range.holds(nan)) << range.text();
    EXPECT_FALSE(range.holds(-infinity)) << range.text();
    EXPECT_EQ(range.holds(infinity), range.with_infinity) << range.text();
  }
  EXPECT_TRUE(within(0, 1).holds(0) && within(0, 1).holds(1));
  EXPECT_FALSE(above(0, 1).holds(0));
  EXPECT_FALSE(below(0, 1).holds(1));
  EXPECT_TRUE(within(1, 9).odd().holds(3));
  EXPECT_FALSE(within(1, 9).odd().holds(4));
  EXPECT_TRUE(within(-9, 9).odd().holds(-3));
  EXPECT_TRUE(within(1000, 2000).or_zero().holds(0));
  EXPECT_FALSE(within(1000, 2000).or_zero().holds(1));
}

TEST(Options, RangesSayWhatTheyHold) {
  EXPECT_EQ(within(1, 100000).text(), "1..100000");
  EXPECT_EQ(above(0, 1e12).text(), "0..1e+12, 0 excluded");
  EXPECT_EQ(below(0, 1).text(), "0..1, 1 excluded");
  EXPECT_EQ(within(2, 8).even().or_zero().text(), "2..8, even, or 0");
  EXPECT_EQ(above(0, 5).or_infinity().text(), "0..5, 0 excluded, or infinite");
  EXPECT_EQ(any_seed.text(), "0..2^64 - 1");
}

TEST(Options, FaultsNameStructAndFieldAndWhatFieldsDoNotGoTogether) {
  RoomOptions room;
  EXPECT_EQ(options_fault(room), "");
  room.lamp.power = 0;
  EXPECT_EQ(options_fault(room), "LampOptions.power must lie in 0..100, 0 excluded, got 0");
  room = {};
  room.colour = static_cast<Colour>(7);
  EXPECT_EQ(options_fault(room), "RoomOptions.colour must be one of 'red', 'green'");
  room = {};
  room.open = true;
  room.num_walls = 0;
  EXPECT_EQ(options_fault(room), "RoomOptions: open needs num_walls");
  EXPECT_THROW(validate(room), InvalidArgument);
}

TEST(Options, EnumsHaveNames) {
  Colour colour = Colour::red;
  EXPECT_TRUE(parse_enum("green", &colour));
  EXPECT_EQ(colour, Colour::green);
  EXPECT_FALSE(parse_enum("blue", &colour));
  EXPECT_STREQ(enum_name(Colour::red), "red");
  EXPECT_EQ(enum_list<Colour>(), "'red', 'green'");
  EXPECT_THROW(enum_name(static_cast<Colour>(2)), InvalidArgument);
}

TEST(Options, UnitsComeFromTheName) {
  EXPECT_EQ(unit_of("frame_ms"), "ms");
  EXPECT_EQ(unit_of("silence_dbfs"), "dBFS");
  EXPECT_EQ(unit_of("running_s"), "s");
  EXPECT_EQ(unit_of("num_states"), "");
}

TEST(OptionsInFiles, FormerNamesNumbersOfEnumsAndOlderDefaultsAreRead) {
  ModelFile written;
  written.set_kind("room");
  written.set_number("lamp.power", 20);
  written.set_integer("walls", 6);
  written.set_text("colour", "red");
  const auto bytes = written.serialise();
  const ModelFile file = ModelFile::parse(bytes, "room.hri");
  RoomOptions room;
  detail::read_options(file, &room);
  EXPECT_EQ(room.lamp.power, 20);
  EXPECT_EQ(room.num_walls, 6);
  EXPECT_EQ(room.colour, Colour::red);
  EXPECT_EQ(room.width_s, 2) << "no file said otherwise";
  EXPECT_EQ(room.old_width, 3) << "what files without it meant";
  EXPECT_EQ(file.kind(), "room");
  file.require_all_read();
}

TEST(OptionsInFiles, UnknownNamesAndFieldsAreRefused) {
  ModelFile file;
  file.set_text("colour", "blue");
  RoomOptions room;
  EXPECT_THROW(detail::read_options(file, &room), FormatError);
  file.set_text("colour", "1");
  EXPECT_THROW(detail::read_options(file, &room), FormatError) << "numbers are version 1";
  file.set_text("colour", "red");
  detail::read_options(file, &room);
  file.require_all_read();
  file.set_number("height", 2);
  try {
    file.require_all_read();
    FAIL() << "height is unknown";
  } catch (const FormatError& error) {
    EXPECT_NE(std::string(error.what()).find("'height'"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace hri
