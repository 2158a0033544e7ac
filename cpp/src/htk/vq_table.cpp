// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/htk/vq_table.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "hri/core/error.hpp"
#include "htk/model_text.hpp"
#include "htk/text_lines.hpp"

namespace hri::htk {
namespace {

constexpr int kMostCodewords = detail::kMostMixtures;
constexpr int kNodesOfTable = 2 * kMostCodewords;
constexpr int kColumnsOfTable = 8191;
constexpr int kLargestId = 1000000000;
constexpr std::size_t kValuesOfTable = std::size_t{1} << 24U;
constexpr int kFullCovariance = 2;
constexpr double kLargestOfTable = 1e15;  // of means and inverse variances: distances stay finite

// TableNumbers between blanks, on whatever lines.
class TableNumbers {
 public:
  TableNumbers(const std::string& text, const std::string& name) : lines_(text, name) { advance(); }

  [[nodiscard]] bool ended() const { return ended_; }
  [[noreturn]] void refuse(const std::string& why) const { lines_.refuse(why); }

  int whole(const char* what, int low, int high) {
    advance();
    if (ended_) refuse(std::string("the file ends before ") + what);
    const auto value = static_cast<int>(lines_.whole_of(fields_[at_], low, high));
    ++at_;
    return value;
  }

  float number(const char* what) {
    advance();
    if (ended_) refuse(std::string("the file ends before ") + what);
    return static_cast<float>(lines_.number_of(fields_[at_++], kLargestOfTable));
  }

  // To the next one, so that errors name its line.
  void advance() {
    while (!ended_ && at_ >= fields_.size()) {
      ended_ = !lines_.next();
      fields_ = ended_ ? std::vector<std::string>() : lines_.fields();
      at_ = 0;
    }
  }

 private:
  detail::TextLines lines_;
  std::vector<std::string> fields_;
  std::size_t at_ = 0;
  bool ended_ = false;
};

class TableReader {
 public:
  TableReader(const std::string& text, const std::string& name) : in_(text, name) {}

  VqTable read() {
    read_header();
    std::map<int, std::size_t> places;
    std::vector<bool> known(static_cast<std::size_t>(num_nodes_), false);
    while (static_cast<int>(table_.nodes.size()) < num_nodes_) {
      VqTable::Node node = read_node();
      if (!places.emplace(node.id, table_.nodes.size()).second)
        in_.refuse("the node " + std::to_string(node.id) + " stands here again");
      if (node.codeword > 0) {
        const auto number = static_cast<std::size_t>(node.codeword) - 1;
        if (known[number]) in_.refuse("the codeword " + std::to_string(node.codeword) + " again");
        known[number] = true;
      }
      table_.nodes.push_back(std::move(node));
    }
    in_.advance();
    if (!in_.ended()) in_.refuse("there are more values than the header says");
    const auto count = std::count(known.begin(), known.end(), true);
    if (count == 0 || count > kMostCodewords ||
        !std::all_of(known.begin(), known.begin() + count, [](bool one) { return one; }))
      in_.refuse("codewords are not 1, 2, ... up to " + std::to_string(kMostCodewords));
    check_links(places);
    return std::move(table_);
  }

 private:
  void read_header() {
    const auto code = static_cast<unsigned>(in_.whole("the parameter kind", 0, 65535));
    const ParameterKind kind{static_cast<BaseKind>(code & 0x3fU),
                             static_cast<std::uint16_t>(code & ~(0x3fU | kCodeword))};
    if (code != 0) {
      if (!is_named(kind.base) || kind.base == BaseKind::anon || kind.fault() != nullptr)
        in_.refuse("the parameter kind " + std::to_string(code) + " is none");
      table_.kind = kind.plain();
    }
    table_.is_tree = in_.whole("the type", 0, 1) == 1;
    const int distance = in_.whole("the kind of covariance", 1, 5);
    if (distance == kFullCovariance) in_.refuse("full covariances are not read");
    if (distance != 1 && distance != 5) in_.refuse("the kind of covariance is none of 1, 2 and 5");
    table_.distance = static_cast<VqTable::Distance>(distance);
    num_nodes_ = in_.whole("the number of nodes", 1, kNodesOfTable);
    if (in_.whole("the number of streams", 1, 1000) != 1)
      in_.refuse("several streams are not read");
    num_columns_ = in_.whole("the width of the stream", 1, kColumnsOfTable);
    if (static_cast<std::size_t>(num_nodes_) * static_cast<std::size_t>(num_columns_) >
        kValuesOfTable)
      in_.refuse("the table has too many values");
  }

