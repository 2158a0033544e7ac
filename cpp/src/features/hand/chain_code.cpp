// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/features/hand/chain_code.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "hri/core/error.hpp"

namespace hri {
namespace {

constexpr float kDiagonal = 1.41421356F;

float length_of(std::uint8_t direction) { return direction % 2 == 0 ? 1.0F : kDiagonal; }

}  // namespace

void chain_code(Span<const ContourPoint> contour, std::vector<std::uint8_t>* code) {
  code->clear();
  if (contour.size() < 2) return;
  // By (dy + 1, dx + 1).
  constexpr std::uint8_t kNone = 8;
  constexpr std::uint8_t kDirections[3][3] = {{3, 2, 1}, {4, kNone, 0}, {5, 6, 7}};
  for (std::size_t i = 0; i < contour.size(); ++i) {
    const ContourPoint& a = contour[i];
    const ContourPoint& b = contour[i + 1 == contour.size() ? 0 : i + 1];
    const int dx = b.x_px - a.x_px;
    const int dy = b.y_px - a.y_px;
    const bool near = dx >= -1 && dx <= 1 && dy >= -1 && dy <= 1 && (dx != 0 || dy != 0);
    if (!near) {
      fail(ErrorKind::invalid_argument,
           "contour: points " + std::to_string(i) + " and the next are not neighbours");
    }
    code->push_back(kDirections[dy + 1][dx + 1]);
  }
}

void turn_code(Span<const std::uint8_t> code, std::vector<std::uint8_t>* turns) {
  turns->resize(code.size());
  for (std::size_t i = 0; i < code.size(); ++i) {
    const std::uint8_t next = code[i + 1 == code.size() ? 0 : i + 1];
    (*turns)[i] = static_cast<std::uint8_t>((next + 8 - code[i]) % 8);
  }
}

std::size_t least_start(Span<const std::uint8_t> code) {
  // Two candidates race; the one that loses skips past what it was compared on.
  const std::size_t count = code.size();
  std::size_t a = 0;
  std::size_t b = 1;
  std::size_t same = 0;
  while (a < count && b < count && same < count) {
    const std::uint8_t from_a = code[(a + same) % count];
    const std::uint8_t from_b = code[(b + same) % count];
    if (from_a == from_b) {
      ++same;
      continue;
    }
    (from_a > from_b ? a : b) += same + 1;
    if (a == b) ++b;
    same = 0;
  }
  return std::min(a, b);
}

std::vector<std::uint8_t> shape_number(Span<const ContourPoint> contour) {
  std::vector<std::uint8_t> code;
  std::vector<std::uint8_t> turns;
  chain_code(contour, &code);
  turn_code(code, &turns);
  const auto start = static_cast<std::ptrdiff_t>(least_start(turns));
  if (!turns.empty()) std::rotate(turns.begin(), turns.begin() + start, turns.end());
  return turns;
}

ChainCodeComputer::ChainCodeComputer(const ChainCodeOptions& options)
    : options_(validated(options)) {}

void ChainCodeComputer::compute(Span<const ContourPoint> contour, Span<float> out) const {
  require(!contour.empty(), "contour is empty");
  require(out.size() == static_cast<std::size_t>(num_features()),
          "out must have num_features() values");
  thread_local std::vector<std::uint8_t> code;
  thread_local std::vector<std::uint8_t> turns;
  chain_code(contour, &code);
  if (options_.use_turns) turn_code(code, &turns);
  std::fill(out.begin(), out.end(), 0.0F);
  float length = 0;
  for (const std::uint8_t c : code) length += length_of(c);
  if (code.empty()) return;
  const float part_length = length / static_cast<float>(options_.num_parts);
  float along = 0;
  for (std::size_t i = 0; i < code.size(); ++i) {
    // A step counts where its middle lies.
    const float step = length_of(code[i]);
    const auto part =
        std::min(static_cast<int>((along + step / 2) / part_length), options_.num_parts - 1);
    const std::uint8_t bin = options_.use_turns ? turns[i] : code[i];
    out[8 * static_cast<std::size_t>(part) + bin] += step;
    along += step;
  }
  for (std::size_t part = 0; part < out.size(); part += 8) {
    float sum = 0;
    for (std::size_t i = part; i < part + 8; ++i) sum += out[i];
    if (!(sum > 0)) continue;
    for (std::size_t i = part; i < part + 8; ++i) out[i] /= sum;
  }
}

void ChainCodeComputer::compute(ImageView mask, Span<float> out) const {
  thread_local std::vector<ContourPoint> contour;
  trace_contour(mask, &contour);
  require(!contour.empty(), "mask is empty");
  compute(Span<const ContourPoint>(contour), out);
}

}  // namespace hri
