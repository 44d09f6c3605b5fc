#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <exception>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>

#include "engine/base/names.h"
#include "engine/base/result.h"
#include "engine/base/text.h"
#include "engine/formats/gltf/animation.h"
#include "engine/formats/gltf/container.h"
#include "engine/formats/gltf/file.h"
#include "engine/formats/gltf/gltf.h"
#include "engine/formats/gltf/mesh.h"
#include "engine/formats/gltf/nodes.h"

namespace etude {
namespace {

/// The data that the callbacks of one parse share.
struct Fetcher {
  const FetchFile* fetch = nullptr;
  std::string file;
  bool wants_pictures = false;
  double bytes_left = kMaxGltfBytes;
  std::optional<Error> complaint;  ///< the first error of a callback

  bool Complain(Error error) {
    if (!complaint) complaint = std::move(error);
    return false;
  }
};

/// Returns true if a URI names a picture. The parser requests pictures in the same way as buffers, so only the
/// extension distinguishes them.
bool IsPicture(const std::string& uri) {
  constexpr std::array<std::string_view, 7> kEndings = {".png", ".jpg", ".jpeg", ".webp", ".ktx2", ".dds", ".gif"};
  const std::string lower = InLowerCase(uri);
  return std::ranges::any_of(kEndings, [&](std::string_view ending) { return lower.ends_with(ending); });
}

/// Returns true if a percent-decoded URI names something in the file's folder or below it.
bool StaysInFolder(std::string_view uri) {
  const auto is_bad = [](char c) { return c == ':' || c == '\\' || (c >= 0 && c < ' ') || c == 0x7f; };
  if (uri.empty() || uri.starts_with('/') || uri.starts_with('~') || std::ranges::any_of(uri, is_bad)) return false;
  while (!uri.empty()) {
    const std::size_t slash = std::min(uri.find('/'), uri.size());
    if (uri.substr(0, slash) == "..") return false;
    uri.remove_prefix(std::min(slash + 1, uri.size()));
  }
  return true;
}

bool FileExists(const std::string& path, void* user_data) {
  return static_cast<const Fetcher*>(user_data)->wants_pictures || !IsPicture(path);
}

std::string ExpandFilePath(const std::string& path, void*) { return path; }

bool ReadWholeFile(std::vector<unsigned char>* out, std::string*, const std::string& uri, void* user_data) {
  Fetcher& fetcher = *static_cast<Fetcher*>(user_data);
  const Place place{fetcher.file};
  if (!StaysInFolder(uri)) {
    return fetcher.Complain(
        Fail(place, "the file refers to {}; allowed: files in the same folder", Quote(uri)).value());
  }
  if (!*fetcher.fetch) {
    return fetcher.Complain(
        Fail(place, "the file refers to {}; allowed: data inside the file itself", Quote(uri)).value());
  }
  auto bytes = (*fetcher.fetch)(uri);
  if (!bytes) return fetcher.Complain(bytes.error());
  fetcher.bytes_left -= static_cast<double>(bytes->size());
  if (fetcher.bytes_left < 0) {
    return fetcher.Complain(
        Fail(place, "the files that this file refers to exceed {:.0f} MB together at {}; allowed: at most this size",
             kMaxGltfBytes / 1e6, Quote(uri))
            .value());
  }
  out->assign(bytes->begin(), bytes->end());
  return true;
}

bool WriteWholeFile(std::string*, const std::string&, const std::vector<unsigned char>&, void*) { return false; }

/// Makes `parser` read files only through `fetcher`. It is a template because tinygltf's versions differ: version 2.9
/// added a callback for a file's size. If a callback is missing, tinygltf reports an error and keeps its own callbacks,
/// which read any file.
template <typename Callbacks, typename Parser>
Result<void> ReadOnlyThrough(Fetcher& fetcher, Parser& parser) {
  Callbacks callbacks{};
  callbacks.FileExists = FileExists;
  callbacks.ExpandFilePath = ExpandFilePath;
  callbacks.ReadWholeFile = ReadWholeFile;
  callbacks.WriteWholeFile = WriteWholeFile;
  if constexpr (requires { callbacks.GetFileSizeInBytes; }) {
    // Any size is accepted here, because ReadWholeFile limits the bytes of all files together.
    callbacks.GetFileSizeInBytes = [](std::size_t* size, std::string*, const std::string&, void*) {
      *size = 0;
      return true;
    };
  }
  callbacks.user_data = &fetcher;
  if constexpr (std::is_void_v<decltype(parser.SetFsCallbacks(callbacks))>) {
    parser.SetFsCallbacks(callbacks);
  } else if (!parser.SetFsCallbacks(callbacks)) {
    return Fail({fetcher.file},
                "Etude cannot read glTF files, because this version of tinygltf does not accept Etude's functions for "
                "reading files");
  }
  return {};
}

/// Keeps the encoded bytes of a picture from a file or URI. Pictures in a buffer are read later, because tinygltf has
/// not checked their bounds.
bool KeepEncoded(tinygltf::Image* image, const int, std::string*, std::string*, int, int, const unsigned char* bytes,
                 int size, void*) {
  if (image->bufferView == kNoIndex && size > 0) image->image.assign(bytes, bytes + size);
  return true;
}

/// Returns the first real error in tinygltf's text, which has one line per error; tinygltf continues after an error if
/// possible. Warnings about optional properties are ignored.
std::string Complaint(std::string_view text) {
  constexpr std::array<std::string_view, 3> kHarmless = {
      "'inverseBindMatrices' property is missing in Skin.",  // the property is optional since glTF 2.0
      "'node' property is missing.",                         // channels without a node are ignored, as specified
      "`node` field is missing in animation.channels.target",
  };
  while (!text.empty()) {
    const std::string_view line = TakeLine(text);
    if (!line.empty() && std::ranges::find(kHarmless, line) == kHarmless.end()) return std::string(line);
  }
  return "";
}

/// Makes an error from the parser's message; messages of the JSON parser contain a position.
Error NotGltf(const std::string& file, const std::string& complaint) {
  Place place{file};
  std::string what = complaint;
  if (const std::size_t at = complaint.find("parse error at line "); at != std::string::npos) {
    std::sscanf(complaint.c_str() + at, "parse error at line %d, column %d", &place.line, &place.column);
    constexpr std::string_view kSeparator = ": ";
    what = complaint.substr(complaint.find(kSeparator, at) + kSeparator.size());
  }
  constexpr std::size_t kMaxMessageBytes = 200;
  return Fail(std::move(place), "not glTF 2.0: {}", what.substr(0, kMaxMessageBytes)).value();
}

constexpr const char* kDraco = "KHR_draco_mesh_compression";

/// Returns true if files that require this extension can be read. Extensions for lights and materials do not affect the
/// result, quantised meshes are supported, and compressed meshes are left out.
bool IsHarmless(const std::string& extension) {
  return extension.starts_with("KHR_materials_") || extension.starts_with("KHR_texture_") ||
         extension.starts_with("EXT_texture_") || extension == "KHR_lights_punctual" ||
         extension == "KHR_mesh_quantization" || extension == kDraco;
}

Result<void> CheckExtensions(const tinygltf::Model& model, const std::string& file) {
  for (const std::string& extension : model.extensionsRequired) {
    if (IsHarmless(extension)) continue;
    return Fail({file},
                "extensionsRequired: found {}; allowed: KHR_materials_*, KHR_texture_*, EXT_texture_*, "
                "KHR_lights_punctual, KHR_mesh_quantization, KHR_draco_mesh_compression (without its meshes)",
                Quote(extension));
  }
  return {};
}

/// Refuses an index or count that is negative or not a number, and a channel whose target has no path, because
/// tinygltf's versions report these differently or not at all.
Result<void> CheckCounts(const nlohmann::json& json, const std::string& where, const std::string& file) {
  constexpr std::array<std::string_view, 12> kCounts = {
      "bufferView", "byteOffset", "byteStride", "indices", "inverseBindMatrices", "material", "mesh", "mode",
      "node",       "scene",      "skeleton",   "skin"};
  if (json.is_object()) {
    for (const auto& [key, value] : json.items()) {
      if (key == "extras" || key == "extensions") continue;
      const std::string name = where.empty() ? key : where + "." + key;
      // In a sparse accessor, the value of this key is an object.
      const bool may_be_object = key == "indices" && !where.starts_with("meshes");
      if (std::ranges::find(kCounts, key) != kCounts.end() && !value.is_number_unsigned() &&
          !(may_be_object && value.is_object())) {
        return Fail({file}, "{}: found {}; allowed: a whole number of 0 or more", name, value.dump().substr(0, 40));
      }
      if (key == "target" && value.is_object() && !(value.contains("path") && value["path"].is_string())) {
        return Fail({file}, "{}.path: found no text; allowed: translation, rotation, scale, weights", name);
      }
      RETURN_IF_ERROR(CheckCounts(value, name, file));
    }
  } else if (json.is_array()) {
    for (std::size_t i = 0; i < json.size(); ++i) {
      RETURN_IF_ERROR(CheckCounts(json[i], fmt::format("{}[{}]", where, i), file));
    }
  }
  return {};
}

/// Refuses index lists without a buffer view: tinygltf 2.7 refuses them, 2.9 reads them as zeros. Precondition:
/// CheckCounts has passed.
Result<void> CheckIndexLists(const nlohmann::json& json, const std::string& file) {
  const nlohmann::json::json_pointer to_meshes("/meshes"), to_accessors("/accessors");
  if (!json.contains(to_meshes) || !json.contains(to_accessors) || !json[to_accessors].is_array()) return {};
  for (const auto& mesh : json[to_meshes]) {
    for (const auto& primitive : mesh.is_object() ? mesh.value("primitives", nlohmann::json()) : nlohmann::json()) {
      if (!primitive.is_object() || primitive.contains("extensions")) continue;
      const std::size_t accessor = primitive.value("indices", json[to_accessors].size());
      const auto list = accessor < json[to_accessors].size() ? json[to_accessors][accessor] : nlohmann::json();
      if (!list.is_object() || list.contains("bufferView") || list.contains("sparse")) continue;
      return Fail({file}, "accessors[{}]: found no bufferView; allowed: one bufferView for each index list", accessor);
    }
  }
  return {};
}

/// Refuses file names with a NUL character, plain or escaped, because tinygltf 2.9 would cut the name there and request
/// another file.
Result<void> CheckFileNames(const nlohmann::json& json, const std::string& file) {
  for (const char* list : {"buffers", "images"}) {
    if (!json.is_object() || !json.contains(list) || !json[list].is_array()) continue;
    for (const auto& entry : json[list]) {
      if (!entry.is_object() || !entry.contains("uri") || !entry["uri"].is_string()) continue;
      const auto& uri = entry["uri"].get_ref<const std::string&>();
      if (uri.starts_with("data:") || (uri.find('\0') == std::string::npos && uri.find("%00") == std::string::npos)) {
        continue;
      }
      return Fail({file}, "the file refers to {}; allowed: files in the same folder", Quote(uri));
    }
  }
  return {};
}

void PutNumber(std::string& bytes, std::size_t number) {
  for (int i = 0; i < 4; ++i) bytes += static_cast<char>((number >> (8 * i)) & 0xffU);
}

/// Returns the file without its meshes if they are compressed by Draco, because the parser would fail on them; nullopt
/// for other files.
std::optional<std::string> WithoutDracoMeshes(const GltfContainer& container) {
  if (container.json.find(kDraco) == std::string_view::npos) return std::nullopt;
  // Return nullopt unless the file requires Draco.
  auto json = nlohmann::json::parse(container.json, nullptr, /*allow_exceptions=*/false);
  const bool is_file = json.is_object() && json.contains("extensionsRequired") && json["extensionsRequired"].is_array();
  if (!is_file || std::ranges::find(json["extensionsRequired"], kDraco) == json["extensionsRequired"].end()) {
    return std::nullopt;
  }
  // Remove the meshes from the JSON.
  json.erase("meshes");
  if (json.contains("nodes") && json["nodes"].is_array()) {
    for (auto& node : json["nodes"]) {
      if (node.is_object()) node.erase("mesh");
    }
  }
  // Write the file again, as text or binary.
  std::string text = json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  if (!container.is_binary) return text;
  text.resize((text.size() + 3) / 4 * 4, ' ');
  std::string bytes = "glTF";
  const std::size_t binary = container.binary.empty() ? 0 : kChunkHeaderBytes + container.binary.size();
  PutNumber(bytes, 2);
  PutNumber(bytes, kHeaderBytes + kChunkHeaderBytes + text.size() + binary);
  PutNumber(bytes, text.size());
  PutNumber(bytes, kJsonChunk);
  bytes += text;
  if (binary == 0) return bytes;
  PutNumber(bytes, container.binary.size());
  PutNumber(bytes, kBinaryChunk);
  return bytes += container.binary;
}

/// The maximal length of a name; every clip copies the names of its joints, so long names would use much memory.
constexpr std::size_t kMaxNameBytes = 500;

template <typename Named>
Result<void> TidyNames(std::vector<Named>& all, std::string_view kind, const std::string& file) {
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].name.size() > kMaxNameBytes) {
      return Fail({file}, "{}[{}].name: found {} bytes; allowed: at most {}", kind, i, all[i].name.size(),
                  kMaxNameBytes);
    }
    all[i].name = GltfText(all[i].name);
  }
  return {};
}

