#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/recordings/blind_files.h"
#include "bench/statistics/bootstrap.h"
#include "bench/statistics/preferences.h"
#include "cli/arguments.h"
#include "cli/commands.h"
#include "cli/facts.h"
#include "engine/base/utf8.h"
#include "io/drawing/numbers.h"
#include "io/files/files.h"

namespace etude {
namespace {

struct BlindCommandOptions {
  std::vector<std::string> files;
  std::uint64_t seed = 1;
  bool as_json = false;
};

std::string InPerCent(const std::optional<double>& share) {
  return share ? FormatFixed(100 * *share, 1) + " %" : std::string(kNoValue);
}

std::string InPerCent(const std::optional<Interval>& interval) {
  if (!interval) return std::string(kNoValue);
  return fmt::format("{}–{} %", FormatFixed(100 * interval->low, 1), FormatFixed(100 * interval->high, 1));
}

std::optional<double> ShareOf(const MetricAgreement& metric) {
  return metric.decided > 0 ? std::optional(static_cast<double>(metric.agreed) / metric.decided) : std::nullopt;
}

Json EndsOf(const std::optional<Interval>& interval) {
  return interval ? Json{interval->low, interval->high} : Json(nullptr);
}

Json FactsOf(const Preferences& found) {
  Json methods = Json::array(), metrics = Json::array(), one_sided = Json::array();
  for (const PreferredMethod& method : found.methods) {
    methods.push_back({{"method", method.method},
                       {"wins", method.wins},
                       {"answers", method.answers},
                       {"preferred_share", OrNull(method.share)},
                       {"interval", EndsOf(method.interval)}});
  }
  for (const MetricAgreement& metric : found.metrics) {
    metrics.push_back({{"metric", metric.metric},
                       {"agreed", metric.agreed},
                       {"decided", metric.decided},
                       {"equal", metric.equal},
                       {"missing", metric.missing},
                       {"agreed_share", OrNull(ShareOf(metric))},
                       {"interval", EndsOf(metric.interval)}});
  }
  for (const OneSidedRater& rater : found.one_sided) {
    one_sided.push_back({{"rater", rater.rater}, {"left", rater.left}, {"decided", rater.decided}});
  }
  return {{"raters", found.raters}, {"pairs", found.pairs}, {"answers", found.answers}, {"same", found.same},
          {"without", found.without}, {"methods", methods}, {"metrics", metrics}, {"one_sided", one_sided}};
}

void Print(const Preferences& found) {
  fmt::print("{}, {}, {} ({} “no difference”); {} not answered\n\n", Plural(found.raters, "rater"),
             Plural(found.pairs, "pair"), Plural(found.answers, "answer"), found.same, found.without);
  // Print one row for each method.
  std::size_t width = 24;
  for (const PreferredMethod& method : found.methods) width = std::max(width, method.method.size());
  fmt::print("{:<{}}  {:>9}  {:>16}  {:>10}\n", "method", width, "preferred", "95 % interval", "answers");
  for (const PreferredMethod& method : found.methods) {
    fmt::print("{:<{}}  {:>9}  {:>16}  {:>10}\n", Visible(method.method), width, InPerCent(method.share),
               InPerCent(method.interval), FormatNumber(method.answers));
  }
  fmt::print(
      "Preferred: the probability that raters prefer the method to another compared method (Bradley–Terry model; “no "
      "difference” counts as half a win). {}\n\n",
      found.raters < kMinSample
          ? fmt::format("Intervals need {} raters.", kMinSample)
          : "The 95 % intervals are bootstrapped over raters, and are valid for these films only.");
  // Print one row for each metric.
  fmt::print("{:<{}}  {:>9}  {:>16}  {:>10}\n", "metric", width, "agrees", "95 % interval", "pairs");
  for (const MetricAgreement& metric : found.metrics) {
    if (metric.decided == 0) continue;
    fmt::print("{:<{}}  {:>9}  {:>16}  {:>10}\n", Visible(metric.metric), width, InPerCent(ShareOf(metric)),
               InPerCent(metric.interval), metric.decided);
  }
  fmt::print(
      "Agrees: the share of pairs in which the metric prefers the same side as most raters. Pairs without a majority "
      "of raters, and pairs with equal values of the metric, do not count. Wilson intervals are over pairs. A coin "
      "toss would agree in 50 % of the pairs. The best of {} metrics was selected on these films, so it will agree "
      "less often on other films.\n",
      found.metrics.size());
  for (const OneSidedRater& rater : found.one_sided) {
    fmt::print(stderr,
               "etude: {} chose the left side in {} of {} decided pairs, although sides were random (p < 0.01). Leave "
               "out this rater's file if the rater did not watch the films\n",
               Visible(rater.rater), rater.left, rater.decided);
  }
}

Result<int> BlindCommand(const BlindCommandOptions& options) {
  BlindFiles files;
  for (const std::string& file : options.files) {
    ASSIGN_OR_RETURN(const auto text, ReadWholeFile(file));
    RETURN_IF_ERROR(AddBlindFile(text, file, files));
  }
  RETURN_IF_ERROR(CheckBlindFiles(files));
  const Preferences found = MeasurePreferences(files, options.seed);
  if (options.as_json) {
    RETURN_IF_ERROR(PrintFacts("blind", FactsOf(found)));
  } else {
    Print(found);
  }
  return kSuccess;
}

}  // namespace

void DefineBlind(CLI::App& app, Action& action) {
  auto options = std::make_shared<BlindCommandOptions>();
  CLI::App* command = app.add_subcommand(
      "blind", "Summarise which transitions people prefer, and which metrics agree with their preferences");
  command
      ->add_option("files", options->files,
                   "Key files that `etude report --blind` wrote, and answer files that raters saved")
      ->required();
  AddSeed(*command, options->seed, "Seed of the bootstrap");
  AddJson(*command, options->as_json);
  command->callback([=, &action] { action = [=] { return Finish(BlindCommand(*options)); }; });
}

}  // namespace etude
