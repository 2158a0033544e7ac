// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/codebook/multi_stream_codebook.hpp"

#include <gtest/gtest.h>

#include "hri/core/error.hpp"
#include "models/model_testing.hpp"

namespace hri {
namespace {

using namespace testing_data;

const std::vector<int> kWidths = {5, 2, 4};

CodebookOptions with_size_a_stream(int num_codewords) {
  CodebookOptions options;
  options.num_codewords = num_codewords;
  return options;
}

TEST(MultiStreamCodebook, CodesEachStreamAsItsOwnCodebookDoes) {
  const MatrixF rows = noise(400, 11, 1);
  std::vector<CodebookReport> reports(7);
  const auto book = MultiStreamCodebook::train_lbg(rows, kWidths, with_size_a_stream(16), &reports);
  ASSERT_EQ(book.num_streams(), 3);
  ASSERT_EQ(reports.size(), 3U);
  EXPECT_EQ(book.dim(), 11);
  const MatrixF frames = noise(50, 11, 2);
  const Matrix<std::int32_t> symbols = book.quantise(frames);
  ASSERT_EQ(symbols.rows(), 50);
  ASSERT_EQ(symbols.cols(), 3);
  double distortion = 0;
  int first = 0;
  for (int s = 0; s < 3; ++s) {
    const int width = kWidths[static_cast<std::size_t>(s)];
    CodebookReport report;
    const MatrixF columns = rows.middleCols(first, width);
    const Codebook alone = Codebook::train_lbg(columns, with_size_a_stream(16), &report);
    EXPECT_EQ(book.stream(s).centroids(), alone.centroids());
    EXPECT_EQ(reports[static_cast<std::size_t>(s)].distortions, report.distortions);
    const MatrixF part = frames.middleCols(first, width);
    const std::vector<std::int32_t> expected = alone.quantise(part);
    for (Eigen::Index t = 0; t < 50; ++t)
      EXPECT_EQ(symbols(t, s), expected[static_cast<std::size_t>(t)]);
    distortion += alone.distortion(part);
    first += width;
  }
  EXPECT_EQ(book.distortion(frames), distortion);
}

TEST(MultiStreamCodebook, WithOneStreamIsACodebook) {
  const MatrixF rows = noise(300, 6, 3);
  const auto book =
      MultiStreamCodebook::train_lbg(rows, std::vector<int>{6}, with_size_a_stream(10));
  const Codebook alone = Codebook::train_lbg(rows, with_size_a_stream(10));
  EXPECT_EQ(book.stream(0).centroids(), alone.centroids());
  const Matrix<std::int32_t> symbols = book.quantise(rows);
  EXPECT_EQ(std::vector<std::int32_t>(symbols.data(), symbols.data() + symbols.size()),
            alone.quantise(rows));
  EXPECT_EQ(book.distortion(rows), alone.distortion(rows));
}

TEST(MultiStreamCodebook, TakesCodebooksOfDifferentSizes) {
  const MultiStreamCodebook book({Codebook(noise(7, 2, 4)), Codebook(noise(3, 1, 5))});
  EXPECT_EQ(book.dim(), 3);
  const Matrix<std::int32_t> symbols = book.quantise(noise(90, 3, 6));
  EXPECT_EQ(symbols.col(0).maxCoeff(), 6);
  EXPECT_EQ(symbols.col(1).maxCoeff(), 2);
  EXPECT_EQ(book.quantise(MatrixF(0, 3)).size(), 0);
}

TEST(MultiStreamCodebook, RefusesBadInputByName) {
  MatrixF rows = noise(20, 11, 7);
  const auto train = [&](const std::vector<int>& widths) {
    return message_of<InvalidArgument>(
        [&] { MultiStreamCodebook::train_lbg(rows, widths, with_size_a_stream(4)); });
  };
  EXPECT_EQ(train({5, 5}), "widths add up to 10, the rows have 11 columns");
  EXPECT_EQ(train({5, 5, 2}), "widths add up to 12, the rows have 11 columns");
  EXPECT_EQ(train({12, -1}), "widths[1] = -1 is less than 1");
  EXPECT_EQ(train({11, 0}), "widths[1] = 0 is less than 1");
  EXPECT_EQ(train({}), "widths add up to 0, the rows have 11 columns");
  EXPECT_THROW(MultiStreamCodebook({}), InvalidArgument);
  const auto book = MultiStreamCodebook::train_lbg(rows, kWidths, with_size_a_stream(4));
  EXPECT_THROW(static_cast<void>(book.quantise(noise(3, 10, 8))), InvalidArgument);
  EXPECT_THROW(static_cast<void>(book.distortion(MatrixF(0, 11))), InvalidArgument);
  std::vector<std::int32_t> small(59);
  EXPECT_THROW(book.quantise(rows, {small.data(), small.size()}), InvalidArgument);
  rows(3, 8) = kNan;
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "row 3, column 8", train(kWidths));
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "row 3, column 8",
                      message_of<InvalidArgument>([&] { static_cast<void>(book.quantise(rows)); }));
}

