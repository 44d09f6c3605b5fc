#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "engine/formats/gltf/file.h"
#include "tests/engine/formats/gltf/small_glb.h"
#include "tests/engine/formats/spoilt.h"
#include "tests/support/kept_lines.h"
#include "tests/support/replaced.h"
#include "tests/support/results.h"

namespace etude {
namespace {

/// Makes a picture of two pixels from a file's first bytes.
Result<ColourImage> FirstBytes(std::string_view bytes, std::size_t max_pixels) {
  if (bytes.size() < 4 || max_pixels < 2) return Fail({}, "{} bytes, {} pixels", bytes.size(), max_pixels);
  const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(bytes[i]); };
  ColourImage picture(2, 1);
  picture.pixels = {{byte(0), byte(1), byte(2)}, {byte(3), byte(1), 255}};
  return picture;
}

Result<GltfContent> ReadGlb(const std::string& bytes) {
  const auto fetch = [](const std::string& uri) -> Result<std::string> {
    if (uri == "beside.png") return std::string("a picture");
    return Fail({}, "no file {}", uri);
  };
  auto read = ReadGltf(bytes, "a.glb", fetch, FirstBytes);
  if (read) testing::ExpectSane(*read);
  return read;
}

/// Writes numbers into a buffer, and describes them in JSON.
class PackedNumbers {
 public:
  template <typename T>
  void Add(int component, const char* type, std::size_t width, const std::vector<T>& values, const char* more = "") {
    while (binary_.size() % 4 != 0) binary_ += '\0';
    const char* comma = views_.empty() ? "" : ",";
    views_ += fmt::format(R"({}{{"buffer":0,"byteOffset":{},"byteLength":{}}})", comma, binary_.size(),
                          sizeof(T) * values.size());
    accessors_ += fmt::format(R"({}{{"bufferView":{},"componentType":{},"count":{},"type":"{}"{}}})", comma, count_++,
                              component, values.size() / width, type, more);
    binary_.append(reinterpret_cast<const char*>(values.data()), sizeof(T) * values.size());
  }
  const std::string& binary() const { return binary_; }
  std::string Json() const {
    return fmt::format("\"accessors\":[{}],\"bufferViews\":[{}],\"buffers\":[{{\"byteLength\":{}}}]", accessors_,
                       views_, binary_.size());
  }

