#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "engine/formats/gltf/gltf.h"
#include "io/clips/fbx.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using testing::HasSubstr;

constexpr std::int64_t kTicksPerSecond = 46'186'158'000;
constexpr int kStep = 2, kLinear = 4, kCubic = 8;

/// The keys of one axis: times in seconds, angles in degrees, and the kind of its curve.
struct Axis {
  std::vector<double> times_s, degrees;
  int kind = kLinear;
};
using Angles = std::array<double, 3>;
using Motion = std::function<Angles(double time_s)>;

std::string Property(const char* name, const char* type, const std::string& values) {
  return fmt::format("P: \"{}\", \"{}\", \"\", \"A\",{}\n", name, type, values);
}

/// Returns an FBX text of hips (a Null) at 90 centimetres along one axis, and an arm (a LimbNode), which turns.
std::string File(const std::array<Axis, 3>& axes, const std::string& settings = "", const std::string& span = "",
                 const char* hips_at = "0,90,0") {
  std::string objects, links;
  const auto object = [&](const char* kind, int id, const char* name, const char* type, const std::string& more) {
    objects += fmt::format("{}: {}, \"{}\", \"{}\" {{\nProperties70: {{\n{}}}\n}}\n", kind, id, name, type, more);
  };
  object("Model", 10, "Model::Hips", "Null", Property("Lcl Translation", "Vector3D", hips_at));
  object("Model", 11, "Model::Arm", "LimbNode", Property("Lcl Translation", "Vector3D", "10,0,0"));
  object("AnimationStack", 1, "AnimStack::Wave", "", span);
  object("AnimationLayer", 2, "AnimLayer::Base", "", "");
  object("AnimationCurveNode", 3, "AnimCurveNode::R", "", "");
  links += "C: \"OO\",10,0\nC: \"OO\",11,10\nC: \"OO\",2,1\nC: \"OO\",3,2\nC: \"OP\",3,11, \"Lcl Rotation\"\n";
  for (int k = 0; k < 3; ++k) {
    const Axis& axis = axes[static_cast<std::size_t>(k)];
    std::vector<std::int64_t> ticks;
    for (const double time_s : axis.times_s) ticks.push_back(std::llround(time_s * kTicksPerSecond));
    objects += fmt::format(
        "AnimationCurve: {}, \"AnimCurve::\", \"\" {{\nDefault: 0\nKeyVer: 4008\nKeyTime: *{} {{\na: {}\n}}\n"
        "KeyValueFloat: *{} {{\na: {}\n}}\nKeyAttrFlags: *1 {{\na: {}\n}}\nKeyAttrDataFloat: *4 {{\na: 0,0,0,0\n}}\n"
        "KeyAttrRefCount: *1 {{\na: {}\n}}\n}}\n",
        20 + k, ticks.size(), fmt::join(ticks, ","), ticks.size(), fmt::join(axis.degrees, ","), axis.kind,
        ticks.size());
    links += fmt::format("C: \"OP\",{},3, \"d|{}\"\n", 20 + k, "XYZ"[k]);
  }
  return "; FBX 7.4.0 project file\nFBXHeaderExtension: {\nFBXVersion: 7400\n}\nGlobalSettings: {\nVersion: 1000\n"
         "Properties70: {\n" +
         settings + "}\n}\nObjects: {\n" + objects + "}\nConnections: {\n" + links + "}\n";
}

/// Returns keys of a motion from one time to another; `branch` changes the angles of a key, but not its rotation.
std::array<Axis, 3> Baked(const Motion& motion, double rate_hz, double from_s, double to_s,
                          const std::function<Angles(std::size_t, Angles)>& branch) {
  std::array<Axis, 3> axes;
  for (std::size_t k = 0; k <= static_cast<std::size_t>(std::lround((to_s - from_s) * rate_hz)); ++k) {
    const double time_s = from_s + static_cast<double>(k) / rate_hz;
    const Angles angles = branch(k, motion(time_s));
    for (std::size_t i = 0; i < 3; ++i) {
      axes[i].times_s.push_back(time_s);
      axes[i].degrees.push_back(angles[i]);
    }
  }
  return axes;
}

/// Returns FBX's rotation by Euler angles: about X first, then Y, then Z.
glm::dquat Turned(const Angles& degrees) {
  const auto about = [&](int i) {
    glm::dvec3 axis(0);
    axis[i] = 1;
    return glm::angleAxis(glm::radians(degrees[static_cast<std::size_t>(i)]), axis);
  };
  return about(2) * about(1) * about(0);
}

