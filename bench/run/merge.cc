#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "bench/results/folder.h"
#include "bench/run/journal.h"
#include "bench/run/manifest.h"
#include "bench/run/run.h"
#include "bench/run/run_folder.h"
#include "bench/run/supervisor.h"
#include "engine/base/digest.h"
#include "engine/base/names.h"
#include "io/files/files.h"
#include "io/process/clock.h"

namespace etude {
namespace {

namespace fs = std::filesystem;

struct Shards {
  int count = 0;
  std::map<int, fs::path> folders;
  std::string manifest;              ///< text of the first shard's manifest
  std::vector<std::string> missing;  ///< messages about missing shards and cells, and about folders without a shard
  std::vector<JsonDifference> other_libraries = {};
};

/// Fails unless a shard's manifest equals those of the earlier shards. If `other_libraries` is true, libraries may
/// differ, and the differences are collected.
Result<void> CheckManifest(const fs::path& folder, const JournalHead& head, bool other_libraries, Shards& shards) {
  if (head.manifest == Digest().Add(std::string_view(shards.manifest)).Hex()) return {};
  ASSIGN_OR_RETURN(const auto then, ReadJson(shards.manifest, shards.folders.begin()->second.string()));
  ASSIGN_OR_RETURN(const auto now, ReadJsonFile(Inside(folder) / "manifest.json"));
  const std::vector<JsonDifference> found = CompareManifests(then, now);
  const Place place{folder.string()};
  if (found.empty()) return Fail(place, "the shard's manifest.json was changed after the shard began");
  if (OfPrograms(found) == found) {
    return Fail(place,
                "used different versions of outside programs than the shards before it: {}; run this shard again with "
                "--overwrite",
                InWords(found));
  }
  if (!AreOfLibraries(found))
    return Fail(place, "belongs to a different run than the shards before it: {}", InWords(found));
  if (!other_libraries) {
    return Fail(place,
                "used different libraries than the shards before it: {}; --other-libraries merges the shards anyway "
                "and records the differences",
                InWords(found));
  }
  shards.other_libraries.insert(shards.other_libraries.end(), found.begin(), found.end());
  return {};
}

Result<void> AddShard(const fs::path& folder, const std::string& build, bool other_libraries, Shards& shards) {
  const Place place{folder.string(), 0, 0};
  ASSIGN_OR_RETURN(const auto head, ReadJournalHead(folder));
  if (head.build != build) return Fail(place, "was run by build {} of etude, but this is build {}", head.build, build);
  if (shards.folders.empty()) {
    ASSIGN_OR_RETURN(auto manifest, ReadWholeFile(Inside(folder) / "manifest.json"));
    shards.manifest = std::move(manifest);
    shards.count = head.shard.count;
  }
  RETURN_IF_ERROR(CheckManifest(folder, head, other_libraries, shards));
  if (head.shard.count != shards.count) {
    return Fail(place, "is shard {}, but the shards before it belong to a run of {} shards", ToString(head.shard),
                shards.count);
  }
  const auto [other, is_new] = shards.folders.emplace(head.shard.index, folder);
  if (!is_new)
    return Fail(place, "is shard {}, but {} is the same shard", ToString(head.shard), other->second.string());
  ASSIGN_OR_RETURN(const auto recorded, OtherLibrariesOf(folder));
  shards.other_libraries.insert(shards.other_libraries.end(), recorded.begin(), recorded.end());
  return {};
}

/// Fails if a folder that was given as a shard is not a shard; names the shards that it contains.
Result<void> RequireNoFolderOfShards(const fs::path& folder) {
  if (Exists(Inside(folder) / kJournalFile) || Exists(Inside(folder) / "manifest.json")) return {};
  std::vector<std::string> shards;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    if (Exists(Inside(entry->path()) / kJournalFile)) shards.push_back(entry->path().string());
  }
  // If nothing in a folder is foreign to a run, the run was stopped before it began its journal.
  if (shards.empty() && (!fs::is_directory(folder, error) || InspectFolder(folder))) return {};
  if (shards.empty()) return Fail({folder.string()}, "is no shard; allowed: the result folders of `etude run --shard`");
  std::ranges::sort(shards);
  return Fail({folder.string()}, "is no shard, but contains shards; allowed: these shards, {}", Join(shards, " "));
}

/// Finds the shards in the folders and lists the missing ones. Fails if shards belong to different runs or builds, or
/// if a shard occurs twice.
Result<Shards> FindShards(const std::vector<std::string>& folders, bool other_libraries) {
  ASSIGN_OR_RETURN(const auto build, BuildDigest());
  Shards shards;
  for (const std::string& folder : folders) {
    RETURN_IF_ERROR(RequireNoFolderOfShards(folder));
    ASSIGN_OR_RETURN(const auto state, InspectFolder(folder));
    if (state == FolderState::kFinished) return Fail({folder, 0, 0}, "is a whole run, not a shard");
    if (state == FolderState::kFree) {
      shards.missing.push_back(folder + " contains no shard");
    } else if (auto added = AddShard(folder, build, other_libraries, shards); !added) {
      return tl::unexpected(added.error());
    }
  }
  for (int index = 1; index <= shards.count; ++index) {
    if (!shards.folders.contains(index))
      shards.missing.push_back("shard " + ToString(Shard{index, shards.count}) + " is missing");
  }
  return shards;
}

/// Describes which cells a shard lacks, e.g. "shard 2/4 in DIR lacks 3 of 40 cells (the first is ik/…)"; "" if it lacks
/// none.
std::string WhatLacks(const Plan& plan, const Shard& shard, const fs::path& folder, const CellTable& cells) {
  std::size_t wanted = 0, lacking = 0;
  std::string first;
  for (std::size_t cell = 0; cell < plan.cell_count(); ++cell) {
    if (!plan.IsIn(shard, plan.WorldOf(cell))) continue;
    ++wanted;
    if (cells.Has(cell)) continue;
    if (++lacking == 1) first = plan.IdentityOf(cell).Id();
  }
  if (lacking == 0) return "";
  return fmt::format("shard {} in {} lacks {} of {} cells; the first missing cell is {}", ToString(shard),
                     folder.string(), lacking, wanted, first);
}

}  // namespace

