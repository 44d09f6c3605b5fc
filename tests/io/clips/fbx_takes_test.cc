#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/formats/gltf/gltf.h"
#include "io/clips/fbx.h"
#include "io/clips/fbx_preparation.h"
#include "tests/io/clips/fbx_writer.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using testing::HasSubstr;

constexpr std::int64_t kSecond = 46'186'158'000;
constexpr double kArm = 0.1, kHand = 0.2;  // metres: the arm from the hips, and the hand from the arm, along X

/// An animation layer: its properties, and the arm's angle about Z, degrees, at the times of its keys.
struct ArmLayer {
  std::string name, properties;
  std::vector<double> times_s, degrees;
};

/// Angles of a motion whose speed changes, so that a shift in time shows.
double Angle(double time_s) { return 20 * time_s * time_s + 10 * time_s; }

ArmLayer Baked(const std::string& name, double from_s, double to_s, double (*angle)(double),
               const std::string& properties = "") {
  ArmLayer layer{name, properties, {}, {}};
  for (int k = 0; k <= std::lround((to_s - from_s) * 30); ++k) {
    layer.times_s.push_back(from_s + k / 30.0);
    layer.degrees.push_back(angle(layer.times_s.back()));
  }
  return layer;
}

std::string Number(const char* name, double value) {
  return fmt::format("P: \"{}\", \"Number\", \"\", \"A\",{}\n", name, value);
}
std::string Triple(const char* name, double x, double y, double z) {
  return fmt::format("P: \"{}\", \"Vector3D\", \"Vector\", \"\",{},{},{}\n", name, x, y, z);
}
std::string Time(const char* name, double time_s) {
  return fmt::format("P: \"{}\", \"KTime\", \"Time\", \"\",{}\n", name, std::llround(time_s * kSecond));
}
std::string Span(double from_s, double to_s) { return Time("LocalStart", from_s) + Time("LocalStop", to_s); }

/// Texts that are added to the arm's properties, the hips' properties, the time span, and the template of spans.
struct More {
  std::string arm, hips, span, preset;
};

/// Returns an FBX text, in centimetres, of hips at the origin, an arm and a hand.
std::string ArmFile(const std::vector<ArmLayer>& layers, const More& more = {}) {
  std::string objects, links;
  const auto object = [&](const char* kind, int id, const std::string& name, const char* type,
                          const std::string& properties) {
    objects += fmt::format("{}: {}, \"{}\", \"{}\" {{\nProperties70: {{\n{}}}\n}}\n", kind, id, name, type, properties);
  };
  object("Model", 10, "Model::Hips", "LimbNode", more.hips);
  object("Model", 11, "Model::Arm", "LimbNode",
         "P: \"RotationActive\", \"bool\", \"\", \"\",1\n" + Triple("Lcl Translation", 100 * kArm, 0, 0) + more.arm);
  object("Model", 12, "Model::Hand", "LimbNode", Triple("Lcl Translation", 100 * kHand, 0, 0));
  object("AnimationStack", 1, "AnimStack::Wave", "", more.span);
  links += "C: \"OO\",10,0\nC: \"OO\",11,10\nC: \"OO\",12,11\n";
  int id = 100;
  for (const ArmLayer& layer : layers) {
    const int layer_id = id++, node = id++, curve = id++;
    object("AnimationLayer", layer_id, "AnimLayer::" + layer.name, "", layer.properties);
    object("AnimationCurveNode", node, "AnimCurveNode::R", "", "");
    std::vector<std::int64_t> ticks;
    for (const double time_s : layer.times_s) ticks.push_back(std::llround(time_s * kSecond));
    objects += fmt::format(
        "AnimationCurve: {}, \"AnimCurve::\", \"\" {{\nDefault: 0\nKeyVer: 4008\nKeyTime: *{} {{\na: {}\n}}\n"
        "KeyValueFloat: *{} {{\na: {}\n}}\n}}\n",
        curve, ticks.size(), fmt::join(ticks, ","), ticks.size(), fmt::join(layer.degrees, ","));
    links += fmt::format("C: \"OO\",{},1\nC: \"OO\",{},{}\n", layer_id, node, layer_id);
    links += fmt::format("C: \"OP\",{},11, \"Lcl Rotation\"\nC: \"OP\",{},{}, \"d|Z\"\n", node, curve, node);
  }
  return "; FBX 7.4.0 project file\nFBXHeaderExtension: {\nFBXVersion: 7400\n}\nGlobalSettings: {\nVersion: 1000\n"
         "Properties70: {\nP: \"TimeMode\", \"enum\", \"\", \"\",6\n}\n}\nDefinitions: {\nObjectType: "
         "\"AnimationStack\" {\nCount: 1\n" +
         more.preset + "}\n}\nObjects: {\n" + objects + "}\nConnections: {\n" + links + "}\n";
}

