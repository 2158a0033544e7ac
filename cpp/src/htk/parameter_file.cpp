// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Parameter files are written here, and read in parameter_reader.cpp.
#include "hri/htk/parameter_file.hpp"

#include <cmath>
#include <cstring>

#include "hri/core/error.hpp"
#include "hri/io/file.hpp"
#include "htk/parameter_layout.hpp"

namespace hri::htk {
namespace {

using detail::Checksum;
using detail::is_of_integers;
using detail::kExtraSamples;
using detail::kLargestInteger;

constexpr std::size_t kBytesAtOnce = std::size_t{1} << 16U;  // that go to the disk

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
    write_to(nullptr);
    return std::move(bytes_);
  }

  // To a file as the bytes come, so that they need no memory of the size of the file.
  void write_to(AtomicFile* out) {
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
      if (out != nullptr && bytes_.size() >= kBytesAtOnce) flush(out);
    }
    if (kind_.has(kChecksum)) word(sum_.value());
    if (out != nullptr) flush(out);
  }

 private:
  void flush(AtomicFile* out) {
    out->write(bytes_);
    bytes_.clear();
  }

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
    return static_cast<double>(kind_.base == BaseKind::irefc ? value * kLargestInteger : value);
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

std::vector<std::uint8_t> ParameterFile::serialise() const { return Writer(*this).write(); }

void ParameterFile::write(const std::string& path) const {
  Writer writer(*this);
  AtomicFile out(path);
  writer.write_to(&out);
  out.commit();
}

int ParameterFile::num_static() const {
  return static_cast<int>(values.cols()) / kind.num_blocks();
}

}  // namespace hri::htk
