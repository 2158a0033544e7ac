// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/htk/parameter_kind.hpp"

#include <algorithm>
#include <utility>

#include "hri/core/error.hpp"

namespace hri::htk {
namespace {

// In the order in which HTK writes them.
constexpr std::array<std::pair<char, Qualifier>, 10> kLetters{{{'E', kEnergy},
                                                               {'D', kDelta},
                                                               {'N', kNoEnergy},
                                                               {'A', kAcceleration},
                                                               {'T', kThird},
                                                               {'C', kCompressed},
                                                               {'K', kChecksum},
                                                               {'Z', kZeroMean},
                                                               {'0', kC0},
                                                               {'V', kCodeword}}};

}  // namespace

std::string ParameterKind::try_parse(const std::string& text, ParameterKind* kind) {
  std::string upper = text;
  for (char& c : upper) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  const std::string name = "the parameter kind '" + text + "' ";
  *kind = ParameterKind();
  const std::size_t end = std::min(upper.find('_'), upper.size());
  if (!parse_enum(std::string_view(upper).substr(0, end), &kind->base))
    return name + "does not begin with one of " + enum_list<BaseKind>();
  for (std::size_t at = end; at < upper.size(); at += 2) {
    const auto* const found =
        std::find_if(kLetters.begin(), kLetters.end(), [&](const auto& letter) {
          return upper[at] == '_' && at + 1 < upper.size() && letter.first == upper[at + 1];
        });
    if (found == kLetters.end()) return name + "has something else than _E _D _N _A _T _C _K _Z _0";
    if (kind->has(found->second)) return name + "has a qualifier twice";
    kind->qualifiers = static_cast<std::uint16_t>(kind->qualifiers | found->second);
  }
  const char* fault = kind->fault();
  return fault == nullptr ? std::string() : name + fault;
}

ParameterKind ParameterKind::parse(const std::string& text) {
  ParameterKind kind;
  const std::string fault = try_parse(text, &kind);
  require(fault.empty(), fault.c_str());
  return kind;
}

std::uint16_t ParameterKind::code() const {
  return static_cast<std::uint16_t>(qualifiers | static_cast<std::uint16_t>(base));
}

std::string ParameterKind::text() const {
  std::string name = enum_name(base);
  for (const auto& [letter, qualifier] : kLetters) {
    if (has(qualifier)) name += std::string("_") + letter;
  }
  return name;
}

ParameterKind ParameterKind::plain() const {
  return {base, static_cast<std::uint16_t>(qualifiers & ~(kCompressed | kChecksum))};
}

int ParameterKind::num_blocks() const {
  return 1 + (has(kDelta) ? 1 : 0) + (has(kAcceleration) ? 1 : 0) + (has(kThird) ? 1 : 0);
}

const char* ParameterKind::fault() const {
  if (has(kCodeword))
    return "has codewords beside the frames (_V), which no file or model has here: see VQTABLE, "
           "SAVEASVQ";
  if (has(kAcceleration) && !has(kDelta)) return "has _A without _D";
  if (has(kThird) && !has(kAcceleration)) return "has _T without _A";
  if (has(kNoEnergy) && !(has(kDelta) && (has(kEnergy) || has(kC0))))
    return "has _N without _D and one of _E and _0";
  const bool integers =
      base == BaseKind::waveform || base == BaseKind::discrete || base == BaseKind::irefc;
  if (integers && has(kCompressed)) return "has _C, though it is of integers";
  if (base == BaseKind::waveform && plain().qualifiers != 0) return "has qualifiers of frames";
  return nullptr;
}

}  // namespace hri::htk
