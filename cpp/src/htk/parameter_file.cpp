// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/htk/parameter_file.hpp"

#include <cmath>
#include <cstring>

#include "hri/core/error.hpp"
#include "hri/io/file.hpp"

namespace hri::htk {
namespace {

constexpr std::size_t kHeaderBytes = ParameterHeader::kBytes;
constexpr float kLargest = 32767;  // of the integers of _C and IREFC
constexpr int kExtraSamples = 4;   // that scale and offset of _C count as

bool is_of_integers(ParameterKind kind) {
  return kind.base == BaseKind::waveform || kind.base == BaseKind::discrete ||
         kind.base == BaseKind::irefc;
}

// HTK's checksum of the big-endian 16-bit words behind the header.
class Checksum {
 public:
  void add(std::uint16_t word) { sum_ = (sum_ * 65536 + word) % 36897; }
  [[nodiscard]] std::uint16_t value() const { return static_cast<std::uint16_t>(sum_); }

 private:
  std::uint32_t sum_ = 0;
};

class Reader {
 public:
  Reader(Span<const std::uint8_t> bytes, const std::string& name) : bytes_(bytes), name_(name) {}

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

  ParameterFile read() {
    const ParameterHeader header = read_header();
    if (bytes_.size() != num_bytes_)
      refuse("the header says " + std::to_string(num_bytes_) + " bytes, the file has " +
             std::to_string(bytes_.size()));
    ParameterFile file;
    file.kind = header.kind;
    file.sample_period = header.sample_period;
    file.values.resize(header.num_frames, header.num_columns);
    at_ = kHeaderBytes;
    check_sum(file.kind);
    read_values(&file);
    return file;
  }

 private:
  [[noreturn]] void refuse(const std::string& why) const {
    fail(ErrorKind::format, name_ + ": byte " + std::to_string(at_) + ": " + why);
  }

  std::uint16_t word() {
    const auto value = static_cast<std::uint16_t>(bytes_[at_] << 8U | bytes_[at_ + 1]);
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

  void check_sum(ParameterKind kind) {
    if (!kind.has(kChecksum)) return;
    Checksum sum;
    while (at_ + 2 < bytes_.size()) sum.add(word());
    if (word() != sum.value()) {
      at_ -= 2;
      refuse("the checksum is wrong: the file is damaged");
    }
    at_ = kHeaderBytes;
  }

  void read_values(ParameterFile* file) {
    MatrixF& values = file->values;
    if (file->kind.has(kCompressed)) {
      for (std::vector<float>* row : {&file->scale, &file->offset}) {
        for (Eigen::Index c = 0; c < values.cols(); ++c) row->push_back(number());
      }
      for (const float scale : file->scale) {
        if (!(scale > 0)) refuse("a scale of _C is not above 0");
      }
    }
    for (Eigen::Index t = 0; t < values.rows(); ++t) {
      for (Eigen::Index c = 0; c < values.cols(); ++c) {
        values(t, c) = value(*file, static_cast<std::size_t>(c));
        if (!std::isfinite(values(t, c))) refuse("a value of _C is too large");
      }
    }
  }

  float value(const ParameterFile& file, std::size_t column) {
    const bool compressed = file.kind.has(kCompressed);
    if (!compressed && !is_of_integers(file.kind)) return number();
    const auto integer = static_cast<float>(static_cast<std::int16_t>(word()));
    if (compressed) return (integer + file.offset[column]) / file.scale[column];
    return file.kind.base == BaseKind::irefc ? integer / kLargest : integer;
  }

  Span<const std::uint8_t> bytes_;
  const std::string& name_;
  std::size_t at_ = 0;
  std::uint64_t num_bytes_ = 0;  // of the file, as the header says
};

class Writer {
 public:
  explicit Writer(const ParameterFile& file) : file_(file) {
    kind_ = file.kind;
    kind_.qualifiers = static_cast<std::uint16_t>(kind_.qualifiers & ~kNoEnergy);
    require(kind_.base != BaseKind::anon, "a file needs a parameter kind");
    if (const char* fault = kind_.fault(); fault != nullptr)
      fail(ErrorKind::invalid_argument,
           "the parameter kind '" + kind_.text() + "' " + std::string(fault));
    require(file.sample_period > 0, "sample_period must be above 0");
    require(file.values.rows() >= 1 && file.values.cols() >= 1, "values: there is no frame");
    require(file.values.rows() < 0x7fffffff - kExtraSamples, "values: there are too many frames");
    require(file.values.cols() <= 8191, "values: a frame has at most 8191 columns");
    require(file.values.cols() % kind_.num_blocks() == 0,
            "values: so many columns cannot be of this kind");
    require(kind_.base != BaseKind::waveform || file.values.cols() == 1,
            "values: a waveform has one column");
    require(file.values.allFinite(), "values: one is not finite");
  }

