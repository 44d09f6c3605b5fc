#include "bench/run/journal.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "bench/results/folder.h"
#include "engine/base/machine.h"
#include "io/files/files.h"

namespace etude {
namespace {

constexpr std::uint32_t kInMemory = std::numeric_limits<std::uint32_t>::max();
// Memory for the cached parts of all files together, bytes.
constexpr std::size_t kMemory = std::size_t{64} << 20;
constexpr std::size_t kMaxPartBytes = 1 << 20, kMinPartBytes = 1 << 14;

namespace fs = std::filesystem;

constexpr int kJournalVersion = 4;
constexpr int kHeads = 2;

Result<JournalHead> DecodeHead(const std::string& line, const Place& place) {
  ASSIGN_OR_RETURN(const auto json, ReadJson(line, place.file, place.line));
  JournalHead head;
  try {
    const int version = json.at("journal").get<int>();
    if (version != kJournalVersion) {
      return Fail(place, "found a journal of version {}; this program reads version {}", version, kJournalVersion);
    }
    head.manifest = json.at("manifest").get<std::string>();
    head.build = json.at("build").get<std::string>();
    const auto shard = ParseShard(json.at("shard").get<std::string>());
    if (!shard) return Fail(place, "{}", shard.error().message);
    head.shard = *shard;
  } catch (const Json::exception& error) {
    return Fail(place, "is not the header of a journal: {}", error.what());
  }
  return head;
}

/// The position of a cell's line in a journal file.
struct LineInFile {
  std::uint32_t file;
  std::uint64_t offset;
  std::size_t length;
};

/// Records the position of a cell's line in `cells`. Returns false if the cell already has a line. Fails if the cell is
/// not in the shard.
Result<bool> AddCell(const CellLineHead& head, const LineInFile& line, const Place& place, const Plan& plan,
                     const Shard& shard, CellTable& cells) {
  const std::size_t cell = head.cell;
  if (cell >= plan.cell_count() || !plan.IsIn(shard, plan.WorldOf(cell))) {
    return Fail(place, "found cell {}, which does not belong to shard {} of this run", cell, ToString(shard));
  }
  if (cells.Has(cell)) return false;
  cells.Put(cell, line.file, line.offset, line.length);
  return true;
}

}  // namespace

std::vector<bool> CellTable::Done() const {
  std::vector<bool> done;
  for (std::size_t cell = 0; cell < size(); ++cell) done.push_back(Has(cell));
  return done;
}

std::uint32_t CellTable::AddFile(const FilePath& file) {
  sources_.push_back({.file = file});
  return static_cast<std::uint32_t>(sources_.size() - 1);
}

void CellTable::Put(std::size_t cell, std::uint32_t file, std::uint64_t offset, std::size_t length) {
  places_[cell] = {offset, static_cast<std::uint32_t>(length), file};
}

void CellTable::Put(std::size_t cell, std::string line) {
  Put(cell, kInMemory, lines_.size(), line.size());
  lines_.push_back(std::move(line));
}

Result<FinishedCell> CellTable::Read(std::size_t cell, const Plan& plan) {
  ASSIGN_OR_RETURN(const auto line, ReadLine(cell));
  return DecodeCellLine(line, plan.IdentityOf(cell), PlaceOf(cell));
}

Place CellTable::PlaceOf(std::size_t cell) const {
  const std::uint32_t file = places_[cell].file;
  return file == kInMemory ? Place() : Place{sources_[file].file.string()};
}

Result<std::string_view> CellTable::ReadLine(std::size_t cell) {
  const LinePlace& place = places_[cell];
  if (place.file == kInMemory) return lines_[place.offset];
  Source& source = sources_[place.file];
  const auto has_line = [&] {
    return place.offset >= source.begin && place.offset + place.length <= source.begin + source.part.size();
  };
  if (!has_line()) RETURN_IF_ERROR(ReadPart(source, place));
  if (!has_line()) return Fail(PlaceOf(cell), "was shortened by another program while etude read it");
  return std::string_view(source.part).substr(place.offset - source.begin, place.length);
}

Result<void> CellTable::ReadPart(Source& source, const LinePlace& place) const {
  const std::size_t size = std::clamp(kMemory / sources_.size(), kMinPartBytes, kMaxPartBytes);
  // Lines are in order of completion, so the line of the cell that is read next may be shortly before this line.
  // Therefore, read a part of the file that begins earlier.
  source.begin = place.offset - std::min<std::uint64_t>(place.offset, size / 2);
  source.part.resize(std::max<std::size_t>(size, place.offset - source.begin + place.length));
  ASSIGN_OR_RETURN(const auto file, OpenFile(source.file, O_RDONLY));
  std::size_t read = 0;
  while (read < source.part.size()) {
    const ssize_t count = ::pread(file.number(), source.part.data() + read, source.part.size() - read,
                                  static_cast<off_t>(source.begin + read));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) break;
    read += static_cast<std::size_t>(count);
  }
  source.part.resize(read);
  return {};
}

Result<Journal> Journal::Begin(const fs::path& folder, const JournalHead& head, const JournalLag& sync) {
  const FilePath path = Inside(folder) / kJournalFile;
  ASSIGN_OR_RETURN(auto file, OpenFile(path, O_WRONLY | O_CREAT | O_TRUNC | O_APPEND, 0644));
  Journal journal(path, std::move(file), sync);
  ASSIGN_OR_RETURN(const auto json, WriteJson({{"journal", kJournalVersion},
                                               {"manifest", head.manifest},
                                               {"build", head.build},
                                               {"shard", ToString(head.shard)}}));
  const std::string line = WithSum(json) + "\n";
  RETURN_IF_ERROR(journal.Write(line + line));
  RETURN_IF_ERROR(journal.Sync());
  RETURN_IF_ERROR(SyncFolder(folder));
  return journal;
}

