#include "io/clips/convert.h"

#include <gmock/gmock.h>

#include <limits>

#include "engine/formats/bvh.h"
#include "engine/formats/gltf/gltf.h"
#include "engine/formats/trc.h"
#include "sim/choreography/canonical_body.h"
#include "sim/choreography/move.h"
#include "tests/io/clips/clip_folder.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

constexpr const char* kReal = "/usr/share/assimp/models/BVH/01_03.bvh";

class ConvertTest : public ClipFolder {
 protected:
  std::string Convert(const std::string& reference, MotionFormat format, const ConvertOptions& options = {}) {
    auto clips = ReadClips(reference);
    EXPECT_TRUE(clips) << reference;
    const auto converted = ConvertClips(std::move(*clips), format, options);
    EXPECT_TRUE(converted) << ToString(converted.error());
    return converted ? converted->bytes : "";
  }
  std::string Complaint(const std::string& reference, MotionFormat format, const ConvertOptions& options = {}) {
    const auto converted = ConvertClips(*ReadClips(reference), format, options);
    EXPECT_FALSE(converted);
    return converted ? "" : ToString(converted.error());
  }
  /// Returns the largest distance of a joint of `b` from the joint of the same name in `a`, whose unit is `metres` m.
  static double WorstGap(const Clip& a, double metres, const Clip& b) {
    std::vector<GlobalTransform> in_a, in_b;
    double worst = a.frames.size() == b.frames.size() ? 0 : std::numeric_limits<double>::infinity();
    for (std::size_t frame = 0; frame < std::min(a.frames.size(), b.frames.size()); ++frame) {
      ComputeGlobals(a.skeleton, a.frames[frame], in_a);
      ComputeGlobals(b.skeleton, b.frames[frame], in_b);
      for (std::size_t joint = 0; joint < a.skeleton.joints.size(); ++joint) {
        const int other = b.skeleton.Find(a.skeleton.joints[joint].name);
        if (other < 0) return std::numeric_limits<double>::infinity();
        worst = std::max(worst, glm::distance(metres * in_a[joint].position, in_b[other].position));
      }
    }
    return worst;
  }
  static GltfContent ReadBack(const std::string& glb) {
    auto content = ReadGltf(glb, "back.glb", [](const std::string&) { return Fail({}, "nothing is outside"); });
    EXPECT_TRUE(content) << ToString(content.error());
    return content ? *content : GltfContent{};
  }
};

TEST_F(ConvertTest, BvhToBvhKeepsTheFilesOwnSkeletonAndUnit) {
  const Clip before = ReadClips(kReal)->front().clip;
  ASSERT_OK(after, ReadBvh(Convert(kReal, MotionFormat::kBvh), "after.bvh"));
  EXPECT_EQ(after->skeleton.joints.size(), before.skeleton.joints.size());
  EXPECT_EQ(after->rate_hz, before.rate_hz);
  EXPECT_LT(WorstGap(before, 1, *after), 1e-4);
}

TEST_F(ConvertTest, OfMarkersToASkeletonSaysWhatTheirReaderChanged) {
  BodyMotion raised{.rate_hz = 30, .poses = std::vector<BodyPose>(10, StandingPose())};
  for (BodyPose& pose : raised.poses) {
    for (glm::dvec3& joint : pose.joints) joint.y += 2;
  }
  const std::string trc = Write("raised.trc", WriteTrc(raised, "raised"));
  for (const MotionFormat format : {MotionFormat::kBvh, MotionFormat::kGlb, MotionFormat::kCsv}) {
    ASSERT_OK(converted, ConvertClips(*ReadClips(trc), format, {}));
    EXPECT_THAT(converted->changes, ::testing::Contains(HasSubstr("Etude moved the floor from ")));
  }
}

