#pragma once

#include "engine/motion/clip.h"

namespace tinygltf {
class Model;
}

namespace etude {

/// Adds a clip as a LINEAR animation of the model's first nodes, which are the joints of `skeleton`. What stays at rest
/// gets no channel, what stays still one key; a clip in which nothing moves keeps its length in one channel. A clip
/// without frames is left out.
void AddGltfClip(tinygltf::Model& model, const Skeleton& skeleton, const Clip& clip);

}  // namespace etude