std::string Preset(const std::string& properties) {
  return "PropertyTemplate: \"FbxAnimStack\" {\nProperties70: {\n" + properties + "}\n}\n";
}

/// Returns the place of the hand, metres, if the arm's joint lies at `arm` and turns by an angle about Z.
glm::dvec3 HandAt(double degrees, const glm::dvec3& arm = {kArm, 0, 0}) {
  const double angle = glm::radians(degrees);
  return arm + kHand * glm::dvec3(std::cos(angle), std::sin(angle), 0);
}

/// The hand's place in every frame, metres, and the remark about the file.
struct Waved {
  std::vector<glm::dvec3> hand;
  std::string remark;
};

Waved Read(const std::string& text) {
  Waved waved;
  const auto motion = ReadFbx(text, "a.fbx");
  if (!motion) return {{}, ToString(motion.error())};
  const auto content = ReadGltf(motion->glb, "a.fbx", nullptr);
  if (!content || content->clips.size() != 1) return {{}, "no clip"};
  const Clip& clip = content->clips[0];
  for (const LocalPose& pose : clip.frames) {
    std::vector<GlobalTransform> globals;
    ComputeGlobals(clip.skeleton, pose, globals);
    waved.hand.push_back(globals[static_cast<std::size_t>(clip.skeleton.Find("Hand"))].position);
  }
  waved.remark = motion->remark;
  return waved;
}

/// Expects one frame for each 1/30 s, with the hand where `place` puts it.
template <typename Place>
void ExpectHand(const Waved& waved, double from_s, double to_s, Place place, const std::string& what = "") {
  ASSERT_EQ(waved.hand.size(), std::lround((to_s - from_s) * 30) + 1) << what << waved.remark;
  for (std::size_t k = 0; k < waved.hand.size(); ++k) {
    const glm::dvec3 truth = place(from_s + static_cast<double>(k) / 30);
    EXPECT_NEAR(glm::distance(waved.hand[k], truth), 0, 1e-5) << what << " frame " << k;
  }
}
glm::dvec3 Truth(double time_s) { return HandAt(Angle(time_s)); }

TEST(FbxTakes, TheBaseLayerIsReadAndLayersThatChangeItAreTold) {
  const ArmLayer base = Baked("Base", 0, 1, Angle);
  const auto zero = [](double) { return 0.0; };
  const auto other = [](double time_s) { return 50 - 30 * time_s; };
  const Waved alone = Read(ArmFile({base}));
  ExpectHand(alone, 0, 1, Truth, "the control: one layer");
  EXPECT_EQ(alone.remark, "");
  for (const auto& layer : {Baked("Fix", 0, 1, zero), Baked("Fix", 0, 1, other), Baked("Fix", 0, 0, other),
                            Baked("Fix", 0, 1, other, Number("BlendMode", 1) + Number("Weight", 60))}) {
    const Waved waved = Read(ArmFile({base, layer}));
    ExpectHand(waved, 0, 1, Truth);
    EXPECT_THAT(
        waved.remark,
        HasSubstr(
            "clip 'Wave': Etude uses only the animation layer 'Base' and leaves out the other layers ('Fix'); bake"));
  }
  for (const char* silent : {"Weight", "Mute"}) {
    const Waved waved = Read(ArmFile({base, Baked("Fix", 0, 1, other, Number(silent, *silent == 'W' ? 0 : 1))}));
    ExpectHand(waved, 0, 1, Truth, silent);
    EXPECT_EQ(waved.remark, "") << silent;
  }
}

