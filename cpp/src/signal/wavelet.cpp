// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/signal/wavelet.hpp"

#include "hri/core/error.hpp"

namespace hri {
namespace {

struct LowPass {
  const char* name;
  std::vector<double> taps;
};

Wavelet with_mirrors(const LowPass& low) {
  Wavelet w{low.name, low.taps, low.taps, {low.taps.rbegin(), low.taps.rend()}, low.taps};
  const std::size_t n = low.taps.size();
  for (std::size_t k = 0; k < n; ++k) {
    w.dec_hi[k] = (k % 2 == 0 ? -1.0 : 1.0) * w.rec_lo[k];
    w.rec_hi[n - 1 - k] = w.dec_hi[k];
  }
  return w;
}

const std::vector<Wavelet>& all_wavelets() {
  static const std::vector<Wavelet> wavelets = [] {
    const std::vector<LowPass> table = {
#include "wavelet_tables.inc"
    };
    std::vector<Wavelet> result;
    result.reserve(table.size());
    for (const LowPass& low : table) result.push_back(with_mirrors(low));
    return result;
  }();
  return wavelets;
}

}  // namespace

const Wavelet& wavelet(std::string_view name) {
  std::string known;
  for (const Wavelet& w : all_wavelets()) {
    if (w.name == name) return w;
    known += (known.empty() ? "" : ", ") + w.name;
  }
  fail(ErrorKind::invalid_argument,
       "unknown wavelet '" + std::string(name) + "'; there are: " + known);
}

std::vector<std::string> wavelet_names() {
  std::vector<std::string> names;
  for (const Wavelet& w : all_wavelets()) names.push_back(w.name);
  return names;
}

}  // namespace hri
