// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Parameter files are read here, whole or in part, through a window of bounded size.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "hri/core/error.hpp"
#include "hri/htk/parameter_file.hpp"
#include "htk/parameter_layout.hpp"
#include "io/open_file.hpp"

namespace hri::htk {
namespace {

using detail::Checksum;
using detail::is_of_integers;
using detail::kExtraSamples;
using detail::kLargestInteger;

constexpr std::size_t kHeaderBytes = ParameterHeader::kBytes;
constexpr std::size_t kWindowBytes = std::size_t{1} << 16U;
constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 31U;  // that become values at once

// The bytes of a file, through a window that moves with what is read, or of memory.
class Bytes {
 public:
  explicit Bytes(Span<const std::uint8_t> memory) : window_(memory), size_(memory.size()) {}
  explicit Bytes(const hri::detail::OpenFile& file)
      : file_(&file), buffer_(kWindowBytes), size_(file.size()) {}

  [[nodiscard]] std::uint64_t size() const { return size_; }
  // Two bytes; nullptr: they are not there any more.
  const std::uint8_t* pair_at(std::uint64_t at) {
    if (at < begin_ || at + 2 > begin_ + window_.size()) {
      if (file_ == nullptr) return nullptr;
      window_ = {buffer_.data(), file_->read_at(at, {buffer_.data(), buffer_.size()})};
      begin_ = at;
      if (window_.size() < 2) return nullptr;
    }
    return window_.data() + (at - begin_);
  }

 private:
  const hri::detail::OpenFile* file_ = nullptr;
  std::vector<std::uint8_t> buffer_;
  Span<const std::uint8_t> window_;
  std::uint64_t begin_ = 0;
  std::uint64_t size_;
};

class Reader {
 public:
  template <class Source>
  Reader(const Source& source, const std::string& name) : bytes_(source), name_(name) {}

  ParameterHeader read_header() {
    ParameterHeader header;
    if (bytes_.size() < kHeaderBytes) refuse("the header takes 12 bytes");
    const std::uint32_t count = long_word();
    const std::uint32_t period = long_word();
    const std::uint16_t sample_bytes = word();
    const std::uint16_t code = word();
    at_ = 0;
    if (count == 0 || count > 0x7fffffff) refuse("the number of frames is not above 0");
    at_ = 4;
    if (period == 0 || period > 0x7fffffff) refuse("the sample period is not above 0");
    header.sample_period = static_cast<std::int32_t>(period);
    at_ = 10;
    header.kind = kind_of(code);
    if (header.kind.has(kNoEnergy)) refuse("the parameter kind has _N, which no file has");
    header.num_columns = columns_of(header.kind, sample_bytes);
    at_ = 0;
    const bool compressed = header.kind.has(kCompressed);
    if (compressed && count <= kExtraSamples) refuse("no frame is left beside _C");
    header.num_frames = count - (compressed ? kExtraSamples : 0);
    num_bytes_ = kHeaderBytes + std::uint64_t{count} * sample_bytes +
                 (header.kind.has(kChecksum) ? std::uint64_t{2} : std::uint64_t{0});
    return header;
  }

  // The same of a file that has the size which the header says.
  ParameterHeader read_sized_header() {
    const ParameterHeader header = read_header();
    at_ = 0;
    if (bytes_.size() != num_bytes_)
      refuse("the header says " + std::to_string(num_bytes_) + " bytes, the file has " +
             std::to_string(bytes_.size()));
    return header;
  }

  ParameterFile read() {
    const ParameterHeader header = read_sized_header();
    check_sum(header);
    return read_values(header, 0, header.num_frames);
  }

  ParameterFile read_frames(std::int64_t first, std::int64_t last) {
    const ParameterHeader header = read_sized_header();
    if (last > header.num_frames)
      fail(ErrorKind::format, name_ + ": has " + std::to_string(header.num_frames) +
                                  " frames, none with number " + std::to_string(last - 1));
    if (last - first == header.num_frames) check_sum(header);
    return read_values(header, first, last);
  }

  void verify() { check_sum(read_sized_header()); }

 private:
  [[noreturn]] void refuse(const std::string& why) const {
    fail(ErrorKind::format, name_ + ": byte " + std::to_string(at_) + ": " + why);
  }

  std::uint16_t word() {
    const std::uint8_t* pair = bytes_.pair_at(at_);
    if (pair == nullptr) refuse("the file was cut while it was read");
    const auto value = static_cast<std::uint16_t>(pair[0] << 8U | pair[1]);
    at_ += 2;
    return value;
  }

  std::uint32_t long_word() {
    const std::uint32_t high = word();  // before the other, which an expression need not be
    return high << 16U | word();
  }

  float number() {
    const std::uint32_t bits = long_word();
    float value = 0;
    std::memcpy(&value, &bits, sizeof value);
    if (!std::isfinite(value)) {
      at_ -= 4;
      refuse("a value is not finite");
    }
    return value;
  }

