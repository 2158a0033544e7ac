// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/htk/decision_trees.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <utility>

#include "hri/core/error.hpp"
#include "hri/htk/labels.hpp"
#include "htk/model_text.hpp"
#include "htk/text_lines.hpp"

namespace hri::htk {
namespace {

constexpr std::size_t kNodesOfTrees = 1000000;  // of all trees

// Marks { } , and the fields between them, with the lines that they stand in.
class TreeTokens {
 public:
  TreeTokens(const std::string& text, const std::string& name) : lines_(text, name) { advance(); }

  [[nodiscard]] bool ended() const { return ended_; }
  [[nodiscard]] bool is_mark(char mark) const {
    return !ended_ && !is_quoted_ && now_ == std::string(1, mark);
  }
  [[nodiscard]] bool is_quoted() const { return is_quoted_; }
  [[nodiscard]] const std::string& now() const { return now_; }
  [[noreturn]] void refuse(const std::string& why) const { lines_.refuse(why); }

  void expect(char mark) {
    if (!is_mark(mark)) refuse(std::string("expected ") + mark);
    advance();
  }

  std::string take(const char* what) {
    if (ended_ || now_.empty() || (!is_quoted_ && now_.find_first_of("{},") != std::string::npos))
      refuse(std::string("expected ") + what);
    std::string taken = now_;
    advance();
    return taken;
  }

  // A number of a node, 0 or below, with its sign taken off.
  int take_node() {
    const auto number = static_cast<int>(lines_.whole_of(now_, -int{kNodesOfTrees}, 0));
    advance();
    return -number;
  }

  void advance() {
    while (!ended_ && at_ >= rest_.size()) {
      ended_ = !lines_.next();
      rest_ = lines_.line();
      at_ = 0;
    }
    now_.clear();
    is_quoted_ = false;
    if (ended_) return;
    std::size_t end = at_ + 1;
    const char first = rest_[at_];
    if (first == '"' || first == '\'') {
      is_quoted_ = true;
      while (end < rest_.size() && rest_[end] != first) end += rest_[end] == '\\' ? 2 : 1;
      end = std::min(end + 1, rest_.size());
      std::vector<std::string> fields;
      if (const char* fault = detail::split_fields(rest_.substr(at_, end - at_), &fields))
        refuse(fault);
      now_ = fields.front();
    } else {
      if (std::string("{},").find(first) == std::string::npos)
        end = std::min(rest_.find_first_of(" \t\r{},\"'", at_), rest_.size());
      now_ = rest_.substr(at_, end - at_);
    }
    at_ = std::min(rest_.find_first_not_of(detail::kBlanks, end), rest_.size());
  }

 private:
  detail::TextLines lines_;
  std::string rest_;
  std::size_t at_ = 0;
  std::string now_;
  bool is_quoted_ = false;
  bool ended_ = false;
};

class TreeReader {
 public:
  TreeReader(const std::string& text, const std::string& name) : in_(text, name) {}

  DecisionTrees read() {
    while (!in_.ended()) {
      if (!in_.is_quoted() && in_.now() == "QS") {
        read_question();
      } else {
        read_tree();
      }
    }
    return std::move(made_);
  }

 private:
  void read_question() {
    in_.advance();
    ContextQuestion question;
    question.name = in_.take("the name of a question");
    in_.expect('{');
    question.patterns.push_back(in_.take("a pattern"));
    while (in_.is_mark(',')) {
      in_.advance();
      question.patterns.push_back(in_.take("a pattern"));
    }
    in_.expect('}');
    const auto number = static_cast<int>(made_.questions.size());
    if (!questions_.emplace(question.name, number).second)
      in_.refuse("the question '" + question.name + "' stands here again");
    made_.questions.push_back(std::move(question));
  }

  // unit[state], and a leaf or nodes in { }.
  void read_tree() {
    DecisionTree tree;
    const std::string head = in_.now();
    const std::size_t bracket = head.rfind('[');
    double state = 0;
    if (in_.is_quoted() || bracket == std::string::npos || bracket == 0 || head.back() != ']' ||
        !detail::parse_number(head.substr(bracket + 1, head.size() - bracket - 2), &state) ||
        state != static_cast<int>(std::clamp(state, 2.0, double{detail::kMostStates})))
      in_.refuse("expected QS, or a tree such as a[2]");
    tree.unit = head.substr(0, bracket);
    tree.state = static_cast<int>(state);
    in_.advance();
    if (in_.is_mark('{')) {
      in_.advance();
      read_nodes(&tree);
    } else {
      tree.nodes.push_back({-1, -1, -1, in_.take("the name of a state, or {")});
    }
    num_nodes_ += tree.nodes.size();
    if (num_nodes_ > kNodesOfTrees) in_.refuse("the trees have too many nodes");
    made_.trees.push_back(std::move(tree));
  }

  struct Fork {
    int question = 0;
    std::array<int, 2> forks{};  // that follow for no and yes; 0: none
    std::array<std::string, 2> leaves;
  };