  std::vector<std::uint8_t> write() {
    const bool compressed = kind_.has(kCompressed);
    const bool narrow = compressed || is_of_integers(kind_);
    const auto frames = static_cast<std::uint32_t>(file_.values.rows());
    long_word(frames + (compressed ? kExtraSamples : 0));
    long_word(static_cast<std::uint32_t>(file_.sample_period));
    word(static_cast<std::uint16_t>(file_.values.cols() * (narrow ? 2 : 4)));
    word(kind_.code());
    sum_ = Checksum();
    if (compressed) write_scales();
    for (Eigen::Index t = 0; t < file_.values.rows(); ++t) {
      for (Eigen::Index c = 0; c < file_.values.cols(); ++c) {
        const float value = file_.values(t, c);
        if (!narrow) {
          number(value);
        } else {
          integer(scaled(value, static_cast<std::size_t>(c)));
        }
      }
    }
    if (kind_.has(kChecksum)) word(sum_.value());
    return std::move(bytes_);
  }

 private:
  void word(std::uint16_t value) {
    sum_.add(value);
    bytes_.push_back(static_cast<std::uint8_t>(value >> 8U));
    bytes_.push_back(static_cast<std::uint8_t>(value & 0xffU));
  }
  void long_word(std::uint32_t value) {
    word(static_cast<std::uint16_t>(value >> 16U));
    word(static_cast<std::uint16_t>(value & 0xffffU));
  }
  void number(float value) {
    std::uint32_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    long_word(bits);
  }
  // Half away from zero, as HTK rounds.
  void integer(double value) {
    const double rounded = std::round(value);
    require(rounded >= -32768 && rounded <= 32767, "values: one does not fit 16 bits");
    word(static_cast<std::uint16_t>(static_cast<std::int16_t>(rounded)));
  }

  [[nodiscard]] double scaled(float value, std::size_t column) const {
    if (kind_.has(kCompressed))
      return static_cast<double>(value) * static_cast<double>(scale_[column]) -
             static_cast<double>(offset_[column]);
    return static_cast<double>(kind_.base == BaseKind::irefc ? value * kLargest : value);
  }

  void write_scales() {
    const auto columns = static_cast<std::size_t>(file_.values.cols());
    scale_ = file_.scale;
    offset_ = file_.offset;
    if (scale_.empty() && offset_.empty()) choose_scales();
    require(scale_.size() == columns && offset_.size() == columns,
            "scale and offset must have a value a column");
    for (std::size_t c = 0; c < columns; ++c) {
      require(std::isfinite(scale_[c]) && scale_[c] > 0 && std::isfinite(offset_[c]),
              "a scale must be above 0, and an offset finite");
    }
    for (const float s : scale_) number(s);
    for (const float o : offset_) number(o);
  }

  void choose_scales() {
    for (Eigen::Index c = 0; c < file_.values.cols(); ++c) {
      const auto low = static_cast<double>(file_.values.col(c).minCoeff());
      const auto high = static_cast<double>(file_.values.col(c).maxCoeff());
      const bool constant = !(high > low);
      scale_.push_back(static_cast<float>(constant ? 1 : 2.0 * 32767 / (high - low)));
      offset_.push_back(static_cast<float>(constant ? high : (high + low) * 32767 / (high - low)));
    }
  }

  const ParameterFile& file_;
  ParameterKind kind_;
  Checksum sum_;
  std::vector<float> scale_;
  std::vector<float> offset_;
  std::vector<std::uint8_t> bytes_;
};

}  // namespace

ParameterHeader ParameterHeader::parse(Span<const std::uint8_t> bytes, const std::string& name) {
  return Reader(bytes, name).read_header();
}

ParameterFile ParameterFile::parse(Span<const std::uint8_t> bytes, const std::string& name) {
  return Reader(bytes, name).read();
}

ParameterFile ParameterFile::read(const std::string& path) { return parse(read_file(path), path); }

std::vector<std::uint8_t> ParameterFile::serialise() const { return Writer(*this).write(); }

void ParameterFile::write(const std::string& path) const {
  write_file_atomically(path, serialise());
}

int ParameterFile::num_static() const {
  return static_cast<int>(values.cols()) / kind.num_blocks();
}

}  // namespace hri::htk
