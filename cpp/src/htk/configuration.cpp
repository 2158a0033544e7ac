// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/htk/configuration.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <utility>

#include "hri/core/error.hpp"
#include "htk/text_lines.hpp"

namespace hri::htk {
namespace {

constexpr double kUnitsPerMs = 1e4;  // HTK's times are in 100 ns
constexpr double kUnitsPerS = 1e7;
constexpr double kLeastRateHz = 1000;  // as of the end pointer
constexpr double kLargestRateHz = 384000;

std::string upper(std::string text) {
  for (char& c : text) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  return text;
}

class ConfigurationReader {
 public:
  ConfigurationReader(const std::string& text, const std::string& name, Configuration* out)
      : lines_(text, name), out_(out) {
    add_setters();
  }

  void read() {
    while (lines_.next()) {
      const std::string line = without_comment(lines_.line());
      if (line.find_first_not_of(detail::kBlanks) != std::string::npos) read_line(line);
    }
  }

 private:
  using Setter = std::function<void(const std::string&)>;

  // Up to a # that does not stand in quotation marks.
  static std::string without_comment(const std::string& line) {
    char quote = '\0';
    for (std::size_t at = 0; at < line.size(); ++at) {
      const char c = line[at];
      if (quote == '\0' && c == '#') return line.substr(0, at);
      if (c == quote) {
        quote = '\0';
      } else if (quote == '\0' && (c == '"' || c == '\'')) {
        quote = c;
      }
    }
    return line;
  }

  void read_line(const std::string& line) {
    const std::size_t equals = line.find('=');
    std::vector<std::string> values;
    if (equals == std::string::npos) lines_.refuse("expected KEY = VALUE");
    if (const char* fault = detail::split_fields(line.substr(equals + 1), &values);
        fault != nullptr)
      lines_.refuse(fault);
    std::string key = line.substr(0, equals);
    const std::size_t colon = key.find(':');
    if (colon != std::string::npos) key = key.substr(colon + 1);
    std::vector<std::string> keys;
    if (detail::split_fields(key, &keys) != nullptr || keys.size() != 1 || values.empty())
      lines_.refuse("expected KEY = VALUE");
    const std::string name = upper(keys.front());
    const std::size_t first = line.find_first_not_of(detail::kBlanks, equals + 1);
    const std::size_t last = line.find_last_not_of(detail::kBlanks);
    out_->settings.emplace_back(name, line.substr(first, last + 1 - first));
    const auto found = setters_.find(name);
    if (found == setters_.end()) {
      out_->ignored.push_back(name);
      return;
    }
    if (values.size() != 1) lines_.refuse(name + " takes one value");
    found->second(values.front());
    if (const std::string fault = options_fault(out_->features); !fault.empty())
      lines_.refuse(name + ": " + fault);
  }

  bool flag(const std::string& value) const {
    const std::string text = upper(value);
    if (text == "T" || text == "TRUE") return true;
    if (text == "F" || text == "FALSE") return false;
    lines_.refuse("'" + value + "' is neither T nor F");
  }

  void add_flag(const char* key, bool* field) {
    setters_[key] = [this, field](const std::string& value) { *field = flag(value); };
  }
  void add_number(const char* key, double* field, double unit = 1) {
    setters_[key] = [this, field, unit](const std::string& value) {
      *field = lines_.number_of(value) / unit;
    };
  }
  // Of a frequency, below 0: not set.
  void add_frequency(const char* key, double* field) {
    setters_[key] = [this, field](const std::string& value) {
      const double hz = lines_.number_of(value);
      *field = hz < 0 ? 0 : hz;
    };
  }
  void add_whole(const char* key, int* field) {
    setters_[key] = [this, field](const std::string& value) {
      *field = static_cast<int>(lines_.whole_of(value, 0, 1000000));
    };
  }
  // Of a setting that has one value here: others would change the parameters.
  void add_fixed(const char* key, double only) {
    setters_[key] = [this, key, only](const std::string& value) {
      const std::string text = upper(value);
      const bool off = text == "F" || text == "FALSE";
      if (off ? only != 0 : (text == "T" || text == "TRUE" || lines_.number_of(value) != only))
        lines_.refuse(std::string(key) + " = " + value + " is not supported");
    };
  }
  void add_word(const char* key, std::vector<std::string> known) {
    setters_[key] = [this, key, known = std::move(known)](const std::string& value) {
      for (const std::string& k : known) {
        if (upper(value) == k) return;
      }
      lines_.refuse(std::string(key) + " = " + value + " is not supported");
    };
  }

