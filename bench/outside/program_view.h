#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace etude {

/// A program as it is started, with or without a sandbox, and the files that a sandbox shows it beside the system.
struct ProgramView {
  std::vector<std::string> command;          ///< program and arguments; files are absolute paths
  std::vector<std::filesystem::path> shown;  ///< absolute paths of files and folders shown to it
  std::filesystem::path start;               ///< its working folder; "" = a scratch folder
};

/// Makes the view of `command`, a program as FindProgram returns it and its arguments. It is shown the files that it
/// names, and `files`; without `files`, the folder of its own executable or, if that belongs to the system, of its
/// script (the first file it names). Its working folder is the first folder that it is shown.
ProgramView ViewOf(const std::vector<std::string>& command, const std::vector<std::string>& files);

/// Returns the folder of Etude's Python package, which every program is shown and which is in its PYTHONPATH:
/// `share/etude/python` beside an installed program, else `python` in a folder above it; "" if there is none.
std::filesystem::path PythonFolder();

}  // namespace etude
