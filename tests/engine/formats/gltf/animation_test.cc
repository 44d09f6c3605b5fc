#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "tests/engine/formats/gltf/small_glb.h"

namespace etude {
namespace {

using testing::Floats;
using testing::Glb;
using testing::Read;

std::string Packed(const std::vector<float>& values) {
  std::string bytes(values.size() * sizeof(float), '\0');
  std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

struct Curve {
  std::string path;
  std::string interpolation;
  std::vector<float> times;
  std::vector<float> values;
};

/// Returns a file with one node "Joint", at rest at (7, 8, 9), and one animation with these curves.
std::string Animated(const std::vector<Curve>& curves, const std::string& name = "Move", const std::string& more = "") {
  std::string samplers, channels, accessors, views, binary;
  const auto add = [&](const std::vector<float>& values, const std::string& type, std::size_t width) {
    const std::string comma = views.empty() ? "" : ",";
    views += comma + fmt::format(R"({{"buffer":0,"byteOffset":{},"byteLength":{}}})", binary.size(), 4 * values.size());
    accessors += comma + fmt::format(R"({{"bufferView":{},"componentType":5126,"count":{},"type":"{}"}})",
                                     std::ranges::count(accessors, '{'), values.size() / width, type);
    binary += Packed(values);
  };
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const bool is_rotation = curves[i].path == "rotation";
    add(curves[i].times, "SCALAR", 1);
    add(curves[i].values, is_rotation ? "VEC4" : "VEC3", is_rotation ? 4 : 3);
    const std::string comma = i == 0 ? "" : ",";
    samplers += comma + fmt::format(R"({{"input":{},"output":{},"interpolation":"{}"}})", 2 * i, 2 * i + 1,
                                    curves[i].interpolation);
    channels += comma + fmt::format(R"({{"sampler":{},"target":{{"node":0,"path":"{}"}}}})", i, curves[i].path);
  }
  return Glb(fmt::format(R"({{{}"asset":{{"version":"2.0"}},"scenes":[{{"nodes":[0]}}],
"nodes":[{{"name":"Joint","translation":[7,8,9]}}],
"animations":[{{"name":"{}","samplers":[{}],"channels":[{}]}}],
"accessors":[{}],"bufferViews":[{}],"buffers":[{{"byteLength":{}}}]}})",
                         more, name, samplers, channels, accessors, views, binary.size()),
             binary);
}

/// Returns the only joint's transforms per frame of the only clip.
std::vector<LocalTransform> Frames(const Clip& clip) {
  std::vector<LocalTransform> frames;
  for (const LocalPose& pose : clip.frames) frames.push_back(pose.at(0));
  return frames;
}

Clip OnlyClip(const std::string& bytes) {
  const GltfContent content = Read(bytes);
  EXPECT_EQ(content.clips.size(), 1u);
  return content.clips.empty() ? Clip{} : content.clips[0];
}

void ExpectSampled(const glm::dvec3& found, const glm::dvec3& expected, double tolerance = 1e-6) {
  EXPECT_LT(glm::length(found - expected), tolerance) << "(" << found.x << ", " << found.y << ", " << found.z << ")";
}

void ExpectTurn(const glm::dquat& found, double radians, const glm::dvec3& axis) {
  const glm::dquat expected = glm::angleAxis(radians, axis);
  EXPECT_NEAR(std::abs(glm::dot(found, expected)), 1, 1e-7)
      << "turned by " << glm::angle(found) << " instead of " << radians;
}

TEST(GltfAnimation, KeepsEvenlySpacedLinearKeysAsFrames) {
  const Clip clip = OnlyClip(Animated({{"translation", "LINEAR", {0, 0.04f, 0.08f}, {0, 0, 0, 1, 2, 3, 4, 4, 4}}}));
  EXPECT_EQ(clip.name, "Move");
  EXPECT_EQ(clip.rate_hz, 25);
  const auto frames = Frames(clip);
  ASSERT_EQ(frames.size(), 3u);
  EXPECT_EQ(frames[1].translation, glm::dvec3(1, 2, 3));
  EXPECT_EQ(frames[2].translation, glm::dvec3(4, 4, 4));
}

