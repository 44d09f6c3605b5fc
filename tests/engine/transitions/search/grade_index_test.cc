#include "engine/transitions/search/grade_index.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/engine/transitions/search/search_data.h"

namespace etude {
namespace {

/// A second implementation: a loop over `ComputeDistance`.
bool HasMatchByLoop(const std::vector<Grades>& frames, const FeatureWeights& weights, const std::vector<Tags>& tags,
                    const GradeIndex::Query& query) {
  for (int f = 0; f < static_cast<int>(frames.size()); ++f) {
    if (f >= query.own_first && f < query.own_end) continue;
    if (query.tags != nullptr && tags[f] != *query.tags) continue;
    if (ComputeDistance(query.grades, frames[f], weights).value < query.threshold) return true;
  }
  return false;
}

/// Checks that both implementations agree whether frames match, for many thresholds and clip lengths. Returns the
/// numbers of matches and non-matches.
struct Answers {
  int yes = 0, no = 0;
};
Answers ExpectSameAnswers(const std::vector<Grades>& frames, const std::vector<Grades>& queries,
                          const FeatureWeights& weights) {
  std::vector<Tags> tags;
  for (const Grades& frame : frames) tags.push_back(ChooseTags(frame));
  const GradeIndex index(frames, weights, tags);
  const int count = static_cast<int>(frames.size());
  Answers answers;
  int hint = 0;
  for (const Grades& grades : queries) {
    const Tags own_tags = ChooseTags(grades);
    for (double threshold : {0.0, 1e-200, 0.1, kPaperThreshold, 1.0, 3.0, 1e300, kInfinity}) {
      for (const auto& [first, end] : {std::pair{0, 0}, {0, count}, {0, count / 2}, {count / 3, count - 1}}) {
        for (const Tags* asked : {static_cast<const Tags*>(nullptr), &own_tags}) {
          const GradeIndex::Query query{grades, threshold, first, end, asked};
          const bool expected = HasMatchByLoop(frames, weights, tags, query);
          EXPECT_EQ(index.HasMatch(query, hint), expected) << "threshold " << threshold << ", without " << first;
          int fresh = -1;
          EXPECT_EQ(index.HasMatch(query, fresh), expected) << "from another hint";
          ++(expected ? answers.yes : answers.no);
        }
      }
    }
  }
  return answers;
}

std::vector<Grades> Some(const std::vector<Grades>& frames, std::size_t count) {
  std::vector<Grades> some;
  for (std::size_t i = 0; i < count; ++i) some.push_back(frames[i * frames.size() / count]);
  return some;
}

TEST(GradeIndex, AnswersAsALoopDoesForFramesOfMotion) {
  RandomStream dice = SearchDice("motion");
  const std::vector<Grades> frames = WanderingFrames(3000, dice);
  std::vector<Grades> queries = Some(frames, 6);
  for (const Grades& strange : WanderingFrames(6, dice)) queries.push_back(strange);
  const Answers answers = ExpectSameAnswers(frames, queries, PaperWeights());
  EXPECT_GT(answers.yes, 100);
  EXPECT_GT(answers.no, 100);
}

TEST(GradeIndex, AnswersAsALoopDoesForGradesThatNoMotionHas) {
  RandomStream dice = SearchDice("noise");
  for (int count : {1, 2, 15, 16, 17, 255, 256, 257, 700}) {
    SCOPED_TRACE(count);
    ExpectSameAnswers(RandomFrames(count, -3, 9, dice), RandomFrames(2, -4, 10, dice), PaperWeights());
  }
}

TEST(GradeIndex, AFrameOfTheOwnClipIsNoMatchHoweverEqual) {
  RandomStream dice = SearchDice("own");
  const std::vector<Grades> frames = RandomFrames(600, 0, 100, dice);
  const GradeIndex index(frames, PaperWeights());
  int hint = 0;
  for (int f = 0; f < 600; f += 37) {
    EXPECT_TRUE(index.HasMatch({frames[f], 1e-9, 0, f}, hint)) << "the control: the frame itself counts";
    EXPECT_FALSE(index.HasMatch({frames[f], 1e-9, f, f + 1}, hint));
  }
}

TEST(GradeIndex, LeavesOutAFrameThatIsExactlyAtTheThreshold) {
  RandomStream dice = SearchDice("threshold");
  const std::vector<Grades> frames = WanderingFrames(3000, dice);
  const GradeIndex index(frames, PaperWeights());
  int hint = 0;
  for (std::size_t f : {100u, 1000u, 2000u, 2900u}) {
    Grades query = frames[f];
    for (double& grade : query) grade += dice.Uniform(-0.05, 0.05);
    double nearest = kInfinity;
    for (const Grades& frame : frames) nearest = std::min(nearest, ComputeDistance(query, frame, PaperWeights()).value);
    EXPECT_FALSE(index.HasMatch({query, nearest}, hint));
    EXPECT_TRUE(index.HasMatch({query, std::nextafter(nearest, kInfinity)}, hint)) << "the control";
  }
}

TEST(GradeIndex, LeavesOutFeaturesOfNoWeight) {
  RandomStream dice = SearchDice("weights");
  const std::vector<Grades> frames = WanderingFrames(600, dice);
  FeatureWeights weights{};
  ExpectSameAnswers(frames, Some(frames, 2), weights);
  weights[3] = 8;
  ExpectSameAnswers(frames, Some(frames, 3), weights);
}

TEST(GradeIndex, KeepsTiniestAndGreatestDistancesApart) {
  std::vector<Grades> frames(40);
  for (std::size_t f = 0; f < frames.size(); ++f) {
    frames[f][f % kTermCount] = std::pow(10.0, -170 + 0.5 * static_cast<double>(f));
    if (f % 7 == 0) frames[f][2] = std::pow(10.0, 100 + static_cast<double>(f));
  }
  ExpectSameAnswers(frames, {frames[0], frames[9], Grades{}}, PaperWeights());
}

TEST(GradeIndex, FindsNothingInNoFramesOrBelowAThresholdThatIsNone) {
  int hint = 0;
  EXPECT_FALSE(GradeIndex({}, PaperWeights()).HasMatch({Grades{}, kInfinity}, hint));
  const GradeIndex index(std::vector<Grades>(20), PaperWeights());
  EXPECT_TRUE(index.HasMatch({Grades{}, 1e-9}, hint)) << "the control";
  for (double threshold : {0.0, -1.0, -kInfinity, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_FALSE(index.HasMatch({Grades{}, threshold}, hint));
  }
}

}  // namespace
}  // namespace etude