 private:
  std::string views_, accessors_, binary_;
  int count_ = 0;
};

/// Returns a file with all supported features: strips and fans, two sets of joints, normalised and sparse numbers,
/// matrices, a mirrored rigid mesh, every interpolation, textures, and a VRM file's bones.
PackedNumbers RichNumbers() {
  PackedNumbers packed;
  std::vector<float> places, normals, on_texture, binds(32), turns, moves, sizes;
  for (int i = 0; i < 6; ++i) {
    const float t = static_cast<float>(i);
    places.insert(places.end(), {0.3f * t, t * t * 0.1f, std::sin(t)});
    normals.insert(normals.end(), {0.6f, i % 2 == 0 ? 0.8f : -0.8f, 0});
    on_texture.insert(on_texture.end(), {0.2f * t, 1 - 0.1f * t});
  }
  for (int k : {0, 5, 10, 15, 16, 21, 26, 31}) binds[k] = 1;
  binds[13] = -0.7f;
  for (int i = 0; i < 9; ++i) {
    moves.insert(moves.end(), {0.1f * static_cast<float>(i), 0.5f, 1 - 0.2f * static_cast<float>(i)});
  }
  for (int i = 0; i < 3; ++i) {
    turns.insert(turns.end(), {std::sin(0.4f * static_cast<float>(i)), 0, 0, -std::cos(0.4f * static_cast<float>(i))});
    sizes.insert(sizes.end(), {1, 1 + 0.3f * static_cast<float>(i), 0.9f});
  }
  packed.Add(5126, "VEC3", 3, places);
  packed.Add(5126, "VEC3", 3, normals);
  packed.Add(5126, "VEC2", 2, on_texture);
  packed.Add(5121, "VEC4", 4,
             std::vector<std::uint8_t>{0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 1, 1, 1, 1, 0, 0, 0, 0, 0, 0, 1, 0, 1, 0});
  packed.Add(5121, "VEC4", 4, std::vector<std::uint8_t>{100, 80, 0, 0, 255, 0, 0, 0, 0,  90, 90, 20,
                                                        1,   2,  3, 4, 0,   0, 0, 0, 50, 60, 70, 80},
             R"(,"normalized":true)");
  packed.Add(5123, "VEC4", 4,
             std::vector<std::uint16_t>{1, 0, 0, 0, 1, 1, 0, 0, 0, 1, 0, 1, 0, 0, 0, 1, 1, 1, 0, 0, 0, 0, 1, 1});
  packed.Add(5123, "VEC4", 4, std::vector<std::uint16_t>{65535, 9, 0, 0, 1, 2, 3, 4, 500, 400, 300, 200,
                                                         9,     9, 9, 9, 0, 0, 0, 0, 7,   6,   5,   4},
             R"(,"normalized":true)");
  packed.Add(5121, "SCALAR", 1, std::vector<std::uint8_t>{0, 1, 2, 3, 4, 5, 1});
  packed.Add(5126, "MAT4", 16, binds);
  packed.Add(5126, "SCALAR", 1, std::vector<float>{0, 0.5f, 1.25f});
  packed.Add(5126, "VEC3", 3, moves);
  packed.Add(5126, "VEC4", 4, turns);
  packed.Add(5126, "VEC3", 3, sizes);
  packed.Add(5123, "SCALAR", 1, std::vector<std::uint16_t>{1, 4});
  packed.Add(5126, "VEC3", 3, std::vector<float>{9, 8, 7, 6, 5, 4});
  packed.Add(5126, "VEC3", 3, places,
             R"(,"sparse":{"count":2,"indices":{"bufferView":13,"componentType":5123},"values":{"bufferView":14}})");
  packed.Add(5120, "VEC4", 4, std::vector<std::int8_t>{0, 0, 0, 127, 90, 0, 0, 90, 127, 0, 0, 0},
             R"(,"normalized":true)");
  packed.Add(5126, "SCALAR", 1, std::vector<float>{0.25f, 0.29f, 0.33f});
  return packed;
}

std::string RichJson(const PackedNumbers& packed) {
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,3]}],
"extensionsUsed":["VRM","VRMC_vrm"],
"extensions":{"VRM":{"humanoid":{"humanBones":[{"bone":"hips","node":0},{"bone":"spine","node":1}]}},
"VRMC_vrm":{"humanoid":{"humanBones":{"head":{"node":2},"jaw":{"node":3}}}}},
"nodes":[{"name":"Root","children":[1,2],"matrix":[0,0,-2,0,0,3,0,0,1,0,0,0,5,6,7,1]},
{"name":"Arm","rotation":[0,0.6,0,0.8],"scale":[-1,1.5,1],"mesh":1},
{"name":"Arm","translation":[1,2,3],"rotation":[0,0,3,4]},
{"mesh":0,"skin":0},{"name":"Outside"}],
"skins":[{"joints":[1,2],"inverseBindMatrices":8,"skeleton":0}],
"meshes":[{"name":"Coat","primitives":[{"attributes":{"POSITION":0,"NORMAL":1,"TEXCOORD_0":2,"JOINTS_0":3,"WEIGHTS_0":4,
"JOINTS_1":5,"WEIGHTS_1":6},"indices":7,"mode":5,"material":0},{"attributes":{"POSITION":15,"JOINTS_0":3,"WEIGHTS_0":4},
"mode":6,"material":1},{"attributes":{"POSITION":0},"mode":1}]},
{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":2},"mode":4}]}],
"materials":[{"name":"Fur","pbrMetallicRoughness":{"baseColorFactor":[0.5,0.25,0.125,1],"baseColorTexture":{"index":0}}},
{"pbrMetallicRoughness":{"baseColorTexture":{"index":1}}},{"name":"Plain"}],
"textures":[{"source":0,"sampler":0},{"source":1}],"samplers":[{"wrapS":33648,"wrapT":33071}],
"images":[{"bufferView":1,"mimeType":"image/png"},{"uri":"beside.png"}],
"animations":[{"name":"Go","samplers":[{"input":9,"output":10,"interpolation":"CUBICSPLINE"},
{"input":9,"output":11,"interpolation":"STEP"},{"input":9,"output":12},{"input":9,"output":16}],
"channels":[{"sampler":0,"target":{"node":1,"path":"translation"}},{"sampler":1,"target":{"node":0,"path":"rotation"}},
{"sampler":2,"target":{"node":1,"path":"scale"}},{"sampler":3,"target":{"node":2,"path":"rotation"}}]},
{"samplers":[{"input":17,"output":12}],"channels":[{"sampler":0,"target":{"node":4,"path":"translation"}}]}],
)" + packed.Json() +
         "}";
}

