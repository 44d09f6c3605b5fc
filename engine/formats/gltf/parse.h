#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "engine/base/result.h"
#include "engine/formats/gltf/gltf.h"

namespace tinygltf {
class Model;
}

namespace etude {

/// tinygltf's model of a file, as found: nothing in it can be trusted but the JSON types. Its buffers are loaded, its
/// images left encoded, and fetched from files of their own only where pictures are wanted. Refused: what
/// OpenGltfContainer or tinygltf refuses, another version than 2.x, extensions that are required and change what is
/// read here, URIs that leave the file's folder.
Result<std::unique_ptr<tinygltf::Model>> ParseGltf(std::string_view bytes, const std::string& file,
                                                   const FetchFile& fetch, bool wants_pictures);

}  // namespace etude
