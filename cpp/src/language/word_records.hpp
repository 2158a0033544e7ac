// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// The words of all hypotheses of a decoder, as a tree of records that grows at its leaves: what no
// hypothesis refers to any more is reused, what all of them share is decided.
#pragma once

#include <cstdint>
#include <vector>

#include "hri/language/connected_decoder.hpp"

namespace hri::detail {

/// What a hypothesis is: its score and its last word.
struct Token {
  double score = -std::numeric_limits<double>::infinity();
  std::int32_t record = 0;

  [[nodiscard]] bool alive() const { return score > -std::numeric_limits<double>::infinity(); }
};

class WordRecords {
 public:
  explicit WordRecords(int capacity);

  /// Forgets everything; root() is the beginning of the input.
  void reset();
  /// The record of the last decided word, on which all tokens build.
  [[nodiscard]] std::int32_t root() const { return root_; }
  [[nodiscard]] int num_free() const { return static_cast<int>(free_.size()); }
  [[nodiscard]] int num_used() const { return static_cast<int>(records_.size() - free_.size()); }
  void grow();

  /// A word behind another; num_free() must not be 0.
  std::int32_t add(std::int32_t previous, int model, std::int64_t end_frame, double score);
  [[nodiscard]] std::int64_t end_frame(std::int32_t record) const { return at(record).end_frame; }
  [[nodiscard]] double score(std::int32_t record) const { return at(record).score; }

  /// Decides what all living tokens share and frees what none of them needs. Called between marks:
  /// begin_marking(), mark() of every living token, end_marking().
  void begin_marking();
  void mark(std::int32_t record);
  void end_marking();

  /// The first word behind root() of a token, root() itself where it has none.
  [[nodiscard]] std::int32_t first_open(std::int32_t record) const;

  /// Appends the words of a token, those decided and not taken first.
  void words_of(std::int32_t record, std::vector<DecodedWord>* words) const;
  [[nodiscard]] const std::vector<DecodedWord>& decided() const { return decided_; }
  std::vector<DecodedWord>& decided() { return decided_; }

 private:
  struct Record {
    std::int32_t previous = 0;
    int model = 0;
    std::int64_t end_frame = 0;
    double score = 0;
    // Of the marking under way.
    bool is_marked = false;
    bool is_end = false;             // of a token
    std::int32_t num_followers = 0;  // marked records behind it
    std::int32_t follower = -1;      // the last of these
  };
  [[nodiscard]] const Record& at(std::int32_t record) const {
    return records_[static_cast<std::size_t>(record)];
  }
  Record& at(std::int32_t record) { return records_[static_cast<std::size_t>(record)]; }
  [[nodiscard]] DecodedWord word_of(std::int32_t record) const;

  std::vector<Record> records_;
  std::vector<std::int32_t> free_;
  std::int32_t root_ = 0;
  std::vector<DecodedWord> decided_;
};

}  // namespace hri::detail
