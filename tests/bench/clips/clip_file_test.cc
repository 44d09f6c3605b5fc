#include "bench/clips/clip_file.h"

#include "tests/bench/clips/clip_folder.h"

namespace etude {
namespace {

class ClipFileTest : public ClipFolder {
 protected:
  std::string Complaint(const std::string& path) {
    const auto file = ReadClipFile(path);
    EXPECT_FALSE(file) << path;
    return file ? "" : ToString(file.error());
  }
};

TEST_F(ClipFileTest, TheFormatIsToldByContentNotByName) {
  const auto bvh = ReadClipFile(Write("really_bvh.glb", kTwoJoints));
  ASSERT_TRUE(bvh) << ToString(bvh.error());
  EXPECT_EQ(bvh->format, ClipFormat::kBvh);
  EXPECT_EQ(bvh->clips.size(), 1u);
  const auto gltf = ReadClipFile(Write("really_gltf.bvh", GltfWith("")));
  ASSERT_TRUE(gltf) << ToString(gltf.error());
  EXPECT_EQ(gltf->format, ClipFormat::kGltf);
  EXPECT_TRUE(gltf->clips.empty());
  EXPECT_EQ(gltf->figure.skeleton.joints.size(), 2u);
}

TEST_F(ClipFileTest, WhatIsNeitherIsToldWithWhatIsAllowed) {
  EXPECT_NE(Complaint(Write("x.bvh", "hello\n")).find("x.bvh:1:1: a file that begins with 'hello'; allowed: BVH"),
            std::string::npos);
  EXPECT_NE(Complaint(Write("empty.glb", "")).find("an empty file"), std::string::npos);
  EXPECT_NE(Complaint(Write("a.fbx", "Kaydara FBX Binary  ...")).find("an FBX file, which Blender turns into glTF"),
            std::string::npos);
  EXPECT_NE(Complaint(folder_.path().string()).find("is no file"), std::string::npos);
  EXPECT_NE(Complaint(In("none.bvh")).find("no such file"), std::string::npos);
}

TEST_F(ClipFileTest, AFileThatIsTooLargeIsRefusedBeforeItIsRead) {
  const std::string path = Write("huge.bvh", "HIERARCHY");
  std::filesystem::resize_file(path, kLargestClipFile + 1);  // takes no room on the disk
  EXPECT_NE(Complaint(path).find("501 MB; at most 500 MB"), std::string::npos);
}

TEST_F(ClipFileTest, BuffersAreReadFromTheFilesOwnFolder) {
  Write("deeper/numbers.bin", AnimationBytes());
  const auto file = ReadClipFile(Write("a.gltf", GltfWithAnimations("deeper/numbers.bin")));
  ASSERT_TRUE(file) << ToString(file.error());
  EXPECT_EQ(file->clips.size(), 2u);
  EXPECT_NE(Complaint(Write("b.gltf", GltfWithAnimations("absent.bin"))).find("'absent.bin': No such file"),
            std::string::npos);
}

TEST_F(ClipFileTest, NothingOutsideTheFolderIsRead) {
  Write("outside/numbers.bin", AnimationBytes());
  Write("inside/numbers.bin", AnimationBytes());
  std::filesystem::create_symlink(In("outside/numbers.bin"), In("inside/link.bin"));
  std::filesystem::create_symlink(In("inside/numbers.bin"), In("inside/fine.bin"));
  // The control: a link that stays inside is followed.
  EXPECT_TRUE(ReadClipFile(Write("inside/fine.gltf", GltfWithAnimations("fine.bin"))));
  EXPECT_NE(
      Complaint(Write("inside/a.gltf", GltfWithAnimations("link.bin"))).find("a link that leads out of the folder"),
      std::string::npos);
  for (const std::string uri : {"../outside/numbers.bin", "%2e%2e/outside/numbers.bin", "/etc/hostname",
                                "file:///etc/hostname", "http://localhost/numbers.bin"}) {
    EXPECT_FALSE(ReadClipFile(Write("inside/b.gltf", GltfWithAnimations(uri)))) << uri;
  }
}

TEST_F(ClipFileTest, BuffersCountTogetherWithTheFile) {
  Write("numbers.bin", AnimationBytes());
  std::filesystem::resize_file(In("numbers.bin"), kLargestClipFile - 10);
  EXPECT_NE(Complaint(Write("a.gltf", GltfWithAnimations("numbers.bin"))).find("at most 500 MB"), std::string::npos);
}

// Debian's assimp-testmodels: one box, its picture beside it, within a URI and within the GLB.
TEST_F(ClipFileTest, TexturesAreTheSameWhereverTheyStand) {
  const std::string models = "/usr/share/assimp/models/glTF2/BoxTextured-glTF";
  std::vector<SharedTexture> textures;
  for (const std::string name : {"/BoxTextured.gltf", "-Embedded/BoxTextured.gltf", "-Binary/BoxTextured.glb"}) {
    if (!std::filesystem::exists(models + name)) GTEST_SKIP() << "no " << models << name;
    const auto file = ReadClipFile(models + name);
    ASSERT_TRUE(file) << ToString(file.error());
    ASSERT_EQ(file->figure.materials.size(), 1u);
    textures.push_back(file->figure.materials[0].texture);
    ASSERT_TRUE(textures.back()) << name;
    EXPECT_GT(textures.back()->picture.width, 100);
    EXPECT_TRUE(textures.back()->picture.pixels == textures.front()->picture.pixels) << name;
  }
}

}  // namespace
}  // namespace etude
