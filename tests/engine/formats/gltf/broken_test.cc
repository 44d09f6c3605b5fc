#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include "tests/engine/formats/gltf/small_glb.h"
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

struct BrokenText {
  const char* what;
  const char* from;
  const char* to;
  const char* complaint;
};

// clang-format off
constexpr BrokenText kBrokenTexts[] = {
    {"no version", R"("version":"2.0")", R"("generator":"x")", R"(not glTF 2.0: "asset" object not found)"},
    {"version 1", R"("version":"2.0")", R"("version":"1.0")", "asset.version: found '1.0'; allowed: 2.0"},
    {"no JSON", R"("nodes":[{)", R"("nodes":[{{)", "not glTF 2.0: syntax error while parsing object key"},
    {"meshopt", R"("scene":0)", R"("extensionsRequired":["KHR_texture_transform","EXT_meshopt_compression"])", "extensionsRequired: found 'EXT_meshopt_compression'; allowed: KHR_materials_*"},
    // scenes and nodes
    {"scene out of range", R"("scene":0)", R"("scene":1)", "scene: found 1; allowed: 0 to 0"},
    {"scene of no node", R"([{"nodes":[0,2]}])", R"([{"nodes":[0,3]}])", "scenes[0].nodes[1]: found 3; allowed: 0 to 2"},
    {"negative root", R"([{"nodes":[0,2]}])", R"([{"nodes":[-1]}])", "scenes[0].nodes[0]: found -1; allowed: 0 to 2"},
    {"a child as root", R"([{"nodes":[0,2]}])", R"([{"nodes":[1]}])", "scenes[0].nodes[0]: found node 1, a child of node 0; allowed: roots"},
    {"child out of range", R"("children":[1])", R"("children":[3])", "nodes[0].children[0]: found 3; allowed: 0 to 2"},
    {"own child", R"("children":[1])", R"("children":[0])", "nodes[0]: is its own ancestor; allowed: a tree"},
    {"cycle of two", R"({"name":"Spine",)", R"({"name":"Spine","children":[0],)", "nodes[0]: is its own ancestor"},
    {"two parents", R"("name":"Body",)", R"("children":[1],)", "nodes[2].children[0]: found node 1, a child of node 0 already; allowed: one parent"},
    {"child twice", R"("children":[1])", R"("children":[1,1])", "nodes[0].children[1]: found node 1, a child of node 0 already"},
    {"translation of two numbers", "[0,0.5,0]", "[0,0.5]", "nodes[1].translation: found 2 numbers; allowed: 3"},
    {"translation beyond sense", "[0,0.5,0]", "[0,1e10,0]", "nodes[1].translation: found 10000000000; allowed: numbers within ±1e+09"},
    {"beyond any double", "[0,0.5,0]", "[0,1e999,0]", "number overflow parsing '1e999'"},
    {"rotation of length 0", R"("translation":[0,0.5,0])", R"("rotation":[0,0,0,0])", "nodes[1].rotation: found a quaternion of length 0; allowed: unit quaternions"},
    {"matrix of 15 numbers", R"("translation":[0,0.5,0])", R"("matrix":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0])", "nodes[1].matrix: found 15 numbers; allowed: 16"},
    {"sheared matrix", R"("translation":[0,0.5,0])", R"("matrix":[1,0,0,0,0.5,1,0,0,0,0,1,0,0,0,0,1])", "nodes[1].matrix: shears; allowed: translation, rotation, scale"},
    {"flat matrix", R"("translation":[0,0.5,0])", R"("matrix":[1,0,0,0,0,0,0,0,0,0,1,0,0,0,0,1])", "nodes[1].matrix: flattens an axis"},
    {"projecting matrix", R"("translation":[0,0.5,0])", R"("matrix":[1,0,0,1,0,1,0,0,0,0,1,0,0,0,0,1])", "nodes[1].matrix: found a projection; allowed: a last row of 0, 0, 0, 1"},
    {"scales that multiply beyond sense", R"([0,1,0]},{"name":"Spine",)", R"([0,1,0],"scale":[1e6,1,1]},{"name":"Spine","scale":[1e6,1,1],)", "nodes: found joint 'Spine' beyond ±1e+09 in the world"},
    // skins and meshes
    {"skin out of range", R"("skin":0)", R"("skin":1)", "nodes[2].skin: found 1; allowed: 0 to 0"},
    {"bone out of range", R"("joints":[0,1])", R"("joints":[0,3])", "skins[0].joints[1]: found 3; allowed: 0 to 2"},
    {"skin without bones", R"("joints":[0,1])", R"("joints":[])", "skins[0].joints: found none"},
    {"too few bind matrices", R"("joints":[0,1])", R"("joints":[0,1,0])", "skins[0].inverseBindMatrices: found 2; 3 joints need as many"},
    {"bind matrices that are a text", R"("inverseBindMatrices":4)", R"("inverseBindMatrices":"4")", "skins[0].inverseBindMatrices: found \"4\"; allowed: a whole number from 0"},
    {"negative bind matrices", R"("inverseBindMatrices":4)", R"("inverseBindMatrices":-1)", "skins[0].inverseBindMatrices: found -1; allowed: a whole number from 0"},
    {"bind matrices of another kind", R"("inverseBindMatrices":4)", R"("inverseBindMatrices":2)", "skins[0].inverseBindMatrices (accessors[2]): found another type; allowed: MAT4"},
    {"mesh out of range", R"("mesh":0)", R"("mesh":1)", "nodes[2].mesh: found 1; allowed: 0 to 0"},
    {"mesh without primitives", R"("primitives")", R"("primitive")", "meshes[0].primitives: found none; at least one is needed"},
    {"accessor out of range", R"("POSITION":0)", R"("POSITION":7)", "meshes[0].primitives[0].POSITION: found 7; allowed: 0 to 6"},
    {"negative accessor", R"("POSITION":0)", R"("POSITION":-2147483648)", "meshes[0].primitives[0].POSITION: found -2147483648"},
    {"positions of another type", R"("POSITION":0)", R"("POSITION":3)", "POSITION (accessors[3]): found another type; allowed: VEC3"},
    {"indices of another type", R"("indices":3)", R"("indices":5)", "indices (accessors[5]): found component type 5126; allowed: 5121, 5123 or 5125"},
    {"joints as floats", R"("JOINTS_0":1)", R"("JOINTS_0":2)", "JOINTS (accessors[2]): found component type 5126"},
    {"weights as integers", R"("WEIGHTS_0":2)", R"("WEIGHTS_0":1)", "WEIGHTS (accessors[1]): found component type 5121"},
    {"joints without weights", R"(,"WEIGHTS_0":2)", "", "found one of JOINTS_0 and WEIGHTS_0; allowed: both or none"},
    {"a skinned mesh without joints", R"(,"JOINTS_0":1,"WEIGHTS_0":2)", "", "found no JOINTS_0; its skin needs them"},
    {"unknown mode", R"("indices":3)", R"("indices":3,"mode":7)", "meshes[0].primitives[0].mode: found 7; allowed: 0 to 6"},
    {"material out of range", R"("material":0)", R"("material":1)", "meshes[0].primitives[0].material: found 1; allowed: 0 to 0"},
    {"two corners of three", R"("componentType":5123,"count":3)", R"("componentType":5123,"count":2)", "found 2 corners; allowed: multiples of 3"},
    // animations
    {"sampler out of range", R"("sampler":0)", R"("sampler":1)", "animations[0].channels[0].sampler: found 1; allowed: 0 to 0"},
    {"target that is negative", R"("node":1)", R"("node":-1)", "animations[0].channels[0].target.node: found -1; allowed: a whole number from 0"},
    {"target that is a text", R"("node":1)", R"("node":"1")", "animations[0].channels[0].target.node: found \"1\"; allowed: a whole number from 0"},
    {"no path", R"("node":1,"path":"rotation")", R"("node":1)", "animations[0].channels[0].target.path: found no text; allowed: translation, rotation, scale, weights"},
    {"neither node nor path", R"("node":1,"path":"rotation")", "", "animations[0].channels[0].target.path: found no text"},
    {"target out of range", R"("node":1)", R"("node":99)", "animations[0].channels[0].target.node: found 99; allowed: 0 to 2"},
    {"unknown path", R"("path":"rotation")", R"("path":"colour")", "animations[0].channels[0].target.path: found 'colour'; allowed: translation, rotation, scale, weights"},
    {"rotations for a translation", R"("path":"rotation")", R"("path":"translation")", "animations[0].samplers[0].output (accessors[6]): found another type; allowed: VEC3"},
    {"unknown interpolation", R"("output":6)", R"("output":6,"interpolation":"BEZIER")", "animations[0].samplers[0].interpolation: found 'BEZIER'; allowed: LINEAR, STEP, CUBICSPLINE"},
    {"spline without tangents", R"("output":6)", R"("output":6,"interpolation":"CUBICSPLINE")", "animations[0].samplers[0].output: found 3 values; 3 times need 9"},
    {"input out of range", R"("input":5)", R"("input":-7)", "animations[0].samplers[0].input: found -7; allowed: 0 to 6"},
    {"the same channel twice", R"("channels":[)", R"("channels":[{"sampler":0,"target":{"node":1,"path":"rotation"}},)", "animations[0].channels[1]: found the rotation of node 1 again; allowed: one channel each"},
    // accessors, views, buffers
    {"huge count", R"("componentType":5126,"count":3)", R"("componentType":5126,"count":4000000000)", "POSITION (accessors[0]): found 4000000000 elements; allowed: 1 to"},
    {"count near 2^64", R"("componentType":5126,"count":3)", R"("componentType":5126,"count":18446744073709551615)", "found 18446744073709551615 elements; allowed: 1 to"},
    {"no elements", R"("componentType":5126,"count":3)", R"("componentType":5126,"count":0)", "found 0 elements; allowed: 1 to"},
    {"one element too many", R"("componentType":5126,"count":3)", R"("componentType":5126,"count":4)", "POSITION (accessors[0]): found 4 elements of 12 bytes every 12 bytes at byte 0; bufferViews[0] holds 36"},
    {"offset near 2^64", R"({"bufferView":0,)", R"({"bufferView":0,"byteOffset":18446744073709551604,)", "at byte 18446744073709551604; bufferViews[0] holds 36"},
    {"zeros without end", R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,)", R"("accessors":[{"componentType":5126,"count":100000000,)", "found 100000000 elements; allowed: 1 to"},
    {"doubles", R"("componentType":5126,"count":3,"type":"VEC3")", R"("componentType":5130,"count":3,"type":"VEC3")", "POSITION (accessors[0]): found component type 5130; allowed: 5126 (float)"},
    {"view out of range", R"({"bufferView":0)", R"({"bufferView":7)", "POSITION (accessors[0]).bufferView: found 7; allowed: 0 to 6"},
    {"stride below an element", R"({"buffer":0,"byteLength":36})", R"({"buffer":0,"byteLength":36,"byteStride":8})", "bufferViews[0].byteStride: found 8; allowed here: at least 12"},
    {"stride past the end", R"({"buffer":0,"byteLength":36})", R"({"buffer":0,"byteLength":36,"byteStride":16})", "found 3 elements of 12 bytes every 16 bytes at byte 0; bufferViews[0] holds 36"},
    {"buffer out of range", R"({"buffer":0,"byteLength":36})", R"({"buffer":-1,"byteLength":36})", "bufferViews[0].buffer: found -1; allowed: 0 to 0"},
    {"view past its buffer", R"({"buffer":0,"byteLength":36})", R"({"buffer":0,"byteLength":36,"byteOffset":280})", "bufferViews[0]: found 36 bytes at byte 280; buffer 0 holds 292"},
    {"negative offset", R"({"bufferView":0,)", R"({"bufferView":0,"byteOffset":-4,)", "byteOffset: found -4; allowed: a whole number from 0"},
    {"negative offset of a view", R"({"buffer":0,"byteLength":36})", R"({"buffer":0,"byteLength":36,"byteOffset":-4})", "bufferViews[0].byteOffset: found -4; allowed"},
    {"offset that is a text", R"({"buffer":0,"byteLength":36})", R"({"buffer":0,"byteLength":36,"byteOffset":"4"})", "bufferViews[0].byteOffset: found \"4\"; allowed"},
    {"view near 2^64", R"({"buffer":0,"byteLength":36})", R"({"buffer":0,"byteLength":18446744073709551615,"byteOffset":12})", "bufferViews[0]: found 18446744073709551615 bytes at byte 12"},
    {"offset of a view near 2^64", R"({"buffer":0,"byteLength":36})", R"({"buffer":0,"byteLength":36,"byteOffset":18446744073709551600})", "bufferViews[0]: found 36 bytes at byte 18446744073709551600"},
    {"buffer beyond the file", R"("byteLength":292)", R"("byteLength":296)", "not glTF 2.0: Invalid `byteLength'"},
    {"empty buffer", R"("byteLength":292)", R"("byteLength":0)", "not glTF 2.0: "},
    {"broken data URI", R"("byteLength":292)", R"("byteLength":292,"uri":"data:application/octet-stream;base64,AAAA")", "not glTF 2.0: Failed to decode 'uri'"},
    {"sparse past the end", R"("count":3,"type":"SCALAR"},)", R"("count":3,"type":"SCALAR","sparse":{"count":4,"indices":{"bufferView":3,"componentType":5123},"values":{"bufferView":3}}},)", "indices (accessors[3]).sparse.count: found 4; allowed: 1 to 3"},
    {"sparse of nothing", R"("count":3,"type":"SCALAR"},)", R"("count":3,"type":"SCALAR","sparse":{"count":-1,"indices":{"bufferView":3,"componentType":5123},"values":{"bufferView":3}}},)", "sparse.count: found -1"},
    {"sparse with float indices", R"("count":3,"type":"SCALAR"},)", R"("count":3,"type":"SCALAR","sparse":{"count":1,"indices":{"bufferView":3,"componentType":5126},"values":{"bufferView":3}}},)", "sparse.indices.componentType: found 5126"},
    {"sparse index out of range", R"("count":3,"type":"SCALAR"},)", R"("count":3,"type":"SCALAR","sparse":{"count":1,"indices":{"bufferView":2,"componentType":5125},"values":{"bufferView":3}}},)", "sparse.indices: found 1065353216; allowed: 0 to 2"},
    {"sparse with a negative offset", R"("count":3,"type":"SCALAR"},)", R"("count":3,"type":"SCALAR","sparse":{"count":1,"indices":{"bufferView":3,"byteOffset":-6,"componentType":5123},"values":{"bufferView":3}}},)", "sparse.indices.byteOffset: found -6; allowed: a whole number from 0"},
    {"sparse values past the view", R"("count":3,"type":"SCALAR"},)", R"("count":3,"type":"SCALAR","sparse":{"count":1,"indices":{"bufferView":3,"componentType":5123},"values":{"bufferView":3,"byteOffset":5}}},)", "sparse.values: found 1 elements of 2 bytes every 2 bytes at byte 5; bufferViews[3] holds 6"},
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
      {testing::kJoints + 4, RawBytes<std::uint8_t>({2}), "JOINTS: found 2 at vertex 1; allowed: 0 to 1"},
      {testing::kWeights + 16, Floats({-0.5f}), "WEIGHTS: found -0.5; allowed: from 0"},
      {testing::kIndices + 4, RawBytes<std::uint16_t>({3}), "indices: found vertex 3 in element 2; allowed: 0 to 2"},
      {testing::kBind + 12, Floats({1}), "skins[0].inverseBindMatrices[0]: found a projection"},
      {testing::kBind + 64, Floats({kNaN}), "skins[0].inverseBindMatrices (accessors[4]): found nan in element 1"},
      {testing::kTimes, Floats({0, 2, 1}), "animations[0].samplers[0].input: found 1 s after 2 s; allowed: times that"},
      {testing::kTimes + 4, Floats({kNaN}), "animations[0].samplers[0].input (accessors[5]): found nan"},
      {testing::kTimes, Floats({0, 1, 9e8f}), "animations[0]: with its 54000000001 frames of 2 joints all clips take"},
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
      EXPECT_THAT(
          GlbComplaint(Glb(std::string(kSmallGltf), binary)),
          HasSubstr(std::abs(off) < 0.001f ? "read without complaint" : "inverseBindMatrices[0]: found a projection"))
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
  // As they stand in JSON.
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
    EXPECT_THAT(complaint, HasSubstr("allowed: files in its own folder"));
  }
}

TEST(BrokenGltf, CannotReadAFileBesideItsFolder) {
  const std::filesystem::path beside = std::filesystem::path(::testing::TempDir()) / "etude_beside_its_folder.bin";
  std::ofstream(beside, std::ios::binary) << SmallBinary();
  for (const std::filesystem::path& uri : {beside, std::filesystem::relative(beside)}) {
    SCOPED_TRACE(uri);
    const std::string text =
        Replaced(kSmallGltf, R"("byteLength":292)", fmt::format(R"("byteLength":292,"uri":"{}")", uri.string()));
    EXPECT_THAT(GlbComplaint(text), HasSubstr("allowed: files in its own folder"));
  }
  std::filesystem::remove(beside);
}

TEST(BrokenGltf, IsRefusedWhenAFileItNamesIsMissingOrOfAnotherSize) {
  const std::string text = Replaced(kSmallGltf, R"("byteLength":292)", R"("byteLength":292,"uri":"bear.bin")");
  EXPECT_THAT(GlbComplaint(text), HasSubstr("names the file 'bear.bin'; allowed here: data within the file"));
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
  EXPECT_THAT(with(8, static_cast<std::uint32_t>(good.size()) + 1), HasSubstr("the GLB announces"));
  EXPECT_THAT(with(8, 8), HasSubstr("the GLB announces 8 bytes"));
  EXPECT_THAT(with(8, 16), HasSubstr("the GLB ends within a chunk's header"));
  EXPECT_THAT(with(12, 0xFFFFFFFC),
              HasSubstr("found a chunk of 4294967292 bytes at byte 12; allowed: a multiple of 4"));
  EXPECT_THAT(with(12, json_bytes - 1), HasSubstr("allowed: a multiple of 4"));
  EXPECT_THAT(with(16, 7), HasSubstr("found a chunk of type 0x00000007 at byte 12; allowed here: 0x4E4F534A"));
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
  EXPECT_THAT(GlbComplaint(extras(std::string(100'000, '['))), HasSubstr("JSON nested more than 64 levels deep"));
  std::string many = "[0";
  for (int i = 0; i < 1'000'000; ++i) many += ",0";
  EXPECT_THAT(GlbComplaint(extras(many + "]")), HasSubstr("JSON of more than 1000000 values"));
  EXPECT_THAT(GlbComplaint(R"({"asset)"), HasSubstr("a string of the JSON has no end"));
  EXPECT_THAT(GlbComplaint("{\"a\\"), HasSubstr("a string of the JSON has no end"));
}

TEST(BrokenGltf, IsRefusedForBuffersThatEachCopyTheBinaryPart) {
  std::string buffers = R"({"byteLength":292})";
  for (int i = 0; i < 999; ++i) buffers += R"(,{"byteLength":292})";
  const std::string text = Replaced(kSmallGltf, R"({"byteLength":292})", buffers);
  EXPECT_EQ(GlbComplaint(Glb(text, SmallBinary())), "read without complaint");
  EXPECT_THAT(GlbComplaint(Glb(text, SmallBinary() + std::string(400'000, '\0'))),
              HasSubstr("1000 buffers beside 400292 bytes of binary data; allowed: 256 MB together"));
  EXPECT_THAT(GlbComplaint(Glb(Replaced(text, R"("buffers")", R"("buff\u0065rs")"), SmallBinary())),
              HasSubstr("at the top of the JSON; allowed: names without"));
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
  EXPECT_THAT(GlbComplaint(file(crowd + "{},{}")), HasSubstr("nodes: found 1025 joints; allowed: 1024"));
}

TEST(BrokenGltf, IsRefusedForLongNamesWhichEveryClipWouldCopy) {
  const auto file = [](const char* from, std::size_t length) {
    return Glb(Replaced(kSmallGltf, from, "\"name\":\"" + std::string(length, 'x')), SmallBinary());
  };
  for (const char* name : {R"("name":"Hips)", R"("name":"Bow)", R"("name":"Coat)", R"("name":"Fur)"}) {
    EXPECT_EQ(GlbComplaint(file(name, 500)), "read without complaint");
    EXPECT_THAT(GlbComplaint(file(name, 501)), HasSubstr("[0].name: found 501 bytes; allowed: 500"));
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
  EXPECT_THAT(GlbComplaint(strip(2'000'003)), HasSubstr("with it there are 3 vertices and 2000001 triangles; allowed"));
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
  EXPECT_THAT(GlbComplaint(flat(666'667)),
              HasSubstr("with it there are 2000001 vertices and 666667 triangles; allowed: 2000000 and 2000000"));
  // The count is refused before joints and weights are read.
  constexpr std::size_t kCount = 2'000'001;
  std::string json = Replaced(kSmallGltf, R"("componentType":5126,"count":3,"type":"VEC3")",
                              fmt::format(R"("componentType":5120,"count":{},"type":"VEC3")", kCount));
  json = Replaced(json, R"("byteLength":36)",
                  fmt::format(R"("byteOffset":292,"byteLength":{},"byteStride":4)", 4 * kCount));
  json = Replaced(json, R"("byteLength":292)", fmt::format(R"("byteLength":{})", 292 + 4 * kCount));
  EXPECT_THAT(GlbComplaint(Glb(json, SmallBinary() + std::string(4 * kCount, '\0'))),
              HasSubstr("primitives[0]: found 2000001 vertices; allowed: 2000000"));
}

TEST(BrokenGltf, IsRefusedForMoreAnimationsThanAnyoneMakes) {
  const auto file = [](int count) {
    std::string animations;
    for (int i = 0; i < count; ++i) animations += i == 0 ? "{}" : ",{}";
    return Glb(R"({"asset":{"version":"2.0"},"nodes":[{}],"animations":[)" + animations + "]}");
  };
  EXPECT_EQ(GlbComplaint(file(1000)), "read without complaint");
  EXPECT_THAT(GlbComplaint(file(1001)), HasSubstr("animations: found 1001; allowed: 1000"));
}

TEST(BrokenGltf, IsRefusedForALongTailBelowACycle) {
  // A cycle: 0 → 1 → … → 199 hangs below 200 → 201 → 200.
  std::string nodes;
  for (int i = 1; i < 200; ++i) nodes += fmt::format(R"({{"children":[{}]}},)", i);
  nodes += R"({},{"children":[0,201]},{"children":[200]})";
  EXPECT_THAT(GlbComplaint(Glb(R"({"asset":{"version":"2.0"},"nodes":[)" + nodes + "]}")),
              HasSubstr("hangs below its own descendants; allowed: a tree"));
}

}  // namespace
}  // namespace etude
