#pragma once

#include <filesystem>
#include <vector>

#include "bench/gate/finished_run.h"
#include "bench/model/run_data.h"
#include "engine/base/result.h"
#include "io/drawing/film.h"
#include "io/real_takes/real_take.h"

namespace etude {

struct ReportOptions {
  /// If true, makes the films and the picture strip, which take most of a report's time. If false, the page says that
  /// no films were requested.
  bool pictures = true;
  /// If true, films show coached sessions from first to last frame, not only around a correction.
  bool whole_sessions = false;
  FilmWatch watch = {};
  std::vector<RealTake> real = {};  ///< captures of real films, shown beside the run's simulated captures
};

/// Writes the report of a run: `report/index.html` (self-contained), `report/summary.md`, `report/junit.xml`,
/// `report/tables/*.{csv,tex}`, and, if the run kept recordings, `report/motions/*.{bvh,js}`, `report/pictures/*.exr`
/// and `video/*.mp4`. Each file is written completely or not at all. Fails, naming the path, if a file cannot be
/// written. If a film cannot be made, the function does not fail; the page gives the reason. Returns false, and writes
/// no new page, if the films were stopped.
Result<bool> WriteReport(const RunData& run, const std::filesystem::path& run_folder, const ReportOptions& options);

/// The files that `etude gate` writes beside a report.
constexpr const char *kGateMarkdown = "gate.md", *kGateJunit = "gate.xml";

/// The result of comparing a report with its run.
struct ReportCheck {
  int files = 0;  ///< number of files that were compared
  /// Names of files that differ from the files made anew, or that belong to no report.
  std::vector<std::string> differences;
  std::vector<std::string> not_compared;  ///< descriptions of the files that exist but were not compared
};

/// Compares the tables, motions and page in a run's folder with the same files made anew from the run. Does not compare
/// pictures, films and captures of real films.
Result<ReportCheck> CheckReport(const RunData& run, const std::filesystem::path& run_folder);

/// Runs the gate without a baseline, and compares its output with the files that `etude gate` wrote beside the report.
/// Files of a gate with a baseline are listed as not compared.
Result<ReportCheck> CheckGate(const FinishedRun& run, const std::filesystem::path& run_folder);

}  // namespace etude
