#include "engine/transitions/search/grade_index.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <tuple>

#include "tests/engine/transitions/search/search_data.h"

namespace etude {

/// To the last bit.
bool operator==(const Neighbour& a, const Neighbour& b) { return a.frame == b.frame && a.distance == b.distance; }

std::ostream& operator<<(std::ostream& out, const Neighbour& n) { return out << n.frame << " at " << n.distance; }

namespace {

/// The second implementation: a loop over `ComputeDistance`.
struct Loop {
  const std::vector<Grades>& frames;
  FeatureWeights weights;

  std::vector<Neighbour> Within(const Grades& query, double threshold) const {
    std::vector<Neighbour> found;
    for (std::size_t f = 0; f < frames.size(); ++f) {
      const double distance = ComputeDistance(query, frames[f], weights).value;
      if (distance < threshold) found.push_back({static_cast<int>(f), distance});
    }
    return found;
  }
  std::vector<Neighbour> Nearest(const Grades& query, int k) const {
    std::vector<Neighbour> all = Within(query, kInfinity);
    std::ranges::sort(all, {}, [](const Neighbour& n) { return std::tuple(n.distance, n.frame); });
    all.resize(std::min<std::size_t>(all.size(), std::max(k, 0)));
    return all;
  }
};

/// Asks both for everything; returns how many neighbours were compared.
std::size_t ExpectSameAnswers(const std::vector<Grades>& frames, const std::vector<Grades>& queries,
                              const FeatureWeights& weights) {
  const GradeIndex index(frames, weights);
  const Loop loop{frames, weights};
  std::size_t compared = 0;
  for (const Grades& query : queries) {
    for (double threshold : {0.0, 1e-200, 0.1, kPaperThreshold, 1.0, 3.0, 1e300, kInfinity}) {
      const std::vector<Neighbour> expected = loop.Within(query, threshold);
      EXPECT_EQ(index.Within(query, threshold), expected) << "threshold " << threshold;
      const std::optional<Neighbour> expected_first = expected.empty() ? std::nullopt : std::optional(expected.front());
      EXPECT_EQ(index.First(query, threshold), expected_first) << "threshold " << threshold;
      compared += expected.size();
    }
    for (int k : {-1, 0, 1, 2, 10, 100, 5000}) {
      const std::vector<Neighbour> expected = loop.Nearest(query, k);
      EXPECT_EQ(index.Nearest(query, k), expected) << "k " << k;
      compared += expected.size();
    }
  }
  return compared;
}

std::vector<Grades> Some(const std::vector<Grades>& frames, std::size_t count) {
  std::vector<Grades> some;
  for (std::size_t i = 0; i < count; ++i) some.push_back(frames[i * frames.size() / count]);
  return some;
}

TEST(GradeIndex, AnswersAsALoopDoesForFramesOfMotion) {
  RandomStream dice = SearchDice("motion");
  const std::vector<Grades> frames = WanderingFrames(3000, dice);
  std::vector<Grades> queries = Some(frames, 4);
  for (const Grades& strange : WanderingFrames(4, dice)) queries.push_back(strange);
  EXPECT_GT(ExpectSameAnswers(frames, queries, PaperWeights()), 10000u);
}

TEST(GradeIndex, AnswersAsALoopDoesForGradesThatNoMotionHas) {
  RandomStream dice = SearchDice("noise");
  for (int count : {1, 2, 15, 16, 17, 255, 256, 257, 700}) {
    SCOPED_TRACE(count);
    ExpectSameAnswers(RandomFrames(count, -3, 9, dice), RandomFrames(2, -4, 10, dice), PaperWeights());
  }
}

TEST(GradeIndex, TakesTheLowestOfEqualFrames) {
  RandomStream dice = SearchDice("equal");
  const std::vector<Grades> few = RandomFrames(3, 0, 1, dice);
  std::vector<Grades> frames;
  for (int i = 0; i < 900; ++i) frames.push_back(few[dice.IndexBelow(3)]);
  ExpectSameAnswers(frames, few, PaperWeights());
  EXPECT_EQ(GradeIndex(frames, PaperWeights()).Nearest(frames[700], 1).front().frame,
            static_cast<int>(std::ranges::find(frames, frames[700]) - frames.begin()));
}

TEST(GradeIndex, DoesNoWorkForAThresholdThatNoDistanceIsBelow) {
  RandomStream dice = SearchDice("nothing");
  const std::vector<Grades> frames = WanderingFrames(100, dice);
  const GradeIndex index(frames, PaperWeights());
  for (double threshold : {0.0, -1.0, -kInfinity, std::numeric_limits<double>::quiet_NaN()}) {
    SearchWork work;
    EXPECT_FALSE(index.First(frames[0], threshold, &work));
    EXPECT_TRUE(index.Within(frames[0], threshold, &work).empty());
    EXPECT_EQ(work.distances + work.boxes, 0) << threshold;
  }
  SearchWork work;
  EXPECT_TRUE(index.First(frames[0], 1e-9, &work)) << "the control";
  EXPECT_GT(work.distances, 0);
  const GradeIndex empty({}, PaperWeights());
  EXPECT_FALSE(empty.First(frames[0], 1));
  EXPECT_TRUE(empty.Within(frames[0], 1).empty());
}

TEST(GradeIndex, LeavesOutAFrameThatIsExactlyAtTheThreshold) {
  // More frames than the head has, which is searched apart from the tree.
  RandomStream dice = SearchDice("threshold");
  const std::vector<Grades> frames = WanderingFrames(6000, dice);
  const GradeIndex index(frames, PaperWeights());
  const Loop loop{frames, PaperWeights()};
  int in_head = 0, beyond_head = 0;
  for (std::size_t f : {100u, 2000u, 4000u, 5000u, 5500u, 5900u}) {
    Grades query = frames[f];
    for (double& grade : query) grade += dice.Uniform(-0.05, 0.05);
    const Neighbour nearest = loop.Nearest(query, 1).front();
    EXPECT_TRUE(index.Within(query, nearest.distance).empty());
    EXPECT_FALSE(index.First(query, nearest.distance));
    const double more = std::nextafter(nearest.distance, kInfinity);
    EXPECT_EQ(index.Within(query, more), std::vector{nearest}) << "the control";
    EXPECT_EQ(index.First(query, more), nearest) << "the control";
    ++(nearest.frame < 4096 ? in_head : beyond_head);
  }
  EXPECT_GE(in_head, 2);
  EXPECT_GE(beyond_head, 2);
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

TEST(GradeIndex, OfNoFramesFindsNothing) {
  const GradeIndex index({}, PaperWeights());
  EXPECT_EQ(index.FrameCount(), 0);
  EXPECT_FALSE(index.First({}, kInfinity));
  EXPECT_TRUE(index.Within({}, kInfinity).empty());
  EXPECT_TRUE(index.Nearest({}, 3).empty());
}

TEST(GradeIndex, FindsNothingBelowAThresholdThatIsNone) {
  const std::vector<Grades> frames(20);
  const GradeIndex index(frames, PaperWeights());
  for (double threshold : {0.0, -1.0, -kInfinity, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_FALSE(index.First({}, threshold));
    EXPECT_TRUE(index.Within({}, threshold).empty());
  }
}

TEST(GradeIndex, LooksAtFewFramesAndSaysSo) {
  RandomStream dice = SearchDice("work");
  const std::vector<Grades> frames = WanderingFrames(20000, dice);
  const GradeIndex index(frames, PaperWeights());
  SearchWork nearest, first, all;
  index.Nearest(frames[777], 1, &nearest);
  index.First(frames[19000], kPaperThreshold, &first);
  index.Within(frames[777], kInfinity, &all);
  for (const SearchWork& work : {nearest, first}) {
    EXPECT_GT(work.distances, 0);
    EXPECT_LT(work.distances, 2000);
    EXPECT_GT(work.boxes, 0);
    EXPECT_LT(work.boxes, 4000);
  }
  EXPECT_EQ(all.distances, 20000) << "the control: everything is asked for";
  EXPECT_EQ(all.boxes, 20000 / 16 + 79 + 5);
}

}  // namespace
}  // namespace etude