struct Read {
  Clip clip;
  std::string remark;
  std::set<std::string> skinned;
  glm::dquat ArmIn(double frame) const {
    return SampleFrame(clip, frame)[static_cast<std::size_t>(clip.skeleton.Find("Arm"))].rotation;
  }
};

Read ReadText(const std::string& text) {
  const auto motion = ReadFbx(text, "a.fbx");
  if (!motion) return {{}, ToString(motion.error()), {}};
  const auto content = ReadGltf(motion->glb, "a.fbx", nullptr);
  if (!content || content->clips.size() != 1) return {{}, "no clip", {}};
  return {content->clips[0], motion->remark, content->skinned};
}

/// Returns the angle between two rotations, degrees.
double Apart(const glm::dquat& a, const glm::dquat& b) {
  const glm::dquat between = glm::inverse(a) * b;
  return glm::degrees(2 * std::atan2(glm::length(glm::dvec3(between.x, between.y, between.z)), std::abs(between.w)));
}

Angles Smooth(double t) { return {200 * t - 30, 60 * std::sin(3 * t), 170 + 250 * t}; }

TEST(FbxKeys, EveryBranchOfTheEulerAnglesGivesTheSameMotionAtTheFilesRate) {
  const auto wrapped = [](double angle) { return angle - 360 * std::floor((angle + 180) / 360); };
  const auto twin = [](const Angles& a) { return Angles{a[0] + 180, 180 - a[1], a[2] + 180}; };
  const std::vector<std::function<Angles(std::size_t, Angles)>> branches = {
      [](std::size_t, Angles a) { return a; },  // the control
      [&](std::size_t, Angles a) {
        return Angles{wrapped(a[0]), wrapped(a[1]), wrapped(a[2])};
      },
      [&](std::size_t k, Angles a) { return k % 20 < 10 ? a : twin(a); },
      [&](std::size_t k, Angles a) {
        return k % 7 == 3 ? Angles{a[0] - 360, a[1] + 720, a[2]} : a;
      },
      [&](std::size_t k, Angles a) {
        for (double& angle : a = k % 2 == 0 ? a : twin(a)) angle = wrapped(angle);
        return a;
      }};
  for (const double rate_hz : {24.0, 30.0, 120.0}) {
    for (const double from_s : {0.0, 2.0}) {
      for (std::size_t i = 0; i < branches.size(); ++i) {
        SCOPED_TRACE(fmt::format("{} Hz from {} s, branch {}", rate_hz, from_s, i));
        const Read read = ReadText(File(Baked(Smooth, rate_hz, from_s, from_s + 2, branches[i])));
        EXPECT_EQ(read.remark, "");
        EXPECT_EQ(read.clip.rate_hz, rate_hz);
        ASSERT_EQ(read.clip.frames.size(), 2 * rate_hz + 1);
        for (std::size_t k = 0; k < read.clip.frames.size(); ++k) {
          const double time_s = from_s + static_cast<double>(k) / rate_hz;
          EXPECT_LT(Apart(read.ArmIn(static_cast<double>(k)), Turned(Smooth(time_s))), 0.01) << "frame " << k;
          // Between two keys, the shortest arc: as far from one as from the other.
          if (k == 0) continue;
          const glm::dquat last = Turned(Smooth(time_s - 1 / rate_hz)), next = Turned(Smooth(time_s));
          const glm::dquat between = read.ArmIn(static_cast<double>(k) - 0.5);
          EXPECT_NEAR(Apart(last, between), Apart(last, next) / 2, 0.02) << "before frame " << k;
          EXPECT_NEAR(Apart(next, between), Apart(last, next) / 2, 0.02) << "before frame " << k;
        }
      }
    }
  }
}

