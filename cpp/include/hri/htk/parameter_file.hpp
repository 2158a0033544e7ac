// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// HTK's parameter files: a header of 12 bytes, then frames, all big-endian (HTK Book, section
// 5.10.1).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/types.hpp"
#include "hri/htk/parameter_kind.hpp"

namespace hri::htk {

/// What the first 12 bytes of a file say.
struct HRI_API ParameterHeader {
  static constexpr std::size_t kBytes = 12;

  ParameterKind kind;
  std::int32_t sample_period = 0;  ///< in 100 ns
  std::int64_t num_frames = 0;
  int num_columns = 0;

  /// Throws FormatError naming file and byte as ParameterFile::parse() does; of the bytes only the
  /// first 12 are read.
  static ParameterHeader parse(Span<const std::uint8_t> bytes, const std::string& name);
  /// Of a file, of which no more is read. Throws IoError, too, and FormatError also where the file
  /// has another size than the header says.
  static ParameterHeader read(const std::string& path);
};

/// What a file holds. What was read is written again byte for byte, unless _C meets a column whose
/// mean is more than about 100 times its range.
struct HRI_API ParameterFile {
  ParameterKind kind;
  std::int32_t sample_period = 100000;  ///< from frame to frame, in 100 ns
  /// Frames in rows. Of WAVEFORM and DISCRETE whole numbers within 16 bits; of IREFC within -1..1.
  MatrixF values;
  /// Of _C: the file holds scale * value - offset, rounded. Empty: chosen from the ranges of the
  /// columns.
  std::vector<float> scale;
  std::vector<float> offset;

  /// Throws IoError, and FormatError naming file and byte for whatever is no such file: a kind that
  /// there is not, sizes that do not fit the file, a checksum that is wrong, values not finite,
  /// more than 2 GiB of frames. Beside `values` it needs memory of a fixed size.
  static ParameterFile read(const std::string& path);
  /// The same from memory; `name` stands for the path in messages.
  static ParameterFile parse(Span<const std::uint8_t> bytes, const std::string& name);

  /// Frames first .. last - 1 alone, to the bit as read() has them, in memory for these; with _C
  /// scale and offset are those of the file. A checksum is checked only where these are all frames:
  /// it needs every byte of the file. Throws as read() does, for values of these frames alone;
  /// FormatError where the file has fewer frames, InvalidArgument unless 0 <= first < last.
  static ParameterFile read_frames(const std::string& path, std::int64_t first, std::int64_t last);
  static ParameterFile parse_frames(Span<const std::uint8_t> bytes, const std::string& name,
                                    std::int64_t first, std::int64_t last);
  /// Throws as read() does for a header, a size and a checksum that are wrong, of a file of any
  /// size, in memory of a fixed one.
  static void verify(const std::string& path);

  /// The bytes of the file: with _C in `kind` compressed, with _K with a checksum; _N is left out,
  /// as HTK does, since files hold the energy. Throws InvalidArgument for no frame, no column, kind
  /// ANON, columns that the kind cannot have, and values not finite or out of range.
  [[nodiscard]] std::vector<std::uint8_t> serialise() const;
  void write(const std::string& path) const;

  /// Columns of the static coefficients.
  [[nodiscard]] int num_static() const;
};

}  // namespace hri::htk
