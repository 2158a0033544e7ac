// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// HTK's label files and master label files (HTK Book, chapter 6).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hri/core/export.hpp"

namespace hri::htk {

/// A name with a score, beside a label: another level of the transcription.
struct AuxiliaryLabel {
  std::string name;
  bool has_score = false;
  double score = 0;
};

struct Label {
  static constexpr std::int64_t kNoTime = -1;

  std::string name;
  std::int64_t first = kNoTime;  ///< in 100 ns
  std::int64_t last = kNoTime;   ///< in 100 ns; kNoTime where only `first` is known
  bool has_score = false;
  double score = 0;
  std::vector<AuxiliaryLabel> auxiliary;
  std::int64_t line = 0;  ///< of the file that it was read from, from 1; 0: of none
  std::string text;       ///< that line; it is written again while it says the same
};

/// The labels of one recording; further ones are alternatives.
struct HRI_API Transcription {
  std::vector<std::vector<Label>> alternatives = std::vector<std::vector<Label>>(1);

  [[nodiscard]] const std::vector<Label>& labels() const { return alternatives.front(); }

  /// Reads a label file: lines of [start [end]] name [score] {name [score]}; /// between
  /// alternatives. Throws IoError, and FormatError naming file and line for lines of another form
  /// and times that go back.
  static Transcription read(const std::string& path);
  /// The same from memory; `name` stands for the path in messages.
  static Transcription parse(const std::string& text, const std::string& name);

  /// The text of a label file, which is read as it was: names that could be numbers stand in
  /// quotation marks. Throws InvalidArgument for names and times that no file can hold.
  [[nodiscard]] std::string to_text() const;
  void write(const std::string& path) const;
};

/// Transcriptions by patterns of the names of their label files.
struct HRI_API MasterLabelFile {
  struct Entry {
    std::string pattern;  ///< * stands for any characters, ? for one
    Transcription transcription;
    /// Where label files that the pattern matches are: "pattern" -> "folder"; "": the labels are
    /// here.
    std::string folder;
    /// "pattern" => "folder": folders of the name may stand in it, too.
    bool is_searched = false;
  };
  std::vector<Entry> entries;

  /// Throws as Transcription::read() does.
  static MasterLabelFile read(const std::string& path);
  static MasterLabelFile parse(const std::string& text, const std::string& name);

  /// Throws InvalidArgument as Transcription::to_text() does, and for patterns that no file can
  /// hold.
  [[nodiscard]] std::string to_text() const;
  void write(const std::string& path) const;

  /// The first entry whose pattern matches the name of a label file; nullptr where there is none.
  [[nodiscard]] const Entry* find(const std::string& name) const;
};

/// Whether `name` is as `pattern` has it: * stands for any characters, ? for one.
HRI_API bool matches(const std::string& pattern, const std::string& name);

}  // namespace hri::htk
