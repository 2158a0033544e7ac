// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Model files that were changed on purpose: every kind of wrong header is refused by name.

#include <sys/resource.h>

#include "hri/core/error.hpp"
#include "hri/core/random.hpp"
#include "hri/io/model_file.hpp"
#include "io/io_testing.hpp"

namespace hri {
namespace {

using io_testing::message_of;
using Bytes = std::vector<std::uint8_t>;

// Two tensors of 16 bytes: "a" doubles 1 x 2, "b" floats 2 x 2.
ModelFile small() {
  ModelFile file;
  file.set_kind("sample");
  MatrixD a(1, 2);
  a << 1, 2;
  file.set_matrix("a", a);
  MatrixF b(2, 2);
  b << 3, 4, 5, 6;
  file.set_matrix("b", b);
  return file;
}

Bytes packed(const std::string& header, const Bytes& data) {
  Bytes bytes;
  for (unsigned i = 0; i < 8; ++i)
    bytes.push_back(static_cast<std::uint8_t>(std::uint64_t{header.size()} >> (8 * i)));
  bytes.insert(bytes.end(), header.begin(), header.end());
  bytes.insert(bytes.end(), data.begin(), data.end());
  return bytes;
}

std::string header_of(const Bytes& bytes) {
  std::size_t size = 0;
  for (unsigned i = 0; i < 8; ++i) size |= static_cast<std::size_t>(bytes[i]) << (8 * i);
  return {bytes.begin() + 8, bytes.begin() + 8 + static_cast<std::ptrdiff_t>(size)};
}

Bytes data_of(const Bytes& bytes) {
  return {bytes.begin() + 8 + static_cast<std::ptrdiff_t>(header_of(bytes).size()), bytes.end()};
}

// small() with `from` in its header replaced by `to`.
Bytes with(const std::string& from, const std::string& to) {
  const Bytes bytes = small().serialise();
  std::string header = header_of(bytes);
  const std::size_t at = header.find(from);
  EXPECT_NE(at, std::string::npos) << from << " is not in " << header;
  if (at != std::string::npos) header.replace(at, from.size(), to);
  return packed(header, data_of(bytes));
}

// The same with the checksum that its content has, which the refusal names: a file made by someone
// who knows the format.
Bytes forged(const std::string& header, const Bytes& data) {
  const std::string message =
      message_of<FormatError>([&] { ModelFile::parse(packed(header, data), "x"); });
  const std::string mark = "content gives ";
  const std::size_t named = message.find(mark);
  if (named == std::string::npos) return packed(header, data);
  std::string right = header;
  right.replace(right.find("checksum\":\"") + 11, 8, message.substr(named + mark.size(), 8));
  return packed(right, data);
}

TEST(ModelFileDamage, IsNamedWithFileAndField) {
  struct Case {
    const char* from;
    const char* to;
    const char* named;
  };
  const Case cases[] = {
      {R"("format_version":"2")", R"("format_version":"3")", "format version 3"},
      {R"("format_version":"2")", R"("format_version":"0")", "format version 0"},
      {R"("format_version":"2")", R"("format_version":"x")", "format_version"},
      {R"("format_version":"2")", R"("format_version":1)", "format_version"},
      {R"("format_version":"2",)", "", "format_version"},
      {R"("kind":"sample")", R"("kind":"simple")", "checksum"},
      {"__metadata__", "__metadatA__", "'__metadatA__' needs"},
      {R"("__metadata__":{)", R"("__metadata__":"","x":{)", "'__metadata__' is missing"},
      {"checksum", "checksun", "checksum"},
      {R"("dtype":"F64")", R"("dtype":"I64")", "'a': dtype"},
      {R"("dtype":"F64")", R"("dtype":64)", "'a': dtype"},
      {R"("dtype":"F64")", R"("dtypo":"F64")", "'a' needs dtype"},
      {R"("dtype":"F64")", R"("dtype":"F64","more":1)", "'a' needs"},
      {R"("shape":[1,2])", R"("shape":[2])", "a.shape"},
      {R"("shape":[1,2])", R"("shape":[1,-2])", "a.shape"},
      {R"("shape":[1,2])", R"("shape":[1,2.0])", "a.shape"},
      {R"("shape":[1,2])", R"("shape":[1,3])", "'a'"},
      {R"("shape":[1,2])", R"("shape":[1152921504606846977,2])", "'a'"},
      {R"([0,16])", "[16,0]", "'a'"},
      {R"([0,16])", "[0,1000]", "'a'"},
      {R"([0,16])", R"(["0",16])", "a.data_offsets"},
      {R"([0,16])", "[16,32]", "overlap"},
      {R"([16,32])", "[8,24]", "overlap"},
      {R"("b":{)", R"("a":{)", "'a' stands twice"},
      {R"("kind":)", R"("kind":"other","kind":)", "'kind' stands twice"},
      {R"("b":{)", R"("b":[)", "'b' needs"},
      {R"({"__metadata__")", R"(["__metadata__")", "JSON"},
  };
  for (const Case& c : cases) {
    const std::string message =
        message_of<FormatError>([&] { ModelFile::parse(with(c.from, c.to), "robot.hri"); });
    EXPECT_EQ(message.rfind("robot.hri: ", 0), 0U) << message;
    EXPECT_NE(message.find(c.named), std::string::npos) << c.to << ": " << message;
  }
}

// Read as any JSON, each of these takes 70 bytes of memory and more for every byte of the file.
TEST(ModelFileDamage, BracketsWithoutEndAreRefusedWhereTheyBegin) {
  const std::size_t size = std::size_t{15} << 20U;
  std::string objects;
  while (objects.size() < size) objects += R"({"a":)";
  std::string pairs = "[";
  while (pairs.size() < size) pairs += "[],";
  for (const std::string& text :
       {std::string(size, '['), objects, pairs, R"({"a":)" + std::string(size, '['),
        R"({"a":)" + pairs, R"({"__metadata__":{"a":)" + objects, R"({"a":{"shape":)" + pairs}) {
    rusage before{};
    rusage after{};
    getrusage(RUSAGE_SELF, &before);
    message_of<FormatError>([&] { ModelFile::parse(packed(text, {}), "x"); });
    getrusage(RUSAGE_SELF, &after);
    EXPECT_LT(after.ru_maxrss - before.ru_maxrss, 64 << 10) << text.substr(0, 40);
  }
  ModelFile file = small();
  for (const std::string& text : {std::string(size, '['), pairs, "[\"a\"" + std::string(99, ']'),
                                  std::string("[\"a\",[\"b\"]]"), std::string("\"a\"")}) {
    file.set_text("labels", text);
    EXPECT_NE(message_of<FormatError>([&] { (void)file.text_list("labels"); }).find("'labels'"),
              std::string::npos);
  }
}

TEST(ModelFileDamage, TextIsNoNumberForItsFirstCharacters) {
  ModelFile file = small();
  for (const std::string& text :
       {std::string(1, '\0'), std::string("1\0", 2), std::string(), std::string(" 1"),
        std::string("1 "), std::string("1_0"), std::string("0x1"), std::string("१")}) {
    file.set_text("n", text);
    message_of<FormatError>([&] { (void)file.integer("n"); });
    message_of<FormatError>([&] { (void)file.number("n"); });
  }
}

std::string refusal_of(const Bytes& bytes) {
  return message_of<FormatError>([&] { ModelFile::parse(bytes, "x"); });
}

TEST(ModelFileDamage, ACutFileSaysHowMuchOfItIsThere) {
  const Bytes whole = small().serialise();
  const std::size_t head = 8 + header_of(whole).size();
  for (std::size_t size = 8; size < whole.size(); ++size) {
    const std::size_t needed = size < head ? head : whole.size();
    EXPECT_EQ(refusal_of(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size))),
              "x: is cut: " + std::to_string(size) + " of " + (size < head ? "at least " : "") +
                  std::to_string(needed) + " bytes are there");
  }
  // An end beyond all files is damage, and no cut.
  EXPECT_NE(refusal_of(with("[16,32]", "[18446744073709551599,18446744073709551615]")).find("'b'"),
            std::string::npos);
}

