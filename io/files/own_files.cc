#include "io/files/own_files.h"

#include <system_error>

namespace etude {

namespace fs = std::filesystem;

fs::path ThisProgram() {
  std::error_code error;
  return fs::read_symlink("/proc/self/exe", error);
}

fs::path FolderWith(const fs::path& what, const fs::path& from) {
  std::error_code error;
  for (fs::path above = from; !above.empty(); above = above.parent_path()) {
    for (const fs::path& folder : {above / "share/etude", above}) {
      if (fs::exists(folder / what, error)) return folder;
    }
    if (!above.has_relative_path()) break;
  }
  return {};
}

}  // namespace etude
