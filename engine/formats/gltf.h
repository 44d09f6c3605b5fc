#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/motion/character.h"
#include "engine/motion/clip.h"

namespace etude {

/// What a glTF file holds: a figure (its skeleton is all nodes of the default scene; meshes may be none) and clips, one
/// per animation, on that same skeleton.
struct GltfContent {
  Character character;
  std::vector<Clip> clips;  ///< named as in the file; unnamed or doubled names are numbered
};

/// Gives the bytes of a file that a .gltf names, relative to the .gltf's own folder. `uri` has been checked: relative,
/// percent-decoded, without "..", scheme or absolute path.
using FetchFile = std::function<Result<std::string>(const std::string& uri)>;

/// Reads glTF 2.0, text (.gltf) or binary (.glb). Metres, Y up, as the format says.
///
/// Animations become frames at a fixed rate: the rate of their keys where these are evenly spaced (a whole number
/// within 0.01 %), else 60 Hz. LINEAR (slerp for rotations), STEP and CUBICSPLINE are evaluated as the specification
/// says; joints without channels stay at rest; sparse accessors and normalised integers are understood.
///
/// Refused with one complaint: what is not glTF 2.0, required extensions (all), indices out of range, accessors outside
/// their buffers, cycles or nodes with two parents, huge counts (caps as for BVH, and 2 million triangles), times that
/// do not ascend, values that are not finite, URIs that leave the file's folder.
Result<GltfContent> ReadGltf(std::string_view bytes, const std::string& file, const FetchFile& fetch);

/// Writes a figure with its clips as one GLB: nodes, skins, materials, and LINEAR animations at the clips' rates,
/// floats. Every clip has the character's skeleton. A character without meshes is written too. Valid by Khronos' glTF
/// validator.
std::string WriteGlb(const Character& character, std::span<const Clip> clips);

}  // namespace etude
