#include "bench/tasks/base/clip_library.h"

#include <glob.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "engine/motion/to_body.h"

namespace etude {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kBuiltinPrefix = "builtin:";
constexpr std::size_t kMostClips = 1000;
constexpr std::uintmax_t kLargestFile = 512u << 20;

Result<void> AddBuiltins(const std::string& reference, const Place& place, ClipLibrary& library) {
  const std::string wanted = reference.substr(kBuiltinPrefix.size());
  const std::vector<std::string> names = wanted == "*" ? BuiltinMoveNames() : std::vector<std::string>{wanted};
  for (const std::string& name : names) {
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
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return Fail({path, 0, 0}, "is no file");
  if (fs::file_size(path, error) > kLargestFile) {
    return Fail({path, 0, 0}, "{} MiB; at most {} are read", fs::file_size(path, error) >> 20, kLargestFile >> 20);
  }
  std::ifstream in(path, std::ios::binary);
  std::ostringstream bytes;
  bytes << in.rdbuf();
  if (!in) return Fail({path, 0, 0}, "cannot be read");
  auto read = ReadBodyMotion(bytes.str(), path);
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