// Keys of three axes some nanoseconds apart: in single precision their times are equal or adjacent.
TEST(GltfAnimation, KeysThatCoincideAreOneFrame) {
  for (const float apart : {0.f, 1e-9f, 2e-8f, 1e-6f, 1e-5f}) {
    Curve curve{"translation", "LINEAR", {}, {}};
    for (int k = 0; k < 12; ++k) {
      const float time = static_cast<float>(k) / 30, x = static_cast<float>(k * k);
      for (const float here : {time, time + apart}) {
        curve.times.push_back(here);
        curve.values.insert(curve.values.end(), {x, -x, 1});
      }
    }
    const Clip clip = OnlyClip(Animated({curve}));
    EXPECT_EQ(clip.rate_hz, 30) << apart;
    ASSERT_EQ(clip.frames.size(), 12u) << apart;
    for (int k = 0; k < 12; ++k) ExpectSampled(Frames(clip)[k].translation, {k * k, -k * k, 1}, 0.01);
  }
}

TEST(GltfAnimation, StepsOfOneFrameAreFramesAndLongerStepsAreHeld) {
  for (const double keys_hz : {24.0, 30.0, 60.0, 12.0}) {
    Curve curve{"translation", "STEP", {}, {}};
    for (int k = 0; k < 12; ++k) {
      curve.times.push_back(static_cast<float>(k / keys_hz));
      curve.values.insert(curve.values.end(), {static_cast<float>(k * k), 0, 1});
    }
    const Clip clip = OnlyClip(Animated({curve}));
    EXPECT_EQ(clip.rate_hz, keys_hz < 24 ? 60 : keys_hz);
    const std::size_t each = keys_hz < 24 ? 5 : 1;
    ASSERT_EQ(clip.frames.size(), 11 * each + 1) << keys_hz;
    for (std::size_t k = 0; k < clip.frames.size(); ++k) {
      const auto key = static_cast<double>(k / each);
      EXPECT_EQ(Frames(clip)[k].translation, glm::dvec3(key * key, 0, 1)) << keys_hz << " Hz, frame " << k;
    }
  }
}

TEST(GltfAnimation, JumpsWhereTwoKeysHaveOneTime) {
  const auto frames =
      Frames(OnlyClip(Animated({{"translation", "LINEAR", {0, 0.5f, 0.5f, 1}, {0, 0, 0, 1, 0, 0, 5, 0, 0, 6, 0, 0}}})));
  ASSERT_EQ(frames.size(), 3u);
  EXPECT_EQ(frames[1].translation, glm::dvec3(5, 0, 0)) << "the last of both";
}

TEST(GltfAnimation, SamplesUnevenKeysAt60HzAlongStraightLines) {
  const Clip clip = OnlyClip(Animated({{"translation", "LINEAR", {0, 0.5f, 2}, {0, 0, 0, 1, 0, 0, 1, 3, 0}}}));
  EXPECT_EQ(clip.rate_hz, 60);
  const auto frames = Frames(clip);
  ASSERT_EQ(frames.size(), 121u);
  ExpectSampled(frames[15].translation, {0.5, 0, 0});  // at 0.25 s
  ExpectSampled(frames[75].translation, {1, 1.5, 0});  // at 1.25 s
  EXPECT_EQ(frames[120].translation, glm::dvec3(1, 3, 0));
}

