#include "bench/clips/clip_library.h"

#include <glob.h>

#include <filesystem>

#include "bench/files/files.h"
#include "engine/retargeting/to_body.h"

namespace etude {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kBuiltinPrefix = "builtin:";
constexpr std::size_t kMostClips = 1000;

Result<void> AddBuiltins(const std::string& reference, const Place& place, ClipLibrary& library) {
  const std::string wanted = reference.substr(kBuiltinPrefix.size());
  const std::vector<std::string> names = wanted == "*" ? BuiltinMoveNames() : std::vector<std::string>{wanted};
  for (const std::string& name : names) {
    if (library.clips.size() >= kMostClips) return Fail(place, "more than {} clips", kMostClips);
    auto move = LoadBuiltinMove(name);
    if (!move) return Fail(place, "{}", move.error().message);
    const std::string full = std::string(kBuiltinPrefix) + name;
    BodyMotion motion = move->motion;
    library.clips.push_back({full, full, std::move(motion), std::move(*move), ""});
  }
  return {};
}

/// The files a path or pattern stands for, sorted by name.
Result<std::vector<std::string>> FilesOf(const std::string& reference, const Place& place) {
  glob_t matches{};
  const int status = ::glob(reference.c_str(), GLOB_TILDE, nullptr, &matches);
  std::vector<std::string> files;
  for (std::size_t i = 0; status == 0 && i < matches.gl_pathc; ++i) files.emplace_back(matches.gl_pathv[i]);
  ::globfree(&matches);
  if (files.empty()) {
    return Fail(place, "no clip matches '{}'; allowed: builtin:NAME, a .bvh file, or a pattern such as 'mocap/*.bvh'",
                reference);
  }
  return files;
}

Result<void> AddFile(const std::string& path, ClipLibrary& library) {
  const auto bytes = ReadWholeFile(path);
  if (!bytes) return tl::unexpected(bytes.error());
  auto read = ReadBodyMotion(*bytes, path);
  if (!read) return tl::unexpected(read.error());
  library.clips.push_back({fs::path(path).stem().string(), path, std::move(read->motion), std::nullopt, read->note});
  return {};
}

}  // namespace

Result<ClipLibrary> LoadClips(const std::vector<std::string>& references, const Place& place) {
  ClipLibrary library;
  for (const std::string& reference : references) {
    if (reference.starts_with(kBuiltinPrefix)) {
      if (auto added = AddBuiltins(reference, place, library); !added) return tl::unexpected(added.error());
      continue;
    }
    const auto files = FilesOf(reference, place);
    if (!files) return tl::unexpected(files.error());
    for (const std::string& file : *files) {
      if (library.clips.size() >= kMostClips) return Fail(place, "more than {} clips", kMostClips);
      if (auto added = AddFile(file, library); !added) return tl::unexpected(added.error());
    }
  }
  return library;
}

}  // namespace etude
