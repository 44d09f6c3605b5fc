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

Result<GltfContent> ReadGltf(std::string_view bytes, const std::string& file, const FetchFile& fetch) {
  const auto model = ParseGltf(bytes, file, fetch);
  if (!model) return tl::unexpected(model.error());
  GltfFile parsed(**model, file);
  auto nodes = ReadGltfNodes(parsed);
  if (!nodes) return tl::unexpected(nodes.error());
  GltfContent content;
  content.character.name = Stem(file);
  content.character.skeleton = nodes->skeleton;
  if (auto ok = ReadGltfMeshes(parsed, *nodes, content.character); !ok) return tl::unexpected(ok.error());
  auto clips = ReadGltfClips(parsed, *nodes);
  if (!clips) return tl::unexpected(clips.error());
  content.clips = std::move(*clips);
  return content;
}

}  // namespace etude
