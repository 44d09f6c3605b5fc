#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include "tests/engine/formats/gltf/small_glb.h"
#include "tests/support/kept_answers.h"
#include "tests/support/replaced.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using testing::Floats;
using testing::Glb;
using testing::GlbComplaint;
using ::testing::HasSubstr;
using testing::kSmallGltf;
using testing::RawBytes;
using testing::Replaced;
using testing::SmallBinary;
using ::testing::StartsWith;

/// A change of kSmallGltf that tinygltf or the JSON parser refuses, and the error message in their words. The error
/// messages in Etude's own words are in broken.txt.
struct BrokenText {
  const char* what;
  const char* from;
  const char* to;
  const char* complaint;
};

// clang-format off
constexpr BrokenText kBrokenTexts[] = {
    {"no version", R"("version":"2.0")", R"("generator":"x")", R"(not glTF 2.0: "asset" object not found)"},
    {"no JSON", R"("nodes":[{)", R"("nodes":[{{)", "not glTF 2.0: syntax error while parsing object key"},
    {"beyond any double", "[0,0.5,0]", "[0,1e999,0]", "number overflow parsing '1e999'"},
    {"buffer beyond the file", R"("byteLength":292)", R"("byteLength":296)", "not glTF 2.0: Invalid `byteLength'"},
    {"empty buffer", R"("byteLength":292)", R"("byteLength":0)", "not glTF 2.0: "},
    {"broken data URI", R"("byteLength":292)", R"("byteLength":292,"uri":"data:application/octet-stream;base64,AAAA")", "not glTF 2.0: Failed to decode 'uri'"},
};
// clang-format on

TEST(BrokenGltf, IsRefusedNamingThePlaceAndWhatIsAllowed) {
  ASSERT_EQ(GlbComplaint(testing::SmallGlb()), "read without complaint");  // the control: unbroken, it reads
  for (const BrokenText& broken : kBrokenTexts) {
    SCOPED_TRACE(broken.what);
    const std::string complaint = GlbComplaint(Glb(Replaced(kSmallGltf, broken.from, broken.to), SmallBinary()));
    EXPECT_THAT(complaint, StartsWith("test.glb"));
    EXPECT_THAT(complaint, HasSubstr(broken.complaint));
  }
  const auto complaint = [](const std::string& edit) {
    return GlbComplaint(Glb(testing::Edited(std::string(kSmallGltf), edit), SmallBinary()));
  };
  EXPECT_TRUE(testing::AnswersAreKept("tests/engine/formats/gltf/broken.txt", complaint));
}

TEST(BrokenGltf, ThatIsNoJsonIsRefusedWithItsLineAndColumnAndTheParsersWords) {
  EXPECT_THAT(GlbComplaint("{\"asset\":\n  {\"version\": x}}"),
              StartsWith("test.glb:2:15: not glTF 2.0: syntax error while parsing value"));
}

TEST(BrokenGltf, IsRefusedForItsNumbers) {
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const struct {
    std::size_t part;
    std::string bytes;
    const char* complaint;
  } broken[] = {
      {testing::kPositions + 4, Floats({kNaN}), "POSITION (accessors[0]): found nan in element 0; allowed: numbers"},
      {testing::kPositions + 12, Floats({-kInfinity}), "POSITION (accessors[0]): found -inf in element 1"},
      {testing::kPositions + 24, Floats({3e38f}), "POSITION (accessors[0]): found 3"},
      {testing::kJoints + 4, RawBytes<std::uint8_t>({2}), "JOINTS: found joint 2 at vertex 1; allowed: 0 to 1"},
      {testing::kWeights + 16, Floats({-0.5f}), "WEIGHTS: found -0.5; allowed: 0 or more"},
      {testing::kIndices + 4, RawBytes<std::uint16_t>({3}), "indices: found vertex 3 in element 2; allowed: 0 to 2"},
      {testing::kBind + 12, Floats({1}), "skins[0].inverseBindMatrices[0]: the matrix contains a projection"},
      {testing::kBind + 64, Floats({kNaN}), "skins[0].inverseBindMatrices (accessors[4]): found nan in element 1"},
      {testing::kTimes, Floats({0, 2, 1}),
       "animations[0].samplers[0].input: found the time 1 s after the time 2 s; allowed: times that"},
      {testing::kTimes + 4, Floats({kNaN}), "animations[0].samplers[0].input (accessors[5]): found nan"},
      {testing::kTimes, Floats({0, 1, 9e8f}),
       "animations[0]: this animation has 54000000001 frames of 2 joints, which brings all animations to"},
      {testing::kTurns + 16, Floats({0, 0, 0, 0}), "samplers[0].output: found a rotation of length 0 at 1 s"},
      {testing::kTurns + 16, Floats({kInfinity}), "samplers[0].output (accessors[6]): found inf in element 1"},
  };
  for (const auto& [part, bytes, complaint] : broken) {
    std::string binary = SmallBinary();
    binary.replace(part, bytes.size(), bytes);
    EXPECT_THAT(GlbComplaint(Glb(std::string(kSmallGltf), binary)), HasSubstr(complaint));
  }
}

