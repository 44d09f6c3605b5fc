#include "io/clips/references.h"

#include <glob.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>

#include "engine/base/names.h"
#include "engine/base/utf8.h"
#include "sim/choreography/song.h"

namespace etude {
namespace {

/// Clips that a Debian package installs. References name these clips without their paths, so that no scenario and no
/// result contains a path of one machine.
struct PackagedClips {
  std::string_view prefix;   ///< the prefix of references to these clips
  std::string_view package;  ///< name of the Debian package
  std::string_view folder;
  std::string_view ending;
};
constexpr std::array kPackagedClips = {
    PackagedClips{"assimp:", "assimp-testmodels", "/usr/share/assimp/models/BVH/", ".bvh"}};

const PackagedClips* FindPackage(std::string_view reference) {
  const auto found =
      std::ranges::find_if(kPackagedClips, [&](const PackagedClips& one) { return reference.starts_with(one.prefix); });
  return found == kPackagedClips.end() ? nullptr : &*found;
}

std::vector<std::string> FilesMatching(const std::string& pattern) {
  // glob calls itself for every '/' with a copy of the pattern, so thousands of '/' would overflow the stack.
  constexpr std::size_t kMaxPatternBytes = 1000;
  if (pattern.size() > kMaxPatternBytes) return {};
  glob_t matches{};
  const int status = ::glob(pattern.c_str(), GLOB_TILDE, nullptr, &matches);
  std::vector<std::string> files;
  for (std::size_t i = 0; status == 0 && i < matches.gl_pathc; ++i) files.emplace_back(matches.gl_pathv[i]);
  ::globfree(&matches);
  return files;
}

std::vector<std::string> BuiltinsOf(const std::string& reference) {
  const std::string wanted = reference.substr(kBuiltinPrefix.size());
  std::vector<std::string> names = wanted == "*"       ? BuiltinMoveNames()
                                   : wanted == "acts"  ? BuiltinActNames()
                                   : wanted == "songs" ? BuiltinSongNames()
                                                       : std::vector<std::string>{wanted};
  for (std::string& name : names) name.insert(0, kBuiltinPrefix);
  return names;
}

std::vector<std::string> FilesOf(const std::string& reference) {
  std::error_code ignored;
  if (std::filesystem::exists(reference, ignored)) return {reference};  // an existing file's name is not a pattern
  if (const PackagedClips* package = FindPackage(reference)) {
    std::vector<std::string> files = FilesMatching(FileOf(reference));
    for (std::string& file : files) file = std::string(package->prefix) + std::filesystem::path(file).stem().string();
    return files;
  }
  if (std::vector<std::string> files = FilesMatching(reference); !files.empty()) return files;
  const SplitReference split = Split(reference);
  if (!split.animation) return {};
  if (std::filesystem::exists(split.path, ignored)) return {reference};
  std::vector<std::string> files = FilesMatching(split.path);
  for (std::string& match : files) match += "#" + *split.animation;
  return files;
}

}  // namespace

Result<BuiltinClip> LoadBuiltinClip(const std::string& name, const Place& place) {
  const std::vector<std::string> songs = BuiltinSongNames();
  if (std::ranges::find(songs, name) != songs.end()) {
    auto song = LoadBuiltinSong(name);
    if (!song) return Fail(place, "{}", song.error().message);
    return BuiltinClip{std::move(song->motion), std::nullopt};
  }
  auto move = LoadBuiltinMove(name);
  if (!move) {
    // LoadBuiltinMove suggests only moves and acts, but the user may have meant a song.
    const std::string nearest = NearestName(name, songs);
    return Fail(place, "{}; songs: {}{}", move.error().message, Join(songs),
                nearest.empty() ? "" : " (did you mean '" + nearest + "'?)");
  }
  BuiltinClip clip{move->motion, std::nullopt};
  if (!move->key_poses.empty()) clip.move = std::move(*move);
  return clip;
}

Result<std::vector<std::string>> ExpandReference(const std::string& reference, const Place& place, std::size_t most) {
  const bool is_builtin = reference.starts_with(kBuiltinPrefix);
  std::vector<std::string> found = is_builtin ? BuiltinsOf(reference) : FilesOf(reference);
  if (const PackagedClips* package = FindPackage(reference); found.empty() && package != nullptr) {
    return Fail(place, "no clip matches '{}'; the clips {} are part of the package {}, in the folder {}", reference,
                package->prefix, package->package, package->folder);
  }
  if (found.empty()) {
    return Fail(place,
                "no clip matches '{}'; allowed: builtin:NAME, assimp:NAME, a motion file, file.glb#ANIMATION, or "
                "a pattern such "
                "as 'mocap/*.bvh'",
                reference);
  }
  if (found.size() > most) return Fail(place, "'{}' matches more than {} clips", reference, most);
  for (const std::string& file : found) {
    if (!CheckUtf8(file, "")) return Fail(place, "{} has a name that is not UTF-8 text", Quote(file));
  }
  return found;
}

std::string FileOf(const std::string& reference) {
  const PackagedClips* package = FindPackage(reference);
  std::error_code ignored;
  if (package == nullptr || std::filesystem::exists(reference, ignored)) return reference;
  return std::string(package->folder) + reference.substr(package->prefix.size()) + std::string(package->ending);
}

SplitReference Split(const std::string& reference) {
  std::error_code ignored;
  if (std::filesystem::exists(reference, ignored)) return {reference, std::nullopt};
  // The names of files and of animations may contain '#'. Try each '#' as the separator, until the part before it is an
  // existing file.
  for (std::size_t hash = reference.rfind('#'); hash != std::string::npos && hash > 0;
       hash = reference.rfind('#', hash - 1)) {
    std::string path = reference.substr(0, hash);
    if (std::filesystem::exists(path, ignored)) return {std::move(path), reference.substr(hash + 1)};
  }
  const std::size_t hash = reference.find('#');
  if (hash == std::string::npos) return {reference, std::nullopt};
  return {reference.substr(0, hash), reference.substr(hash + 1)};
}

Result<std::vector<std::string>> ExpandReferences(const std::vector<std::string>& references, std::size_t most) {
  std::vector<std::string> all;
  for (const std::string& reference : references) {
    ASSIGN_OR_RETURN(auto expanded, ExpandReference(reference, {}, most));
    all.insert(all.end(), expanded.begin(), expanded.end());
    if (all.size() > most) return Fail({}, "more than {} clips", most);
  }
  return all;
}

}  // namespace etude
