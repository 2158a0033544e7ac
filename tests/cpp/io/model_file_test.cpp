// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/io/model_file.hpp"

#include <clocale>
#include <cmath>
#include <cstring>
#include <limits>
#include <locale>

#include "hri/core/error.hpp"
#include "hri/core/random.hpp"
#include "io/io_testing.hpp"
#include "test_folder.hpp"

namespace hri {
namespace {

using io_testing::message_of;

ModelFile sample() {
  ModelFile file;
  file.set_kind("sample");
  file.set_text_list("labels", {"एक", "two", "with \"quotes\"", ""});
  file.set_integer("answer", -42);
  file.set_number("third", 1.0 / 3.0);
  MatrixD a(2, 3);
  a << 1.0 / 7.0, -0.0, 1e-300, 3, 4, -1e30;
  file.set_matrix("a", a);
  file.set_vector("v", VectorF(VectorF::LinSpaced(5, 0.1F, 0.5F)));
  return file;
}

TEST(ModelFile, ComesBackToTheBit) {
  const TestFolder folder;
  const ModelFile written = sample();
  written.write(folder / "m.hri");
  const ModelFile read = ModelFile::read(folder / "m.hri");
  EXPECT_EQ(read.kind(), "sample");
  EXPECT_EQ(read.text_list("labels"), written.text_list("labels"));
  EXPECT_EQ(read.integer("answer"), -42);
  EXPECT_EQ(read.number("third"), 1.0 / 3.0);
  EXPECT_EQ(read.matrix_d("a"), written.matrix_d("a"));
  EXPECT_TRUE(std::signbit(read.matrix_d("a")(0, 1)));
  EXPECT_EQ(read.vector_f("v"), written.vector_f("v"));
  EXPECT_EQ(read.serialise(), written.serialise());
  EXPECT_EQ(read.name(), folder / "m.hri");
}

TEST(ModelFile, NamesFileAndFieldOfWhatIsNotThere) {
  const ModelFile file = ModelFile::parse(sample().serialise(), "robot.hri");
  for (const std::string& message :
       {message_of<FormatError>([&] { (void)file.matrix_d("means"); }),
        message_of<FormatError>([&] { (void)file.text("means"); }),
        message_of<FormatError>([&] { (void)file.number("means"); })}) {
    EXPECT_NE(message.find("robot.hri"), std::string::npos) << message;
    EXPECT_NE(message.find("means"), std::string::npos) << message;
  }
  EXPECT_THROW((void)file.matrix_f("a"), FormatError);  // it holds doubles
  EXPECT_THROW((void)file.vector_d("a"), FormatError);  // it has two rows
  EXPECT_THROW((void)file.integer("third"), FormatError);
  EXPECT_TRUE(file.has("a"));
  EXPECT_FALSE(file.has("b"));
}

TEST(ModelFile, RefusesNumbersThatAreNotFinite) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const double bad : {std::nan(""), kInfinity, -kInfinity}) {
    ModelFile file;
    file.set_kind("sample");
    EXPECT_THROW(file.set_number("n", bad), InvalidArgument);
    MatrixD m = MatrixD::Zero(2, 2);
    m(1, 0) = bad;
    EXPECT_NE(message_of<InvalidArgument>([&] { file.set_matrix("means", m); }).find("means"),
              std::string::npos);
    EXPECT_THROW(file.set_vector("v", VectorF(m.col(0).cast<float>())), InvalidArgument);
  }
  // Nor as the text of a number.
  ModelFile file;
  file.set_kind("sample");
  file.set_text("third", "nan");
  file.set_text("fourth", "1e999");
  file.set_text("fifth", "1,5");
  for (const char* field : {"third", "fourth", "fifth"})
    EXPECT_THROW((void)file.number(field), FormatError) << field;
}

// Finite, but what is computed from them is not.
TEST(ModelFile, RefusesNumbersThatAreAbsurdlyLarge) {
  ModelFile file;
  file.set_kind("sample");
  EXPECT_THROW(file.set_number("n", 2e30), InvalidArgument);
  EXPECT_THROW(file.set_vector("v", VectorD(VectorD::Constant(3, -2e30))), InvalidArgument);
  EXPECT_THROW(file.set_vector("w", VectorF(VectorF::Constant(3, 3e38F))), InvalidArgument);
  file.set_vector("w", VectorF(VectorF::Constant(3, 1e15F)));
  file.set_text("scale", "1e308");
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "field 'scale' is beyond 1e30",
                      message_of<FormatError>([&] { (void)file.number("scale"); }));
}

