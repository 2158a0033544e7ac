// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// EditScript from the text of a file.
#include "hri/htk/edit_script.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "hri/core/error.hpp"
#include "htk/model_text.hpp"
#include "htk/text_lines.hpp"

namespace hri::htk {
namespace {

using detail::kMostMixtures;
using detail::kMostStates;
constexpr std::size_t kMostItems = 100000;  // of all lists

class ScriptReader {
 public:
  ScriptReader(const std::string& text, const std::string& name) : text_(text), name_(name) {}

  std::vector<EditCommand> read() {
    std::vector<EditCommand> commands;
    for (skip_blanks(); at_ < text_.size(); skip_blanks()) {
      if (now() == '#' || text_.compare(at_, 2, "//") == 0) {
        at_ = std::min(text_.find('\n', at_), text_.size());
      } else if (text_.compare(at_, 3, "TR ") == 0) {
        at_ += 3;  // how much HHEd prints
        whole(word("{"), 0, 1000000);
      } else {
        commands.push_back(command());
      }
    }
    return commands;
  }

 private:
  [[noreturn]] void refuse(const std::string& why) const {
    fail(ErrorKind::format, name_ + ": line " + std::to_string(line_) + ": " + why);
  }

  [[nodiscard]] char now() const { return at_ < text_.size() ? text_[at_] : '\0'; }

  void skip_blanks() {
    for (; now() == ' ' || now() == '\t' || now() == '\r' || now() == '\n'; ++at_)
      line_ += now() == '\n' ? 1 : 0;
  }

  bool skip(char c) {
    skip_blanks();
    if (now() != c) return false;
    ++at_;
    return true;
  }

  void expect(char c) {
    if (!skip(c)) refuse(std::string("expected ") + c);
  }

  // Characters up to a blank or one of `ends`.
  std::string word(const std::string& ends) {
    skip_blanks();
    const std::size_t end = std::min(text_.find_first_of(" \t\r\n" + ends, at_), text_.size());
    const std::string taken = text_.substr(at_, end - at_);
    at_ = end;
    return taken;
  }

  double number_of(const std::string& text) const {
    double value = 0;
    if (!detail::parse_number(text, &value)) refuse("expected a number, not '" + text + "'");
    return value;
  }

  int whole(const std::string& text, int low, int high) const {
    const double value = number_of(text);
    if (value != std::floor(value) || value < low || value > high)
      refuse("expected a whole number in " + std::to_string(low) + ".." + std::to_string(high));
    return static_cast<int>(value);
  }

  EditCommand command() {
    EditCommand made;
    made.line = line_;
    const std::string name = word("{");
    if (name == "MU") {
      made.kind = EditCommand::Kind::split_mixtures;
      const std::string count = word("{");
      made.is_more = !count.empty() && count.front() == '+';
      made.num_mixtures = whole(made.is_more ? count.substr(1) : count, 1, kMostMixtures);
    } else if (name == "TI") {
      made.kind = EditCommand::Kind::tie;
      made.macro = quotable("the name of a macro");
    } else if (name == "AT" || name == "RT") {
      made.kind =
          name == "AT" ? EditCommand::Kind::add_transition : EditCommand::Kind::remove_transition;
      made.from = whole(word("{"), 1, kMostStates - 1);
      made.to = whole(word("{"), 2, kMostStates);
      if (name == "AT") made.probability = number_of(word("{"));
      if (made.probability < 0 || made.probability > 1 || (name == "AT" && made.probability == 0))
        refuse("a probability is above 0, and at most 1");
    } else if (name == "TB" || name == "TC") {
      made.kind = name == "TB" ? EditCommand::Kind::tie_by_tree : EditCommand::Kind::tie_clusters;
      made.threshold = not_negative();
      made.macro = quotable("the name of a macro");
    } else if (without_items(name, &made)) {
      return made;
    } else {
      refuse("there is no command '" + name +
             "' but MU, TI, AT, RT, CL, RO, LS, QS, TB, TC, AU, CO, ST and LT");
    }
    made.items = items();
    for (const EditItem& item : made.items) check(made, item);
    return made;
  }

  double not_negative() {
    const double value = number_of(word("{"));
    if (value < 0 || value > 1e15) refuse("a threshold is not negative");
    return value;
  }

  // Whether it is a command without items; it is read then.
  bool without_items(const std::string& name, EditCommand* made) {
    using Kind = EditCommand::Kind;
    static const std::map<std::string, Kind> kinds{
        {"CL", Kind::clone},      {"QS", Kind::question},   {"RO", Kind::statistics},
        {"LS", Kind::statistics}, {"AU", Kind::add_unseen}, {"CO", Kind::merge_equal},
        {"ST", Kind::save_trees}, {"LT", Kind::load_trees}};
    const auto found = kinds.find(name);
    if (found == kinds.end()) return false;
    made->kind = found->second;
    if (name == "QS") {
      made->question.name = quotable("the name of a question");
      expect('{');
      do {
        made->question.patterns.push_back(quotable("a pattern", ",}"));
        if (++num_items_ > kMostItems) refuse("there are too many items");
      } while (skip(','));
      expect('}');
      return true;
    }
    if (name == "RO") {
      made->least_occupation = not_negative();
      // A path may follow in the line.
      at_ = std::min(text_.find_first_not_of(" \t\r", at_), text_.size());
      if (now() == '\n' || now() == '\0' || now() == '#') return true;
    }
    made->path = quotable("the path of a file");
    return true;
  }

