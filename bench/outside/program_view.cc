#include "bench/outside/program_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "engine/base/names.h"
#include "io/files/file_path.h"
#include "io/files/own_files.h"
#include "io/process/fence.h"

namespace etude {
namespace {

namespace fs = std::filesystem;

constexpr std::streamsize kMaxScriptBytes = 4096;
constexpr int kMaxLinks = 40;
/// The extensions of scripts. An argument with one of them must name an existing file; any other argument need not.
constexpr std::string_view kScriptEndings[] = {".py", ".sh", ".js", ".mjs", ".rb", ".pl", ".jl", ".R", ".lua", ".php"};

/// Returns the absolute, normalised path without a slash at its end.
fs::path Whole(const fs::path& path) {
  std::error_code error;
  const fs::path whole = fs::absolute(path, error).lexically_normal();
  return whole.has_filename() ? whole : whole.parent_path();
}

bool IsSeen(const fs::path& path, const ProgramView& view) {
  return Fence::IsOfSystem(path) ||
         std::ranges::any_of(view.shown, [&](const fs::path& one) { return IsWithin(path, one); });
}

/// Returns true if the sandbox must not show this folder as a whole: the root, a folder directly below / or /home, and
/// folders that contain a scratch folder.
bool IsTooWide(const fs::path& folder) {
  const fs::path above = folder.parent_path();
  return above == "/" || above == "/home" || folder == "/" || Fence::HoldsScratch(folder);
}

/// Returns the folder of the installation to which `path` belongs; the sandbox does not show `path`. Tries in this
/// order: the program's folder and the folder above that, if they contain `path`; if `path` is a folder `bin` or lies
/// in one, the folder above `bin`; the folder that contains `path`, or `path` if it is a folder. Leaves out folders
/// that are too wide (IsTooWide). Returns `path` if no folder is left.
fs::path InstallationOf(const fs::path& path, const fs::path& program) {
  fs::path common;
  for (auto [a, b] = std::pair(path.begin(), program.begin()); a != path.end() && b != program.end() && *a == *b;) {
    common /= *a++;
    ++b;
  }
  const fs::path own = program.parent_path();
  if ((common == own || common == own.parent_path()) && !IsTooWide(common)) return common;
  std::error_code error;
  const fs::path folder = fs::is_directory(path, error) ? path : path.parent_path();
  const fs::path above = folder.parent_path();
  if (folder.filename() == "bin" && !IsTooWide(above)) return above;
  return IsTooWide(folder) ? path : folder;
}

/// Adds a path to the list and removes the paths below it. Adds nothing if the list already contains the path or a
/// folder above it.
void AddWidest(const fs::path& path, std::vector<fs::path>& paths) {
  if (std::ranges::any_of(paths, [&](const fs::path& known) { return IsWithin(path, known); })) return;
  std::erase_if(paths, [&](const fs::path& known) { return IsWithin(known, path); });
  paths.push_back(path);
}

/// Returns the absolute paths that occur in a text.
std::vector<fs::path> PathsIn(std::string_view text) {
  constexpr std::string_view kEnds = " \t\r\n\"'`:;,=()[]{}<>|&$";
  std::vector<fs::path> found;
  for (std::size_t at = 0; (at = text.find('/', at)) != std::string_view::npos;) {
    const std::size_t end = std::min(text.find_first_of(kEnds, at), text.size());
    const bool is_start = at == 0 || text[at - 1] == '!' || kEnds.find(text[at - 1]) != std::string_view::npos;
    if (is_start && end - at > 1) found.push_back(Whole(std::string(text.substr(at, end - at))));
    at = end;
  }
  return found;
}

/// Returns the first 4 KiB of a script (a file that begins with #!); "" for any other file.
std::string TextOfScript(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string text(kMaxScriptBytes, '\0');
  file.read(text.data(), kMaxScriptBytes);
  text.resize(static_cast<std::size_t>(file.gcount()));
  return text.starts_with("#!") ? text : "";
}

}  // namespace

ProgramView ViewOf(const std::vector<std::string>& command, const std::vector<std::string>& files) {
  ProgramView view;
  std::error_code error;
  for (const std::string& file : files) view.shown.push_back(Whole(file));
  for (const std::string& word : command) {
    // A word without '/' counts as a path only if it is the name of a file, because a folder may have the same name by
    // chance.
    const bool is_file = fs::is_regular_file(word, error);
    if (!is_file && (word.find('/') == std::string::npos || !fs::exists(word, error))) {
      view.command.push_back(word);
      continue;
    }
    const fs::path path = Whole(word);
    view.command.push_back(path.string());
    if (!is_file || Fence::IsOfSystem(path)) continue;
    const fs::path folder = path.parent_path();
    // The Python of a virtual environment is a link, so it cannot be a mount point. The link is shown together with its
    // folder.
    const bool is_shown = fs::is_symlink(path, error) &&
                          std::ranges::any_of(view.shown, [&](const fs::path& one) { return IsWithin(path, one); });
    if (is_shown) continue;
    view.shown.push_back(view.shown.empty() && !Fence::HoldsScratch(folder) ? folder : path);
  }
  for (const fs::path& path : view.shown) {
    if (view.start.empty() && fs::is_directory(path, error)) view.start = path;
  }
  return view;
}

std::vector<fs::path> FindUnseen(const ProgramView& view, std::string_view words) {
  if (view.command.empty()) return {};
  std::error_code error;
  const fs::path program = view.command.front();
  std::vector<fs::path> named;
  // The Python of a virtual environment is a link out of its folder, and needs the file pyvenv.cfg of the environment.
  const fs::path environment = program.parent_path().parent_path();
  if (fs::exists(environment / "pyvenv.cfg", error)) named.push_back(environment / "pyvenv.cfg");
  fs::path target = program;
  for (int links = 0; links < kMaxLinks && fs::is_symlink(target, error); ++links) {
    target = Whole(target.parent_path() / fs::read_symlink(target, error));
    named.push_back(target);
  }
  // Collect the paths that occur in the script and in the last output.
  for (const std::string& text : {TextOfScript(target), std::string(words)})
    std::ranges::move(PathsIn(text), std::back_inserter(named));
  std::vector<fs::path> unseen;
  for (const fs::path& path : named) {
    if (!fs::exists(path, error) || IsSeen(path, view) || IsTooWide(path)) continue;
    AddWidest(InstallationOf(path, program), unseen);
  }
  return unseen;
}

std::string FilesThatShow(const std::vector<fs::path>& unseen, const ProgramView& view, bool as_options) {
  std::vector<fs::path> files;
  std::error_code error;
  for (const fs::path& path : view.shown) {
    const fs::path folder = fs::is_directory(path, error) ? path : path.parent_path();
    AddWidest(IsTooWide(folder) ? path : folder, files);
  }
  for (const fs::path& path : unseen) AddWidest(path, files);
  std::vector<std::string> words;
  for (const fs::path& path : files) words.push_back(path.string());
  return as_options ? "--files " + Join(words, " --files ") : fmt::format("files: [{}]", Join(words));
}

Result<void> CheckNames(const std::vector<std::string>& command, const std::vector<Place>& places) {
  std::error_code error;
  for (std::size_t i = 0; i < command.size(); ++i) {
    const std::string& word = command[i];
    const fs::path path = word;
    const bool is_text = i > 0 && (command[i - 1] == "-c" || command[i - 1] == "-e");
    const bool is_script = i > 0 && !is_text && !word.starts_with('-') &&
                           std::ranges::find(kScriptEndings, path.extension().string()) != std::end(kScriptEndings);
    if (fs::exists(path, error) || !(is_script || (i == 0 && word.find('/') != std::string::npos))) continue;
    std::vector<std::string> near;
    const fs::path folder = path.parent_path();
    for (fs::directory_iterator entry(folder.empty() ? "." : folder, error), end; !error && entry != end;
         entry.increment(error)) {
      near.push_back((folder / entry->path().filename()).string());
    }
    std::ranges::sort(near);
    const std::string nearest = NearestName(word, near);
    return Fail(i < places.size() ? places[i] : Place(), "there is no file '{}'{}", word,
                nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest));
  }
  return {};
}

fs::path PythonFolder() {
  const fs::path folder = FolderWith("python/etude/__init__.py");
  return folder.empty() ? folder : folder / "python";
}

}  // namespace etude