TEST(ModelFile, RefusesTextThatIsNotUtf8) {
  ModelFile file;
  EXPECT_NE(message_of<InvalidArgument>([&] { file.set_kind("caf\xe9"); }).find("kind"),
            std::string::npos);
  EXPECT_THROW(file.set_text_list("labels", {"fine", "\xff"}), InvalidArgument);
  file.set_kind(std::string("zero\0inside", 11));
  EXPECT_EQ(ModelFile::parse(file.serialise(), "x").kind(), file.kind());
}

// As a program sees it that set its user's locale: decimal commas and points between thousands.
struct Commas : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

TEST(ModelFile, IsTheSameInEveryLocale) {
  const std::vector<std::uint8_t> bytes = sample().serialise();
  const std::locale before = std::locale::global(std::locale(std::locale(), new Commas));
  const std::string c_before = std::setlocale(LC_NUMERIC, nullptr);
  for (const char* name : {"de_DE.UTF-8", "fr_FR.UTF-8", "ru_RU.UTF-8"}) {
    if (std::setlocale(LC_NUMERIC, name) != nullptr) break;
  }
  const std::vector<std::uint8_t> there = sample().serialise();
  const double third = ModelFile::parse(bytes, "x").number("third");
  std::locale::global(before);
  std::setlocale(LC_NUMERIC, c_before.c_str());
  EXPECT_EQ(there, bytes);
  EXPECT_EQ(third, 1.0 / 3.0);
}

TEST(ModelFile, KeepsEveryNumberToTheBit) {
  ModelFile file;
  file.set_kind("sample");
  Random random(23);
  for (int i = 0; i < 2000; ++i) {
    const std::uint64_t bits = random.next_u64();
    double value = 0;
    std::memcpy(&value, &bits, sizeof value);
    if (i == 0) value = std::numeric_limits<double>::denorm_min();
    if (i == 1) value = ModelFile::kLargestNumber;
    if (i == 2) value = -0.0;
    if (!(std::abs(value) <= ModelFile::kLargestNumber)) continue;
    file.set_number("n", value);
    const double back = file.number("n");
    EXPECT_EQ(std::memcmp(&back, &value, sizeof value), 0) << value;
  }
  file.set_integer("i", std::numeric_limits<std::int64_t>::min());
  EXPECT_EQ(file.integer("i"), std::numeric_limits<std::int64_t>::min());
  file.set_text("i", "9223372036854775808");
  EXPECT_THROW((void)file.integer("i"), FormatError);
}

TEST(ModelFile, RefusesEveryShorterFile) {
  const std::vector<std::uint8_t> bytes = sample().serialise();
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    EXPECT_THROW(ModelFile::parse(Span<const std::uint8_t>(bytes).subspan(0, length), "x"),
                 FormatError)
        << length;
  }
}

// Whatever is changed, reading ends in a FormatError or in the same content; nothing else may be
// thrown, and nothing read beyond the bytes (sanitizers watch).
TEST(ModelFile, SurvivesEveryMutation) {
  const std::vector<std::uint8_t> bytes = sample().serialise();
  Random random(11);
  int refused = 0;
  for (int i = 0; i < 5000; ++i) {
    std::vector<std::uint8_t> broken = bytes;
    for (std::uint64_t k = 0; k <= random.below(3); ++k) {
      broken[random.below(broken.size())] = static_cast<std::uint8_t>(random.below(256));
    }
    if (random.below(4) == 0) broken.resize(random.below(broken.size()));
    try {
      const ModelFile file = ModelFile::parse(broken, "x");
      if (file.has("a")) {
        EXPECT_EQ(file.matrix_d("a"), sample().matrix_d("a"));
      }
    } catch (const FormatError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 4500);
}

TEST(ModelFile, BoundsSizesByTheRealOne) {
  for (const std::uint64_t length :
       {std::uint64_t{1} << 62U, ~std::uint64_t{0}, std::uint64_t{9}}) {
    std::vector<std::uint8_t> bytes(16, '{');
    for (unsigned i = 0; i < 8; ++i) bytes[i] = static_cast<std::uint8_t>(length >> (8 * i));
    EXPECT_THROW(ModelFile::parse(bytes, "x"), FormatError);
  }
}

}  // namespace
}  // namespace hri
