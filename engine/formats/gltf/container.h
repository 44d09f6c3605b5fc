#pragma once

#include <string>
#include <string_view>

#include "engine/base/result.h"

namespace etude {

/// The two parts of a glTF file.
struct GltfContainer {
  bool is_binary = false;
  std::string_view json;
  std::string_view binary;  ///< of a GLB; may be empty
};

/// The most bytes taken from a file, from its binary part times the buffers that copy it, and from the files it names.
constexpr double kMostGltfBytes = 256e6;

/// Finds the parts of a .gltf or .glb, and refuses what would make a parser of JSON take memory out of proportion:
/// sizes that disagree, over 256 MB, JSON nested deeper than 64 levels or of over a million values, many buffers that
/// each copy the binary part. Whether the JSON is JSON is the parser's matter.
Result<GltfContainer> OpenGltfContainer(std::string_view bytes, const std::string& file);

}  // namespace etude
