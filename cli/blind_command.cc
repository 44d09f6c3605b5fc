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

Json OrNull(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

Json OrNull(const std::optional<Interval>& interval) {
  return interval ? Json{interval->low, interval->high} : Json(nullptr);
}

Json FactsOf(const Preferences& found) {
  Json methods = Json::array(), metrics = Json::array(), one_sided = Json::array();
  for (const PreferredMethod& method : found.methods) {
    methods.push_back({{"method", method.method},
                       {"wins", method.wins},
                       {"answers", method.answers},
                       {"preferred_share", OrNull(method.share)},
                       {"interval", OrNull(method.interval)}});
  }
  for (const MetricAgreement& metric : found.metrics) {
    metrics.push_back({{"metric", metric.metric},
                       {"agreed", metric.agreed},
                       {"decided", metric.decided},
                       {"equal", metric.equal},
                       {"missing", metric.missing},
                       {"agreed_share", OrNull(ShareOf(metric))},
                       {"interval", OrNull(metric.interval)}});
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
      "Preferred: the chance that a method is preferred to another one that it was compared with (Bradley and Terry; "
      "“no difference” is half a win). {}\n\n",
      found.raters < kMinSample
          ? fmt::format("Intervals need {} raters.", kMinSample)
          : "Intervals are over raters (bootstrap, 95 %), on these films.");
  // Print one row for each metric.
  fmt::print("{:<{}}  {:>9}  {:>16}  {:>10}\n", "metric", width, "agrees", "95 % interval", "pairs");
  for (const MetricAgreement& metric : found.metrics) {
    if (metric.decided == 0) continue;
    fmt::print("{:<{}}  {:>9}  {:>16}  {:>10}\n", Visible(metric.metric), width, InPerCent(ShareOf(metric)),
               InPerCent(metric.interval), metric.decided);
  }
  fmt::print(
      "Agrees: the share of pairs in which most raters and the metric prefer the same side. Pairs without a majority "
      "of raters, or with equal values of the metric, do not count. Intervals are over pairs (Wilson). A coin would "
      "agree in 50 %. The best of {} metrics looks better here than it will on other films.\n",
      found.metrics.size());
  for (const OneSidedRater& rater : found.one_sided) {
    fmt::print(stderr,
               "etude: {} chose left in {} of {} decided pairs, although sides were random (p < 0.01); leave the "
               "file out if this rater did not judge the films\n",
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
  CLI::App* command =
      app.add_subcommand("blind", "Summarise which transitions people prefer, and which metric agrees with them");
  command->add_option("files", options->files, "Keys that `etude report --blind` wrote, and files that raters saved")
      ->required();
  AddSeed(*command, options->seed, "Seed of the bootstrap");
  AddJson(*command, options->as_json);
  command->callback([=, &action] { action = [=] { return Finish(BlindCommand(*options)); }; });
}

}  // namespace etude
