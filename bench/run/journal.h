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

/// The finished cells of a run or of a shard, by their number in the plan: of each, where its line stands. What the
/// lines say stays on the disk until it is asked for, so that a run of any size fits into memory.
class CellTable {
 public:
  explicit CellTable(std::size_t cells) : places_(cells) {}

  std::size_t size() const { return places_.size(); }
  bool Has(std::size_t cell) const { return places_[cell].length > 0; }
  std::vector<bool> Done() const;

  /// A file that holds lines of cells; what stands for it in Put.
  std::uint32_t AddFile(const FilePath& file);
  void Put(std::size_t cell, std::uint32_t file, std::uint64_t offset, std::size_t length);
  /// A line that stands in no file.
  void Put(std::size_t cell, std::string line);

  /// The entry of a cell that is there. Quick when cells are asked for in about the order in which they stand.
  Result<FinishedCell> Read(std::size_t cell, const Plan& plan);
  /// Its line, until another is asked for.
  Result<std::string_view> ReadLine(std::size_t cell);

 private:
  struct LinePlace {
    std::uint64_t offset = 0;  ///< in the file, or the place in `lines_`
    std::uint32_t length = 0;  ///< 0 = there is none
    std::uint32_t file = 0;
  };
  /// A file, and the part of it that was read last.
  struct Source {
    FilePath file;
    std::uint64_t begin = 0;
    std::string part = {};
  };

  Result<void> ReadPart(Source& source, const LinePlace& place) const;
  /// The file that a cell's line stands in, for complaints.
  Place PlaceOf(std::size_t cell) const;

  std::vector<LinePlace> places_;
  std::vector<Source> sources_;
  std::vector<std::string> lines_;
};

/// The identity of a journal's run: only cells of the same build, suite and seed can stand together.
struct JournalHead {
  std::string manifest;  ///< digest of manifest.json
  std::string build;     ///< digest of the program
  Shard shard;
};

/// The limits of how far behind the disk may be: whichever comes first.
struct JournalLag {
  double seconds = 1;
  double mebibytes = 1;
};

/// The append-only record of a run that is under way, and all that is left of a finished shard: JSON Lines, a
/// head (twice, because everything hangs on it) and then one line per cell (cell_line.h) in order of completion, each
/// written at once and synchronised in groups. A cell that other programs measure has two: the answered one, with its
/// motion, and the finished one.
class Journal {
 public:
  /// Begins a journal.
  static Result<Journal> Begin(const std::filesystem::path& folder, const JournalHead& head,
                               const JournalLag& sync = {});
  /// Goes on with a journal that `ReadJournal` has read; a last line that was torn is cut off.
  static Result<Journal> Continue(const std::filesystem::path& folder, const JournalLag& sync = {});

  /// Appends the line of a cell (cell_line.h); returns where in the file it stands.
  Result<std::uint64_t> Append(std::string_view line);
  /// True if the disk is as far behind as it may be.
  bool IsSyncDue() const;
  /// Returns once every line that was appended is on the disk.
  Result<void> Sync();

 private:
  Journal(FilePath path, Descriptor file, const JournalLag& sync)
      : path_(std::move(path)), file_(std::move(file)), sync_(sync) {}
  Result<void> Write(std::string_view lines);

  FilePath path_;
  Descriptor file_;
  JournalLag sync_;
  std::uint64_t end_ = 0;  ///< of the file
  std::size_t unsynced_bytes_ = 0;
  Clock::time_point synced_at_ = Clock::now();
};

/// Reads the head alone.
Result<JournalHead> ReadJournalHead(const std::filesystem::path& folder);

struct JournalContent {
  JournalHead head;
  std::vector<int> damaged;  ///< numbers, from 1, of lines that do not count: not as written, or of a cell that has one
  std::size_t cells = 0, cells_ok = 0;
  std::size_t answered = 0;  ///< other cells, which have yet to be measured
};

/// Puts the finished cells of a journal into `cells`, and those that were answered into `answered`, unless it is null
/// (both have one place per cell of `plan`). A last line without its end is what a kill
/// leaves, and ignored; a line that is not as it was written (a flipped bit, something that somebody wrote into it)
/// costs its cell alone, and a second line of a cell only itself. A good line that is no cell of the plan or of the
/// shard is refused with file:line.
Result<JournalContent> ReadJournal(const std::filesystem::path& folder, const Plan& plan, CellTable& cells,
                                   CellTable* answered = nullptr);

/// Lines of cells in a temporary file, for those that only have to outlast this process's memory.
class TemporaryLines {
 public:
  /// Has one place per cell. The file is made for the first line.
  explicit TemporaryLines(std::size_t cells) : cells_(cells) {}
  /// Fails with an error of this machine where the file cannot be made.
  Result<void> Add(std::size_t cell, std::string_view line);
  CellTable& cells() { return cells_; }

 private:
  CellTable cells_;
  std::optional<TemporaryFolder> folder_;
  std::optional<Journal> journal_;  ///< in it, the first file of `cells_`
};

}  // namespace etude
