#include "bench/statistics/preferences.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/random/stream.h"

namespace etude {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// The key of a page of pairs of "a" and "b"; the metric is lower for a; a is on the left in even pairs.
BlindKey KeyOf(int pairs) {
  BlindKey key{.page = "page", .seed = "1", .worlds = pairs};
  for (int i = 0; i < pairs; ++i) {
    const bool is_even = i % 2 == 0;
    BlindKey::Pair pair{.scenario = "s", .world = std::to_string(i), .left = is_even ? "a" : "b", .right = is_even ? "b" : "a"};
    pair.metrics.push_back({"jump_cm", false, is_even ? 1.0 : 2.0, is_even ? 2.0 : 1.0});
    pair.metrics.push_back({"clean_share", true, is_even ? 0.0 : 1.0, is_even ? 1.0 : 0.0});
    pair.metrics.push_back({"live", true, 1.0, 1.0 + 1e-12});
    pair.metrics.push_back({"settle_s", false, std::nullopt, 1.0});
    key.pairs.push_back(std::move(pair));
  }
  return key;
}

/// Returns answers that prefer a in the first `wins` pairs, and b in the others.
BlindAnswers Prefers(const BlindKey& key, const std::string& rater, int wins) {
  BlindAnswers answers{key.page, rater, {}};
  for (std::size_t i = 0; i < key.pairs.size(); ++i) {
    const std::string wanted = static_cast<int>(i) < wins ? "a" : "b";
    answers.preferred.push_back(key.pairs[i].left == wanted ? "left" : "right");
  }
  return answers;
}

TEST(BradleyTerry, IsTheShareOfWinsWithTwoItems) {
  const auto strengths = FitBradleyTerry({{0, 7}, {3, 0}});
  EXPECT_NEAR(strengths[0], 0.7, 1e-12);
  EXPECT_NEAR(strengths[1], 0.3, 1e-12);
  EXPECT_THAT(FitBradleyTerry({{0, 5}, {0, 0}}), ElementsAre(1, 0));
}

TEST(BradleyTerry, GivesEqualStrengthsToASymmetricRoundRobin) {
  for (double strength : FitBradleyTerry({{0, 4, 6}, {6, 0, 4}, {4, 6, 0}})) EXPECT_NEAR(strength, 1.0 / 3, 1e-9);
}

TEST(BradleyTerry, RecoversPlantedStrengths) {
  // Strengths .1, .2, .3, .4 are recovered exactly from expected wins; from drawn wins within three standard errors.
  const std::vector<double> planted = {0.1, 0.2, 0.3, 0.4};
  WinTable exact(4, std::vector<double>(4)), drawn = exact;
  RandomStream dice({7, "planted", 0}, "wins");
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      if (i != j) exact[i][j] = 100 * planted[i] / (planted[i] + planted[j]);
    }
    for (std::size_t j = 0; j < i; ++j) {
      for (int n = 0; n < 2000; ++n) {
        const bool wins = dice.Chance(planted[i] / (planted[i] + planted[j]));
        drawn[wins ? i : j][wins ? j : i] += 1;
      }
    }
  }
  const auto fitted = FitBradleyTerry(exact), found = FitBradleyTerry(drawn);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(fitted[i], planted[i], 1e-9);
    EXPECT_NEAR(found[i], planted[i], 0.02);
  }
}

TEST(Preferences, CountAnswersAndMetricsThatAgree) {
  BlindFiles files{{KeyOf(10)}, {}};
  files.answers.push_back(Prefers(files.keys[0], "anna", 8));
  files.answers[0].preferred[9] = "same";
  files.answers.push_back(Prefers(files.keys[0], "ben", 8));
  files.answers[1].preferred[8] = "";
  const Preferences found = MeasurePreferences(files, 1);
  EXPECT_EQ(found.raters, 2);
  EXPECT_EQ(found.answers, 19);
  EXPECT_EQ(found.same, 1);
  EXPECT_EQ(found.without, 1);
  ASSERT_EQ(found.methods.size(), 2u);
  EXPECT_EQ(found.methods[0].method, "a");
  EXPECT_EQ(found.methods[0].wins, 16.5);
  EXPECT_NEAR(*found.methods[0].share, 16.5 / 19, 1e-8);
  EXPECT_FALSE(found.methods[0].interval);  // two raters are too few
  ASSERT_EQ(found.metrics.size(), 4u);
  EXPECT_EQ(found.metrics[0].metric, "jump_cm");
  EXPECT_EQ(found.metrics[0].agreed, 8);
  EXPECT_EQ(found.metrics[0].decided, 10);
  EXPECT_EQ(found.metrics[1].metric, "clean_share");  // this metric prefers b
  EXPECT_EQ(found.metrics[1].agreed, 2);
  EXPECT_EQ(found.metrics[2].equal, 10);  // the values differ by rounding only
  EXPECT_FALSE(found.metrics[2].interval);
  EXPECT_EQ(found.metrics[3].missing, 10);
  EXPECT_THAT(found.one_sided, IsEmpty());
}