TEST(FbxTakes, ALayerThatOverridesTheBaseFullyReplacesIt) {
  const auto other = [](double time_s) { return 50 - 30 * time_s * time_s; };
  const auto place = [&](double time_s) { return HandAt(other(time_s)); };
  const ArmLayer base = Baked("Base", 0, 1, Angle);
  for (const double mode : {1, 2}) {
    const Waved waved = Read(ArmFile({base, Baked("Over", 0, 1, other, Number("BlendMode", mode))}));
    ExpectHand(waved, 0, 1, place);
    EXPECT_EQ(waved.remark, "");
  }
  const Waved solo = Read(ArmFile({base, Baked("Only", 0, 1, other, Number("Solo", 1))}));
  ExpectHand(solo, 0, 1, place);
  EXPECT_THAT(solo.remark, HasSubstr("Etude uses only the animation layer 'Only'"));
}

TEST(FbxTakes, KeysOutsideOfTheTimeSpanAreLeftOutAndTold) {
  const ArmLayer keys = Baked("Base", 0, 2, Angle);
  const std::string preset = Preset(Span(0, 0));
  const auto cut = [](double seconds) {
    return fmt::format("(LocalStart to LocalStop); these keys reach {:.2f} s beyond it", seconds);
  };
  for (const auto& [from_s, to_s] : {std::pair(0.5, 1.5), {1.0, 2.0}, {0.0, 1.0}}) {
    const Waved waved = Read(ArmFile({keys}, {.span = Span(from_s, to_s)}));
    ExpectHand(waved, from_s, to_s, Truth, fmt::format("{} s", from_s));
    EXPECT_THAT(waved.remark, HasSubstr(cut(std::max(from_s, 2 - to_s))));
  }
  // An end of a span that the file does not state is the template's, or 0.
  for (const std::string& by_template : {preset, std::string()}) {
    for (const double before_s : {0.0, 0.5}) {
      const Waved waved =
          Read(ArmFile({Baked("Base", -before_s, 1, Angle)}, {.span = Time("LocalStop", 1), .preset = by_template}));
      ExpectHand(waved, 0, 1, Truth, by_template);
      EXPECT_EQ(waved.remark.find("Etude leaves out keys outside") != std::string::npos, before_s > 0) << waved.remark;
    }
  }
  // The controls: the span of the keys, a wider one, and none; keys that begin later or earlier than 0.
  for (const double from_s : {0.0, 3.0, -1.0}) {
    for (const std::string& span :
         {Span(from_s, from_s + 1), Span(from_s, from_s + 7), Span(0, 0), Span(from_s + 0.5, from_s + 0.5),
          Time("LocalStart", -9e7) + Time("LocalStop", 9e7), std::string()}) {
      for (const std::string& by_template : {preset, std::string()}) {
        const Waved waved =
            Read(ArmFile({Baked("Base", from_s, from_s + 1, Angle)}, {.span = span, .preset = by_template}));
        ExpectHand(waved, from_s, from_s + 1, Truth, span + by_template);
        EXPECT_EQ(waved.remark, "") << span;
      }
    }
  }
  const Waved beside = Read(ArmFile({keys}, {.span = Span(5, 6)}));
  ExpectHand(beside, 0, 2, Truth);
  EXPECT_THAT(beside.remark, HasSubstr("contains no key, so Etude uses all keys"));
}

