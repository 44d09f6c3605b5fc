#include <fmt/core.h>
#include <sys/random.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>

#include "bench/finished_runs/finished_runs.h"
#include "bench/replay/verify.h"
#include "bench/results/seal.h"
#include "bench/results/signature.h"
#include "cli/commands.h"
#include "cli/facts.h"
#include "cli/interrupt.h"
#include "cli/output_file.h"
#include "cli/progress_bar.h"
#include "engine/base/machine.h"
#include "engine/base/names.h"
#include "engine/base/text.h"
#include "reports/report.h"

namespace etude {
namespace {

/// The default sample size. If 5 % of a very large number of cells are forged, the sample misses all forged cells with
/// probability 0.95^59, 1 in 21. In a run with fewer cells, this probability is lower.
constexpr const char* kDefaultSample = "59";
constexpr const char* kWholeSample = "all";
constexpr std::size_t kMaxSample = 10'000'000;

struct VerifyCommandOptions {
  ReplayOptions replay;
  std::string sample = kDefaultSample;  ///< a number, or "all"
  std::string key_file;               ///< file with the key of secret worlds, "" = none
  std::string sign, check;            ///< key files for signing and for checking a signature, "" = none
  bool as_json = false;
};

/// Parses --sample; returns nullopt for "all".
std::optional<std::size_t> ReadSample(const std::string& text) { return ParseNumber<std::size_t>(text); }

/// Returns "" for a valid value of --sample, else the error message.
std::string CheckSample(const std::string& text) {
  if (text == kWholeSample) return "";
  if (const auto number = ParseNumber<std::size_t>(text); number && *number <= kMaxSample) return "";
  return fmt::format("'{}' is not a sample size; allowed: 0 to {}, or '{}'", text, kMaxSample, kWholeSample);
}

/// Draws an unpredictable seed. It has 53 bits, because JSON readers that use doubles keep such a number exactly.
Result<std::uint64_t> FreshDice() {
  std::uint64_t dice = 0;
  if (::getrandom(&dice, sizeof dice, 0) != sizeof dice) return FailOfMachine("getrandom returned no random numbers");
  return dice >> 11;
}

std::string ShareInWords(double chance) {
  if (chance == 0) return "none";
  if (chance < 1e-6) return "fewer than 1 in a million";
  if (chance <= 0.5) return fmt::format("1 in {:.{}f}", 1 / chance, chance > 0.1 ? 1 : 0);
  return fmt::format("{:.3g} %", 100 * chance);
}

/// Returns two sentences: the probability that the sample misses a forgery, and the seed of the sample.
std::string SampleInWords(const CellChoice& choice) {
  std::vector<std::string> missed;
  for (const MissedForgery& one : WhatIsMissed(choice)) {
    const std::string share = ShareInWords(one.chance);
    if (!one.method.empty()) {
      missed.push_back(
          fmt::format("{0} of the forgeries that change {2} of the cells of {1}", share, one.method, one.forged));
    } else if (missed.empty()) {
      missed.push_back(
          fmt::format("{0} of the forgeries that change {2} of the {1} cells", share, one.cells, one.forged));
    } else {
      missed.push_back(fmt::format("{} of the forgeries that change a single cell", share));
    }
  }
  if (missed.empty()) return "Etude ran every cell again that can be run again.";
  return fmt::format(
      "A sample of this size misses {}. --sample all detects every forgery; --sample-seed {} draws the same sample "
      "again.",
      Join(missed), choice.dice);
}

/// Lists, by method, the rows that cannot be verified by running the rows' cells again.
std::vector<std::string> NotVerified(const CellChoice& choice) {
  std::vector<std::string> lines;
  for (const MethodRows& method : choice.methods) {
    const std::string name = method.scenario + "/" + method.method;
    if (!method.why_not.empty())
      lines.push_back(fmt::format("{}: all {} cells: {}", name, method.rows, method.why_not));
    for (const auto& [status, rows] : method.by_machine) {
      lines.push_back(
          fmt::format("{}: {} of {} cells ended with the status {} on the run's machine; on another machine, these "
                      "cells may end with another status",
                      name, rows, method.rows, status));
    }
  }
  return lines;
}

Json FactsOf(const CellChoice& choice) {
  Json missed = Json::array();
  for (const MissedForgery& one : WhatIsMissed(choice)) {
    missed.push_back({{"method", one.method.empty() ? Json() : Json(one.method)},
                      {"forged", one.forged},
                      {"cells", one.cells},
                      {"chance", one.chance}});
  }
  return {{"seed", choice.dice},
          {"drawn", choice.drawn},
          {"cells", choice.drawable},
          {"recorded", choice.recorded},
          {"missed", std::move(missed)}};
}

/// Adds the checks of the report, and of the files that `etude gate` wrote into the report's folder, if these files
/// exist. Only the check of a report needs all rows in memory, as making the report did.
Result<void> AddReport(const std::string& folder, std::vector<Verified>& all, std::vector<std::string>& not_verified) {
  if (!Exists(Inside(folder) / "report") && !Exists(Inside(folder) / "video")) return {};
  ASSIGN_OR_RETURN(auto run, LoadFinishedRun(folder, Sealing::kIgnored));
  if (run.scenarios.empty()) return {};  // the run has not ended
  run.data.unsealed.clear();             // otherwise the expected page would mention the broken seal
  ASSIGN_OR_RETURN(auto check, CheckReport(run.data, folder));
  ASSIGN_OR_RETURN(auto gate, CheckGate(run, folder));
  check.files += gate.files;
  std::ranges::move(gate.differences, std::back_inserter(check.differences));
  std::ranges::move(gate.not_compared, std::back_inserter(check.not_compared));
  std::ranges::move(check.not_compared, std::back_inserter(not_verified));
  if (check.files > 0 || !check.differences.empty()) {
    all.push_back({fmt::format("report: {} files, compared with a new report of the run", check.files),
                   std::move(check.differences)});
  }
  return {};
}

Result<int> VerifyCommand(VerifyCommandOptions options) {
  // Load the run without trusting the run's seal, because a broken seal is one of the findings.
  const Interrupt interrupt;
  ReplayOptions& replay = options.replay;
  ASSIGN_OR_RETURN(replay.key, TakeSecretKey(options.key_file));
  replay.stop = interrupt.requested();
  replay.sealing = Sealing::kIgnored;  // a broken seal is reported, but does not end the check
  replay.recorded_too = true;
  replay.without_programs = !replay.outside.allow_exec;
  replay.on_progress = ProgressOf("cells");
  replay.sample = ReadSample(options.sample);
  if (!replay.dice) {
    ASSIGN_OR_RETURN(replay.dice, FreshDice());
  }
  // Check the signature, run the sampled cells again, and compare the report.
  std::vector<Verified> all;
  std::vector<std::string> not_verified;
  if (options.check.empty() && Exists(Inside(replay.folder) / kSignatureFile)) {
    not_verified.push_back(fmt::format(
        "{}: the signature was not checked, because the option --check with a public key is missing", kSignatureFile));
  } else if (!options.check.empty()) {
    const auto signed_by = CheckSignature(replay.folder, options.check);
    if (!signed_by && signed_by.error().place.file == options.check) return tl::unexpected(signed_by.error());
    all.push_back({"signature" + (signed_by ? " of key " + *signed_by : ""), {}});
    if (!signed_by) all.back().differences.push_back(ToString(signed_by.error()));
  }
  ASSIGN_OR_RETURN(auto verified, VerifyRun(replay, replay.sample != std::size_t{0}));
  std::ranges::move(verified.checks, std::back_inserter(all));
  if (verified.choice) std::ranges::move(NotVerified(*verified.choice), std::back_inserter(not_verified));
  RETURN_IF_ERROR(AddReport(replay.folder, all, not_verified));
  if (*interrupt.requested()) return TellStopped({{}, "stopped before the verification was complete"});
  // Print the checks that agree and the checks that differ.
  std::size_t agree = 0;
  Json checks = Json::array();
  for (const Verified& one : all) {
    agree += one.differences.empty() ? 1 : 0;
    checks.push_back({{"what", one.what}, {"differences", one.differences}});
    if (options.as_json) continue;
    if (one.differences.empty()) fmt::print("agrees   {}\n", one.what);
    PrintList("differs  " + one.what, one.differences);
  }
  const std::optional<CellChoice>& choice = verified.choice;
  if (options.as_json) {
    RETURN_IF_ERROR(PrintFacts("verify", {{"agrees", agree == all.size()},
                                          {"checks", std::move(checks)},
                                          {"sample", choice ? FactsOf(*choice) : Json()},
                                          {"not_verified", not_verified}}));
  } else {
    PrintList("Not verified:", not_verified);
    fmt::print("{}\n", choice ? SampleInWords(*choice) : "Etude ran no cell again.");
    fmt::print(
        "{} of {} checks agree. Nothing verifies times, the machine, the version of Etude, the suite's name, and the "
        "files in stderr/ and blind/.\n",
        agree, all.size());
  }
  // Sign the run only if everything agrees.
  if (agree < all.size()) return kNothingWorked;
  if (options.sign.empty()) return kSuccess;
  RETURN_IF_ERROR(SignRun(replay.folder, options.sign));
  TellWritten(replay.folder + "/" + kSignatureFile, options.as_json ? stderr : stdout);
  return kSuccess;
}

}  // namespace

void DefineVerify(CLI::App& app, Action& action) {
  auto options = std::make_shared<VerifyCommandOptions>();
  CLI::App* command = app.add_subcommand(
      "verify", "Check that the files of a run agree with each other, and that its cells can be reproduced");
  command->add_option("folder", options->replay.folder, "A result folder")->required();
  command
      ->add_option("--sample", options->sample,
                   "Number of cells to run again at random, in addition to all cells with a recording. 0: run no cell; "
                   "all: run every cell")
      ->check(CheckSample);
  command->add_option(
      "--sample-seed", options->replay.dice,
      "Seed of the sample, to repeat a check. Keep it secret from the author of the run (default: random)");
  command->add_option("--sign", options->sign,
                      "Sign the run with this secret key if everything agrees (minisign -G -W)");
  command->add_option(
      "--check", options->check,
      "Check the run's signature with this public key, or with a file that contains the key (minisign)");
  AddSeedFile(*command, options->key_file);
  AddOutsideRules(*command, options->replay.outside);
  AddJobs(*command, options->replay.jobs);
  AddJson(*command, options->as_json);
  command->callback([=, &action] { action = [=] { return Finish(VerifyCommand(*options)); }; });
}

}  // namespace etude
