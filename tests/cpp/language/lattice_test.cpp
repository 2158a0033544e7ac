// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/language/lattice.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "hri/core/error.hpp"
#include "language/decoding_testing.hpp"

namespace hri {
namespace {

using namespace testing_data;

constexpr int kStatesOfModels = 5;
constexpr int kSilentModel = 2;
constexpr int kNumFrames = 6;
const LatticeOptions kAll{1e12, 1000000};

std::vector<int> words_of(const std::vector<DecodedWord>& words) {
  std::vector<int> models;
  for (const DecodedWord& word : words) {
    if (word.model != kSilentModel) models.push_back(word.model);
  }
  return models;
}

// A network, its lattice, and all its paths by trying.
struct Case {
  Case(const WordNetwork& network, std::uint64_t seed, const LatticeOptions& lattice_options = kAll)
      : chains(two_words_and_silence(10 * seed)),
        scores(random_scores(kNumFrames, kStatesOfModels, seed)),
        options(options_of(seed)),
        lattice(Lattice::decode(chains, network, scores, options, lattice_options)),
        plain(chains, network, options, scores) {}

  static ConnectedDecoderOptions options_of(std::uint64_t seed) {
    ConnectedDecoderOptions options;
    options.beam = 1e12;
    options.insertion_penalty = -2.0 + static_cast<double>(seed % 3);
    options.language_scale = 0.5 + static_cast<double>(seed % 2);
    return options;
  }

  // The probability of the paths for which `chosen` is true.
  template <class F>
  [[nodiscard]] double probability(double scale, F&& chosen) const {
    double sum = 0;
    double all = 0;
    for (const auto& path : plain.paths()) {
      const double weight = std::exp(scale * (path.log_score - plain.log_score()));
      all += weight;
      if (chosen(path.words)) sum += weight;
    }
    return sum / all;
  }

