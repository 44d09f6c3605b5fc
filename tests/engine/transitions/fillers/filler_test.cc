#include "engine/transitions/fillers/filler.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/named.h"
#include "engine/transitions/fillers/gap_library.h"

namespace etude {
namespace {

using Law = std::function<glm::dvec3(const Ends&, double)>;

const Filler& FillerOf(const char* name) { return *FindByName(AllFillers(), name); }

JointTree ThreeJoints() {
  return {{"root", "knee", "foot"}, {-1, 0, 1}, {{0, 0, 0}, {0, -0.4, 0.05}, {0, -0.4, 0}}, {false, false, false}};
}

/// Returns a root with constant velocity and joints turning about fixed axes at constant speed; at speed 0 it rests.
std::vector<TreePose> Steady(std::size_t frames, double speed) {
  std::vector<TreePose> poses;
  for (std::size_t f = 0; f < frames; ++f) {
    const double t = speed * static_cast<double>(f);
    poses.push_back({glm::dvec3(0.02, 0.001, -0.03) * t + glm::dvec3(1, 0.9, 2),
                     {TurnOf(glm::dvec3(0, 0.3, 0.1)) * TurnOf(t * glm::dvec3(0.01, 0.02, 0)),
                      TurnOf(t * glm::dvec3(-0.03, 0, 0.01)), TurnOf(glm::dvec3(1, 0, 0))}});
  }
  return poses;
}

/// Returns a motion that changes its speed and rotates everywhere.
std::vector<TreePose> Wild(std::size_t frames) {
  std::vector<TreePose> poses;
  for (std::size_t f = 0; f < frames; ++f) {
    const double t = 0.1 * static_cast<double>(f);
    poses.push_back({{std::sin(t), 0.9 + 0.05 * std::cos(2 * t), t * t / 20},
                     {TurnOf({0.1 * std::sin(3 * t), t / 3, 0}), TurnOf({std::sin(t), 0.2 * std::cos(5 * t), 0}),
                      TurnOf({0, 0, std::cos(t)})}});
  }
  return poses;
}

double FarthestApart(std::span<const TreePose> a, std::span<const TreePose> b) {
  double farthest = a.size() == b.size() ? 0 : 1e9;
  for (std::size_t f = 0; f < std::min(a.size(), b.size()); ++f) {
    farthest = std::max(farthest, glm::distance(a[f].root, b[f].root));
    for (std::size_t j = 0; j < a[f].turns.size(); ++j) {
      farthest = std::max(farthest, glm::length(RotationVector(glm::conjugate(a[f].turns[j]) * b[f].turns[j])));
    }
  }
  return farthest;
}

/// Returns the filler's error in the frames that it does not see.
double ErrorOf(const Filler& filler, const std::vector<TreePose>& poses, std::size_t past, std::size_t missing,
               std::size_t given, const GapLibrary* library = nullptr) {
  const JointTree tree = ThreeJoints();
  const std::span all = poses;
  const Gap gap{tree, all.first(past), all.subspan(past + missing, given), missing, 30, library};
  return FarthestApart(filler.fill(gap, {}), all.subspan(past, missing));
}

TEST(Fillers, FillASteadyMotionExactlyIfTheyKnowSpeeds) {
  for (const std::size_t given : {1u, 2u}) {
    EXPECT_LT(ErrorOf(FillerOf("inertialised"), Steady(30, 1), 5, 12, given), 1e-9);
    EXPECT_LT(ErrorOf(FillerOf("minimum-jerk"), Steady(30, 1), 5, 12, given), 1e-9);
    EXPECT_LT(ErrorOf(FillerOf("interpolation"), Steady(30, 1), 5, 12, given), 1e-3)
        << "a chord, not an arc, below 16°";
    EXPECT_LT(ErrorOf(FillerOf("interpolation"), Steady(30, 4), 5, 12, given), 1e-9) << "arcs above";
  }
  EXPECT_GT(ErrorOf(FillerOf("zero-velocity"), Steady(30, 1), 5, 12, 1), 0.3);
  EXPECT_GT(ErrorOf(FillerOf("dead-blending"), Steady(30, 1), 5, 12, 2), 0.004) << "its velocities decay";
}

TEST(Fillers, HoldABodyThatStands) {
  for (const Filler& filler : AllFillers()) {
    if (filler.uses_library) continue;
    EXPECT_LT(ErrorOf(filler, Steady(30, 0), 3, 20, 1), 1e-12) << filler.name;
    EXPECT_LT(ErrorOf(filler, Steady(30, 0), 3, 20, 2), 1e-12) << filler.name;
    EXPECT_GT(ErrorOf(filler, Wild(60), 3, 20, 1), 0.01) << filler.name;
  }
}

/// Returns a law's largest error of position and velocity at both ends.
double ErrorAtEnds(const Law& law, const Ends& ends) {
  constexpr double kStep = 1e-6;
  const double last = ends.seconds;
  const glm::dvec3 first_velocity = (law(ends, kStep) - law(ends, 0)) / kStep;
  const glm::dvec3 last_velocity = (law(ends, last) - law(ends, last - kStep)) / kStep;
  return std::max({glm::distance(law(ends, 0), ends.start), glm::distance(law(ends, last), ends.end),
                   glm::distance(first_velocity, ends.start_velocity),
                   ends.end_velocity ? glm::distance(last_velocity, *ends.end_velocity) : 0.0});
}

TEST(Fillers, MeetBothEndsWithTheirVelocities) {
  const Ends known{{1, 2, 3}, {-4, 0.5, 2}, {0, 2.5, 3.5}, glm::dvec3(3, -2, 1), 0.7},
      unknown{{1, 2, 3}, {-4, 0.5, 2}, {0, 2.5, 3.5}, {}, 0.7};
  for (const Ends& ends : {known, unknown}) {
    const Law laws[] = {[](const Ends& e, double t) { return InertialisedAt(e, t, 0.1); },
                        [](const Ends& e, double t) { return DeadBlendedAt(e, t, 0.2); }, LeastJerkAt};
    for (const Law& law : laws) EXPECT_LT(ErrorAtEnds(law, ends), 1e-3);
  }
  const Law straight = [](const Ends& e, double t) { return e.start + t / e.seconds * (e.end - e.start); };
  EXPECT_GT(ErrorAtEnds(straight, known), 1) << "a straight line does not";
}

double JerkOf(const Ends& ends) {
  constexpr int kSteps = 400;
  const double step = ends.seconds / kSteps;
  double sum = 0;
  for (int i = 0; i + 3 <= kSteps; ++i) {
    const auto at = [&](int k) { return LeastJerkAt(ends, step * (i + k)); };
    const glm::dvec3 third = at(3) - 3.0 * at(2) + 3.0 * at(1) - at(0);
    sum += glm::dot(third, third);
  }
  return sum;
}

TEST(Fillers, LeaveAnUnknownVelocityWhereTheJerkIsLeast) {
  Ends ends{{0, 0, 0}, {1, -2, 0}, {0.3, 0.2, -0.4}, {}, 0.5};
  const double least = JerkOf(ends);
  EXPECT_GT(least, 0);
  for (double x = -4; x <= 4; x += 0.5) {
    for (double y = -4; y <= 4; y += 0.5) {
      ends.end_velocity = glm::dvec3(x, y, -1.5);
      EXPECT_GT(JerkOf(ends), 0.999 * least);
    }
  }
}

/// A body of hips and two legs with bent knees.
struct Walker {
  Walker() {
    for (const double x : {0.1, -0.1}) {
      const int hip = static_cast<int>(tree.names.size());
      for (const char* name : {"hip", "knee", "ankle", "toes"}) tree.names.emplace_back(name);
      tree.parents.insert(tree.parents.end(), {0, hip, hip + 1, hip + 2});
      tree.offsets.insert(tree.offsets.end(), {{x, 0, 0}, {0, -0.45, 0.15}, {0, -0.44, -0.15}, {0, -0.06, 0.15}});
    }
    tree.is_point.resize(tree.size());
    using enum Role;
    int joint = 1;
    for (const Role role : {kLeftHip, kLeftKnee, kLeftAnkle, kLeftFoot}) {
      roles[Index(role)] = joint;
      roles[Index(Mirrored(role))] = 4 + joint++;
    }
  }
  TreePose At(double x, double z) const {
    return {{x, 0.95, z}, std::vector<glm::dquat>(tree.size(), glm::dquat(1, 0, 0, 0))};
  }
  /// Fills 30 frames at 30 Hz between the body at rest at the origin and the pose `end`.
  std::vector<TreePose> Filled(const char* filler, const TreePose& end, bool knows_roles = true) const {
    const std::vector<TreePose> past(10, At(0, 0)), future(1, end);
    const auto none = RawMotion::NoRoles();
    return FillerOf(filler).fill({tree, past, future, 30, 30, nullptr, knows_roles ? roles : none}, {});
  }
  /// Returns the largest speed of the slower toes, m/s, and the largest height of any toes.
  std::pair<double, double> SlowerToes(std::vector<TreePose> poses) const {
    poses.insert(poses.begin(), At(0, 0));
    double fastest = 0, highest = 0;
    std::vector<glm::dvec3> before;
    for (const TreePose& pose : poses) {
      std::vector<glm::dvec3> at;
      std::vector<glm::dquat> turns;
      AppendGlobals(tree, pose, at, turns);
      if (!before.empty()) {
        fastest = std::max(fastest, 30 * std::min(glm::distance(at[4], before[4]), glm::distance(at[8], before[8])));
      }
      highest = std::max({highest, at[4].y, at[8].y});
      before = at;
    }
    return {fastest, highest};
  }

