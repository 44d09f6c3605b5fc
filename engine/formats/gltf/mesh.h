#pragma once

#include "engine/base/result.h"
#include "engine/formats/gltf/file.h"
#include "engine/formats/gltf/gltf.h"
#include "engine/formats/gltf/nodes.h"
#include "engine/motion/character.h"

namespace etude {

/// Reads the scene's surfaces and their colours into `character`, whose skeleton is the nodes'. One mesh per primitive
/// that has triangles (lists, strips, fans; points and lines are passed over):
/// - with a skin, one binding per joint of the skin; of several sets of joints the four greatest weights of a vertex
///   are kept and made to sum to 1; a vertex without weight hangs on the skin's first joint;
/// - without, one binding to its node;
/// - without normals, faces get their own, as the specification demands.
/// Colours are the materials' base colour factors and textures; KHR_texture_transform, vertex colours and morph targets
/// are not read.
Result<void> ReadGltfMeshes(GltfFile& file, const GltfNodes& nodes, const DecodePicture& decode, Character& character);

/// Says whether a joint's axes at rest are a mirror image, under which triangles turn over.
bool IsMirrored(const Skeleton& skeleton, int joint);

/// Changes which side of the triangles is the outside.
void TurnOver(SkinnedMesh& mesh);

}  // namespace etude
