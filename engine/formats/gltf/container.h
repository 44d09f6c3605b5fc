#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "engine/base/result.h"

namespace etude {

/// The two parts of a glTF file.
struct GltfContainer {
  bool is_binary = false;
  std::string_view json;
  std::string_view binary;  ///< the binary part of a GLB file; may be empty
};

/// The maximum size of a file in bytes. The same limit holds for the sum of all copies of the file's binary part (one
/// copy for each buffer without URI), and for the sum of all files to which the file refers.
inline constexpr double kMaxGltfBytes = 256e6;

// The layout of a GLB file (glTF 2.0, section 4.4): a header, then chunks, each with a header of its own.
inline constexpr std::size_t kHeaderBytes = 12, kChunkHeaderBytes = 8;
inline constexpr std::uint32_t kJsonChunk = 0x4E4F534A;    ///< "JSON"
inline constexpr std::uint32_t kBinaryChunk = 0x004E4942;  ///< "BIN\0"

/// Finds the parts of a .gltf or .glb file. Refuses files that would make a JSON parser use excessive memory:
/// inconsistent sizes, more than 256 MB, JSON nested deeper than 64 levels or with more than a million values, and many
/// buffers that each copy the binary part. The syntax of the JSON is checked by the parser.
Result<GltfContainer> OpenGltfContainer(std::string_view bytes, const std::string& file);

}  // namespace etude