TEST(GltfAnimation, TurnsLinearRotationsAtConstantSpeedTheShortWay) {
  const float half = std::sqrt(0.5f);
  // A rotation of 90° about Z with the other sign: the short way is still 90°, not 270°.
  const Clip clip =
      OnlyClip(Animated({{"rotation", "LINEAR", {0, 1, 1.5f}, {0, 0, 0, 1, 0, 0, -half, -half, 0, 0, half, half}}}));
  const auto frames = Frames(clip);
  ASSERT_EQ(clip.rate_hz, 60);
  ASSERT_EQ(frames.size(), 91u);
  for (const int frame : {0, 10, 20, 30, 60, 75}) {
    SCOPED_TRACE(frame);
    ExpectTurn(frames[frame].rotation, std::min(frame / 60.0, 1.0) * std::numbers::pi / 2, {0, 0, 1});
  }
}

TEST(GltfAnimation, KeepsTheThreeAxesOfAScaleApart) {
  const auto frames = Frames(OnlyClip(Animated({{"scale", "LINEAR", {0, 1}, {1, 2, 4, 3, 5, 0.5f}}})));
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_EQ(frames[0].scale, glm::dvec3(1, 2, 4));
  EXPECT_EQ(frames[1].scale, glm::dvec3(3, 5, 0.5));
}

TEST(GltfAnimation, HoldsStepsUntilTheNextKey) {
  const Clip clip = OnlyClip(Animated({{"scale", "STEP", {0, 0.5f, 1}, {1, 1, 1, 2, 2, 2, 3, 3, 3}}}));
  EXPECT_EQ(clip.rate_hz, 60);
  const auto frames = Frames(clip);
  ASSERT_EQ(frames.size(), 61u);
  EXPECT_EQ(frames[29].scale, glm::dvec3(1));
  EXPECT_EQ(frames[30].scale, glm::dvec3(2));
  EXPECT_EQ(frames[59].scale, glm::dvec3(2));
  EXPECT_EQ(frames[60].scale, glm::dvec3(3));
}

TEST(GltfAnimation, FollowsCubicSplinesWithTheirTangents) {
  // x = t³ with keys at 0 and 2 s: values 0 and 8, slopes 0 and 12. Each key has in-tangent, value, out-tangent.
  const Clip clip = OnlyClip(Animated(
      {{"translation", "CUBICSPLINE", {0, 2}, {99, 99, 99, 0, 0, 0, 0, 0, 0, 12, 0, 0, 8, 0, 0, 99, 99, 99}}}));
  const auto frames = Frames(clip);
  ASSERT_EQ(frames.size(), 121u);
  for (int frame = 0; frame <= 120; frame += 5)
    ExpectSampled(frames[frame].translation, {std::pow(frame / 60.0, 3), 0, 0});
}

TEST(GltfAnimation, MakesCubicSplineRotationsUnit) {
  const float half = std::sqrt(0.5f);
  const Clip clip = OnlyClip(Animated({{"rotation", "CUBICSPLINE", {0, 1}, {0, 0, 0, 0, 0,    0, 0,    1, 0, 0, 0, 0, 0,
                                                                            0, 0, 0, 0, half, 0, half, 0, 0, 0, 0}}}));
  for (const LocalTransform& frame : Frames(clip)) EXPECT_NEAR(glm::length(frame.rotation), 1, 2e-7);
  // With zero tangents, symmetry gives half the turn at half the time.
  ExpectTurn(Frames(clip)[30].rotation, std::numbers::pi / 4, {0, 1, 0});
}

TEST(GltfAnimation, BeginsAtItsFirstKeyAndEndsAtItsLastOfAllChannels) {
  const Clip clip =
      OnlyClip(Animated({{"translation", "LINEAR", {2.1f, 2.2f}, {0, 0, 0, 1, 0, 0}},
                         {"scale", "LINEAR", {2, 2.1f, 2.2f, 2.3f}, {1, 1, 1, 2, 2, 2, 3, 3, 3, 4, 4, 4}}}));
  EXPECT_EQ(clip.rate_hz, 10);
  const auto frames = Frames(clip);
  ASSERT_EQ(frames.size(), 4u);
  EXPECT_EQ(frames[0].translation, glm::dvec3(0));  // before the first key its value holds
  EXPECT_EQ(frames[3].translation, glm::dvec3(1, 0, 0));
  EXPECT_EQ(frames[3].scale, glm::dvec3(4));
}

