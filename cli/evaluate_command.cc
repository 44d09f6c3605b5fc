#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <span>
#include <sstream>

#include "bench/metrics/catalogue.h"
#include "bench/results/folder.h"
#include "bench/run/run.h"
#include "bench/scenario/methods.h"
#include "bench/tasks/evaluation/find_files.h"
#include "bench/tasks/registry.h"
#include "cli/commands.h"
#include "cli/evaluate_alone.h"
#include "cli/evaluate_parts.h"
#include "cli/facts.h"
#include "cli/named_results.h"
#include "cli/pair_notes.h"
#include "cli/run_outcome.h"
#include "engine/base/csv.h"
#include "engine/base/names.h"
#include "engine/retargeting/map_file.h"
#include "io/files/files.h"
#include "io/files/json.h"

namespace etude {
namespace {

/// The options of `etude evaluate`.
struct EvaluateOptions {
  std::vector<std::string> files;  ///< the truth, then results
  std::string pairs, joints, people, joint_map, clip_facts, lag, statistics, music_beats;
  std::vector<std::string> metrics;
  std::string output;
  bool overwrite = false;
  bool keeps_motions = false;
  bool by_joint = false;
  int jobs = 0;
  bool as_json = false;
  AloneOptions alone;
  std::string command_line;
};

/// Returns the methods that the heading of a CSV file of pairs lists, one per column.
Result<std::vector<NamedResult>> ReadColumns(const std::string& file) {
  ASSIGN_OR_RETURN(const auto text, ReadWholeFile(file));
  std::vector<NamedResult> results;
  ASSIGN_OR_RETURN(const auto rows, ReadCsv(text, file));
  for (const std::string& column : rows.empty() ? std::vector<std::string>{} : rows.front().cells) {
    if (column == "truth" || column == "name") continue;
    if (!IsPlainName(column)) {
      return Fail({file, rows.front().line, 0}, "column {} is not a valid method name", Quote(column));
    }
    results.push_back({column, {}});
  }
  if (results.empty())
    return Fail({file, 1, 0}, "the heading has no column for a method; allowed: a heading such as truth,mine");
  return results;
}

/// Returns the text of a scenario that compares pairs of files.
Result<std::string> ScenarioOfPairs(const EvaluateOptions& options) {
  const bool has_pairs = !options.pairs.empty();
  if (has_pairs != options.files.empty() || options.files.size() == 1) {
    return Fail({},
                "`etude evaluate` needs a truth and results; or --pairs FILE.csv; or --alone and motions, if there is "
                "no truth");
  }
  ASSIGN_OR_RETURN(const auto results,
                   has_pairs ? ReadColumns(options.pairs) : ReadResults(std::span(options.files).subspan(1)));
  std::string text = "scenario: evaluate\nquestion: How close are these motions to their truths?\ntask: evaluation\n";
  text += has_pairs ? fmt::format("pairs: {}\n", QuotedInYaml(options.pairs))
                    : fmt::format("truth: [{}]\n", QuotedInYaml(options.files.front()));
  if (!options.joints.empty()) text += fmt::format("joints: {}\n", QuotedInYaml(options.joints));
  if (!options.people.empty()) text += fmt::format("people: {}\n", QuotedInYaml(options.people));
  if (!options.statistics.empty()) text += fmt::format("statistics: {}\n", QuotedInYaml(options.statistics));
  if (!options.music_beats.empty()) text += fmt::format("music_beats: {}\n", QuotedInYaml(options.music_beats));
  if (options.lag == "find") text += "sweep: {lag: [none, find]}\n";
  text += MethodsInYaml(results);
  return text;
}

/// Returns the text of the scenario that the options describe.
Result<std::string> ScenarioOf(const EvaluateOptions& options) {
  const AloneOptions& alone = options.alone;
  for (const auto& [name, value] : {std::pair{"--pairs", &options.pairs},
                                    {"--joints", &options.joints},
                                    {"--lag", &options.lag},
                                    {"--statistics", &options.statistics}}) {
    if (alone.is_alone && !value->empty())
      return Fail({}, "{} cannot be combined with --alone, because --alone uses no truth", name);
  }
  if (alone.is_alone && options.by_joint)
    return Fail({}, "--by-joint cannot be combined with --alone, because --alone uses no truth");
  if (!alone.is_alone && (alone.floor_m || !alone.limits.empty()))
    return Fail({}, "--floor and --limits can only be used with --alone");
  ASSIGN_OR_RETURN(auto text,
                   alone.is_alone ? ScenarioOfMotions(options.files, alone, options.people) : ScenarioOfPairs(options));
  if (options.metrics.empty()) return text;
  std::vector<std::string> quoted;
  for (const std::string& metric : options.metrics) quoted.push_back(QuotedInYaml(metric));
  return text + fmt::format("metrics: [{}]\n", Join(quoted));
}

/// Returns, as JSON: the aggregates of every metric of every method, and the result folder.
Json FactsOf(const ScenarioSummary& summary, const std::string& folder) {
  Json methods = Json::array();
  for (const ConditionSummary& condition : summary.conditions) {
    for (const MethodSummary& method : condition.methods) {
      Json metrics = Json::array();
      for (const MetricSummary& metric : method.metrics) {
        metrics.push_back({{"metric", metric.id},
                           {"median", OrNull(metric.median)},
                           {"mean", OrNull(metric.mean)},
                           {"low", OrNull(metric.ci_low)},
                           {"high", OrNull(metric.ci_high)},
                           {"pairs", metric.present},
                           {"without", metric.missing}});
      }
      methods.push_back({{"method", method.method},
                         {"condition", ConditionLabel(condition.condition)},
                         {"pairs_judged", method.ok},
                         {"metrics", std::move(metrics)}});
    }
  }
  return {{"methods", std::move(methods)}, {"output", folder}};
}

constexpr std::string_view kSeenShare = "seen_share";

/// Returns true if a method has no value for some joints that the truth shows.
bool LeavesValuesOut(const ScenarioSummary& summary) {
  return std::ranges::any_of(summary.conditions, [](const ConditionSummary& condition) {
    return std::ranges::any_of(condition.methods, [](const MethodSummary& method) {
      const auto seen = std::ranges::find(method.metrics, kSeenShare, &MetricSummary::id);
      return seen != method.metrics.end() && seen->mean && *seen->mean < 1;
    });
  });
}

/// Prints a line for each headline metric of each method, under a line for each condition if there are several.
void PrintTable(const ScenarioSummary& summary) {
  std::size_t width = 6;
  for (const std::string& method : summary.methods) width = std::max(width, method.size());
  fmt::print("  {:<{}}  {:<28}  {:>9}  {:>9}  {:<22}  pairs\n", "method", width, "metric", "median", "mean",
             "95 % of its aggregate");
  const auto show = [](const std::optional<double>& value) { return value ? fmt::format("{:.4g}", *value) : "-"; };
  // If a method leaves values out, its other figures look better than they are: also show the share that it gives.
  std::vector<std::string> ids = summary.headline_metrics;
  if (LeavesValuesOut(summary) && std::ranges::find(ids, kSeenShare) == ids.end()) ids.emplace_back(kSeenShare);
  const auto print_method = [&](const MethodSummary& method) {
    for (const std::string& id : ids) {
      const auto metric = std::ranges::find(method.metrics, id, &MetricSummary::id);
      if (metric == method.metrics.end()) continue;
      const std::string interval =
          metric->ci_low && metric->ci_high ? fmt::format("{:.4g} to {:.4g}", *metric->ci_low, *metric->ci_high) : "-";
      fmt::print("  {:<{}}  {:<28}  {:>9}  {:>9}  {:<22}  {} of {}\n", method.method, width, id, show(metric->median),
                 show(metric->mean), interval, metric->present, metric->present + metric->missing);
    }
  };
  for (const ConditionSummary& condition : summary.conditions) {
    if (!condition.condition.empty()) fmt::print("{}\n", ConditionLabel(condition.condition));
    for (const MethodSummary& method : condition.methods) print_method(method);
  }
}

constexpr const char* kScenarioFile = "evaluate.yaml";

/// Replaces the place of an error in the generated scenario `text`, which the user did not write, by the command-line
/// argument that caused the error.
Error AboutArguments(Error error, const std::string& text) {
  constexpr std::pair<std::string_view, std::string_view> kArguments[] = {
      {"truth", "the truth"},  {"pairs", "--pairs"},      {"joints", "--joints"},
      {"people", "--people"},  {"sweep", "--lag"},        {"statistics", "--statistics"},
      {"floor_m", "--floor"},  {"at_most", "--limits"},   {"music_beats", "--music-beats"},
      {"metrics", "--metric"}, {"methods", "the results"}};
  if (error.place.file != kScenarioFile) return error;
  // Find the key of the line; an indented line belongs to the last key above this line.
  std::istringstream lines(text);
  std::string line;
  std::string found;
  for (int i = 0; i < error.place.line && std::getline(lines, line); ++i) {
    if (!line.starts_with(' ')) found = line.substr(0, line.find(':'));
  }
  const auto argument = std::ranges::find(kArguments, found, &std::pair<std::string_view, std::string_view>::first);
  error.place = {argument == std::end(kArguments) ? "" : std::string(argument->second)};
  return error;
}

Result<int> EvaluateCommand(const EvaluateOptions& options) {
  RunOptions run;
  run.scenarios = {kScenarioFile};
  ASSIGN_OR_RETURN(run.text, ScenarioOf(options));
  run.joint_map = options.joint_map;
  run.clip_facts = options.clip_facts;
  run.output = options.output;
  run.overwrite = options.overwrite;
  run.keeps_motions = options.keeps_motions;
  run.jobs = options.jobs;
  run.command_line = options.command_line;
  run.program_version = ETUDE_VERSION;
  StdoutToStderr redirected(options.as_json);
  const auto ran = RunWithProgress(run);
  if (!ran) return tl::unexpected(AboutArguments(ran.error(), run.text));
  const auto& outcome = *ran;
  redirected.End();
  if (!outcome) return kInterrupted;
  // Hours of motion give many rows, so load the rows only if the summary lacks the needed data.
  ASSIGN_OR_RETURN(auto data, LoadRunOutline(outcome->folder));
  if (options.alone.is_alone || options.by_joint || HasAngles(data.scenarios.front())) {
    ASSIGN_OR_RETURN(data, LoadRunRowByRow(outcome->folder));
  }
  const ScenarioSummary& summary = data.scenarios.front();
  // With a truth, the command fails if a pair is not judged. Without a truth, it fails if a method has no judged clip.
  const bool lacks_some = !options.alone.is_alone && outcome->cells_ok < outcome->cells;
  const bool has_silent = lacks_some || std::ranges::any_of(summary.conditions.front().methods,
                                                            [](const MethodSummary& method) { return method.ok == 0; });
  const Triage triage = options.alone.is_alone ? TriageOf(data) : Triage{};
  // If limits are given, the command also fails if a clip exceeds them or is not judged.
  const bool exceeds = !triage.beyond_limits.empty() || (!options.alone.limits.empty() && !triage.not_judged.empty());
  const int code = has_silent || exceeds ? kNothingWorked : kSuccess;
  const std::string folder = outcome->folder.string();
  const std::vector<AngleAgreement> angles = AgreementByAngle(data);
  PairNotes notes;
  if (!options.alone.is_alone) {
    ASSIGN_OR_RETURN(notes, ReadPairNotes(outcome->folder));
  }
  const DoubtList doubts = options.alone.is_alone ? DoubtsOf(data) : notes.doubts;
  doubts.Tell();
  if (options.as_json) {
    Json facts = FactsOf(summary, folder);
    facts["doubts"] = doubts.lines();
    facts["angles"] = FactsOf(angles);
    if (options.by_joint) facts["joints"] = FactsOf(ErrorsByJoint(data));
    facts["judged"] = notes.judged.Lines();
    facts["not_judged"] = options.alone.is_alone ? triage.not_judged : notes.every_not_judged;
    facts["left_out"] = LeftOutIn(*outcome);
    if (options.alone.is_alone) facts["with_faults"] = triage.faulty;
    if (triage.has_limits) facts["beyond_limits"] = triage.beyond_limits;
    RETURN_IF_ERROR(PrintFacts("evaluate", std::move(facts)));
    return code;
  }
  if (options.alone.is_alone) {
    PrintTriage(triage);
  } else {
    PrintTable(summary);
    PrintAngles(summary, angles);
    if (options.by_joint) PrintJoints(ErrorsByJoint(data));
    PrintPairNotes(notes);
  }
  fmt::print("{} of {} cells ok; all {} metrics are in {}\nNext: etude report {}\n", outcome->cells_ok, outcome->cells,
             FindTaskKind(summary.task)->metrics.size(), folder, folder);
  return code;
}

}  // namespace

void DefineEvaluate(CLI::App& app, const std::string& command_line, Action& action) {
  auto options = std::make_shared<EvaluateOptions>();
  options->command_line = command_line;
  CLI::App* command =
      app.add_subcommand("evaluate",
                         "Compare motion files with their true motions, or find faults in motions without a truth. "
                         "Exit code 1: a pair, or all results of a method, could not be judged");
  command->add_option("files", options->files,
                      "The truth, then one or more results. Each is a file, a folder or a pattern in quotes. Several "
                      "results need names: NAME=PATTERN");
  command->add_flag("--alone", options->alone.is_alone,
                    "Judge motions without a truth: find faults that no human motion has (arguments: FILE, FILE#CLIP, "
                    "folders, patterns)");
  command->add_option(
      "--floor", options->alone.floor_m,
      "With --alone: height of the floor, in metres (default: 0; estimated from the feet if the motion is far from 0)");
  command->add_option("--limits", options->alone.limits,
                      "With --alone: a file of the largest allowed values of metrics, or 'recorded' for the file that "
                      "comes with Etude. Exit code 1: a clip exceeds a limit or could not be judged");
  command->add_option(
      "--pairs", options->pairs,
      "Instead of files: a CSV table of pairs. Its columns are `truth`, one per method, and optionally `name`");
  command->add_option("--joints", options->joints,
                      "Which joints are compared: roles (joints with the same role; the default), same (joints with "
                      "the same name), or a joint set (see `etude list keys`)");
  command->add_option("--people", options->people,
                      "A pattern of file names in which {person} stands for the person's name, such as '{person}_*'");
  command
      ->add_option(
          "--lag", options->lag,
          "find: also estimate and remove the time shift between truth and result, and judge the results a second time")
      ->check(OneOf({"none", "find"}));
  command->add_option("--statistics", options->statistics,
                      "For the metric L2P: a CSV with means and standard deviations of joints");
  command->add_option("--music-beats", options->music_beats,
                      "For beat alignment: a file with the times of the music's beats, in seconds, one per line");
  command->add_option("--metric", options->metrics,
                      "A metric to show in the table (see `etude list metrics`). All metrics are always measured");
  command->add_flag("--by-joint", options->by_joint, "Also list the mean error of each joint, in descending order");
  command->add_option(kJointMapOption, options->joint_map,
                      "A joint-map file: it assigns joints to roles, and can state the unit and the up axis");
  AddUnit(*command, "files", options->clip_facts);
  AddUp(*command, "files", options->clip_facts);
  // Define the outputs.
  command->add_option("-o,--output", options->output, "Result folder (default: out/evaluate-1)");
  AddOverwrite(*command, options->overwrite, "Replace a folder that already contains a run");
  command
      ->add_option_function<std::string>(
          "--keep", [options](const std::string&) { options->keeps_motions = true; },
          "motions: record the motions, so that the report page can show pictures and a viewer of them")
      ->check(OneOf({"motions"}));
  AddJobs(*command, options->jobs);
  AddJson(*command, options->as_json);
  command->callback([=, &action] { action = [=] { return Finish(EvaluateCommand(*options)); }; });
}

}  // namespace etude