TEST(ModelFileDamage, AnotherFileIsSaidToBeNone) {
  const std::string text = "# The command line\n";
  for (const Bytes& bytes :
       {Bytes(text.begin(), text.end()), Bytes{'R', 'I', 'F', 'F', 36, 0, 0, 0, 'W', 'A', 'V', 'E'},
        Bytes(64, 0), Bytes(64, 255), packed("no object", {}), packed("", {})})
    EXPECT_EQ(refusal_of(bytes).rfind("x: is no model file of hri", 0), 0U) << refusal_of(bytes);
  EXPECT_EQ(refusal_of(Bytes(7, 0)), "x: too short for a model file: 7 bytes");
}

TEST(ModelFileDamage, BytesThatNoTensorOwnsAreRefused) {
  Bytes bytes = small().serialise();
  bytes.push_back(0);
  EXPECT_NE(message_of<FormatError>([&] { ModelFile::parse(bytes, "x"); }).find("1 bytes beyond"),
            std::string::npos);
  const std::string header = header_of(small().serialise());
  Bytes data = data_of(small().serialise());
  data.insert(data.begin() + 16, 8, std::uint8_t{0});
  std::string moved = header;
  moved.replace(moved.find("[16,32]"), 7, "[24,40]");
  EXPECT_NE(
      message_of<FormatError>([&] { ModelFile::parse(packed(moved, data), "x"); }).find("gap"),
      std::string::npos);
}

// The bytes of a tensor say nothing about how they are to be read.
TEST(ModelFileDamage, AnotherShapeOrTypeOfTheSameBytesIsRefused) {
  for (const auto& [from, to] : {std::pair{R"("shape":[2,2])", R"("shape":[4,1])"},
                                 {R"("shape":[2,2])", R"("shape":[1,4])"},
                                 {R"("F64","shape":[1,2])", R"("F32","shape":[2,2])"}}) {
    EXPECT_THROW(ModelFile::parse(with(from, to), "x"), FormatError) << to;
  }
}

