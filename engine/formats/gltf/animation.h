#pragma once

#include <vector>

#include "engine/base/result.h"
#include "engine/formats/gltf/file.h"
#include "engine/formats/gltf/nodes.h"
#include "engine/motion/clip.h"

namespace etude {

/// One clip per animation that turns, moves or scales a node, as gltf.h says. Animations of morph targets alone are
/// left out.
Result<std::vector<Clip>> ReadGltfClips(GltfFile& file, const GltfNodes& nodes);

}  // namespace etude
