// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/htk/dictionary.hpp"

#include <utility>

#include "hri/core/error.hpp"
#include "htk/text_lines.hpp"

namespace hri::htk {
namespace {

bool in_brackets(const std::string& field) {
  return field.size() >= 2 && field.front() == '[' && field.back() == ']';
}

// Fills an entry from its line; gives "", or what is wrong with it.
std::string read_entry(const std::string& line, Pronunciation* entry) {
  std::vector<std::string> fields;
  std::vector<bool> marked;
  if (const char* fault = detail::split_fields(line, &fields, &marked); fault != nullptr)
    return fault;
  entry->word = fields[0];
  if (entry->word.empty()) return "a word is empty";
  std::size_t at = 1;
  if (at < fields.size() && !marked[at] && in_brackets(fields[at])) {
    entry->has_output = true;
    entry->output = fields[at].substr(1, fields[at].size() - 2);
    ++at;
  }
  // A number that is all that is left is the name of a model.
  double probability = 0;
  if (at + 1 < fields.size() && !marked[at] && detail::parse_number(fields[at], &probability)) {
    if (!(probability > 0 && probability <= 1))
      return "the probability of a pronunciation is outside 0..1, 0 excluded";
    entry->probability = probability;
    ++at;
  }
  for (; at < fields.size(); ++at) {
    if (fields[at].empty()) return "the name of a model is empty";
    entry->models.push_back(fields[at]);
  }
  return entry->models.empty() ? "'" + entry->word + "' has no models" : "";
}

// Whether the line that an entry was read from says what it holds now.
bool is_said_by_its_line(const Pronunciation& entry) {
  if (entry.text.find_first_not_of(detail::kBlanks) == std::string::npos ||
      entry.text.find_first_of("\r\n") != std::string::npos)
    return false;
  Pronunciation again;
  return read_entry(entry.text, &again).empty() && again.word == entry.word &&
         again.has_output == entry.has_output && again.output == entry.output &&
         again.probability == entry.probability && again.models == entry.models;
}

// In quotation marks also where it would be read as something else.
std::string field_text(const std::string& name, const std::string& what) {
  detail::require_name(name, what);
  double value = 0;
  const bool special =
      in_brackets(name) || name.front() == '#' || detail::parse_number(name, &value);
  return special ? detail::in_quotes(name) : detail::quoted(name);
}

}  // namespace

Dictionary Dictionary::parse(const std::string& text, const std::string& name) {
  detail::require_text(text, name);
  detail::TextLines lines(text, name);
  Dictionary dictionary;
  while (lines.next()) {
    if (lines.line().empty()) continue;
    Pronunciation entry;
    if (const std::string fault = read_entry(lines.line(), &entry); !fault.empty())
      lines.refuse(fault);
    entry.line = lines.number();
    entry.text = lines.line();
    dictionary.entries.push_back(std::move(entry));
  }
  return dictionary;
}

Dictionary Dictionary::read(const std::string& path) {
  return parse(detail::read_text(path), path);
}

std::string Dictionary::to_text() const {
  std::string text;
  for (const Pronunciation& entry : entries) {
    require(entry.probability > 0 && entry.probability <= 1,
            "the probability of a pronunciation is outside 0..1, 0 excluded");
    require(!entry.models.empty(), "a pronunciation has no models");
    if (is_said_by_its_line(entry)) {
      text += entry.text + "\n";
      continue;
    }
    text += field_text(entry.word, "the word");
    if (entry.has_output) {
      if (!entry.output.empty()) detail::require_name(entry.output, "the output");
      require(entry.output.find_first_of(" \t\\") == std::string::npos,
              "the output of a word has blanks or backslashes in it");
      text += " [" + entry.output + "]";
    }
    if (entry.probability != 1) text += " " + detail::shortest(entry.probability);
    for (const std::string& model : entry.models) text += " " + field_text(model, "the model");
    text += '\n';
  }
  return text;
}

void Dictionary::write(const std::string& path) const { detail::write_text(path, to_text()); }

std::map<std::string, std::vector<int>> Dictionary::by_word() const {
  std::map<std::string, std::vector<int>> found;
  for (std::size_t i = 0; i < entries.size(); ++i)
    found[entries[i].word].push_back(static_cast<int>(i));
  return found;
}

}  // namespace hri::htk
