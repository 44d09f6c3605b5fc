#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/motion/character.h"
#include "engine/motion/clip.h"

namespace etude {

enum class ClipFormat { kBvh, kGltf, kGlb, kDeepMimic, kBuiltin };
/// "BVH", "glTF", "GLB", "DeepMimic", "built-in"
std::string_view FormatName(ClipFormat format);

/// What a motion file holds.
struct ClipFile {
  ClipFormat format = ClipFormat::kBvh;
  Character figure;         ///< a skeleton, and meshes if the file has any
  std::vector<Clip> clips;  ///< on that skeleton; a glTF file may have none
};

/// Larger files, or a .gltf with more in its buffers, are refused before memory is taken.
constexpr std::uintmax_t kLargestClipFile = 500'000'000;

/// Reads a BVH or glTF file or a motion of DeepMimic, told by its content, whatever it is called. The buffers of a .gltf are read from its own
/// folder and below only, links leading out of it are refused.
Result<ClipFile> ReadClipFile(const std::string& path);

}  // namespace etude
