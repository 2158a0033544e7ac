// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/signal/wavelet.hpp"

#include <algorithm>
#include <unordered_map>
#include <utility>

#include "hri/core/error.hpp"

namespace hri {
namespace {

// No synthesis filter: the reverse of the analysis filter, the wavelet is orthogonal.
struct LowPass {
  const char* name;
  std::vector<double> analysis;
  std::vector<double> synthesis;
};

Wavelet with_mirrors(std::string name, std::vector<double> dec_lo, std::vector<double> rec_lo) {
  Wavelet w;
  w.name = std::move(name);
  w.dec_lo = std::move(dec_lo);
  w.rec_lo = std::move(rec_lo);
  w.dec_hi.resize(w.dec_lo.size());
  w.rec_hi.resize(w.rec_lo.size());
  for (std::size_t k = 0; k < w.dec_lo.size(); ++k) {
    const double sign = k % 2 == 0 ? 1 : -1;
    w.dec_hi[k] = -sign * w.rec_lo[k];
    w.rec_hi[k] = sign * w.dec_lo[k];
  }
  return w;
}

std::vector<double> reversed(const std::vector<double>& taps) {
  return {taps.rbegin(), taps.rend()};
}

std::vector<Wavelet> make_wavelets() {
  // clang-format off
  const std::vector<LowPass> table = {
#include "signal/wavelet_daubechies.inc"
#include "signal/wavelet_symlets.inc"
#include "signal/wavelet_coiflets.inc"
#include "signal/wavelet_biorthogonal.inc"
  };
  // clang-format on
  std::vector<Wavelet> result;
  std::vector<Wavelet> exchanged;
  for (const LowPass& low : table) {
    const std::string name = low.name;
    if (low.synthesis.empty()) {
      result.push_back(with_mirrors(name, low.analysis, reversed(low.analysis)));
      continue;
    }
    result.push_back(with_mirrors(name, low.analysis, low.synthesis));
    // bior2.4 to rbio2.4: analysis and synthesis change places.
    exchanged.push_back(
        with_mirrors("rbio" + name.substr(4), reversed(low.synthesis), reversed(low.analysis)));
  }
  for (Wavelet& w : exchanged) result.push_back(std::move(w));
  return result;
}

const std::vector<Wavelet>& all_wavelets() {
  static const std::vector<Wavelet> wavelets = make_wavelets();
  return wavelets;
}

}  // namespace

const Wavelet& wavelet(std::string_view name) {
  static const std::unordered_map<std::string_view, const Wavelet*> by_name = [] {
    std::unordered_map<std::string_view, const Wavelet*> result;
    for (const Wavelet& w : all_wavelets()) result.emplace(w.name, &w);
    return result;
  }();
  if (const auto found = by_name.find(name); found != by_name.end()) return *found->second;
  std::string known;
  for (const Wavelet& w : all_wavelets()) known += (known.empty() ? "" : ", ") + w.name;
  fail(ErrorKind::invalid_argument,
       "unknown wavelet '" + std::string(name) + "'; there are: " + known);
}

bool WaveletName::holds(std::string_view name) const {
  const std::vector<std::string> names = wavelet_names();
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::vector<std::string> wavelet_names() {
  std::vector<std::string> names;
  for (const Wavelet& w : all_wavelets()) names.push_back(w.name);
  return names;
}

}  // namespace hri