TEST(BrokenGltf, MayHaveBindMatricesThatAreAffineButForAThousandth) {
  for (const std::size_t entry : {3u, 7u, 11u, 15u}) {
    for (const float off : {0.0009f, -0.0009f, 0.0011f, -0.0011f}) {
      std::string binary = SmallBinary();
      binary.replace(testing::kBind + 4 * entry, 4, Floats({(entry == 15 ? 1 : 0) + off}));
      EXPECT_THAT(GlbComplaint(Glb(std::string(kSmallGltf), binary)),
                  HasSubstr(std::abs(off) < 0.001f ? "read without complaint"
                                                   : "inverseBindMatrices[0]: the matrix contains a projection"))
          << entry;
    }
  }
}

TEST(BrokenGltf, MayLackWhatTheFormatLeavesOpen) {
  // Bones without bind matrices, and a channel without a node; tinygltf versions treat these differently.
  const std::string no_binds = Replaced(kSmallGltf, R"(,"inverseBindMatrices":4)", "");
  EXPECT_EQ(GlbComplaint(Glb(no_binds, SmallBinary())), "read without complaint");
  const std::string twice =
      Replaced(no_binds, R"("skins":[{"joints":[0,1]}])", R"("skins":[{"joints":[0,1]},{"joints":[0]}])");
  EXPECT_EQ(GlbComplaint(Glb(twice, SmallBinary())), "read without complaint");
  ASSERT_OK(undriven, ReadGltf(Glb(Replaced(kSmallGltf, R"("node":1,)", ""), SmallBinary()), "test.glb", {}));
  EXPECT_TRUE(undriven->clips.empty());  // nothing else moves
}

TEST(BrokenGltf, IsRefusedForUrisThatLeaveItsFolder) {
  // The URIs are written as in JSON, with its escapes.
  for (const char* uri :
       {"../bear.bin", "/etc/passwd", "file:///etc/passwd", "http://example.org/bear.bin", "C:bear.bin",
        "%2e%2e/bear.bin", "%2E%2E%2Fbear.bin", "parts/../../bear.bin", "parts/%2e%2e/x", "..", "~/bear.bin",
        R"(\\host\\bear.bin)", R"(a\\..\\b)", R"($(reboot)\n)", R"(a\u0000.bin)", "a%00.bin", "data:text/html,x"}) {
    SCOPED_TRACE(uri);
    const std::string text =
        Replaced(kSmallGltf, R"("byteLength":292)", fmt::format(R"("byteLength":292,"uri":"{}")", uri));
    const std::string complaint = GlbComplaint(text, [](const std::string& asked) -> Result<std::string> {
      ADD_FAILURE() << "asked for " << asked;
      return SmallBinary();
    });
    EXPECT_THAT(complaint, HasSubstr("allowed: files in the same folder"));
  }
}

