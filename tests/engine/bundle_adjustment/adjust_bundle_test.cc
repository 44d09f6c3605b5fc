#include "engine/bundle_adjustment/adjust_bundle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace etude {
namespace {

/// Returns an arm of three limbs on a turning root: seven angles, two lengths, four points.
MeasurableBody Arm(double upper = 0.5, double lower = 0.4) {
  MeasurableBody arm;
  arm.tree.joints = {{"root", -1, glm::dvec3(0), glm::dmat3(1), 0, 0},
                     {"shoulder", 0, {0.1, 0, 0.2}, glm::dmat3(1), 0, 3},
                     {"elbow", 1, {0, 0, upper}, glm::dmat3(1), 3, 1},
                     {"wrist", 2, {0, 0, lower}, glm::dmat3(1), 4, 3}};
  arm.tree.limits.assign(7, {-2, 2});
  arm.points = {{0, {0, 0, 0}}, {0, {0.3, 0, 0}}, {1, {0, 0, 0}}, {2, {0, 0, 0}}, {3, {0, 0, 0}}, {3, {0.05, 0, 0.2}}};
  arm.lengths = {upper, lower};
  arm.joint_shares = {{2, 0, {0, 0, 1}}, {3, 1, {0, 0, 1}}};
  return arm;
}

TreeState PoseAt(double t) {
  TreeState state{.root_position = {0.2 * t, 0.1 * std::sin(t), 0.05 * t}};
  state.root_frame = glm::dmat3(glm::rotate(glm::dmat4(1), 0.4 + 0.3 * t, glm::normalize(glm::dvec3(1, 2, 3))));
  for (int i = 0; i < 7; ++i) state.angles.push_back(0.6 * std::sin(1.3 * i + 0.5 + t));
  return state;
}

std::vector<ProjectionMatrix> Cameras() {
  return {MatrixOf(LookAt({}, {3, 1, 3}, {0, 0, 0.5})), MatrixOf(LookAt({}, {-3, 2, 2.5}, {0, 0, 0.5}))};
}

std::vector<BundleMark> ExactMarks(const MeasurableBody& body, const std::vector<TreeState>& states) {
  std::vector<BundleMark> marks;
  PlacedPoints placed;
  for (std::size_t k = 0; k < states.size(); ++k) {
    PlacePoints(body, states[k], false, placed);
    for (const ProjectionMatrix& camera : Cameras()) {
      for (std::size_t p = 0; p < body.points.size(); ++p) {
        marks.push_back({static_cast<int>(k), static_cast<int>(p), camera, *Project(camera, placed.positions[p]),
                         glm::dmat2(0.25)});
      }
    }
  }
  return marks;
}

std::vector<TreeState> Poses(int count, double step, double offset = 0) {
  std::vector<TreeState> states;
  for (int k = 0; k < count; ++k) states.push_back(PoseAt(step * k + offset));
  return states;
}

double LargestError(const MeasurableBody& body, const BundleSolution& found, const MeasurableBody& true_body,
                    const std::vector<TreeState>& truth) {
  double largest = 0;
  PlacedPoints a, b;
  for (std::size_t k = 0; k < truth.size(); ++k) {
    PlacePoints(WithLengths(body, found.lengths), found.states[k], false, a);
    PlacePoints(true_body, truth[k], false, b);
    for (std::size_t p = 0; p < a.positions.size(); ++p) {
      largest = std::max(largest, glm::distance(a.positions[p], b.positions[p]));
    }
  }
  return largest;
}

BundleOptions Exact() {
  BundleOptions options{.max_iterations = 100, .min_decrease = 1e-14};
  return options;
}

TEST(PlacePoints, TellsHowPointsMoveAsFiniteDifferencesDo) {
  const MeasurableBody arm = Arm();
  const TreeState state = PoseAt(0.7);
  PlacedPoints placed, plus, minus;
  PlacePoints(arm, state, true, placed);
  ASSERT_EQ(placed.columns, 6 + 7 + 2);
  constexpr double kStep = 1e-6;
  for (int column = 0; column < placed.columns; ++column) {
    const auto moved = [&](double by, PlacedPoints& out) {
      TreeState near = state;
      std::vector<double> lengths = arm.lengths;
      if (column < 3) near.root_position[column] += by;
      if (column >= 3 && column < 6) {
        glm::dvec3 axis(0);
        axis[column - 3] = 1;
        near.root_frame = glm::dmat3(glm::rotate(glm::dmat4(1), by, axis)) * near.root_frame;
      }
      if (column >= 6 && column < 13) near.angles[column - 6] += by;
      if (column >= 13) lengths[column - 13] += by;
      PlacePoints(WithLengths(arm, lengths), near, false, out);
    };
    moved(kStep, plus);
    moved(-kStep, minus);
    for (std::size_t p = 0; p < arm.points.size(); ++p) {
      const glm::dvec3 difference = (plus.positions[p] - minus.positions[p]) / (2 * kStep);
      EXPECT_LT(glm::distance(difference, placed.gains_of(static_cast<int>(p))[column]), 1e-8) << p << " " << column;
    }
  }
}

TEST(AdjustBundle, GivesPosesAndLengthsOfExactMarksBack) {
  const std::vector<TreeState> truth = Poses(6, 0.3);
  const MeasurableBody true_arm = Arm(0.55, 0.33), arm = Arm();
  const auto marks = ExactMarks(true_arm, truth);
  const std::vector<TreeState> start = Poses(6, 0.3, 0.15);
  BundleOptions options = Exact();
  options.adjusts_lengths = true;
  const BundleSolution found = AdjustBundle({.body = arm, .start = start, .marks = marks}, options);
  ASSERT_TRUE(found.is_solved);
  EXPECT_NEAR(found.lengths[0], 0.55, 1e-9);
  EXPECT_NEAR(found.lengths[1], 0.33, 1e-9);
  EXPECT_LT(LargestError(arm, found, true_arm, truth), 1e-8);
  EXPECT_LT(found.last_cost, 1e-12 * found.first_cost);

  const BundleSolution fixed = AdjustBundle({.body = arm, .start = start, .marks = marks}, Exact());
  EXPECT_EQ(fixed.lengths, arm.lengths);
  EXPECT_GT(LargestError(arm, fixed, true_arm, truth), 0.01) << "the control: with wrong lengths no pose fits";
}

// Returns the cost at a place, without a step.
double CostAt(const MeasurableBody& body, std::span<const TreeState> states, std::span<const BundleMark> marks,
              BundleOptions options) {
  options.max_iterations = 0;
  return AdjustBundle({.body = body, .start = states, .marks = marks}, options).first_cost;
}

// A wrong derivative of any term would end the search away from the minimum.
TEST(AdjustBundle, EndsWhereFiniteDifferencesOfTheWholeSumVanish) {
  const std::vector<TreeState> truth = Poses(5, 0.1);
  auto marks = ExactMarks(Arm(), truth);
  for (std::size_t i = 0; i < marks.size(); ++i) {
    marks[i].pixel +=
        glm::dvec2(4 * std::sin(11.0 * static_cast<double>(i)), 4 * std::cos(7.0 * static_cast<double>(i)));
    marks[i].information = {{0.3, 0.1}, {0.1, 0.2}};
  }
  MeasurableBody arm = Arm(0.52, 0.38);
  arm.tree.limits.assign(7, {-0.3, 0.3});
  BundleOptions options = Exact();
  options.adjusts_lengths = true;
  options.smoothness.emplace();
  options.smoothness->points = {0, 2, 5};
  const BundleSolution found = AdjustBundle({.body = arm, .start = Poses(5, 0.1, 0.05), .marks = marks}, options);
  ASSERT_TRUE(found.is_solved);
  EXPECT_LT(found.last_cost, found.first_cost);
  const MeasurableBody at = WithLengths(arm, found.lengths);
  EXPECT_NEAR(CostAt(at, found.states, marks, options), found.last_cost, 1e-9 * found.last_cost);

  constexpr double kStep = 1e-4;
  int checked = 0;
  // Near its minimum the cost is a parabola of `by`. A slope below 1e-4 · bend means that the minimum is less than 1e-4
  // (m or rad) away.
  const auto expect_minimum = [&](const auto& cost) {
    const double slope = (cost(kStep) - cost(-kStep)) / (2 * kStep);
    const double bend = (cost(kStep) + cost(-kStep) - 2 * found.last_cost) / (kStep * kStep);
    EXPECT_GT(bend, 0);
    EXPECT_LT(std::abs(slope), 1e-4 * bend) << "parameter " << checked;
    ++checked;
  };
  for (std::size_t k = 0; k < found.states.size(); ++k) {
    for (int i = 0; i < 6 + 7; ++i) {
      expect_minimum([&](double by) {
        std::vector<TreeState> states = found.states;
        glm::dvec3 axis(0);
        if (i < 6) axis[i % 3] = 1;
        if (i < 3) states[k].root_position += by * axis;
        if (i >= 3 && i < 6)
          states[k].root_frame = glm::dmat3(glm::rotate(glm::dmat4(1), by, axis)) * states[k].root_frame;
        if (i >= 6) states[k].angles[i - 6] += by;
        return CostAt(at, states, marks, options);
      });
    }
  }
  for (std::size_t i = 0; i < 2; ++i) {
    expect_minimum([&](double by) {
      std::vector<double> lengths = found.lengths;
      lengths[i] += by;
      return CostAt(WithLengths(arm, lengths), found.states, marks, options);
    });
  }
  EXPECT_EQ(checked, 5 * 13 + 2);
}

TEST(AdjustBundle, IsMovedByAGrossErrorOnlyWithoutARobustLoss) {
  const std::vector<TreeState> truth = Poses(3, 0.2);
  auto marks = ExactMarks(Arm(), truth);
  marks[2 * Arm().points.size() - 2].pixel += glm::dvec2(150, -80);  // the wrist in the first frame
  const auto error = [&](RobustLoss loss) {
    BundleOptions options = Exact();
    options.loss = loss;
    const BundleSolution found = AdjustBundle({.body = Arm(), .start = Poses(3, 0.2, 0.1), .marks = marks}, options);
    EXPECT_TRUE(found.is_solved);
    return LargestError(Arm(), found, Arm(), truth);
  };
  EXPECT_LT(error(RobustLoss::kCauchy), 0.005);
  EXPECT_GT(error(RobustLoss::kNone), 0.05);
  EXPECT_LT(error(RobustLoss::kHuber), error(RobustLoss::kNone));
}

TEST(AdjustBundle, FillsFramesWithoutMarksByTheirNeighbours) {
  const std::vector<TreeState> truth = Poses(9, 0.03);
  auto marks = ExactMarks(Arm(), truth);
  std::erase_if(marks, [](const BundleMark& mark) { return mark.frame == 4; });
  std::vector<TreeState> start = truth;
  start[4] = PoseAt(1);
  BundleOptions options = Exact();
  const BundleSolution alone = AdjustBundle({.body = Arm(), .start = start, .marks = marks}, options);
  EXPECT_NEAR(alone.states[4].angles[0], start[4].angles[0], 1e-9) << "nothing tells where the arm is";
  options.smoothness.emplace();
  options.smoothness->points = {0, 1, 2};
  const BundleSolution smooth = AdjustBundle({.body = Arm(), .start = start, .marks = marks}, options);
  EXPECT_LT(LargestError(Arm(), smooth, Arm(), truth), 0.01);
}

TEST(AdjustBundle, KeepsAnglesWithinLimitsUnlessPicturesInsist) {
  MeasurableBody stiff = Arm();
  for (AngleRange& range : stiff.tree.limits) range = {-0.2, 0.2};
  const std::vector<TreeState> truth = Poses(1, 0);
  const auto marks = ExactMarks(Arm(), truth);
  BundleOptions options = Exact();
  options.limit_deviation = 1e3;
  const BundleSolution loose = AdjustBundle({.body = stiff, .start = truth, .marks = marks}, options);
  EXPECT_LT(LargestError(stiff, loose, stiff, truth), 1e-5);
  options.limit_deviation = 1e-6;
  options.loss = RobustLoss::kNone;
  const BundleSolution tight = AdjustBundle({.body = stiff, .start = truth, .marks = marks}, options);
  for (const double angle : tight.states[0].angles) EXPECT_LT(std::abs(angle), 0.2 + 1e-4);
}

TEST(AdjustBundle, IsNotSolvedWithoutFrames) {
  const BundleSolution nothing = AdjustBundle({.body = Arm(), .start = {}, .marks = {}});
  EXPECT_FALSE(nothing.is_solved);
  EXPECT_EQ(nothing.lengths, Arm().lengths) << "as they were";
}

}  // namespace
}  // namespace etude
