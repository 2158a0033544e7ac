// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/signal/resample.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numeric>

#include "core/numbers.hpp"
#include "hri/core/error.hpp"
#include "hri/core/kernels.hpp"
#include "signal/resample_kernel.hpp"

namespace hri {
namespace {

using detail::kPi;
constexpr double kKaiserBeta = 7.0;  // about 70 dB of stop band
constexpr int kZeroCrossings = 32;   // on each side, at the lower rate
constexpr double kPassBand = 0.95;   // cut-off as a share of the lower Nyquist rate

// Modified Bessel function of the first kind, order 0, by its power series.
double bessel_i0(double x) {
  double sum = 1;
  double term = 1;
  for (int k = 1; term > 1e-16 * sum; ++k) {
    term *= (x / (2.0 * k)) * (x / (2.0 * k));
    sum += term;
  }
  return sum;
}

double kernel(double t, double half_width, double cutoff) {
  if (std::abs(t) >= half_width) return 0;
  const double r = t / half_width;
  const double x = kPi * cutoff * t;
  const double sinc = std::abs(x) < 1e-9 ? 1.0 : std::sin(x) / x;
  static const double scale = 1.0 / bessel_i0(kKaiserBeta);
  return cutoff * sinc * scale * bessel_i0(kKaiserBeta * std::sqrt(1 - r * r));
}

// The weights that bring one sample rate to another: output n lies at n * down / up input samples,
// so only `up` different phases occur, with one row of weights each. Rows are padded by zeros.
struct Phases {
  int from_hz = 0, to_hz = 0;
  std::int64_t up = 0, down = 0, reach = 0, taps = 0, stride = 0;
  std::vector<float> weights;
};

Phases make_phases(int from_hz, int to_hz) {
  Phases p;
  p.from_hz = from_hz;
  p.to_hz = to_hz;
  const std::int64_t common = std::gcd(from_hz, to_hz);
  p.up = to_hz / common;
  p.down = from_hz / common;
  // Time is counted in input samples; the cut-off falls with the output rate when that is the lower
  // one.
  const double cutoff =
      kPassBand * std::min(1.0, static_cast<double>(p.up) / static_cast<double>(p.down));
  const double half_width = kZeroCrossings / cutoff;
  p.reach = static_cast<std::int64_t>(half_width);
  p.taps = 2 * p.reach + 2;
  p.stride = p.taps - p.taps % detail::kDotLanes + detail::kDotLanes;
  p.weights.resize(static_cast<std::size_t>(p.up * p.stride));
  for (std::int64_t phase = 0; phase < p.up; ++phase) {
    const double fraction = static_cast<double>(phase) / static_cast<double>(p.up);
    for (std::int64_t k = 0; k < p.taps; ++k) {
      p.weights[static_cast<std::size_t>(phase * p.stride + k)] = static_cast<float>(
          kernel(static_cast<double>(k - p.reach) - fraction, half_width, cutoff));
    }
  }
  return p;
}

// A microphone has one rate: computing its weights takes longer than applying them to a word, so
// each thread keeps those it used last, unless they are large (rates with no common divisor to
// speak of).
std::shared_ptr<const Phases> phases_of(int from_hz, int to_hz) {
  constexpr std::size_t kKept = std::size_t{1} << 18;  // weights: a megabyte
  thread_local std::shared_ptr<const Phases> kept;
  if (kept && kept->from_hz == from_hz && kept->to_hz == to_hz) return kept;
  auto phases = std::make_shared<const Phases>(make_phases(from_hz, to_hz));
  if (phases->weights.size() <= kKept) kept = phases;
  return phases;
}

// Outputs before the first one at or behind an input sample.
std::int64_t outputs_before(const Phases& phases, std::int64_t sample) {
  return sample <= 0 ? 0 : (sample * phases.up + phases.down - 1) / phases.down;
}

// Outputs begin .. end; samples that lie beyond the signal count as zeros.
void filter_edge(const Phases& phases, Span<const float> samples, std::int64_t begin,
                 std::int64_t end, float* out) {
  const auto num_in = static_cast<std::int64_t>(samples.size());
  for (std::int64_t n = begin; n < end; ++n) {
    const std::int64_t position = n * phases.down;
    const std::int64_t first = position / phases.up - phases.reach;
    const float* row = phases.weights.data() + (position % phases.up) * phases.stride;
    const std::int64_t skipped = std::max<std::int64_t>(0, -first);
    const std::int64_t count = std::min(phases.taps, num_in - first) - skipped;
    if (count <= 0) continue;
    out[n] = dot(row + skipped, samples.data() + first + skipped, static_cast<int>(count));
  }
}

// Outputs from `begin`, which reads no sample before the first, as far as they and the kernel read
// none behind the last; returns how many.
std::int64_t filter_inside(const Phases& phases, Span<const float> samples, std::int64_t begin,
                           std::int64_t num_out, float* out) {
  const detail::ResampleKernel& kernel = detail::resample_kernel();
  const auto num_in = static_cast<std::int64_t>(samples.size());
  const std::int64_t end =
      std::min(num_out, outputs_before(phases, num_in - phases.stride + phases.reach + 1));
  const std::int64_t count = std::max<std::int64_t>(0, end - begin);
  const std::int64_t whole = count - count % kernel.num_lanes;
  if (whole == 0) return 0;
  detail::PhaseTable table;
  table.weights = phases.weights.data();
  table.taps = phases.taps;
  table.stride = phases.stride;
  table.num_phases = phases.up;
  table.phase_step = phases.down % phases.up;
  table.sample_step = phases.down / phases.up;
  const std::int64_t position = begin * phases.down;
  kernel.filter(table, samples.data() + position / phases.up - phases.reach, position % phases.up,
                whole, out + begin);
  return whole;
}

}  // namespace

std::vector<float> resample(Span<const float> samples, int from_hz, int to_hz) {
  if (from_hz < 1000 || from_hz > 384000 || to_hz < 1000 || to_hz > 384000) {
    fail(ErrorKind::invalid_argument, "sample rates must lie in 1000..384000 Hz, got " +
                                          std::to_string(from_hz) + " and " +
                                          std::to_string(to_hz));
  }
  if (from_hz == to_hz) return {samples.begin(), samples.end()};
  const std::shared_ptr<const Phases> phases = phases_of(from_hz, to_hz);
  const auto num_in = static_cast<std::int64_t>(samples.size());
  const std::int64_t num_out = (num_in * phases->up + phases->down - 1) / phases->down;
  std::vector<float> out(static_cast<std::size_t>(num_out));
  const std::int64_t inside = std::min(num_out, outputs_before(*phases, phases->reach));
  const std::int64_t done = inside + filter_inside(*phases, samples, inside, num_out, out.data());
  filter_edge(*phases, samples, 0, inside, out.data());
  filter_edge(*phases, samples, done, num_out, out.data());
  return out;
}

}  // namespace hri
