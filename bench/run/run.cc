#include "bench/run/run.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "bench/results/folder.h"
#include "bench/run/costs.h"
#include "bench/run/machine_trial.h"
#include "bench/run/manifest.h"
#include "bench/run/outside_metrics.h"
#include "bench/run/run_folder.h"
#include "bench/run/suite.h"
#include "bench/run/supervisor.h"
#include "bench/run/used_keys.h"
#include "engine/base/digest.h"
#include "io/files/files.h"
#include "io/files/json.h"
#include "io/files/own_files.h"
#include "io/process/clock.h"

namespace etude {
namespace {

namespace fs = std::filesystem;

fs::path FolderFor(const RunOptions& options, const SuiteSetup& suite) {
  if (!options.output.empty()) return options.output;
  const std::string part =
      options.shard.IsWhole() ? "" : fmt::format("-{}-of-{}", options.shard.index, options.shard.count);
  const std::string seed = suite.seed.IsPlain() ? ToString(suite.seed) : "secret-" + suite.seed.Digest().substr(0, 8);
  return fmt::format("out/{}-{}{}", suite.suite, seed, part);
}

/// Examines a result folder. Fails if the options do not allow writing into it, for example because it contains a run.
Result<FolderState> CheckFolder(const fs::path& folder, const RunOptions& options) {
  auto state = InspectFolder(folder);
  if (!state || *state == FolderState::kFree || options.resume || options.overwrite) return state;
  if (const auto head = ReadJournalHead(folder);
      head && !head->shard.IsWhole() && Exists(Inside(folder) / "host.json")) {
    return Fail({folder.string()},
                "already contains the finished shard {}; 'etude merge' makes one run of all shards, --overwrite "
                "replaces this shard, -o chooses another folder",
                ToString(head->shard));
  }
  return Fail({folder.string(), 0, 0}, "already contains {}; {}--overwrite replaces it, -o chooses another folder",
              *state == FolderState::kFinished ? "a run" : "an unfinished run",
              *state == FolderState::kFinished ? "" : "--resume continues it, ");
}

/// Fails unless the folder's manifest equals `manifest` and lists the outside programs of `scenarios`. If
/// `other_libraries` is true, libraries may differ, and the folder records the differences.
Result<void> CheckManifest(const fs::path& folder, const std::string& manifest, bool other_libraries,
                           std::span<const PreparedScenario> scenarios) {
  const FilePath path = Inside(folder) / "manifest.json";
  ASSIGN_OR_RETURN(const auto found, ReadWholeFile(path));
  if (found == manifest) return {};
  ASSIGN_OR_RETURN(const auto then, ReadJson(found, path.string()));
  ASSIGN_OR_RETURN(const auto now, ReadJson(manifest, ""));
  const bool was_secret = then.is_object() && then.value("seed", Json()).is_string();
  if (was_secret && now.at("seed").is_number()) {
    return Fail({path.string()},
                "the worlds of this run are secret; to resume the run, give the key again with --seed-file");
  }
  const Json version = was_secret ? then.value("secret_worlds", Json(1)) : Json();
  if (version.is_number_integer()) RETURN_IF_ERROR(CheckSecretWorlds(version.get<int>(), {path.string()}));
  const std::vector<JsonDifference> differences = CompareManifests(then, now);
  constexpr const char* kCure =
      "--resume continues only the same run; --overwrite replaces the old run, -o chooses another folder";
  if (const auto of_programs = OfPrograms(differences); !of_programs.empty() && of_programs == differences) {
    if (auto told = RequirePrograms(then, scenarios, {path.string()}); !told) {
      return Fail(told.error().place, "{}; {}", told.error().message, kCure);
    }
    return Fail({path.string()}, "this run used other versions of outside programs: {}; {}", InWords(differences),
                kCure);
  }
  if (!AreOfLibraries(differences)) {
    return Fail({path.string()}, "belongs to another run: {}; {}", InWords(differences), kCure);
  }
  if (other_libraries) return RecordOtherLibraries(folder, differences);
  return Fail({path.string()},
              "libraries have changed since the run began: {}; --other-libraries resumes the run anyway and records "
              "the changes",
              InWords(differences));
}

/// Fails if the outside programs differ from those of the manifest at `path`, which the run repeats.
Result<void> CheckSamePrograms(const std::string& path, const Json& now, std::span<const PreparedScenario> scenarios) {
  ASSIGN_OR_RETURN(const auto then, ReadJsonFile(path));
  if (then.contains("data_set")) return {};  // `etude export` wrote the manifest; it runs no program
  RETURN_IF_ERROR(RequirePrograms(then, scenarios, {path}));
  const auto differences = OfPrograms(CompareManifests(then, now));
  if (differences.empty()) return {};
  return Fail({path}, "this run used other versions of outside programs: {}; run its scenario instead of its manifest",
              InWords(differences));
}

Result<void> CheckHead(const fs::path& folder, const JournalHead& found, const JournalHead& wanted) {
  const Place place{(folder / kJournalFile).string(), 1, 0};
  if (found.build != wanted.build) {
    return Fail(place, "was written by build {} of etude, but this is build {}; start a new run", found.build,
                wanted.build);
  }
  if (found.shard != wanted.shard) {
    return Fail(place, "belongs to shard {}, not {}", ToString(found.shard), ToString(wanted.shard));
  }
  return {};
}

/// Writes finished cells to the journal, and reports the progress.
class JournalRecorder {
 public:
  JournalRecorder(CellTable& cells, CellTable* answered, Journal journal, const FilePath& file, const Progress& before,
                  const ExpectedWork& work, const std::function<void(const Progress&)>& on_progress)
      : work_(work),
        cells_(cells),
        answered_(answered),
        journal_(std::move(journal)),
        file_(cells.AddFile(file)),
        answered_file_(answered == nullptr ? 0 : answered->AddFile(file)),
        progress_(before),
        unsynced_(before),
        on_progress_(on_progress) {
    on_progress_(progress_);
  }

