#pragma once

#include <cstddef>
#include <map>
#include <string>

#include "engine/base/texture.h"
#include "engine/formats/gltf/file.h"
#include "engine/formats/gltf/gltf.h"

namespace tinygltf {
struct Image;
struct Material;
}  // namespace tinygltf

namespace etude {

/// The base colour textures of a file's materials; each picture is decoded once.
class GltfTextures {
 public:
  /// Both must outlive it.
  GltfTextures(const GltfFile& file, const DecodePicture& decode) : file_(file), decode_(decode) {}

  /// The material's texture times its colour (linear RGB); null where it has none, or none in PNG or JPEG. Refused:
  /// indices that name nothing, damaged pictures, more than 64 million pixels in one file.
  Result<SharedTexture> Read(const tinygltf::Material& material, const glm::dvec3& colour, const std::string& where);

 private:
  Result<SharedTexture> ReadPlain(int texture, const std::string& where);
  Result<std::string_view> BytesOf(const tinygltf::Image& image, const std::string& where) const;
  Result<void> Take(std::size_t pixels, const std::string& where);

  const GltfFile& file_;
  const DecodePicture& decode_;
  std::map<int, SharedTexture> plain_;  ///< by index; as the file has them
  std::size_t pixels_left_ = 64'000'000;
};

}  // namespace etude