TEST(GltfAnimation, ALateBeginningAndTimesInMillisecondsAreSaid) {
  const auto begins_at = [](float start) {
    return Read(Animated({{"translation", "LINEAR", {start, start + 1, start + 2}, {0, 0, 0, 1, 0, 0, 0, 0, 0}}}))
        .remarks;
  };
  EXPECT_THAT(begins_at(2), ::testing::ElementsAre("the first key of 'Move' is at 2 s; Etude uses this time as time "
                                                   "0"));
  EXPECT_THAT(begins_at(1.f / 24), ::testing::IsEmpty()) << "as of exporters that count frames from 1";
  // Six hours in milliseconds, with an uneven step.
  const auto refused = ReadGltf(
      Animated({{"translation", "LINEAR", {0, 33, 70, 21.6e6f}, {0, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0}}}), "a.glb", {});
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, ::testing::HasSubstr("s apart: are the times in milliseconds?"));
}

TEST(GltfAnimation, TakesTheRateFromWhatMoves) {
  // Exporters give constant values two keys with STEP.
  const Clip clip = OnlyClip(Animated({{"scale", "STEP", {0, 0.1f}, {2, 2, 2, 2, 2, 2}},
                                       {"translation", "LINEAR", {0, 0.05f, 0.1f}, {0, 0, 0, 1, 0, 0, 0, 0, 0}}}));
  EXPECT_EQ(clip.rate_hz, 20);
  EXPECT_EQ(Frames(clip)[1].scale, glm::dvec3(2));
}

TEST(GltfAnimation, KeepsARateThatIsNoWholeNumber) {
  std::vector<float> times, values;
  for (int k = 0; k < 100; ++k) {
    times.push_back(static_cast<float>(k / 29.97));
    values.insert(values.end(), {static_cast<float>(k), 0, 0});
  }
  const Clip clip = OnlyClip(Animated({{"translation", "LINEAR", times, values}}));
  EXPECT_DOUBLE_EQ(clip.rate_hz, 29.97);
  ASSERT_EQ(clip.frames.size(), 100u);
  for (int k = 0; k < 100; ++k) EXPECT_NEAR(Frames(clip)[k].translation.x, k, 1e-4);
}

