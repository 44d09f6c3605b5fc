#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/base/image.h"
#include "tests/engine/formats/gltf/small_glb.h"
#include "tests/support/replaced.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using testing::Floats;
using testing::Glb;
using ::testing::HasSubstr;
using testing::kSmallGltf;
using testing::Replaced;
using testing::SmallBinary;

constexpr std::string_view kPng = "\x89PNG of two pixels", kOther = "RIFF of another kind";

/// Decodes kPng to two pixels if `max_pixels` allows it.
Result<ColourImage> TwoPixels(std::string_view bytes, std::size_t max_pixels) {
  if (max_pixels < 2) return Fail({}, "too many pixels");
  if (bytes != kPng) return Fail({}, "a damaged PNG picture: {} bytes", bytes.size());
  ColourImage picture(2, 1);
  picture.pixels = {{200, 100, 50}, {255, 255, 255}};
  return picture;
}

/// Returns the small figure with texture coordinates; `more` is further JSON, such as materials.
std::string Textured(const std::string& more, std::string_view picture, const std::string& factor = "[1,1,1,1]",
                     const std::string& info = R"({"index":0})") {
  std::string binary = SmallBinary() + Floats({0, 0, 1, 0, 0.5f, 2});
  const std::size_t at = binary.size();
  binary += picture;
  std::string json(kSmallGltf);
  json = Replaced(json, R"("baseColorFactor":[0.5,0.25,0.125,1])",
                  R"("baseColorFactor":)" + factor + R"(,"baseColorTexture":)" + info);
  json = Replaced(json, R"("WEIGHTS_0":2)", R"("WEIGHTS_0":2,"TEXCOORD_0":7)");
  json = Replaced(json, R"("accessors":[)",
                  R"("textures":[{"source":0,"sampler":0}],"samplers":[{"wrapS":33648,"wrapT":33071}],)" + more +
                      R"("accessors":[)");
  json = Replaced(json, R"({"bufferView":6,"componentType":5126,"count":3,"type":"VEC4"}])",
                  R"({"bufferView":6,"componentType":5126,"count":3,"type":"VEC4"},
                     {"bufferView":7,"componentType":5126,"count":3,"type":"VEC2"}])");
  json = Replaced(json, R"({"buffer":0,"byteOffset":244,"byteLength":48}])",
                  R"({"buffer":0,"byteOffset":244,"byteLength":48},{"buffer":0,"byteOffset":292,"byteLength":24},
                     {"buffer":0,"byteOffset":)" +
                      std::to_string(at) + R"(,"byteLength":)" + std::to_string(picture.size()) + "}]");
  json = Replaced(json, R"("buffers":[{"byteLength":292}])",
                  R"("buffers":[{"byteLength":)" + std::to_string(binary.size()) + "}]");
  return Glb(json, binary);
}

constexpr const char* kWithin = R"("images":[{"bufferView":8,"mimeType":"image/png"}],)";

Material OnlyMaterial(const std::string& bytes, const FetchFile& fetch = {}) {
  const auto content = ReadGltf(bytes, "test.glb", fetch, TwoPixels);
  EXPECT_TRUE(content) << ToString(content.error());
  return content && content->character.materials.size() == 1 ? content->character.materials[0] : Material();
}

std::string ComplaintOf(const std::string& bytes) {
  const auto content = ReadGltf(bytes, "test.glb", {}, TwoPixels);
  return content ? "read without complaint" : ToString(content.error());
}

TEST(GltfTextures, AreReadFromWithinTheFileWithTheirPlaces) {
  ASSERT_OK(content, ReadGltf(Textured(kWithin, kPng), "test.glb", {}, TwoPixels));
  const SharedTexture texture = content->character.materials[0].texture;
  ASSERT_TRUE(texture);
  EXPECT_EQ(texture->picture.width, 2);
  EXPECT_EQ(texture->picture.At(0, 0), (Rgb8{200, 100, 50}));
  EXPECT_EQ(texture->beyond_u, Texture::Beyond::kMirrors);
  EXPECT_EQ(texture->beyond_v, Texture::Beyond::kStays);
  const auto& vertices = content->character.meshes[0].vertices;
  EXPECT_EQ(vertices[1].on_texture, glm::dvec2(1, 0));
  EXPECT_EQ(vertices[2].on_texture, glm::dvec2(0.5, 2));
}

