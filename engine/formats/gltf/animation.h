#pragma once

#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/formats/gltf/file.h"
#include "engine/formats/gltf/nodes.h"
#include "engine/motion/clip.h"

namespace etude {

/// Reads one clip per animation that rotates, moves or scales a node, as gltf.h describes. Animations that only move
/// morph targets are left out. `remarks` gets a text about every name that several animations have, and about every
/// animation whose first key is later than 0.1 s.
Result<std::vector<Clip>> ReadGltfClips(GltfFile& file, const GltfNodes& nodes, std::vector<std::string>& remarks);

}  // namespace etude