  void add_setters() {
    HtkFeatureOptions& f = out_->features;
    setters_["TARGETKIND"] = [this](const std::string& value) { set_target(value); };
    setters_["TARGETRATE"] = [this](const std::string& value) {
      out_->features.frame_shift_ms = lines_.number_of(value) / kUnitsPerMs;
      out_->has_target_rate = true;
    };
    setters_["SOURCEFORMAT"] = [this](const std::string& value) { set_format(value); };
    add_word("TARGETFORMAT", {"HTK"});
    add_number("WINDOWSIZE", &f.frame_length_ms, kUnitsPerMs);
    add_flag("USEHAMMING", &f.hamming);
    add_number("PREEMCOEF", &f.pre_emphasis);
    add_flag("ZMEANSOURCE", &f.zero_mean);
    add_flag("USEPOWER", &f.use_power);
    add_whole("NUMCHANS", &f.num_filters);
    add_frequency("LOFREQ", &f.low_hz);
    add_frequency("HIFREQ", &f.high_hz);
    add_number("WARPFREQ", &f.warp);
    add_frequency("WARPLCUTOFF", &f.warp_low_hz);
    add_frequency("WARPUCUTOFF", &f.warp_high_hz);
    add_whole("LPCORDER", &f.lpc_order);
    add_whole("NUMCEPS", &f.num_cepstra);
    add_number("CEPLIFTER", &f.lifter);
    add_flag("RAWENERGY", &f.raw_energy);
    add_flag("ENORMALISE", &f.normalise_energy);
    add_number("ESCALE", &f.energy_scale);
    add_number("SILFLOOR", &f.silence_floor_db);
    add_whole("DELTAWINDOW", &f.delta_window);
    add_whole("ACCWINDOW", &f.acceleration_window);
    add_whole("THIRDWINDOW", &f.third_window);
    add_flag("SAVECOMPRESSED", &out_->save_compressed);
    add_flag("SAVEWITHCRC", &out_->save_with_checksum);
    add_flag("SAVEASVQ", &out_->save_codewords);
    setters_["VQTABLE"] = [this](const std::string& value) { out_->vq_table = value; };
    for (const char* key : {"SIMPLEDIFFS", "V1COMPAT", "ADDDITHER", "DOUBLEFFT"}) add_fixed(key, 0);
    for (const char* key : {"CEPSCALE", "MELFLOOR"}) add_fixed(key, 1);
    add_refusals();
    if (out_->live) {
      add_settings_of_live_sound();
    } else {
      add_refusals_of_live_sound();
    }
  }

  // MEASURESIL and the thresholds of HTK's detector set nothing: the end pointer has its own.
  void add_settings_of_live_sound() {
    add_word("SOURCEKIND", {"HAUDIO", "WAVEFORM", "ANON"});
    setters_["USESILDET"] = [this](const std::string& value) {
      if (!flag(value)) lines_.refuse("USESILDET = " + value + ": live sound is cut at silence");
    };
    setters_["SOURCERATE"] = [this](const std::string& value) {
      const double rate_hz = kUnitsPerS / std::max(lines_.number_of(value), 1e-30);
      if (!(rate_hz >= kLeastRateHz && rate_hz <= kLargestRateHz))
        lines_.refuse("SOURCERATE = " + value +
                      " is no sample period in 100 ns: 625 is that of 16000 Hz");
      out_->source_rate_hz = static_cast<int>(std::lround(rate_hz));
    };
    add_whole("SILSEQCOUNT", &out_->silence_frames);
    setters_["RECOUTPREFIX"] = [this](const std::string& value) { out_->record_prefix = value; };
    setters_["RECOUTSUFFIX"] = [this](const std::string& value) { out_->record_suffix = value; };
  }

  void add_refusals_of_live_sound() {
    setters_["SOURCEKIND"] = [this](const std::string& value) {
      const std::string kind = upper(value);
      if (kind == "HAUDIO") refuse_live_sound("SOURCEKIND", value);
      if (kind != "WAVEFORM" && kind != "ANON")
        lines_.refuse("SOURCEKIND = " + value + " is not supported");
    };
    for (const char* key : {"USESILDET", "MEASURESIL"}) {
      setters_[key] = [this, key](const std::string& value) {
        if (flag(value)) refuse_live_sound(key, value);
      };
    }
    for (const char* key : {"RECOUTPREFIX", "RECOUTSUFFIX"})
      setters_[key] = [this, key](const std::string& value) { refuse_live_sound(key, value); };
  }

  void refuse_live_sound(const std::string& key, const std::string& value) const {
    lines_.refuse(key + " = " + value + " is of live sound, and files are read here");
  }