  std::vector<WordChain> chains;
  MatrixF scores;
  ConnectedDecoderOptions options;
  Lattice lattice;
  PlainDecoder plain;
};

template <class F>
void for_every_case(F&& f) {
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    for (const WordNetwork& network : networks_of_two_words()) f(Case(network, seed), network);
  }
}

TEST(Lattice, HasTheBestSentenceOfTheDecoder) {
  for_every_case([](const Case& c, const WordNetwork& network) {
    ConnectedDecoder decoder(c.chains, network, c.options);
    for (Eigen::Index t = 0; t < c.scores.rows(); ++t) decoder.push(row_span(c.scores, t));
    const DecodedSentence expected = decoder.finish();
    const DecodedSentence found = c.lattice.best();
    EXPECT_TRUE(found.complete);
    EXPECT_NEAR(found.log_score, expected.log_score, 1e-9);
    ASSERT_EQ(found.words.size(), expected.words.size());
    for (std::size_t i = 0; i < found.words.size(); ++i) {
      EXPECT_EQ(found.words[i].model, expected.words[i].model);
      EXPECT_EQ(found.words[i].first_frame, expected.words[i].first_frame);
      EXPECT_EQ(found.words[i].last_frame, expected.words[i].last_frame);
      EXPECT_NEAR(found.words[i].log_score, expected.words[i].log_score, 1e-9);
    }
  });
}

TEST(Lattice, OrdersAllSentencesAsTryingThemDoes) {
  std::size_t most = 0;
  for_every_case([&](const Case& c, const WordNetwork&) {
    std::map<std::vector<int>, double> best;
    for (const auto& path : c.plain.paths()) {
      const auto place = best.emplace(words_of(path.words), kNever).first;
      place->second = std::max(place->second, path.log_score);
    }
    const std::vector<DecodedSentence> found = c.lattice.n_best(1000);
    ASSERT_EQ(found.size(), std::min<std::size_t>(1000, best.size()));
    for (std::size_t i = 0; i < found.size(); ++i) {
      const auto expected = best.find(words_of(found[i].words));
      ASSERT_NE(expected, best.end());
      EXPECT_NEAR(found[i].log_score, expected->second, 1e-9);
      if (i > 0) {
        EXPECT_LE(found[i].log_score, found[i - 1].log_score + 1e-9);
      }
      best.erase(expected);  // none is met twice
    }
    const std::vector<DecodedSentence> three = c.lattice.n_best(3);
    EXPECT_EQ(three.size(), std::min<std::size_t>(3, found.size()));
    most = std::max(most, found.size());
  });
  EXPECT_GE(most, 15U);  // of at most three words
}

// Of all of them the sums differ by their rounding at most.
TEST(Lattice, FindsManySentencesOfOneScore) {
  WordChain chain;
  chain.log_start = VectorD::Zero(1);
  chain.log_transition = MatrixD::Constant(1, 1, std::log(0.3));
  chain.log_exit = VectorD::Constant(1, std::log(0.3));
  constexpr int kFrames = 40;
  const MatrixF scores = MatrixF::Constant(kFrames, 2, -0.1F);
  const Lattice lattice =
      Lattice::decode({chain, chain}, WordNetwork::loop(2), scores, ConnectedDecoderOptions());
  std::set<std::vector<int>> different;
  for (const DecodedSentence& found : lattice.n_best(300)) {
    std::vector<int> words;
    for (const DecodedWord& word : found.words) words.push_back(word.model);
    different.insert(words);
    EXPECT_NEAR(found.log_score, kFrames * (std::log(0.3) - 0.1), 1e-5);
  }
  EXPECT_EQ(different.size(), 300U);
}

TEST(Lattice, SharesOneOfProbabilityInEveryFrame) {
  for_every_case([](const Case& c, const WordNetwork&) {
    const VectorD shares = c.lattice.posteriors(0.3);
    for (int t = 0; t < kNumFrames; ++t) {
      double sum = 0;
      for (std::size_t a = 0; a < c.lattice.arcs().size(); ++a) {
        const Lattice::Arc& arc = c.lattice.arcs()[a];
        if (c.lattice.nodes()[static_cast<std::size_t>(arc.from)].frame <= t &&
            t < c.lattice.nodes()[static_cast<std::size_t>(arc.to)].frame)
          sum += shares[static_cast<Eigen::Index>(a)];
      }
      EXPECT_NEAR(sum, 1, 1e-9);
    }
  });
}

TEST(Lattice, IsAsSureOfAWordAsAllPathsThatHaveItThere) {
  constexpr double kScale = 0.5;
  for_every_case([](const Case& c, const WordNetwork&) {
    const std::vector<DecodedWord> words = c.lattice.best().words;
    const std::vector<double> found = c.lattice.confidences(words, kScale);
    ASSERT_EQ(found.size(), words.size());
    for (std::size_t i = 0; i < words.size(); ++i) {
      double most = 0;
      for (std::int64_t t = words[i].first_frame; t < words[i].last_frame; ++t) {
        const auto has_it = [&](const std::vector<DecodedWord>& path) {
          return std::any_of(path.begin(), path.end(), [&](const DecodedWord& word) {
            return word.model == words[i].model && word.first_frame <= t && t < word.last_frame;
          });
        };
        most = std::max(most, c.probability(kScale, has_it));
      }
      EXPECT_NEAR(found[i], most, 1e-9);
    }
  });
}

TEST(Lattice, GivesOneWordAPlaceInAConfusionNetwork) {
  int num_words = 0;
  for_every_case([&](const Case& c, const WordNetwork&) {
    const std::vector<ConfusionSlot> slots = c.lattice.confusion_network(0.2);
    std::int64_t frame = 0;
    for (const ConfusionSlot& slot : slots) {
      EXPECT_GE(slot.first_frame, frame);
      EXPECT_LT(slot.first_frame, slot.last_frame);
      frame = slot.last_frame;
      double sum = 0;
      double before = 1;
      for (const ConfusionSlot::Entry& entry : slot.entries) {
        EXPECT_NE(entry.model, kSilentModel);
        EXPECT_LE(entry.probability, before);
        before = entry.probability;
        sum += entry.probability;
        num_words += entry.model == WordNetwork::kNull ? 0 : 1;
      }
      EXPECT_NEAR(sum, 1, 1e-9);
    }
  });
  EXPECT_GT(num_words, 100);
}

TEST(Lattice, CountsThePathsOfASlotOfOneWord) {
  // One word whose frames are all: its slot has what every path says of it.
  const Case c(WordNetwork::sequence(2, 1), 1);
  const std::vector<ConfusionSlot> slots = c.lattice.confusion_network(1);
  ASSERT_EQ(slots.size(), 1U);
  for (const ConfusionSlot::Entry& entry : slots[0].entries) {
    const auto is_it = [&](const std::vector<DecodedWord>& path) {
      return path.front().model == entry.model;
    };
    EXPECT_NEAR(entry.probability, c.probability(1, is_it), 1e-9);
  }
}

TEST(Lattice, KeepsWhatIsWithinTheBeamAndNoMore) {
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    const WordNetwork network = WordNetwork::loop(2, kSilentModel);
    constexpr double kBeam = 4;
    const Case c(network, seed, {kBeam, 1000000});
    // A word in a place is kept where a path through it is within the beam.
    std::map<std::vector<std::int64_t>, double> best;
    for (const auto& path : c.plain.paths()) {
      for (const DecodedWord& word : path.words) {
        const auto place =
            best.emplace(std::vector<std::int64_t>{word.model, word.first_frame, word.last_frame},
                         kNever)
                .first;
        place->second = std::max(place->second, path.log_score);
      }
    }
    const auto num_near = std::count_if(best.begin(), best.end(), [&](const auto& entry) {
      return entry.second >= c.plain.log_score() - kBeam;
    });
    const auto num_kept = std::count_if(
        c.lattice.arcs().begin(), c.lattice.arcs().end(), [&](const Lattice::Arc& arc) {
          return c.lattice.nodes()[static_cast<std::size_t>(arc.to)].model != WordNetwork::kNull;
        });
    EXPECT_EQ(num_kept, num_near);
    EXPECT_LT(static_cast<std::size_t>(num_near), best.size());
  }
}