  // A name that may stand in quotation marks; else it ends at a blank or one of `ends`.
  std::string quotable(const std::string& what, const std::string& ends = "{") {
    skip_blanks();
    if (now() != '"' && now() != '\'') return nonempty(word(ends), what);
    const std::size_t end = text_.find(now(), at_ + 1);
    if (end == std::string::npos || text_.substr(at_, end - at_).find('\n') != std::string::npos)
      refuse("a quotation does not end");
    const std::string name = text_.substr(at_ + 1, end - at_ - 1);
    at_ = end + 1;
    return nonempty(name, what);
  }

  std::string nonempty(const std::string& text, const std::string& what) const {
    if (text.empty()) refuse("expected " + what);
    return text;
  }

  void check(const EditCommand& made, const EditItem& item) const {
    using Kind = EditItem::Kind;
    const bool transitions = item.kind == Kind::transitions;
    if (made.kind == EditCommand::Kind::split_mixtures) {
      if (item.kind != Kind::mixtures) refuse("MU takes items such as {*.state[2-4].mix}");
    } else if (made.kind == EditCommand::Kind::tie) {
      if (item.kind == Kind::mixtures) refuse("TI takes a mixture by its number, as in mix[1]");
      if (item.kind != made.items.front().kind) refuse("TI takes items of one kind");
    } else if (made.kind == EditCommand::Kind::tie_by_tree ||
               made.kind == EditCommand::Kind::tie_clusters) {
      if (item.kind != Kind::state) refuse("TB and TC take items such as {(a,*-a+*).state[2]}");
    } else if (!transitions) {
      refuse("AT and RT take items such as {a.transP}");
    }
  }

  std::vector<EditItem> items() {
    std::vector<EditItem> list;
    expect('{');
    do {
      list.push_back(item());
      if (++num_items_ > kMostItems) refuse("there are too many items");
    } while (skip(','));
    expect('}');
    return list;
  }

  EditItem item() {
    EditItem made;
    if (skip('(')) {
      do {
        made.models.push_back(nonempty(word("(){}[],."), "the name of a model"));
      } while (skip(','));
      expect(')');
    } else {
      made.models.push_back(nonempty(word("(){}[],."), "the name of a model"));
    }
    expect('.');
    const std::string part = word("(){}[],.");
    if (part == "transP") return made;
    if (part != "state") refuse("expected transP or state, not '" + part + "'");
    made.states = numbers(2, kMostStates - 1);
    made.kind = EditItem::Kind::state;
    if (skip('.')) pdf(&made);
    return made;
  }

  // What follows the numbers of states.
  void pdf(EditItem* made) {
    std::string part = word("(){}[],.");
    if (part == "stream") {
      numbers(1, 1);
      expect('.');
      part = word("(){}[],.");
    }
    if (part != "mix") refuse("expected mix, not '" + part + "'");
    made->kind = EditItem::Kind::mixtures;
    skip_blanks();
    if (now() != '[') return;
    made->mixtures = numbers(1, kMostMixtures);
    made->kind = EditItem::Kind::mixture;
    if (!skip('.')) return;
    const std::string vector = word("(){}[],.");
    if (vector != "mean" && vector != "cov") refuse("expected mean or cov, not '" + vector + "'");
    made->kind = vector == "mean" ? EditItem::Kind::mean : EditItem::Kind::variance;
  }

  std::vector<EditItem::Numbers> numbers(int low, int high) {
    std::vector<EditItem::Numbers> list;
    expect('[');
    do {
      EditItem::Numbers one;
      one.low = one.high = whole(word("(){}[],.-"), low, high);
      if (skip('-')) one.high = whole(word("(){}[],.-"), low, high);
      if (one.high < one.low) refuse("a range ends before it begins");
      list.push_back(one);
      if (++num_items_ > kMostItems) refuse("there are too many items");
    } while (skip(','));
    expect(']');
    return list;
  }

  const std::string& text_;
  const std::string& name_;
  std::size_t at_ = 0;
  std::int64_t line_ = 1;
  std::size_t num_items_ = 0;
};

}  // namespace

EditScript EditScript::parse(const std::string& text, const std::string& name) {
  detail::require_text(text, name);
  return {name, ScriptReader(text, name).read()};
}

EditScript EditScript::read(const std::string& path) {
  return parse(detail::read_text(path), path);
}

}  // namespace hri::htk
