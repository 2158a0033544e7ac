// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/features/hand/contour.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "hri/core/error.hpp"

namespace hri {
namespace {

// Neighbouring pixels of one row, [left, right), and the region they belong to: another run of it,
// or itself.
struct Run {
  int y = 0;
  int left = 0;
  int right = 0;
  int region = 0;
  std::int64_t num_pixels = 0;  // of the whole region, at its root
};

int root_of(std::vector<Run>& runs, int i) {
  while (runs[static_cast<std::size_t>(i)].region != i) {
    Run& run = runs[static_cast<std::size_t>(i)];
    run.region = runs[static_cast<std::size_t>(run.region)].region;
    i = run.region;
  }
  return i;
}

// The earlier run stays the root, so that a root is the first of its region in reading order.
void join(std::vector<Run>& runs, int a, int b) {
  const int first = root_of(runs, a);
  const int second = root_of(runs, b);
  runs[static_cast<std::size_t>(std::max(first, second))].region = std::min(first, second);
}

// Calls found(left, right) for every run of a row. Hands leave most of a picture empty: eight
// pixels at a time are skipped.
template <class Found>
void runs_of_row(const std::uint8_t* row, int width, const Found& found) {
  int x = 0;
  while (x < width) {
    std::uint64_t eight = 0;
    while (x + 8 <= width && (std::memcpy(&eight, row + x, 8), eight == 0)) x += 8;
    while (x < width && row[x] == 0) ++x;
    if (x == width) return;
    const void* end = std::memchr(row + x, 0, static_cast<std::size_t>(width - x));
    const int right =
        end == nullptr ? width : static_cast<int>(static_cast<const std::uint8_t*>(end) - row);
    found(x, right);
    x = right;
  }
}

template <class Found>
void runs_of_row(const float* row, int width, float threshold, const Found& found) {
  int x = 0;
  while (x < width) {
    while (x < width && !(row[x] > threshold)) ++x;
    if (x == width) return;
    const int left = x;
    while (x < width && row[x] > threshold) ++x;
    found(left, x);
  }
}

// First pixel of the largest region; x_px is -1 where there is none. `scan(y, found)` gives the
// runs of row y.
template <class Scan>
ContourPoint first_of_largest(int height, const Scan& scan) {
  thread_local std::vector<Run> runs;
  runs.clear();
  std::size_t above = 0;  // runs of the row above: [above, row)
  std::size_t row = 0;
  for (int y = 0; y < height; ++y) {
    scan(y, [&](int left, int right) {
      const auto self = static_cast<int>(runs.size());
      runs.push_back({y, left, right, self, 0});
      while (above < row && runs[above].right < left) ++above;
      // The last run above that touches this one may touch the next, too: it is not passed.
      for (std::size_t i = above; i < row && runs[i].left <= right; ++i)
        join(runs, static_cast<int>(i), self);
    });
    above = row;
    row = runs.size();
  }
  ContourPoint best{-1, -1};
  std::int64_t most = 0;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const auto root = static_cast<std::size_t>(root_of(runs, static_cast<int>(i)));
    runs[root].num_pixels += runs[i].right - runs[i].left;
  }
  for (const Run& run : runs) {
    if (run.num_pixels <= most) continue;
    most = run.num_pixels;
    best = {run.left, run.y};
  }
  return best;
}

template <class Inside>
int next_direction(const Inside& inside, ContourPoint at, int direction) {
  // Look around clockwise, beginning behind the left shoulder.
  for (int turn = 6; turn < 14; ++turn) {
    const int candidate = (direction + turn) % 8;
    const ContourPoint& step = detail::kContourSteps[candidate];
    if (inside(at.x_px + step.x_px, at.y_px + step.y_px)) return candidate;
  }
  return -1;  // a single pixel
}

template <class Inside>
void walk(const Inside& inside, ContourPoint start, std::vector<ContourPoint>* contour) {
  contour->clear();
  if (start.x_px < 0) return;
  contour->push_back(start);
  const int first = next_direction(inside, start, 0);  // nothing lies left of or above the start
  if (first < 0) return;
  ContourPoint at = start;
  int direction = first;
  while (true) {
    at = {at.x_px + detail::kContourSteps[direction].x_px,
          at.y_px + detail::kContourSteps[direction].y_px};
    direction = next_direction(inside, at, direction);
    // Where two parts meet at the start, it is passed before the walk is over.
    if (at == start && direction == first) return;
    contour->push_back(at);
  }
}

}  // namespace

void trace_contour(ImageView mask, std::vector<ContourPoint>* contour) {
  require(mask.channels == 1, "mask must have one channel");
  contour->clear();
  if (mask.empty()) return;
  const ContourPoint start = first_of_largest(mask.height_px, [&](int y, const auto& found) {
    runs_of_row(mask.row(y), mask.width_px, found);
  });
  const auto inside = [&](int x, int y) {
    return x >= 0 && y >= 0 && x < mask.width_px && y < mask.height_px && mask.row(y)[x] != 0;
  };
  walk(inside, start, contour);
}

void trace_contour(ConstMatrixRefF image, float threshold, std::vector<ContourPoint>* contour) {
  const auto width = static_cast<int>(image.cols());
  const auto height = static_cast<int>(image.rows());
  const ContourPoint start = first_of_largest(height, [&](int y, const auto& found) {
    runs_of_row(image.data() + y * image.outerStride(), width, threshold, found);
  });
  const auto inside = [&](int x, int y) {
    return x >= 0 && y >= 0 && x < width && y < height && image(y, x) > threshold;
  };
  walk(inside, start, contour);
}

void resample_contour(Span<const ContourPoint> contour, Span<float> x_px, Span<float> y_px) {
  require(!contour.empty(), "contour is empty");
  require(x_px.size() == y_px.size() && !x_px.empty(), "x_px and y_px must have the same room");
  struct Place {
    float x = 0;
    float y = 0;
    float along = 0;  // from the first place
  };
  thread_local std::vector<Place> places;
  const std::size_t count = contour.size();
  places.resize(count + 1);
  constexpr float kSmooth[5] = {1.0F / 16, 4.0F / 16, 6.0F / 16, 4.0F / 16, 1.0F / 16};
  for (std::size_t i = 0; i < count; ++i) {
    Place place;
    for (std::size_t k = 0; k < 5; ++k) {
      const ContourPoint& p = contour[(i + 2 * count + k - 2) % count];
      // From the first point: places far from the corner of a large picture lose no digits.
      place.x += kSmooth[k] * static_cast<float>(p.x_px - contour[0].x_px);
      place.y += kSmooth[k] * static_cast<float>(p.y_px - contour[0].y_px);
    }
    places[i] = place;
  }
  places[count] = places[0];
  for (std::size_t i = 1; i <= count; ++i) {
    places[i].along = places[i - 1].along +
                      std::hypot(places[i].x - places[i - 1].x, places[i].y - places[i - 1].y);
  }
  const float length = places[count].along;
  std::size_t next = 1;
  for (std::size_t i = 0; i < x_px.size(); ++i) {
    const float wanted = length * static_cast<float>(i) / static_cast<float>(x_px.size());
    while (next < count && places[next].along <= wanted) ++next;
    const Place& a = places[next - 1];
    const Place& b = places[next];
    const float gap = b.along - a.along;
    const float share = gap > 0 ? std::clamp((wanted - a.along) / gap, 0.0F, 1.0F) : 0.0F;
    x_px[i] = static_cast<float>(contour[0].x_px) + a.x + share * (b.x - a.x);
    y_px[i] = static_cast<float>(contour[0].y_px) + a.y + share * (b.y - a.y);
  }
}

}  // namespace hri
