#include "io/clips/bids_files.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <system_error>

#include "engine/base/text.h"

namespace etude {
namespace {

namespace fs = std::filesystem;

/// Returns the number of entities of a file's name; nullopt if the file does not apply to a file with these entities.
std::optional<std::size_t> EntitiesOf(std::string_view name, std::string_view suffix,
                                      const std::vector<std::string_view>& allowed) {
  if (name == suffix) return 0;
  if (!name.ends_with(suffix) || name[name.size() - suffix.size() - 1] != '_') return std::nullopt;
  const auto entities = SplitAt(name.substr(0, name.size() - suffix.size() - 1), '_');
  const auto is_allowed = [&](std::string_view entity) { return std::ranges::find(allowed, entity) != allowed.end(); };
  return std::ranges::all_of(entities, is_allowed) ? std::optional(entities.size()) : std::nullopt;
}

/// Returns the path of the file in `folder` that applies; "" if there is none.
std::string FileIn(const fs::path& folder, std::string_view suffix, const std::vector<std::string_view>& allowed) {
  std::optional<std::size_t> most;
  std::string found;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const auto entities = EntitiesOf(entry->path().filename().string(), suffix, allowed);
    if (!entities || (most && *entities < *most)) continue;
    const std::string file = entry->path().string();
    if (most && *entities == *most && file > found) continue;  // so that the order of the folder does not matter
    most = entities;
    found = file;
  }
  return found;
}

}  // namespace

std::vector<std::string> FindBidsFiles(const std::string& path, std::string_view suffix) {
  constexpr int kMaxLevels = 4;
  const std::string name = fs::path(path).stem().string();
  const std::vector<std::string_view> entities = SplitAt(name, '_');
  std::vector<std::string> files;
  std::error_code error;
  fs::path folder = fs::path(path).parent_path();
  if (folder.empty()) folder = ".";
  for (int level = 0; level <= kMaxLevels; ++level) {
    if (const std::string file = FileIn(folder, suffix, entities); !file.empty()) files.insert(files.begin(), file);
    const fs::path whole = fs::canonical(folder, error);
    if (error || fs::exists(folder / "dataset_description.json", error) || whole == whole.root_path()) break;
    folder = whole.parent_path();
  }
  return files;
}

}  // namespace etude