Result<Journal> Journal::Continue(const fs::path& folder, const JournalLag& sync) {
  const FilePath path = Inside(folder) / kJournalFile;
  ASSIGN_OR_RETURN(auto opened, OpenFile(path, O_RDWR | O_APPEND));
  Journal journal(path, std::move(opened), sync);
  const int file = journal.file_.number();
  off_t end = ::lseek(file, 0, SEEK_END);
  for (char last = 0; end > 0; --end) {
    if (::pread(file, &last, 1, end - 1) != 1 || last == '\n') break;
  }
  if (end < 0 || ::ftruncate(file, end) != 0) {
    return CannotWrite(path.string(), "cannot be continued", errno);
  }
  journal.end_ = static_cast<std::uint64_t>(end);
  return journal;
}

Result<std::uint64_t> Journal::Append(std::string_view line) {
  const std::uint64_t offset = end_;
  RETURN_IF_ERROR(Write(std::string(line) + "\n"));
  return offset;
}

Result<void> Journal::Write(std::string_view lines) {
  for (std::size_t written = 0; written < lines.size();) {
    const ssize_t count = ::write(file_.number(), lines.data() + written, lines.size() - written);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return CannotWrite(path_.string(), "cannot be written", errno);
    written += static_cast<std::size_t>(count);
  }
  end_ += lines.size();
  unsynced_bytes_ += lines.size();
  return {};
}

bool Journal::IsSyncDue() const {
  constexpr double kMebibyte = 1 << 20;
  return static_cast<double>(unsynced_bytes_) >= sync_.mebibytes * kMebibyte ||
         SecondsSince(synced_at_) >= sync_.seconds;
}

Result<void> Journal::Sync() {
  if (unsynced_bytes_ > 0 && ::fdatasync(file_.number()) != 0) {
    return CannotWrite(path_.string(), "cannot be synchronised", errno);
  }
  unsynced_bytes_ = 0;
  synced_at_ = Clock::now();
  return {};
}

namespace {

/// Returns the first undamaged copy of the head. The file begins with two copies.
Result<JournalHead> ReadHead(FileLines lines, const std::string& path) {
  std::string line;
  int read = 0;
  while (read < kHeads) {
    ASSIGN_OR_RETURN(const bool has_line, lines.Next(line));
    if (!has_line || !lines.had_end()) break;
    ++read;
    if (HasRightSum(line)) return DecodeHead(line, {path, read, 0});
  }
  if (read == 0) {
    return Fail({path, 0, 0},
                "is empty or begins with a cut line, so its cells are lost; restore this file, or run again with "
                "--overwrite");
  }
  return Fail({path, 1, 0}, "neither the first line nor a later copy is the header of a journal");
}

}  // namespace

Result<JournalHead> ReadJournalHead(const fs::path& folder) {
  const FilePath path = Inside(folder) / kJournalFile;
  ASSIGN_OR_RETURN(auto lines, FileLines::Open(path));
  return ReadHead(std::move(lines), path.string());
}

Result<JournalContent> ReadJournal(const fs::path& folder, const Plan& plan, CellTable& cells, CellTable* answered) {
  const FilePath path = Inside(folder) / kJournalFile;
  ASSIGN_OR_RETURN(auto head, ReadJournalHead(folder));
  JournalContent content{.head = std::move(head), .damaged = {}};
  ASSIGN_OR_RETURN(auto lines, FileLines::Open(path));
  const std::uint32_t file = cells.AddFile(path), answered_file = answered == nullptr ? 0 : answered->AddFile(path);
  std::uint64_t offset = 0;
  int number = 1;
  for (std::string line;; ++number, offset += line.size() + 1) {
    ASSIGN_OR_RETURN(const bool has_line, lines.Next(line));
    if (!has_line || !lines.had_end()) break;  // ignores an incomplete last line
    if (number <= kHeads) continue;
    // A line with a wrong checksum is damaged.
    const auto cell = ReadCellLineHead(line);
    if (!cell) {
      content.damaged.push_back(number);
      continue;
    }
    // A second line of the same cell also counts as damaged.
    if (!cell->is_measured && answered == nullptr) continue;
    const LineInFile place{cell->is_measured ? file : answered_file, offset, line.size()};
    ASSIGN_OR_RETURN(const bool counts, AddCell(*cell, place, {path.string(), number}, plan, content.head.shard,
                                                cell->is_measured ? cells : *answered));
    if (!counts) {
      content.damaged.push_back(number);
      continue;
    }
    if (!cell->is_measured) continue;
    ++content.cells;
    content.cells_ok += cell->status == Status::kOk ? 1 : 0;
  }
  // Count the answered cells that have no finished line.
  for (std::size_t cell = 0; answered != nullptr && cell < answered->size(); ++cell) {
    content.answered += answered->Has(cell) && !cells.Has(cell) ? 1 : 0;
  }
  return content;
}

Result<void> TemporaryLines::Add(std::size_t cell, std::string_view line) {
  if (!journal_) {
    auto folder = TemporaryFolder::Make("answered");
    auto journal = folder ? Journal::Begin(folder->path(), {}) : tl::unexpected(folder.error());
    if (!journal) return tl::unexpected(OfThisMachine(journal.error()));
    cells_.AddFile(folder->path() / kJournalFile);
    folder_ = std::move(*folder);
    journal_.emplace(std::move(*journal));
  }
  ASSIGN_OR_RETURN(const auto offset, journal_->Append(line));
  cells_.Put(cell, 0, offset, line.size());
  return {};
}

}  // namespace etude
