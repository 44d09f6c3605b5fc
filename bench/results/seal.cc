#include "bench/results/seal.h"

#include <map>
#include <nlohmann/json.hpp>

#include "bench/results/folder.h"
#include "engine/base/digest.h"
#include "engine/base/machine.h"
#include "io/files/files.h"
#include "io/files/json.h"

namespace etude {
namespace {

namespace fs = std::filesystem;

constexpr int kSealVersion = 1;

using Digests = std::map<std::string, std::string>;  // digests by path in the folder

bool IsSealed(const fs::path& from_folder) {
  const std::string first = from_folder.begin()->string();
  for (const char* name : {kSealFile, kSignedFile, kSignatureFile}) {
    if (first == name || first == TemporaryName(name)) return false;
  }
  return first != kJournalFile && first != kLockFile && !IsMadeFromResults(first);
}

Result<Digests> DigestsOf(const fs::path& folder) {
  Digests digests;
  std::error_code error;
  for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const fs::path name = entry->path().lexically_relative(folder);
    if (!IsSealed(name)) {
      entry.disable_recursion_pending();
    } else if (const fs::file_status status = entry->symlink_status(error); fs::is_regular_file(status)) {
      Digest digest;
      RETURN_IF_ERROR(ReadInChunks(Inside(folder) / name, [&](std::string_view bytes) { digest.Add(bytes); }));
      digests[name.generic_string()] = digest.Hex();
    } else if (!fs::is_directory(status)) {
      return Fail({entry->path().string()}, "is neither a file nor a folder; a run writes only files and folders");
    } else if (fs::is_empty(entry->path(), error)) {
      digests[name.generic_string() + "/"] = "empty";
    }
  }
  if (error) return CannotRead(folder.string(), "cannot be read", error.value());
  return digests;
}

Result<Digests> ReadSeal(const FilePath& path) {
  if (!Exists(path)) {
    return Fail({path.string()}, "is missing: either an older program wrote this run, or the seal was removed");
  }
  ASSIGN_OR_RETURN(const auto json, ReadJsonFile(path));
  try {
    if (json.at("version").get<int>() != kSealVersion) {
      return Fail({path.string()}, "found a seal of version {}; this program reads version {}",
                  json.at("version").dump(), kSealVersion);
    }
    if (json.size() != 3)
      return Fail({path.string()}, "is not a seal; allowed: only the keys format, version and files");
    return json.at("files").get<Digests>();
  } catch (const Json::exception& error) {
    return Fail({path.string()}, "is not a seal: {}", error.what());
  }
}

}  // namespace

bool IsMadeFromResults(std::string_view part) { return part == "report" || part == "video" || part == "blind"; }

Result<void> SealRun(const fs::path& folder) {
  ASSIGN_OR_RETURN(const auto digests, DigestsOf(folder));
  return SaveJson(Inside(folder) / kSealFile, {{"format", "etude-seal"}, {"version", kSealVersion}, {"files", digests}},
                  OnDisk::kLater);
}

Result<std::vector<std::string>> SealedNames(const fs::path& folder) {
  ASSIGN_OR_RETURN(const auto sealed, ReadSeal(Inside(folder) / kSealFile));
  std::vector<std::string> names;
  for (const auto& [name, digest] : sealed) {
    if (!name.ends_with('/')) names.push_back(name);
  }
  return names;
}

Result<void> CheckSeal(const fs::path& folder) {
  ASSIGN_OR_RETURN(const auto sealed, ReadSeal(Inside(folder) / kSealFile));
  ASSIGN_OR_RETURN(const auto found, DigestsOf(folder));
  for (const auto& [name, digest] : sealed) {
    const auto file = found.find(name);
    const Place place{(folder / name).string()};
    if (file == found.end()) return Fail(place, "is missing, although the run wrote it");
    if (file->second != digest) return Fail(place, "was changed after the run wrote it");
  }
  for (const auto& [name, digest] : found) {
    if (!sealed.contains(name)) return Fail({(folder / name).string()}, "was not written by the run");
  }
  return {};
}

}  // namespace etude
