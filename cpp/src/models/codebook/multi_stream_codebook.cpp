// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/models/codebook/multi_stream_codebook.hpp"

#include <utility>

#include "hri/core/error.hpp"
#include "hri/models/row_checks.hpp"

namespace hri {
namespace {

constexpr int kMostStreams = 4096;

std::string stream_prefix(const std::string& prefix, std::int64_t stream) {
  return prefix + "stream" + std::to_string(stream) + ".";
}

}  // namespace

MultiStreamCodebook::MultiStreamCodebook(std::vector<Codebook> streams)
    : streams_(std::move(streams)) {
  require(!streams_.empty() && streams_.size() <= kMostStreams,
          "a codebook by streams needs 1..4096 streams");
  for (const Codebook& stream : streams_) dim_ += stream.dim();
}

MultiStreamCodebook MultiStreamCodebook::train_lbg(ConstMatrixRefF rows, Span<const int> widths,
                                                   const CodebookOptions& options,
                                                   std::vector<CodebookReport>* reports) {
  std::int64_t columns = 0;
  for (std::size_t s = 0; s < widths.size(); ++s) {
    if (widths[s] < 1)
      fail(ErrorKind::invalid_argument,
           "widths[" + std::to_string(s) + "] = " + std::to_string(widths[s]) + " is less than 1");
    columns += widths[s];
  }
  if (columns != rows.cols())
    fail(ErrorKind::invalid_argument, "widths add up to " + std::to_string(columns) +
                                          ", the rows have " + std::to_string(rows.cols()) +
                                          " columns");
  // Before the streams are trained, so that the column named is one of the rows.
  validate_finite(rows, "rows");
  if (reports != nullptr) reports->assign(widths.size(), {});
  std::vector<Codebook> streams;
  Eigen::Index first = 0;
  for (std::size_t s = 0; s < widths.size(); ++s) {
    streams.push_back(Codebook::train_lbg(rows.middleCols(first, widths[s]), options,
                                          reports == nullptr ? nullptr : &(*reports)[s]));
    first += widths[s];
  }
  return MultiStreamCodebook(std::move(streams));
}

void MultiStreamCodebook::check(ConstMatrixRefF frames) const {
  require(frames.cols() == dim_, "frames must have dim() columns");
  validate_finite(frames, "frames");
}

void MultiStreamCodebook::quantise(ConstMatrixRefF frames, Span<std::int32_t> out) const {
  check(frames);
  require(out.size() == static_cast<std::size_t>(frames.rows()) * streams_.size(),
          "out must have num_streams() places a frame");
  if (out.empty()) return;  // no frames have no place for a second stream
  Eigen::Index first = 0;
  for (int s = 0; s < num_streams(); ++s) {
    stream(s).quantise(frames.middleCols(first, stream(s).dim()), out.data() + s, num_streams());
    first += stream(s).dim();
  }
}

Matrix<std::int32_t> MultiStreamCodebook::quantise(ConstMatrixRefF frames) const {
  Matrix<std::int32_t> symbols(frames.rows(), num_streams());
  quantise(frames, {symbols.data(), static_cast<std::size_t>(symbols.size())});
  return symbols;
}

double MultiStreamCodebook::distortion(ConstMatrixRefF frames) const {
  check(frames);
  double sum = 0;
  Eigen::Index first = 0;
  for (const Codebook& stream : streams_) {
    sum += stream.distortion(frames.middleCols(first, stream.dim()));
    first += stream.dim();
  }
  return sum;
}

void MultiStreamCodebook::write(ModelFile& file, const std::string& prefix) const {
  file.set_integer(prefix + "num_streams", num_streams());
  for (int s = 0; s < num_streams(); ++s) stream(s).write(file, stream_prefix(prefix, s));
}

MultiStreamCodebook MultiStreamCodebook::read(const ModelFile& file, const std::string& prefix) {
  const std::int64_t num_streams = file.integer(prefix + "num_streams");
  if (num_streams < 1 || num_streams > kMostStreams) {
    fail(ErrorKind::format, file.name() + ": field '" + prefix + "num_streams' is " +
                                std::to_string(num_streams) + ", not in 1..4096");
  }
  const std::string beyond = stream_prefix(prefix, num_streams) + "centroids";
  if (file.has(beyond))
    fail(ErrorKind::format, file.name() + ": field '" + beyond + "' lies beyond num_streams");
  std::vector<Codebook> streams;
  streams.reserve(static_cast<std::size_t>(num_streams));
  for (std::int64_t s = 0; s < num_streams; ++s)
    streams.push_back(Codebook::read(file, stream_prefix(prefix, s)));
  return MultiStreamCodebook(std::move(streams));
}

}  // namespace hri