  Result<void> Add(const DeliveredCell& cell) {
    const std::size_t number = cell.head.cell;
    const bool was_answered = answered_ != nullptr && answered_->Has(number);
    unsynced_.work_done += (was_answered || !cell.head.is_measured ? 0.5 : 1) * work_.Of(number);
    ASSIGN_OR_RETURN(const auto offset, journal_.Append(cell.line));
    if (cell.head.is_measured) {
      cells_.Put(number, file_, offset, cell.line.size());
      ++unsynced_.cells_done;
      unsynced_.cells_ok += cell.head.status == Status::kOk ? 1 : 0;
      unsynced_.cells_answered -= was_answered ? 1 : 0;
    } else {
      answered_->Put(number, answered_file_, offset, cell.line.size());
      ++unsynced_.cells_answered;
    }
    return journal_.IsSyncDue() ? Sync() : Result<void>();
  }

  /// Synchronises the journal to the disk, then reports how many cells are on the disk.
  Result<void> Sync() {
    RETURN_IF_ERROR(journal_.Sync());
    progress_ = unsynced_;
    progress_.seconds = SecondsSince(start_);
    on_progress_(progress_);
    return {};
  }

  /// Reports the progress once a second, so that the user sees the elapsed time even if no further cell is safe on the
  /// disk.
  void Wait() {
    const double now = SecondsSince(start_);
    if (now - progress_.seconds < 1) return;
    progress_.seconds = now;
    on_progress_(progress_);
  }

  const Progress& progress() const { return progress_; }