Result<void> TidyAllNames(tinygltf::Model& model, const std::string& file) {
  RETURN_IF_ERROR(TidyNames(model.nodes, "nodes", file));
  RETURN_IF_ERROR(TidyNames(model.animations, "animations", file));
  RETURN_IF_ERROR(TidyNames(model.meshes, "meshes", file));
  return TidyNames(model.materials, "materials", file);
}

/// Returns tinygltf's model of a file. Only the JSON types in the model have been checked, not values such as indices.
/// Buffers are loaded; images stay encoded, and images in separate files are fetched only if pictures are wanted.
/// Returns an error for anything that OpenGltfContainer or tinygltf refuses, a version other than 2.x, required
/// extensions that would change what is read here, and URIs that leave the file's folder.
Result<std::unique_ptr<tinygltf::Model>> ParseGltf(std::string_view bytes, const std::string& file,
                                                   const FetchFile& fetch, bool wants_pictures) {
  ASSIGN_OR_RETURN(auto container, OpenGltfContainer(bytes, file));
  const auto json = nlohmann::json::parse(container.json, nullptr, /*allow_exceptions=*/false);
  RETURN_IF_ERROR(CheckFileNames(json, file));

  // Parse the file with our own callbacks.
  const std::optional<std::string> without_meshes = WithoutDracoMeshes(container);
  if (without_meshes) bytes = *without_meshes;
  Fetcher fetcher{.fetch = &fetch, .file = file, .wants_pictures = wants_pictures, .complaint = {}};
  tinygltf::TinyGLTF parser;
  parser.SetImageLoader(KeepEncoded, nullptr);
  RETURN_IF_ERROR(ReadOnlyThrough<tinygltf::FsCallbacks>(fetcher, parser));
  auto model = std::make_unique<tinygltf::Model>();
  std::string errors, warnings;
  bool is_read = false;
  try {
    is_read = container.is_binary ? parser.LoadBinaryFromMemory(model.get(), &errors, &warnings,
                                                                reinterpret_cast<const unsigned char*>(bytes.data()),
                                                                static_cast<unsigned>(bytes.size()))
                                  : parser.LoadASCIIFromString(model.get(), &errors, &warnings, bytes.data(),
                                                               static_cast<unsigned>(bytes.size()), "");
  } catch (const std::exception& exception) {
    errors = exception.what();
  }
  // The model is filled even if reading failed. An unsupported required extension is then the most likely reason, so
  // report it first.
  RETURN_IF_ERROR(CheckExtensions(*model, file));
  const std::string complaint = Complaint(errors);
  if (!is_read || !complaint.empty()) {
    // If a file could not be fetched, this caused the failure. (A missing picture does not make the parser fail.)
    if (fetcher.complaint) return tl::unexpected(*fetcher.complaint);
    // Prefer our own error messages, which are the same with every version of tinygltf. They apply to glTF 2 only,
    // because glTF 1 has names where 2.0 has numbers.
    const nlohmann::json::json_pointer version("/asset/version");
    if (json.contains(version) && json[version].is_string() && json[version].get<std::string>().starts_with("2")) {
      RETURN_IF_ERROR(CheckCounts(json, "", file));
      RETURN_IF_ERROR(CheckIndexLists(json, file));
    }
    return tl::unexpected(NotGltf(file, complaint.empty() ? "the parser failed" : complaint));
  }
  if (!model->asset.version.starts_with("2.")) {
    return Fail({file}, "asset.version: found {}; allowed: 2.0", Quote(model->asset.version));
  }
  RETURN_IF_ERROR(CheckCounts(json, "", file));
  RETURN_IF_ERROR(CheckIndexLists(json, file));
  RETURN_IF_ERROR(TidyAllNames(*model, file));
  return model;
}