  VqTable::Node read_node() {
    if (in_.whole("the stream of a node", 1, 1000) != 1) in_.refuse("several streams are not read");
    VqTable::Node node;
    node.codeword = in_.whole("the codeword of a node", 0, num_nodes_);
    node.id = in_.whole("the number of a node", 1, kLargestId);
    node.left = in_.whole("the left node", 0, kLargestId);
    node.right = in_.whole("the right node", 0, kLargestId);
    if (!table_.is_tree && (node.codeword == 0 || node.left != 0))
      in_.refuse("a node of a list has no codeword, or a left node");
    if (table_.is_tree && (node.left == 0) != (node.right == 0))
      in_.refuse("a node of a tree has one node below it");
    if (table_.is_tree && (node.left == 0) != (node.codeword > 0))
      in_.refuse("leaves of a tree have a codeword, and forks have none");
    node.mean.resize(num_columns_);
    for (float& value : node.mean) value = in_.number("the mean of a node");
    if (table_.distance == VqTable::Distance::euclidean) return node;
    node.inverse_variance.resize(num_columns_);
    for (float& value : node.inverse_variance) {
      value = in_.number("the inverse variance of a node");
      if (!(value > 0)) in_.refuse("an inverse variance is not above 0");
    }
    return node;
  }

  // Whether every node but the first follows one that stands before it, and one only.
  void check_links(const std::map<int, std::size_t>& places) const {
    std::vector<bool> reached(table_.nodes.size(), false);
    for (std::size_t n = 0; n < table_.nodes.size(); ++n) {
      for (const int id : {table_.nodes[n].left, table_.nodes[n].right}) {
        if (id == 0) continue;
        const auto found = places.find(id);
        if (found == places.end())
          in_.refuse("there is no node " + std::to_string(id) + ", which another names");
        if (found->second <= n || reached[found->second])
          in_.refuse("the node " + std::to_string(id) + " does not follow one node before it");
        reached[found->second] = true;
      }
    }
    if (static_cast<std::size_t>(std::count(reached.begin(), reached.end(), true)) + 1 !=
        reached.size())
      in_.refuse("a node follows none");
  }