TEST_F(ConvertTest, FormatsWithAClockKeepWhenAMotionBegins) {
  BodyMotion raised{.rate_hz = 30, .poses = std::vector<BodyPose>(90, StandingPose())};
  MarkerMotion markers = JointMarkers(raised, 5);
  for (std::size_t t = 0; t < 30; ++t) markers.frames[t][Index(Role::kLeftKnee)].reset();  // the body begins at 6 s
  const std::string trc = Write("late.trc", WriteTrc(markers, "late"));
  ConvertOptions options{.trim = TimeSpan{1.5, 2.5}};  // and the trimmed part at 6.5 s, 1.5 s after the first frame
  for (const auto& [format, name] : {std::pair(MotionFormat::kTrc, "a.trc"),
                                     {MotionFormat::kCsv, "a.csv"},
                                     {MotionFormat::kC3d, "a.c3d"},
                                     {MotionFormat::kNpz, "a.npz"},
                                     {MotionFormat::kMot, "a.mot"}}) {
    const auto back = ReadClips(Write(name, Convert(trc, format, options)));
    ASSERT_TRUE(back) << ToString(back.error());
    ASSERT_TRUE(back->front().made->start_s) << name;
    EXPECT_NEAR(*back->front().made->start_s, 6.5, 1e-6) << name;
  }
  ASSERT_OK(bvh, ConvertClips(*ReadClips(trc), MotionFormat::kBvh, options));
  EXPECT_THAT(bvh->changes, ::testing::Contains("time 0 of the output is the time 6.5 s of the input"));
  // C3D counts whole frames, from 0 s on.
  for (const auto& [begin_s, written] : {std::pair(0.117, "time 0.133333 s of the output is the time 0.117 s of the"),
                                         {-1.0, "time 0 of the output is the time -1 s of the input"}}) {
    const MarkerMotion odd = JointMarkers(raised, begin_s);
    const auto sources = ReadClips(Write("odd.trc", WriteTrc(odd, "odd")));
    ASSERT_TRUE(sources) << ToString(sources.error());
    ASSERT_OK(c3d, ConvertClips(*sources, MotionFormat::kC3d, {}));
    EXPECT_THAT(c3d->changes, ::testing::Contains(HasSubstr(written)));
    ASSERT_OK(same, ConvertClips(*sources, MotionFormat::kTrc, {}));
    EXPECT_THAT(same->changes, ::testing::Not(::testing::Contains(HasSubstr("of the output"))));
  }
  // A part that begins before the body begins with the body; a part that ends before the body is refused.
  options.trim = TimeSpan{0.5, 1.5};
  ASSERT_OK(early, ReadClips(Write("early.npz", Convert(trc, MotionFormat::kNpz, options))));
  EXPECT_NEAR(*early->front().made->start_s, 6, 1e-6);
  EXPECT_EQ(early->front().clip.frames.size(), 16u);
  options.trim = TimeSpan{0, 0.5};
  EXPECT_THAT(testing::Refusal(ConvertClips(*ReadClips(trc), MotionFormat::kNpz, options)),
              HasSubstr("ends at 0.5 s, but the whole body is seen only from 1.00 s on"));
}

TEST_F(ConvertTest, BvhToGlbIsInMetresAndComesBackAsTheSamePlaces) {
  ASSERT_OK(opened, UnderstandClip(ReadClips(kReal)->front(), {}));
  const double metres = opened->body.metres_per_unit;
  EXPECT_NE(metres, 1);
  const std::string glb = Convert(kReal, MotionFormat::kGlb);
  const GltfContent back = ReadBack(glb);
  ASSERT_EQ(back.clips.size(), 1u);
  EXPECT_LT(WorstGap(opened->source.clip, metres, back.clips[0]), 1e-4);
  EXPECT_GT(WorstGap(opened->source.clip, 1, back.clips[0]), 1) << "the control: in another unit";

  ASSERT_OK(again, ReadBvh(Convert(Write("own.glb", glb), MotionFormat::kBvh), "again.bvh"));
  EXPECT_LT(WorstGap(opened->source.clip, metres, *again), 1e-4);
}

TEST_F(ConvertTest, ATrimmedMirroredResampledClipIsAllThree) {
  ConvertOptions options{.trim = TimeSpan{0.5, 1.0}, .rate_hz = 30, .mirror = true};
  const Clip before = ReadClips(kReal)->front().clip;
  ASSERT_OK(after, ReadBvh(Convert(kReal, MotionFormat::kBvh, options), "after.bvh"));
  EXPECT_EQ(after->frames.size(), 16u);
  std::vector<GlobalTransform> was, is;
  ComputeGlobals(before.skeleton, before.frames[static_cast<std::size_t>(0.5 * before.rate_hz)], was);
  ComputeGlobals(after->skeleton, after->frames[0], is);
  const glm::dvec3 left = was[before.skeleton.Find("LeftHand")].position;
  const glm::dvec3 right = is[after->skeleton.Find("RightHand")].position;
  EXPECT_LT(glm::distance(glm::dvec3(-left.x, left.y, left.z), right), 1e-4);
}

