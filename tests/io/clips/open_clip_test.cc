#include "io/clips/open_clip.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "engine/formats/joint_csv.h"
#include "engine/formats/trc.h"
#include "engine/retargeting/rig.h"
#include "io/clips/clip_library.h"
#include "io/clips/references.h"
#include "sim/choreography/canonical_body.h"
#include "sim/choreography/song.h"
#include "tests/io/clips/clip_folder.h"
#include "tests/support/gaps.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class OpenClipTest : public ClipFolder {
 protected:
  void SetUp() override {
    Write("numbers.bin", AnimationBytes());
    dance_ = Write("dance.gltf", GltfWithAnimations("numbers.bin"));
  }

  std::vector<std::string> Expanded(const std::string& reference) {
    const auto expanded = ExpandReference(reference, {});
    EXPECT_TRUE(expanded) << reference;
    return expanded ? *expanded : std::vector<std::string>{};
  }
  static std::string Complaint(const std::string& reference) {
    const auto clips = ReadClips(reference);
    EXPECT_FALSE(clips) << reference;
    return clips ? "" : ToString(clips.error());
  }

  std::string dance_;
};

TEST_F(OpenClipTest, AByteOrderMarkBeforeTextChangesNothing) {
  BodyMotion still{.rate_hz = 30, .poses = std::vector<BodyPose>(40, StandingPose())};
  const std::string trc = WriteTrc(still, "still");
  ASSERT_OK(plain, ReadClips(Write("plain.trc", trc)));
  ASSERT_OK(marked, ReadClips(Write("marked.trc", "\xEF\xBB\xBF" + trc)));
  EXPECT_EQ(marked->at(0).clip.frames, plain->at(0).clip.frames);
}

TEST_F(OpenClipTest, LineEndsOfOldMacsAndLeadingBlankLinesChangeNothing) {
  BodyMotion waving{.rate_hz = 30, .poses = std::vector<BodyPose>(40, StandingPose())};
  for (std::size_t t = 0; t < waving.poses.size(); ++t)
    waving.poses[t][Role::kLeftHand].y += .2 * std::sin(.3 * static_cast<double>(t));
  const std::string motive =
      "Format Version,1.23,Export Frame Rate,60.0,Length Units,Meters,Coordinate Space,Global\n\n,Type" + [] {
        std::string types, names = "\n,Name", kinds = "\n,", axes = "\nFrame,Time (Seconds)", first, second;
        const BodyPose pose = StandingPose();
        for (const Role role : AllRoles()) {
          for (int axis = 0; axis < 3; ++axis) {
            types += ",Bone", kinds += ",Position", names += "," + std::string(RoleName(role));
            axes += std::string(",") + "XYZ"[axis], first += fmt::format(",{}", pose[role][axis]);
          }
        }
        return types + names + kinds + axes + "\n0,0.0" + first + "\n1,0.0166667" + first + "\n";
      }();
  for (const auto& [name, text] :
       {std::pair("a.trc", WriteTrc(waving, "waving")), {"a.csv", WriteJointCsv(waving)}, {"m.csv", motive}}) {
    ASSERT_OK(plain, ReadClips(Write(name, text)));
    std::string of_mac = text, twice;
    std::ranges::replace(of_mac, '\n', '\r');
    for (const char c : text) twice += c == '\n' ? std::string("\r\r\n") : std::string(1, c);
    for (const std::string& other : {of_mac, twice, "\n" + text, "\r\n \r\n" + text, "\xEF\xBB\xBF\n" + text}) {
      ASSERT_OK(read, ReadClips(Write(name, other)));
      EXPECT_EQ(read->at(0).clip.frames, plain->at(0).clip.frames) << name;
      EXPECT_EQ(read->at(0).format, plain->at(0).format) << name;
    }
  }
}