  TableNumbers in_;
  VqTable table_;
  int num_nodes_ = 0;
  int num_columns_ = 0;
};

// What the distance of a node adds to that of its columns.
double constant_of(const VqTable::Node& node) {
  return -node.inverse_variance.cast<double>().array().log().sum();
}

double distance_to(const VqTable::Node& node, double constant, const VectorF& frame) {
  const auto squares = (frame - node.mean).cast<double>().array().square();
  if (node.inverse_variance.size() == 0) return squares.sum();
  return (squares * node.inverse_variance.cast<double>().array()).sum() + constant;
}

}  // namespace

VqTable VqTable::parse(const std::string& text, const std::string& name) {
  detail::require_text(text, name);
  return TableReader(text, name).read();
}

VqTable VqTable::read(const std::string& path) { return parse(detail::read_text(path), path); }

VqTable VqTable::of_codebook(const Codebook& codebook, ParameterKind kind,
                             const VectorF& deviation) {
  require(codebook.size() <= kMostCodewords, "a table has at most 4096 codewords");
  require(deviation.size() == 0 || deviation.size() == codebook.dim(),
          "there must be a deviation a column");
  require((deviation.array() > 0).all(), "a deviation is not above 0");
  VqTable table;
  table.kind = kind.plain();
  if (deviation.size() > 0) table.distance = Distance::variances;
  for (int c = 0; c < codebook.size(); ++c) {
    Node node;
    node.codeword = node.id = c + 1;
    node.right = c + 1 < codebook.size() ? c + 2 : 0;
    node.mean = codebook.centroids().row(c);
    if (deviation.size() > 0) {
      node.mean.array() *= deviation.array();
      node.inverse_variance = deviation.array().square().inverse();
    }
    table.nodes.push_back(std::move(node));
  }
  return table;
}

std::string VqTable::to_text() const {
  require(!nodes.empty(), "a table has no node");
  const unsigned code = kind.base == BaseKind::anon ? 0U : unsigned{kind.plain().code()};
  std::string text = std::to_string(code) + " " + (is_tree ? "1 " : "0 ") +
                     std::to_string(static_cast<int>(distance)) + " " +
                     std::to_string(nodes.size()) + " 1 " + std::to_string(dim()) + "\n";
  for (const Node& node : nodes) {
    text += "1 " + std::to_string(node.codeword) + " " + std::to_string(node.id) + " " +
            std::to_string(node.left) + " " + std::to_string(node.right) + "\n";
    for (const float value : node.mean) text += " " + detail::shortest(value);
    text += '\n';
    if (node.inverse_variance.size() == 0) continue;
    for (const float value : node.inverse_variance) text += " " + detail::shortest(value);
    text += '\n';
  }
  // What is written can be read: a table that was made by hand is checked here.
  parse(text, "the table");
  return text;
}

void VqTable::write(const std::string& path) const { detail::write_text(path, to_text()); }

int VqTable::num_codewords() const {
  return static_cast<int>(std::count_if(nodes.begin(), nodes.end(),
                                        [](const Node& node) { return node.codeword > 0; }));
}

int VqTable::dim() const { return nodes.empty() ? 0 : static_cast<int>(nodes.front().mean.size()); }

std::vector<std::int32_t> VqTable::quantise(ConstMatrixRefF frames) const {
  require(!nodes.empty() && frames.cols() == dim(),
          "the frames have another number of columns than the table");
  require(frames.allFinite(), "the frames have values that are not finite");
  std::map<int, std::size_t> places;
  std::vector<double> constants;
  constants.reserve(nodes.size());
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    places.emplace(nodes[n].id, n);
    constants.push_back(constant_of(nodes[n]));
  }
  const auto distance_of_node = [&](std::size_t n, const VectorF& frame) {
    return distance_to(nodes[n], constants[n], frame);
  };
  const auto place_of = [&](int id) {
    const auto found = places.find(id);
    require(found != places.end(), "the nodes are no tree");
    return found->second;
  };
  std::vector<std::int32_t> codewords;
  codewords.reserve(static_cast<std::size_t>(frames.rows()));
  for (Eigen::Index t = 0; t < frames.rows(); ++t) {
    const VectorF frame = frames.row(t);
    std::size_t nearest = 0;
    for (std::size_t steps = 0; is_tree && nodes[nearest].codeword == 0; ++steps) {
      require(steps < nodes.size(), "the nodes are no tree");
      const std::size_t left = place_of(nodes[nearest].left);
      const std::size_t right = place_of(nodes[nearest].right);
      nearest = distance_of_node(right, frame) < distance_of_node(left, frame) ? right : left;
    }
    double best = is_tree ? 0 : distance_of_node(nearest, frame);
    for (std::size_t n = 1; n < nodes.size() && !is_tree; ++n) {
      const double found = distance_of_node(n, frame);
      if (!(found < best)) continue;
      best = found;
      nearest = n;
    }
    codewords.push_back(nodes[nearest].codeword);
  }
  return codewords;
}

}  // namespace hri::htk