/// Returns the node of each bone in a VRM file's table of bones, by bone name; malformed entries are ignored.
std::map<std::string, int> BoneTable(const tinygltf::Model& model) {
  std::map<std::string, int> nodes;
  const auto add = [&](const std::string& bone, const tinygltf::Value& value) {
    if (value.Has("node") && value.Get("node").IsInt()) nodes[bone] = value.Get("node").GetNumberAsInt();
  };
  for (const char* extension : {"VRMC_vrm", "VRMC_vrm_animation", "VRM"}) {
    const auto found = model.extensions.find(extension);
    if (found == model.extensions.end() || !found->second.Has("humanoid")) continue;
    const tinygltf::Value& humanoid = found->second.Get("humanoid");
    if (!humanoid.Has("humanBones")) continue;
    const tinygltf::Value& bones = humanoid.Get("humanBones");
    for (const std::string& bone : bones.Keys()) add(bone, bones.Get(bone));
    for (std::size_t i = 0; bones.IsArray() && i < bones.ArrayLen(); ++i) {
      const tinygltf::Value& bone = bones.Get(i);
      if (bone.Has("bone") && bone.Get("bone").IsString()) add(bone.Get("bone").Get<std::string>(), bone);
    }
  }
  return nodes;
}

/// Returns a file's name without folder and extension: "dances/robot.glb" → "robot".
std::string Stem(const std::string& file) {
  const std::string name = file.substr(file.find_last_of('/') + 1);
  return name.substr(0, name.find_last_of('.'));
}

}  // namespace

