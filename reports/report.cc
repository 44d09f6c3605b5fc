#include "reports/report.h"

#include <algorithm>
#include <set>

#include "bench/recordings/capture_extras.h"
#include "io/drawing/escape.h"
#include "io/files/files.h"
#include "reports/comparison_table.h"
#include "reports/films/media.h"
#include "reports/gate_table.h"
#include "reports/junit.h"
#include "reports/page.h"
#include "reports/page_check.h"
#include "reports/paper/paper_b_section.h"
#include "reports/viewer/world_script.h"
#include "reports/words/cell_series.h"

namespace etude {
namespace {

namespace fs = std::filesystem;

constexpr const char *kReportFolder = "report", *kFilmsFolder = "video", *kPicturesFolder = "pictures";
constexpr const char* kPage = "index.html";
constexpr const char *kStranger = " is not a file of this run's report",
                     *kOtherwise = " differs from a new report of this run";

/// A text file of a report; `path` is relative to `report`.
struct ReportText {
  fs::path path;
  std::string text;
};

void AddTables(const RunData& run, std::vector<ReportText>& texts) {
  for (std::size_t i = 0; i < run.scenarios.size(); ++i) {
    const ScenarioSummary& scenario = run.scenarios[i];
    const std::string name = "tables/" + FileNameOf(scenario.name, i);
    texts.push_back({name + ".csv", NumberTableCsv(run, scenario)});
    texts.push_back({name + "-comparisons.csv", ComparisonTableCsv(scenario)});
    texts.push_back({name + ".tex", ScenarioLatex(run, scenario)});
    std::string csv = PaperBCsv(run, scenario);
    if (!csv.empty()) texts.push_back({name + "-paper-b.csv", std::move(csv)});
  }
}

// Adds two kinds of motion files: BVH files of the motions that captures recovered, for other programs, and the scripts
// with the motions that the page shows.
Result<void> AddMotions(const RunData& run, std::vector<ReportText>& texts) {
  for (const auto& [row, recorded] : RecordedRows(run)) {
    if (row->task != "capture") continue;
    ASSIGN_OR_RETURN(auto extras, ReadCaptureExtras(recorded->recording.extras_json));
    texts.push_back({fs::path("motions") / MotionFileOf(recorded->cell), std::move(extras.bvh)});
  }
  for (const RecordedWorld& world : RecordedWorlds(run)) texts.push_back({world.file, WorldScript(run, world)});
  return {};
}

/// Returns all text files of a report except the page.
Result<std::vector<ReportText>> TextsOf(const RunData& run) {
  std::vector<ReportText> texts = {{"summary.md", WriteMarkdown(run)}, {"junit.xml", WriteJunit(run)}};
  AddTables(run, texts);
  RETURN_IF_ERROR(AddMotions(run, texts));
  return texts;
}

}  // namespace

Result<bool> WriteReport(const RunData& run, const std::filesystem::path& run_folder, const ReportOptions& options) {
  const FilePath folder = Inside(run_folder) / kReportFolder, films = Inside(run_folder) / kFilmsFolder;
  for (const FilePath& made : {folder, films}) RETURN_IF_ERROR(PlainFilesBelow(made));
  // Write the texts that need no rendering first, so that they exist even if rendering the film fails.
  ASSIGN_OR_RETURN(const auto texts, TextsOf(run));
  for (const auto& [path, text] : texts) RETURN_IF_ERROR(WriteFileAtomically(folder / path, text));

  Media media;
  if (options.pictures) {
    media = MakeMedia(run, {.films = films, .pictures = folder / kPicturesFolder},
                      {.whole_sessions = options.whole_sessions, .watch = options.watch});
    if (options.watch.IsStopped()) return false;
  } else {
    media.film.why_not = "There is no film, because this report was made without films.";
  }
  RETURN_IF_ERROR(WriteFileAtomically(folder / kPage, WritePage(run, media, options.real)));
  return true;
}

Result<ReportCheck> CheckReport(const RunData& run, const std::filesystem::path& run_folder) {
  ReportCheck check;
  ASSIGN_OR_RETURN(const auto texts, TextsOf(run));
  const FilePath folder = Inside(run_folder) / kReportFolder, films = Inside(run_folder) / kFilmsFolder;
  // Compare the text files, byte for byte.
  std::set<fs::path> names = {kPage, kGateMarkdown, kGateJunit};
  for (const auto& [path, text] : texts) {
    names.insert(path);
    if (!Exists(folder / path)) continue;
    ++check.files;
    ASSIGN_OR_RETURN(const auto found, ReadWholeFile(folder / path));
    if (found != text) check.differences.push_back((folder / path).string() + kOtherwise);
  }
  // Compare the page. The rows of real films do not belong to the run and are not compared. If the page has a
  // section of real films, the new page is made with one empty take: it then has this section, too, and all other
  // parts can be compared.
  bool has_media = false;
  if (const FilePath page = folder / kPage; Exists(page)) {
    ++check.files;
    ASSIGN_OR_RETURN(const auto found, ReadWholeFile(page));
    std::vector<RealTake> takes(found.find(kTakesBegin) == std::string::npos ? 0 : 1);
    const PageCheck compared = CheckPage(found, WritePage(run, {}, takes));
    if (!compared.same) check.differences.push_back(page.string() + kOtherwise);
    if (compared.has_takes) check.not_compared.push_back(page.string() + ": rows of captures of real films");
    has_media = compared.has_media;
  }
  // List files in the report's folder that no report of this run contains.
  ASSIGN_OR_RETURN(const auto beside, PlainFilesBelow(folder));
  for (const fs::path& name : beside) {
    const bool is_picture = name.parent_path() == kPicturesFolder && name.extension() == ".exr";
    has_media = has_media || is_picture;
    if (!is_picture && !names.contains(name)) check.differences.push_back((folder / name).string() + kStranger);
  }
  ASSIGN_OR_RETURN(const auto filmed, PlainFilesBelow(films));
  const std::set<std::string> film_names = FilmNames(run);
  for (const fs::path& name : filmed) {
    if (!film_names.contains(name.string())) check.differences.push_back((films / name).string() + kStranger);
  }
  if (has_media || !filmed.empty()) {
    check.not_compared.push_back(
        "report/ and video/: pictures and films with their captions; `etude report` makes new ones");
  }
  return check;
}

Result<ReportCheck> CheckGate(const FinishedRun& run, const std::filesystem::path& run_folder) {
  ReportCheck check;
  const FilePath folder = Inside(run_folder) / kReportFolder;
  ASSIGN_OR_RETURN(const auto report, JudgeRun(run, nullptr, ""));
  bool has_baseline = false;
  for (const auto& [name, text] :
       {std::pair(kGateMarkdown, WriteGateMarkdown(report)), std::pair(kGateJunit, WriteGateJunit(report))}) {
    if (!Exists(folder / name)) continue;
    ASSIGN_OR_RETURN(const auto found, ReadWholeFile(folder / name));
    has_baseline = has_baseline || found.find("\nBaseline ") != std::string::npos;
    if (has_baseline) {
      check.not_compared.push_back(
          (folder / name).string() +
          ": the result of a gate with a baseline, because the run does not contain the baseline");
      continue;
    }
    ++check.files;
    if (found != text) check.differences.push_back((folder / name).string() + kOtherwise);
  }
  return check;
}

}  // namespace etude