TEST(ModelFileDamage, SidesBeyondSixtyThreeBitsAreRefusedEvenIfForged) {
  ModelFile none;
  none.set_kind("sample");
  none.set_matrix("e", MatrixD(0, 2));
  const std::string header = header_of(none.serialise());
  const auto shaped = [&](const char* shape) {
    std::string changed = header;
    return changed.replace(changed.find("[0,2]"), 5, shape);
  };
  EXPECT_EQ(ModelFile::parse(forged(shaped("[0,3]"), {}), "x").matrix_d("e").cols(), 3);
  for (const char* shape : {"[9223372036854775808,2]", "[18446744073709551615,0]", "[0,1073741824]",
                            "[2,9223372036854775808]"}) {
    EXPECT_THROW(ModelFile::parse(forged(shaped(shape), {}), "x"), FormatError) << shape;
  }
}

TEST(ModelFileDamage, WeightsThatAreNotFiniteOrAbsurdAreRefusedEvenIfForged) {
  const std::string header = header_of(small().serialise());
  for (const std::size_t last_byte : {15U, 31U}) {  // of the last value of "a", of "b"
    Bytes data = data_of(small().serialise());
    data[last_byte] = 0x7F;
    data[last_byte - 1] = 0xF8;  // a NaN as double and as float
    const ModelFile file = ModelFile::parse(forged(header, data), "robot.hri");
    const std::string message = last_byte == 15
                                    ? message_of<FormatError>([&] { (void)file.matrix_d("a"); })
                                    : message_of<FormatError>([&] { (void)file.matrix_f("b"); });
    EXPECT_EQ(message.rfind("robot.hri: ", 0), 0U) << message;
    EXPECT_NE(message.find("finite"), std::string::npos) << message;

    data[last_byte] = 0x7E;  // 8e300 and 1e38
    const ModelFile large = ModelFile::parse(forged(header, data), "robot.hri");
    EXPECT_PRED_FORMAT2(::testing::IsSubstring, "holds a value beyond 1e",
                        message_of<FormatError>([&] {
                          last_byte == 15 ? (void)large.matrix_d("a") : (void)large.matrix_f("b");
                        }));
  }
}

TEST(ModelFileDamage, OfAnyBitIsRefusedOrChangesNothing) {
  const ModelFile whole = small();
  const Bytes bytes = whole.serialise();
  int same = 0;
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    for (unsigned change = 1; change < 256; ++change) {
      Bytes broken = bytes;
      broken[at] = static_cast<std::uint8_t>(broken[at] ^ change);
      try {
        // Blanks at the end of the header may change into other blanks, nothing else.
        ASSERT_EQ(ModelFile::parse(broken, "x").serialise(), bytes) << "byte " << at;
        ++same;
      } catch (const FormatError&) {
      }
    }
  }
  EXPECT_LE(same, 7 * 3);
}

TEST(ModelFileDamage, DeepAndLongHeadersEndInAnError) {
  for (const std::size_t depth : {1000U, 1000000U}) {
    const std::string open(depth, '[');
    EXPECT_THROW(ModelFile::parse(packed(open, {}), "x"), FormatError);
    EXPECT_THROW(
        ModelFile::parse(packed("{\"a\":" + open + std::string(depth, ']') + "}", {}), "x"),
        FormatError);
  }
  EXPECT_THROW(ModelFile::parse(packed("", {}), "x"), FormatError);
  EXPECT_THROW(ModelFile::parse(packed("{}", {}), "x"), FormatError);
  EXPECT_THROW(ModelFile::parse(packed("null", {}), "x"), FormatError);
}

// Pieces of headers cut out, doubled and swapped: further from the real thing than single bytes.
TEST(ModelFileDamage, OfWholePiecesThrowsFormatErrorsOnly) {
  const Bytes bytes = small().serialise();
  const std::string header = header_of(bytes);
  const std::vector<std::string> pieces = {
      "{",       "}",     "[",    "]",  ",",  ":",  "\"",    "-1",           "0",   "1e9", "null",
      "\"F64\"", "\\u00", "\xff", "{}", "[]", "32", "\"a\"", "__metadata__", "true"};
  Random random(17);
  int read = 0;
  for (int i = 0; i < 4000; ++i) {
    std::string changed = header;
    for (std::uint64_t k = 0; k <= random.below(3); ++k) {
      const std::size_t at = random.below(changed.size());
      const std::size_t count = random.below(12);
      changed.replace(at, count, pieces[random.below(pieces.size())]);
    }
    try {
      (void)ModelFile::parse(packed(changed, data_of(bytes)), "x");
      ++read;
    } catch (const FormatError&) {
    }
  }
  EXPECT_LT(read, 40);
}

}  // namespace
}  // namespace hri
