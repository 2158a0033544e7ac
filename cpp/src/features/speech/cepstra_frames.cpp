// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Static cepstra: what CepstraComputer does frame by frame, several frames at a time.
#include <algorithm>
#include <array>
#include <cfloat>

#include "core/numbers.hpp"
#include "features/speech/cepstra_kernels.hpp"
#include "features/speech/cepstra_workspace.hpp"
#include "hri/core/error.hpp"
#include "hri/signal/lanes.hpp"
#include "hri/signal/linear_prediction.hpp"

namespace hri {
namespace {

constexpr std::size_t kMostLanes = 16;
using detail::kDecibelsPerNeper;

}  // namespace

CepstraComputer::Workspace& CepstraComputer::workspace() {
  thread_local Workspace w;
  return w;
}

Eigen::Index CepstraComputer::column_of(int n) const {
  return n == 0 ? c0_column_ : n - (c0_column_ == 0 ? 0 : 1);
}

// The sample before frame `t` and the frame: where they lie in the audio, or in `edge`.
const float* CepstraComputer::frame_at(Span<const float> audio, std::ptrdiff_t t,
                                       Span<float> edge) const {
  const bool centred = options_.padding == FramePadding::centred;
  const std::ptrdiff_t start = t * frame_shift_ - (centred ? frame_length_ / 2 : 0) - 1;
  const auto count = static_cast<std::ptrdiff_t>(audio.size());
  if (start >= 0 && start + frame_length_ < count) return audio.data() + start;
  for (std::ptrdiff_t n = 0; n <= frame_length_; ++n) {
    const std::ptrdiff_t at = start + n;
    const bool outside = at < 0 || at >= count;
    // Without padding only what comes before the first sample is outside: it stands for that
    // itself.
    const float value = outside ? (centred ? 0.0F : audio[0]) : audio[static_cast<std::size_t>(at)];
    edge[static_cast<std::size_t>(n)] = value;
  }
  return edge.data();
}

void CepstraComputer::compute_static(Span<const float> audio, MatrixRefF out) const {
  const auto lanes = static_cast<Eigen::Index>(num_lanes());
  const auto block =
      static_cast<std::size_t>(bank_.num_filters() + 1) * static_cast<std::size_t>(lanes);
  const auto length = static_cast<std::size_t>(frame_length_) + 1;
  Workspace& work = workspace();
  work.edges.resize(kMostLanes * length);
  // Where filters are raised towards the loudest, all log energies come first.
  const bool raise = options_.top_db > 0;
  const auto num_blocks = static_cast<std::size_t>((out.rows() + lanes - 1) / lanes);
  if (raise) work.logs.resize(num_blocks * block);
  std::array<const float*, kMostLanes> frames{};
  for (Eigen::Index first = 0; first < out.rows(); first += lanes) {
    const auto count = static_cast<std::size_t>(std::min(lanes, out.rows() - first));
    for (std::size_t l = 0; l < count; ++l) {
      frames[l] = frame_at(audio, first + static_cast<Eigen::Index>(l),
                           {work.edges.data() + l * length, length});
    }
    const Span<const float* const> now(frames.data(), count);
    if (raise) {
      log_energies(now, work.logs.data() + static_cast<std::size_t>(first / lanes) * block, &work);
    } else {
      compute_frames(now, out.middleRows(first, static_cast<Eigen::Index>(count)));
    }
  }
  if (!raise) return;
  float loudest = -FLT_MAX;
  for (std::size_t b = 0; b < num_blocks; ++b) {
    const float* logs = work.logs.data() + b * block;
    loudest = std::max(loudest, *std::max_element(logs, logs + block - lanes));
  }
  const float lowest = loudest - static_cast<float>(options_.top_db / kDecibelsPerNeper);
  for (Eigen::Index first = 0; first < out.rows(); first += lanes) {
    project(work.logs.data() + static_cast<std::size_t>(first / lanes) * block, lowest,
            out.middleRows(first, std::min(lanes, out.rows() - first)), &work);
  }
}

void CepstraComputer::compute_frames(Span<const float* const> frames, MatrixRefF out) const {
  require(out.rows() == static_cast<Eigen::Index>(frames.size()) && out.cols() == num_static(),
          "out must have shape (frames.size(), num_static)");
  Workspace& work = workspace();
  const auto lanes = static_cast<std::size_t>(num_lanes());
  const auto block = static_cast<std::size_t>(bank_.num_filters() + 1) * lanes;
  for (std::size_t first = 0; first < frames.size(); first += lanes) {
    const std::size_t count = std::min(lanes, frames.size() - first);
    const auto now = frames.subspan(first, count);
    auto rows = out.middleRows(static_cast<Eigen::Index>(first), static_cast<Eigen::Index>(count));
    if (options_.kind == CepstraKind::linear_prediction) {
      predict(now, rows, &work);
      continue;
    }
    if (work.logs.size() < block) work.logs.resize(block);
    log_energies(now, work.logs.data(), &work);
    project(work.logs.data(), -FLT_MAX, rows, &work);
  }
}

// Up to num_lanes() frames, side by side and windowed, to work->frames.
void CepstraComputer::condition(Span<const float* const> frames, float* log_energy,
                                Workspace* work) const {
  const detail::CepstraKernels& kernels = detail::cepstra_kernels();
  const auto lanes = static_cast<std::size_t>(kernels.num_lanes);
  const bool spectrum = options_.kind == CepstraKind::filter_bank;
  detail::FrameTable table;
  table.length = frame_length_;
  table.num_rows = spectrum ? fft_.size() : frame_length_;
  table.window = window_.data();
  table.pre_emphasis = static_cast<float>(options_.pre_emphasis);
  table.begins_anew = options_.frame_pre_emphasis;
  table.remove_dc = options_.remove_dc;
  table.energy_scale = static_cast<float>(options_.sample_scale * options_.sample_scale);
  table.energy_floor = static_cast<float>(options_.energy_floor);
  const auto length = static_cast<std::size_t>(frame_length_) + 1;
  work->samples.resize(length * lanes);
  work->frames.resize(static_cast<std::size_t>(table.num_rows) * lanes);
  // Lanes beyond the last frame repeat it.
  std::array<const float*, kMostLanes> all{};
  for (std::size_t l = 0; l < lanes; ++l) all[l] = frames[std::min(l, frames.size() - 1)];
  interleave({all.data(), lanes}, length, {work->samples.data(), work->samples.size()});
  kernels.condition(table, work->samples.data(), work->frames.data(),
                    options_.use_energy ? log_energy : nullptr);
}

void CepstraComputer::log_energies(Span<const float* const> frames, float* logs,
                                   Workspace* work) const {
  const detail::CepstraKernels& kernels = detail::cepstra_kernels();
  condition(frames, logs + bank_.num_filters() * kernels.num_lanes, work);
  work->power.resize(static_cast<std::size_t>(fft_.num_bins()) *
                     static_cast<std::size_t>(kernels.num_lanes));
  fft_.power_spectra({work->frames.data(), work->frames.size()},
                     {work->power.data(), work->power.size()});
  if (!options_.use_power) kernels.take_roots(fft_.num_bins(), work->power.data());
  kernels.log_energies(bank_.table(), static_cast<float>(options_.energy_floor), work->power.data(),
                       logs);
}

void CepstraComputer::project(const float* logs, float lowest, MatrixRefF out,
                              Workspace* work) const {
  const detail::CepstraKernels& kernels = detail::cepstra_kernels();
  const Eigen::Index lanes = kernels.num_lanes;
  work->cepstra.resize(static_cast<std::size_t>(num_static() * lanes));
  kernels.project(dct_.data(), num_static(), bank_.num_filters(), lowest, logs,
                  work->cepstra.data());
  if (options_.use_energy) {
    const float* energies = logs + bank_.num_filters() * lanes;
    for (Eigen::Index l = 0; l < lanes; ++l)
      work->cepstra[static_cast<std::size_t>(c0_column_ * lanes + l)] =
          static_cast<float>(lifts_[0]) * energies[l];
  }
  for (Eigen::Index l = 0; l < out.rows(); ++l) {
    for (Eigen::Index c = 0; c < num_static(); ++c)
      out(l, c) = work->cepstra[static_cast<std::size_t>(c * lanes + l)];
  }
}

// Linear prediction in double, as voices come close to what cannot be predicted better.
void CepstraComputer::predict(Span<const float* const> frames, MatrixRefF out,
                              Workspace* work) const {
  const auto lanes = static_cast<std::size_t>(num_lanes());
  const auto length = static_cast<std::size_t>(frame_length_);
  const auto order = static_cast<std::size_t>(options_.lpc_order);
  std::array<float, kMostLanes> log_energy{};
  condition(frames, log_energy.data(), work);
  work->frame.resize(length);
  work->numbers.resize(2 * order + 1 + lifts_.size());
  const Span<double> r(work->numbers.data(), order + 1);
  const Span<double> a(r.end(), order);
  const Span<double> c(a.end(), lifts_.size());
  for (std::size_t l = 0; l < frames.size(); ++l) {
    for (std::size_t n = 0; n < length; ++n)
      work->frame[n] = static_cast<double>(work->frames[n * lanes + l]);
    autocorrelation(work->frame, r);
    lpc_cepstrum(a, std::max(levinson_durbin(r, a), options_.energy_floor), c);
    if (options_.use_energy) c[0] = static_cast<double>(log_energy[l]);
    for (std::size_t n = options_.use_c0 ? 0 : 1; n < c.size(); ++n) {
      out(static_cast<Eigen::Index>(l), column_of(static_cast<int>(n))) =
          static_cast<float>(lifts_[n] * c[n]);
    }
  }
}

}  // namespace hri