TEST(BrokenGltf, CannotReadAFileBesideItsFolder) {
  const std::filesystem::path beside = std::filesystem::path(::testing::TempDir()) / "etude_beside_its_folder.bin";
  std::ofstream(beside, std::ios::binary) << SmallBinary();
  for (const std::filesystem::path& uri : {beside, std::filesystem::relative(beside)}) {
    SCOPED_TRACE(uri);
    const std::string text =
        Replaced(kSmallGltf, R"("byteLength":292)", fmt::format(R"("byteLength":292,"uri":"{}")", uri.string()));
    EXPECT_THAT(GlbComplaint(text), HasSubstr("allowed: files in the same folder"));
  }
  std::filesystem::remove(beside);
}

TEST(BrokenGltf, IsRefusedWhenAFileItNamesIsMissingOrOfAnotherSize) {
  const std::string text = Replaced(kSmallGltf, R"("byteLength":292)", R"("byteLength":292,"uri":"bear.bin")");
  EXPECT_THAT(GlbComplaint(text), HasSubstr("the file refers to 'bear.bin'; allowed: data inside the file itself"));
  EXPECT_EQ(
      GlbComplaint(text, [](const std::string&) -> Result<std::string> { return Fail({"bear.bin"}, "no such file"); }),
      "bear.bin: no such file");
  EXPECT_THAT(GlbComplaint(text, [](const std::string&) -> Result<std::string> { return SmallBinary() + "more"; }),
              HasSubstr("File size mismatch : bear.bin, requestedBytes 292, but got 296"));
}

TEST(BrokenGltf, IsRefusedForSizesThatDisagree) {
  const std::string good = testing::SmallGlb();
  const std::uint32_t json_bytes = static_cast<std::uint32_t>((kSmallGltf.size() + 3) / 4 * 4);
  const auto with = [&](std::size_t at, std::uint32_t number) {
    std::string glb = good;
    const std::string bytes = RawBytes({number});
    glb.replace(at, 4, bytes);
    return GlbComplaint(glb);
  };
  EXPECT_THAT(with(4, 1), HasSubstr("found GLB version 1; allowed: 2"));
  EXPECT_THAT(with(8, static_cast<std::uint32_t>(good.size()) + 1), HasSubstr("the GLB header states"));
  EXPECT_THAT(with(8, 8), HasSubstr("the GLB header states 8 bytes"));
  EXPECT_THAT(with(8, 16), HasSubstr("the GLB ends within a chunk's header"));
  EXPECT_THAT(with(12, 0xFFFFFFFC),
              HasSubstr("found a chunk of 4294967292 bytes at byte 12; allowed: a multiple of 4"));
  EXPECT_THAT(with(12, json_bytes - 1), HasSubstr("allowed: a multiple of 4"));
  EXPECT_THAT(with(16, 7), HasSubstr("found a chunk of type 0x00000007 at byte 12; allowed: type 0x4E4F534A"));
  // The binary chunk is one word longer than the file; then it has another type.
  EXPECT_THAT(with(20 + json_bytes, 296), HasSubstr("found a chunk of 296 bytes"));
  EXPECT_THAT(with(24 + json_bytes, 7), HasSubstr("found a chunk of type 0x00000007"));
}

TEST(BrokenGltf, IsRefusedWhenItEndsAnywhereEarly) {
  const std::string good = testing::SmallGlb();
  for (std::size_t length = 0; length < good.size(); ++length) {
    ASSERT_FALSE(ReadGltf(good.substr(0, length), "cut.glb", {})) << length;
  }
}