  JointTree tree{{"hips"}, {-1}, {{0, 0, 0}}, {false}};
  std::array<int, kRoleCount> roles = RawMotion::NoRoles();
};

TEST(PlantedFeet, StandOnOneFootWhileTheOtherSteps) {
  const Walker walker;
  for (const auto& [x, z] : {std::pair{0.0, 0.6}, {0.4, 0.0}, {-0.2, -0.3}}) {
    const auto [speed, height] = walker.SlowerToes(walker.Filled("planted-feet", walker.At(x, z)));
    EXPECT_LT(speed, 0.25) << x << ' ' << z;
    EXPECT_GT(height, 0.02) << "a step is lifted";
    EXPECT_GT(walker.SlowerToes(walker.Filled("near-gaps", walker.At(x, z))).first, 0.35) << "the control glides";
  }
}

TEST(PlantedFeet, ChangeNothingWhereNothingMovesOrNoRoleIsKnown) {
  const Walker walker;
  EXPECT_LT(FarthestApart(walker.Filled("planted-feet", walker.At(0, 0)), std::vector<TreePose>(30, walker.At(0, 0))),
            1e-6);
  EXPECT_EQ(
      FarthestApart(walker.Filled("planted-feet", walker.At(0, 1), false), walker.Filled("near-gaps", walker.At(0, 1))),
      0);
}

TEST(Fillers, FindAGapInALibraryThatHoldsItTurnedAndMoved) {
  const std::vector<TreePose> poses = Wild(80);
  TreeMotion held{ThreeJoints(), 30, Wild(80)}, other{ThreeJoints(), 30, Steady(80, 1)};
  const glm::dquat turn = TurnOf({0, 1.2, 0});
  for (TreePose& pose : held.poses)
    pose = {turn * pose.root + glm::dvec3(4, 0, -7), {turn * pose.turns[0], pose.turns[1], pose.turns[2]}};
  GapLibrary library;
  library.Add(other);
  EXPECT_GT(ErrorOf(FillerOf("nearest-gap"), poses, 10, 20, 1, &library), 0.1);
  library.Add(held);
  EXPECT_LT(ErrorOf(FillerOf("nearest-gap"), poses, 10, 20, 1, &library), 1e-9);
  EXPECT_EQ(ErrorOf(FillerOf("nearest-gap"), poses, 10, 20, 1), 1e9) << "without a library nothing is filled";
  // With one identical gap in the library and no other near, a third of dead blending's error is removed (weights 1 and
  // 2).
  GapLibrary of_held;
  of_held.Add(held);
  EXPECT_NEAR(
      ErrorOf(FillerOf("near-gaps"), poses, 10, 20, 1, &of_held) / ErrorOf(FillerOf("near-gaps"), poses, 10, 20, 1),
      2.0 / 3, 0.05);
  TreeMotion renamed = held;
  renamed.tree.names[2] = "toe";
  GapLibrary of_another_tree;
  of_another_tree.Add(renamed);
  EXPECT_EQ(ErrorOf(FillerOf("nearest-gap"), poses, 10, 20, 1, &of_another_tree), 1e9);
}

}  // namespace
}  // namespace etude
