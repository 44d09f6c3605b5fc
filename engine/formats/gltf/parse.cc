#include "engine/formats/gltf/parse.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <exception>
#include <nlohmann/json.hpp>
#include <optional>

#include "engine/base/names.h"
#include "engine/formats/gltf/container.h"
#include "engine/formats/gltf/file.h"
#include "engine/formats/gltf/text.h"

namespace etude {
namespace {

/// What the callbacks of one parse share.
struct Fetcher {
  const FetchFile* fetch = nullptr;
  std::string file;
  bool wants_pictures = false;
  double bytes_left = kMostGltfBytes;
  std::optional<Error> complaint;  ///< the first

  bool Complain(Error error) {
    if (!complaint) complaint = std::move(error);
    return false;
  }
};

/// Pictures are asked for in the same way as buffers.
bool IsPicture(const std::string& uri) {
  constexpr std::array<std::string_view, 7> kEndings = {".png", ".jpg", ".jpeg", ".webp", ".ktx2", ".dds", ".gif"};
  std::string lower = uri;
  for (char& c : lower) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return std::ranges::any_of(kEndings, [&](std::string_view ending) { return lower.ends_with(ending); });
}

/// Whether a percent-decoded URI names something in the file's folder or below it.
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
    return fetcher.Complain(Fail(place, "names the file {}; allowed: files in its own folder", Quote(uri)).value());
  }
  if (!*fetcher.fetch) {
    return fetcher.Complain(Fail(place, "names the file {}; allowed here: data within the file", Quote(uri)).value());
  }
  auto bytes = (*fetcher.fetch)(uri);
  if (!bytes) return fetcher.Complain(bytes.error());
  fetcher.bytes_left -= static_cast<double>(bytes->size());
  if (fetcher.bytes_left < 0) {
    return fetcher.Complain(
        Fail(place, "names files of over {:.0f} MB; {} is one too many", kMostGltfBytes / 1e6, Quote(uri)).value());
  }
  out->assign(bytes->begin(), bytes->end());
  return true;
}

bool WriteWholeFile(std::string*, const std::string&, const std::vector<unsigned char>&, void*) { return false; }

/// Keeps a picture as it stands in its own file or URI. Of those within a buffer tinygltf has not checked the place.
bool KeepEncoded(tinygltf::Image* image, const int, std::string*, std::string*, int, int, const unsigned char* bytes,
                 int size, void*) {
  if (image->bufferView == kNoIndex && size > 0) image->image.assign(bytes, bytes + size);
  return true;
}

/// tinygltf puts what it dislikes into one text, a line each, and goes on where it can. What it only wishes were there
/// is no reason to refuse.
std::string Complaint(std::string_view text) {
  constexpr std::array<std::string_view, 3> kHarmless = {
      "'inverseBindMatrices' property is missing in Skin.",  // optional since 2.0
      "'node' property is missing.",                         // such channels are to be ignored
      "`node` field is missing in animation.channels.target",
  };
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    if (!line.empty() && std::ranges::find(kHarmless, line) == kHarmless.end()) return std::string(line);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return "";
}

/// JSON's own errors say where they are.
Error NotGltf(const std::string& file, const std::string& complaint) {
  Place place{file};
  std::string what = complaint;
  if (const std::size_t at = complaint.find("parse error at line "); at != std::string::npos) {
    std::sscanf(complaint.c_str() + at, "parse error at line %d, column %d", &place.line, &place.column);
    constexpr std::string_view kSeparator = ": ";
    what = complaint.substr(complaint.find(kSeparator, at) + kSeparator.size());
  }
  constexpr std::size_t kLongest = 200;
  return Fail(std::move(place), "not glTF 2.0: {}", what.substr(0, kLongest)).value();
}

/// Extensions of lights and looks change nothing that is read here; quantised meshes are understood.
bool IsHarmless(const std::string& extension) {
  return extension.starts_with("KHR_materials_") || extension.starts_with("KHR_texture_") ||
         extension.starts_with("EXT_texture_") || extension == "KHR_lights_punctual" ||
         extension == "KHR_mesh_quantization";
}

Result<void> CheckExtensions(const tinygltf::Model& model, const std::string& file) {
  for (const std::string& extension : model.extensionsRequired) {
    if (IsHarmless(extension)) continue;
    return Fail({file},
                "extensionsRequired: found {}; allowed: KHR_materials_*, KHR_texture_*, EXT_texture_*, "
                "KHR_lights_punctual, KHR_mesh_quantization",
                Quote(extension));
  }
  return {};
}

/// tinygltf takes an optional index or count that is negative, or no number, for one that is not there.
Result<void> CheckCounts(const nlohmann::json& json, const std::string& where, const std::string& file) {
  constexpr std::array<std::string_view, 10> kCounts = {
      "bufferView", "byteOffset", "byteStride", "indices", "material", "mesh", "mode", "scene", "skeleton", "skin"};
  if (json.is_object()) {
    for (const auto& [key, value] : json.items()) {
      if (key == "extras" || key == "extensions") continue;
      const std::string name = where.empty() ? key : where + "." + key;
      if (std::ranges::find(kCounts, key) != kCounts.end() && !value.is_number_unsigned() && !value.is_object()) {
        return Fail({file}, "{}: found {}; allowed: a whole number from 0", name, value.dump().substr(0, 40));
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

/// Every clip copies the names of its joints: long ones would multiply.
constexpr std::size_t kLongestName = 500;

template <typename Named>
Result<void> TidyNames(std::vector<Named>& all, std::string_view kind, const std::string& file) {
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].name.size() > kLongestName) {
      return Fail({file}, "{}[{}].name: found {} bytes; allowed: {}", kind, i, all[i].name.size(), kLongestName);
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

}  // namespace

Result<std::unique_ptr<tinygltf::Model>> ParseGltf(std::string_view bytes, const std::string& file,
                                                   const FetchFile& fetch, bool wants_pictures) {
  ASSIGN_OR_RETURN(auto container, OpenGltfContainer(bytes, file));

  Fetcher fetcher{.fetch = &fetch, .file = file, .wants_pictures = wants_pictures, .complaint = {}};
  tinygltf::TinyGLTF parser;
  parser.SetImageLoader(KeepEncoded, nullptr);
  parser.SetFsCallbacks({FileExists, ExpandFilePath, ReadWholeFile, WriteWholeFile, &fetcher});
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
  // Filled even where reading failed, and then most likely the reason.
  RETURN_IF_ERROR(CheckExtensions(*model, file));
  const std::string complaint = Complaint(errors);
  if (!is_read || !complaint.empty()) {
    // Files asked for in vain count only when they were needed.
    if (fetcher.complaint) return tl::unexpected(*fetcher.complaint);
    return tl::unexpected(NotGltf(file, complaint.empty() ? "the parser gave up" : complaint));
  }
  if (!model->asset.version.starts_with("2.")) {
    return Fail({file}, "asset.version: found {}; allowed: 2.0", Quote(model->asset.version));
  }
  RETURN_IF_ERROR(CheckCounts(nlohmann::json::parse(container.json, nullptr, /*allow_exceptions=*/false), "", file));
  RETURN_IF_ERROR(TidyAllNames(*model, file));
  return model;
}

}  // namespace etude
