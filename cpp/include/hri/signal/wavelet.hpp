// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Wavelet filters by PyWavelets' names: haar, db1..db38, sym2..sym20, coif1..coif17, dmey, and the
// biorthogonal bior1.1..bior6.8 and rbio1.1..rbio6.8. The thesis's "Daubechies-6" is ambiguous: db6
// has 12 taps, D6 = db3 has 6.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "hri/core/export.hpp"

namespace hri {

/// Analysis (dec) and synthesis (rec) filters of one length. High-pass filters are quadrature
/// mirrors of the other side's low-pass: dec_hi[k] = (-1)^(k+1) rec_lo[k], rec_hi[k] = (-1)^k
/// dec_lo[k]. For an orthogonal wavelet rec_lo is the reverse of dec_lo; dec_hi of db2 is the
/// (c3, -c2, c1, -c0) which the thesis prints without its c1.
struct Wavelet {
  std::string name;
  std::vector<double> dec_lo;
  std::vector<double> dec_hi;
  std::vector<double> rec_lo;
  std::vector<double> rec_hi;
};

/// Throws InvalidArgument that lists the names for an unknown one. The reference lives as long as
/// the program.
HRI_API const Wavelet& wavelet(std::string_view name);

HRI_API std::vector<std::string> wavelet_names();

/// Range of an options field that names a wavelet.
struct HRI_API WaveletName {
  [[nodiscard]] bool holds(std::string_view name) const;
  [[nodiscard]] std::string text() const { return "the name of a wavelet, such as 'db4'"; }
};

}  // namespace hri
