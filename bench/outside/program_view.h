#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"

namespace etude {

/// The command of a program, and the files that a sandbox shows the program in addition to the system's files. The
/// command is the same with and without a sandbox.
struct ProgramView {
  std::vector<std::string> command;          ///< program and arguments; files are absolute paths
  std::vector<std::filesystem::path> shown;  ///< absolute paths of the files and folders that the sandbox shows
  std::filesystem::path start;               ///< the program's working folder; "" = a scratch folder
};

/// Makes the view of `command`: a program as returned by FindProgram, and its arguments. The sandbox shows `files` and
/// the files that the command names. If `files` is empty, the sandbox shows the whole folder of the first of these
/// files that does not belong to the system: of the program's executable, or else of its script. It shows only the
/// file if this folder contains a scratch folder. The program's working folder is the first folder shown.
ProgramView ViewOf(const std::vector<std::string>& command, const std::vector<std::string>& files);

/// Returns the files and folders that a program may need but that its sandbox does not show. Call it if the program
/// failed to start in the sandbox. Candidates are the file pyvenv.cfg if the program belongs to a Python virtual
/// environment, the target of the program if it is a link, the paths in its text if it is a script, and the paths in
/// `words`, its last output. Candidates that do not exist, that the sandbox shows, or that are too wide to be shown are
/// left out; any other candidate is replaced by the folder of its installation. Empty = nothing is known to be missing.
std::vector<std::filesystem::path> FindUnseen(const ProgramView& view, std::string_view words);

/// Returns the text of a key `files` with which the sandbox shows a program `unseen` in addition to the files shown
/// already: "files: [mine, /home/me/venv]". If `as_options` is true, returns options: "--files mine --files
/// /home/me/venv".
std::string FilesThatShow(const std::vector<std::filesystem::path>& unseen, const ProgramView& view,
                          bool as_options = false);

/// Fails if the command contains the path of a program or the name of a script, but no such file exists. The error's
/// place is the word's entry in `places`, if there is one.
Result<void> CheckNames(const std::vector<std::string>& command, const std::vector<Place>& places = {});

/// Returns the folder of Etude's Python package: `share/etude/python` of an installation, else `python` in a folder
/// above the running program; "" if there is none. Every outside program has this folder in its PYTHONPATH, and its
/// sandbox shows the package in it.
std::filesystem::path PythonFolder();

}  // namespace etude
