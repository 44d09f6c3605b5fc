#include "bench/run/journal.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <utility>

#include "bench/files/durable.h"
#include "bench/results/folder.h"
#include "bench/run/cell_json.h"
#include "engine/base/digest.h"

namespace etude {
namespace {

namespace fs = std::filesystem;

constexpr int kJournalVersion = 2;
constexpr int kHeads = 2;

/// A line says at its end what its text adds up to, so that a disk's or an editor's mistake is found.
constexpr std::string_view kSumBegin = R"(,"sum":")", kSumEnd = R"("})";

std::string WithSum(const std::string& json) {
  const std::string text = json.substr(0, json.size() - 1);  // without the last brace
  return text + std::string(kSumBegin) + Digest().Add(std::string_view(text)).Hex() + std::string(kSumEnd) + "\n";
}

bool HasRightSum(const std::string& line) {
  const std::size_t at = line.rfind(kSumBegin);
  return at != std::string::npos && WithSum(line.substr(0, at) + "}") == line + "\n";
}

Result<JournalHead> DecodeHead(const std::string& line, const Place& place) {
  ASSIGN_OR_RETURN(const auto json, ReadJson(line, place.file, place.line));
  JournalHead head;
  try {
    const int version = json.at("journal").get<int>();
    if (version != kJournalVersion) {
      return Fail(place, "a journal of version {}; this program reads {}", version, kJournalVersion);
    }
    head.manifest = json.at("manifest").get<std::string>();
    head.build = json.at("build").get<std::string>();
    const auto shard = ParseShard(json.at("shard").get<std::string>());
    if (!shard) return Fail(place, "{}", shard.error().message);
    head.shard = *shard;
  } catch (const Json::exception& error) {
    return Fail(place, "not the head of a journal: {}", error.what());
  }
  return head;
}

Result<void> AddCell(const std::string& line, const Place& place, const Plan& plan, const Shard& shard,
                     CellTable& cells) {
  ASSIGN_OR_RETURN(const auto json, ReadJson(line, place.file, place.line));
  ASSIGN_OR_RETURN(auto finished, DecodeFinishedCell(json, place));
  const auto number = json.find("cell");
  if (number == json.end() || !number->is_number_unsigned()) return Fail(place, "a line without its cell's number");
  const std::size_t cell = number->get<std::size_t>();
  if (cell >= plan.cell_count() || !plan.IsIn(shard, plan.WorldOf(cell)) ||
      plan.IdentityOf(cell).Id() != finished.row.Id()) {
    return Fail(place, "cell {} ({}) is none of this run's shard {}", cell, finished.row.Id(), ToString(shard));
  }
  if (cells[cell]) return Fail(place, "cell {} ({}) stands in two places", cell, finished.row.Id());
  cells[cell] = std::move(finished);
  return {};
}

}  // namespace

Result<Journal> Journal::Begin(const fs::path& folder, const JournalHead& head, const JournalLag& sync) {
  Journal journal(folder / kJournalFile,
                  ::open((folder / kJournalFile).c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND | O_CLOEXEC, 0644),
                  sync);
  ASSIGN_OR_RETURN(const auto json, WriteJson({{"journal", kJournalVersion},
                                               {"manifest", head.manifest},
                                               {"build", head.build},
                                               {"shard", ToString(head.shard)}}));
  const std::string line = WithSum(json);
  RETURN_IF_ERROR(journal.Write(line + line));
  RETURN_IF_ERROR(journal.Sync());
  RETURN_IF_ERROR(SyncFolder(folder));
  return journal;
}

Result<Journal> Journal::Continue(const fs::path& folder, const JournalLag& sync) {
  const fs::path path = folder / kJournalFile;
  Journal journal(path, ::open(path.c_str(), O_RDWR | O_APPEND | O_CLOEXEC), sync);
  off_t end = ::lseek(journal.file_, 0, SEEK_END);
  for (char last = 0; end > 0; --end) {
    if (::pread(journal.file_, &last, 1, end - 1) != 1 || last == '\n') break;
  }
  if (end < 0 || ::ftruncate(journal.file_, end) != 0) {
    return Fail({path.string(), 0, 0}, "cannot be continued: {}", std::strerror(errno));
  }
  return journal;
}

Journal::Journal(Journal&& other) noexcept
    : path_(std::move(other.path_)),
      file_(std::exchange(other.file_, -1)),
      sync_(other.sync_),
      unsynced_bytes_(other.unsynced_bytes_),
      synced_at_(other.synced_at_) {}

Journal::~Journal() {
  if (file_ >= 0) ::close(file_);
}

Result<void> Journal::Append(std::size_t cell, FinishedCell finished) {
  Json json{{"cell", cell}};
  json.update(EncodeFinishedCell(std::move(finished)));
  ASSIGN_OR_RETURN(const auto line, WriteJson(json));
  return Write(WithSum(line));
}

Result<void> Journal::Write(const std::string& line) {
  for (std::size_t written = 0; written < line.size();) {
    const ssize_t count = ::write(file_, line.data() + written, line.size() - written);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return Fail({path_.string(), 0, 0}, "cannot be written: {}", std::strerror(errno));
    written += static_cast<std::size_t>(count);
  }
  unsynced_bytes_ += line.size();
  return {};
}

bool Journal::IsSyncDue() const {
  constexpr double kMebibyte = 1 << 20;
  return static_cast<double>(unsynced_bytes_) >= sync_.mebibytes * kMebibyte ||
         SecondsSince(synced_at_) >= sync_.seconds;
}

Result<void> Journal::Sync() {
  if (unsynced_bytes_ > 0 && ::fdatasync(file_) != 0) {
    return Fail({path_.string(), 0, 0}, "cannot be synchronised: {}", std::strerror(errno));
  }
  unsynced_bytes_ = 0;
  synced_at_ = Clock::now();
  return {};
}

namespace {

/// The first of the head's copies that is as it was written, from the lines at the file's beginning.
Result<JournalHead> ReadHead(std::istream& in, const std::string& path) {
  std::string line;
  int read = 0;
  while (read < kHeads && std::getline(in, line) && !in.eof()) {
    ++read;
    if (HasRightSum(line)) return DecodeHead(line, {path, read, 0});
  }
  if (read == 0) return Fail({path, 0, 0}, "cannot be read, or is empty");
  return Fail({path, 1, 0}, "not the head of a journal, and no copy of it follows");
}

}  // namespace

Result<JournalHead> ReadJournalHead(const fs::path& folder) {
  const fs::path path = folder / kJournalFile;
  std::ifstream in(path, std::ios::binary);
  return ReadHead(in, path.string());
}

Result<JournalContent> ReadJournal(const fs::path& folder, const Plan& plan, CellTable& cells) {
  const fs::path path = folder / kJournalFile;
  ASSIGN_OR_RETURN(auto head, ReadJournalHead(folder));
  JournalContent content{.head = std::move(head), .damaged = {}};
  std::ifstream in(path, std::ios::binary);
  int number = 1;
  for (std::string line; std::getline(in, line); ++number) {
    if (in.eof()) break;  // it does not end in a line end: torn
    if (number <= kHeads) continue;
    if (!HasRightSum(line)) {
      content.damaged.push_back(number);
    } else if (auto added = AddCell(line, {path.string(), number, 0}, plan, content.head.shard, cells); !added) {
      return tl::unexpected(added.error());
    }
  }
  return content;
}

std::vector<bool> DoneCells(const CellTable& cells) {
  std::vector<bool> done;
  for (const auto& cell : cells) done.push_back(cell.has_value());
  return done;
}

}  // namespace etude
