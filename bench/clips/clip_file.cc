#include "bench/clips/clip_file.h"

#include <algorithm>
#include <filesystem>

#include "bench/files/files.h"
#include "engine/base/names.h"
#include "engine/formats/bvh.h"
#include "engine/formats/deepmimic.h"
#include "engine/formats/gltf/gltf.h"
#include "engine/formats/text_scanner.h"
#include "sim/camera/jpeg.h"
#include "sim/sensors/image_files.h"

namespace etude {
namespace {

namespace fs = std::filesystem;

/// Reads files until together they would be too large.
class CappedReader {
 public:
  Result<std::string> Read(const fs::path& path) {
    std::error_code not_there;  // ReadWholeFile says it better
    const std::uintmax_t size = fs::file_size(path, not_there);
    if (!not_there && size > left_) {
      return Fail({path.string(), 0, 0}, "{} MB; at most {} MB of a clip are read", (size + 999'999) / 1'000'000,
                  kLargestClipFile / 1'000'000);
    }
    auto bytes = ReadWholeFile(path);
    if (bytes) left_ -= std::min<std::uintmax_t>(left_, bytes->size());
    return bytes;
  }

 private:
  std::uintmax_t left_ = kLargestClipFile;
};

Result<std::string> ReadBeside(const std::string& path, const std::string& uri, CappedReader& reader) {
  const auto fail = [&](const std::string& why) { return Fail({path, 0, 0}, "its file {}: {}", Quote(uri), why); };
  std::error_code error;
  const fs::path folder = fs::canonical(fs::path(path), error).parent_path();
  const fs::path file = fs::canonical(folder / uri, error);
  if (error) return fail(error.message());
  // A link may lead anywhere: what counts is where the file really is.
  const auto ends = std::ranges::mismatch(folder, file);
  if (ends.in1 != folder.end()) return fail("a link that leads out of the folder");
  auto bytes = reader.Read(file);
  if (!bytes) return fail(bytes.error().message);
  return bytes;
}

Result<ColourImage> DecodeTexture(std::string_view bytes, std::size_t most_pixels) {
  return bytes.starts_with("\x89PNG") ? DecodeColourPng(bytes, most_pixels) : ReadJpeg(bytes, most_pixels);
}

/// What the first bytes say of a file that is neither: some formats are often met, and easily made into one of ours.
std::string WhatElse(std::string_view bytes, const std::string& first_word) {
  const bool is_fbx = bytes.starts_with("Kaydara FBX Binary") || bytes.starts_with("; FBX");
  if (is_fbx) return "an FBX file, which Blender turns into glTF";
  if (first_word.empty()) return "an empty file";
  return "a file that begins with " + Quote(first_word);
}

ClipFile FileOfOne(ClipFormat format, Clip clip) {
  ClipFile file{.format = format,
                .figure = {.name = clip.name, .skeleton = clip.skeleton, .materials = {}, .meshes = {}},
                .clips = {}};
  file.clips.push_back(std::move(clip));
  return file;
}

}  // namespace

std::string_view FormatName(ClipFormat format) {
  switch (format) {
    case ClipFormat::kBvh:
      return "BVH";
    case ClipFormat::kGltf:
      return "glTF";
    case ClipFormat::kGlb:
      return "GLB";
    case ClipFormat::kDeepMimic:
      return "DeepMimic";
    case ClipFormat::kBuiltin:
      break;
  }
  return "built-in";
}

Result<ClipFile> ReadClipFile(const std::string& path) {
  CappedReader reader;
  ASSIGN_OR_RETURN(const auto bytes, reader.Read(path));
  TextScanner scanner(bytes, path);
  const bool has_text = scanner.SkipToText();
  const Token first = has_text ? scanner.Next() : Token{};

  ClipFile file;
  if (first.text == "{" && IsDeepMimicMotion(bytes)) {
    ASSIGN_OR_RETURN(auto clip, ReadDeepMimicMotion(bytes, path));
    return FileOfOne(ClipFormat::kDeepMimic, std::move(clip));
  }
  if (bytes.starts_with("glTF") || first.text == "{") {
    file.format = first.text == "{" ? ClipFormat::kGltf : ClipFormat::kGlb;
    ASSIGN_OR_RETURN(
        auto content,
        ReadGltf(
            bytes, path, [&](const std::string& uri) { return ReadBeside(path, uri, reader); }, DecodeTexture));
    file.figure = std::move(content.character);
    file.clips = std::move(content.clips);
    return file;
  }
  constexpr std::string_view kBvhStart = "HIERARCHY";
  if (!std::ranges::equal(first.text, kBvhStart, {}, [](char c) { return c >= 'a' && c <= 'z' ? c - 'a' + 'A' : c; })) {
    return Fail(scanner.At(first),
                "{}; allowed: BVH (it begins with HIERARCHY), glTF 2.0 (.glb, .gltf), DeepMimic's motions",
                WhatElse(bytes, std::string(first.text)));
  }
  ASSIGN_OR_RETURN(auto clip, ReadBvh(bytes, path));
  return FileOfOne(ClipFormat::kBvh, std::move(clip));
}

}  // namespace etude
