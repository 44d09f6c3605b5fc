#include "engine/formats/gltf/textures.h"

#include <tiny_gltf.h>

#include <array>

#include "engine/base/srgb.h"

namespace etude {
namespace {

Texture::Beyond BeyondOf(int wrap) {
  if (wrap == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT) return Texture::Beyond::kMirrors;
  if (wrap == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return Texture::Beyond::kStays;
  return Texture::Beyond::kRepeats;
}

bool IsUnderstood(std::string_view bytes) { return bytes.starts_with("\x89PNG") || bytes.starts_with("\xff\xd8\xff"); }

SharedTexture Tinted(const Texture& plain, const glm::dvec3& colour) {
  std::array<std::array<std::uint8_t, 256>, 3> of_byte;
  for (int k = 0; k < 3; ++k) {
    for (int byte = 0; byte < 256; ++byte) {
      of_byte[k][byte] = SrgbOfLinear(colour[k] * LinearOfSrgb(static_cast<std::uint8_t>(byte)));
    }
  }
  auto tinted = std::make_shared<Texture>(plain);
  for (Rgb8& pixel : tinted->picture.pixels) {
    pixel = {of_byte[0][pixel.r], of_byte[1][pixel.g], of_byte[2][pixel.b]};
  }
  return tinted;
}

}  // namespace

Result<SharedTexture> GltfTextures::Read(const tinygltf::Material& material, const glm::dvec3& colour,
                                         const std::string& where) {
  const int index = material.pbrMetallicRoughness.baseColorTexture.index;
  if (index == kNoIndex || !decode_) return SharedTexture();
  ASSIGN_OR_RETURN(auto plain, ReadPlain(index, where + ".pbrMetallicRoughness.baseColorTexture.index"));
  if (!plain || colour == glm::dvec3(1)) return plain;
  RETURN_IF_ERROR(Take(plain->picture.pixels.size(), where));
  return Tinted(*plain, colour);
}

Result<SharedTexture> GltfTextures::ReadPlain(int index, const std::string& where) {
  const tinygltf::Model& model = file_.model();
  RETURN_IF_ERROR(file_.CheckIndex(index, model.textures.size(), where));
  if (const auto known = plain_.find(index); known != plain_.end()) return known->second;
  const tinygltf::Texture& source = model.textures[static_cast<std::size_t>(index)];
  SharedTexture& kept = plain_[index];
  const std::string name = fmt::format("textures[{}]", index);
  if (source.source == kNoIndex) return kept;  // in a format of some extension
  RETURN_IF_ERROR(file_.CheckIndex(source.source, model.images.size(), name + ".source"));
  const std::string image_name = fmt::format("images[{}]", source.source);
  ASSIGN_OR_RETURN(const auto bytes, BytesOf(model.images[static_cast<std::size_t>(source.source)], image_name));
  if (!IsUnderstood(bytes)) return kept;

  auto picture = decode_(bytes, pixels_left_);
  if (!picture) return file_.Refuse(image_name, "{}", picture.error().message);
  RETURN_IF_ERROR(Take(picture->pixels.size(), image_name));
  auto texture = std::make_shared<Texture>(Texture{.picture = std::move(*picture)});
  if (source.sampler != kNoIndex) {
    RETURN_IF_ERROR(file_.CheckIndex(source.sampler, model.samplers.size(), name + ".sampler"));
    const tinygltf::Sampler& sampler = model.samplers[static_cast<std::size_t>(source.sampler)];
    texture->beyond_u = BeyondOf(sampler.wrapS);
    texture->beyond_v = BeyondOf(sampler.wrapT);
  }
  kept = std::move(texture);
  return kept;
}

Result<std::string_view> GltfTextures::BytesOf(const tinygltf::Image& image, const std::string& where) const {
  if (image.bufferView != kNoIndex) return file_.ReadView(image.bufferView, where + ".bufferView");
  return std::string_view(reinterpret_cast<const char*>(image.image.data()), image.image.size());
}

Result<void> GltfTextures::Take(std::size_t pixels, const std::string& where) {
  if (pixels > pixels_left_) {
    return file_.Refuse(where, "found {} pixels; allowed in all textures: 64 million, of which {} are left", pixels,
                        pixels_left_);
  }
  pixels_left_ -= pixels;
  return {};
}

}  // namespace etude
