#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace etude {

/// A program as it is started, alike with a fence and without, and what a fence shows it beside the system.
struct ProgramView {
  std::vector<std::string> command;          ///< the files that it names by absolute paths
  std::vector<std::filesystem::path> shown;  ///< absolute paths of files and folders
  std::filesystem::path start;               ///< the folder that it starts in; "" = a scratch folder
};

/// Makes the view of `command`, a program as FindProgram gives it and its arguments: it is shown the files that it
/// names, and `files`; where there are none, the folder of its own executable or, when that is the system's, of its
/// script (the first file it names). It starts in the first folder that it is shown.
ProgramView ViewOf(const std::vector<std::string>& command, const std::vector<std::string>& files);

/// The folder of Etude's Python package, which every program is shown and its PYTHONPATH leads to: `share/etude/python`
/// beside an installed program, else `python` in a folder above it; "" where there is none.
std::filesystem::path PythonFolder();

}  // namespace etude
