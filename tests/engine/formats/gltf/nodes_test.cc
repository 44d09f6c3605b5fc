#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "tests/engine/formats/gltf/small_glb.h"
#include "tests/support/replaced.h"

namespace etude {
namespace {

using ::testing::ElementsAre;
using testing::Glb;
using testing::Read;

/// Returns the skeleton of a file with these nodes; without `scenes` all nodes count.
Skeleton SkeletonOf(const std::string& nodes, const std::string& scenes = "") {
  const std::string before = scenes.empty() ? "" : R"("scenes":)" + scenes + ",";
  return Read(Glb(R"({"asset":{"version":"2.0"},)" + before + R"("nodes":)" + nodes + "}")).character.skeleton;
}

std::vector<std::string> Names(const Skeleton& skeleton) {
  std::vector<std::string> names;
  for (const Joint& joint : skeleton.joints) names.push_back(joint.name);
  return names;
}

std::vector<int> Parents(const Skeleton& skeleton) {
  std::vector<int> parents;
  for (const Joint& joint : skeleton.joints) parents.push_back(joint.parent);
  return parents;
}

void ExpectPlace(const glm::dvec3& found, const glm::dvec3& expected) {
  EXPECT_LT(glm::length(found - expected), 1e-9) << "(" << found.x << ", " << found.y << ", " << found.z << ")";
}

TEST(GltfNodes, BecomeJointsInTheFilesOrderButParentsFirst) {
  const Skeleton skeleton = SkeletonOf(R"([{"name":"toe"},{"name":"hand"},{"name":"hip","children":[3,1]},
      {"name":"foot","children":[0]}])");
  EXPECT_THAT(Names(skeleton), ElementsAre("hip", "foot", "toe", "hand"));
  EXPECT_THAT(Parents(skeleton), ElementsAre(-1, 0, 1, 0));
}

TEST(GltfNodes, KeepsSeveralRoots) {
  const Skeleton skeleton = SkeletonOf(R"([{"name":"a"},{"name":"b","children":[2]},{"name":"c"}])");
  EXPECT_THAT(Parents(skeleton), ElementsAre(-1, -1, 1));
}

TEST(GltfNodes, OutsideTheDefaultSceneAreLeftOut) {
  const std::string nodes = R"([{"name":"a"},{"name":"b"}])";
  EXPECT_THAT(Names(SkeletonOf(nodes, R"([{"nodes":[1]},{"nodes":[0]}])")), ElementsAre("b"));
  EXPECT_THAT(Names(SkeletonOf(nodes, R"([{"nodes":[1]},{"nodes":[0]}],"scene":1)")), ElementsAre("a"));
}

TEST(GltfNodes, OutsideTheSceneAreKeptWhenTheyAreAnimatedOrBones) {
  const std::string json = testing::Replaced(testing::kSmallGltf, R"("nodes":[0,2])", R"("nodes":[2])");
  const GltfContent content = Read(Glb(json, testing::SmallBinary()));
  EXPECT_THAT(Names(content.character.skeleton), ElementsAre("Hips", "Spine"));
  EXPECT_EQ(content.character.meshes.size(), 1u);
}

TEST(GltfNodes, OutsideTheSceneAreKeptWithTheirAncestorsWhereEitherAloneNeedsThem) {
  std::string json(testing::kSmallGltf);
  const auto cut = [&](const std::string& from, std::size_t bytes, const std::string& to) {
    ASSERT_NE(json.find(from), std::string::npos) << from;
    json.replace(json.find(from), bytes, to);
  };
  cut(R"("nodes":[0,2])", 13, R"("nodes":[2])");
  const std::string with_skin = json;
  cut(R"(,"mesh":0,"skin":0)", 18, "");
  cut(R"("skins":)", json.find(R"("meshes":)") - json.find(R"("skins":)"), "");
  EXPECT_THAT(Names(Read(Glb(json, testing::SmallBinary())).character.skeleton), ElementsAre("Hips", "Spine", "Body"));
  cut(R"("animations":)", json.find(R"("accessors":)") - json.find(R"("animations":)"), "");
  EXPECT_THAT(Names(Read(Glb(json, testing::SmallBinary())).character.skeleton), ElementsAre("Body"));
  json = with_skin;
  cut(R"("animations":)", json.find(R"("accessors":)") - json.find(R"("animations":)"), "");
  EXPECT_THAT(Names(Read(Glb(json, testing::SmallBinary())).character.skeleton), ElementsAre("Hips", "Spine"))
      << "bones that nothing moves";
}

TEST(GltfNodes, ThatOnlyHoldASkinnedMeshAreNoJoints) {
  EXPECT_THAT(Names(Read(testing::SmallGlb()).character.skeleton), ElementsAre("Hips", "Spine"));
}

TEST(GltfNodes, MustBeInTheDefaultScene) {
  EXPECT_THAT(testing::GlbComplaint(Glb(R"({"asset":{"version":"2.0"},"scenes":[{}],"nodes":[{}]})")),
              ::testing::HasSubstr("scenes: the default scene has no nodes; allowed: at least one"));
}

TEST(GltfNodes, WithoutNamesAreNumbered) {
  EXPECT_THAT(Names(SkeletonOf(R"([{"children":[1]},{}])")), ElementsAre("node_0", "node_1"));
}

TEST(GltfNodes, OfOneNameAreNumbered) {
  EXPECT_THAT(Names(SkeletonOf(R"([{"name":"a","children":[1]},{"name":"a"}])")), ElementsAre("a", "a#2"));
}

TEST(GltfNodes, KeepTranslationRotationAndScaleToTheLastDigit) {
  const Skeleton skeleton =
      SkeletonOf(R"([{"translation":[0.1,-0.2,3e5],"rotation":[0.6,0,0,0.8],"scale":[2,-0.5,0.25]}])");
  const LocalTransform& rest = skeleton.joints.at(0).rest;
  EXPECT_EQ(rest.translation, glm::dvec3(0.1, -0.2, 3e5));
  EXPECT_EQ(rest.rotation, glm::dquat(0.8, 0.6, 0, 0));
  EXPECT_EQ(rest.scale, glm::dvec3(2, -0.5, 0.25));
}

TEST(GltfNodes, MakeRotationsUnit) {
  const Skeleton skeleton = SkeletonOf(R"([{"rotation":[0,0,3,4]}])");
  EXPECT_NEAR(glm::length(skeleton.joints.at(0).rest.rotation - glm::dquat(0.8, 0, 0, 0.6)), 0, 1e-15);
}

TEST(GltfNodes, TakeMatricesApart) {
  // Columns: X to 2Y, Y to −3X, Z to 4Z; then a translation.
  const Skeleton skeleton = SkeletonOf(R"([{"matrix":[0,2,0,0,-3,0,0,0,0,0,4,0,5,6,7,1]}])");
  const LocalTransform& rest = skeleton.joints.at(0).rest;
  ExpectPlace(rest.translation, {5, 6, 7});
  ExpectPlace(rest.scale, {2, 3, 4});
  ExpectPlace(glm::eulerAngles(rest.rotation), {0, 0, std::numbers::pi / 2});
}

TEST(GltfNodes, TakeMirroringMatricesApart) {
  const Skeleton skeleton = SkeletonOf(R"([{"matrix":[1,0,0,0,0,1,0,0,0,0,-2,0,0,0,0,1]}])");
  std::vector<GlobalTransform> globals;
  ComputeGlobals(skeleton, RestPose(skeleton), globals);
  const glm::dmat3& axes = globals.at(0).axes;
  ExpectPlace(axes[0], {1, 0, 0});
  ExpectPlace(axes[1], {0, 1, 0});
  ExpectPlace(axes[2], {0, 0, -2});
}

}  // namespace
}  // namespace etude