TEST(BrokenGltf, IsRefusedForJsonThatWouldTakeTooMuchMemory) {
  const auto extras = [](const std::string& json) { return Replaced(kSmallGltf, "{", R"({"extras":)" + json + ","); };
  EXPECT_EQ(GlbComplaint(Glb(extras(std::string(60, '[') + std::string(60, ']')), SmallBinary())),
            "read without complaint");
  EXPECT_THAT(GlbComplaint(extras(std::string(100'000, '['))), HasSubstr("the JSON is nested more than 64 levels "
                                                                         "deep"));
  std::string many = "[0";
  for (int i = 0; i < 1'000'000; ++i) many += ",0";
  EXPECT_THAT(GlbComplaint(extras(many + "]")), HasSubstr("the JSON contains more than 1000000 values"));
  EXPECT_THAT(GlbComplaint(R"({"asset)"), HasSubstr("a string of the JSON has no closing quotation mark"));
  EXPECT_THAT(GlbComplaint("{\"a\\"), HasSubstr("a string of the JSON has no closing quotation mark"));
}

TEST(BrokenGltf, IsRefusedForBuffersThatEachCopyTheBinaryPart) {
  std::string buffers = R"({"byteLength":292})";
  for (int i = 0; i < 999; ++i) buffers += R"(,{"byteLength":292})";
  const std::string text = Replaced(kSmallGltf, R"({"byteLength":292})", buffers);
  EXPECT_EQ(GlbComplaint(Glb(text, SmallBinary())), "read without complaint");
  EXPECT_THAT(
      GlbComplaint(Glb(text, SmallBinary() + std::string(400'000, '\0'))),
      HasSubstr("found 1000 buffers, each with a copy of 400292 bytes of binary data; allowed: at most 256 MB for all "
                "copies together"));
  EXPECT_THAT(GlbComplaint(Glb(Replaced(text, R"("buffers")", R"("buff\u0065rs")"), SmallBinary())),
              HasSubstr("; allowed: keys without"));
}

TEST(BrokenGltf, IsRefusedForMoreOrDeeperJointsThanAnyBodyHas) {
  const auto file = [](const std::string& nodes) {
    return Glb(R"({"asset":{"version":"2.0"},"nodes":[)" + nodes + "]}");
  };
  std::string chain, crowd;
  for (int i = 1; i < 128; ++i) chain += fmt::format(R"({{"children":[{}]}},)", i);
  for (int i = 1; i < 1024; ++i) crowd += "{},";
  EXPECT_EQ(GlbComplaint(file(chain + "{}")), "read without complaint");
  EXPECT_THAT(GlbComplaint(file(chain + R"({"children":[128]},{})")),
              HasSubstr("nodes[128]: nested more than 128 levels deep"));
  EXPECT_EQ(GlbComplaint(file(crowd + "{}")), "read without complaint");
  EXPECT_THAT(GlbComplaint(file(crowd + "{},{}")), HasSubstr("nodes: found 1025 joints; allowed: at most 1024"));
}

TEST(BrokenGltf, IsRefusedForLongNamesWhichEveryClipWouldCopy) {
  const auto file = [](const char* from, std::size_t length) {
    return Glb(Replaced(kSmallGltf, from, "\"name\":\"" + std::string(length, 'x')), SmallBinary());
  };
  for (const char* name : {R"("name":"Hips)", R"("name":"Bow)", R"("name":"Coat)", R"("name":"Fur)"}) {
    EXPECT_EQ(GlbComplaint(file(name, 500)), "read without complaint");
    EXPECT_THAT(GlbComplaint(file(name, 501)), HasSubstr("[0].name: found 501 bytes; allowed: at most 500"));
  }
}

TEST(BrokenGltf, GetsNamesThatCommandNoTerminal) {
  std::string json = Replaced(kSmallGltf, "Bow", R"(B\no\u001b[31m\u009bw é)");
  json = Replaced(json, "Spine", R"(Spine\u0000)");
  ASSERT_OK(content, ReadGltf(Glb(Replaced(json, "Fur", R"(\u007f)"), SmallBinary()), "test.glb", {}));
  EXPECT_EQ(content->clips.front().name, "B?o?[31m??w é");
  EXPECT_EQ(content->character.skeleton.joints[1].name, "Spine?");
  EXPECT_EQ(content->character.materials.front().name, "?");
}

TEST(BrokenGltf, IsRefusedForMoreTrianglesThanAnyFigureHas) {
  const auto strip = [](std::size_t corners) {
    const std::string indices = fmt::format(R"("componentType":5121,"count":{},"type":"SCALAR")", corners);
    std::string json = Replaced(kSmallGltf, R"("indices":3)", R"("indices":3,"mode":5)");
    json = Replaced(json, R"("attributes":{)", R"("attributes":{"NORMAL":0,)");
    json = Replaced(json, R"("componentType":5123,"count":3,"type":"SCALAR")", indices);
    json = Replaced(json, R"("byteOffset":96,"byteLength":6)",
                    fmt::format(R"("byteOffset":292,"byteLength":{})", corners));
    json = Replaced(json, R"("byteLength":292)", fmt::format(R"("byteLength":{})", 292 + corners));
    return Glb(json, SmallBinary() + std::string(corners, '\0'));
  };
  EXPECT_EQ(GlbComplaint(strip(2'000'002)), "read without complaint");
  EXPECT_THAT(GlbComplaint(strip(2'000'003)),
              HasSubstr("the file has 3 vertices and 2000001 triangles up to this primitive; allowed"));
}

TEST(BrokenGltf, IsRefusedForMoreVerticesThanAnyFigureHas) {
  // Without normals, each triangle gets three vertices of its own.
  const auto flat = [](std::size_t triangles) {
    const std::size_t corners = triangles + 2;
    std::string json = Replaced(kSmallGltf, R"("indices":3)", R"("indices":3,"mode":5)");
    json = Replaced(json, R"("componentType":5123,"count":3,"type":"SCALAR")",
                    fmt::format(R"("componentType":5121,"count":{},"type":"SCALAR")", corners));
    json = Replaced(json, R"("byteOffset":96,"byteLength":6)",
                    fmt::format(R"("byteOffset":292,"byteLength":{})", corners));
    json = Replaced(json, R"("byteLength":292)", fmt::format(R"("byteLength":{})", 292 + corners));
    return Glb(json, SmallBinary() + std::string(corners, '\0'));
  };
  EXPECT_EQ(GlbComplaint(flat(666'666)), "read without complaint");
  EXPECT_THAT(
      GlbComplaint(flat(666'667)),
      HasSubstr(
          "the file has 2000001 vertices and 666667 triangles up to this primitive; allowed: at most 2000000 vertices "
          "and 2000000 triangles"));
  // The count is refused before joints and weights are read.
  constexpr std::size_t kCount = 2'000'001;
  std::string json = Replaced(kSmallGltf, R"("componentType":5126,"count":3,"type":"VEC3")",
                              fmt::format(R"("componentType":5120,"count":{},"type":"VEC3")", kCount));
  json = Replaced(json, R"("byteLength":36)",
                  fmt::format(R"("byteOffset":292,"byteLength":{},"byteStride":4)", 4 * kCount));
  json = Replaced(json, R"("byteLength":292)", fmt::format(R"("byteLength":{})", 292 + 4 * kCount));
  EXPECT_THAT(GlbComplaint(Glb(json, SmallBinary() + std::string(4 * kCount, '\0'))),
              HasSubstr("primitives[0]: found 2000001 vertices; allowed: at most 2000000"));
}

TEST(BrokenGltf, IsRefusedForMoreAnimationsThanAnyoneMakes) {
  const auto file = [](int count) {
    std::string animations;
    for (int i = 0; i < count; ++i) animations += i == 0 ? "{}" : ",{}";
    return Glb(R"({"asset":{"version":"2.0"},"nodes":[{}],"animations":[)" + animations + "]}");
  };
  EXPECT_EQ(GlbComplaint(file(1000)), "read without complaint");
  EXPECT_THAT(GlbComplaint(file(1001)), HasSubstr("animations: found 1001; allowed: at most 1000"));
}

TEST(BrokenGltf, IsRefusedForALongTailBelowACycle) {
  // The chain 0 → 1 → … → 199 hangs below the cycle 200 → 201 → 200.
  std::string nodes;
  for (int i = 1; i < 200; ++i) nodes += fmt::format(R"({{"children":[{}]}},)", i);
  nodes += R"({},{"children":[0,201]},{"children":[200]})";
  EXPECT_THAT(GlbComplaint(Glb(R"({"asset":{"version":"2.0"},"nodes":[)" + nodes + "]}")),
              HasSubstr("an ancestor of the node is its own ancestor; allowed: a tree of nodes"));
}

}  // namespace
}  // namespace etude
