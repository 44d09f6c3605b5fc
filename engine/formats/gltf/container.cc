#include "engine/formats/gltf/container.h"

#include <cstddef>
#include <cstdint>

#include "engine/base/names.h"

namespace etude {
namespace {

constexpr int kMaxNesting = 64;
constexpr std::size_t kMaxValues = 1'000'000;

/// Reads a little-endian 32-bit number, whatever the byte order of the machine.
std::uint32_t Number(std::string_view bytes, std::size_t at) {
  std::uint32_t number = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    number |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at + i])) << (8 * i);
  }
  return number;
}

/// Returns the chunk that begins at `at`, and sets `at` to its end.
Result<std::string_view> TakeChunk(std::string_view bytes, std::size_t& at, std::uint32_t kind, const Place& place) {
  const std::size_t left = bytes.size() - at;
  if (left < kChunkHeaderBytes) {
    return Fail(place, "the GLB ends within a chunk's header, at byte {}", bytes.size());
  }
  const std::size_t length = Number(bytes, at);
  const std::uint32_t found = Number(bytes, at + 4);
  if (found != kind) {
    return Fail(place, "found a chunk of type 0x{:08X} at byte {}; allowed: type 0x{:08X}", found, at, kind);
  }
  if (length > left - kChunkHeaderBytes || length % 4 != 0) {
    return Fail(place,
                "found a chunk of {} bytes at byte {}; allowed: a multiple of 4, at most the {} bytes left in the file",
                length, at, left - kChunkHeaderBytes);
  }
  at += kChunkHeaderBytes + length;
  return bytes.substr(at - length, length);
}

Result<GltfContainer> OpenGlb(std::string_view bytes, const Place& place) {
  if (bytes.size() < kHeaderBytes)
    return Fail(place, "found a GLB file of {} bytes; allowed: at least 12, the size of the header", bytes.size());
  if (const std::uint32_t version = Number(bytes, 4); version != 2) {
    return Fail(place, "found GLB version {}; allowed: 2", version);
  }
  const std::size_t length = Number(bytes, 8);
  if (length > bytes.size() || length < kHeaderBytes) {
    return Fail(place, "the GLB header states {} bytes, but the file has {}", length, bytes.size());
  }
  bytes = bytes.substr(0, length);
  std::size_t at = kHeaderBytes;
  ASSIGN_OR_RETURN(auto json, TakeChunk(bytes, at, kJsonChunk, place));
  GltfContainer container{.is_binary = true, .json = json, .binary = {}};
  if (at < bytes.size()) {
    ASSIGN_OR_RETURN(auto binary, TakeChunk(bytes, at, kBinaryChunk, place));
    container.binary = binary;
  }
  return container;
}

/// Scans JSON without parsing it, and limits its nesting and number of values.
class JsonShape {
 public:
  /// Returns the number of buffers.
  Result<std::size_t> CountBuffers(std::string_view json, const Place& place) {
    // Skip strings, count values and levels; an object at level 2 under the key "buffers" is a buffer.
    for (std::size_t i = 0; i < json.size(); ++i) {
      switch (json[i]) {
        case '"': {
          const std::size_t start = ++i;
          while (i < json.size() && json[i] != '"') i += json[i] == '\\' ? 2 : 1;
          if (i >= json.size()) return Fail(place, "a string of the JSON has no closing quotation mark");
          if (depth_ == 1) key_ = json.substr(start, i - start);
          // Refuse escaped keys: an escaped form of "buffers" would not be recognised below.
          if (depth_ == 1 && key_.find('\\') != std::string_view::npos) {
            return Fail(place, "found the top-level JSON key {}; allowed: keys without '\\'", Quote(key_));
          }
          break;
        }
        case '{':
        case '[':
          if (depth_ == 2 && json[i] == '{' && key_ == "buffers") ++buffers_;
          ++values_;
          if (++depth_ > kMaxNesting) return Fail(place, "the JSON is nested more than {} levels deep", kMaxNesting);
          break;
        case '}':
        case ']':
          --depth_;
          break;
        case ',':
          ++values_;
          break;
        default:
          break;
      }
      if (values_ > kMaxValues) return Fail(place, "the JSON contains more than {} values", kMaxValues);
    }
    return buffers_;
  }

 private:
  int depth_ = 0;
  std::size_t values_ = 0;
  std::size_t buffers_ = 0;
  std::string_view key_;  ///< the last string at the top level: a key or a value
};

}  // namespace

Result<GltfContainer> OpenGltfContainer(std::string_view bytes, const std::string& file) {
  const Place place{file};
  if (static_cast<double>(bytes.size()) > kMaxGltfBytes) {
    return Fail(place, "the glTF file has {} bytes; allowed: at most {:.0f} MB", bytes.size(), kMaxGltfBytes / 1e6);
  }
  GltfContainer container{.is_binary = false, .json = bytes, .binary = {}};
  if (bytes.starts_with("glTF")) {
    auto glb = OpenGlb(bytes, place);
    if (!glb) return glb;
    container = *glb;
  }
  ASSIGN_OR_RETURN(const auto buffers, JsonShape().CountBuffers(container.json, place));
  // Every buffer without a URI gets a copy of the binary part, so limit the size of all copies together.
  if (static_cast<double>(buffers) * static_cast<double>(container.binary.size()) > kMaxGltfBytes) {
    return Fail(place,
                "found {} buffers, each with a copy of {} bytes of binary data; allowed: at most {:.0f} MB for all "
                "copies together",
                buffers, container.binary.size(), kMaxGltfBytes / 1e6);
  }
  return container;
}

}  // namespace etude