TEST_F(ConvertTest, WhatWouldNotFitIntoMemoryIsRefused) {
  ConvertOptions options{.rate_hz = 1e6};
  EXPECT_THAT(Complaint(kReal, MotionFormat::kBvh, options), HasSubstr("GB; allowed: at most 1 GB"));
  EXPECT_THAT(Complaint(kReal, MotionFormat::kCsv, options), HasSubstr("poses"));
}

TEST_F(ConvertTest, ARetargetedBodyHasTheCanonicalLimbsAndAGroundedOneItsOwn) {
  ConvertOptions grounded, retargeted;
  grounded.ground = true;
  retargeted.retarget = true;
  const auto own = UnderstandClip(ReadClips(kReal)->front(), {});
  for (const auto& [options, thigh] :
       {std::pair{grounded,
                  glm::distance(own->body.motion.poses[0][Role::kLeftHip], own->body.motion.poses[0][Role::kLeftKnee])},
        std::pair{retargeted, glm::distance(StandingPose()[Role::kLeftHip], StandingPose()[Role::kLeftKnee])}}) {
    ASSERT_OK(clip, ReadBvh(Convert(kReal, MotionFormat::kBvh, options), "body.bvh"));
    EXPECT_EQ(clip->rate_hz, kJudgedRateHz);
    const int knee = clip->skeleton.Find("left_knee");
    ASSERT_GE(knee, 0);
    EXPECT_NEAR(glm::length(clip->skeleton.joints[knee].rest.translation), thigh, 1e-3);
  }
}

TEST_F(ConvertTest, ABearDancesInAGlbWithItsMeshes) {
  ConvertOptions options{.performer = Performer::kBear};
  const GltfContent bear = ReadBack(Convert("builtin:clap", MotionFormat::kGlb, options));
  EXPECT_FALSE(bear.character.meshes.empty());
  ASSERT_EQ(bear.clips.size(), 1u);
  EXPECT_EQ(bear.clips[0].name, "clap");
  EXPECT_EQ(bear.clips[0].frames.size(), LoadBuiltinMove("clap")->motion.poses.size());
  EXPECT_THAT(Complaint("builtin:clap", MotionFormat::kBvh, options),
              HasSubstr("only GLB files can contain a character"));
}

TEST_F(ConvertTest, SeveralAnimationsBecomeAGlbOrAComplaint) {
  Write("numbers.bin", AnimationBytes());
  const std::string dance = Write("dance.gltf", GltfWithAnimations("numbers.bin"));
  EXPECT_EQ(ReadBack(Convert(dance, MotionFormat::kGlb)).clips.size(), 2u);
  EXPECT_THAT(Complaint(dance, MotionFormat::kBvh),
              HasSubstr("choose one of the 2 animations with FILE#NAME: Armature|Jump, Armature|Walk"));
}

TEST_F(ConvertTest, WithoutAUnitThereIsNoGlb) {
  const std::string path = Write("two.bvh", kTwoJoints);
  EXPECT_THAT(Complaint(path, MotionFormat::kGlb), HasSubstr("use --unit to state the unit"));
  ConvertOptions options;
  options.open.body.metres_per_unit = 0.01;
  options.open.body.up = UpAxis::kZ;
  const GltfContent glb = ReadBack(Convert(path, MotionFormat::kGlb, options));
  std::vector<GlobalTransform> globals;
  ComputeGlobals(glb.character.skeleton, glb.clips[0].frames[1], globals);
  // (1, 10, 0) cm with Z up lies along what is now −Z.
  EXPECT_LT(glm::distance(globals[glb.character.skeleton.Find("Chest")].position, glm::dvec3(0.01, 0, -0.1)), 1e-6);
}

TEST(TimeSpanTest, EndsMayBeLeftOut) {
  EXPECT_EQ(ParseTimeSpan("1.5:4")->from_s, 1.5);
  EXPECT_EQ(ParseTimeSpan("1.5:4")->to_s, 4);
  EXPECT_EQ(ParseTimeSpan(":3")->from_s, 0);
  EXPECT_EQ(ParseTimeSpan("2:")->to_s, std::numeric_limits<double>::infinity());
  for (const char* wrong : {"", "3", "a:b", "-1:2", "1:2:3", "nan:2", "1:inf", "4:1"}) {
    EXPECT_FALSE(ParseTimeSpan(wrong)) << wrong;
  }
}

TEST(FormatTest, IsToldByTheExtension) {
  EXPECT_EQ(FormatOfName("a/b.glb"), MotionFormat::kGlb);
  EXPECT_THAT(testing::Message(FormatOfName("a/b.fbx")), HasSubstr(".bvh, .glb, .trc, .csv"));
}

}  // namespace
}  // namespace etude
