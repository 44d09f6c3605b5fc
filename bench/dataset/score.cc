#include "bench/dataset/score.h"

#include <nlohmann/json.hpp>

#include "bench/dataset/export.h"
#include "bench/run/cell_runner.h"
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

/// Fails if the data set has a newer layout than this program knows. Data sets of all older layouts can be scored,
/// because only the manifest is read.
Result<void> CheckVersion(const FilePath& manifest) {
  ASSIGN_OR_RETURN(const auto json, ReadJsonFile(manifest));
  const Json version = json.is_object() ? json.value("data_set", Json(1)) : Json(1);
  if (version.is_number_integer() && version >= 1 && version <= kDataSetVersion) return {};
  return Fail({manifest.string()}, "found a data set of version {}; allowed: versions 1 to {}", version.dump(),
              kDataSetVersion);
}

Result<SuiteSetup> ReadTarget(const ScoreOptions& options) {
  const FilePath manifest = Inside(options.target) / "manifest.json";
  if (!Exists(manifest)) {
    RunOptions run;
    run.scenarios = {options.target};
    run.seed = options.seed;
    run.key = options.key;
    run.trials = options.trials;
    run.clips = options.clips;
    run.joint_map = options.joint_map;
    run.clip_facts = options.clip_facts;
    return ReadSuite(run);
  }
  if (options.seed || options.trials || !options.clips.empty() || !options.joint_map.empty() ||
      !options.clip_facts.empty()) {
    return Fail({manifest.string(), 0, 0},
                "already sets the seed, the trials and the clips; leave out --seed, --trials, --clips, --joint-map, "
                "--unit, --up, --rate");
  }
  RETURN_IF_ERROR(CheckVersion(manifest));
  ASSIGN_OR_RETURN(auto suite, ReadManifest(manifest));
  RETURN_IF_ERROR(OpenSeeds(options.key, {manifest.string()}, suite));
  return suite;
}

Result<std::vector<PreparedScenario>> PrepareTarget(const SuiteSetup& suite, const ScoreOptions& options) {
  auto scenarios = PrepareAll(suite);
  if (!scenarios) return scenarios;
  const FilePath manifest = Inside(options.target) / "manifest.json";
  if (Exists(manifest)) {
    RETURN_IF_ERROR(CheckClips(manifest, *scenarios));
    RETURN_IF_ERROR(CheckPrograms(manifest.string(), *scenarios, options.outside));
  }
  return scenarios;
}

std::string NameOf(const Plan& plan, std::size_t w) {
  const Scenario& scenario = plan.scenario_of(w).scenario();
  const World& world = plan.world(w);
  return fmt::format("{}/{}/{}", scenario.name, ConditionFolders(scenario)[world.condition],
                     WorldName(plan.scenario_of(w), world.condition, world.trial));
}

// Largest size of an answer file, bytes; equal to kMaxReplyBytes (bench/outside/messages.h). An answer with 60 s of
// poses takes 3 MB.
constexpr std::uintmax_t kMaxAnswerBytes = std::uintmax_t{16} << 20;

Result<CellResult> JudgeFile(TaskWorld& world, const FilePath& file) {
  ASSIGN_OR_RETURN(const auto text, ReadWholeFile(file, kMaxAnswerBytes));
  ASSIGN_OR_RETURN(const auto answer, ReadJson(text, file.string()));
  auto judged = JudgeAnswer(world, answer);
  if (!judged) return Fail({file.string(), 0, 0}, "{}", ToString(judged.error()));
  return judged;
}

