// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// NGramModel to and from the text of ARPA files.
#include <cmath>
#include <iomanip>
#include <locale>
#include <sstream>
#include <utility>

#include "hri/core/error.hpp"
#include "hri/io/file.hpp"
#include "hri/language/ngram_model.hpp"
#include "language/ngram_words.hpp"

namespace hri {
class ArpaReader {
 public:
  ArpaReader(const std::string& text, const std::string& name) : text_(text), name_(name) {}

  NGramModel read() {
    while (next() && line_ != "\\data\\") {
    }
    if (line_ != "\\data\\") refuse("has no \\data\\");
    read_counts();
    for (std::size_t n = 0; n < counts_.size(); ++n) read_section(n);
    if (line_ != "\\end\\") refuse("has no \\end\\ here");
    if (model_.start_ < 0) refuse("has no unigram <s>");
    if (model_.end_ < 0) refuse("has no unigram </s>");
    model_.text_ = text_;
    return std::move(model_);
  }

 private:
  [[noreturn]] void refuse(const std::string& why) const {
    fail(ErrorKind::format, name_ + ": line " + std::to_string(number_) + ": " + why);
  }

  // The next line that is not empty, without white space at its ends; false after the last.
  bool next() {
    constexpr const char* kBlank = " \t\r";
    while (at_ < text_.size()) {
      const std::size_t end = std::min(text_.find('\n', at_), text_.size());
      line_ = text_.substr(at_, end - at_);
      at_ = end + 1;
      ++number_;
      const std::size_t first = line_.find_first_not_of(kBlank);
      if (first == std::string::npos) continue;
      line_ = line_.substr(first, line_.find_last_not_of(kBlank) + 1 - first);
      return true;
    }
    line_.clear();
    return false;
  }

  void read_counts() {
    while (next() && line_.rfind("ngram ", 0) == 0) {
      const std::size_t equals = line_.find('=');
      const std::string order = std::to_string(counts_.size() + 1);
      if (equals == std::string::npos || trimmed(line_.substr(6, equals - 6)) != order)
        refuse("expected 'ngram " + order + "=...'");
      if (counts_.size() == static_cast<std::size_t>(NGramModel::kMaxOrder))
        refuse("has an order above " + std::to_string(NGramModel::kMaxOrder));
      const std::string count = trimmed(line_.substr(equals + 1));
      // A count that the text cannot hold is found by its section; here it has to be a number.
      if (count.empty() || count.size() > 12 ||
          count.find_first_not_of("0123456789") != std::string::npos)
        refuse("'" + count + "' is no count");
      counts_.push_back(std::stoll(count));
    }
    if (counts_.empty()) refuse("has no counts of n-grams");
    model_.ngrams_.resize(counts_.size());
  }

  static std::string trimmed(const std::string& text) {
    const std::size_t first = text.find_first_not_of(" \t");
    if (first == std::string::npos) return {};
    return text.substr(first, text.find_last_not_of(" \t") + 1 - first);
  }

  void read_section(std::size_t n) {
    const std::string title = "\\" + std::to_string(n + 1) + "-grams:";
    if (line_ != title) refuse("expected '" + title + "'");
    auto& ngrams = model_.ngrams_[n];
    while (next() && line_.front() != '\\') read_ngram(n + 1, &ngrams);
    if (static_cast<long long>(ngrams.size()) != counts_[n]) {
      refuse("there are " + std::to_string(ngrams.size()) + " " + std::to_string(n + 1) +
             "-grams above, \\data\\ says " + std::to_string(counts_[n]));
    }
    if (n == 0) model_.index_words();
  }

  void read_ngram(std::size_t order, std::map<NGramModel::NGram, NGramModel::Entry>* ngrams) {
    std::vector<std::string> fields = split();
    if (fields.size() != order + 1 && fields.size() != order + 2)
      refuse("expected a probability, " + std::to_string(order) + " words and perhaps a back-off");
    NGramModel::Entry entry;
    entry.log10_probability = number(fields[0]);
    if (entry.log10_probability > 0) refuse("a probability is above 1: " + fields[0]);
    if (fields.size() == order + 2) entry.log10_backoff = number(fields.back());
    NGramModel::NGram ngram;
    for (std::size_t i = 1; i <= order; ++i) ngram.push_back(word_number(fields[i], order));
    if (!ngrams->emplace(std::move(ngram), entry).second) refuse("an n-gram stands here again");
  }

  // Unigrams number the words in their order.
  std::int32_t word_number(const std::string& word, std::size_t order) {
    if (order == 1) {
      if (const char* fault = detail::word_fault(word); fault != nullptr)
        refuse(std::string("a word ") + fault);
      const auto [found, is_new] =
          numbers_.emplace(word, static_cast<std::int32_t>(numbers_.size()));
      if (is_new) model_.words_.push_back(word);
      return found->second;
    }
    const auto found = numbers_.find(word);
    if (found == numbers_.end()) refuse("'" + word + "' is no unigram");
    return found->second;
  }

  [[nodiscard]] std::vector<std::string> split() const {
    std::vector<std::string> fields;
    for (std::size_t at = line_.find_first_not_of(" \t"); at != std::string::npos;) {
      const std::size_t end = line_.find_first_of(" \t", at);
      fields.push_back(line_.substr(at, end == std::string::npos ? end : end - at));
      at = end == std::string::npos ? end : line_.find_first_not_of(" \t", end);
    }
    return fields;
  }

  [[nodiscard]] double number(const std::string& text) const {
    constexpr double kLargest = 1e6;
    std::istringstream in(text);
    in.imbue(std::locale::classic());  // a program may have set a locale with decimal commas
    double value = 0;
    if (!(in >> value) || in.peek() != std::istringstream::traits_type::eof() ||
        !(std::fabs(value) <= kLargest))
      refuse("'" + text + "' is no number of an n-gram");
    return value;
  }

  const std::string& text_;
  const std::string& name_;
  std::size_t at_ = 0;
  std::int64_t number_ = 0;  // of the line, from 1
  std::string line_;
  std::vector<long long> counts_;
  std::map<std::string, std::int32_t> numbers_;
  NGramModel model_;
};

NGramModel NGramModel::parse(const std::string& text, const std::string& name) {
  return ArpaReader(text, name).read();
}

NGramModel NGramModel::load(const std::string& path) {
  const std::vector<std::uint8_t> bytes = read_file(path);
  return parse({bytes.begin(), bytes.end()}, path);
}

std::string NGramModel::to_arpa() const {
  if (!text_.empty()) return text_;
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out << std::setprecision(17) << "\\data\\\n";
  for (int n = 1; n <= order(); ++n) out << "ngram " << n << "=" << num_ngrams(n) << "\n";
  for (int n = 1; n <= order(); ++n) {
    out << "\n\\" << n << "-grams:\n";
    for (const auto& [ngram, entry] : ngrams_[static_cast<std::size_t>(n - 1)]) {
      out << entry.log10_probability;
      for (std::size_t i = 0; i < ngram.size(); ++i)
        out << (i == 0 ? '\t' : ' ') << words_[static_cast<std::size_t>(ngram[i])];
      if (n < order()) out << '\t' << entry.log10_backoff;
      out << '\n';
    }
  }
  out << "\n\\end\\\n";
  return out.str();
}

void NGramModel::save(const std::string& path) const {
  const std::string text = to_arpa();
  const std::vector<std::uint8_t> bytes(text.begin(), text.end());
  write_file_atomically(path, bytes);
}

}  // namespace hri
