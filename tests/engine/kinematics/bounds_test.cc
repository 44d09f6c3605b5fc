// Tries values just within and just beyond the thresholds of equal positions, limb lengths, reach, and FindFault.
#include <gtest/gtest.h>

#include "engine/kinematics/capture_body.h"
#include "tests/engine/kinematics/observed_tree.h"
#include "tests/engine/kinematics/random_tree.h"
#include "tests/engine/kinematics/rest_bodies.h"

namespace etude {
namespace {

TEST(Kinematics, DoesNotTakeForApartWhatIsInOnePlace) {
  const BodyPose pose = ToBodyPose(Body(), RandomPose(Body(), 3, 0.5));
  const std::array<std::pair<Role, Role>, 2> ends = {
      {{Role::kRightFoot, Role::kRightHip}, {Role::kRightHand, Role::kRightShoulder}}};
  for (const auto& [end, root] : ends) {
    for (const double gap : {5e-7, 2e-6}) {
      LimbObservation seen = Observe(pose);
      seen.ends[end] += pose[Mirrored(root)] - pose[root] + glm::dvec3(gap, 0, 0);
      EXPECT_EQ(FixLimbLengths(seen, {}).has_value(), gap > 1e-6) << RoleName(root);
    }
  }
  for (const double length : {5e-5, 2e-4}) {
    RestBody rest = PlainRestBody();
    const glm::dvec3 elbow = rest.roles[Index(Role::kLeftElbow)].position, wrist = elbow + glm::dvec3(0, length, 0);
    RestBody::RoleAnchor& hand = rest.roles[Index(Role::kLeftHand)];
    rest.joints[hand.joint].position = rest.roles[Index(Role::kLeftWrist)].position = wrist;
    EXPECT_EQ(FittedBody(rest).has_value(), length > 1e-4);
  }
}

TEST(OutOfReach, LeavesABillionthOfAMetreForRounding) {
  const KinematicTree body = Body();
  IkProblem problem = DisturbedProblem(body, StandingState(body), 1, 0);
  for (EffectorTarget& target : problem.targets) target.position_weight = 0;
  problem.targets[3].position_weight = 1;
  problem.targets[3].axis_weights = glm::dvec3(0);
  const LimbLengths l;
  // The chain from the toe up the left leg, across half the hips, up trunk and neck.
  const double reach = l.foot + l.shank + l.thigh + l.hip_width / 2 + l.trunk + l.neck;
  for (const double beyond : {5e-10, 2e-9}) {
    problem.targets[3].position = problem.start.root_position + glm::dvec3(0, reach + beyond, 0);
    EXPECT_EQ(IsOutOfReach(body, problem), beyond > 1e-9) << beyond;
  }
}

TEST(Faults, BeginRightBeyondTheirBounds) {
  const KinematicTree sound_tree = Body();
  const IkProblem sound = DisturbedProblem(sound_tree, RandomPose(sound_tree, 1, 1), 1, 10);
  const auto fault = [&](const auto& spoil) {
    KinematicTree tree = sound_tree;
    IkProblem problem = sound;
    IkOptions options;
    spoil(tree, problem, options);
    return std::string(FindFault(tree, problem, options));
  };
  using T = KinematicTree;
  using P = IkProblem;
  using O = IkOptions;
  EXPECT_EQ(fault([](T&, P& p, O&) { p.start.root_position.y = 1e6; }), "");
  EXPECT_EQ(fault([](T&, P& p, O&) { p.start.root_position.y = 1.0001e6; }),
            "the root's position is not finite or too large, or the root's axes are not orthonormal");
  EXPECT_EQ(fault([](T&, P& p, O&) { p.start.root_frame[0] *= 1 + 0.9e-6; }), "");
  EXPECT_EQ(fault([](T&, P& p, O&) { p.start.root_frame[0] *= 1 + 1.1e-6; }),
            "the root's position is not finite or too large, or the root's axes are not orthonormal");
  EXPECT_EQ(fault([](T&, P& p, O&) { p.start.angles[3] = -1e6; }), "");
  EXPECT_EQ(fault([](T&, P& p, O&) { p.start.angles[3] = -1.0001e6; }), "a start angle is not finite");
  EXPECT_EQ(fault([](T&, P& p, O&) { p.limits[3] = {0.5, 0.5}; }), "");
  EXPECT_EQ(fault([](T&, P& p, O&) {
              p.limits[3] = {0.5, 0.4999};
            }),
            "an angle limit is not finite or too large, or a lower limit is above the upper limit");
  EXPECT_EQ(fault([](T&, P& p, O&) { p.targets[1].axis_weights.y = 1e6; }), "");
  EXPECT_EQ(fault([](T&, P& p, O&) { p.targets[1].position_weight = 1.1e6; }),
            "a target is invalid; allowed: a finite position, orthonormal axes, finite weights of 0 or more");
  EXPECT_EQ(fault([](T&, P& p, O&) { p.targets[2].axis_weights.y = -1e-9; }),
            "a target is invalid; allowed: a finite position, orthonormal axes, finite weights of 0 or more");
  EXPECT_EQ(fault([](T&, P& p, O&) { p.targets.pop_back(); }),
            "the number of targets is not the tree's number of end effectors");
  EXPECT_EQ(fault([](T&, P& p, O&) { p.limits.pop_back(); }),
            "the number of angles or limits is not the tree's number of degrees of freedom");
  EXPECT_EQ(fault([](T&, P&, O& o) { o.angle_change_tolerance = 0; }), "");
  EXPECT_EQ(fault([](T&, P&, O& o) { o.angle_change_tolerance = -1e-9; }),
            "the angle-change tolerance is negative or not finite");
  EXPECT_EQ(fault([](T&, P&, O& o) { o.max_iterations = 1; }), "");
  EXPECT_EQ(fault([](T&, P&, O& o) { o.max_iterations = 0; }), "the iteration limit is below 1");
  EXPECT_EQ(fault([](T& t, P&, O&) { t.joints[1].p_PJ = glm::dvec3(0); }), "") << "it stands where the root does";
  EXPECT_EQ(fault([](T& t, P&, O&) { t.joints[2].p_PJ = glm::dvec3(0); }), "a limb has no length");
  EXPECT_EQ(fault([](T& t, P&, O&) { t.effectors[0].p_LE = {0, 0, 1.1e6}; }), "a limb has no length");
  EXPECT_EQ(fault([](T& t, P&, O&) { t.effectors[0].p_LE = glm::dvec3(0); }), "a limb has no length");
  for (const int joint : {-1, static_cast<int>(kBodyTreeJointCount)}) {
    EXPECT_EQ(fault([&](T& t, P&, O&) { t.effectors[3].joint = joint; }),
              "the joints do not form a tree whose first joint is the root");
  }
  EXPECT_EQ(fault([](T& t, P&, O&) { t.effectors[3].joint = 0; }), "");
  EXPECT_EQ(fault([](T& t, P&, O&) { t.joints[0].dof_count = 1; }),
            "the joints do not form a tree whose first joint is the root");
  EXPECT_EQ(fault([](T& t, P&, O&) { t.joints[5].dof_count = 4; }),
            "the joints do not form a tree whose first joint is the root");
  EXPECT_EQ(fault([](T& t, P&, O&) { t.joints[5].parent = 5; }),
            "the joints do not form a tree whose first joint is the root");
  EXPECT_EQ(fault([](T& t, P&, O&) { t.limits.push_back({}); }),
            "the joints do not form a tree whose first joint is the root");
  KinematicTree few;
  few.joints = {{}, {.name = "", .parent = 0, .p_PJ = {0, 0, 1}, .dof_count = 3}};
  few.limits.resize(3);
  EXPECT_EQ(FindTreeFault(few), "");
  few.joints[1].dof_count = 4;
  few.limits.resize(4);
  EXPECT_NE(FindTreeFault(few), "") << "no joint turns about four axes";
  few.joints[1].dof_count = -1;
  few.joints.push_back({.name = "", .parent = 1, .p_PJ = {0, 0, 1}, .first_dof = -1, .dof_count = 1});
  few.limits.clear();
  EXPECT_NE(FindTreeFault(few), "") << "nor about less than none";
}

}  // namespace
}  // namespace etude
