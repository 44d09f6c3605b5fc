#include "bench/run/canonical_names.h"

#include <filesystem>

namespace etude {
namespace {

namespace fs = std::filesystem;

fs::path TopOf(const fs::path& folder) {
  for (fs::path above = folder; above != above.parent_path(); above = above.parent_path()) {
    if (std::error_code none; fs::exists(above / ".git", none)) return above;
  }
  return {};
}

}  // namespace

std::map<std::string, std::string> CanonicalNames(const std::string& scenario_file,
                                                  const std::vector<std::string>& sources) {
  std::error_code error;
  const fs::path given = fs::absolute(scenario_file, error).lexically_normal().parent_path();
  const fs::path folder = fs::weakly_canonical(given, error);
  const fs::path top = TopOf(folder);
  std::map<std::string, std::string> names;
  for (const std::string& source : sources) {
    // As an include says it: from the scenario's folder, whatever links lead there.
    const fs::path from_folder = fs::absolute(source, error).lexically_normal().lexically_relative(given);
    const fs::path path = (folder / from_folder).lexically_normal();
    names[source] = (top.empty() ? path : path.lexically_relative(top)).generic_string();
  }
  return names;
}

}  // namespace etude
