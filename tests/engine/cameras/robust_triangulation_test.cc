#include "engine/cameras/robust_triangulation.h"

#include <gtest/gtest.h>

#include <vector>

#include "sim/random/stream.h"
#include "tests/engine/cameras/camera_at.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using Indices = std::vector<std::size_t>;
constexpr double kTolerancePx = 12;
const glm::dvec3 kPoint(0.3, 1.2, -0.4), kOther(-0.2, 0.7, 0.1);

std::vector<Sighting> Sightings(int count, const glm::dvec3& point) {
  std::vector<Sighting> sightings;
  for (int i = 0; i < count; ++i) sightings.push_back({CameraAt(-70 + 55 * i), *Project(CameraAt(-70 + 55 * i), point)});
  return sightings;
}

Indices AllBut(std::size_t count, std::size_t one) {
  Indices indices;
  for (std::size_t i = 0; i < count; ++i) {
    if (i != one) indices.push_back(i);
  }
  return indices;
}

TEST(AgreeingViews, LeaveOutTheOneCameraThatIsWrong) {
  for (std::size_t count = 3; count <= 6; ++count) {
    for (std::size_t wrong = 0; wrong < count; ++wrong) {
      std::vector<Sighting> sightings = Sightings(static_cast<int>(count), kPoint);
      sightings[wrong].pixel += glm::dvec2(45, -60);
      EXPECT_EQ(AgreeingViews(sightings, kTolerancePx), AllBut(count, wrong)) << count << " cameras, " << wrong;
    }
  }
}

TEST(AgreeingViews, KeepAllWhoseErrorsAreSmall) {
  std::vector<Sighting> sightings = Sightings(5, kPoint);
  for (std::size_t i = 0; i < 5; ++i) sightings[i].pixel += glm::dvec2(i % 2 ? 2 : -2, i % 3 ? 1 : -1);
  EXPECT_EQ(AgreeingViews(sightings, kTolerancePx).size(), 5u);
  EXPECT_LT(AgreeingViews(sightings, 0.1).size(), 5u) << "the control: a tolerance below the errors";
}

TEST(AgreeingViews, OfTwoNobodyCanSayWhichIsWrong) {
  std::vector<Sighting> sightings = Sightings(2, kPoint);
  sightings[1].pixel.y += 100;
  EXPECT_EQ(AgreeingViews(sightings, kTolerancePx), (Indices{0, 1}));
}

TEST(AgreeingViews, OfALimbLeaveOutThePictureThatShowsAnother) {
  for (std::size_t wrong = 0; wrong < 4; ++wrong) {
    const auto begins = Sightings(4, kPoint), ends = Sightings(4, kOther);
    std::vector<LimbSighting> limb;
    for (std::size_t i = 0; i < 4; ++i) limb.push_back({begins[i].matrix, {begins[i].pixel, ends[i].pixel}});
    EXPECT_EQ(AgreeingViews(limb, kTolerancePx).size(), 4u);
    limb[wrong].stroke.b += glm::dvec2(-70, 20);
    EXPECT_EQ(AgreeingViews(limb, kTolerancePx), AllBut(4, wrong));
  }
}

const glm::dvec3 kPlace(0.2, 1.1, -0.1);

std::vector<WeightedSighting> Sightings() {
  std::vector<WeightedSighting> sightings;
  for (const glm::dvec3& place : {glm::dvec3(0, 1, 4), {3, 2, 2}, {-3, 1.5, 2}, {1, 2.2, -4}, {4, 1, -1}}) {
    const ProjectionMatrix matrix = MatrixOf(LookAt({}, place, {0, 1, 0}));
    sightings.push_back({{matrix, *Project(matrix, kPlace)}, 1});
  }
  return sightings;
}

TEST(TriangulateRobustly, GivesThePointBackFromExactSightings) {
  ASSERT_OK(point, TriangulateRobustly(Sightings()));
  EXPECT_LT(glm::distance(point->position, kPlace), 1e-9);
  EXPECT_EQ(point->agrees, std::vector<bool>(5, true));
}