Result<RunOutcome> Merge(const MergeOptions& options, const std::function<void(double share)>& on_progress) {
  const Clock::time_point start = Clock::now();
  // Find the shards and prepare the run to which they belong.
  ASSIGN_OR_RETURN(auto shards, FindShards(options.folders, options.other_libraries));
  if (shards.folders.empty()) return Fail({}, "there is nothing to merge: {}", Join(shards.missing, "; "));
  ASSIGN_OR_RETURN(const auto prepared,
                   PrepareRun(Inside(shards.folders.begin()->second) / "manifest.json", options.key));
  ASSIGN_OR_RETURN(const auto manifest, ReadJson(shards.manifest, ""));
  RETURN_IF_ERROR(RequirePrograms(manifest, prepared.scenarios, {shards.folders.begin()->second.string()}));
  const Plan plan(prepared.scenarios);
  CellTable cells(plan.cell_count());
  Json hosts = Json::array();
  RunOutcome outcome{.folder = options.output, .cells = cells.size()};
  // Reading the shards counts as the first half of the progress, writing the run as the second.
  const auto goes_on = [&](double share) {
    on_progress(share);
    return options.stop == nullptr || !*options.stop;
  };
  // Read every journal and list the missing cells.
  std::size_t read = 0;
  for (const auto& [index, folder] : shards.folders) {
    if (!goes_on(0.5 * static_cast<double>(read) / static_cast<double>(cells.size()))) {
      outcome.stopped = true;
      return outcome;
    }
    ASSIGN_OR_RETURN(const auto journal, ReadJournal(folder, plan, cells));
    read += journal.cells;
    outcome.cells_ok += journal.cells_ok;
    const std::string what = WhatLacks(plan, journal.head.shard, folder, cells);
    if (!what.empty()) shards.missing.push_back(what);
    ASSIGN_OR_RETURN(const auto host, what.empty() ? ReadJsonFile(Inside(folder) / "host.json") : Json());
    hosts.push_back(host);
  }
  if (!shards.missing.empty()) {
    return Fail({}, "not all {} shards are finished ('etude run --shard i/{} --resume' continues a shard): {}",
                shards.count, shards.count, Join(shards.missing, "; "));
  }
  // Write the whole run.
  ASSIGN_OR_RETURN(const auto state, InspectFolder(options.output));
  if (state != FolderState::kFree && !options.overwrite) {
    return Fail({options.output, 0, 0},
                "already contains a run; --overwrite replaces this run, -o chooses another folder");
  }
  ASSIGN_OR_RETURN(auto claimed, RunFolder::Claim(options.output, false));
  outcome.why_unlocked = claimed.why_unlocked();
  RETURN_IF_ERROR(WriteFileAtomically(Inside(options.output) / "manifest.json", shards.manifest));
  if (!shards.other_libraries.empty()) RETURN_IF_ERROR(RecordOtherLibraries(options.output, shards.other_libraries));
  Json host = DescribeHost(options.command_line, 0, 0);
  host["shards"] = std::move(hosts);
  const auto has_written = [&](double share) { return goes_on(0.5 + 0.5 * share); };
  ASSIGN_OR_RETURN(const bool is_whole, FinishRun(options.output, plan, cells, host, WorkerCount(0), has_written));
  outcome.stopped = !is_whole;
  outcome.seconds = SecondsSince(start);
  if (is_whole) claimed.Keep();
  return outcome;
}

}  // namespace etude
