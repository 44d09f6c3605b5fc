#pragma once

#include <string>
#include <vector>

#include "bench/run/run.h"

namespace etude {

/// Exit codes of every command.
constexpr int kSuccess = 0;
constexpr int kNothingWorked = 1;
constexpr int kBadInput = 2;
constexpr int kInterrupted = 130;

/// `etude run`: runs scenarios with a progress bar and prints the verdicts.
int RunCommand(const RunOptions& options);
/// `etude report DIR`: writes DIR/report and DIR/video.
int ReportCommand(const std::string& folder, bool with_video);

enum class Listing { kMethods, kMetrics, kScenarios, kClips };
/// `etude list …`: what can be named in a scenario.
int ListCommand(Listing what, const std::string& scenario_folder);

/// Prints a complaint the one way Etude does, and gives kBadInput.
int Complain(const Error& error);

}  // namespace etude
