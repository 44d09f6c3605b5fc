#pragma once

#include <filesystem>
#include <string>

#include "engine/base/result.h"

namespace etude {

enum class FolderState {
  kFree,        ///< not there, empty, or left by a run or merge that was ended with nothing to go on with
  kUnfinished,  ///< holds a journal: of an interrupted run, of one under way, or of a shard
  kFinished,    ///< holds a whole run: host.json, which is written last, and no journal
};

/// Looks at what a folder holds. Something that is no run is refused: it is never written into.
Result<FolderState> LookAtFolder(const std::filesystem::path& path);

/// A result folder that this run alone writes into. One that ends before any cell did takes the folder away again, if
/// it made it.
class RunFolder {
 public:
  /// Makes the folder and locks it against other runs; empties it unless it is to be continued.
  static Result<RunFolder> Claim(const std::filesystem::path& path, bool keep_contents);
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

}  // namespace etude
