#include "bench/dataset/export.h"

#include <fcntl.h>
#include <fmt/ranges.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <utility>

#include "bench/dataset/layout.h"
#include "bench/dataset/take_films.h"
#include "bench/run/manifest.h"
#include "bench/run/plan.h"
#include "bench/run/suite.h"
#include "bench/run/used_keys.h"
#include "engine/base/csv.h"
#include "engine/base/machine.h"
#include "io/files/files.h"
#include "io/files/json.h"

namespace etude {
namespace {

namespace fs = std::filesystem;

constexpr const char* kReadme =
    R"(# A data set of Etude

- `inputs/` contains what a method may see. Share this folder.
- `truth/` contains the truth, which is needed to judge answers. Do not share this folder. Do not share `manifest.json`
  either, because Etude can make the truth from the manifest.

`inputs/index.csv` lists the problems. A problem is `SCENARIO/CONDITION/TRIAL/problem.json`, and its files are in the
same folder. `SCENARIO/CONDITION/setting.json` contains the data that all problems of a condition share. For recorded
people, each problem has its own `setting.json`. Etude's `docs/outside-methods.md` describes problems and answers of
every task. A method's predictions are a folder of answers, one JSON object per problem, with the names
`SCENARIO/CONDITION/TRIAL.json`. If pictures that `problem.json` lists are missing, extract them from the film:
`ffmpeg -i camera-1.mkv -start_number 0 camera-1-%04d.png`. This command judges the answers:

    etude score THIS_FOLDER PREDICTIONS -o RESULT --name METHOD
)";

/// Returns the canonical absolute path of a folder, without a slash at its end.
fs::path Named(const fs::path& path) {
  std::error_code error;
  const fs::path named = fs::weakly_canonical(fs::absolute(path, error), error);
  return named.has_filename() ? named : named.parent_path();
}

/// Returns the temporary folder next to `path`. An export fills it first and then renames it.
fs::path PartialOf(const fs::path& path) { return Named(path).string() + ".partial"; }

/// Opens and locks a folder. Returns its file descriptor, or −1 if it cannot be opened or another process has the lock.
int Lock(const fs::path& folder) {
  const int lock = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (lock < 0 || LockUnlessTaken(lock, folder)) return lock;
  ::close(lock);
  return -1;
}

/// Returns true if an export creates a file or folder of this name at the top of its data set.
bool IsOfExport(const fs::path& name) {
  constexpr std::array kParts = {"inputs", "truth", "README.md", "manifest.json"};
  return std::ranges::any_of(kParts, [&](const char* part) { return name == part || name == TemporaryName(part); });
}

/// Fills a folder under a temporary name and renames it when it is complete. The destructor deletes an incomplete
/// folder.
class NewFolder {
 public:
  static Result<NewFolder> Begin(const fs::path& path) {
    const Place place{path.string(), 0, 0};
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (fs::exists(status) && !fs::is_directory(status)) return Fail(place, "is not a folder");
    if (fs::is_directory(status) && !fs::is_empty(path, error)) {
      return Fail(place, "is not empty; choose another folder with -o");
    }
    const fs::path partial = PartialOf(path);
    RETURN_IF_ERROR(MakeFolder(Inside(partial.parent_path()) / partial.filename()));
    NewFolder folder(path, Lock(partial));
    if (folder.lock_ < 0)
      return Fail(place, "another export is writing into this folder; choose another folder with -o");
    // Empty the folder that a killed export left. Refuse a folder with other contents.
    for (fs::directory_iterator entry(folder.partial_, error), end; !error && entry != end; entry.increment(error)) {
      if (IsOfExport(entry->path().filename())) continue;
      ::close(std::exchange(folder.lock_, -1));
      return Fail({entry->path().string()}, "is not a file of an export; choose another folder with -o");
    }
    for (fs::directory_iterator entry(folder.partial_, error), end; !error && entry != end; entry.increment(error)) {
      fs::remove_all(entry->path(), error);
    }
    if (error) return CannotWrite(folder.partial_.string(), "cannot be emptied", error.value());
    return folder;
  }
  NewFolder(NewFolder&& other) noexcept
      : path_(std::move(other.path_)), partial_(std::move(other.partial_)), lock_(std::exchange(other.lock_, -1)) {}
  NewFolder& operator=(NewFolder&&) = delete;
  ~NewFolder() {
    if (lock_ < 0) return;
    std::error_code ignored;
    if (IsOurs(partial_)) fs::remove_all(partial_, ignored);
    ::close(lock_);
  }

  /// Returns the temporary folder. Writing below it never follows a link, even if a link replaces the folder.
  FilePath partial() const { return Inside(partial_.parent_path()) / partial_.filename(); }

