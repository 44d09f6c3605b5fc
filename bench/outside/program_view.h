#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace etude {

/// A program as it is started, with or without a sandbox, and the files that a sandbox shows it beside the system.
struct ProgramView {
  std::vector<std::string> command;          ///< program and arguments; files are absolute paths
  std::vector<std::filesystem::path> shown;  ///< absolute paths of files and folders shown to it
  std::filesystem::path start;               ///< its working folder; "" = a scratch folder
};

/// Makes the view of `command`: a program as returned by FindProgram, and its arguments. The program is shown `files`
/// and the files that its command names. Without `files` it is shown the folder of its executable or, if that belongs
/// to the system, of its script (the first file among the arguments). Its working folder is the first shown folder.
ProgramView ViewOf(const std::vector<std::string>& command, const std::vector<std::string>& files);

/// Returns the files and folders that a program may lack if it did not start in a fence. Candidates are the target of
/// its link, the paths in its text if it is a script, and the paths in `words`, its last output; those that the fence
/// does not show are returned. Each is replaced by the folder of the installation that contains it. Empty = none known.
std::vector<std::filesystem::path> FindUnseen(const ProgramView& view, std::string_view words);

/// Returns the key `files` that shows a program `unseen` in addition to what it sees: "files: [mine, /home/me/venv]".
std::string FilesThatShow(const std::vector<std::filesystem::path>& unseen, const ProgramView& view);

/// Returns the folder of Etude's Python package, which every program is shown and which is in its PYTHONPATH:
/// `share/etude/python` beside an installed program, else `python` in a folder above it; "" if there is none.
std::filesystem::path PythonFolder();

}  // namespace etude
