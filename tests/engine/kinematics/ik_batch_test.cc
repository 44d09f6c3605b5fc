#include "engine/kinematics/ik_batch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "tests/engine/kinematics/posed_tree.h"

namespace etude {
namespace {

IkProblem SomeProblem(int trial) { return DisturbedProblem(Body(), RandomPose(Body(), trial, 1), trial, 15); }

TEST(IkBatch, KeepsEveryNumberOfItsProblems) {
  for (const int count : {1, 5, 8, 9, 24}) {
    std::vector<IkProblem> problems;
    for (int i = 0; i < count; ++i) problems.push_back(SomeProblem(i));
    const IkBatch batch(Body(), problems);
    ASSERT_EQ(batch.count(), count);
    EXPECT_EQ(batch.FindSound().size(), problems.size());
    for (int i = 0; i < count; ++i) {
      const IkProblem &wanted = problems[static_cast<std::size_t>(i)], kept = batch.Get(i);
      EXPECT_EQ(kept.start.angles, wanted.start.angles);
      EXPECT_EQ(kept.start.root_position, wanted.start.root_position);
      EXPECT_EQ(kept.start.root_frame, wanted.start.root_frame);
      for (std::size_t dof = 0; dof < wanted.limits.size(); ++dof) {
        const auto row = static_cast<int>(dof);
        EXPECT_EQ(batch.start_angles(row)[i], wanted.start.angles[dof]);
        EXPECT_EQ(batch.lower_limits(row)[i], wanted.limits[dof].lower);
        EXPECT_EQ(batch.upper_limits(row)[i], wanted.limits[dof].upper);
        EXPECT_EQ(kept.limits[dof].lower, wanted.limits[dof].lower);
        EXPECT_EQ(kept.limits[dof].upper, wanted.limits[dof].upper);
      }
      for (int k = 0; k < 3; ++k) EXPECT_EQ(batch.root(k)[i], wanted.start.root_position[k]);
      for (int k = 0; k < 9; ++k) EXPECT_EQ(batch.root(3 + k)[i], wanted.start.root_frame[k / 3][k % 3]);
      for (std::size_t e = 0; e < wanted.targets.size(); ++e) {
        const EffectorTarget &found = kept.targets[e], &target = wanted.targets[e];
        EXPECT_EQ(found.position, target.position);
        EXPECT_EQ(found.axes, target.axes);
        EXPECT_EQ(found.position_weight, target.position_weight);
        EXPECT_EQ(found.axis_weights, target.axis_weights);
        const auto number = [&](int k) { return batch.target(static_cast<int>(e), k)[i]; };
        for (int k = 0; k < 3; ++k) EXPECT_EQ(number(k), target.position[k]);
        for (int k = 0; k < 9; ++k) EXPECT_EQ(number(3 + k), target.axes[k / 3][k % 3]);
        EXPECT_EQ(number(12), target.position_weight);
        for (int k = 0; k < 3; ++k) EXPECT_EQ(number(13 + k), target.axis_weights[k]);
      }
    }
  }
}

TEST(IkBatch, FindsTheFaultsThatAreFoundInSingleProblems) {
  const glm::dmat3 mirror(-1, 0, 0, 0, 1, 0, 0, 0, 1);
  const std::vector<std::function<void(IkProblem&)>> changes = {
      [](IkProblem&) {},
      [](IkProblem& p) { p.start.angles[7] = NAN; },
      [](IkProblem& p) { p.start.angles[7] = 1e6; },
      [](IkProblem& p) { p.start.angles[7] = 1.1e6; },
      [](IkProblem& p) { p.limits[4].lower = -2e6; },
      [](IkProblem& p) { p.limits[4].upper = 2e6; },
      [](IkProblem& p) { p.limits[4].lower = p.limits[4].upper; },
      [](IkProblem& p) { p.limits[4].lower = p.limits[4].upper + 1e-9; },
      [](IkProblem& p) { p.start.root_position.z = -INFINITY; },
      [](IkProblem& p) { p.start.root_frame[1] *= 1 + 0.9e-6; },
      [](IkProblem& p) { p.start.root_frame[1] *= 1 + 1.2e-6; },
      [&](IkProblem& p) { p.start.root_frame = p.start.root_frame * mirror; },
      [](IkProblem& p) { p.start.root_frame[2] = p.start.root_frame[0]; },
      [](IkProblem& p) { p.targets[0].position.x = 1.5e6; },
      [](IkProblem& p) { p.targets[3].position.z = NAN; },
      [](IkProblem& p) { p.targets[3].axes[2] *= 1.001; },
      [&](IkProblem& p) { p.targets[1].axes = p.targets[1].axes * mirror; },
      [](IkProblem& p) { p.targets[2].position_weight = -1e-9; },
      [](IkProblem& p) { p.targets[2].position_weight = 0; },
      [](IkProblem& p) { p.targets[2].axis_weights.z = 2e6; },
      [](IkProblem& p) { p.targets[2].axis_weights.x = -1; },
      [](IkProblem& p) { p.targets.pop_back(); },
      [](IkProblem& p) { p.start.angles.pop_back(); },
      [](IkProblem& p) { p.limits.pop_back(); },
      [](IkProblem& p) { p.targets[0].axes[0] = glm::normalize(p.targets[0].axes[0] + 0.1 * p.targets[0].axes[1]); }};
  std::vector<IkProblem> problems;
  std::vector<int> sound;
  for (std::size_t i = 0; i < changes.size(); ++i) {
    changes[i](problems.emplace_back(SomeProblem(static_cast<int>(i))));
    if (FindProblemFault(Body(), problems.back()).empty()) sound.push_back(static_cast<int>(i));
  }
  EXPECT_EQ(IkBatch(Body(), problems).FindSound(), sound);
  EXPECT_EQ(sound, (std::vector<int>{0, 2, 6, 9, 18})) << "the control";
  EXPECT_TRUE(IkBatch(Body(), 4).FindSound().empty()) << "no problem is all zeros";
}

}  // namespace
}  // namespace etude
