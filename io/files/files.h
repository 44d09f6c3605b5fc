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

/// The time at which a finished file and its name are synchronised to disk (fsync). Only a synchronised file survives a
/// power cut.
enum class OnDisk {
  kAtOnce,  ///< synchronised before the call returns
  kLater,   ///< synchronised by the caller with SyncTree, or never for temporary files
};

/// Writes a file completely or not at all: first under a temporary name beside `path`; then the temporary file is
/// renamed. The rename replaces a link instead of following it. Creates the folder. Fails as FileSpot::Find does; also
/// fails, with the path and the system's reason, if the file cannot be written.
Result<void> WriteFileAtomically(const FilePath& path, std::string_view bytes, OnDisk when = OnDisk::kAtOnce);

/// Writes one JSON value and a line end with WriteFileAtomically. Also fails on NaN and infinity (WriteJson).
Result<void> SaveJson(const FilePath& path, const Json& json, OnDisk when = OnDisk::kAtOnce);

/// Returns the temporary name under which `path` is written if no other process writes the same file; otherwise the
/// name also contains a number.
std::filesystem::path TemporaryName(const std::filesystem::path& path);

/// A file that is written under a temporary name, beside its final path. Finish renames the file; without Finish, the
/// destructor deletes it. Two processes that write the same path have different temporary files, because each locks
/// its own. The next process reuses the temporary file of a killed process.
class PartialFile {
 public:
  /// Creates the folder and an empty temporary file. Fails as WriteFileAtomically does.
  static Result<PartialFile> Claim(const FilePath& path);
  PartialFile() = default;
  PartialFile(PartialFile&& other) noexcept { *this = std::move(other); }
  PartialFile& operator=(PartialFile&& other) noexcept;
  ~PartialFile();

  const FilePath& path() const { return path_; }  ///< the final path
  int file() const { return file_; }              ///< descriptor, open for writing; −1 after Finish
  /// Renames the temporary file to the final path.
  Result<void> Finish(OnDisk when = OnDisk::kAtOnce);
  /// Returns the error "cannot write this file" with the reason in errno.
  tl::unexpected<Error> Failure() const;
  /// Checks by a write whether the file can grow; fails with the system's reason, for instance a full disk. A caller
  /// uses this to learn why another program (an encoder) could not write the file.
  Result<void> CheckRoom() const;

 private:
  FilePath path_ = "";
  FileSpot spot_;     ///< the folder and name of `path_`
  std::string name_;  ///< the temporary name, in the same folder
  int file_ = -1;
  bool made_folder_ = false;
};

/// A PartialFile that is written in pieces, through a buffer.
class AtomicFile {
 public:
  /// Fails like PartialFile::Claim.
  static Result<AtomicFile> Begin(const FilePath& path);

  Result<void> Write(std::string_view bytes);
  /// Replaces bytes that were written before, from `offset` on.
  Result<void> Overwrite(std::uint64_t offset, std::string_view bytes);
  /// Writes the buffered bytes, and renames the temporary file to the final path.
  Result<void> Finish(OnDisk when = OnDisk::kAtOnce);

 private:
  Result<void> Flush();

  PartialFile partial_;
  std::string unwritten_;
};

/// The maximum size of a file that is read whole, bytes. A larger file is refused before memory is allocated.
constexpr std::uintmax_t kMaxFileBytes = std::uintmax_t{2} << 30;

/// Reads all bytes of a file of at most `limit` bytes. Fails as OpenFile does.
Result<std::string> ReadWholeFile(const FilePath& path, std::uintmax_t limit = kMaxFileBytes);

/// Calls `use` with consecutive parts of a file of any size, each at most 256 KiB. Fails as OpenFile does.
Result<void> ReadInChunks(const FilePath& path, const std::function<void(std::string_view)>& use);

/// Reads a file of any size line by line.
class FileLines {
 public:
  /// Fails as OpenFile does.
  static Result<FileLines> Open(const FilePath& path);

  /// Reads the next line into `line`, without the line end. Returns false at the end of the file.
  Result<bool> Next(std::string& line);
  /// Returns true if the last line read had a line end; without one, the file may have been cut off.
  bool had_end() const { return had_end_; }

 private:
  FileLines(const FilePath& path, Descriptor file) : path_(path), file_(std::move(file)) {}

  FilePath path_;
  Descriptor file_;
  std::string part_;    ///< the part of the file in memory
  std::size_t at_ = 0;  ///< position of the next byte in `part_`
  bool had_end_ = false;
};

/// Calls `use` with each line of a file, without line ends. Stops at the first error of `use` or of reading, and
/// returns this error.
Result<void> ForEachLine(const FilePath& path,
                         const std::function<Result<void>(std::string_view line, const Place& place)>& use);

/// Synchronises a file's contents to disk (fsync). Fails with the file's name.
Result<void> SyncFile(const std::filesystem::path& path);

/// Synchronises the entries of one folder. Only then does the name of a new file survive a power cut.
Result<void> SyncFolder(const std::filesystem::path& folder);

/// Synchronises the entries of all folders above a folder, as far as they can be opened. Only then does the folder
/// itself survive a power cut.
Result<void> SyncPathTo(const std::filesystem::path& folder);

/// Synchronises a folder and every file and folder below it.
Result<void> SyncTree(const std::filesystem::path& folder);

/// Locks an open file or folder against other processes, until this process closes it. Returns false if another process
/// has the lock, or if the file no longer has this name. Returns true on file systems without locks.
bool LockUnlessTaken(int file, const std::filesystem::path& name);

}  // namespace etude