TEST(MultiStreamCodebook, StopsWhenAskedInAnyStream) {
  CodebookOptions options = with_size_a_stream(4);
  int polls = 0;
  int stop_at = 0;
  options.should_stop = [&] { return ++polls == stop_at; };
  const MatrixF rows = noise(60, 11, 9);
  MultiStreamCodebook::train_lbg(rows, kWidths, options);
  stop_at = polls;  // the last poll of the last stream
  polls = 0;
  EXPECT_THROW(MultiStreamCodebook::train_lbg(rows, kWidths, options), Interrupted);
}

TEST(MultiStreamCodebook, IsTheSameAfterLoading) {
  const MatrixF rows = noise(300, 11, 10);
  const auto book = MultiStreamCodebook::train_lbg(rows, kWidths, with_size_a_stream(20));
  ModelFile file;
  book.write(file, "vq.");
  const MultiStreamCodebook loaded = MultiStreamCodebook::read(through_bytes(file), "vq.");
  ASSERT_EQ(loaded.num_streams(), 3);
  for (int s = 0; s < 3; ++s) EXPECT_EQ(loaded.stream(s).centroids(), book.stream(s).centroids());
  EXPECT_EQ(loaded.quantise(rows), book.quantise(rows));
}

TEST(MultiStreamCodebook, RefusesFilesByTheFieldThatIsWrong) {
  const MultiStreamCodebook book({Codebook(noise(7, 2, 11)), Codebook(noise(3, 1, 12))});
  const auto refused = [&](const auto& damage) {
    ModelFile file;
    book.write(file, "vq.");
    damage(file);
    return message_of<FormatError>([&] { MultiStreamCodebook::read(file, "vq."); });
  };
  EXPECT_EQ(refused([](ModelFile&) {}), "nothing thrown");
  for (const int count : {-1, 0, 4097}) {
    EXPECT_PRED_FORMAT2(::testing::IsSubstring, "'vq.num_streams' is " + std::to_string(count),
                        refused([&](ModelFile& f) { f.set_integer("vq.num_streams", count); }));
  }
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "vq.num_streams",
                      refused([](ModelFile& f) { f.set_text("vq.num_streams", "2x"); }));
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "'vq.stream2.centroids'",
                      refused([](ModelFile& f) { f.set_integer("vq.num_streams", 3); }));
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "'vq.stream1.centroids'",
                      refused([](ModelFile& f) { f.set_integer("vq.num_streams", 1); }));
  EXPECT_PRED_FORMAT2(
      ::testing::IsSubstring, "'vq.stream0.centroids' is empty",
      refused([](ModelFile& f) { f.set_matrix("vq.stream0.centroids", MatrixF(0, 2)); }));
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "vq.stream1.centroids", refused([](ModelFile& f) {
                        f.set_matrix("vq.stream1.centroids",
                                     MatrixD(noise(3, 1, 1).cast<double>()));
                      }));
  ModelFile other;
  EXPECT_PRED_FORMAT2(::testing::IsSubstring, "vq.num_streams",
                      message_of<FormatError>([&] { MultiStreamCodebook::read(other, "vq."); }));
}

TEST(MultiStreamCodebook, RefusesEveryFlippedByte) {
  const MultiStreamCodebook book({Codebook(noise(2, 2, 13)), Codebook(noise(1, 1, 14))});
  ModelFile file;
  book.write(file, "vq.");
  const std::vector<std::uint8_t> sound = file.serialise();
  for (std::size_t i = 0; i < sound.size(); ++i) {
    std::vector<std::uint8_t> bytes = sound;
    bytes[i] ^= 0x10U;
    try {
      const auto read = MultiStreamCodebook::read(ModelFile::parse(bytes, "flipped"), "vq.");
      // A flip that is still read can only have hit what carries no meaning.
      ASSERT_EQ(read.num_streams(), 2);
      for (int s = 0; s < 2; ++s)
        EXPECT_EQ(read.stream(s).centroids(), book.stream(s).centroids()) << i;
    } catch (const FormatError&) {
      continue;
    }
  }
}

}  // namespace
}  // namespace hri
