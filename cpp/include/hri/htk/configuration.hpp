// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// HTK's configuration files, as far as they say how parameters are computed and written (HTK Book,
// section 4.3 and chapter 5).
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/htk/feature_extractor.hpp"

namespace hri::htk {

enum class SourceFormat : std::uint8_t { htk, wav };
constexpr auto enum_names(SourceFormat) { return std::array{"HTK", "WAV"}; }

/// Defaults are HTK's.
struct HRI_API Configuration {
  ParameterKind target;  ///< TARGETKIND; ANON: that of the source
  SourceFormat source_format = SourceFormat::htk;
  bool has_target_rate = false;  ///< else features.frame_shift_ms is no one's choice
  bool save_compressed = false;
  bool save_with_checksum = true;
  /// _V of TARGETKIND, which `target` has not: frames become codewords of the table for models that
  /// are discrete, and in files where `save_codewords` says so.
  bool has_codewords = false;
  bool save_codewords = false;  ///< SAVEASVQ
  std::string vq_table;         ///< VQTABLE, a path
  /// Of live sound, direct audio input, whose settings follow; without it they set nothing, or are
  /// refused where they would change results. Set it before anything is read.
  bool live = false;
  int source_rate_hz = 0;     ///< SOURCERATE, of the recordings of the models; 0: not set
  int silence_frames = 0;     ///< SILSEQCOUNT, that end an utterance; 0: not set
  std::string record_prefix;  ///< RECOUTPREFIX, of the names of utterances
  std::string record_suffix;  ///< RECOUTSUFFIX
  HtkFeatureOptions features;
  std::vector<std::string> ignored;  ///< keys that are read by other tools only, or by none
  std::vector<std::pair<std::string, std::string>> settings;  ///< keys and values, as they came

  /// Sets what a file sets: lines of KEY = VALUE, or MODULE: KEY = VALUE, and comments behind #.
  /// Throws IoError; FormatError naming file and line for lines of another form, values out of
  /// range, and settings that would change parameters, labels or results and that there are not
  /// here.
  void read(const std::string& path);
  /// The same from memory; `name` stands for the path in messages.
  void parse(const std::string& text, const std::string& name);

  /// The kind of files to write: the target, or `source` where it is ANON (ANON_D: with these
  /// qualifiers), with _C and _K as
  /// set and without _N.
  [[nodiscard]] ParameterKind written_kind(ParameterKind source) const;
};

}  // namespace hri::htk