  // What would change parameters, labels or results, and is not carried out: refused, unless it
  // says what is done anyhow.
  void add_refusals() {
    for (const char* key :
         {"NATURALREADORDER", "NATURALWRITEORDER", "ADAPTCMN",    "NONUMESCAPES", "RAWMITFORMAT",
          "FORCEOUT",         "FORCECXTEXP",       "FORCELEFTBI", "FORCERIGHTBI", "ALLOWXWRDEXP",
          "CFWORDBOUNDARY",   "USEHMMSETLOG",      "SAVEBINARY",  "SAVELATBIN",   "STRIPTRIPHONES",
          "STRIPCONTEXT",     "IGNORECASE",        "NISTSCORE",   "TRANSALT",     "USEINXFORM"})
      add_fixed(key, 0);
    add_word("BYTEORDER", {"NONVAX"});
    add_fixed("NSTREAMS", 1);
    for (const char* key : {"LABELFORMAT", "SOURCELABEL", "TARGETLABEL"}) add_word(key, {"HTK"});
    for (const char* key : {"TRANSLEVEL", "REFLEVEL", "TESTLEVEL"}) add_fixed(key, 0);
    for (const char* key :
         {"CMEANDIR",         "CMEANMASK",   "CMEANPATHMASK", "VARSCALEDIR",   "VARSCALEMASK",
          "VARSCALEPATHMASK", "VARSCALEFN",  "MATTRANFN",     "MATTRAN",       "SIDEXFORMMASK",
          "SIDEXFORMEXT",     "STEREOMODE",  "LABFILEMASK",   "LABOFILEMASK",  "LATFILEMASK",
          "LATOFILEMASK",     "HPARMFILTER", "HWAVEFILTER",   "HLABELFILTER",  "HMMDEFFILTER",
          "HMMLISTFILTER",    "HNETFILTER",  "HDICTFILTER",   "LANGMODFILTER", "PRONSCALE",
          "INPUTXFORM",       "PAXFORMMASK", "INXFORMMASK",   "SPEAKERMASK",   "PHRASELABEL",
          "PHONELABEL"})
      setters_[key] = [this, key](const std::string& value) {
        lines_.refuse(std::string(key) + " = " + value + " is not supported");
      };
  }

  void set_target(const std::string& value) {
    ParameterKind kind;
    // Not one of `kind`: no file has it.
    const std::string name = upper(value);
    const std::size_t at = name.find("_V");
    const bool has_codewords = at != std::string::npos;
    const std::string fault = ParameterKind::try_parse(
        has_codewords ? value.substr(0, at) + value.substr(at + 2) : value, &kind);
    if (!fault.empty()) lines_.refuse(fault);
    if (kind != kind.plain())
      lines_.refuse("TARGETKIND takes no _C and _K: SAVECOMPRESSED and SAVEWITHCRC set them");
    out_->target = kind;
    out_->has_codewords = has_codewords;
  }

  void set_format(const std::string& value) {
    const std::string name = upper(value);
    if (name == "WAV" || name == "WAVE") {
      out_->source_format = SourceFormat::wav;
    } else if (name == "HTK") {
      out_->source_format = SourceFormat::htk;
    } else {
      lines_.refuse("SOURCEFORMAT = " + value + " is not supported; WAV and HTK are");
    }
  }

  detail::TextLines lines_;
  Configuration* out_;
  std::map<std::string, Setter> setters_;
};

}  // namespace

void Configuration::parse(const std::string& text, const std::string& name) {
  detail::require_text(text, name);
  Configuration changed = *this;
  ConfigurationReader(text, name, &changed).read();
  *this = std::move(changed);
}

void Configuration::read(const std::string& path) { parse(detail::read_text(path), path); }

ParameterKind Configuration::written_kind(ParameterKind source) const {
  ParameterKind kind = target;
  if (kind.base == BaseKind::anon && kind.qualifiers == 0) kind = source.plain();
  if (kind.base == BaseKind::anon) kind.base = source.base;
  const bool integers = kind.base == BaseKind::waveform || kind.base == BaseKind::discrete ||
                        kind.base == BaseKind::irefc;
  // Files hold the energy; observations leave it out.
  unsigned qualifiers = kind.qualifiers & ~static_cast<unsigned>(kNoEnergy);
  if (save_compressed && !integers) qualifiers |= kCompressed;
  if (save_with_checksum && kind.base != BaseKind::waveform) qualifiers |= kChecksum;
  kind.qualifiers = static_cast<std::uint16_t>(qualifiers);
  return kind;
}

}  // namespace hri::htk