TEST(Lattice, NarrowsItsBeamWhereThereAreTooManyArcs) {
  const Case whole(WordNetwork::loop(2, kSilentModel), 2);
  const Case small(WordNetwork::loop(2, kSilentModel), 2, {1e12, 30});
  EXPECT_LE(small.lattice.arcs().size(), 30U);
  EXPECT_GT(whole.lattice.arcs().size(), 60U);
  EXPECT_NEAR(small.lattice.best().log_score, whole.plain.log_score(), 1e-9);
  const Case one(WordNetwork::loop(2, kSilentModel), 2, {1e12, 1});
  EXPECT_EQ(one.lattice.n_best(10).size(), 1U);
}

TEST(Lattice, IsEmptyWhereNoSentenceFits) {
  const auto chains = two_words_and_silence(1);
  const MatrixF two = random_scores(2, kStatesOfModels, 1);
  const Lattice none = Lattice::decode(chains, WordNetwork::sequence(2, 3), two);
  EXPECT_TRUE(none.empty());
  EXPECT_FALSE(none.best().complete);
  EXPECT_TRUE(none.n_best(3).empty());
  EXPECT_TRUE(none.confusion_network(1).empty());
  EXPECT_EQ(none.posteriors(1).size(), 0);
  const MatrixF nothing(0, kStatesOfModels);
  const Lattice silent = Lattice::decode(chains, WordNetwork::loop(2), nothing);
  ASSERT_EQ(silent.n_best(3).size(), 1U);
  EXPECT_TRUE(silent.best().words.empty());
}

TEST(Lattice, RefusesWhatIsNone) {
  const Lattice::Node start;
  const Lattice::Node word{0, 3, false};
  EXPECT_NO_THROW(Lattice({start, word}, {{0, 1, -1, 0}}));
  EXPECT_THROW(Lattice({start, word}, {}), InvalidArgument);
  EXPECT_THROW(Lattice({start, word}, {{1, 0, -1, 0}}), InvalidArgument);
  EXPECT_THROW(Lattice({start, word}, {{0, 2, -1, 0}}), InvalidArgument);
  EXPECT_THROW(Lattice({start, word}, {{0, 1, std::nan(""), 0}}), InvalidArgument);
  EXPECT_THROW(Lattice({start, {0, 0, false}}, {{0, 1, -1, 0}}), InvalidArgument);
  EXPECT_THROW(Lattice({start, {-2, 3, false}}, {{0, 1, -1, 0}}), InvalidArgument);
  EXPECT_THROW(Lattice({{-1, 4, false}, word}, {{0, 1, -1, 0}}), InvalidArgument);
  EXPECT_THROW(Lattice({start, word, word}, {{0, 1, -1, 0}, {0, 2, -1, 0}}), InvalidArgument);
  const Lattice lattice({start, word}, {{0, 1, -1, 0}});
  EXPECT_THROW((void)lattice.n_best(0), InvalidArgument);
  EXPECT_THROW((void)lattice.posteriors(0), InvalidArgument);
  const auto chains = two_words_and_silence(1);
  EXPECT_THROW(Lattice::decode(chains, WordNetwork::loop(2), MatrixF::Zero(3, 4)), InvalidArgument);
  MatrixF bad = random_scores(3, kStatesOfModels, 1);
  bad(1, 1) = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(Lattice::decode(chains, WordNetwork::loop(2), bad), InvalidArgument);
}

}  // namespace
}  // namespace hri