  void read_nodes(DecisionTree* tree) {
    std::map<int, Fork> forks;
    while (!in_.is_mark('}')) {
      if (in_.ended()) in_.refuse("a tree does not end with }");
      const int number = in_.take_node();
      Fork fork;
      const auto found = questions_.find(in_.take("the name of a question"));
      if (found == questions_.end()) in_.refuse("the question is not defined above");
      fork.question = found->second;
      for (std::size_t side = 0; side < 2; ++side) {
        if (in_.is_quoted()) {
          fork.leaves[side] = in_.take("the name of a state");
        } else if (fork.forks[side] = in_.take_node(); fork.forks[side] == 0) {
          in_.refuse("node 0 follows none");
        }
      }
      if (!forks.emplace(number, std::move(fork)).second) in_.refuse("a node stands here again");
    }
    add_nodes(forks, tree);
    in_.advance();
  }

  // Every fork once, from the root on.
  void add_nodes(const std::map<int, Fork>& forks, DecisionTree* tree) const {
    std::vector<int> numbers{0};  // of the nodes; of leaves not used
    std::size_t num_forks = 0;
    std::map<int, bool> reached{{0, true}};
    tree->nodes.emplace_back();
    for (std::size_t n = 0; n < numbers.size(); ++n) {
      if (!tree->nodes[n].leaf.empty()) continue;
      const auto found = forks.find(numbers[n]);
      if (found == forks.end()) in_.refuse("there is no node " + std::to_string(-numbers[n]));
      ++num_forks;
      tree->nodes[n].question = found->second.question;
      for (std::size_t side = 0; side < 2; ++side) {
        const int number = found->second.forks[side];
        if (number != 0 && !reached.emplace(number, true).second)
          in_.refuse("node " + std::to_string(-number) + " follows two");
        (side == 0 ? tree->nodes[n].no : tree->nodes[n].yes) = static_cast<int>(numbers.size());
        numbers.push_back(number);
        tree->nodes.push_back({-1, -1, -1, found->second.leaves[side]});
      }
    }
    if (num_forks != forks.size()) in_.refuse("a node follows none");
  }

  TreeTokens in_;
  DecisionTrees made_;
  std::map<std::string, int> questions_;
  std::size_t num_nodes_ = 0;
};

std::string marked_name(const std::string& name, char quote) {
  detail::require_name(name, "a name of a tree");
  require(name.find_first_of("\"'\\") == std::string::npos, "a name of a tree has marks in it");
  return quote + name + quote;
}

std::string text_of_tree(const DecisionTree& tree, const std::vector<ContextQuestion>& questions) {
  std::string text = tree.unit + "[" + std::to_string(tree.state) + "]\n";
  if (tree.nodes.front().question < 0)
    return text + "   " + marked_name(tree.nodes.front().leaf, '"') + "\n\n";
  // Forks get the numbers in which they are met, no before yes.
  std::vector<int> order{0};
  std::string lines;
  for (std::size_t f = 0; f < order.size(); ++f) {
    const DecisionTree::Node& node = tree.nodes[static_cast<std::size_t>(order[f])];
    lines += (f == 0 ? "  " : " -") + std::to_string(f) + " " +
             marked_name(questions[static_cast<std::size_t>(node.question)].name, '\'');
    for (const int next : {node.no, node.yes}) {
      const DecisionTree::Node& end = tree.nodes[static_cast<std::size_t>(next)];
      if (end.question < 0) {
        lines += " " + marked_name(end.leaf, '"');
      } else {
        lines += " -" + std::to_string(order.size());
        order.push_back(next);
      }
    }
    lines += '\n';
  }
  return text + "{\n" + lines + "}\n\n";
}

}  // namespace

bool is_answered_yes(const ContextQuestion& question, const std::string& model) {
  return std::any_of(question.patterns.begin(), question.patterns.end(),
                     [&](const std::string& pattern) { return matches(pattern, model); });
}

DecisionTrees DecisionTrees::parse(const std::string& text, const std::string& name) {
  detail::require_text(text, name);
  return TreeReader(text, name).read();
}

DecisionTrees DecisionTrees::read(const std::string& path) {
  return parse(detail::read_text(path), path);
}

std::string DecisionTrees::to_text() const {
  std::string text;
  for (const ContextQuestion& question : questions) {
    text += "QS " + marked_name(question.name, '\'') + " { ";
    for (std::size_t p = 0; p < question.patterns.size(); ++p)
      text += (p == 0 ? "" : ",") + marked_name(question.patterns[p], '"');
    text += " }\n";
  }
  text += '\n';
  for (const DecisionTree& tree : trees) text += text_of_tree(tree, questions);
  return text;
}

const DecisionTree* DecisionTrees::find(const std::string& unit, int state) const {
  const auto found = std::find_if(trees.rbegin(), trees.rend(), [&](const DecisionTree& tree) {
    return tree.unit == unit && tree.state == state;
  });
  return found == trees.rend() ? nullptr : &*found;
}

const std::string& DecisionTrees::leaf_of(const DecisionTree& tree,
                                          const std::string& model) const {
  const DecisionTree::Node* node = &tree.nodes.front();
  while (node->question >= 0) {
    const ContextQuestion& question = questions[static_cast<std::size_t>(node->question)];
    node = &tree.nodes[static_cast<std::size_t>(is_answered_yes(question, model) ? node->yes
                                                                                 : node->no)];
  }
  return node->leaf;
}

}  // namespace hri::htk
