#include <tiny_gltf.h>

#include "engine/formats/gltf/animation.h"
#include "engine/formats/gltf/file.h"
#include "engine/formats/gltf/gltf.h"
#include "engine/formats/gltf/mesh.h"
#include "engine/formats/gltf/nodes.h"
#include "engine/formats/gltf/parse.h"

namespace etude {
namespace {

/// "dances/robot.glb" → "robot"
std::string Stem(const std::string& file) {
  const std::string name = file.substr(file.find_last_of('/') + 1);
  return name.substr(0, name.find_last_of('.'));
}

}  // namespace

Result<GltfContent> ReadGltf(std::string_view bytes, const std::string& file, const FetchFile& fetch,
                             const DecodePicture& decode) {
  ASSIGN_OR_RETURN(const auto model, ParseGltf(bytes, file, fetch, decode != nullptr));
  GltfFile parsed(*model, file);
  ASSIGN_OR_RETURN(auto nodes, ReadGltfNodes(parsed));
  GltfContent content;
  content.character.name = Stem(file);
  content.character.skeleton = nodes.skeleton;
  RETURN_IF_ERROR(ReadGltfMeshes(parsed, nodes, decode, content.character));
  ASSIGN_OR_RETURN(auto clips, ReadGltfClips(parsed, nodes));
  content.clips = std::move(clips);
  return content;
}

}  // namespace etude
