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

/// The joints that a node's mesh hangs on: those of its skin, else the node itself.
Result<std::vector<SkinnedMesh::Binding>> ReadGltfBindings(GltfFile& file, const GltfNodes& nodes, int node);

/// Reads the joints and weights of a mesh that has its bindings and vertices: of all sets the four greatest weights of
/// a vertex, with a sum of 1. A vertex without weight hangs on the first binding.
Result<void> ReadGltfWeights(GltfFile& file, const tinygltf::Primitive& primitive, const std::string& where,
                             SkinnedMesh& mesh);

/// An accessor of as many elements as the mesh has vertices.
Result<GltfNumbers> ReadGltfAttribute(GltfFile& file, int accessor, std::size_t width, GltfComponents allowed,
                                      const std::string& where, const SkinnedMesh& mesh);

}  // namespace etude
