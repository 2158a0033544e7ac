// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/htk/word_lattice.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "hri/core/error.hpp"
#include "htk/text_lines.hpp"

namespace hri::htk {
namespace {

constexpr std::int64_t kMost = 10000000;                  // nodes or arcs of a file
constexpr double kLargestField = 1e12;                    // of scores, natural logs, and of times
constexpr std::size_t kMostKept = std::size_t{1} << 26U;  // bytes of the text that was read

// NAME=VALUE fields of one line.
using Fields = std::map<std::string, std::string>;

// The short names of fields by the long ones.
using Names = std::map<std::string, std::string>;

const Names& header_names() {
  static const Names names{{"NODES", "N"}, {"LINKS", "L"}, {"SUBLAT", "S"}};
  return names;
}
const Names& node_names() {
  static const Names names{{"time", "t"}, {"WORD", "W"}, {"var", "v"}, {"SUBLAT", "L"}};
  return names;
}
const Names& arc_names() {
  static const Names names{{"START", "S"}, {"END", "E"},      {"WORD", "W"},
                           {"var", "v"},   {"acoustic", "a"}, {"language", "l"}};
  return names;
}

class LatticeReader {
 public:
  LatticeReader(const std::string& text, const std::string& name) : lines_(text, name) {}

  WordLattice read() {
    while (lines_.next()) {
      if (lines_.line().empty() || lines_.line().front() == '#') continue;
      read_line(fields());
    }
    if (num_nodes_ < 0) lines_.refuse("the lattice has no line with N= and L=");
    if (static_cast<std::int64_t>(nodes_.size()) != num_nodes_)
      lines_.refuse("there are " + std::to_string(nodes_.size()) + " nodes above, N= says " +
                    std::to_string(num_nodes_));
    if (static_cast<std::int64_t>(lattice_.arcs.size()) != num_arcs_)
      lines_.refuse("there are " + std::to_string(lattice_.arcs.size()) + " arcs above, L= says " +
                    std::to_string(num_arcs_));
    lattice_.insertion_penalty = natural(lattice_.insertion_penalty);
    for (auto& [number, word] : nodes_) lattice_.words.push_back(std::move(word));
    for (const auto& [number, line] : line_of_) lattice_.lines.push_back(line);
    if (!variant_of_.empty()) {
      lattice_.variants.resize(lattice_.words.size());
      for (const auto& [number, variant] : variant_of_)
        lattice_.variants[static_cast<std::size_t>(number)] = variant;
    }
    // Of the times of some nodes alone nothing can be made.
    for (const auto& [number, time] : times_) {
      if (times_.size() == nodes_.size()) lattice_.times_s.push_back(time);
    }
    if (!words_of_arcs_.empty()) put_words_on_nodes();
    if (const std::string fault = lattice_.fault(); !fault.empty()) lines_.refuse(fault);
    return std::move(lattice_);
  }

 private:
  [[nodiscard]] Fields fields() const {
    Fields found;
    std::vector<std::string> parts;
    // A value becomes a part of its own, so that it may stand in quotation marks.
    std::string line;
    bool in_quotes = false;
    const std::string& given = lines_.line();
    for (std::size_t at = 0; at < given.size(); ++at) {
      line += given[at];
      if (given[at] == '\\' && at + 1 < given.size()) {
        line += given[++at];
      } else if (given[at] == '"') {
        in_quotes = !in_quotes;
      } else if (given[at] == '=' && !in_quotes) {
        line += ' ';
      }
    }
    if (const char* fault = detail::split_fields(line, &parts); fault != nullptr)
      lines_.refuse(fault);
    for (std::size_t i = 0; i < parts.size(); i += 2) {
      const std::string& part = parts[i];
      if (part.size() < 2 || part.back() != '=' || i + 1 >= parts.size())
        lines_.refuse("expected fields NAME=VALUE");
      if (!found.emplace(part.substr(0, part.size() - 1), parts[i + 1]).second)
        lines_.refuse("the field " + part + " stands here twice");
    }
    if (found.count("I") > 0) return with_short_names(found, node_names());
    return with_short_names(found, found.count("J") > 0 ? arc_names() : header_names());
  }

  [[nodiscard]] Fields with_short_names(const Fields& fields, const Names& names) const {
    Fields result;
    for (const auto& [name, value] : fields) {
      const auto found = names.find(name);
      const std::string& short_name = found == names.end() ? name : found->second;
      if (!result.emplace(short_name, value).second)
        lines_.refuse("the field " + short_name + "= stands here twice, by its long name too");
    }
    return result;
  }