  /// Syncs the folder's contents to disk, then renames the folder to its final name.
  Result<void> Finish() {
    RETURN_IF_ERROR(SyncTree(partial_));
    if (!IsOurs(partial_))
      return Fail({partial_.string()}, "was replaced or removed by another program during the export");
    std::error_code error;
    fs::rename(partial_, path_, error);
    if (error) return CannotWrite(path_.string(), "cannot be written", error.value());
    ::close(std::exchange(lock_, -1));
    return SyncPathTo(path_);
  }

 private:
  NewFolder(const fs::path& path, int lock) : path_(Named(path)), partial_(PartialOf(path)), lock_(lock) {}

  /// Returns true if `name` is still the path of the locked folder.
  bool IsOurs(const fs::path& name) const {
    struct stat locked {
    }, named{};
    return ::fstat(lock_, &locked) == 0 && ::lstat(name.c_str(), &named) == 0 && locked.st_ino == named.st_ino &&
           locked.st_dev == named.st_dev;
  }

  fs::path path_, partial_;
  int lock_;  ///< file descriptor that has the lock; −1 after Finish
};

Result<void> SavePayload(const Payload& payload, const FilePath& folder, const char* name) {
  RETURN_IF_ERROR(SaveJson(folder / name, *payload.json, OnDisk::kLater));
  for (const Attachment& file : payload.files) {
    if (IsPictureOfTake(file.name)) continue;  // a frame of a film, which SaveFilms writes
    RETURN_IF_ERROR(WriteFileAtomically(folder / file.name, file.bytes, OnDisk::kLater));
  }
  return {};
}

class Exporter {
 public:
  static constexpr std::size_t kParts = 3;  ///< steps per world: problem made, problem written, truth written

  Exporter(const PreparedScenario& scenario, FilePath folder, bool depth)
      : scenario_(scenario), folder_(std::move(folder)), depth_(depth) {}

  /// Writes the setting that all worlds of a condition share. Does nothing if each world has a setting of its own.
  Result<void> SaveSetting(int condition, const std::string& place) {
    if (scenario_.task(condition).HasOwnSettings()) return {};
    const auto setting = scenario_.task(condition).Setting();
    if (!setting) return About(place, setting.error());
    return SavePayload(*setting, folder_ / "inputs" / place, "setting.json");
  }

  /// Writes the problem and the truth of a world, and appends the world's line to `index`. Calls `on_part(1)` when the
  /// problem is made and `on_part(2)` when it is written.
  Result<void> SaveWorld(int condition, int trial, const std::string& place, ExportOutcome& outcome,
                         std::vector<std::string>& index, const std::function<void(std::size_t)>& on_part) {
    const auto world = scenario_.task(condition).MakeWorld(scenario_.KeyOf(condition, trial), /*keeps_motion=*/false);
    const std::string path = place + "/" + WorldName(scenario_, condition, trial);
    const Row row = scenario_.IdentityOf(condition, trial, 0);
    const auto why_skipped = world->WhySkipped();
    const bool is_plain = scenario_.setup().seed.IsPlain();
    index.push_back(fmt::format("{},{},{},{},{},{},{},{}\n", CsvText(row.scenario), row.task,
                                CsvText(ConditionLabel(row.condition)), is_plain ? fmt::format("{}", trial) : "",
                                is_plain ? CsvText(row.clip) : "", why_skipped ? "" : CsvText(path + "/problem.json"),
                                why_skipped ? "" : CsvText(path + ".json"), CsvText(why_skipped.value_or(""))));
    if (why_skipped) {
      ++outcome.skipped;
      return {};
    }
    ++outcome.problems;
    // Free the problem before the truth is made, because the pictures of a world need much memory.
    {
      const auto problem = world->MakeProblem();
      if (!problem) return About(path, problem.error());
      on_part(1);
      RETURN_IF_ERROR(SavePayload(*problem, folder_ / "inputs" / path, "problem.json"));
      if (scenario_.task(condition).HasOwnSettings()) {
        const auto setting = world->MakeSetting();
        if (!setting) return About(path, setting.error());
        RETURN_IF_ERROR(SavePayload(*setting, folder_ / "inputs" / path, "setting.json"));
      }
      RETURN_IF_ERROR(SaveFilms(*problem, condition, path));
      on_part(2);
    }
    const auto truth = world->MakeTruth();
    if (!truth) return About(path, truth.error());
    RETURN_IF_ERROR(SavePayload(*truth, folder_ / "truth" / path, "truth.json"));
    if (!depth_) return {};
    const auto drawn = world->MakeTruePictures([&](const Attachment& file) {
      return WriteFileAtomically(folder_ / "truth" / path / file.name, file.bytes, OnDisk::kLater);
    });
    return drawn ? drawn : About(path, drawn.error());
  }

