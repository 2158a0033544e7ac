// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/recognition/subword/subword_recognizer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <utility>

#include "hri/core/error.hpp"
#include "recognition/sentence/sentence_front_end.hpp"

namespace hri {
namespace {

constexpr float kImpossible = -std::numeric_limits<float>::infinity();
// Of a word that has more states than the recording frames, a frame.
constexpr double kLeastScore = -1e4;

bool goes_by_one(const GaussianMixtureHmm& model) {
  const Topology& topology = model.chain().topology();
  return topology.kind == Topology::Kind::left_right && topology.max_jump == 1;
}

}  // namespace

int UnitModels::find(const std::string& name) const {
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? -1 : static_cast<int>(found - names.begin());
}

SubwordRecognizer::SubwordRecognizer(const SubwordRecognizerOptions& options,
                                     htk::Dictionary lexicon, UnitModels units,
                                     const Calibration& calibration,
                                     std::vector<std::string> unrecorded)
    : options_(validated(options)),
      lexicon_(std::move(lexicon)),
      units_(std::move(units)),
      calibration_(calibration),
      unrecorded_(std::move(unrecorded)),
      front_end_(std::make_shared<const detail::SentenceFrontEnd>(options_.words)) {
  require(units_.names.size() == units_.models.size() &&
              units_.names.size() == units_.final_stays.size(),
          "units: names, models and final_stays differ in number");
  std::stable_sort(lexicon_.entries.begin(), lexicon_.entries.end(),
                   [](const auto& a, const auto& b) { return a.word < b.word; });
  std::vector<std::string> words;
  words.reserve(lexicon_.entries.size());
  for (const htk::Pronunciation& entry : lexicon_.entries) words.push_back(entry.word);
  labels_ = sorted_labels(words);
  bonuses_ = VectorF::Zero(static_cast<Eigen::Index>(labels_.size()));
  for (const std::string& word : unrecorded_) {
    require(std::binary_search(labels_.begin(), labels_.end(), word),
            "an unrecorded word is not in the lexicon");
    bonuses_[label_index(labels_, word)] = static_cast<float>(options_.unrecorded_bonus);
  }
  emissions_ = std::make_shared<const GaussianEmissions>(units_.models);
  require(emissions_->dim() == front_end_->num_features(),
          "the models have another dimension than the front end");
  int column = 0;
  for (std::size_t u = 0; u < units_.models.size(); ++u) {
    require(goes_by_one(units_.models[u]), "a model of a unit is not left-right without skips");
    require(units_.final_stays[u] >= 0 && units_.final_stays[u] < 1,
            "final_stays must lie in 0..1, 1 excluded");
    first_columns_.push_back(column);
    const bool is_shared = units_.names[u].find(kOwnUnit) == std::string::npos;
    for (int s = 0; s < units_.models[u].num_states(); ++s, ++column) {
      if (is_shared) shared_columns_.push_back(column);
    }
  }
  for (const htk::Pronunciation& entry : lexicon_.entries) add_path(entry);
}

void SubwordRecognizer::add_path(const htk::Pronunciation& entry) {
  require(!entry.models.empty(), "a word has no unit");
  Path path;
  path.label = label_index(labels_, entry.word);
  path.log_weight = std::log(entry.probability);
  const auto add = [&](const std::string& name) {
    const int unit = units_.find(name);
    if (unit < 0) {
      fail(ErrorKind::invalid_argument,
           "there is no unit '" + name + "', of the word '" + entry.word + "'");
    }
    const GaussianMixtureHmm& model = units_.models[static_cast<std::size_t>(unit)];
    for (int s = 0; s < model.num_states(); ++s) {
      const double stay = s + 1 < model.num_states()
                              ? model.chain().transition()(s, s)
                              : units_.final_stays[static_cast<std::size_t>(unit)];
      path.columns.push_back(first_columns_[static_cast<std::size_t>(unit)] + s);
      path.log_stay.push_back(static_cast<float>(std::log(stay)));
      path.log_go.push_back(static_cast<float>(std::log1p(-stay)));
    }
  };
  add(UnitModels::kSilence);
  for (const std::string& name : entry.models) add(name);
  add(UnitModels::kSilence);
  paths_.push_back(std::move(path));
}

VectorF SubwordRecognizer::scores_of(ConstMatrixRefF frames) const {
  MatrixF emissions(frames.rows(), emissions_->num_states());
  emissions_->compute(frames, emissions);
  // Relative to the best state of each frame, which also keeps the digits of float. Units of single
  // words are left aside: the scores of the others stay as they were before these came.
  for (Eigen::Index t = 0; t < emissions.rows(); ++t) {
    float most = kImpossible;
    for (const int column : shared_columns_) most = std::max(most, emissions(t, column));
    emissions.row(t).array() -= most;
  }
  VectorF scores =
      VectorF::Constant(static_cast<Eigen::Index>(labels_.size()), static_cast<float>(kLeastScore));
  std::vector<float> best;
  for (const Path& path : paths_) {
    const std::size_t n = path.columns.size();
    best.assign(n, kImpossible);
    for (Eigen::Index t = 0; t < emissions.rows(); ++t) {
      const float* row = emissions.row(t).data();
      for (std::size_t s = n; s-- > 0;) {
        const float stayed = best[s] + path.log_stay[s];
        const float came = s > 0 ? best[s - 1] + path.log_go[s - 1] : (t == 0 ? 0.0F : kImpossible);
        best[s] = std::max(stayed, came) + row[path.columns[s]];
      }
    }
    const double whole = path.log_weight + static_cast<double>(best[n - 1] + path.log_go[n - 1]);
    const auto score =
        static_cast<float>(std::max(kLeastScore, whole / static_cast<double>(emissions.rows())));
    scores[path.label] = std::max(scores[path.label], score);
  }
  return scores + bonuses_;
}

VectorF SubwordRecognizer::scores(Span<const float> audio, int sample_rate_hz) const {
  detail::CutSentence word = front_end_->cut(audio, sample_rate_hz);
  if (word.samples.empty()) return {};
  return scores_of(front_end_->frames(std::move(word.samples)));
}

Decision SubwordRecognizer::recognise(Span<const float> audio, int sample_rate_hz) const {
  detail::CutSentence word = front_end_->cut(audio, sample_rate_hz);
  Decision decision;
  if (!word.samples.empty()) {
    const VectorF scores = scores_of(front_end_->frames(std::move(word.samples)));
    decision = calibration_.decide(scores, scores.maxCoeff(), labels_);
  }
  decision.notes.insert(decision.notes.begin(), word.notes.begin(), word.notes.end());
  return decision;
}

SubwordRecognizer SubwordRecognizer::without_word(const std::string& label) const {
  const auto found = std::lower_bound(labels_.begin(), labels_.end(), label);
  if (found == labels_.end() || *found != label)
    fail(ErrorKind::invalid_argument, "there is no word '" + label + "'");
  require(labels_.size() > 2, "two words at least must be left");
  htk::Dictionary rest;
  std::set<std::string> used;
  for (const htk::Pronunciation& entry : lexicon_.entries) {
    if (entry.word == label) continue;
    used.insert(entry.models.begin(), entry.models.end());
    rest.entries.push_back(entry);
  }
  UnitModels kept;
  for (std::size_t u = 0; u < units_.names.size(); ++u) {
    const std::string& name = units_.names[u];
    if (name.find(kOwnUnit) != std::string::npos && used.count(name) == 0) continue;
    kept.names.push_back(name);
    kept.models.push_back(units_.models[u]);
    kept.final_stays.push_back(units_.final_stays[u]);
  }
  std::vector<std::string> unrecorded = unrecorded_;
  unrecorded.erase(std::remove(unrecorded.begin(), unrecorded.end(), label), unrecorded.end());
  return {options_, std::move(rest), std::move(kept),
          calibration_.without_class(static_cast<int>(found - labels_.begin())),
          std::move(unrecorded)};
}

}  // namespace hri
