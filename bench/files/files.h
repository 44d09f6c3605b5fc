#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "bench/files/json.h"
#include "engine/base/result.h"

namespace etude {

/// Puts `bytes` at `path`, whole or not at all: written beside it first, then renamed. Makes the folder
/// it stands in. Fails naming the path and the system's reason.
Result<void> WriteFileAtomically(const std::filesystem::path& path, std::string_view bytes);

/// Puts one JSON value and a line end at `path`, whole or not at all.
Result<void> SaveJson(const std::filesystem::path& path, const Json& json);

/// Names the file beside `path` that is written first and renamed to `path` when it is whole.
std::filesystem::path TemporaryName(const std::filesystem::path& path);

/// Makes a folder and those above it. Fails naming it.
Result<void> MakeFolder(const std::filesystem::path& folder);

/// Gives the finished file its real name; on failure removes it and names the path.
Result<void> RenameFinished(const std::filesystem::path& temporary, const std::filesystem::path& path);

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

/// Larger files are refused before memory is taken.
constexpr std::uintmax_t kLargestFile = std::uintmax_t{2} << 30;

/// Reads all bytes of a file of at most kLargestFile. Fails naming the path.
Result<std::string> ReadWholeFile(const std::filesystem::path& path);

/// Hands a file of any size to `use`, at most 256 KiB at a time. Fails naming the path.
Result<void> ReadInChunks(const std::filesystem::path& path, const std::function<void(std::string_view)>& use);

/// Hands a file to `use` line by line, without the lines' ends. Stops at the first complaint, and fails with it.
Result<void> ForEachLine(const std::filesystem::path& path,
                         const std::function<Result<void>(std::string_view line, const Place& place)>& use);

/// Returns once what a file holds is on its disk, so that a power cut cannot take it. Fails naming the file.
Result<void> SyncFile(const std::filesystem::path& path);

/// Returns once a folder's own entries, the names that it holds, are on its disk: a new file's name is only safe then.
Result<void> SyncFolder(const std::filesystem::path& folder);

/// Returns once the entries of all folders above a folder are on their disks, as far as they may be opened, so that the
/// folder itself is there after a power cut.
Result<void> SyncPathTo(const std::filesystem::path& folder);

/// Returns once every file and folder below a folder, and the folder itself, are on their disks.
Result<void> SyncTree(const std::filesystem::path& folder);

}  // namespace etude
