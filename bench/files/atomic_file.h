#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "engine/base/result.h"

namespace etude {

/// A file that is written bit by bit and has its name only once it is whole: until then it stands beside its place, and
/// goes when it is not finished.
class AtomicFile {
 public:
  /// Makes the folder it stands in. Fails, as everything here, naming the path and the system's reason.
  static Result<AtomicFile> Begin(const std::filesystem::path& path);
  AtomicFile(AtomicFile&& other) noexcept;
  AtomicFile& operator=(AtomicFile&& other) noexcept;
  ~AtomicFile();

  Result<void> Write(std::string_view bytes);
  /// Puts bytes in the place of some that were written.
  Result<void> Overwrite(std::uint64_t offset, std::string_view bytes);
  /// Gives the file its name.
  Result<void> Finish();

 private:
  AtomicFile(std::filesystem::path path, int file) : path_(std::move(path)), file_(file) {}
  Result<void> Flush();
  tl::unexpected<Error> Failure();

  std::filesystem::path path_;
  int file_ = -1;  ///< −1 once it is finished or given up
  std::string unwritten_;
};

}  // namespace etude
