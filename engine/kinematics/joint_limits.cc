#include "engine/kinematics/joint_limits.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "engine/base/angles.h"
#include "engine/base/named.h"
#include "engine/kinematics/body_tree.h"

namespace etude {
namespace {

constexpr Named<LimitSet> kLimitSets[] = {{"adult", LimitSet::kAdult},
                                          {"aaos", LimitSet::kAaos},
                                          {"kendall", LimitSet::kKendall},
                                          {"hoppenfeld", LimitSet::kHoppenfeld},
                                          {"ama", LimitSet::kAma}};

constexpr double kMaxSidewaysDeg = 80;
constexpr double kNotGiven = -1;

// The extreme angles of one movement, degrees from the anatomical position: one per column of paper B's table 3.1.
using Movement = std::array<double, 4>;
constexpr Movement kNone{0, 0, 0, 0};
constexpr Movement kShoulderFlexion{180, 180, 90, 150};
constexpr Movement kShoulderExtension{60, 45, 45, 50};
constexpr Movement kShoulderAbduction{180, 180, 180, 180};
constexpr Movement kShoulderAdduction{30, 30, 30, 30};  // not in table 3.1; ours
constexpr Movement kShoulderInner{70, 70, 55, 90};
constexpr Movement kShoulderOuter{90, 90, 45, 90};
constexpr Movement kElbowFlexion{150, 145, 150, 140};
constexpr Movement kWristExtension{70, 70, 70, 60};
constexpr Movement kWristFlexion{80, 80, 80, 60};
constexpr Movement kWristRadial{20, 20, 20, 20};
constexpr Movement kWristUlnar{30, 35, 30, 30};
constexpr Movement kHipFlexion{120, 125, 135, 100};
constexpr Movement kHipExtension{30, 10, 30, 30};
constexpr Movement kHipAbduction{45, 45, 50, 40};
constexpr Movement kHipAdduction{30, 10, 30, 20};
constexpr Movement kHipOuter{45, 45, 45, 40};
constexpr Movement kHipInner{45, 45, 35, 50};
constexpr Movement kKneeFlexion{135, 140, 135, 150};
constexpr Movement kAnkleDorsiflexion{20, 20, 20, 20};
constexpr Movement kAnklePlantarflexion{50, 45, 50, 40};
constexpr Movement kAnkleInversion{35, 35, kNotGiven, 30};
constexpr Movement kAnkleEversion{15, 20, kNotGiven, 20};
constexpr Movement kNeckFlexion{45, 45, kNotGiven, 60};
constexpr Movement kNeckExtension{45, 45, kNotGiven, 75};
constexpr Movement kNeckSide{45, kNotGiven, 45, 45};
constexpr Movement kNeckRotation{60, kNotGiven, kNotGiven, 80};
constexpr Movement kTrunkFlexion{80, kNotGiven, kNotGiven, 50};
constexpr Movement kTrunkExtension{25, kNotGiven, kNotGiven, 25};
constexpr Movement kTrunkSide{35, kNotGiven, kNotGiven, 25};
constexpr Movement kTrunkRotation{45, kNotGiven, kNotGiven, 30};

// One degree of freedom: the movement that decreases its angle and the movement that increases it.
struct DofRow {
  BodyTreeJoint joint;
  int axis;
  const Movement& falls;
  const Movement& rises;
};

// The rows of all degrees of freedom, in the order of the tree's angles.
constexpr std::array<DofRow, 29> kDofs = {{
    {kTreeLeftAnkle, 0, kAnkleDorsiflexion, kAnklePlantarflexion},
    {kTreeLeftKnee, 0, kNone, kKneeFlexion},
    {kTreeLeftHip, 0, kHipAbduction, kHipAdduction},
    {kTreeLeftHip, 1, kHipOuter, kHipInner},
    {kTreeLeftHip, 2, kHipFlexion, kHipExtension},
    {kTreeNavel, 0, kTrunkFlexion, kTrunkExtension},
    {kTreeNavel, 1, kTrunkSide, kTrunkSide},
    {kTreeNavel, 2, kTrunkRotation, kTrunkRotation},
    {kTreeLeftShoulder, 0, kShoulderExtension, kShoulderFlexion},
    {kTreeLeftShoulder, 1, kShoulderAbduction, kShoulderAdduction},
    {kTreeLeftShoulder, 2, kShoulderOuter, kShoulderInner},
    {kTreeLeftElbow, 0, kNone, kElbowFlexion},
    {kTreeLeftWrist, 0, kWristExtension, kWristFlexion},
    {kTreeLeftWrist, 1, kWristRadial, kWristUlnar},
    {kTreeRightShoulder, 0, kShoulderExtension, kShoulderFlexion},
    {kTreeRightShoulder, 1, kShoulderAdduction, kShoulderAbduction},
    {kTreeRightShoulder, 2, kShoulderInner, kShoulderOuter},
    {kTreeRightElbow, 0, kNone, kElbowFlexion},
    {kTreeRightWrist, 0, kWristExtension, kWristFlexion},
    {kTreeRightWrist, 1, kWristUlnar, kWristRadial},
    {kTreeNeck, 0, kNeckFlexion, kNeckExtension},
    {kTreeNeck, 1, kNeckSide, kNeckSide},
    {kTreeNeck, 2, kNeckRotation, kNeckRotation},
    {kTreeRightHip, 0, kHipExtension, kHipFlexion},
    {kTreeRightHip, 1, kHipAdduction, kHipAbduction},
    {kTreeRightHip, 2, kHipInner, kHipOuter},
    {kTreeRightKnee, 0, kKneeFlexion, kNone},
    {kTreeRightAnkle, 0, kAnklePlantarflexion, kAnkleDorsiflexion},
    {kTreeRightAnkle, 1, kAnkleInversion, kAnkleEversion},
}};

// Returns the extreme angle of a movement, radians.
double Reach(const Movement& movement, int column, int axis) {
  const double degrees = movement[column] == kNotGiven ? movement[0] : movement[column];
  return Radians(axis == 1 ? std::min(degrees, kMaxSidewaysDeg) : degrees);
}

}  // namespace

const std::vector<std::string>& LimitSetNames() {
  static const std::vector<std::string> names = NamesOf(kLimitSets);
  return names;
}

std::optional<LimitSet> FindLimitSet(std::string_view name) { return FindValue(kLimitSets, name); }

std::vector<AngleRange> JointLimits(LimitSet set) {
  const KinematicTree body = MakeBodyTree({});
  if (set == LimitSet::kAdult) return body.limits;
  const int column = static_cast<int>(set) - static_cast<int>(LimitSet::kAaos);
  std::vector<AngleRange> limits;
  for (const DofRow& dof : kDofs) {
    assert(body.joints[dof.joint].first_dof + dof.axis == static_cast<int>(limits.size()));
    limits.push_back({0 - Reach(dof.falls, column, dof.axis), Reach(dof.rises, column, dof.axis)});
  }
  assert(limits.size() == body.limits.size());
  return limits;
}

}  // namespace etude