TEST_F(OpenClipTest, AClockOfMillisecondsAndARateThatNoFileStatesAreSaid) {
  std::string slow(kTwoJoints);
  slow.replace(slow.find("Time: 0.1"), 9, "Time: 8.3");
  EXPECT_THAT(ReadClips(Write("a.bvh", slow))->at(0).remarks,
              ElementsAre("frames are 8.3 s apart: are the times in milliseconds, or are they frame numbers? Use "
                          "`--rate` (for `etude clip convert`: `--file-rate`) to set the rate"));
  slow.replace(slow.find("Time: 8.3"), 9, "Time: 1.0");
  EXPECT_THAT(ReadClips(Write("a.bvh", slow))->at(0).remarks,
              ElementsAre(::testing::StartsWith("frames are 1 s apart: are the times in milliseconds")));
  EXPECT_THAT(ReadClips(Write("b.bvh", kTwoJoints))->at(0).remarks, ElementsAre());
  const std::string asf =
      ":root\norder TX\nposition 0 0 0\n:bonedata\nbegin\nname a\ndirection 1 0 0\nlength 1\nend\n:hierarchy\nbegin\n"
      "root a\nend\n";
  Write("c.asf", asf);
  const std::string motion = Write("c.amc", ":FULLY-SPECIFIED\n1\nroot 1\n2\nroot 2\n");
  EXPECT_THAT(ReadClips(motion)->at(0).remarks, ElementsAre("the file states no rate, so Etude assumes 120 Hz"));
}

TEST_F(OpenClipTest, EveryAnimationIsAClipOfItsOwn) {
  ASSERT_OK(clips, ReadClips(dance_));
  ASSERT_EQ(clips->size(), 2u);
  EXPECT_EQ(clips->at(0).name, "dance#Armature|Jump");
  EXPECT_EQ(clips->at(1).source, dance_ + "#Armature|Walk");
  EXPECT_EQ(clips->at(0).character, nullptr) << "nodes without meshes are no figure";
}

TEST_F(OpenClipTest, AnimationsOfOneNameAndASecondBodyAreSaid) {
  std::string gltf = GltfWithAnimations("numbers.bin");
  gltf.replace(gltf.find("|Walk"), 5, "|Jump");
  ASSERT_OK(clips, ReadClips(Write("same.gltf", gltf)));
  EXPECT_EQ(clips->at(1).name, "same#Armature|Jump_2");
  EXPECT_THAT(clips->at(0).remarks,
              ElementsAre("two animations are named 'Armature|Jump'; Etude renames the second to 'Armature|Jump_2'"));
  // Two people on one skeleton; readers number joints of the same name.
  Clip pair = RigClip({.rate_hz = 30, .poses = {StandingPose(), StandingPose()}}, StandingPose(), "pair");
  SourceClip source{.name = "one", .source = "one.glb", .format = ClipFormat::kGlb, .clip = pair};
  const auto alone = UnderstandClip(source, {});
  ASSERT_TRUE(alone) << ToString(alone.error());
  EXPECT_THAT(alone->body.doubts, ElementsAre());
  const int count = static_cast<int>(pair.skeleton.joints.size());
  for (int i = 0; i < count; ++i) {
    Joint joint = pair.skeleton.joints[static_cast<std::size_t>(i)];
    joint.name += "#2";
    joint.parent = joint.parent < 0 ? -1 : joint.parent + count;
    pair.skeleton.joints.push_back(joint);
  }
  for (LocalPose& frame : pair.frames) frame.insert(frame.end(), frame.begin(), frame.begin() + count);
  source.clip = pair;
  const auto both = UnderstandClip(source, {});
  ASSERT_TRUE(both) << ToString(both.error());
  EXPECT_THAT(both->body.doubts,
              ElementsAre("the file contains a second body with the left hip 'left_hip#2'; Etude uses the body with "
                          "'left_hip' (use --joint-map to choose another body)"));
}

TEST_F(OpenClipTest, AnAnimationIsChosenByNameOrByItsEnd) {
  for (const std::string name : {"#Armature|Walk", "#Walk"}) {
    ASSERT_OK(clips, ReadClips(dance_ + name));
    ASSERT_EQ(clips->size(), 1u);
    EXPECT_EQ(clips->front().source, dance_ + "#Armature|Walk");
  }
  EXPECT_THAT(Complaint(dance_ + "#Armature|Wolk"), HasSubstr("did you mean 'Armature|Walk'? Allowed: Armature|Jump"));
  EXPECT_THAT(Complaint(dance_ + "#"), HasSubstr("unknown animation ''"));
}

