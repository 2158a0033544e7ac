// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// What training saw on samples held out: how often a recogniser is right, what its threshold
// rejects and accepts, and which of its classes it confuses. Whole people are held out where every
// class is left without them, else single recordings: then the rates are too good for other people.
#pragma once

#include <string>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/types.hpp"
#include "hri/io/model_file.hpp"
#include "hri/recognition/calibration.hpp"

namespace hri {

/// Two classes that are confused with one another.
struct ConfusedPair {
  int first = 0;  ///< class numbers, first < second
  int second = 0;
  double rate = 0;  ///< share of the samples decided for either of the two that are the other
};

struct HRI_API HeldOutReport {
  /// Pairs below are not named by confused_pairs().
  static constexpr double kMinConfusionRate = 0.1;
  static constexpr int kMinConfusions = 2;

  std::vector<std::string> labels;  ///< of the classes, as they were in training
  /// [true class][best class]: how many samples, whether rejected or not. Empty where nothing could
  /// be held out.
  MatrixF confusion;
  double false_reject_rate = 0;  ///< share of right decisions below the threshold; 0 without any
  /// How many samples were decided upon as if their class were not in the vocabulary. None where no
  /// class could be left out, as of two: then nothing is known of what the threshold accepts.
  int num_others = 0;
  double false_accept_rate = 0;  ///< share of these that are not below the threshold; 0 without any

  /// What came of `decisions` on samples held out, by classes of the names `labels`, and of those
  /// whose scores are `others`: samples whose class was treated as unknown. Empty without
  /// decisions.
  static HeldOutReport from_decisions(std::vector<std::string> labels,
                                      const std::vector<HeldOut>& decisions,
                                      const std::vector<float>& others,
                                      const Calibration& calibration);

  [[nodiscard]] bool empty() const { return confusion.size() == 0; }
  [[nodiscard]] int num_samples() const { return static_cast<int>(confusion.sum()); }
  /// Share of samples whose best class is the true one; 0 if empty.
  [[nodiscard]] double accuracy() const;
  /// In falling order of their rate.
  [[nodiscard]] std::vector<ConfusedPair> confused_pairs() const;

  /// Without the counts of a label, if it has any; the rates stay.
  [[nodiscard]] HeldOutReport without(const std::string& label) const;

  /// Writes nothing if empty.
  void write(ModelFile& file) const;
  /// Throws FormatError for what no training writes; empty where the file has none.
  static HeldOutReport read(const ModelFile& file);
};

}  // namespace hri
