#pragma once

#include <filesystem>

namespace etude {

/// Returns the path of the running program.
std::filesystem::path ThisProgram();

/// Returns the folder with the files that come with Etude, such as scenarios: the first `share/etude` (installed) or
/// folder (a clone of the repository) in and above the folder `from` that contains the path `what`. Returns "" if there
/// is none.
std::filesystem::path FolderWith(const std::filesystem::path& what,
                                 const std::filesystem::path& from = ThisProgram().parent_path());

}  // namespace etude