TEST_F(OpenClipTest, FilesWithoutMotionAndChoicesWithoutMeaningAreRefused) {
  EXPECT_THAT(Complaint(Write("figure.gltf", GltfWith(""))),
              HasSubstr("the file contains no animation, only a character (joints: 2"));
  EXPECT_THAT(Complaint(Write("a.bvh", kTwoJoints) + "#Jump"), HasSubstr("a BVH file has only one motion"));
}

TEST_F(OpenClipTest, AFileThatItselfHoldsASignIsThatFile) {
  const std::string sharp = Write("take#2.bvh", kTwoJoints);
  ASSERT_OK(clips, ReadClips(sharp));
  EXPECT_EQ(clips->front().name, "take#2");
  Write("numbers[1].bvh", kTwoJoints);
  EXPECT_THAT(Expanded(In("numbers[1].bvh")), ElementsAre(In("numbers[1].bvh")));
}

TEST_F(OpenClipTest, PatternsStandForFilesInOrderEachWithTheAnimation) {
  const std::string a = Write("a.bvh", kTwoJoints), b = Write("b.bvh", kTwoJoints);
  EXPECT_THAT(Expanded(In("*.bvh")), ElementsAre(a, b));
  EXPECT_THAT(Expanded(In("d*.gltf#Walk")), ElementsAre(dance_ + "#Walk"));
  EXPECT_THAT(testing::Refusal(ExpandReference(In("*.fbx"), {.file = "s.yaml", .line = 3, .column = 9})),
              HasSubstr("s.yaml:3:9: no clip matches '"));
}

TEST_F(OpenClipTest, BuiltinsAreMovesActsAndSongs) {
  EXPECT_EQ(Expanded("builtin:*").size(), BuiltinMoveNames().size());
  EXPECT_EQ(Expanded("builtin:acts").size(), BuiltinActNames().size());
  ASSERT_EQ(Expanded("builtin:songs").size(), BuiltinSongNames().size());
  ASSERT_OK(song, LoadBuiltinClip(BuiltinSongNames().front(), {}));
  EXPECT_FALSE(song->move) << "a song is no move that a recogniser was taught";
  EXPECT_TRUE(LoadBuiltinClip("clap", {})->move);
  EXPECT_TRUE(LoadBuiltinClip("wave", {}));
  EXPECT_THAT(Complaint("builtin:clapp"), HasSubstr("did you mean 'clap'?"));
}

TEST_F(OpenClipTest, ABuiltinClipIsUnderstoodAsTheVeryBodyThatDancedIt) {
  auto clips = ReadClips("builtin:boxing");
  ASSERT_TRUE(clips);
  ASSERT_OK(opened, UnderstandClip(std::move(clips->front()), {}));
  const BodyMotion danced = LoadBuiltinMove("boxing")->motion;
  EXPECT_LT(WorstJointDistance(opened->body.motion, danced), 1e-9);
}

TEST_F(OpenClipTest, ALibraryTakesAllKindsInOrderAndNamesWhatItCannotUnderstand) {
  const std::string real = "/usr/share/assimp/models/BVH/01_03.bvh";
  ASSERT_OK(library, LoadClips({"builtin:clap", real, "builtin:wave"}, {}));
  ASSERT_EQ(library->clips.size(), 3u);
  EXPECT_EQ(library->clips[1].name, "01_03");
  EXPECT_EQ(library->clips[1].source, real);
  EXPECT_THAT(library->clips[1].changes.front(), HasSubstr("1 unit = 5.6"));
  EXPECT_FALSE(library->clips[1].move);
  EXPECT_THAT(testing::Refusal(LoadClips({"builtin:clap", dance_}, {})),
              HasSubstr("dance.gltf#Armature|Jump: no joint found for left_shoulder"));
}