 private:
  /// Writes the pictures of each take as a film, at the rate in the condition's setting. Does nothing if there
  /// are no takes.
  Result<void> SaveFilms(const Payload& problem, int condition, const std::string& path) const {
    const auto is_picture = [](const Attachment& file) { return IsPictureOfTake(file.name); };
    if (std::ranges::none_of(problem.files, is_picture)) return {};
    const auto setting = scenario_.task(condition).Setting();
    if (!setting) return About(path, setting.error());
    const double rate_hz = setting->json->value("rate_hz", 30.0);
    const auto saved = SaveTakeFilms(problem.files, rate_hz, folder_ / "inputs" / path);
    return saved ? saved : About(path, saved.error());
  }

  Result<void> About(const std::string& place, const Error& error) const {
    return Fail({scenario_.setup().file, 0, 0}, "{}: {}", place, ToString(error));
  }

  const PreparedScenario& scenario_;
  const FilePath folder_;
  const bool depth_;
};

}  // namespace

void RemoveUnfinishedExport(const fs::path& output) {
  const fs::path partial = PartialOf(output);
  const int lock = Lock(partial);
  if (lock < 0) return;
  std::error_code ignored;
  fs::remove_all(partial, ignored);
  ::close(lock);
}

Result<ExportOutcome> ExportSuite(const ExportOptions& options, const OnProgress& on_progress) {
  // Read and prepare the scenarios as for a run.
  RunOptions run;
  run.scenarios = options.scenarios;
  run.seed = options.seed;
  run.key = options.key;
  run.trials = options.trials;
  run.clips = options.clips;
  run.joint_map = options.joint_map;
  run.clip_facts = options.clip_facts;
  ASSIGN_OR_RETURN(const auto suite, ReadSuite(run));
  RETURN_IF_ERROR(RefuseFiles(suite));
  ASSIGN_OR_RETURN(const auto scenarios, PrepareAll(suite));
  ASSIGN_OR_RETURN(auto manifest, MakeManifest(suite, scenarios, options.program_version));
  // Check that the key was not used before, and create the folder.
  const KeyUse use{"export", suite.suite, DigestOfRun(manifest), {}, options.output};
  if (options.key && !options.reuse_key) RETURN_IF_ERROR(CheckUnused(*options.key, use));
  ASSIGN_OR_RETURN(auto folder, NewFolder::Begin(options.output));

  // Write all worlds. Write the setting of each condition before its first world.
  const Plan plan(scenarios);
  ExportOutcome outcome;
  std::vector<std::string> index;
  const std::size_t parts = plan.world_count() * Exporter::kParts;
  on_progress(0, parts);
  for (std::size_t w = 0; w < plan.world_count(); ++w) {
    const World& world = plan.world(w);
    const PreparedScenario& scenario = plan.scenario_of(w);
    const std::string place = scenario.scenario().name + "/" + ConditionFolders(scenario.scenario())[world.condition];
    Exporter exporter(scenario, folder.partial(), options.depth);
    if (world.trial == 0) {
      RETURN_IF_ERROR(exporter.SaveSetting(world.condition, place));
    }
    RETURN_IF_ERROR(exporter.SaveWorld(world.condition, world.trial, place, outcome, index,
                                       [&](std::size_t part) { on_progress(w * Exporter::kParts + part, parts); }));
    on_progress((w + 1) * Exporter::kParts, parts);
  }
  // Write the index, the README and the manifest. If the worlds are secret, sort the index, because the order of
  // writing would reveal their trials.
  const auto save = [&](const char* name, const std::string& text) {
    return WriteFileAtomically(folder.partial() / name, text);
  };
  if (!suite.seed.IsPlain()) std::ranges::sort(index);
  index.insert(index.begin(), "scenario,task,condition,trial,clip,problem,prediction,skipped\n");
  RETURN_IF_ERROR(save("inputs/index.csv", fmt::format("{}", fmt::join(index, ""))));
  RETURN_IF_ERROR(save("README.md", kReadme));
  manifest["data_set"] = kDataSetVersion;
  RETURN_IF_ERROR(SaveJson(folder.partial() / "manifest.json", manifest));
  if (options.key) RETURN_IF_ERROR(NoteUse(*options.key, use, options.reuse_key));
  RETURN_IF_ERROR(folder.Finish());
  return outcome;
}

}  // namespace etude
