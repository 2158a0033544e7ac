// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// What a frame of an HTK parameter file holds: a base kind and qualifiers, as in MFCC_E_D_A (HTK
// Book, section 5.10.1).
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "hri/core/export.hpp"
#include "hri/core/options.hpp"

namespace hri::htk {

/// In the order of their codes.
enum class BaseKind : std::uint8_t {
  waveform,
  lpc,        ///< linear prediction
  lprefc,     ///< reflection coefficients
  lpcepstra,  ///< cepstrum of linear prediction
  lpdelcep,   ///< the same with deltas
  irefc,      ///< reflection coefficients as 16-bit integers
  mfcc,
  fbank,    ///< log energies of mel filters
  melspec,  ///< the same without log
  user,
  discrete,  ///< codewords
  plp,
  anon,  ///< not named; in no file
};
constexpr auto enum_names(BaseKind) {
  return std::array{"WAVEFORM", "LPC",     "LPREFC", "LPCEPSTRA", "LPDELCEP", "IREFC", "MFCC",
                    "FBANK",    "MELSPEC", "USER",   "DISCRETE",  "PLP",      "ANON"};
}

/// Bits of the code.
enum Qualifier : std::uint16_t {
  kEnergy = 0x40,         ///< _E: log energy behind the others
  kNoEnergy = 0x80,       ///< _N: the absolute energy is left out of observations, not of files
  kDelta = 0x100,         ///< _D
  kAcceleration = 0x200,  ///< _A
  kCompressed = 0x400,    ///< _C: 16-bit integers
  kZeroMean = 0x800,      ///< _Z: the static coefficients have mean 0
  kChecksum = 0x1000,     ///< _K
  kC0 = 0x2000,           ///< _0: c0 behind the other cepstra
  kCodeword = 0x4000,     ///< _V: a codeword beside the frame; not read
  kThird = 0x8000,        ///< _T: third differences
};

struct HRI_API ParameterKind {
  BaseKind base = BaseKind::anon;
  std::uint16_t qualifiers = 0;

  /// "MFCC_D_A_0" and the like, qualifiers in any order, small letters too. Throws InvalidArgument
  /// for other names and for qualifiers twice or that do not go together (see fault()).
  static ParameterKind parse(const std::string& text);
  /// The same without an exception: "", or what is wrong with the name.
  static std::string try_parse(const std::string& text, ParameterKind* kind);

  [[nodiscard]] std::uint16_t code() const;
  /// The name, qualifiers in HTK's order: E D N A T C K Z 0 V.
  [[nodiscard]] std::string text() const;
  [[nodiscard]] bool has(Qualifier q) const { return (qualifiers & q) != 0; }
  /// Without _C and _K, which say how a file holds the frames.
  [[nodiscard]] ParameterKind plain() const;
  /// Blocks of columns: 1, and one more for each of _D, _A and _T.
  [[nodiscard]] int num_blocks() const;
  /// nullptr, or which qualifiers do not go together.
  [[nodiscard]] const char* fault() const;

  bool operator==(const ParameterKind& o) const {
    return base == o.base && qualifiers == o.qualifiers;
  }
  bool operator!=(const ParameterKind& o) const { return !(*this == o); }
};

}  // namespace hri::htk
