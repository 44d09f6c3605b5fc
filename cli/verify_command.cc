#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>

#include "bench/replay/replay.h"
#include "bench/results/folder.h"
#include "bench/results/seal.h"
#include "bench/results/signature.h"
#include "cli/commands.h"
#include "cli/facts.h"
#include "cli/interrupt.h"
#include "cli/output_file.h"
#include "reports/report.h"

namespace etude {
namespace {

struct VerifyCommandOptions {
  ReplayOptions replay;
  std::string key_file;     ///< of secret worlds, "" = none
  std::string sign, check;  ///< keys, "" = none
  bool as_json = false;
};

/// The report, if there is one.
Result<void> AddReport(const std::string& folder, std::vector<Verified>& all) {
  ASSIGN_OR_RETURN(auto run, LoadRun(folder, Sealing::kIgnored));
  run.unsealed.clear();  // which a report of the run would tell
  ASSIGN_OR_RETURN(auto check, CheckReport(run, folder));
  if (check.files > 0) {
    all.push_back({fmt::format("report: {} files, made again", check.files), std::move(check.differences)});
  }
  return {};
}

Result<int> VerifyCommand(VerifyCommandOptions options) {
  const Interrupt interrupt;
  ReplayOptions& replay = options.replay;
  ASSIGN_OR_RETURN(replay.key, TakeSecretKey(options.key_file));
  replay.stop = interrupt.requested();
  replay.sealing = Sealing::kIgnored;  // that is told, and no reason to look no further
  replay.recorded_too = true;
  replay.without_programs = !replay.outside.allow_exec;
  std::vector<Verified> all;
  if (!options.check.empty()) {
    const auto signed_by = CheckSignature(replay.folder, options.check);
    if (!signed_by && signed_by.error().place.file == options.check) return tl::unexpected(signed_by.error());
    all.push_back({"signature" + (signed_by ? " of key " + *signed_by : ""), {}});
    if (!signed_by) all.back().differences.push_back(ToString(signed_by.error()));
  }
  ASSIGN_OR_RETURN(auto verified, VerifyRun(replay, replay.sample > 0));
  std::ranges::move(verified, std::back_inserter(all));
  RETURN_IF_ERROR(AddReport(replay.folder, all));
  if (*interrupt.requested()) return TellStopped({{}, "stopped; nothing was found out"});
  std::size_t agree = 0;
  Json checks = Json::array();
  for (const Verified& one : all) {
    agree += one.differences.empty() ? 1 : 0;
    checks.push_back({{"what", one.what}, {"differences", one.differences}});
    if (options.as_json) continue;
    if (one.differences.empty()) fmt::print("agrees   {}\n", one.what);
    PrintList("differs  " + one.what, one.differences);
  }
  if (options.as_json) {
    RETURN_IF_ERROR(PrintFacts("verify", {{"agrees", agree == all.size()}, {"checks", std::move(checks)}}));
  } else {
    fmt::print("{} of {} agree. Nobody can verify what it says of times and machines.\n", agree, all.size());
  }
  if (agree < all.size()) return kNothingWorked;
  if (options.sign.empty()) return kSuccess;
  RETURN_IF_ERROR(SignRun(replay.folder, options.sign));
  TellWritten(replay.folder + "/" + kSignatureFile, options.as_json ? stderr : stdout);
  return kSuccess;
}

}  // namespace

void DefineVerify(CLI::App& app, Action& action) {
  auto options = std::make_shared<VerifyCommandOptions>();
  options->replay.sample = 10;
  CLI::App* command = app.add_subcommand("verify", "Whether a run says what its cells say, and these come out again");
  command->add_option("folder", options->replay.folder, "A result folder")->required();
  command
      ->add_option("--sample", options->replay.sample,
                   "Run so many cells again, beside all that left a recording; 0 = none")
      ->check(CLI::Range(0, 10'000'000))
      ->capture_default_str();
  command->add_option("--sign", options->sign, "If all agrees, sign it with this secret key (minisign -G -W)");
  command->add_option("--check", options->check, "Check its signature with this public key, or file of one (minisign)");
  AddSeedFile(*command, options->key_file);
  AddOutsideRules(*command, options->replay.outside);
  AddJobs(*command, options->replay.jobs);
  AddJson(*command, options->as_json);
  command->callback([=, &action] { action = [=] { return Finish(VerifyCommand(*options)); }; });
}

}  // namespace etude
