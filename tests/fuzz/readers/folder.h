#pragma once

#include <filesystem>
#include <fstream>
#include <string_view>

#include "io/files/temporary_folder.h"
#include "tests/fuzz/readers/target.h"

namespace etude::fuzz {

/// A folder for a reader's files; soaks place it in memory ($TMPDIR).
class Folder {
 public:
  Folder() : folder_(std::move(TemporaryFolder::Make("fuzz").value())) {}

  const std::filesystem::path& path() const { return folder_.path(); }
  /// Writes a file with these bytes, and returns its path.
  std::filesystem::path With(std::string_view name, std::string_view bytes) const {
    const std::filesystem::path file = path() / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary | std::ios::trunc)
        .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    return file;
  }

 private:
  TemporaryFolder folder_;
};

}  // namespace etude::fuzz