TEST(GltfTextures, AreMultipliedByTheColourInLinearLight) {
  const Material material = OnlyMaterial(Textured(kWithin, kPng, "[0.5,0.25,1,1]"));
  ASSERT_TRUE(material.texture);
  const Rgb8 expected{SrgbOfLinear(0.5 * LinearOfSrgb(200)), SrgbOfLinear(0.25 * LinearOfSrgb(100)), 50};
  EXPECT_EQ(material.texture->picture.At(0, 0), expected);
  EXPECT_EQ(material.colour, glm::dvec3(0.5, 0.25, 1));
}

TEST(GltfTextures, AreReadFromFilesBesideAndFromUris) {
  const auto fetch = [](const std::string& uri) -> Result<std::string> {
    if (uri != "coat.png") return Fail({}, "no such file");
    return std::string(kPng);
  };
  EXPECT_TRUE(OnlyMaterial(Textured(R"("images":[{"uri":"coat.png"}],)", "unused"), fetch).texture);
  // A missing texture leaves the plain colour, because motion alone may be wanted.
  EXPECT_FALSE(OnlyMaterial(Textured(R"("images":[{"uri":"gone.png"}],)", "unused"), fetch).texture);
  EXPECT_FALSE(OnlyMaterial(Textured(R"("images":[{"uri":"../coat.png"}],)", "unused"), fetch).texture);
  EXPECT_TRUE(
      OnlyMaterial(Textured(R"("images":[{"uri":"data:image/png;base64,iVBORyBvZiB0d28gcGl4ZWxz"}],)", "unused"))
          .texture);
}

TEST(GltfTextures, OfOtherFormatsAndUnwantedOnesLeaveThePlainColour) {
  EXPECT_FALSE(OnlyMaterial(Textured(kWithin, kOther)).texture);
  ASSERT_OK(unwanted, ReadGltf(Textured(kWithin, kPng), "test.glb", {}));
  EXPECT_FALSE(unwanted->character.materials[0].texture);
}

TEST(GltfTextures, AreRefusedWithTheirPlaceWhereTheyAreBroken) {
  EXPECT_THAT(ComplaintOf(Textured(kWithin, "\x89PNG, but shorter")), HasSubstr("images[0]: a damaged PNG picture"));
  EXPECT_THAT(ComplaintOf(Textured(kWithin, kPng, "[1,1,1,1]", R"({"index":7})")),
              HasSubstr("materials[0].pbrMetallicRoughness.baseColorTexture.index: found 7"));
  EXPECT_THAT(ComplaintOf(Replaced(Textured(kWithin, kPng), R"("source":0)", R"("source":3)")),
              HasSubstr("textures[0].source: found 3"));
  EXPECT_THAT(ComplaintOf(Replaced(Textured(kWithin, kPng), R"("sampler":0})", R"("sampler":5})")),
              HasSubstr("textures[0].sampler: found 5"));
  EXPECT_THAT(
      ComplaintOf(Replaced(Textured(kWithin, kPng), R"("count":3,"type":"VEC2")", R"("count":2,"type":"VEC2")")),
      HasSubstr("TEXCOORD_0: found 2 elements; POSITION has 3"));
}

TEST(GltfTextures, ACapOnAllPixelsIsHandedToWhoDecodes) {
  std::size_t told = 0;
  const auto decode = [&](std::string_view, std::size_t most) -> Result<ColourImage> {
    told = most;
    return ColourImage(9'000, 8'000);  // a decoder that ignores the limit
  };
  const auto content = ReadGltf(Textured(kWithin, kPng), "test.glb", {}, decode);
  EXPECT_EQ(told, 64'000'000u);
  EXPECT_THAT(testing::Refusal(content),
              ::testing::AllOf(HasSubstr("found 72000000 pixels"), HasSubstr("64 million pixels")));
}

}  // namespace
}  // namespace etude
