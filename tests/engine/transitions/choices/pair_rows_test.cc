#include "engine/transitions/choices/pair_rows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/fuzzy/distance.h"
#include "engine/transitions/library/transition_points.h"
#include "tests/engine/transitions/random_clips.h"

namespace etude {
namespace {

RandomStream Dice(std::string_view purpose) { return {{.suite_seed = 6, .scenario = "rows", .trial = 0}, purpose}; }

TEST(FuzzyRows, AreEquation1ToTheLastBit) {
  RandomStream dice = Dice("fuzzy");
  const MotionLibrary library = RandomLibrary(dice, {10, 23});
  const std::vector<Grades>&playing = library.tagged[0].grades, &next = library.tagged[1].grades;
  const FuzzyRows rows(next, PaperWeights());
  for (const Grades& grades : playing) {
    std::vector<double> distances(next.size());
    rows.Compute(grades, distances);
    for (std::size_t f = 0; f < next.size(); ++f) {
      EXPECT_EQ(distances[f], ComputeDistance(grades, next[f], PaperWeights()).value);
    }
  }
}

TEST(DiagonalSums, AreSumsAlongDiagonalsOfTheKeptRows) {
  DiagonalSums<double> sums(7, 5, 3);
  for (int row = 7; row < 11; ++row) {
    int column = 0;
    for (double& value : sums.OpenRow()) value = 10 * row + column++;
    sums.CloseRow();
  }
  EXPECT_EQ(sums.SumEndingAt(10, 3, 1), 103);
  EXPECT_EQ(sums.SumEndingAt(10, 3, 2), 103 + 92);
  EXPECT_EQ(sums.SumEndingAt(9, 2, 3), 92 + 81 + 70) << "the whole diagonal";
  EXPECT_EQ(sums.SumEndingAt(10, 0, 1), 100);
}

TEST(ReachAround, EndsWithTheShorterClipOnEachSide) {
  const Reach middle = ReachAround(50, 100, 40, 100, 5);
  EXPECT_EQ(middle.Count(), 11);
  const Reach cut = ReachAround(2, 100, 98, 100, 5);
  EXPECT_EQ(cut.before, 2);
  EXPECT_EQ(cut.after, 1);
}

// A second implementation: computes every window from scratch.
double WindowDistance(std::span<const Grades> a, int frame_a, std::span<const Grades> b, int frame_b, int reach,
                      const FeatureWeights& weights) {
  const int before = std::min({reach, frame_a, frame_b});
  const int after =
      std::min({reach, static_cast<int>(a.size()) - 1 - frame_a, static_cast<int>(b.size()) - 1 - frame_b});
  double sum = 0;
  for (int i = -before; i <= after; ++i) {
    sum += ComputeDistance(a[static_cast<std::size_t>(frame_a + i)], b[static_cast<std::size_t>(frame_b + i)], weights)
               .value;
  }
  return sum / (before + after + 1);
}

TEST(FuzzyWindowRows, AreTheWindowDistance) {
  RandomStream dice = Dice("window");
  const MotionLibrary library = RandomLibrary(dice, {40, 31});
  const std::vector<Grades>&playing = library.tagged[0].grades, &next = library.tagged[1].grades;
  constexpr int kFirst = 6, kHalf = 10;
  FuzzyWindowRows rows(playing, next, kFirst, kHalf, PaperWeights());
  for (int leave = kFirst; leave < 40; leave += 3) {
    std::vector<double> costs(next.size());
    rows.Compute(leave, FramesWithin({0, 30}), costs);
    for (int enter = 0; enter < 31; ++enter) {
      EXPECT_NEAR(costs[enter], WindowDistance(playing, leave, next, enter, kHalf, PaperWeights()), 1e-12);
    }
  }
}

/// A second implementation: tries turns of one cloud, each with its best shift.
double CloudDistanceByTrying(const BodyMotion& a, int frame_a, const BodyMotion& b, int frame_b, int half) {
  const Reach reach =
      ReachAround(frame_a, static_cast<int>(a.poses.size()), frame_b, static_cast<int>(b.poses.size()), half);
  const auto mean_square = [&](double yaw) {
    std::vector<glm::dvec3> gaps;
    glm::dvec3 mean(0);
    for (int i = -reach.before; i <= reach.after; ++i) {
      for (std::size_t j = 0; j < kRoleCount; ++j) {
        gaps.push_back(a.poses[frame_a + i].joints[j] - FloorMove{.yaw = yaw}.Apply(b.poses[frame_b + i].joints[j]));
        mean += gaps.back();
      }
    }
    mean /= static_cast<double>(gaps.size());
    double sum = 0;
    for (const glm::dvec3& gap : gaps) {
      const glm::dvec3 left = gap - glm::dvec3(mean.x, 0, mean.z);
      sum += glm::dot(left, left);
    }
    return sum / static_cast<double>(gaps.size());
  };
  double best_yaw = 0, step = 0.5;
  for (int i = 0; i < 13; ++i) {
    if (mean_square(0.5 * i) < mean_square(best_yaw)) best_yaw = 0.5 * i;
  }
  for (; step > 1e-9; step *= 0.5) {
    for (double yaw : {best_yaw - step, best_yaw + step}) {
      if (mean_square(yaw) < mean_square(best_yaw)) best_yaw = yaw;
    }
  }
  return 100 * std::sqrt(mean_square(best_yaw));
}

TEST(PointCloudRows, AreTheLeastDistanceOverAllTurnsAndShifts) {
  RandomStream dice = Dice("clouds");
  const MotionLibrary library = RandomLibrary(dice, {30, 27});
  constexpr int kFirst = 3, kHalf = 5;
  PointCloudRows rows(library.motions[0], library.motions[1], kFirst, 1.0 / 3);
  for (int leave = kFirst; leave < 30; leave += 4) {
    const std::vector<int> enter_frames = {0, 5, 10, 15, 20, 25};
    std::vector<double> costs(enter_frames.size());
    rows.Compute(leave, enter_frames, costs);
    for (std::size_t i = 0; i < costs.size(); ++i) {
      const int enter = enter_frames[i];
      EXPECT_NEAR(costs[i], CloudDistanceByTrying(library.motions[0], leave, library.motions[1], enter, kHalf), 1e-4)
          << leave << ", " << enter;
    }
  }
}

TEST(PointCloudRows, DoNotSeeWhereADanceTakesPlaceNorWhichWayItFaces) {
  RandomStream dice = Dice("place");
  const BodyMotion motion = RandomClip(dice, 30, 1);
  BodyMotion elsewhere = motion;
  for (BodyPose& pose : elsewhere.poses) pose = FloorMove{.yaw = 2, .x = 40, .z = -3}.Apply(pose);
  PointCloudRows rows(motion, elsewhere, 12, 1.0 / 3);
  std::vector<double> costs(2);
  rows.Compute(12, std::vector{12, 13}, costs);
  EXPECT_NEAR(costs[0], 0, 1e-4);
  EXPECT_GT(costs[1], 0.1) << "the control";
}

}  // namespace
}  // namespace etude