  void read_line(const Fields& fields) {
    const bool is_node = fields.count("I") > 0;
    const bool is_header = !is_node && fields.count("J") == 0;
    // In the line of a node L= names one, in others S=.
    if ((is_node && fields.count("L") > 0) || (is_header && fields.count("S") > 0))
      lines_.refuse("lattices in lattices are not read");
    if (is_node) {
      read_node(fields);
    } else if (!is_header) {
      read_arc(fields);
    } else if (fields.count("N") > 0 || fields.count("L") > 0) {
      if (num_nodes_ >= 0) lines_.refuse("N= and L= stand here again");
      if (fields.count("N") == 0 || fields.count("L") == 0) lines_.refuse("expected N= and L=");
      num_nodes_ = lines_.whole_of(fields.at("N"), 1, kMost);
      num_arcs_ = lines_.whole_of(fields.at("L"), 0, kMost);
    }
    if (is_header) {
      if (fields.count("base") > 0) {
        const double base = lines_.number_of(fields.at("base"));
        if (!(base > 0) || base == 1) lines_.refuse("the base of logs is not above 0, or is 1");
        log_base_ = std::log(base);
      }
      if (const auto scale = fields.find("lmscale"); scale != fields.end())
        lattice_.language_scale = lines_.number_of(scale->second, kLargestField);
      if (const auto penalty = fields.find("wdpenalty"); penalty != fields.end())
        lattice_.insertion_penalty = lines_.number_of(penalty->second, kLargestField);
      for (const auto& [key, node] :
           {std::pair{"start", &lattice_.start}, std::pair{"end", &lattice_.end}}) {
        if (fields.count(key) > 0)
          *node = static_cast<int>(lines_.whole_of(fields.at(key), 0, kMost));
      }
    }
    // All others say where the lattice comes from.
  }

  // A log to the base of the file as natural log.
  [[nodiscard]] double natural(double log) const {
    if (std::fabs(log * log_base_) > kLargestField)
      lines_.refuse("a log of this base is no number that can stand here");
    return log * log_base_;
  }

  void require_header() const {
    if (num_nodes_ < 0) lines_.refuse("nodes and arcs stand behind N= and L=");
  }

  void read_node(const Fields& fields) {
    require_header();
    const std::int64_t number = lines_.whole_of(fields.at("I"), 0, num_nodes_ - 1);
    const auto word = fields.find("W");
    const std::string name = word == fields.end() ? WordLattice::kNull : word->second;
    if (name.empty()) lines_.refuse("a word is empty");
    if (!nodes_.emplace(number, name).second)
      lines_.refuse("node " + std::to_string(number) + " stands here again");
    line_of_[number] = lines_.number();
    if (word != fields.end())
      has_words_on_nodes_ = has_words_on_nodes_ || name != WordLattice::kNull;
    if (const auto time = fields.find("t"); time != fields.end())
      times_[number] = lines_.number_of(time->second, kLargestField);
    if (const auto variant = fields.find("v"); variant != fields.end())
      variant_of_[number] = static_cast<int>(lines_.whole_of(variant->second, 0, kMost));
  }

  // A node on every arc that has a word; it ends where the arc does.
  void put_words_on_nodes() {
    if (has_words_on_nodes_) lines_.refuse("there are words on nodes and on arcs");
    const bool has_times = !lattice_.times_s.empty();
    lattice_.variants.resize(lattice_.words.size());
    for (ArcWord& one : words_of_arcs_) {
      WordLattice::Arc& arc = lattice_.arcs[one.arc];
      const int node = static_cast<int>(lattice_.words.size());
      lattice_.words.push_back(std::move(one.word));
      lattice_.lines.push_back(one.line);
      lattice_.variants.push_back(one.variant);
      if (has_times) lattice_.times_s.push_back(lattice_.times_s[static_cast<std::size_t>(arc.to)]);
      const int to = arc.to;
      arc.to = node;
      lattice_.arcs.push_back({node, to, 0, 0});
    }
  }