TEST_F(OpenClipTest, WhatIsTaughtComesBeforeWhatIsFound) {
  const std::string real = "/usr/share/assimp/models/BVH/01_03.bvh";
  ASSERT_OK(taught, ReadJointMapFile("roles:\n  left_hand: RightHand\n", "m.yaml"));
  const auto swapped = LoadClips({real}, {}, {.roles = *taught});
  ASSERT_FALSE(swapped) << "a left hand on the right arm";
  EXPECT_THAT(ToString(swapped.error()), HasSubstr("the role left_hand has the joint 'RightHand'"));
}

class ClipFileTest : public ClipFolder {
 protected:
  std::string Complaint(const std::string& path) {
    const auto file = ReadClipFile(path);
    EXPECT_FALSE(file) << path;
    return file ? "" : ToString(file.error());
  }
};

TEST_F(ClipFileTest, TheFormatIsToldByContentNotByName) {
  ASSERT_OK(bvh, ReadClipFile(Write("really_bvh.glb", kTwoJoints)));
  EXPECT_EQ(bvh->format, ClipFormat::kBvh);
  EXPECT_EQ(bvh->clips.size(), 1u);
  ASSERT_OK(gltf, ReadClipFile(Write("really_gltf.bvh", GltfWith(""))));
  EXPECT_EQ(gltf->format, ClipFormat::kGltf);
  EXPECT_TRUE(gltf->clips.empty());
  EXPECT_EQ(gltf->figure.skeleton.joints.size(), 2u);
}

TEST_F(ClipFileTest, WhatIsNeitherIsToldWithWhatIsAllowed) {
  EXPECT_NE(Complaint(Write("x.bvh", "hello\n")).find("x.bvh:1:1: found a file that begins with 'hello'; allowed: BVH"),
            std::string::npos);
  EXPECT_NE(Complaint(Write("empty.glb", "")).find("an empty file"), std::string::npos);
  EXPECT_NE(Complaint(Write("a.fbx", "Kaydara FBX Binary  ...")).find("a.fbx: the FBX file is damaged: "),
            std::string::npos);
  for (const auto& [bytes, told] : std::vector<std::pair<std::string, const char*>>{
           {"\x1f\x8b\x08", "a gzip file: unpack it"},
           {"\x80\x04}.", "a pickled Python object, which can run code"},
           {"\xff\xfeH", "text in UTF-16: save it as UTF-8"},
           {"version https://git-lfs.github.com/spec/v1\n", "a pointer of Git LFS"},
           {"Coordinates\n", "an OpenSim table"},
           {"my walk.sto\nversion=1\nendheader\n", "an OpenSim table"},
           {":version 1.10\n:name x\n", "an Acclaim skeleton"},
           {"Vocaloid Motion Data 0002", "a motion of MikuMikuDance (.vmd), which needs a model from another file"},
           {"#usda 1.0\n", "a USD scene: export it as glTF"},
           {"NO_OF_FRAMES\t100\n", "Qualisys' TSV: in QTM, export C3D"},
           {"\xEF\xBB\xBFTrajectories\n100\n", "Vicon's CSV: in Nexus, export C3D"},
           {"# by hand\n[Header]\nFileType htr\n[SegmentNames&Hierarchy]\n", "Motion Analysis' HTR"},
           {"<?xml version=\"1.0\"?>\n<mvnx version=\"4\">", "Xsens' MVNX: in MVN, export BVH"},
           {"<?xml version=\"1.0\"?>\n<COLLADA>", "a Collada scene"},
           {"<?xml version=\"1.0\"?>\n<thing/>", "XML of an unknown type"},
           {std::string("\0\0\0 ftypisom", 12), "a film, a picture or a sound"},
           {std::string("\x55\xaa\0\1", 4), "a binary file of an unknown type: export BVH, FBX or C3D"},
           {"{\"Bodies\": []}", "JSON that is neither glTF (it has no \"asset\")"},
           {"[{\"keypoints\": []}]", "a JSON list: for joint positions, use numpy.save"},
           {"frame,x,y,z\n",
            "a table that begins with 'frame,x,y,z': for joint positions, use columns such as wrist_x, wrist_y and "
            "wrist_z"}}) {
    EXPECT_NE(Complaint(Write("other", bytes)).find(told), std::string::npos) << told;
  }
  EXPECT_NE(Complaint(folder_.path().string())
                .find("is no file, but a folder; allowed: a file, or a pattern in quotes "
                      "such as '" +
                      In("*.bvh") + "'"),
            std::string::npos);
  EXPECT_NE(Complaint(In("none.bvh")).find("no such file"), std::string::npos);
}

