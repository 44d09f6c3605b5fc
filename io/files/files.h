#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "engine/base/result.h"
#include "io/files/file_path.h"
#include "io/files/json.h"

namespace etude {

/// The moment at which a finished file is on its disk, name and all, so that a power cut cannot take it.
enum class OnDisk {
  kAtOnce,  ///< before the call returns
  kLater,   ///< when the caller synchronises the folder (SyncTree); or never, of what is temporary
};

/// Puts `bytes` at `path`, whole or not at all: written beside it first, then renamed, which replaces a link instead of
/// following it. Makes the folder it stands in. Fails as FileSpot::Find does, naming the path and the system's reason.
Result<void> WriteFileAtomically(const FilePath& path, std::string_view bytes, OnDisk when = OnDisk::kAtOnce);

/// Puts one JSON value and a line end at `path`, whole or not at all.
Result<void> SaveJson(const FilePath& path, const Json& json, OnDisk when = OnDisk::kAtOnce);

/// Names the file beside `path` that is written first and renamed to `path` when it is whole. While another process
/// writes the same file, it is another name.
std::filesystem::path TemporaryName(const std::filesystem::path& path);

/// The file beside its place that becomes another when it is whole, and goes when it is not finished. It is locked, so
/// that two processes that write the same file have two; what a killed one has left is used by the next.
class PartialFile {
 public:
  /// Makes the folder it stands in, and an empty file. Fails as WriteFileAtomically does.
  static Result<PartialFile> Claim(const FilePath& path);
  PartialFile() = default;
  PartialFile(PartialFile&& other) noexcept { *this = std::move(other); }
  PartialFile& operator=(PartialFile&& other) noexcept;
  ~PartialFile();

  const FilePath& path() const { return path_; }  ///< that it will have
  int file() const { return file_; }              ///< open for writing; −1 once it is finished
  /// Gives the file its name.
  Result<void> Finish(OnDisk when = OnDisk::kAtOnce);
  tl::unexpected<Error> Failure() const;
  /// Fails when the file cannot become longer: another program that was to write it has then met the same.
  Result<void> CheckRoom() const;

 private:
  FilePath path_ = "";
  FileSpot spot_;     ///< of `path_`
  std::string name_;  ///< in the spot's folder, as long as it is not finished
  int file_ = -1;
  bool made_folder_ = false;
};

/// A file that is written bit by bit and has its name only once it is whole.
class AtomicFile {
 public:
  /// Fails like PartialFile.
  static Result<AtomicFile> Begin(const FilePath& path);

  Result<void> Write(std::string_view bytes);
  /// Puts bytes in the place of some that were written.
  Result<void> Overwrite(std::uint64_t offset, std::string_view bytes);
  /// Gives the file its name.
  Result<void> Finish(OnDisk when = OnDisk::kAtOnce);

 private:
  Result<void> Flush();

  PartialFile partial_;
  std::string unwritten_;
};

/// Larger files are refused before memory is taken.
constexpr std::uintmax_t kMaxFileBytes = std::uintmax_t{2} << 30;

/// Reads all bytes of a file of at most `limit` bytes. Fails as OpenFile does.
Result<std::string> ReadWholeFile(const FilePath& path, std::uintmax_t limit = kMaxFileBytes);

/// Hands a file of any size to `use`, at most 256 KiB at a time. Fails as OpenFile does.
Result<void> ReadInChunks(const FilePath& path, const std::function<void(std::string_view)>& use);

/// Reads a file of any size line by line.
class FileLines {
 public:
  /// Fails as OpenFile does.
  static Result<FileLines> Open(const FilePath& path);

  /// Puts the next line into `line`, without its end. False when there is none, or when reading fails.
  Result<bool> Next(std::string& line);
  /// True if the last line had an end, and was not cut off there.
  bool had_end() const { return had_end_; }

 private:
  FileLines(const FilePath& path, Descriptor file) : path_(path), file_(std::move(file)) {}

  FilePath path_;
  Descriptor file_;
  std::string part_;  ///< of the file
  std::size_t at_ = 0;
  bool had_end_ = false;
};

/// Hands a file to `use` line by line, without the lines' ends. Stops at the first complaint, and fails with it.
Result<void> ForEachLine(const FilePath& path,
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

/// Locks an open file or folder against other processes until it is closed. False when another holds it, or when it no
/// longer has this name; true also on file systems that know no locks.
bool LockUnlessTaken(int file, const std::filesystem::path& name);

}  // namespace etude
