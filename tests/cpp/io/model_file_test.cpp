// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/io/model_file.hpp"

#include <cmath>
#include <limits>

#include "hri/core/error.hpp"
#include "hri/core/random.hpp"
#include "io/io_testing.hpp"

namespace hri {
namespace {

using io_testing::Folder;
using io_testing::message_of;

ModelFile sample() {
  ModelFile file;
  file.set_kind("sample");
  file.set_text_list("labels", {"एक", "two", "with \"quotes\"", ""});
  file.set_integer("answer", -42);
  file.set_number("third", 1.0 / 3.0);
  MatrixD a(2, 3);
  a << 1.0 / 7.0, -0.0, 1e-300, 3, 4, 1e300;
  file.set_matrix("a", a);
  file.set_vector("v", VectorF(VectorF::LinSpaced(5, 0.1F, 0.5F)));
  return file;
}

TEST(ModelFile, ComesBackToTheBit) {
  const Folder folder;
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
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    ModelFile file;
    file.set_kind("sample");
    EXPECT_ANY_THROW({
      file.set_matrix("m", MatrixD::Constant(1, 1, bad));
      (void)ModelFile::parse(file.serialise(), "x").matrix_d("m");
    });
  }
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