TEST(FbxKeys, AnAngleThatChangesByMoreThanHalfATurnBetweenDistantKeysMakesThisTurn) {
  for (const double turn : {360.0, -270.0, 900.0, 170.0}) {
    const Axis still{{0, 2}, {0, 0}};
    const Read read = ReadText(File({still, still, Axis{{0, 2}, {10, 10 + turn}}}));
    ASSERT_GT(read.clip.rate_hz, 0) << read.remark;
    for (double time_s = 0; time_s <= 2; time_s += 0.125) {
      EXPECT_LT(Apart(read.ArmIn(time_s * read.clip.rate_hz), Turned({0, 0, 10 + turn * time_s / 2})), 1.5)
          << turn << "° at " << time_s << " s";
    }
    const std::string told = fmt::format("an angle changes by {:g}° from one key to the next", std::abs(turn));
    EXPECT_EQ(read.remark.find(told) != std::string::npos, std::abs(turn) >= 180) << read.remark;
  }
}

TEST(FbxKeys, SparseAndSteppedCurvesOfOneAxisAreTold) {
  const auto axes = [](const Axis& sparse) {
    auto dense = Baked(
        [](double t) {
          return Angles{20 * t, 0, 10 * t};
        },
        30, 0, 3, [](std::size_t, Angles a) { return a; });
    dense[1] = sparse;
    return dense;
  };
  const Axis sparse{{0, 1, 2, 3}, {0, 60, 10, 60}};
  const auto told = [&](int kind) {
    Axis axis = sparse;
    axis.kind = kind;
    return ReadText(File(axes(axis))).remark;
  };
  EXPECT_THAT(told(kCubic), HasSubstr("keys are up to 1.00 s apart"));
  EXPECT_THAT(told(kStep), HasSubstr("the file has stepped keys, up to 1.00 s apart"));
  // The controls: a linear curve is read exactly; a cubic one that stays at its value, and steps of one frame.
  const Read linear = ReadText(File(axes(sparse)));
  EXPECT_EQ(linear.remark, "");
  EXPECT_EQ(linear.clip.rate_hz, 30);
  EXPECT_LT(Apart(linear.ArmIn(15), Turned({10, 30, 5})), 0.01);
  EXPECT_EQ(ReadText(File(axes({{0, 1, 2, 3}, {5, 5, 5, 5}, kCubic}))).remark, "");
  auto steps = axes({});
  steps[1] = steps[0];
  for (Axis& axis : steps) axis.kind = kStep;
  EXPECT_EQ(ReadText(File(steps)).remark, "");
  // Keys outside of the time span do not count.
  const auto ticks = [](double s) { return fmt::format("{}", std::llround(s * kTicksPerSecond)); };
  const std::string span = Property("LocalStart", "KTime", ticks(1)) + Property("LocalStop", "KTime", ticks(2));
  auto late = axes({{0, 2, 3}, {0, 0, 60}, kCubic});
  EXPECT_EQ(ReadText(File(late, "", span)).remark.find("keys are up to"), std::string::npos);
  late[1] = {{0, 1.2, 3}, {0, 0, 60}, kCubic};
  EXPECT_THAT(ReadText(File(late, "", span)).remark, HasSubstr("keys are up to 0.80 s apart"));
}

TEST(FbxKeys, EveryUpAxisBecomesY) {
  const auto still = Baked(Smooth, 30, 0, 1, [](std::size_t, Angles a) { return a; });
  for (const auto& [axis, sign, at] :
       {std::tuple(0, 1, "90,0,0"), {0, -1, "-90,0,0"}, {1, 1, "0,90,0"}, {2, 1, "0,0,90"}, {2, -1, "0,0,-90"}}) {
    const std::string settings =
        Property("UpAxis", "int", std::to_string(axis)) + Property("UpAxisSign", "int", std::to_string(sign));
    const Read read = ReadText(File(still, settings, "", at));
    ASSERT_FALSE(read.clip.frames.empty()) << read.remark;
    std::vector<GlobalTransform> globals;
    ComputeGlobals(read.clip.skeleton, read.clip.frames[0], globals);
    const glm::dvec3 hips = globals[static_cast<std::size_t>(read.clip.skeleton.Find("Hips"))].position;
    EXPECT_LT(glm::distance(hips, glm::dvec3(0, 0.9, 0)), 1e-5) << axis << " " << sign;
    EXPECT_GT(glm::determinant(globals[0].axes), 0);
  }
}

TEST(FbxKeys, LimbNodesAreDeclaredAsASkeletonAndNullsAreNot) {
  EXPECT_EQ(ReadText(File(Baked(Smooth, 30, 0, 1, [](std::size_t, Angles a) { return a; }))).skinned,
            std::set<std::string>{"Arm"});
}

}  // namespace
}  // namespace etude
