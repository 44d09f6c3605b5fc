#pragma once

#include <filesystem>
#include <fstream>
#include <string_view>

#include "io/files/temporary_folder.h"
#include "tests/fuzz/readers/target.h"

namespace etude::fuzz {

/// Where readers of files find what they are to read; soaks put it into memory ($TMPDIR).
class Folder {
 public:
  Folder() : folder_(std::move(TemporaryFolder::Make("fuzz").value())) {}

  const std::filesystem::path& path() const { return folder_.path(); }
  /// The path of a file that holds these bytes now.
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
