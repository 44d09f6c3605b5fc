// Golden values of whole results: bodies made of measurements, poses found in what was seen, faults at their bounds.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/kinematics/capture_body.h"
#include "engine/kinematics/ik_batch.h"
#include "engine/kinematics/joint_limits.h"
#include "engine/kinematics/start_angles.h"
#include "tests/engine/kinematics/observed_tree.h"
#include "tests/engine/kinematics/random_tree.h"
#include "tests/engine/kinematics/rest_bodies.h"
#include "tests/support/fingerprint.h"

namespace etude {
namespace {

using testing::Dice;
using testing::Fingerprint;
using Kept = std::pair<std::size_t, double>;

void AddLengths(const LimbLengths& l, Fingerprint& print) {
  print.Add(l.foot).Add(l.shank).Add(l.thigh).Add(l.hip_width).Add(l.trunk).Add(l.neck).Add(l.shoulder_width);
  print.Add(l.upper_arm).Add(l.forearm).Add(l.hand);
}

void AddAxes(const glm::dmat3& axes, Fingerprint& print) { print.Add(axes[0]).Add(axes[1]).Add(axes[2]); }

void AddTree(const KinematicTree& tree, Fingerprint& print) {
  for (const TreeJoint& joint : tree.joints) {
    print.Add(joint.parent).Add(joint.p_PJ).Add(joint.first_dof).Add(joint.dof_count).Add(joint.name.size());
    AddAxes(joint.R_PJ, print);
  }
  for (const Effector& effector : tree.effectors) print.Add(effector.joint).Add(effector.p_LE);
  for (const AngleRange& range : tree.limits) print.Add(range.lower).Add(range.upper);
  AddAxes(tree.standing_root, print);
}

void AddBody(const CaptureBody& body, Fingerprint& print) {
  AddTree(body.tree, print);
  print.Add(body.is_paper).Add(body.hips_turn).Add(body.bones).Add(body.is_rigid);
  for (const TreePoint& point : body.roles) print.Add(point.joint).Add(point.p_LQ);
  for (const auto& end : body.ends) print.Add(end.role).Add(end.has_position).Add(end.has_direction).Add(end.sense);
  for (const auto& [joint, upper, middle, lower, bends] : body.twists) {
    print.Add(joint).Add(upper).Add(middle).Add(lower).Add(bends);
  }
  AddLengths(body.lengths, print);
  for (const CaptureBody::ClipJoint& joint : body.skeleton) {
    print.Add(joint.parent).Add(joint.offset).Add(joint.limb).Add(joint.is_end);
    AddAxes(joint.R_LC, print);
  }
  print.Add(body.skeleton_root.joint).Add(body.skeleton_root.p_LQ);
}

// The rest body with every joint and role off by so much, in another pose.
RestBody Uneven(RestBody body, double metres) {
  Dice dice(4);
  for (RestBody::Joint& joint : body.joints) joint.position += metres * dice.Vector();
  for (RestBody::RolePlace& place : body.roles) place.position += metres * dice.Vector();
  return body;
}

std::vector<RestBody> RestBodies() {
  RestBody lying = PlainRestBody(), sideways = JointedRestBody();
  for (RestBody* body : {&lying, &sideways}) {
    const auto turn = [&](glm::dvec3& p) {
      p = body == &lying ? glm::dvec3(p.x, -p.z, p.y) : glm::dvec3(p.y, -p.x, p.z);
    };
    for (RestBody::Joint& joint : body->joints) turn(joint.position);
    for (RestBody::RolePlace& place : body->roles) turn(place.position);
  }
  std::vector<RestBody> bodies = {lying, sideways};
  for (const RestBody& body : {PlainRestBody(), JointedRestBody(), SensorRestBody()}) {
    for (const double metres : {0.0, 3e-7, 3e-5, 0.02}) bodies.push_back(Uneven(body, metres));
  }
  return bodies;
}

TEST(Kinematics, GoldenBodies) {
  Fingerprint print;
  AddBody(PaperBody({}), print);
  AddBody(PaperBody({.foot = 0.2, .hip_width = 0.21, .trunk = 0.55, .neck = 0.2, .forearm = 0.22}), print);
  for (const RestBody& rest : RestBodies()) {
    const auto body = FittedBody(rest);
    print.Add(body.has_value());
    if (body) AddBody(*body, print);
  }
  EXPECT_TRUE(print.Is(14794, -41.668147703));
}

TEST(Kinematics, GoldenPosesAndClipsOfBodies) {
  Fingerprint print;
  std::vector<CaptureBody> bodies = {PaperBody({})};
  for (const RestBody& rest : RestBodies()) bodies.push_back(*FittedBody(rest));
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const CaptureBody& body = bodies[b];
    std::vector<TreeState> states;
    for (int trial = 0; trial < 2; ++trial) states.push_back(RandomPose(body.tree, trial, 0.2));
    const BodyPose pose = ToBodyPose(body, states[0]);
    print.Add(pose.joints);
    const Clip clip = ToClip(body, states, 25, "clip");
    for (const Joint& joint : clip.skeleton.joints) {
      print.Add(joint.parent).Add(joint.rest.translation).Add(joint.name.size());
    }
    for (const LocalPose& frame : clip.frames) {
      for (const LocalTransform& joint : frame) print.Add(joint.translation).Add(joint.rotation);
    }
    LimbObservation seen = Disturb(Observe(pose), static_cast<int>(b), 0.02, 9);
    seen.lacks_end[Index(Role::kHead)] = b % 2 == 1;
    seen.lacks_direction[Index(Role::kLeftHand)] = b % 3 == 1;
    for (const EffectorTarget& target : MakeImageProblem(body, seen, states[1]).targets) {
      print.Add(target.position).Add(target.position_weight).Add(target.axis_weights);
      AddAxes(target.axes, print);
    }
  }
  EXPECT_TRUE(print.Is(12498, -143.837722126));
}

TEST(Kinematics, GoldenLengthsObservationsAndStarts) {
  Fingerprint lengths_print, seen_print, start_print;
  const LimbLengths lengths{.foot = 0.2, .hip_width = 0.2, .neck = 0.22};
  for (int trial = 0; trial < 24; ++trial) {
    const BodyPose pose = ToBodyPose(Body(), RandomPose(Body(), trial, 1.0));
    const BodyPose like = ToBodyPose(Body(), RandomPose(Body(), trial + 100, 0.6));
    const std::array<BodyPose, 2> both = {pose, like};
    AddLengths(MeasureLimbLengths(both), lengths_print);
    LimbObservation seen = Disturb(Observe(pose), trial, 0.05, 20);
    const auto fixed = FixLimbLengths(seen, lengths);
    lengths_print.Add(fixed.has_value());
    if (fixed) lengths_print.Add(fixed->joints);

    Dice dice(trial);
    for (bool& lacks : seen.lacks_end) lacks = trial == 23 || dice.Below(3) == 0;
    for (bool& lacks : seen.lacks_direction) lacks = dice.Below(4) == 0;
    if (trial % 5 == 4) seen.directions[Index(Role::kLeftElbow)] = glm::dvec3(0);
    for (const bool is_placed : {false, true}) {
      const auto whole = CompleteObservation(seen, lengths, like, is_placed);
      seen_print.Add(whole.has_value());
      if (!whole || trial % 5 == 4) continue;
      seen_print.Add(whole->ends.joints).Add(whole->directions).Add(whole->lacks_end).Add(whole->lacks_direction);
    }

    BodyPose target = fixed.value_or(pose);
    const glm::dvec3 aside = 0.01 * glm::normalize(glm::cross(glm::dvec3(1, 2, 3), target[Role::kLeftHip]));
    if (trial % 6 == 5) {  // toe, ankle, knee and hip nearly in one line
      const glm::dvec3 up = target[Role::kLeftHip] - target[Role::kLeftKnee];
      target[Role::kLeftAnkle] = target[Role::kLeftKnee] - up;
      target[Role::kLeftFoot] = target[Role::kLeftAnkle] - 0.3 * up + (trial % 4) * 0.2 * aside;
    }
    if (trial % 6 == 2) {  // as an arm
      target[Role::kRightWrist] =
          2.0 * target[Role::kRightElbow] - target[Role::kRightShoulder] + 1.0 * (trial % 4) * aside;
    }
    if (trial % 6 == 1) {  // and shoulders and trunk
      const glm::dvec3 trunk = target[Role::kShoulderCentre] - target[Role::kHipCentre];
      target[Role::kRightShoulder] = target[Role::kLeftShoulder] + 0.3 * trunk + 6e-5 * (trial % 4) * aside;
    }
    for (const LimitSet set : {LimitSet::kAdult, LimitSet::kAma}) {
      const auto start = FindStartState(Body(), target, JointLimits(set));
      start_print.Add(start.has_value());
      if (start) start_print.Add(start->root_position).Add(start->angles);
      if (start) AddAxes(start->root_frame, start_print);
    }
  }
  EXPECT_TRUE(lengths_print.Is(1728, -37.027862897));
  EXPECT_TRUE(seen_print.Is(6444, -207.871988979));
  EXPECT_TRUE(start_print.Is(2064, 40.2126867925));
}

TEST(Kinematics, GoldenLimitsTreesAndFrames) {
  Fingerprint print;
  for (const std::string& name : LimitSetNames()) {
    for (const AngleRange& range : JointLimits(*FindLimitSet(name))) print.Add(range.lower).Add(range.upper);
  }
  for (int trial = 0; trial < 8; ++trial) {
    const KinematicTree tree = RandomTree(trial, 3 + trial);
    const TreeState state = RandomPose(tree, trial, 1.5);
    const TreeFrames frames = ComputeFrames(tree, state);
    for (const LimbFrame& frame : frames.joints) AddAxes(frame.axes, print.Add(frame.position));
    for (const LimbFrame& frame : frames.effectors) AddAxes(frame.axes, print.Add(frame.position));
    for (const glm::dmat3& axes : frames.R_WJ) AddAxes(axes, print);
    print.Add(frames.dof_axes);
    for (std::size_t j = 0; j < tree.joints.size(); ++j) {
      print.Add(JointAngles(tree.joints[j], state.angles));
      for (int axis = 0; axis < tree.joints[j].dof_count; ++axis) {
        print.Add(DofAxis(tree.joints[j], frames.R_WJ[j], state.angles, axis));
      }
    }
    for (const double angle : state.angles) print.Add(ClampAngle(3 * angle, {-0.7, 1.1}));
  }
  for (int count = 1; count < 40; ++count) print.Add(IkBatch(Body(), count).column(0).stride);
  EXPECT_TRUE(print.Is(2368, 155.234212422));
}

TEST(Kinematics, GoldenReachWeightsAndRanges) {
  Fingerprint print;
  for (int trial = 0; trial < 60; ++trial) {
    const KinematicTree tree = RandomTree(trial, 4 + trial % 7);
    IkProblem problem = DisturbedProblem(tree, RandomPose(tree, trial, 1), trial, 30);
    Dice dice(trial);
    for (EffectorTarget& target : problem.targets) {
      target.position += (trial % 4 == 0 ? 2.5 : 1.2) * dice.Vector();
      if (dice.Below(3) == 0) target.axis_weights[dice.Below(3)] = 0;
      if (dice.Below(4) == 0) target.position_weight = 0;
    }
    print.Add(IsOutOfReach(tree, problem));
    IkOptions options;
    options.limits = trial % 3 != 0;
    if (trial % 2 == 0) options.angle_change_tolerance = 0.1 * trial;
    for (const AngleRange& range : AllowedRanges(problem, options)) {
      print.Add(std::max(range.lower, -9.0)).Add(std::min(range.upper, 9.0));
    }
  }
  const IkOptions defaults;
  print.Add(EffectorWeights{}.position).Add(EffectorWeights{}.axes).Add(EffectorTarget{}.position_weight);
  print.Add(EffectorTarget{}.axis_weights).Add(WeightFormula{}.position).Add(WeightFormula{}.axis);
  print.Add(defaults.limits).Add(defaults.max_iterations).Add(1e3 * defaults.position_goal);
  print.Add(1e3 * defaults.axis_goal).Add(1e10 * defaults.stall_change).Add(defaults.trace);
  for (const std::string& name : WeightRuleNames()) {
    const WeightRule rule = *FindWeightRule(name);
    const EffectorWeights weights = ComputeWeights(rule, 0.07, {0.3, 0.02, 1.1});
    const WeightFormula formula = FormulaOf(rule);
    print.Add(weights.position / 1e4).Add(weights.axes).Add(formula.position / 1e4).Add(formula.axis);
    print.Add(formula.power).Add(IsAdaptive(rule));
  }
  EXPECT_TRUE(print.Is(1188, 157.87669931));
}

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
    RestBody::RolePlace& hand = rest.roles[Index(Role::kLeftHand)];
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
  // From the toe up the left leg, across half the hips, up trunk and neck: the navel's joint and the head's.
  const double reach = l.foot + l.shank + l.thigh + l.hip_width / 2 + l.trunk + l.neck;
  for (const double beyond : {5e-10, 2e-9}) {
    problem.targets[3].position = problem.start.root_position + glm::dvec3(0, reach + beyond, 0);
    EXPECT_EQ(IsOutOfReach(body, problem), beyond > 1e-9) << beyond;
  }
}

