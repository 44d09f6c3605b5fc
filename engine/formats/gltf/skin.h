#pragma once

#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/formats/gltf/file.h"
#include "engine/formats/gltf/nodes.h"
#include "engine/motion/character.h"

namespace tinygltf {
struct Primitive;
}

namespace etude {

/// Returns the joints to which a node's mesh is bound: the joints of the node's skin, or the node itself if it has no
/// skin.
Result<std::vector<SkinnedMesh::Binding>> ReadGltfBindings(GltfFile& file, const GltfNodes& nodes, int node);

/// Reads the joints and weights of a mesh whose bindings and vertices are known. It keeps the four largest weights of a
/// vertex over all sets, normalised to the sum 1. A vertex without weight is bound to the first binding.
Result<void> ReadGltfWeights(GltfFile& file, const tinygltf::Primitive& primitive, const std::string& where,
                             SkinnedMesh& mesh);

/// Reads an accessor, which must have as many elements as the mesh has vertices.
Result<GltfNumbers> ReadGltfAttribute(GltfFile& file, int accessor, std::size_t width, GltfComponents allowed,
                                      const std::string& where, const SkinnedMesh& mesh);

}  // namespace etude