  void read_arc(const Fields& fields) {
    require_header();
    (void)lines_.whole_of(fields.at("J"), 0, std::max<std::int64_t>(num_arcs_, 1) - 1);
    WordLattice::Arc arc;
    for (const auto& [key, node] : {std::pair{"S", &arc.from}, std::pair{"E", &arc.to}}) {
      const auto found = fields.find(key);
      if (found == fields.end()) lines_.refuse("an arc needs S= and E=");
      *node = static_cast<int>(lines_.whole_of(found->second, 0, num_nodes_ - 1));
    }
    if (const auto weight = fields.find("l"); weight != fields.end())
      arc.log_weight = natural(lines_.number_of(weight->second, kLargestField));
    if (const auto score = fields.find("a"); score != fields.end())
      arc.log_acoustic = natural(lines_.number_of(score->second, kLargestField));
    if (static_cast<std::int64_t>(lattice_.arcs.size()) >= num_arcs_)
      lines_.refuse("there are more arcs than L= says");
    if (const auto word = fields.find("W");
        word != fields.end() && word->second != WordLattice::kNull) {
      if (word->second.empty()) lines_.refuse("a word is empty");
      const auto variant = fields.find("v");
      words_of_arcs_.push_back(
          {lattice_.arcs.size(), word->second, lines_.number(),
           variant == fields.end() ? 0
                                   : static_cast<int>(lines_.whole_of(variant->second, 0, kMost))});
    }
    lattice_.arcs.push_back(arc);
  }

  struct ArcWord {
    std::size_t arc = 0;
    std::string word;
    std::int64_t line = 0;
    int variant = 0;
  };