TEST(GltfAnimation, HasARateOfItsOwnFromATenthToTenThousand) {
  const auto rate = [](float seconds) {
    return OnlyClip(Animated({{"translation", "LINEAR", {0, seconds}, {0, 0, 0, 1, 2, 3}}})).rate_hz;
  };
  EXPECT_EQ(rate(10), 0.1);
  EXPECT_EQ(rate(10.2f), 60);
  EXPECT_EQ(rate(1e-4f), 10'000);
  EXPECT_EQ(rate(0.99e-4f), 60);
}

TEST(GltfAnimation, ReadsTheKeysOfALongRecordingAsTheyStand) {
  // After ten minutes a float resolves time only to 60 µs.
  std::vector<float> times, values;
  for (int k = 0; k < 72'001; ++k) {
    times.push_back(static_cast<float>(k / 120.0));
    values.insert(values.end(), {static_cast<float>(k % 7), 0, 0});
  }
  const Clip clip = OnlyClip(Animated({{"translation", "LINEAR", times, values}}));
  EXPECT_EQ(clip.rate_hz, 120);
  ASSERT_EQ(clip.frames.size(), 72'001u);
  for (std::size_t k = 0; k < clip.frames.size(); ++k) ASSERT_EQ(clip.frames[k][0].translation.x, k % 7) << k;
}

TEST(GltfAnimation, OfOneKeyIsOneFrame) {
  const Clip clip = OnlyClip(Animated({{"translation", "LINEAR", {3}, {1, 2, 3}}}));
  ASSERT_EQ(clip.frames.size(), 1u);
  EXPECT_EQ(clip.frames[0][0].translation, glm::dvec3(1, 2, 3));
}

TEST(GltfAnimation, LeavesAtRestWhatHasNoChannel) {
  const Clip clip = OnlyClip(Animated({{"scale", "LINEAR", {0, 1}, {1, 1, 1, 2, 2, 2}}}));
  EXPECT_EQ(clip.frames[1][0].translation, glm::dvec3(7, 8, 9));
  EXPECT_EQ(clip.skeleton.joints[0].name, "Joint");
}

TEST(GltfAnimation, IsNamedAsInTheFileOrNumbered) {
  const std::string animation =
      R"({"samplers":[{"input":5,"output":6}],"channels":[{"sampler":0,"target":{"node":1,"path":"rotation"}}])";
  std::string json(testing::kSmallGltf);
  const std::size_t at = json.find(R"({"name":"Bow")");
  json.insert(at, animation + R"(,"name":"Bow"},)" + animation + "}," + animation + R"(,"name":"Bow_2"},)");
  std::vector<std::string> names;
  for (const Clip& clip : Read(Glb(json, testing::SmallBinary())).clips) names.push_back(clip.name);
  EXPECT_THAT(names, ::testing::ElementsAre("Bow", "animation_1", "Bow_2", "Bow_3"));
}

TEST(GltfAnimation, OfMorphTargetsAloneIsLeftOut) {
  std::string json(testing::kSmallGltf);
  json.replace(json.find(R"("path":"rotation")"), 17, R"("path":"weights")");
  EXPECT_TRUE(Read(Glb(json, testing::SmallBinary())).clips.empty());
}

TEST(GltfAnimation, UnderstandsNormalisedIntegers) {
  std::string json(testing::kSmallGltf);
  const std::string floats = R"({"bufferView":6,"componentType":5126,"count":3,"type":"VEC4"})";
  json.replace(json.find(floats), floats.size(),
               R"({"bufferView":6,"componentType":5122,"normalized":true,"count":3,"type":"VEC4"})");
  std::string binary = testing::SmallBinary();
  const std::string turns = testing::RawBytes<std::int16_t>({0, 0, 0, 32767, 23170, 0, 0, 23170, -32768, 0, 0, 0});
  binary.replace(testing::kTurns, turns.size(), turns);
  const Clip clip = OnlyClip(Glb(json, binary));
  ASSERT_EQ(clip.frames.size(), 3u);
  ExpectTurn(clip.frames[1][1].rotation, std::numbers::pi / 2, {1, 0, 0});
  EXPECT_EQ(clip.frames[2][1].rotation, glm::dquat(0, -1, 0, 0));  // −32768 also means −1
}

TEST(GltfAnimation, OfAFileWithCompressedMeshesIsReadWithoutThem) {
  const std::vector<Curve> curves = {{"translation", "LINEAR", {0, 1}, {0, 0, 0, 0, 1, 0}}};
  const GltfContent plain = Read(Animated(curves));
  // A primitive compressed with Draco: its accessors have no data.
  const GltfContent content = Read(Animated(
      curves, "Move",
      R"("extensionsRequired":["KHR_draco_mesh_compression"],"extensionsUsed":["KHR_draco_mesh_compression"],"meshes":[{"primitives":[{"attributes":{"POSITION":9},"extensions":{"KHR_draco_mesh_compression":{"bufferView":0,"attributes":{"POSITION":0}}}}]}],)"));
  ASSERT_EQ(content.clips.size(), 1u);
  EXPECT_EQ(content.clips[0].frames, plain.clips[0].frames);
  EXPECT_TRUE(content.character.meshes.empty());
  EXPECT_THAT(content.remarks, ::testing::ElementsAre(::testing::HasSubstr("(Draco)")));
}

}  // namespace
}  // namespace etude