TEST_F(ClipFileTest, AFileThatIsTooLargeIsRefusedBeforeItIsRead) {
  const std::string path = Write("huge.bvh", "HIERARCHY");
  std::filesystem::resize_file(path, kMaxClipFileBytes + 1);  // a sparse file, which takes no space
  EXPECT_NE(Complaint(path).find("found 501 MB; allowed: at most 500 MB for a motion and its files together"),
            std::string::npos);
}

TEST_F(ClipFileTest, BuffersAreReadFromTheFilesOwnFolder) {
  Write("deeper/numbers.bin", AnimationBytes());
  ASSERT_OK(file, ReadClipFile(Write("a.gltf", GltfWithAnimations("deeper/numbers.bin"))));
  EXPECT_EQ(file->clips.size(), 2u);
  EXPECT_NE(Complaint(Write("b.gltf", GltfWithAnimations("absent.bin")))
                .find("Etude cannot read 'absent.bin', to which this file refers: No such"),
            std::string::npos);
}

TEST_F(ClipFileTest, NothingOutsideTheFolderIsRead) {
  Write("outside/numbers.bin", AnimationBytes());
  Write("inside/numbers.bin", AnimationBytes());
  std::filesystem::create_symlink(In("outside/numbers.bin"), In("inside/link.bin"));
  std::filesystem::create_symlink(In("inside/numbers.bin"), In("inside/fine.bin"));
  // The control: a link within the folder is followed.
  EXPECT_TRUE(ReadClipFile(Write("inside/fine.gltf", GltfWithAnimations("fine.bin"))));
  EXPECT_NE(
      Complaint(Write("inside/a.gltf", GltfWithAnimations("link.bin"))).find("the path is a link to another folder"),
      std::string::npos);
  for (const std::string uri : {"../outside/numbers.bin", "%2e%2e/outside/numbers.bin", "/etc/hostname",
                                "file:///etc/hostname", "http://localhost/numbers.bin"}) {
    EXPECT_FALSE(ReadClipFile(Write("inside/b.gltf", GltfWithAnimations(uri)))) << uri;
  }
}

TEST_F(ClipFileTest, BuffersCountTogetherWithTheFile) {
  Write("numbers.bin", AnimationBytes());
  std::filesystem::resize_file(In("numbers.bin"), kMaxClipFileBytes - 10);
  EXPECT_NE(Complaint(Write("a.gltf", GltfWithAnimations("numbers.bin"))).find("at most 500 MB"), std::string::npos);
}

// Debian's assimp-testmodels: the same box with its picture beside it, in a URI, and in the GLB.
TEST_F(ClipFileTest, TexturesAreTheSameWhereverTheyStand) {
  const std::string models = "/usr/share/assimp/models/glTF2/BoxTextured-glTF";
  std::vector<SharedTexture> textures;
  for (const std::string name : {"/BoxTextured.gltf", "-Embedded/BoxTextured.gltf", "-Binary/BoxTextured.glb"}) {
    if (!std::filesystem::exists(models + name)) GTEST_SKIP() << "no " << models << name;
    ASSERT_OK(file, ReadClipFile(models + name));
    ASSERT_EQ(file->figure.materials.size(), 1u);
    textures.push_back(file->figure.materials[0].texture);
    ASSERT_TRUE(textures.back()) << name;
    EXPECT_GT(textures.back()->picture.width, 100);
    EXPECT_TRUE(textures.back()->picture.pixels == textures.front()->picture.pixels) << name;
  }
}

}  // namespace

}  // namespace etude
