#pragma once

#include <string>
#include <vector>

#include "bench/gate/finished_run.h"
#include "bench/results/folder.h"
#include "cli/arguments.h"
#include "engine/base/result.h"

namespace etude {

struct RunOutcome;

// Exit codes of every command.
constexpr int kSuccess = 0;
constexpr int kNothingWorked = 1;
constexpr int kRegression = 1;
constexpr int kUnusableInput = 2;
constexpr int kIncomplete = 3;
constexpr int kInterrupted = 130;

/// Prints a complaint the one way Etude does, and gives kUnusableInput; kIncomplete of an error of this machine.
int Complain(const Error& error);
/// Gives a command's exit code; without one what Complain gives.
int Finish(const Result<int>& code);
/// Says that Ctrl-C came and what it left, and gives kInterrupted.
int TellStopped(const Error& what_is_left = {{}, "stopped; nothing is kept"});
/// Gives `code`; but where another run has taken the folder's place while files of this one were written into it, says
/// so and gives kIncomplete.
Result<int> UnlessReplaced(const std::string& folder, const RunData& run, int code);
/// Says on standard error that something was read although its seal does not vouch for it; "" = it does.
void TellUnsealed(const std::string& why);
/// Reads a baseline, and says when no seal vouches for it. One whose seal does not fit is refused unless seals are
/// ignored.
Result<Snapshot> TakeBaseline(const std::string& path, Sealing sealing);
/// Prints the tables of a finished run, and why methods have no answer; gives 1 when one has none, or no cell is ok.
int ShowOutcome(const RunOutcome& outcome);
/// Tells whether the parent had closed our standard output, so that nobody will read what is printed.
bool OutputWasClosed();
/// Prints a title and indented lines, or nothing without lines.
void PrintList(const std::string& title, const std::vector<std::string>& lines);

// Each command stands in a file of its name, and defines itself. `command_line` is kept in host.json.

/// `etude run`: runs scenarios with a progress bar and prints the verdicts; with --dry-run tells what it would take.
void DefineRun(CLI::App& app, const std::string& command_line, Action& action);
/// `etude scenario copy NAME FOLDER`: copies what comes with etude.
void DefineScenario(CLI::App& app, Action& action);
/// `etude merge DIR… -o DIR`: makes one run of its shards.
void DefineMerge(CLI::App& app, const std::string& command_line, Action& action);
/// `etude report DIR`: writes DIR/report and DIR/video.
void DefineReport(CLI::App& app, Action& action);
/// `etude rows DIR`: writes the rows as lines of text.
void DefineRows(CLI::App& app, Action& action);
/// `etude replay DIR|FILE`: runs cells again and compares them stage by stage (exit 1 when one differs), or packs one.
void DefineReplay(CLI::App& app, Action& action);
/// `etude cite DIR`: BibTeX, and the sentence that names a run.
void DefineCite(CLI::App& app, Action& action);
/// `etude verify DIR`: recomputes and replays what a run says (exit 1 when it differs); signs it, checks a signature.
void DefineVerify(CLI::App& app, Action& action);
/// `etude gate`: exit 0 pass, 1 regression or unmet expectation, 2 bad input, 3 incomplete.
void DefineGate(CLI::App& app, Action& action);
/// `etude compare A B`: tells what differs between two runs of the same worlds.
void DefineCompare(CLI::App& app, Action& action);
/// `etude export`: writes problems, and their truth apart.
void DefineExport(CLI::App& app, Action& action);
/// `etude score`: scores a folder of answers into a result folder.
void DefineScore(CLI::App& app, const std::string& command_line, Action& action);
/// `etude check-method … -- CMD…`: tests whether a program speaks the protocol of methods outside; exit 1 when not.
void DefineCheckMethod(CLI::App& app, Action& action);
/// `etude list …`: lists what can be named in a scenario.
void DefineList(CLI::App& app, Action& action);
/// `etude clip info|convert|render|contacts|map|grades`
void DefineClip(CLI::App& app, Action& action);
/// `etude clip render`: draws a contact sheet of any clips, or a film of one.
void DefineRender(CLI::App& clip, Action& action);
/// `etude clip grades`: tells what paper A's fuzzy system sees in clips, and how alike they are.
void DefineGrades(CLI::App& clip, Action& action);
/// `etude bridge`: finds bridge frames of clips, for a tags file and a summary; or checks a tags file (exit 2).
void DefineBridge(CLI::App& app, Action& action);
/// `etude train`: learns a fuzzy system or a recogniser from clips, and prints what it knows of clips held out.
void DefineTrain(CLI::App& app, Action& action);
/// `etude teach`: learns moves from recordings.
void DefineTeach(CLI::App& app, Action& action);
/// `etude recognise`: tells events as JSON Lines; with labels the scores.
void DefineRecognise(CLI::App& app, Action& action);
/// `etude sensor stats|fit|sheet`
void DefineSensor(CLI::App& app, Action& action);
/// `etude sensor sheet`: draws a contact sheet of the scenario's first world.
void DefineSheet(CLI::App& sensor, Action& action);
/// `etude calibrate`: finds the cameras of a rig from point pairs or pictures of boards, or prints a board.
void DefineCalibrate(CLI::App& app, Action& action);
/// `etude capture`: finds the motion of a person in films by several cameras.
void DefineCapture(CLI::App& app, const std::string& command_line, Action& action);
/// `etude coach`: coaches a song live from a skeleton stream.
void DefineCoach(CLI::App& app, Action& action);
/// `etude completion SHELL`, and what packages make their manual pages by.
void DefineOptionTree(CLI::App& app, Action& action);
/// `etude crowd`: follows a crowd on one core, tells how long its frames take, and films it.
void DefineCrowd(CLI::App& app, Action& action);

}  // namespace etude