/// Judges the answer in `file` to world `w`, and adds the answer's faults to `faults`. Outside metrics are not measured
/// here, but later.
FinishedCell JudgeWorld(const Plan& plan, std::size_t w, const std::optional<FilePath>& file,
                        PredictionFaults& faults) {
  const PreparedScenario& scenario = plan.scenario_of(w);
  const World& world = plan.world(w);
  const std::size_t method = plan.MethodCount(w) - 1;
  const auto ended = [&](Status status, const std::string& reason) {
    return FinishedCell{scenario.EndedRow(world.condition, world.trial, method, status, reason), {}};
  };
  // Make the world. Outside metrics and films need a recording of the motion.
  const bool has_programs = !scenario.scenario().outside_metrics.empty();
  const bool is_filmed = scenario.scenario().recordings.KeepsTrial(world.trial);
  const auto built =
      scenario.task(world.condition).MakeWorld(scenario.KeyOf(world.condition, world.trial), is_filmed || has_programs);
  // End the cell without judging if the world is skipped (status skipped), or if the answer is missing (failed) or
  // broken (bad_output).
  if (const auto why = built->WhySkipped()) {
    if (file) faults.extra.push_back(fmt::format("{}.json ({})", NameOf(plan, w), *why));
    return ended(Status::kSkipped, *why);
  }
  if (!file) {
    faults.missing.push_back(NameOf(plan, w) + ".json");
    return ended(Status::kFailed, fmt::format("no prediction: {}.json is missing", NameOf(plan, w)));
  }
  auto judged = JudgeFile(*built, *file);
  if (!judged) {
    faults.broken.push_back(ToString(judged.error()));
    return ended(Status::kBadOutput, judged.error().message);
  }
  // Make the row. If the scenario has outside metrics, their values are added to the row later.
  FinishedCell cell{scenario.IdentityOf(world.condition, world.trial, method), {}};
  cell.row.result = *std::move(judged);
  cell.is_measured = !has_programs || !cell.row.result.recording;
  if (cell.is_measured) {
    if (!is_filmed) cell.row.result.recording.reset();
    scenario.CompleteMetrics(world.condition, cell.row);
  }
  return cell;
}

class Meter {
 public:
  Meter(std::size_t cells, const std::function<void(const Progress&)>& on_progress) : on_progress_(on_progress) {
    progress_.cells = cells;
    progress_.work = static_cast<double>(cells);
    on_progress_(progress_);
  }
  void Count(Status status) {
    ++progress_.cells_done;
    ++progress_.work_done;
    progress_.cells_ok += status == Status::kOk ? 1 : 0;
    progress_.seconds = SecondsSince(start_);
    on_progress_(progress_);
  }
  void TellWritten(double share) {
    progress_.written = share;
    on_progress_(progress_);
  }
  const Progress& progress() const { return progress_; }

 private:
  const Clock::time_point start_ = Clock::now();
  const std::function<void(const Progress&)>& on_progress_;
  Progress progress_;
};

/// Judges all answers. Adds each row to `cells`, or to `answered` if outside metrics must still measure it. Returns
/// false if the user stopped the program.
Result<bool> JudgeAll(const Plan& plan, const ScoreOptions& options, CellTable& cells, TemporaryLines& answered,
                      PredictionFaults& faults, Meter& meter) {
  ASSIGN_OR_RETURN(const auto files, FindPredictions(options.predictions, plan, faults));
  for (std::size_t w = 0; w < plan.world_count(); ++w) {
    if (options.stop != nullptr && *options.stop) return false;
    const std::size_t cell = plan.CellAt(w, plan.MethodCount(w) - 1);
    std::string line = EncodeCellLine(cell, JudgeWorld(plan, w, files[w], faults));
    const CellLineHead head = *ReadCellLineHead(line);
    if (head.is_measured) {
      meter.Count(head.status);
      cells.Put(cell, std::move(line));
    } else {
      RETURN_IF_ERROR(answered.Add(cell, line));
    }
  }
  return true;
}

/// Returns the number of answers and their digest. The manifest and these two values identify the run.
Result<Json> DescribeAnswers(const Plan& plan, CellTable& cells, CellTable& answered) {
  Digest digest;
  std::size_t answers = 0;
  for (std::size_t w = 0; w < plan.world_count(); ++w) {
    const std::size_t cell = plan.CellAt(w, plan.MethodCount(w) - 1);
    ASSIGN_OR_RETURN(const auto scored, (cells.Has(cell) ? cells : answered).Read(cell, plan));
    for (const auto& [stage, value] : scored.row.result.digests) {
      if (stage != "answer") continue;
      digest.Add(NameOf(plan, w)).Add(value);
      ++answers;
    }
  }
  return Json{{"answers", answers}, {"digest", digest.Hex()}};
}

}  // namespace

