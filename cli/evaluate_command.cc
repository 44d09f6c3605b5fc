#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "bench/metrics/catalogue.h"
#include "bench/results/folder.h"
#include "bench/results/row_json.h"
#include "bench/run/run.h"
#include "bench/scenario/methods.h"
#include "bench/tasks/registry.h"
#include "cli/commands.h"
#include "cli/facts.h"
#include "engine/base/names.h"
#include "engine/retargeting/map_file.h"
#include "io/files/files.h"
#include "io/files/json.h"

namespace etude {
namespace {

/// The options of `etude evaluate`.
struct EvaluateOptions {
  std::vector<std::string> files;  ///< the truth, then results
  std::string pairs, joints, people, joint_map;
  std::vector<std::string> metrics;
  std::string output;
  bool overwrite = false;
  bool keeps_motions = false;
  int jobs = 0;
  bool as_json = false;
  std::string command_line;
};

/// A method and the pattern of its answers.
struct NamedResult {
  std::string name, pattern;
};

/// Returns a plain name for a pattern: of its folder if it has wildcards, else of its file.
std::string NameFor(const std::string& pattern) {
  const std::filesystem::path path = pattern.ends_with('/') ? pattern.substr(0, pattern.size() - 1) : pattern;
  const bool is_pattern = path.filename().string().find_first_of("*?[") != std::string::npos;
  std::string name = (is_pattern ? path.parent_path().filename() : path.stem()).string();
  std::ranges::replace_if(
      name, [](char c) { return !IsPlainName(std::string(1, c)) && c != '-' && c != '.'; }, '_');
  return IsPlainName(name) ? name : "result";
}

/// Reads RESULT or NAME=PATTERN, one for each method. Fails if several have no names: a shell may have put files in the
/// place of a pattern.
Result<std::vector<NamedResult>> ReadResults(std::span<const std::string> arguments) {
  std::vector<NamedResult> results;
  for (const std::string& argument : arguments) {
    const std::size_t equals = argument.find('=');
    std::error_code none;
    const bool is_named = equals != std::string::npos && IsPlainName(argument.substr(0, equals)) &&
                          !std::filesystem::exists(argument, none);
    if (!is_named && arguments.size() > 1) {
      return Fail({}, "{}: several results need names, NAME=PATTERN, with the pattern in quotes if it has a '*'",
                  Quote(argument));
    }
    results.push_back(is_named ? NamedResult{argument.substr(0, equals), argument.substr(equals + 1)}
                               : NamedResult{NameFor(argument), argument});
  }
  return results;
}

/// Returns the columns of a CSV of pairs that name methods.
Result<std::vector<NamedResult>> ReadColumns(const std::string& file) {
  ASSIGN_OR_RETURN(const auto text, ReadWholeFile(file));
  std::vector<NamedResult> results;
  std::string heading = text.substr(0, text.find_first_of("\r\n")) + ",";
  for (std::size_t at = 0, comma; (comma = heading.find(',', at)) != std::string::npos; at = comma + 1) {
    const std::string column = heading.substr(at, comma - at);
    if (column == "truth" || column == "name") continue;
    if (!IsPlainName(column)) return Fail({file, 1, 0}, "{} is no name of a method", Quote(column));
    results.push_back({column, ""});
  }
  if (results.empty()) return Fail({file, 1, 0}, "has no column of a method; allowed: a heading such as truth,mine");
  return results;
}

/// Writes the scenario that the options mean.
Result<std::string> ScenarioOf(const EvaluateOptions& options) {
  const bool has_pairs = !options.pairs.empty();
  if (has_pairs != options.files.empty() || options.files.size() == 1) {
    return Fail({}, "etude evaluate needs a truth and results, or --pairs FILE.csv (one of the two)");
  }
  ASSIGN_OR_RETURN(const auto results,
                   has_pairs ? ReadColumns(options.pairs) : ReadResults(std::span(options.files).subspan(1)));
  std::string text =
      "scenario: evaluate\nquestion: How close do these motions come to their truths?\ntask: evaluation\n";
  text += has_pairs ? fmt::format("pairs: {}\n", QuotedInYaml(options.pairs))
                    : fmt::format("truth: [{}]\n", QuotedInYaml(options.files.front()));
  if (!options.joints.empty()) text += fmt::format("joints: {}\n", QuotedInYaml(options.joints));
  if (!options.people.empty()) text += fmt::format("people: {}\n", QuotedInYaml(options.people));
  text += "methods:\n";
  for (const NamedResult& result : results) {
    text += fmt::format("  - {{name: {}{}}}\n", QuotedInYaml(result.name),
                        has_pairs ? "" : fmt::format(", answers: [{}]", QuotedInYaml(result.pattern)));
  }
  if (!options.metrics.empty()) {
    std::vector<std::string> quoted;
    for (const std::string& metric : options.metrics) quoted.push_back(QuotedInYaml(metric));
    text += fmt::format("metrics: [{}]\n", Join(quoted));
  }
  return text;
}

/// The aggregates of every metric of every method.
Json FactsOf(const ScenarioSummary& summary, const std::string& folder) {
  const auto number = [](const std::optional<double>& value) { return value ? Json(*value) : Json(); };
  Json methods = Json::array();
  for (const MethodSummary& method : summary.conditions.front().methods) {
    Json metrics = Json::array();
    for (const MetricSummary& metric : method.metrics) {
      metrics.push_back({{"metric", metric.id},
                         {"median", number(metric.median)},
                         {"mean", number(metric.mean)},
                         {"low", number(metric.ci_low)},
                         {"high", number(metric.ci_high)},
                         {"pairs", metric.present},
                         {"without", metric.missing}});
    }
    methods.push_back({{"method", method.method}, {"pairs_judged", method.ok}, {"metrics", std::move(metrics)}});
  }
  return {{"methods", std::move(methods)}, {"output", folder}};
}

/// Prints a line for each headline metric of each method.
void PrintTable(const ScenarioSummary& summary) {
  std::size_t width = 6;
  for (const std::string& method : summary.methods) width = std::max(width, method.size());
  fmt::print("  {:<{}}  {:<28}  {:>9}  {:>9}  {:<22}  pairs\n", "method", width, "metric", "median", "mean",
             "95 % of its aggregate");
  const auto show = [](const std::optional<double>& value) { return value ? fmt::format("{:.4g}", *value) : "-"; };
  for (const MethodSummary& method : summary.conditions.front().methods) {
    for (const std::string& id : summary.headline_metrics) {
      const auto metric = std::ranges::find(method.metrics, id, &MetricSummary::id);
      if (metric == method.metrics.end()) continue;
      const std::string interval =
          metric->ci_low && metric->ci_high ? fmt::format("{:.4g} to {:.4g}", *metric->ci_low, *metric->ci_high) : "-";
      fmt::print("  {:<{}}  {:<28}  {:>9}  {:>9}  {:<22}  {} of {}\n", method.method, width, id, show(metric->median),
                 show(metric->mean), interval, metric->present, metric->present + metric->missing);
    }
  }
}

/// Says what was judged and done, once for each method, and what could not be judged. Rows are read one by one.
Result<void> PrintNotes(const std::filesystem::path& folder) {
  constexpr std::size_t kMaxFailures = 10;
  std::vector<std::string> told, failures;
  std::size_t failed = 0;
  RETURN_IF_ERROR(WriteRows(folder, Sealing::kRequired, [&](std::string_view text) -> Result<void> {
    ASSIGN_OR_RETURN(const auto json, ReadJson(std::string(text), folder.string()));
    ASSIGN_OR_RETURN(const auto row, DecodeRow(json, {folder.string()}));
    const std::string line = fmt::format("{}, {}: {}", row.method, row.clip, row.result.reason);
    if (row.result.status != Status::kOk) {
      if (++failed <= kMaxFailures) failures.push_back(line);
    } else if (std::ranges::find(told, row.method) == told.end()) {
      told.push_back(row.method);
      fmt::print("  {}\n", line);
    }
    return {};
  }));
  if (failed == 0) return {};
  fmt::print("{} not judged:\n", failed);
  for (const std::string& line : failures) fmt::print("  {}\n", line);
  if (failed > failures.size()) fmt::print("  and {} more: etude rows\n", failed - failures.size());
  return {};
}

Result<int> EvaluateCommand(const EvaluateOptions& options) {
  RunOptions run;
  run.scenarios = {"evaluate.yaml"};
  ASSIGN_OR_RETURN(run.text, ScenarioOf(options));
  run.joint_map = options.joint_map;
  run.output = options.output;
  run.overwrite = options.overwrite;
  run.keeps_motions = options.keeps_motions;
  run.jobs = options.jobs;
  run.command_line = options.command_line;
  run.program_version = ETUDE_VERSION;
  StdoutToStderr redirected(options.as_json);
  ASSIGN_OR_RETURN(const auto outcome, RunWithProgress(run));
  redirected.End();
  if (!outcome) return kInterrupted;
  ASSIGN_OR_RETURN(const auto data, LoadRunOutline(outcome->folder));
  const ScenarioSummary& summary = data.scenarios.front();
  const bool has_silent = std::ranges::any_of(summary.conditions.front().methods,
                                              [](const MethodSummary& method) { return method.ok == 0; });
  const int code = has_silent ? kNothingWorked : kSuccess;
  const std::string folder = outcome->folder.string();
  if (options.as_json) {
    RETURN_IF_ERROR(PrintFacts("evaluate", FactsOf(summary, folder)));
    return code;
  }
  PrintTable(summary);
  RETURN_IF_ERROR(PrintNotes(outcome->folder));
  fmt::print("{} of {} cells ok, all {} metrics in {}\nNext: etude report {}\n", outcome->cells_ok, outcome->cells,
             FindTaskKind("evaluation")->metrics.size(), folder, folder);
  return code;
}

}  // namespace

void DefineEvaluate(CLI::App& app, const std::string& command_line, Action& action) {
  auto options = std::make_shared<EvaluateOptions>();
  options->command_line = command_line;
  CLI::App* command = app.add_subcommand("evaluate", "Judge the motions of files by their truths");
  command->add_option(
      "files", options->files,
      "The truth, then results, each a file, a folder or a pattern in quotes; NAME=PATTERN for several");
  command->add_option("--pairs", options->pairs, "A CSV instead: columns truth, one of each method's name, maybe name");
  command->add_option("--joints", options->joints, "Which joints: a set (etude list keys), same, or roles (default)");
  command->add_option("--people", options->people, "Which part of a file's name is the person, such as '{person}_*'");
  command->add_option("--metric", options->metrics, "A metric to show; all are measured (etude list metrics)");
  command->add_option(kJointMapOption, options->joint_map, "Which joints play which roles, the unit, the up axis");
  command->add_option("-o,--output", options->output, "Result folder (default: out/evaluate-1)");
  AddOverwrite(*command, options->overwrite, "Replace a folder that already holds a run");
  command
      ->add_option_function<std::string>(
          "--keep", [options](const std::string&) { options->keeps_motions = true; },
          "motions: record both motions of every pair, for the page's pictures and its viewer")
      ->check(CLI::IsMember({"motions"}));
  AddJobs(*command, options->jobs);
  AddJson(*command, options->as_json);
  command->callback([=, &action] { action = [=] { return Finish(EvaluateCommand(*options)); }; });
}

}  // namespace etude