TEST(Preferences, HaveIntervalsOverRatersThatCoverThePlantedShare) {
  // Raters' own shares are uniform in 0.4 … 0.8, so the bootstrap must draw raters, not answers.
  int covered = 0, beyond_half = 0;
  constexpr int kStudies = 100;
  for (int study = 0; study < kStudies; ++study) {
    BlindFiles files{{KeyOf(40)}, {}};
    RandomStream dice({3, "raters", study}, "answers");
    for (int rater = 0; rater < 12; ++rater) {
      const double own = 0.6 + 0.2 * (2 * dice.Uniform() - 1);
      BlindAnswers answers{"page", std::to_string(rater), {}};
      for (const BlindKey::Pair& pair : files.keys[0].pairs) {
        answers.preferred.push_back((pair.left == "a") == dice.Chance(own) ? "left" : "right");
      }
      files.answers.push_back(std::move(answers));
    }
    const Preferences found = MeasurePreferences(files, 1);
    const auto& a = *std::ranges::find(found.methods, "a", &PreferredMethod::method);
    covered += a.interval->low <= 0.6 && 0.6 <= a.interval->high;
    beyond_half += a.interval->low > 0.5;
  }
  EXPECT_GE(covered, 86);
  EXPECT_LE(covered, 100);
  EXPECT_GE(beyond_half, 60);
}

TEST(Preferences, OfRatersWhoThrowCoinsAgreeWithNoMetric) {
  int excludes_half = 0;
  for (int study = 0; study < 100; ++study) {
    BlindFiles files{{KeyOf(40)}, {}};
    RandomStream dice({4, "coins", study}, "answers");
    for (int rater = 0; rater < 7; ++rater) {
      BlindAnswers answers{"page", std::to_string(rater), {}};
      for (int i = 0; i < 40; ++i) answers.preferred.push_back(dice.Chance(0.5) ? "left" : "right");
      files.answers.push_back(std::move(answers));
    }
    const Preferences found = MeasurePreferences(files, 1);
    excludes_half += found.metrics[0].interval->low > 0.5 || found.metrics[0].interval->high < 0.5;
  }
  EXPECT_LE(excludes_half, 12);
}

TEST(Preferences, NameARaterWhoAlwaysAnswersLeft) {
  BlindFiles files{{KeyOf(40)}, {}};
  files.answers.push_back({"page", "lazy", std::vector<std::string>(40, "left")});
  files.answers.push_back(Prefers(files.keys[0], "anna", 30));
  const Preferences found = MeasurePreferences(files, 1);
  ASSERT_EQ(found.one_sided.size(), 1u);
  EXPECT_EQ(found.one_sided[0].rater, "lazy");
  EXPECT_EQ(found.one_sided[0].left, 40);
}

TEST(BlindFiles, ReadBackWhatTheyWrote) {
  const BlindKey key = KeyOf(3);
  BlindFiles files;
  ASSERT_TRUE(AddBlindFile(WriteBlindKey(key), "key.json", files));
  ASSERT_EQ(files.keys.size(), 1u);
  EXPECT_EQ(WriteBlindKey(files.keys[0]), WriteBlindKey(key));
}

TEST(BlindFiles, ComplainWithThePlaceOfADamagedAnswer) {
  BlindFiles files;
  const auto complaint = [&](const std::string& text) {
    const auto read = AddBlindFile(text, "ben.json", files);
    return read ? "accepted" : ToString(read.error());
  };
  const std::string head = R"({"format":"etude-blind-answers","version":1,"page":"page","rater":"ben","preferred":)";
  EXPECT_THAT(complaint(head + R"(["left","lft"]})"), HasSubstr("ben.json: preferred[1]: 'lft'; allowed: left, right"));
  EXPECT_THAT(complaint(head + R"(["left",3]})"), HasSubstr("ben.json: preferred[1]: 3 is not a text"));
  EXPECT_THAT(complaint(head + R"(["left"])"), HasSubstr("ben.json"));
  EXPECT_THAT(complaint(R"({"format":"else"})"), HasSubstr("ben.json: format: \"else\"; allowed"));
  EXPECT_THAT(complaint("[]"), HasSubstr("ben.json: not a JSON object"));
  EXPECT_EQ(complaint(head + R"(["left"]})"), "accepted");
  EXPECT_THAT(complaint(head + R"(["right"]})"), HasSubstr("a second file with answers of 'ben'"));
  EXPECT_THAT(ToString(CheckBlindFiles(files).error()), HasSubstr("but the key of this page is not given"));
  files.keys.push_back(KeyOf(2));
  EXPECT_THAT(ToString(CheckBlindFiles(files).error()), HasSubstr("to the page page is 1; needed: 2"));
}

}  // namespace
}  // namespace etude
