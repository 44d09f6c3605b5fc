#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ranges>

#include "engine/motion/character.h"
#include "engine/motion/clip.h"
#include "engine/motion/edit.h"
#include "engine/motion/rest_body.h"
#include "engine/motion/statistics.h"
#include "engine/motion/support.h"
#include "sim/choreography/move.h"
#include "tests/engine/motion/standing_body.h"
#include "tests/support/fingerprint.h"
#include "tests/support/person.h"
#include "tests/support/random_clip.h"

namespace etude {
namespace {

using testing::Fingerprint;

BodyMotion NoisyMove(const std::string& name, double noise, double rate_hz = kJudgedRateHz) {
  testing::Dice dice(name.size());
  BodyMotion motion = LoadBuiltinMove(name).value().motion;
  motion.rate_hz = rate_hz;
  for (BodyPose& pose : motion.poses) {
    for (glm::dvec3& joint : pose.joints) joint += noise * dice.Vector();
  }
  return motion;
}

std::vector<BodyMotion> SomeMotions() {
  std::vector<BodyMotion> motions;
  for (const char* name : {"jump", "side_kick", "aerobic", "sway"}) {
    for (const double noise : {0.0, 0.004}) motions.push_back(NoisyMove(name, noise));
  }
  motions.push_back(NoisyMove("boxing", 0.002, 50));
  BodyMotion lying = motions[1], gliding = motions[7], walking = motions[5];
  for (BodyPose& pose : lying.poses) {
    for (glm::dvec3& joint : pose.joints) joint = {joint.x, joint.z, -joint.y};
  }
  for (std::size_t f = 0; f < gliding.poses.size(); ++f) {
    for (glm::dvec3& joint : gliding.poses[f].joints) joint.x += 0.05 * static_cast<double>(f);
  }
  for (std::size_t f = 0; f < walking.poses.size(); ++f) {
    for (glm::dvec3& joint : walking.poses[f].joints) joint += glm::dvec3(0.008, 0.001, -0.01) * static_cast<double>(f);
  }
  for (const BodyMotion& motion : {lying, gliding, walking}) motions.push_back(motion);
  motions.push_back({.rate_hz = 30, .poses = {Standing()}});
  motions.push_back({.rate_hz = 30, .poses = {Standing(), BodyPose(), Standing()}});
  return motions;
}

void AddJoints(Fingerprint& print, const JointSet& joints) { print.Add(joints.to_ulong()); }

TEST(MotionGolden, OfWhatBearsABody) {
  Fingerprint print;
  for (const BodyMotion& motion : SomeMotions()) {
    for (const SupportRules& rules : {SupportRules{}, kFootRules, SupportRules{.lowest = 0.3, .rest_speed = 1.2}}) {
      for (const Bearing& bearing : FindBearing(motion.poses, motion.rate_hz, rules)) {
        AddJoints(print, bearing.rests);
        AddJoints(print, bearing.bears);
      }
    }
    for (const auto& foot : FindFootContacts(motion.poses, motion.rate_hz)) {
      for (const bool stands : foot) print.Add(stands);
    }
    for (const BodyPose& velocity : JointVelocities(motion.poses, motion.rate_hz)) print.Add(velocity.joints);
    for (const BodyPose& pose : motion.poses) {
      print.Add(MassCentre(pose)).Add(Stature(pose)).Add(Facing(pose)).Add(Heading(pose));
      print.Add(ToOrigin(pose).yaw).Add(ToOrigin(pose).x).Add(ToOrigin(pose).z);
      for (const unsigned long set : {0x0ul, 0x8ul, 0x88000ul, 0xcc000ul, 0xc0800ul, 0xfffffUL}) {
        print.Add(BalanceOffset(pose, JointSet(set)));
      }
    }
  }
  EXPECT_TRUE(print.Is(82355, 75507873.1));
}

TEST(MotionGolden, OfWhatHoldsUpWhatIsShown) {
  const std::vector<BodyMotion> motions = SomeMotions();
  const std::vector<SupportRules> several = {
      {},
      {.lowest = 0.05, .rest_speed = 0.2, .height = 0.01, .level = 0.05, .window_s = 0.1},
      {.height = 0.1, .window_s = 1, .least_fall = 2, .most_fall = 30, .flight_stray = 0.03}};
  Fingerprint print;
  for (std::size_t m = 0; m + 2 < motions.size(); ++m) {
    const std::vector<BodyPose>&left = motions[m].poses, &entered = motions[(m + 3) % (motions.size() - 2)].poses;
    constexpr int kLeftAt = 17;
    std::vector<BodyPose> shown(left.begin(), left.begin() + kLeftAt + 1);
    const std::size_t count = std::min(left.size() - kLeftAt, entered.size());
    for (std::size_t f = 1; f < count; ++f) {  // floats by up to 6 cm on its way from the one to the other
      const double share = std::min(static_cast<double>(f) / 14, 1.0);
      BodyPose pose;
      for (std::size_t j = 0; j < kRoleCount; ++j) {
        pose.joints[j] = glm::mix(left[kLeftAt + f].joints[j], entered[f].joints[j], share);
        pose.joints[j].y += (m % 2 == 0 ? 0.03 : 0.06) * std::sin(share * 3.14);
      }
      shown.push_back(pose);
    }
    const std::vector<SupportingClip> clips = {{.poses = left, .begin = 0, .left_at = kLeftAt},
                                               {.poses = entered, .begin = kLeftAt}};
    const int last = static_cast<int>(shown.size()) - 1;
    for (const SupportRules& rules : several) {
      for (const auto& [first, end] : {std::pair{0, last}, {10, 30}, {kLeftAt, kLeftAt}, {last - 4, last}}) {
        for (const Support& support :
             FindSupport(shown, clips, first, std::min(end, last), motions[m].rate_hz, rules)) {
          AddJoints(print, support.joints);
          print.Add(support.flight).Add(support.Holds());
        }
      }
    }
  }
  EXPECT_TRUE(print.Is(10971, 26388703.9124));
}

TEST(MotionGolden, OfJumpsAndFallsFromAnyHeight) {
  Fingerprint print;
  for (const double gravity : {0.0, 5.0, 6.4, 6.6, 9.81, 12.9, 13.1, 20.0}) {
    for (const int frames : {3, 4, 5, 6, 12, 20}) {
      for (const double stray : {0.0, 0.007, 0.012}) {
        std::vector<BodyPose> poses;
        for (int f = -10; f < frames + 10; ++f) {
          const double t = std::clamp(f, 0, frames) / 30.0, whole = frames / 30.0;
          BodyPose pose = Standing();
          const double up = 0.5 * gravity * t * (whole - t) + (f > 0 && f < frames && f % 2 == 0 ? 2 * stray : 0);
          for (glm::dvec3& joint : pose.joints) joint.y += up;
          poses.push_back(pose);
        }
        const std::vector<BodyPose> ground(poses.size(), Standing());
        const std::vector<SupportingClip> clips = {{.poses = ground, .begin = 0}};
        for (const Support& support : FindSupport(poses, clips, 0, static_cast<int>(poses.size()) - 1, 30)) {
          AddJoints(print, support.joints);
          print.Add(support.flight);
        }
        for (const Bearing& bearing : FindBearing(poses, 30)) AddJoints(print, bearing.bears);
      }
    }
  }
  EXPECT_TRUE(print.Is(12240, 3676595.17475));
}

TEST(MotionGolden, OfStatistics) {
  Fingerprint print;
  for (const BodyMotion& motion : SomeMotions()) {
    const MotionStatistics statistics = ComputeStatistics(motion);
    print.Add(statistics.stature_m).Add(statistics.travelled_m).Add(statistics.speed_median_m_s);
    print.Add(statistics.speed_p95_m_s).Add(statistics.speed_peak_m_s).Add(statistics.fastest);
    print.Add(statistics.lowest_foot_m).Add(statistics.foot_slide.mean).Add(statistics.foot_slide.of_foot);
    print.Add(statistics.foot_slide.stance_share).Add(motion.DurationSeconds());
  }
  EXPECT_TRUE(print.Is(252, -70.4324637167));
}

void AddClipTo(Fingerprint& print, const Clip& clip) {
  print.Add(clip.rate_hz).Add(clip.DurationSeconds()).Add(clip.frames.size());
  for (const Joint& joint : clip.skeleton.joints) {
    print.Add(joint.name).Add(joint.parent).Add(joint.is_end_site);
    print.Add(joint.rest.translation).Add(joint.rest.rotation).Add(joint.rest.scale);
  }
  std::vector<GlobalTransform> globals;
  for (const LocalPose& frame : clip.frames) {
    for (const LocalTransform& local : frame) print.Add(local.translation).Add(local.rotation).Add(local.scale);
    ComputeGlobals(clip.skeleton, frame, globals);
    for (const GlobalTransform& global : globals) {
      print.Add(global.position).Add(global.axes[0]).Add(global.axes[1]).Add(global.axes[2]);
    }
  }
}

TEST(MotionGolden, OfEdits) {
  Fingerprint print;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const Clip plain = testing::RandomClip(
        seed,
        {.roots = 1 + static_cast<int>(seed % 3), .rest_rotations = seed % 2 == 0, .moving_offsets = seed % 3 == 0});
    Clip scaled = testing::RandomClip(seed, {.roots = 2, .rest_rotations = true, .scales = true});
    if (seed % 2 == 0) scaled.frames[1][2].scale = {0, 1, -1};
    for (const double rate : {13.0, 30.0, 47.5, 120.0}) AddClipTo(print, Resample(plain, rate));
    for (const auto& [from, to] : {std::pair{0.0, 1.0 / 15},
                                   {0.02, 0.1},
                                   {0.05, 0.04},
                                   {-0.01, 0.1},
                                   {-0.02, 0.1},
                                   {0.1, 0.149},
                                   {0.1, 0.151},
                                   {0.2, 0.3},
                                   {1.0 / 60, 1.0 / 60}}) {
      const Result<Clip> part = Trim(plain, from, to);
      if (part) AddClipTo(print, *part);
      if (!part) print.Add(ToString(part.error()));
    }
    AddClipTo(print, Mirror(plain));
    AddClipTo(print, Mirror(scaled));
    AddClipTo(print, WithoutScales(scaled));
    AddClipTo(print, WithWorldAxesAtRest(plain));
    AddClipTo(print, WithOneRoot(plain));
    if (seed % 3 == 0) {
      for (const int joint : {0, 3, 9}) AddClipTo(print, WithRootAt(plain, joint));
    }
    for (const double frame : {-1.0, 0.0, 0.3, 2.0, 3.999, 4.0, 9.0}) {
      for (const LocalTransform& local : SampleFrame(scaled, frame)) {
        print.Add(local.translation).Add(local.rotation).Add(local.scale);
      }
    }
  }
  const BodyMotion move = NoisyMove("sway", 0.01);
  AddClipTo(print, ToClip(move, "sway"));
  for (const BodyPose& pose : Mirror(move).poses) print.Add(pose.joints);
  EXPECT_TRUE(print.Is(208410, -4894.47512618));
}

TEST(MotionGolden, OfSidesInNames) {
  Fingerprint print;
  Skeleton skeleton;
  for (const char* name : {"LeftArm",    "RightArm",
                           "upperarm.l", "upperarm.r",
                           "L_Elbow",    "lShldr",
                           "rShldr",     "Bip01 L Thigh",
                           "Collar",     "lfemur",
                           "rfemur",     "leftarm",
                           "rightarm",   "L5",
                           "R5",         "L4",
                           "lowerback",  "mixamorig:LeftArm",
                           "left:Hips",  "ARM_L",
                           "ARM_R",      "LArm",
                           "l",          "R",
                           "armL",       "Left",
                           "LEFT_FOOT",  "rightLeft",
                           "leftovers",  "",
                           ":",          "a:b:left",
                           "Left2",      "2Left"}) {
    print.Add(OtherSide(name));
    skeleton.joints.push_back({.name = name, .parent = -1, .rest = {}});
  }
  for (const Joint& joint : WithSidesSwapped(skeleton).joints) print.Add(joint.name);
  skeleton.joints.erase(skeleton.joints.begin() + 10);
  for (const Joint& joint : WithSidesSwapped(skeleton).joints) print.Add(joint.name);
  for (const Role role : AllRoles()) {
    print.Add(RoleName(role)).Add(FindRole(RoleName(role))).Add(ParentOf(role)).Add(Mirrored(role));
    if (role != Role::kHipCentre) print.Add(DirectionAtRest(role));
  }
  print.Add(FindRole("hip"));
  for (const Bone& bone : AllBones()) print.Add(bone.parent).Add(bone.child).Add(BoneLength(Standing(), bone));
  EXPECT_TRUE(print.Is(1175, 2575.7642435));
}

TEST(MotionGolden, OfBodiesAtRestAndDeformedMeshes) {
  Fingerprint print;
  for (const char* name : {"jump", "robot"}) {
    const RestBody body = RestBodyOf(NoisyMove(name, 0.02).poses);
    for (const RestBody::Joint& joint : body.joints) print.Add(joint.name).Add(joint.parent).Add(joint.position);
    for (const RestBody::RolePlace& place : body.roles) print.Add(place.joint).Add(place.position);
    print.Add(body.Pose().joints);
    for (const Joint& joint : BodySkeleton(body.Pose()).joints) print.Add(joint.name).Add(joint.rest.translation);
  }
  testing::Dice dice(3);
  const Clip clip = testing::RandomClip(4, {.scales = true});
  SkinnedMesh mesh;
  for (const int joint : {0, 4, 7, 9}) {
    SkinnedMesh::Binding binding{.joint = joint};
    for (int column = 0; column < 3; ++column) binding.inverse_bind[column] = glm::dvec4(dice.Vector(), 0);
    binding.inverse_bind[3] = glm::dvec4(dice.Vector(), 1);
    mesh.bindings.push_back(binding);
  }
  for (int v = 0; v < 13; ++v) {
    SkinnedMesh::Vertex vertex{.position = dice.Vector(), .normal = glm::normalize(dice.Vector())};
    vertex.bindings = {v % 4, (v + 1) % 4, (v + 2) % 4, (v + 3) % 4};
    vertex.weights = v < 3 ? std::array{1.0, 0.0, 0.0, 0.0} : std::array{0.4, 0.3, 0.2, 0.1};
    mesh.vertices.push_back(vertex);
  }
  std::vector<GlobalTransform> globals;
  for (const LocalPose& frame : clip.frames) {
    ComputeGlobals(clip.skeleton, frame, globals);
    const DeformedMesh deformed = Deform(mesh, globals);
    print.Add(deformed.positions).Add(deformed.normals);
  }
  globals[4].axes = glm::dmat3(0);
  print.Add(Deform(mesh, globals).positions);
  EXPECT_TRUE(print.Is(1836, 1749.88544494));
}

}  // namespace
}  // namespace etude