/// Returns JSON texts, each with one number, text or key changed.
std::vector<std::string> SpoiltJson(const std::string& json, std::uint64_t seed, int count) {
  constexpr std::array<std::string_view, 16> kNumbers = {"0",    "-1",   "1",   "2",    "3",  "7",    "1000",  "5121",
                                                         "5126", "5125", "2e9", "1e10", "[]", "null", "\"x\"", "0.5"};
  constexpr std::array<std::string_view, 12> kTexts = {"VEC3",        "VEC4", "SCALAR",  "MAT4", "rotation", "scale",
                                                       "CUBICSPLINE", "STEP", "weights", "x",    "../a.png", "extras"};
  std::vector<std::pair<std::size_t, std::size_t>> numbers, texts;  // begin and length
  for (std::size_t at = 0; at < json.size(); ++at) {
    if (json[at] == '"') {
      const std::size_t end = json.find('"', at + 1);
      texts.emplace_back(at + 1, end - at - 1);
      at = end;
    } else if (const std::size_t end = json.find_first_not_of("-.0123456789e", at); end > at) {
      numbers.emplace_back(at, end - at);
      at = end - 1;
    }
  }
  testing::Dice dice(seed);
  std::vector<std::string> spoilt;
  for (int i = 0; i < count; ++i) {
    const bool is_number = dice.Below(3) > 0;
    const auto [at, size] = is_number ? numbers[dice.Below(numbers.size())] : texts[dice.Below(texts.size())];
    spoilt.push_back(json);
    spoilt.back().replace(at, size,
                          is_number ? kNumbers[dice.Below(kNumbers.size())] : kTexts[dice.Below(kTexts.size())]);
  }
  return spoilt;
}

TEST(Gltf, IndexListsOfAnotherShapeAreRefusedWithAReason) {
  const std::pair<std::string, std::string> kShapes[] = {{"\"indices\":3", "\"indices\":{}"},
                                                         {"\"indices\":3", "\"indices\":[3]"},
                                                         {"\"accessors\":[", "\"accessors\":{},\"others\":["},
                                                         {"\"meshes\":[", "\"meshes\":\"x\",\"others\":["}};
  for (const auto& [from, to] : kShapes) {
    const std::string json = testing::Replaced(testing::kSmallGltf, from, to);
    EXPECT_FALSE(ReadGlb(testing::Glb(json, testing::SmallBinary()))) << to;
  }
}

TEST(Gltf, ComplaintsAboutOneThingSpoiltAreAsTheyWere) {
  const PackedNumbers rich = RichNumbers();
  const std::string small(testing::kSmallGltf), json = RichJson(rich);
  ASSERT_OK(whole, ReadGltf(testing::Glb(json, rich.binary()), "a.glb", {}, FirstBytes));
  EXPECT_EQ(whole->character.meshes.size(), 3u);
  EXPECT_EQ(whole->clips.size(), 2u);
  std::vector<std::string> numbers;
  testing::Dice dice(4);
  for (int i = 0; i < 400; ++i) {
    constexpr std::array<float, 8> kFloats = {0, -1, 1, 1e9f, 1.1e9f, 0.29f, 1e-8f, -3};
    const float number = i % 25 == 0 ? NAN : kFloats[dice.Below(kFloats.size())];
    std::string binary = rich.binary();
    binary.replace(4 * dice.Below(binary.size() / 4), 4, std::string(reinterpret_cast<const char*>(&number), 4));
    numbers.push_back(testing::Glb(json, binary));
  }
  testing::ComplaintLines complaints;
  complaints.Add("all that is read of the format", SpoiltJson(json, 1, 1500),
                 [&](const std::string& spoilt) { return ReadGlb(testing::Glb(spoilt, rich.binary())); });
  complaints.Add("a small file", SpoiltJson(small, 2, 500),
                 [](const std::string& spoilt) { return ReadGlb(testing::Glb(spoilt, testing::SmallBinary())); });
  complaints.Add("its bytes", testing::SpoiltBytes(testing::Glb(json, rich.binary()), 3, 100), ReadGlb);
  complaints.Add("its numbers", numbers, ReadGlb);
  EXPECT_TRUE(testing::AreKept(complaints.lines(), "tests/engine/formats/gltf/complaints.txt"));
}

}  // namespace
}  // namespace etude