Result<GltfContent> ReadGltf(std::string_view bytes, const std::string& file, const FetchFile& fetch,
                             const DecodePicture& decode) {
  ASSIGN_OR_RETURN(const auto model, ParseGltf(bytes, file, fetch, decode != nullptr));
  GltfFile parsed(*model, file);
  ASSIGN_OR_RETURN(auto nodes, ReadGltfNodes(parsed));
  GltfContent content;
  content.character.name = Stem(file);
  content.character.skeleton = nodes.skeleton;
  if (std::ranges::find(model->extensionsRequired, kDraco) == model->extensionsRequired.end()) {
    RETURN_IF_ERROR(ReadGltfMeshes(parsed, nodes, decode, content.character));
  } else {
    content.remarks.emplace_back("Etude left out the meshes, because they are compressed (Draco)");
  }
  const bool has_pointers = std::ranges::count(model->extensionsUsed, "KHR_animation_pointer") > 0;
  if (has_pointers) content.remarks.emplace_back("Etude does not read animations that use KHR_animation_pointer");
  ASSIGN_OR_RETURN(auto clips, ReadGltfClips(parsed, nodes, content.remarks));
  content.clips = std::move(clips);
  for (const tinygltf::Skin& skin : model->skins) {
    for (const int node : skin.joints) content.skinned.insert(nodes.skeleton.joints[nodes.joint_of[node]].name);
  }
  for (const auto& [bone, node] : BoneTable(*model)) {
    const bool is_node = node >= 0 && node < static_cast<int>(nodes.joint_of.size());
    if (is_node && nodes.joint_of[node] >= 0) content.bones[bone] = nodes.joint_of[node];
  }
  return content;
}

}  // namespace etude
