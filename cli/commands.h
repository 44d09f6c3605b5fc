#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/gate/finished_run.h"
#include "bench/results/folder.h"
#include "cli/arguments.h"
#include "engine/base/result.h"

namespace etude {

struct RunOptions;
struct RunOutcome;

// The exit codes of all commands.
constexpr int kSuccess = 0;
constexpr int kNothingWorked = 1;
constexpr int kRegression = 1;
constexpr int kUnusableInput = 2;
constexpr int kIncompleteRun = 3;
constexpr int kInterrupted = 130;

/// Prints an error message in the standard form. Returns kUnusableInput, or kIncompleteRun if the error's cause is this
/// machine.
int Complain(const Error& error);
/// Returns a command's exit code. For an error, prints it as Complain does and returns Complain's code.
int Finish(const Result<int>& code);
/// Prints that Ctrl-C stopped the work, and `what_is_left` of the output. Returns kInterrupted.
int TellStopped(const Error& what_is_left = {{}, "stopped; no files are kept"});
/// Returns `code`. If another run has replaced the folder while this run wrote files into it, complains and returns
/// kIncompleteRun instead.
Result<int> UnlessReplaced(const std::string& folder, const RunData& run, int code);
/// Warns on standard error that data were read although no valid seal confirms them. If `why` is "", the seal is valid
/// and nothing is printed.
void TellUnsealed(const std::string& why);
/// Reads a baseline, and warns if no seal confirms its content. Fails if the baseline's seal is invalid, unless seals
/// are ignored.
Result<Snapshot> TakeBaseline(const std::string& path, Sealing sealing);
/// Runs scenarios with a progress bar. Reports a result folder that could not be locked, changes that reading made to
/// clips, clips that were left out, damaged lines of a resumed run's journal, and outside methods that ran without a
/// fence. If the run was stopped, reports that and returns nullopt.
Result<std::optional<RunOutcome>> RunWithProgress(RunOptions options);
/// Returns true if standard output was closed before the program started, so that nobody reads it.
bool OutputWasClosed();
/// Returns the number of characters of a UTF-8 text, which is its width on a terminal.
std::size_t CountCharacters(std::string_view text);
/// Returns "1 world", "3 worlds".
std::string CountOf(std::size_t count, std::string_view what);
/// Returns at most `most` of the lines. If there are more, "and N " and `rest` follow as a last line.
std::vector<std::string> FirstLines(std::vector<std::string> lines, std::size_t most, std::string_view rest);
/// Prints a title and indented lines; prints nothing if there are no lines.
void PrintList(const std::string& title, const std::vector<std::string>& lines);

// Each command is defined in a file with the command's name. `command_line` is recorded in host.json.

/// `etude run`: runs scenarios with a progress bar and prints the verdicts; with --dry-run, only forecasts the duration
/// and the detectable differences.
void DefineRun(CLI::App& app, const std::string& command_line, Action& action);
/// `etude evaluate TRUTH RESULT…`: compares motions in files with the truth, and writes a run.
void DefineEvaluate(CLI::App& app, const std::string& command_line, Action& action);
/// `etude scenario copy NAME FOLDER`: copies a scenario that comes with etude.
void DefineScenario(CLI::App& app, Action& action);
/// `etude merge DIR… -o DIR`: merges shards into one run.
void DefineMerge(CLI::App& app, const std::string& command_line, Action& action);
/// `etude report DIR`: writes DIR/report and DIR/video; with --blind, DIR/blind instead.
void DefineReport(CLI::App& app, Action& action);
/// `etude blind FILE…`: summarises people's answers to pages of `etude report --blind`.
void DefineBlind(CLI::App& app, Action& action);
/// `etude rows DIR`: writes the rows as lines of text.
void DefineRows(CLI::App& app, Action& action);
/// `etude replay DIR|FILE`: runs cells again and compares the results stage by stage (exit code 1 if a cell differs),
/// or packs one cell into a file.
void DefineReplay(CLI::App& app, Action& action);
/// `etude cite DIR`: prints a BibTeX entry, and a sentence that identifies the run.
void DefineCite(CLI::App& app, Action& action);
/// `etude verify DIR`: recomputes and replays the results of a run (exit code 1 if any result differs), signs the run,
/// and checks a signature.
void DefineVerify(CLI::App& app, Action& action);
/// `etude gate`: exit code 0 = passed, 1 = regression or unmet expectation, 2 = bad input, 3 = incomplete.
void DefineGate(CLI::App& app, Action& action);
/// `etude compare A B`: prints the differences between two runs of the same worlds.
void DefineCompare(CLI::App& app, Action& action);
/// `etude export`: writes problems, and, separately, the truth about these problems.
void DefineExport(CLI::App& app, Action& action);
/// `etude score`: scores a folder of answers into a result folder.
void DefineScore(CLI::App& app, const std::string& command_line, Action& action);
/// `etude check-method … -- CMD…`: tests whether a program implements the protocol of outside methods; exit code 1 if
/// the program does not.
void DefineCheckMethod(CLI::App& app, Action& action);
/// `etude list …`: lists what a scenario can name.
void DefineList(CLI::App& app, Action& action);
/// `etude clip info|convert|render|contacts|map|grades`
void DefineClip(CLI::App& app, Action& action);
/// `etude clip render`: draws a contact sheet of any clips, or a film of one clip.
void DefineRender(CLI::App& clip, Action& action);
/// `etude clip grades`: prints the fuzzy features, tags and poses of clips (paper A), and how similar clips are.
void DefineGrades(CLI::App& clip, Action& action);
/// `etude bridge`: finds bridge frames of clips and writes a tags file and a summary; or checks a tags file (exit code
/// 2 if the check fails).
void DefineBridge(CLI::App& app, Action& action);
/// `etude transition FROM TO --at S -o FILE`: writes a transition from one clip into another; exit code 1 if there is
/// no such transition.
void DefineTransition(CLI::App& app, Action& action);
/// `etude train`: learns a fuzzy system or a recogniser from clips, and prints the scores of the result on held-out
/// clips.
void DefineTrain(CLI::App& app, Action& action);
/// `etude teach`: learns moves from recordings.
void DefineTeach(CLI::App& app, Action& action);
/// `etude recognise`: prints recognised moves as JSON Lines, and scores if labels are given.
void DefineRecognise(CLI::App& app, Action& action);
/// `etude sensor stats|fit`
void DefineSensor(CLI::App& app, Action& action);
/// `etude calibrate`: finds the cameras of a rig from point pairs or pictures of boards, or prints a board.
void DefineCalibrate(CLI::App& app, Action& action);
/// `etude capture`: finds the motion of a person in films by several cameras.
void DefineCapture(CLI::App& app, const std::string& command_line, Action& action);
/// `etude forecast RIG`: forecasts the errors of captures with this rig.
void DefineForecast(CLI::App& app, const std::string& command_line, Action& action);
/// `etude coach`: coaches a song live from a skeleton stream.
void DefineCoach(CLI::App& app, Action& action);
/// `etude completion SHELL`: prints a script for a shell.
void DefineCompletion(CLI::App& app, Action& action);
/// `etude man`, hidden in the help: writes the manual pages, for the Debian package.
void DefineManual(CLI::App& app, Action& action);
/// `etude crowd`: solves the poses of a crowd on one core, reports the time per frame, and makes a film of the crowd.
void DefineCrowd(CLI::App& app, Action& action);

/// Prints what a run would compute, how long it would take and which differences it could show, as text or as JSON.
/// Returns the exit code.
int DryRunCommand(const RunOptions& options, bool as_json);

}  // namespace etude
