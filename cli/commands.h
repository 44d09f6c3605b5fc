#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/dataset/export.h"
#include "bench/dataset/score.h"
#include "bench/outside/outside_method.h"
#include "bench/results/folder.h"
#include "bench/run/run.h"
#include "reports/report.h"

namespace etude {

/// Exit codes of every command.
constexpr int kSuccess = 0;
constexpr int kNothingWorked = 1;
constexpr int kRegression = 1;
constexpr int kUnusableInput = 2;
constexpr int kIncomplete = 3;
constexpr int kInterrupted = 130;

/// `etude run`: runs scenarios with a progress bar and prints the verdicts.
int RunCommand(const RunOptions& options);
/// `etude run --dry-run`: what a run would take and could show; writes nothing.
int DryRunCommand(const RunOptions& options);
/// `etude merge DIR… -o DIR`: makes one run of its shards.
int MergeCommand(const MergeOptions& options);
/// What `etude replay` is asked.
struct ReplayCommandOptions {
  std::string target;              ///< a result folder, or a packed cell
  std::vector<std::string> cells;  ///< by name; none: all
  std::size_t sample = 0;          ///< this many of them, drawn by the run's seed; 0 = all
  std::string pack_file;           ///< into which the one cell is packed instead, "" = none
  bool overwrite = false;
  int jobs = 0;
  OutsideRules outside;
  Sealing sealing = Sealing::kRequired;
};
/// `etude replay DIR|FILE`: runs cells again and compares them stage by stage (exit 1 when one differs), or packs one.
int ReplayCommand(const ReplayCommandOptions& options);
/// What `etude gate` is asked.
struct GateOptions {
  std::string target;         ///< a result folder; of a self-test a scenario file, "" = the built-in one
  std::string baseline;       ///< a baseline file, "" = none
  bool update = false;        ///< write the baseline from the run, and show what moved
  bool self_test = false;     ///< measure the gate's own false alarms and power
  int repetitions = 40;       ///< of the self-test: pairs of seeds
  std::optional<int> trials;  ///< of the self-test: worlds per condition, else the scenario's
  bool verdicts = false;      ///< of the self-test: measure the verdicts beyond a run's worlds instead
  Sealing sealing = Sealing::kRequired;
};
/// `etude gate --self-test --verdicts`: the table of docs/results.md from so many samples of each design (exit 1 when a
/// promise is broken).
int VerdictsCommand(int repetitions);
/// `etude gate`: exit 0 pass, 1 regression or unmet expectation, 2 bad input, 3 incomplete.
int GateCommand(const GateOptions& options);
/// `etude compare A B`: what differs between two runs of the same worlds.
int CompareCommand(const std::string& a, const std::string& b, Sealing sealing);
/// `etude check-method [--task T] [--time S] [--memory MB] -- CMD…`: whether a program speaks the protocol of methods
/// outside; exit 1 when it does not.
int CheckMethodCommand(OutsideOptions options, const std::string& seat, bool is_fenced);
/// `etude export`: writes problems, and their truth apart.
int ExportCommand(const ExportOptions& options);
/// `etude score`: scores a folder of answers into a result folder.
int ScoreCommand(const ScoreOptions& options);
/// `etude rows DIR`: writes the rows as lines of text into `file`, "" = to standard output.
int RowsCommand(const std::string& folder, const std::string& file, bool overwrite, Sealing sealing);
/// `etude report DIR`: writes DIR/report and DIR/video.
/// `real`: files that `etude capture --distances` wrote.
int ReportCommand(const std::string& folder, const std::vector<std::string>& real, const ReportOptions& options,
                  Sealing sealing);

enum class Listing { kMethods, kScenarios, kClips, kRecordings };
/// `etude list …`: what can be named in a scenario, and the page docs/recordings.md.
int ListCommand(Listing what, const std::string& scenario_folder);

enum class KeysFormat {
  kText,      ///< for people at a terminal
  kMarkdown,  ///< docs/keys.md
  kSchema,    ///< docs/schemas/scenario.schema.json
};
/// `etude list keys`: every key of a scenario file.
int ListKeysCommand(KeysFormat format);

enum class MetricsFormat {
  kTable,     ///< a line each, for people at a terminal
  kJson,      ///< everything, with the test vectors (docs/schemas/metrics.schema.json)
  kMarkdown,  ///< docs/metrics.md
};
/// `etude list metrics`.
int ListMetricsCommand(MetricsFormat format);

/// Says on standard error that a run was read although its folder is not as it was written.
void TellUnsealed(const RunData& run);

/// Prints a complaint the one way Etude does, and gives kUnusableInput.
int Complain(const Error& error);
/// Says that Ctrl-C came and what it left, and gives kInterrupted.
int TellStopped(const Error& what_is_left = {{}, "stopped; nothing is kept"});

}  // namespace etude