Result<ScoreOutcome> ScorePredictions(const ScoreOptions& options,
                                      const std::function<void(const Progress&)>& on_progress) {
  // Read the scenarios, and check that the result folder is free.
  ASSIGN_OR_RETURN(auto suite, ReadTarget(options));
  RETURN_IF_ERROR(RefuseFiles(suite));
  suite.scored = ScoredMethod{options.name, options.alone};
  ASSIGN_OR_RETURN(const auto state, InspectFolder(options.output));
  if (state != FolderState::kFree) {
    return Fail({options.output, 0, 0}, "already contains a run; choose another folder with -o");
  }
  ASSIGN_OR_RETURN(const auto scenarios, PrepareTarget(suite, options));

  // Judge all answers; write nothing if any has a fault.
  ASSIGN_OR_RETURN(Fence fence, FenceFor(scenarios, options.outside, options.output, options.key));
  HideTruthIn(options.target, fence);
  RETURN_IF_ERROR(CheckMetricVectors(scenarios, fence));
  const Plan plan(scenarios);
  CellTable cells(plan.cell_count());
  TemporaryLines answered(plan.cell_count());
  Meter meter(plan.cell_count(), on_progress);
  ScoreOutcome outcome{.run = {.folder = options.output}, .faults = {}};
  ASSIGN_OR_RETURN(const auto judged, JudgeAll(plan, options, cells, answered, outcome.faults, meter));
  if (options.allow_missing) outcome.faults.missing.clear();
  outcome.run.stopped = !judged;
  if (outcome.run.stopped || !outcome.faults.empty()) return outcome;

  // Claim the result folder, write the manifest, and record the use of a key.
  ASSIGN_OR_RETURN(auto claimed, RunFolder::Claim(options.output, /*keep_contents=*/false));
  ASSIGN_OR_RETURN(auto manifest, MakeManifest(suite, scenarios, options.program_version));
  ASSIGN_OR_RETURN(const auto answers, DescribeAnswers(plan, cells, answered.cells()));
  manifest["scored"].update(answers);
  RETURN_IF_ERROR(AddPrograms(scenarios, fence, manifest));
  const fs::path folder = options.output;
  RETURN_IF_ERROR(SaveJson(Inside(folder) / "manifest.json", manifest));
  if (!suite.seed.IsPlain()) {
    const KeyUse use{"score", suite.suite, DigestOfRun(manifest), {}, folder};
    RETURN_IF_ERROR(NoteUse(*options.key, use, /*may_be_used=*/true));
  }
  // Run the scenarios' own methods and the outside metrics.
  const auto whole = RunOrders(suite, plan, plan.OrdersFor({}, cells.Done()),
                               {.program = ThisProgram(),
                                .error_folder = "",
                                .fence = fence,
                                .jobs = options.jobs,
                                .stop = options.stop,
                                .answered = &answered.cells()},
                               [&](const DeliveredCell& cell) -> Result<void> {
                                 if (!cell.head.is_measured) return answered.Add(cell.head.cell, cell.line);
                                 meter.Count(cell.head.status);
                                 cells.Put(cell.head.cell, std::string(cell.line));
                                 return {};
                               });
  if (!whole) return tl::unexpected(whole.error());
  // Write the results.
  outcome.run.stopped = !*whole;
  outcome.run.cells = meter.progress().cells_done;
  outcome.run.cells_ok = meter.progress().cells_ok;
  outcome.run.seconds = meter.progress().seconds;
  if (outcome.run.stopped) return outcome;
  Json host = DescribeHost(options.command_line, WorkerCount(options.jobs), outcome.run.seconds);
  if (!ProgramsOf(scenarios).empty()) {
    host["fence"] = fence.description();
    host["memory"] = fence.MemoryDescription();
  }
  RETURN_IF_ERROR(FinishRun(folder, plan, cells, host, WorkerCount(options.jobs), [&](double share) {
    meter.TellWritten(share);
    return true;
  }));
  claimed.Keep();
  return outcome;
}

}  // namespace etude
