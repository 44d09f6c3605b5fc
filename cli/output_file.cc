#include "cli/output_file.h"

#include <fmt/core.h>

#include <filesystem>

#include "engine/base/utf8.h"

namespace etude {

Result<void> CheckOutput(const std::string& path, bool overwrite, std::string_view ending) {
  namespace fs = std::filesystem;
  if (path.empty()) return {};
  if (!path.ends_with(ending)) return Fail({path, 0, 0}, "has the wrong ending; allowed: {}", ending);
  std::error_code ignored;
  const fs::file_status there = fs::symlink_status(path, ignored);
  if (!fs::exists(there)) return {};
  if (fs::is_directory(path, ignored)) return Fail({path, 0, 0}, "is a folder; allowed: a file name");
  // Refuse devices and pipes: WriteFileAtomically would replace a device instead of sending data to it.
  if (!fs::is_regular_file(there) && !fs::is_symlink(there)) {
    return Fail({path, 0, 0}, "is a device, pipe or socket; allowed: the name of an ordinary file");
  }
  if (overwrite) return {};
  return Fail({path, 0, 0}, "already exists; use --overwrite to replace this file");
}

void TellWritten(const std::string& path, std::FILE* stream) { fmt::print(stream, "written: {}\n", Visible(path)); }

}  // namespace etude
