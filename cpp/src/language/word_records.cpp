// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "language/word_records.hpp"

#include <algorithm>

namespace hri::detail {
namespace {

constexpr std::size_t kDecidedReserve = 1024;

}  // namespace

WordRecords::WordRecords(int capacity) : records_(static_cast<std::size_t>(capacity) + 1) {
  free_.reserve(records_.size());
  decided_.reserve(kDecidedReserve);
  reset();
}

void WordRecords::reset() {
  records_.front() = {};
  root_ = 0;
  free_.clear();
  for (auto i = static_cast<std::int32_t>(records_.size()) - 1; i > 0; --i) free_.push_back(i);
  decided_.clear();
}

void WordRecords::grow() {
  const auto size = static_cast<std::int32_t>(records_.size());
  records_.resize(2 * records_.size());
  free_.reserve(records_.size());
  for (auto i = static_cast<std::int32_t>(records_.size()) - 1; i >= size; --i) free_.push_back(i);
}

std::int32_t WordRecords::add(std::int32_t previous, int model, std::int64_t end_frame,
                              double score) {
  const std::int32_t record = free_.back();
  free_.pop_back();
  at(record) = {previous, model, end_frame, score};
  return record;
}

void WordRecords::begin_marking() {
  for (Record& record : records_) {
    record.is_marked = false;
    record.is_end = false;
    record.num_followers = 0;
    record.follower = -1;
  }
  at(root_).is_marked = true;
}

void WordRecords::mark(std::int32_t record) {
  at(record).is_end = true;
  while (!at(record).is_marked) {
    at(record).is_marked = true;
    Record& before = at(at(record).previous);
    ++before.num_followers;
    before.follower = record;
    record = at(record).previous;
  }
}

void WordRecords::end_marking() {
  while (!at(root_).is_end && at(root_).num_followers == 1) {
    at(root_).is_marked = false;
    root_ = at(root_).follower;
    decided_.push_back(word_of(root_));
  }
  free_.clear();
  for (auto i = static_cast<std::int32_t>(records_.size()) - 1; i >= 0; --i) {
    if (!at(i).is_marked) free_.push_back(i);
  }
}

std::int32_t WordRecords::first_open(std::int32_t record) const {
  std::int32_t first = record;
  while (first != root_ && at(first).previous != root_) first = at(first).previous;
  return first;
}

DecodedWord WordRecords::word_of(std::int32_t record) const {
  const Record& word = at(record);
  const Record& before = at(word.previous);
  return {word.model, before.end_frame, word.end_frame, word.score - before.score};
}

void WordRecords::words_of(std::int32_t record, std::vector<DecodedWord>* words) const {
  words->insert(words->end(), decided_.begin(), decided_.end());
  const auto first = static_cast<std::ptrdiff_t>(words->size());
  for (; record != root_; record = at(record).previous) words->push_back(word_of(record));
  std::reverse(words->begin() + first, words->end());
}

}  // namespace hri::detail