TEST(FbxTakes, SparseKeysCountBeyondTheTimeSpan) {
  for (const double turns : {1.0, -1.0}) {
    const Waved waved = Read(ArmFile({{"Base", "", {0, 2}, {0, turns * 80}}}, {.span = Span(0.5, 1.5)}));
    ASSERT_GE(waved.hand.size(), 2u);
    EXPECT_NEAR(glm::distance(waved.hand.front(), HandAt(turns * 20)), 0, 1e-5);
    EXPECT_NEAR(glm::distance(waved.hand.back(), HandAt(turns * 60)), 0, 1e-5);
  }
}

// FBX places a joint by T R_off R_p R_pre R R_post⁻¹ R_p⁻¹ …; geometric transforms move its mesh only.
TEST(FbxTakes, PostRotationsTurnBackwardsWithAndWithoutPivots) {
  const ArmLayer keys = Baked("Base", 0, 1, Angle);
  const std::string post = Triple("PostRotation", 0, 0, 40), pivot = Triple("RotationPivot", 3, 0, 0);
  ExpectHand(Read(ArmFile({keys}, {.arm = post})), 0, 1, [](double t) { return HandAt(Angle(t) - 40); });
  ExpectHand(Read(ArmFile({keys}, {.arm = post + Triple("PreRotation", 0, 0, 25)})), 0, 1,
             [](double t) { return HandAt(Angle(t) + 25 - 40); });
  ExpectHand(Read(ArmFile({keys}, {.arm = post + pivot})), 0, 1, [](double t) {
    const double angle = glm::radians(Angle(t) - 40);
    return HandAt(Angle(t) - 40,
                  glm::dvec3(kArm + 0.03, 0, 0) - 0.03 * glm::dvec3(std::cos(angle), std::sin(angle), 0));
  });
  // The axes differ: R_z R_x⁻¹ leaves the hand on its circle, R_z R_y(90°)⁻¹ puts it on the arm's axis Z.
  ExpectHand(Read(ArmFile({keys}, {.arm = Triple("PostRotation", 70, 0, 0)})), 0, 1, Truth);
  ExpectHand(Read(ArmFile({keys}, {.arm = Triple("PostRotation", 0, 90, 0)})), 0, 1,
             [](double) { return glm::dvec3(kArm, 0, kHand); });
  // Keys that begin at another time than 0, beside the parts of a pivot, which have keys at 0 only.
  ExpectHand(
      Read(ArmFile({Baked("Base", 4, 5, Angle)}, {.arm = Triple("RotationOffset", 3, 0, 0), .span = Span(4, 5)})), 4, 5,
      [](double t) {
        return HandAt(Angle(t), {kArm + 0.03, 0, 0});
      });
}

TEST(FbxTakes, GeometricTransformsMoveNoJoint) {
  const std::string geometric = Triple("GeometricTranslation", 1, 2, 3) + Triple("GeometricRotation", 10, 20, 30) +
                                Triple("GeometricScaling", 2, 2, 2);
  const ArmLayer keys = Baked("Base", 0, 1, Angle);
  ExpectHand(Read(ArmFile({keys}, {.arm = geometric, .hips = geometric})), 0, 1, Truth);
  ASSERT_OK(motion, ReadFbx(ArmFile({keys}, {.arm = geometric, .hips = geometric}), "a.fbx"));
  ASSERT_OK(content, ReadGltf(motion->glb, "a.fbx", nullptr));
  const Clip& clip = content->clips[0];
  std::vector<GlobalTransform> globals;
  ComputeGlobals(clip.skeleton, clip.frames[0], globals);
  const auto at = [&](const char* joint) { return globals[static_cast<std::size_t>(clip.skeleton.Find(joint))]; };
  EXPECT_NEAR(glm::distance(at("Arm").position, glm::dvec3(kArm, 0, 0)), 0, 1e-5);
  EXPECT_NEAR(glm::length(at("Hips").position), 0, 1e-5);
  for (const Joint& joint : clip.skeleton.joints) EXPECT_EQ(joint.name.find("Geometric"), std::string::npos);
}