  detail::TextLines lines_;
  WordLattice lattice_;
  std::vector<ArcWord> words_of_arcs_;
  std::map<std::int64_t, std::int64_t> line_of_;
  std::map<std::int64_t, int> variant_of_;
  bool has_words_on_nodes_ = false;
  std::map<std::int64_t, std::string> nodes_;
  std::map<std::int64_t, double> times_;
  std::int64_t num_nodes_ = -1;
  std::int64_t num_arcs_ = 0;
  double log_base_ = 1;
};

// The only node for which `found` is false; -1: none or several.
int only_one(const std::vector<bool>& found) {
  if (std::count(found.begin(), found.end(), false) != 1) return -1;
  return static_cast<int>(std::find(found.begin(), found.end(), false) - found.begin());
}

int end_of(const WordLattice& lattice, bool last) {
  std::vector<bool> has(lattice.words.size());
  for (const WordLattice::Arc& arc : lattice.arcs)
    has[static_cast<std::size_t>(last ? arc.from : arc.to)] = true;
  return only_one(has);
}

// Whether arcs between nodes without words go round: what is left when nodes without predecessors
// are taken away again and again.
bool has_null_cycle(const WordLattice& lattice) {
  const auto is_null = [&](int n) {
    return lattice.words[static_cast<std::size_t>(n)] == WordLattice::kNull;
  };
  std::vector<std::vector<int>> next(lattice.words.size());
  std::vector<int> num_before(lattice.words.size());
  for (const WordLattice::Arc& arc : lattice.arcs) {
    if (!is_null(arc.from) || !is_null(arc.to)) continue;
    next[static_cast<std::size_t>(arc.from)].push_back(arc.to);
    ++num_before[static_cast<std::size_t>(arc.to)];
  }
  std::vector<int> open;
  for (std::size_t n = 0; n < next.size(); ++n) {
    if (num_before[n] == 0) open.push_back(static_cast<int>(n));
  }
  std::size_t num_taken = 0;
  while (!open.empty()) {
    const int node = open.back();
    open.pop_back();
    ++num_taken;
    for (const int to : next[static_cast<std::size_t>(node)]) {
      if (--num_before[static_cast<std::size_t>(to)] == 0) open.push_back(to);
    }
  }
  return num_taken < next.size();
}

// A word as the reader above takes it.
std::string word_text(const std::string& word) {
  detail::require_name(word, "the word");
  return word.find('=') == std::string::npos ? detail::quoted(word) : detail::in_quotes(word);
}

// Whether both say the same; lines of a file are no part of it.
bool same(const WordLattice& a, const WordLattice& b) {
  const auto same_arc = [](const WordLattice::Arc& x, const WordLattice::Arc& y) {
    return x.from == y.from && x.to == y.to && x.log_weight == y.log_weight &&
           x.log_acoustic == y.log_acoustic;
  };
  return a.words == b.words && a.times_s == b.times_s && a.variants == b.variants &&
         a.start == b.start && a.end == b.end && a.language_scale == b.language_scale &&
         a.insertion_penalty == b.insertion_penalty &&
         std::equal(a.arcs.begin(), a.arcs.end(), b.arcs.begin(), b.arcs.end(), same_arc);
}

std::string padded(const std::string& text, std::size_t width) {
  return text.size() < width ? text + std::string(width - text.size(), ' ') : text;
}

}  // namespace

int WordLattice::first() const { return start != kByArcs ? start : end_of(*this, false); }
int WordLattice::last() const { return end != kByArcs ? end : end_of(*this, true); }

std::string WordLattice::fault() const {
  const auto size = static_cast<int>(words.size());
  for (const Arc& arc : arcs) {
    if (arc.from < 0 || arc.from >= size || arc.to < 0 || arc.to >= size)
      return "an arc joins nodes that there are not";
    if (!std::isfinite(arc.log_weight) || !std::isfinite(arc.log_acoustic))
      return "the weight of an arc is not finite";
  }
  if (!std::isfinite(language_scale) || !std::isfinite(insertion_penalty))
    return "lmscale= or wdpenalty= is not finite";
  if (!times_s.empty() && times_s.size() != words.size()) return "some nodes have no time";
  for (const double time : times_s) {
    if (!std::isfinite(time)) return "the time of a node is not finite";
  }
  if (!variants.empty() && variants.size() != words.size()) return "some nodes have no variant";
  for (const int variant : variants) {
    if (variant < 0) return "the variant of a pronunciation is below 0";
  }
  if (start < kByArcs || start >= size || end < kByArcs || end >= size)
    return "start= or end= is no node";
  if (first() < 0) return "not exactly one node is without predecessors, to begin sentences";
  if (last() < 0) return "not exactly one node is without successors, to end sentences";
  if (has_null_cycle(*this)) return "nodes without words make a cycle";
  return {};
}

WordLattice WordLattice::of_words(const std::vector<std::string>& sentence) {
  WordLattice lattice;
  lattice.words.emplace_back(kNull);
  lattice.words.insert(lattice.words.end(), sentence.begin(), sentence.end());
  lattice.words.emplace_back(kNull);
  for (int n = 1; n < static_cast<int>(lattice.words.size()); ++n)
    lattice.arcs.push_back({n - 1, n, 0});
  return lattice;
}

WordLattice WordLattice::parse(const std::string& text, const std::string& name) {
  detail::require_text(text, name);
  WordLattice lattice = LatticeReader(text, name).read();
  if (text.size() <= kMostKept) lattice.text_ = text;
  return lattice;
}

WordLattice WordLattice::read(const std::string& path) {
  return parse(detail::read_text(path), path);
}

WordLattice WordLattice::read_grammar(const std::string& path) {
  return of_grammar(detail::read_text(path), path);
}

std::string WordLattice::to_text() const {
  const std::string found = fault();
  require(found.empty(), found.c_str());
  if (!text_.empty() && same(*this, LatticeReader(text_, "text").read())) return text_;
  std::string text = "VERSION=1.0\n";
  if (!times_s.empty() || language_scale != 1 || insertion_penalty != 0)
    text += "lmscale=" + detail::shortest(language_scale) +
            " wdpenalty=" + detail::shortest(insertion_penalty) + "\n";
  if (start != kByArcs) text += "start=" + std::to_string(start) + "\n";
  if (end != kByArcs) text += "end=" + std::to_string(end) + "\n";
  text +=
      "N=" + padded(std::to_string(words.size()), 4) + " L=" + std::to_string(arcs.size()) + "\n";
  for (std::size_t n = 0; n < words.size(); ++n) {
    text += "I=" + padded(std::to_string(n), 4);
    if (!times_s.empty()) text += " t=" + padded(detail::shortest(times_s[n]), 5);
    text += " W=" + word_text(words[n]);
    if (!variants.empty() && variants[n] > 0) text += " v=" + std::to_string(variants[n]);
    text += '\n';
  }
  for (std::size_t a = 0; a < arcs.size(); ++a) {
    text += "J=" + padded(std::to_string(a), 5) + " S=" + padded(std::to_string(arcs[a].from), 4) +
            " E=" + std::to_string(arcs[a].to);
    if (arcs[a].log_acoustic != 0) text += " a=" + detail::shortest(arcs[a].log_acoustic);
    if (arcs[a].log_weight != 0) text += " l=" + detail::shortest(arcs[a].log_weight);
    text += '\n';
  }
  return text;
}

void WordLattice::write(const std::string& path) const { detail::write_text(path, to_text()); }

}  // namespace hri::htk
