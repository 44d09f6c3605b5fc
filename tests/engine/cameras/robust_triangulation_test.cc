#include "engine/cameras/robust_triangulation.h"

#include <gtest/gtest.h>

#include <vector>

namespace etude {
namespace {

const glm::dvec3 kPoint(0.2, 1.1, -0.1);

std::vector<WeightedSighting> Sightings() {
  std::vector<WeightedSighting> sightings;
  for (const glm::dvec3& place : {glm::dvec3(0, 1, 4), {3, 2, 2}, {-3, 1.5, 2}, {1, 2.2, -4}, {4, 1, -1}}) {
    const ProjectionMatrix matrix = MatrixOf(LookAt({}, place, {0, 1, 0}));
    sightings.push_back({{matrix, *Project(matrix, kPoint)}, 1});
  }
  return sightings;
}

TEST(TriangulateRobustly, GivesThePointBackFromExactSightings) {
  const auto point = TriangulateRobustly(Sightings());
  ASSERT_TRUE(point);
  EXPECT_LT(glm::distance(point->position, kPoint), 1e-9);
  EXPECT_EQ(point->agrees, std::vector<bool>(5, true));
}

TEST(TriangulateRobustly, LeavesOutTwoOfFiveThatShowSomethingElse) {
  auto sightings = Sightings();
  sightings[1].sighting.pixel += glm::dvec2(120, 40);
  sightings[3].sighting.pixel += glm::dvec2(-90, 150);
  const auto point = TriangulateRobustly(sightings);
  ASSERT_TRUE(point);
  EXPECT_LT(glm::distance(point->position, kPoint), 1e-9);
  EXPECT_EQ(point->agrees, (std::vector<bool>{true, false, true, false, true}));
  std::vector<Sighting> all;
  for (const WeightedSighting& s : sightings) all.push_back(s.sighting);
  EXPECT_GT(glm::distance(Triangulate(all).position, kPoint), 0.05) << "the control: least squares over all";
}

/// Of cameras at rest the minimum of Σ w d² is where its gradient is nothing: no step in any direction is better.
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
  const auto point = TriangulateRobustly(sightings);
  ASSERT_TRUE(point);
  for (int axis = 0; axis < 3; ++axis) {
    for (const double step : {1e-4, -1e-4}) {
      glm::dvec3 aside = point->position;
      aside[axis] += step;
      EXPECT_GT(squares(aside), squares(point->position));
    }
  }
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