TEST(FbxTakes, JointsThatDoNotInheritAScaleAreDoubted) {
  const auto type = [](int number) { return fmt::format("P: \"InheritType\", \"enum\", \"\", \"\",{}\n", number); };
  const auto doubt = [&](int number, double scale) {
    return DoubtOfScales(ArmFile({}, {.arm = type(number), .hips = Triple("Lcl Scaling", scale, scale, scale)}));
  };
  EXPECT_THAT(doubt(2, 1.1), HasSubstr("joint 'Arm' should not inherit the scale of its parent 'Hips'"));
  EXPECT_EQ(doubt(2, 1), "");
  EXPECT_EQ(doubt(1, 1.1), "");
}

/// Returns a binary file of one clip with two layers that move an arm; the second one is connected to `to`.
std::string TwoLayers(std::uint32_t version, std::int64_t from, std::int64_t until, std::int64_t to) {
  const auto object = [](const char* kind, std::int64_t id, std::string name, const char* type,
                         std::vector<FbxWriter::Node> properties = {}) {
    name += std::string("\0\1", 2) + kind;
    FbxWriter::Node node{kind, "L" + NumberBytes(id) + TextValue(name) + TextValue(type), 3};
    if (!properties.empty()) node.children = {{"Properties70", "", 0, std::move(properties)}};
    return node;
  };
  const auto link = [](std::int64_t source, std::int64_t target, const std::string& property = "") {
    FbxWriter::Node node{"C", TextValue(property.empty() ? "OO" : "OP"), 3};
    node.properties += "L" + NumberBytes(source) + "L" + NumberBytes(target);
    if (!property.empty()) node.properties += TextValue(property);
    return node;
  };
  return FbxWriter(version).File(
      {{"Objects",
        "",
        0,
        {object("AnimationStack", 1, "Wave", "", {Entry("LocalStart", from), Entry("LocalStop", until)}),
         object("AnimationLayer", 2, "Base", ""), object("AnimationLayer", 3, "Fix", ""),
         object("AnimationCurveNode", 4, "R", ""), object("AnimationCurveNode", 5, "R", ""),
         object("AnimationCurve", 6, "", ""), object("AnimationCurve", 7, "", ""),
         object("Model", 8, "Arm", "LimbNode")}},
       {"Connections",
        "",
        0,
        {link(2, 1), link(3, to), link(4, 2), link(5, 3), link(4, 8, "Lcl Rotation"), link(5, 8, "Lcl Rotation"),
         link(6, 4, "d|X"), link(7, 5, "d|X")}}});
}

TEST(FbxTakes, LayersAndSpansOfBinaryFilesChangeInPlace) {
  const auto margin = static_cast<std::int64_t>(kFbxMarginS) * kSecond;
  for (const std::uint32_t version : {7400u, 7700u}) {
    std::string changed;
    const auto remarks = PrepareTakes(TwoLayers(version, kSecond, 3 * kSecond, 1), changed);
    EXPECT_THAT(remarks, testing::ElementsAre(HasSubstr("'Base' and leaves out the other layers ('Fix')")));
    EXPECT_TRUE(changed == TwoLayers(version, kSecond - margin, 3 * kSecond + margin, 0)) << version;
    EXPECT_TRUE(PrepareTakes(TwoLayers(version, 0, kSecond, 0), changed).empty()) << "the control: one layer";
    EXPECT_TRUE(changed == TwoLayers(version, -margin, kSecond + margin, 0));
  }
}

TEST(FbxTakes, DamagedFilesAreReadWithinTheirBytes) {
  for (const std::string& good : {TwoLayers(7400, 0, kSecond, 1), ArmFile({Baked("Base", 0, 0.1, Angle)})}) {
    std::string changed;
    for (std::size_t at = 0; at < good.size(); ++at) {
      PrepareTakes(std::string_view(good).substr(0, at), changed);
      for (const char value : {'\0', '\x7f', '\xff', '"', '}'}) {
        std::string bad = good;
        bad[at] = value;
        PrepareTakes(bad, changed);
        DoubtOfScales(bad);
      }
    }
  }
}

}  // namespace
}  // namespace etude