// At a bound and a hair beyond it, and what is said then.
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
  EXPECT_EQ(fault([](T&, P& p, O&) { p.start.root_position.y = 1.0001e6; }), "the root is no finite frame");
  EXPECT_EQ(fault([](T&, P& p, O&) { p.start.root_frame[0] *= 1 + 0.9e-6; }), "");
  EXPECT_EQ(fault([](T&, P& p, O&) { p.start.root_frame[0] *= 1 + 1.1e-6; }), "the root is no finite frame");
  EXPECT_EQ(fault([](T&, P& p, O&) { p.start.angles[3] = -1e6; }), "");
  EXPECT_EQ(fault([](T&, P& p, O&) { p.start.angles[3] = -1.0001e6; }), "a start angle is not finite");
  EXPECT_EQ(fault([](T&, P& p, O&) { p.limits[3] = {0.5, 0.5}; }), "");
  EXPECT_EQ(fault([](T&, P& p, O&) { p.limits[3] = {0.5, 0.4999}; }), "a limit is inverted");
  EXPECT_EQ(fault([](T&, P& p, O&) { p.targets[1].axis_weights.y = 1e6; }), "");
  EXPECT_EQ(fault([](T&, P& p, O&) { p.targets[1].position_weight = 1.1e6; }),
            "a target is no finite frame with weights");
  EXPECT_EQ(fault([](T&, P& p, O&) { p.targets[2].axis_weights.y = -1e-9; }),
            "a target is no finite frame with weights");
  EXPECT_EQ(fault([](T&, P& p, O&) { p.targets.pop_back(); }), "targets do not fit the tree");
  EXPECT_EQ(fault([](T&, P& p, O&) { p.limits.pop_back(); }), "angles or limits do not fit the tree");
  EXPECT_EQ(fault([](T&, P&, O& o) { o.angle_change_tolerance = 0; }), "");
  EXPECT_EQ(fault([](T&, P&, O& o) { o.angle_change_tolerance = -1e-9; }), "the angle-change tolerance is negative");
  EXPECT_EQ(fault([](T&, P&, O& o) { o.max_iterations = 1; }), "");
  EXPECT_EQ(fault([](T&, P&, O& o) { o.max_iterations = 0; }), "the iteration limit is below 1");
  EXPECT_EQ(fault([](T& t, P&, O&) { t.joints[1].p_PJ = glm::dvec3(0); }), "") << "it stands where the root does";
  EXPECT_EQ(fault([](T& t, P&, O&) { t.joints[2].p_PJ = glm::dvec3(0); }), "a limb has no length");
  EXPECT_EQ(fault([](T& t, P&, O&) { t.effectors[0].p_LE = {0, 0, 1.1e6}; }), "a limb has no length");
  EXPECT_EQ(fault([](T& t, P&, O&) { t.effectors[0].p_LE = glm::dvec3(0); }), "a limb has no length");
  for (const int joint : {-1, static_cast<int>(kBodyTreeJointCount)}) {
    EXPECT_EQ(fault([&](T& t, P&, O&) { t.effectors[3].joint = joint; }), "the joints are no tree with its root first");
  }
  EXPECT_EQ(fault([](T& t, P&, O&) { t.effectors[3].joint = 0; }), "");
  EXPECT_EQ(fault([](T& t, P&, O&) { t.joints[0].dof_count = 1; }), "the joints are no tree with its root first");
  EXPECT_EQ(fault([](T& t, P&, O&) { t.joints[5].dof_count = 4; }), "the joints are no tree with its root first");
  EXPECT_EQ(fault([](T& t, P&, O&) { t.joints[5].parent = 5; }), "the joints are no tree with its root first");
  EXPECT_EQ(fault([](T& t, P&, O&) { t.limits.push_back({}); }), "the joints are no tree with its root first");
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
