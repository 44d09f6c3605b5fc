#include "bench/outside/program_view.h"

#include <algorithm>

#include "io/process/fence.h"

namespace etude {
namespace {

namespace fs = std::filesystem;

/// Returns the absolute path without a slash at its end.
fs::path Whole(const fs::path& path) {
  std::error_code error;
  const fs::path whole = fs::absolute(path, error).lexically_normal();
  return whole.has_filename() ? whole : whole.parent_path();
}

}  // namespace

ProgramView ViewOf(const std::vector<std::string>& command, const std::vector<std::string>& files) {
  ProgramView view;
  std::error_code error;
  for (const std::string& file : files) view.shown.push_back(Whole(file));
  for (const std::string& word : command) {
    // A word without '/' is a path only if it is a file: a folder may have the same name by chance.
    const bool is_file = fs::is_regular_file(word, error);
    if (!is_file && (word.find('/') == std::string::npos || !fs::exists(word, error))) {
      view.command.push_back(word);
      continue;
    }
    const fs::path path = Whole(word);
    view.command.push_back(path.string());
    if (!is_file || Fence::IsOfSystem(path)) continue;
    const fs::path folder = path.parent_path();
    // The Python of a virtual environment is a link: it cannot be a mount point, and its folder shows it already.
    const bool is_shown = fs::is_symlink(path, error) && std::ranges::any_of(view.shown, [&](const fs::path& one) {
                            return std::ranges::mismatch(one, path).in1 == one.end();
                          });
    if (is_shown) continue;
    view.shown.push_back(view.shown.empty() && !Fence::HoldsScratch(folder) ? folder : path);
  }
  for (const fs::path& path : view.shown) {
    if (view.start.empty() && fs::is_directory(path, error)) view.start = path;
  }
  return view;
}

fs::path PythonFolder() {
  std::error_code error;
  const auto holds_package = [&](const fs::path& folder) { return fs::exists(folder / "etude/__init__.py", error); };
  fs::path above = fs::read_symlink("/proc/self/exe", error).parent_path();
  if (const fs::path installed = above.parent_path() / "share/etude/python"; holds_package(installed)) return installed;
  for (; above.has_relative_path(); above = above.parent_path()) {
    if (holds_package(above / "python")) return above / "python";
  }
  return {};
}

}  // namespace etude
