#pragma once

#include "engine/base/result.h"
#include "engine/formats/gltf/file.h"
#include "engine/formats/gltf/gltf.h"
#include "engine/formats/gltf/nodes.h"
#include "engine/motion/character.h"

namespace etude {

/// Reads the scene's surfaces and their colours, as gltf.h describes, into `character`, which must have the skeleton of
/// the nodes. Each primitive with triangles becomes one mesh.
/// - A mesh with a skin has one binding per joint of the skin. The four largest weights of a vertex over all sets of
///   joints are kept and normalised to the sum 1; a vertex without weight is bound to the skin's first joint.
/// - A mesh without a skin has one binding to its node.
/// KHR_texture_transform, vertex colours and morph targets are not read.
Result<void> ReadGltfMeshes(GltfFile& file, const GltfNodes& nodes, const DecodePicture& decode, Character& character);

/// Returns true if a joint's axes at rest are a mirror image, which reverses the orientation of triangles.
bool IsMirrored(const Skeleton& skeleton, int joint);

/// Reverses the orientation of all triangles, so that inside and outside are exchanged.
void FlipTriangles(SkinnedMesh& mesh);

}  // namespace etude
