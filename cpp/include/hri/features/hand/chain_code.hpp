// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Chain codes of outlines (Freeman, 1961; thesis section 5.1.3): eight directions, 0 to the right,
// 2 up, 4 to the left, 6 down.
#pragma once

#include <cstdint>
#include <vector>

#include "hri/core/export.hpp"
#include "hri/core/image_view.hpp"
#include "hri/core/options.hpp"
#include "hri/core/types.hpp"
#include "hri/features/hand/contour.hpp"

namespace hri {

/// The step from every point of a closed outline to the next. Empty for fewer than two points.
/// Throws InvalidArgument where two points are not neighbours. `code` is written over.
HRI_API void chain_code(Span<const ContourPoint> contour, std::vector<std::uint8_t>* code);

/// Turn from every step to the next, modulo 8 (1 is 45 degrees to the left): it stays the same when
/// the outline is turned by multiples of 90 degrees.
HRI_API void turn_code(Span<const std::uint8_t> code, std::vector<std::uint8_t>* turns);

/// Where a closed code starts so that it is smallest as a number.
HRI_API std::size_t least_start(Span<const std::uint8_t> code);

/// Turns from their least start on, the shape number (Bribiesca and Guzman, 1980): it depends
/// neither on place, start nor turns by 90 degrees.
HRI_API std::vector<std::uint8_t> shape_number(Span<const ContourPoint> contour);

struct ChainCodeOptions {
  int num_parts = 1;
  bool use_turns = false;

  static constexpr const char* kName = "ChainCodeOptions";
  template <class Self, class Visitor>
  static void visit(Self& o, Visitor&& v) {
    v("num_parts", o.num_parts, within(1, 64),
      "parts of equal length with a histogram each; from 2 on the start counts, the first pixel of "
      "the outline in reading order");
    v("use_turns", o.use_turns, any_value, "turns instead of directions");
  }
};

/// Histograms of chain codes. Immutable; const calls are safe from several threads.
class HRI_API ChainCodeComputer {
 public:
  /// Throws InvalidArgument naming the field that is out of range.
  explicit ChainCodeComputer(const ChainCodeOptions& options);

  [[nodiscard]] int num_features() const { return 8 * options_.num_parts; }
  [[nodiscard]] const ChainCodeOptions& options() const { return options_; }

  /// Share of every direction (or turn) in the length of each part, where diagonal steps are
  /// sqrt(2) long; zeros for a single pixel. Throws InvalidArgument for an empty outline or mask.
  void compute(Span<const ContourPoint> contour, Span<float> out) const;
  void compute(ImageView mask, Span<float> out) const;

 private:
  ChainCodeOptions options_;
};

}  // namespace hri