  [[nodiscard]] ParameterKind kind_of(std::uint16_t code) const {
    ParameterKind kind{static_cast<BaseKind>(code & 0x3f),
                       static_cast<std::uint16_t>(code & ~0x3f)};
    if (!is_named(kind.base) || kind.base == BaseKind::anon)
      refuse("the parameter kind " + std::to_string(code) + " is none; is it a big-endian file?");
    if (const char* fault = kind.fault(); fault != nullptr)
      refuse("the parameter kind '" + kind.text() + "' " + fault);
    return kind;
  }

  int columns_of(ParameterKind kind, std::uint16_t sample_bytes) {
    at_ = 8;
    const unsigned width = is_of_integers(kind) || kind.has(kCompressed) ? 2 : 4;
    if (sample_bytes == 0 || sample_bytes % width != 0)
      refuse("a frame of " + kind.text() + " cannot take " + std::to_string(sample_bytes) +
             " bytes");
    const auto columns = static_cast<int>(sample_bytes / width);
    if (kind.base == BaseKind::waveform && columns != 1) refuse("a waveform has 2 bytes a sample");
    if (columns % kind.num_blocks() != 0)
      refuse(std::to_string(columns) + " columns cannot be " + kind.text());
    return columns;
  }

  void check_sum(const ParameterHeader& header) {
    if (!header.kind.has(kChecksum)) return;
    Checksum sum;
    at_ = kHeaderBytes;
    while (at_ + 2 < num_bytes_) sum.add(word());
    if (word() != sum.value()) {
      at_ -= 2;
      refuse("the checksum is wrong: the file is damaged");
    }
  }

  ParameterFile read_values(const ParameterHeader& header, std::int64_t first, std::int64_t last) {
    const bool is_narrow = header.kind.has(kCompressed) || is_of_integers(header.kind);
    const std::uint64_t frame_bytes =
        static_cast<std::uint64_t>(header.num_columns) * (is_narrow ? 2 : 4);
    const std::uint64_t num_bytes = static_cast<std::uint64_t>(last - first) * frame_bytes;
    if (num_bytes > kMostBytes)
      fail(ErrorKind::format, name_ + ": has " + std::to_string(num_bytes) + " bytes in frames " +
                                  std::to_string(first) + " to " + std::to_string(last - 1) +
                                  ", more than the limit of " + std::to_string(kMostBytes));
    ParameterFile file;
    file.kind = header.kind;
    file.sample_period = header.sample_period;
    at_ = kHeaderBytes;
    if (file.kind.has(kCompressed)) read_scales(header.num_columns, &file);
    at_ += static_cast<std::uint64_t>(first) * frame_bytes;
    MatrixF& values = file.values;
    values.resize(last - first, header.num_columns);
    for (Eigen::Index t = 0; t < values.rows(); ++t) {
      for (Eigen::Index c = 0; c < values.cols(); ++c) {
        values(t, c) = value(file, static_cast<std::size_t>(c));
        if (!std::isfinite(values(t, c))) refuse("a value of _C is too large");
      }
    }
    return file;
  }

  void read_scales(int num_columns, ParameterFile* file) {
    for (std::vector<float>* row : {&file->scale, &file->offset}) {
      for (int c = 0; c < num_columns; ++c) row->push_back(number());
    }
    for (const float scale : file->scale) {
      if (!(scale > 0)) refuse("a scale of _C is not above 0");
    }
  }

  float value(const ParameterFile& file, std::size_t column) {
    const bool compressed = file.kind.has(kCompressed);
    if (!compressed && !is_of_integers(file.kind)) return number();
    const auto integer = static_cast<float>(static_cast<std::int16_t>(word()));
    if (compressed) return (integer + file.offset[column]) / file.scale[column];
    return file.kind.base == BaseKind::irefc ? integer / kLargestInteger : integer;
  }

  Bytes bytes_;
  const std::string& name_;
  std::uint64_t at_ = 0;
  std::uint64_t num_bytes_ = 0;  // of the file, as the header says
};

void require_range(std::int64_t first, std::int64_t last) {
  require(first >= 0 && first < last, "frames: the first must be at least 0, and below the last");
}

}  // namespace

ParameterHeader ParameterHeader::parse(Span<const std::uint8_t> bytes, const std::string& name) {
  return Reader(bytes, name).read_header();
}

ParameterHeader ParameterHeader::read(const std::string& path) {
  const hri::detail::OpenFile file(path);
  return Reader(file, path).read_sized_header();
}

ParameterFile ParameterFile::parse(Span<const std::uint8_t> bytes, const std::string& name) {
  return Reader(bytes, name).read();
}

ParameterFile ParameterFile::read(const std::string& path) {
  const hri::detail::OpenFile file(path);
  return Reader(file, path).read();
}

ParameterFile ParameterFile::parse_frames(Span<const std::uint8_t> bytes, const std::string& name,
                                          std::int64_t first, std::int64_t last) {
  require_range(first, last);
  return Reader(bytes, name).read_frames(first, last);
}

ParameterFile ParameterFile::read_frames(const std::string& path, std::int64_t first,
                                         std::int64_t last) {
  require_range(first, last);
  const hri::detail::OpenFile file(path);
  return Reader(file, path).read_frames(first, last);
}

void ParameterFile::verify(const std::string& path) {
  const hri::detail::OpenFile file(path);
  Reader(file, path).verify();
}

}  // namespace hri::htk