TEST(TriangulateRobustly, LeavesOutTwoOfFiveThatShowSomethingElse) {
  auto sightings = Sightings();
  sightings[1].sighting.pixel += glm::dvec2(120, 40);
  sightings[3].sighting.pixel += glm::dvec2(-90, 150);
  ASSERT_OK(point, TriangulateRobustly(sightings));
  EXPECT_LT(glm::distance(point->position, kPlace), 1e-9);
  EXPECT_EQ(point->agrees, (std::vector<bool>{true, false, true, false, true}));
  std::vector<Sighting> all;
  for (const WeightedSighting& s : sightings) all.push_back(s.sighting);
  EXPECT_GT(glm::distance(Triangulate(all).position, kPlace), 0.05) << "the control: least squares over all";
}

/// At the minimum of Σ w d² the gradient vanishes: no step in any direction lowers it.
TEST(TriangulateRobustly, FindsTheLeastWeightedSquares) {
  auto sightings = Sightings();
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    sightings[i].weight = 0.2 + 0.15 * static_cast<double>(i);
    sightings[i].sighting.pixel += glm::dvec2(3.0 * static_cast<double>(i % 3) - 3, 2.0 - static_cast<double>(i));
  }
  const auto squares = [&](const glm::dvec3& p) {
    double sum = 0;
    for (const WeightedSighting& s : sightings) {
      const glm::dvec2 d = *Project(s.sighting.matrix, p) - s.sighting.pixel;
      sum += s.weight * glm::dot(d, d);
    }
    return sum;
  };
  ASSERT_OK(point, TriangulateRobustly(sightings));
  for (int axis = 0; axis < 3; ++axis) {
    for (const double step : {1e-4, -1e-4}) {
      glm::dvec3 aside = point->position;
      aside[axis] += step;
      EXPECT_GT(squares(aside), squares(point->position));
    }
  }
}

/// Errors near the threshold make the set change several times before it settles. The position must be the one of the
/// returned set, and the set must be the one of the returned position.
TEST(TriangulateRobustly, ReturnsThePositionOfTheSetThatItReturns) {
  constexpr double kOutlierPx = 20;
  int found = 0, moved = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    RandomStream dice(WorldKey{.suite_seed = 1, .scenario = "robust", .trial = trial}, "sightings");
    auto sightings = Sightings();
    for (WeightedSighting& s : sightings) {
      s.weight = dice.Uniform(0.2, 1.0);
      s.sighting.pixel += glm::dvec2(dice.Normal(0, 22), dice.Normal(0, 22));
    }
    const auto point = TriangulateRobustly(sightings, {.outlier_px = kOutlierPx});
    if (!point) continue;
    ++found;
    std::vector<InformedSighting> agreeing;
    for (std::size_t i = 0; i < sightings.size(); ++i) {
      const glm::dvec2 pixel = *Project(sightings[i].sighting.matrix, point->position);
      EXPECT_EQ(glm::distance(pixel, sightings[i].sighting.pixel) <= kOutlierPx, point->agrees[i])
          << trial << ", " << i;
      if (point->agrees[i]) agreeing.push_back({sightings[i].sighting, glm::dmat2(sightings[i].weight)});
    }
    ASSERT_OK(likeliest, TriangulateLikeliest(agreeing));
    EXPECT_EQ(point->position, likeliest->position) << trial;
    // The control: a set that changes, for which a position of an earlier set is another one.
    std::vector<Sighting> plain;
    std::vector<double> weights;
    for (const WeightedSighting& s : sightings) {
      plain.push_back(s.sighting);
      weights.push_back(s.weight);
    }
    std::vector<bool> first(sightings.size());
    for (const std::size_t view : AgreeingViews(plain, kOutlierPx, weights)) first[view] = true;
    moved += first != point->agrees;
  }
  EXPECT_GT(found, 1000);
  EXPECT_GT(moved, 100);
}

TEST(TriangulateRobustly, SaysNothingWhereNoTwoAgree) {
  auto two = Sightings();
  two.resize(2);
  two[1].sighting.pixel += glm::dvec2(0, 400);
  EXPECT_FALSE(TriangulateRobustly(two));
  EXPECT_FALSE(TriangulateRobustly(std::span(two).first(1)));
  auto unsure = Sightings();
  for (WeightedSighting& s : unsure) s.weight = 0;
  EXPECT_FALSE(TriangulateRobustly(unsure));
}

}  // namespace
}  // namespace etude
