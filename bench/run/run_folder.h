#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "bench/run/supervisor.h"

namespace etude {

/// The folder to write into: `path`, or one that holds nothing but a run when that may be replaced.
/// Anything else is refused and left alone.
Result<std::filesystem::path> ChooseFolder(const std::filesystem::path& path, bool overwrite);

/// A result folder that this run alone writes into, emptied of an older run. One that ends before any
/// world did takes the folder away again, if it made it.
class RunFolder {
 public:
  /// Makes the folder, locks it against other runs and empties it.
  static Result<RunFolder> Claim(const std::filesystem::path& path);
  RunFolder(RunFolder&& other) noexcept;
  ~RunFolder();

  /// From now on there is something in it worth keeping.
  void Keep() { is_ours_ = false; }

 private:
  RunFolder(std::filesystem::path path, bool made, int lock) : path_(std::move(path)), is_ours_(made), lock_(lock) {}

  std::filesystem::path path_;
  bool is_ours_;  ///< made by this run, and nothing in it yet that is worth keeping
  int lock_;      ///< the lock ends with the process, however that ends
};

/// The append-only record of a run that is under way: a line per world, flushed at once.
class Journal {
 public:
  explicit Journal(const std::filesystem::path& folder);

  Result<void> Append(const WorldAnswer& answer);
  /// The run is whole: its rows stand elsewhere.
  void Remove();

 private:
  std::filesystem::path path_;
  std::ofstream out_;
};

}  // namespace etude
