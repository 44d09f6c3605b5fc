#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/run/cell_line.h"
#include "bench/run/plan.h"
#include "io/files/file_path.h"
#include "io/files/temporary_folder.h"
#include "io/process/clock.h"

namespace etude {

/// Stores where the lines of finished cells are, by the cell's number in the plan of a run or shard. Lines stay on the
/// disk until they are read, so runs of any size fit into memory.
class CellTable {
 public:
  explicit CellTable(std::size_t cells) : places_(cells) {}

  std::size_t size() const { return places_.size(); }
  bool Has(std::size_t cell) const { return places_[cell].length > 0; }
  std::vector<bool> Done() const;

  /// Adds a file that contains lines of cells. Returns the file's number, which is the argument `file` of Put.
  std::uint32_t AddFile(const FilePath& file);
  void Put(std::size_t cell, std::uint32_t file, std::uint64_t offset, std::size_t length);
  /// Stores the line of a cell in memory.
  void Put(std::size_t cell, std::string line);

  /// Reads a cell, which must have a line. Reading is fast if cells are read in roughly the order of their lines.
  Result<FinishedCell> Read(std::size_t cell, const Plan& plan);
  /// Reads the line of a cell. The returned text is valid until the next call.
  Result<std::string_view> ReadLine(std::size_t cell);

 private:
  struct LinePlace {
    std::uint64_t offset = 0;  ///< offset in the file, or index in `lines_` for a line in memory
    std::uint32_t length = 0;  ///< length of the line, bytes; 0 = the cell has no line
    std::uint32_t file = 0;
  };
  /// A file, and the part of this file that was read last and is cached. This part begins at offset `begin` of the
  /// file.
  struct Source {
    FilePath file;
    std::uint64_t begin = 0;
    std::string part = {};
  };

  Result<void> ReadPart(Source& source, const LinePlace& place) const;
  /// Returns the file that holds a cell's line, for error messages.
  Place PlaceOf(std::size_t cell) const;

  std::vector<LinePlace> places_;
  std::vector<Source> sources_;
  std::vector<std::string> lines_;
};

/// The identity of a journal's run. Cells can be combined only if their runs have the same build, suite and seed.
struct JournalHead {
  std::string manifest;  ///< digest of manifest.json
  std::string build;     ///< digest of the program
  Shard shard;
};

/// The maximum age and size of lines that are not yet synchronised to the disk. When either limit is reached, the
/// journal must be synchronised.
struct JournalLag {
  double seconds = 1;
  double mebibytes = 1;
};

/// The append-only record of a run in progress, and of a finished shard. It is a file of JSON Lines. It begins with two
/// copies of the head, because no line can be read without the head. Then comes one line per cell (cell_line.h), in
/// order of completion. Each line is written immediately; lines are synchronised to the disk in groups. If outside
/// programs measure a cell, the cell has two lines: an answered line with its motion, and a finished line.
class Journal {
 public:
  static Result<Journal> Begin(const std::filesystem::path& folder, const JournalHead& head,
                               const JournalLag& sync = {});
  /// Continues a journal that `ReadJournal` has read. An incomplete last line is cut off.
  static Result<Journal> Continue(const std::filesystem::path& folder, const JournalLag& sync = {});

  /// Appends the line of a cell (cell_line.h), and returns its offset in the file.
  Result<std::uint64_t> Append(std::string_view line);
  /// Returns true if a limit of JournalLag has been reached.
  bool IsSyncDue() const;
  Result<void> Sync();

 private:
  Journal(FilePath path, Descriptor file, const JournalLag& sync)
      : path_(std::move(path)), file_(std::move(file)), sync_(sync) {}
  Result<void> Write(std::string_view lines);

  FilePath path_;
  Descriptor file_;
  JournalLag sync_;
  std::uint64_t end_ = 0;  ///< size of the file, bytes
  std::size_t unsynced_bytes_ = 0;
  Clock::time_point synced_at_ = Clock::now();
};

Result<JournalHead> ReadJournalHead(const std::filesystem::path& folder);

struct JournalContent {
  JournalHead head;
  /// Numbers, from 1, of the lines that are ignored because they were changed or are duplicates.
  std::vector<int> damaged;
  std::size_t cells = 0, cells_ok = 0;
  std::size_t answered = 0;  ///< number of cells that are answered but not yet measured
};

/// Reads the finished cells of a journal into `cells`. Unless `answered` is null, reads the answered lines into
/// `answered`, also those of cells with a finished line. Both tables have one entry per cell of `plan`. If the last
/// line is incomplete, because the process was killed, it is ignored. If a line was changed (a flipped bit, an edit),
/// only its own cell is lost. If a cell has two lines of one kind, the second is ignored. Fails, with file and line, at
/// a valid line whose cell is not in the plan or shard.
Result<JournalContent> ReadJournal(const std::filesystem::path& folder, const Plan& plan, CellTable& cells,
                                   CellTable* answered = nullptr);

/// Stores lines of cells in a temporary file, to save memory. The file is created with the first line and exists as
/// long as this object.
class TemporaryLines {
 public:
  explicit TemporaryLines(std::size_t cells) : cells_(cells) {}
  Result<void> Add(std::size_t cell, std::string_view line);
  CellTable& cells() { return cells_; }

 private:
  CellTable cells_;
  std::optional<TemporaryFolder> folder_;
  std::optional<Journal> journal_;  ///< the journal in `folder_`; it is file 0 of `cells_`
};

}  // namespace etude