 private:
  const Clock::time_point start_ = Clock::now();
  const ExpectedWork& work_;
  CellTable& cells_;
  CellTable* answered_;  ///< the cells that outside metric programs must still measure; null without such programs
  Journal journal_;
  std::uint32_t file_, answered_file_;  ///< the journal file's number in `cells_`, and in `answered_`
  /// Progress that counts the cells synchronised to the disk, and progress that counts all written cells.
  Progress progress_, unsynced_;
  const std::function<void(const Progress&)>& on_progress_;
};

/// Returns the outcome of a folder whose run is finished.
Result<RunOutcome> AlreadyWhole(const fs::path& folder, const SuiteSetup& suite) {
  ASSIGN_OR_RETURN(const auto run, LoadRunOutline(folder));
  RunOutcome outcome{.folder = folder, .refused = LeftOutOf(suite)};
  for (const ScenarioSummary& scenario : run.scenarios) {
    for (const ConditionSummary& condition : scenario.conditions) {
      for (const MethodSummary& method : condition.methods) {
        outcome.cells_ok += static_cast<std::size_t>(method.ok);
        for (const auto& [status, count] : method.statuses) outcome.cells += static_cast<std::size_t>(count);
      }
    }
  }
  return outcome;
}

/// Returns a complaint for each scenario that films no trial of this run, although it shall film some.
std::vector<Error> UnfilmedIn(const std::vector<PreparedScenario>& scenarios) {
  std::vector<Error> unfilmed;
  for (const PreparedScenario& scenario : scenarios) {
    const std::vector<int>& filmed = scenario.scenario().recordings.trials;
    const int trials = scenario.scenario().trials;
    if (filmed.empty() || std::ranges::min(filmed) < trials) continue;
    unfilmed.push_back({{scenario.setup().file, 0, 0},
                        fmt::format("scenario {} kept no motion, because 'video' selects no trial below {}",
                                    scenario.scenario().name, trials)});
  }
  return unfilmed;
}

/// Returns the changes that reading made to the content of clip files, each change once.
std::vector<LoadedChange> ChangesIn(const std::vector<PreparedScenario>& scenarios) {
  std::vector<LoadedChange> changes;
  std::set<std::pair<std::string, std::string>> told;
  for (const PreparedScenario& scenario : scenarios) {
    for (const LibraryClip& clip : scenario.clips().clips) {
      for (const std::string& change : clip.changes) {
        if (told.emplace(clip.source, change).second) changes.push_back({clip.source, change});
      }
    }
  }
  return changes;
}

/// An open journal, and the progress of the run when the journal was opened.
struct OpenedJournal {
  Journal journal;
  Progress before;  ///< `cells` is the number of cells that the folder will have at the end
  std::vector<int> damaged;
};

/// Writes the manifest and begins a journal. If `continues` is true, continues the existing journal and reads its
/// finished cells into `cells` and its answered cells into `answered` (unless null).
Result<OpenedJournal> OpenJournal(const fs::path& folder, const std::string& manifest, const JournalHead& head,
                                  bool continues, const RunOptions& options, const Plan& plan, const ExpectedWork& work,
                                  CellTable& cells, CellTable* answered) {
  Progress before{.seconds_per_work = work.SecondsEach(WorkerCount(options.jobs))};
  std::vector<int> damaged;
  if (continues) {
    ASSIGN_OR_RETURN(const auto found, ReadJournal(folder, plan, cells, answered));
    RETURN_IF_ERROR(CheckHead(folder, found.head, head));
    damaged = found.damaged;
    before.cells_done = found.cells;
    before.cells_ok = found.cells_ok;
    before.cells_answered = found.answered;
  } else {
    RETURN_IF_ERROR(WriteFileAtomically(Inside(folder) / "manifest.json", manifest, OnDisk::kLater));
    RETURN_IF_ERROR(SyncTree(folder));
    RETURN_IF_ERROR(SyncPathTo(folder));
  }
  ASSIGN_OR_RETURN(auto journal,
                   continues ? Journal::Continue(folder, options.sync) : Journal::Begin(folder, head, options.sync));
  for (std::size_t world = 0; world < plan.world_count(); ++world) {
    if (!plan.IsIn(options.shard, world)) continue;
    before.cells += plan.MethodCount(world);
    for (std::size_t method = 0; method < plan.MethodCount(world); ++method) {
      const std::size_t cell = plan.CellAt(world, method);
      const bool is_answered = answered != nullptr && answered->Has(cell);
      before.work += work.OfWorld(world);
      before.work_done += (cells.Has(cell) ? 1 : is_answered ? 0.5 : 0) * work.OfWorld(world);
    }
  }
  before.work_before = before.work_done;
  return OpenedJournal{std::move(journal), before, std::move(damaged)};
}

/// Writes the results of a whole run. For a shard, which keeps its journal, writes only host.json. Returns false if the
/// user stopped the writing. `was_done` is true if all cells had already been run.
Result<bool> FinishFolder(const fs::path& folder, const Plan& plan, CellTable& cells, const Json& host, bool was_done,
                          const RunOptions& options, Progress progress,
                          const std::function<void(const Progress&)>& on_progress) {
  if (options.shard.IsWhole()) {
    const auto goes_on = [&](double share) {
      progress.written = share;
      on_progress(progress);
      return options.stop == nullptr || !*options.stop;
    };
    return FinishRun(folder, plan, cells, host, WorkerCount(options.jobs), goes_on);
  }
  if (!was_done || !Exists(Inside(folder) / "host.json")) {
    RETURN_IF_ERROR(SaveJson(Inside(folder) / "host.json", host, OnDisk::kLater));
    RETURN_IF_ERROR(SyncTree(folder));
  }
  return true;
}

}  // namespace

Result<RunOutcome> Run(const RunOptions& options, const std::function<void(const Progress&)>& on_progress) {
  const auto start = Clock::now();
  // Check all input before anything is written.
  ASSIGN_OR_RETURN(const auto suite, ReadSuiteToRun(options));
  const fs::path folder = FolderFor(options, suite);
  ASSIGN_OR_RETURN(const auto state, CheckFolder(folder, options));
  ASSIGN_OR_RETURN(const auto scenarios, PrepareToRun(suite, options));
  ASSIGN_OR_RETURN(Fence fence, FenceFor(scenarios, options.outside, folder, options.key));
  if (!options.from.empty()) HideTruthIn(fs::absolute(options.from).parent_path(), fence);
  if (!options.resume || state != FolderState::kFinished) {
    RETURN_IF_ERROR(TryMachine(scenarios, fence));
    RETURN_IF_ERROR(CheckMetricVectors(scenarios, fence));
  }
  // Collect the data that identify the run: plan, manifest and build.
  const Plan plan(scenarios);
  ASSIGN_OR_RETURN(auto described, MakeManifest(suite, scenarios, options.program_version));
  RETURN_IF_ERROR(AddPrograms(scenarios, fence, described));
  if (!options.from.empty()) RETURN_IF_ERROR(CheckSamePrograms(options.from, described, scenarios));
  ASSIGN_OR_RETURN(const auto manifest, WriteJson(described));
  ASSIGN_OR_RETURN(const auto build, BuildDigest());
  const JournalHead head{Digest().Add(manifest + "\n").Hex(), build, options.shard};

  if (options.stop != nullptr && *options.stop) return RunOutcome{.folder = folder, .stopped = true};
  const bool continues = options.resume && state != FolderState::kFree;
  const KeyUse use{"run", suite.suite, DigestOfRun(described), options.shard, folder, continues, !options.from.empty()};
  const bool may_be_used = options.reuse_key;
  const bool is_secret = !suite.seed.IsPlain();
  if (is_secret && !may_be_used && !continues) RETURN_IF_ERROR(CheckUnused(*options.key, use));
  // Claim the folder. Nothing is written before this point.
  ASSIGN_OR_RETURN(auto claimed, RunFolder::Claim(folder, continues));
  if (continues) {
    RETURN_IF_ERROR(CheckManifest(folder, manifest + "\n", options.other_libraries, scenarios));
    if (state == FolderState::kFinished) return AlreadyWhole(folder, suite);
    if (is_secret && !may_be_used) RETURN_IF_ERROR(CheckUnused(*options.key, use));
  }
  // Open the journal, and run the cells that the journal lacks.
  CellTable cells(plan.cell_count()), answered_cells(HasOutsideMetrics(plan) ? plan.cell_count() : 0);
  CellTable* const answered = answered_cells.size() > 0 ? &answered_cells : nullptr;
  ASSIGN_OR_RETURN(const auto costs, ReadKeptCosts());
  const ExpectedWork work(plan, costs);
  ASSIGN_OR_RETURN(auto opened,
                   OpenJournal(folder, manifest + "\n", head, continues, options, plan, work, cells, answered));
  if (is_secret) RETURN_IF_ERROR(NoteUse(*options.key, use, may_be_used));
  std::vector<Order> orders = plan.OrdersFor(options.shard, cells.Done());
  const bool was_done = continues && orders.empty();
  JournalRecorder recorder(cells, answered, std::move(opened.journal), Inside(folder) / kJournalFile, opened.before,
                           work, on_progress);
  const auto whole = RunOrders(suite, plan, std::move(orders),
                               {.program = ThisProgram(),
                                .error_folder = (fs::absolute(folder) / "stderr").string(),
                                .fence = fence,
                                .jobs = options.jobs,
                                .stop = options.stop,
                                .answered = answered,
                                .on_wait = [&] { recorder.Wait(); },
                                .on_all_answered = [&] { return recorder.Sync(); }},
                               [&](const DeliveredCell& cell) {
                                 auto kept = recorder.Add(cell);
                                 if (kept) claimed.Keep();
                                 return kept;
                               });
  // Report how many cells are done.
  RETURN_IF_ERROR(recorder.Sync());
  const Progress& progress = recorder.progress();
  if (!whole) {
    Error failure = whole.error();
    const bool is_kept = progress.cells_done + progress.cells_answered > 0;
    if (is_kept) failure.message += "; finished cells are kept; --resume continues the run";
    return tl::unexpected(std::move(failure));
  }
  RunOutcome outcome{.folder = folder,
                     .cells = progress.cells_done,
                     .cells_ok = progress.cells_ok,
                     .cells_answered = progress.cells_answered,
                     .seconds = SecondsSince(start),
                     .stopped = !*whole,
                     .fence = ProgramsOf(scenarios).empty() ? "" : fence.description(),
                     .why_unlocked = claimed.why_unlocked(),
                     .damaged_lines = std::move(opened.damaged)};
  outcome.refused = LeftOutOf(suite);
  outcome.unfilmed = UnfilmedIn(scenarios);
  outcome.changes = ChangesIn(scenarios);
  // Unless the user stopped the run, write the final results.
  if (outcome.stopped) return outcome;
  claimed.Keep();
  Json host = DescribeHost(options.command_line, WorkerCount(options.jobs), outcome.seconds);
  if (!outcome.fence.empty()) {
    host["fence"] = outcome.fence;
    host["memory"] = fence.MemoryDescription();
  }
  ASSIGN_OR_RETURN(const bool is_whole,
                   FinishFolder(folder, plan, cells, host, was_done, options, recorder.progress(), on_progress));
  outcome.stopped = !is_whole;
  outcome.seconds = SecondsSince(start);
  return outcome;
}

}  // namespace etude
