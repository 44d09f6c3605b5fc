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
  /// Draws the film and the picture strip. They take most of a report's time; without them the page says that none was
  /// asked for.
  bool pictures = true;
  /// Films show coached sessions from their first frame to their last, not around a correction.
  bool whole_sessions = false;
  FilmWatch watch = {};
  std::vector<RealTake> real = {};  ///< captures of real films, shown beside the run's own
};

/// Writes the report of a run: `report/index.html` (self-contained), `report/summary.md`, `report/junit.xml`,
/// `report/tables/*.{csv,tex}`, and, as far as the run kept recordings, `report/motions/*.{bvh,js}`,
/// `report/pictures/*.exr` and `video/*.mp4`. Each file appears whole or not at all. Fails, naming the path, when a
/// file cannot be written; a film that cannot be made is no failure: the page says why. False when the films were
/// stopped: there is no new page then.
Result<bool> WriteReport(const RunData& run, const std::filesystem::path& run_folder, const ReportOptions& options);

/// The files that `etude gate` leaves beside a report.
constexpr const char *kGateMarkdown = "gate.md", *kGateJunit = "gate.xml";

/// A report held against its run.
struct ReportCheck {
  int files = 0;                          ///< that are there and were compared
  std::vector<std::string> differences;   ///< what one says that the run does not, and files that are none of a report
  std::vector<std::string> not_compared;  ///< what is there and was not, in words
};

/// Compares the tables, motions and page of a folder with those that its run makes, but for pictures, films and
/// captures of real films.
Result<ReportCheck> CheckReport(const RunData& run, const std::filesystem::path& run_folder);

/// Compares what a gate left beside the report with what one without a baseline says of the run.
Result<ReportCheck> CheckGate(const FinishedRun& run, const std::filesystem::path& run_folder);

}  // namespace etude
