#include "cli/arguments.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <iostream>

#include "bench/process/pinned_environment.h"
#include "bench/results/folder.h"
#include "bench/run/outside_programs.h"
#include "bench/run/worker.h"
#include "cli/commands.h"
#include "cli/examples.h"

namespace etude {
namespace {

/// Refuses empty values of all options: most often a variable that nobody has set.
void RefuseEmptyValues(CLI::App& command) {
  const CLI::Validator not_empty([](std::string& text) { return text.empty() ? "must not be empty" : ""; }, "");
  for (CLI::Option* option : command.get_options()) {
    if (option->get_items_expected_max() > 0) option->check(not_empty);
  }
  for (CLI::App* inner : command.get_subcommands([](CLI::App*) { return true; })) RefuseEmptyValues(*inner);
}

/// The seeds that are exact wherever JSON is read: whole numbers up to 2^53.
const CLI::Range& SeedRange() {
  static const CLI::Range range(std::uint64_t{0}, std::uint64_t{1} << 53);
  return range;
}

}  // namespace

CLI::Option* AddSeed(CLI::App& command, std::uint64_t& seed, const std::string& help) {
  return command.add_option("--seed", seed, help)->check(SeedRange())->capture_default_str();
}

CLI::Option* AddSeed(CLI::App& command, std::optional<std::uint64_t>& seed, const std::string& help) {
  return command.add_option("--seed", seed, help)->check(SeedRange());
}

CLI::Option* AddSeedFile(CLI::App& command, std::string& file) {
  CLI::Option* option = command.add_option(
      "--seed-file", file,
      "The key of secret worlds: a file of 64 hexadecimal digits or 32 bytes; or the digits stand in ETUDE_SEED_KEY");
  if (CLI::Option* seed = command.get_option_no_throw("--seed")) option->excludes(seed);
  return option;
}

Result<std::optional<SecretKey>> TakeSecretKey(const std::string& file, bool has_seed) {
  ASSIGN_OR_RETURN(auto key, FindSecretKey(file));
  if (key && has_seed) return Fail({kKeyVariable}, "is set, and --seed, too; leave out one of them");
  if (struct stat status{}; key && ::stat(key->file.c_str(), &status) == 0 && (status.st_mode & S_IROTH) != 0) {
    Complain({{file}, "can be read by everybody here; chmod 600 keeps the key to yourself"});
  }
  return key;
}

Action WithSecretKey(CLI::App& command, const std::optional<std::uint64_t>* seed, std::optional<SecretKey>& key,
                     const Action& act) {
  auto file = std::make_shared<std::string>();
  AddSeedFile(command, *file);
  return [=, &key] {
    auto taken = TakeSecretKey(*file, seed != nullptr && seed->has_value());
    if (!taken) return Complain(taken.error());
    key = std::move(*taken);
    return act();
  };
}

CLI::Option* AddJobs(CLI::App& command, int& jobs) {
  return command.add_option("-j,--jobs", jobs, "Worker processes (default: one per processor)")
      ->check(CLI::Range(1, 1024));
}

CLI::Option* AddOverwrite(CLI::App& command, bool& overwrite, const std::string& help) {
  return command.add_flag("--overwrite", overwrite, help);
}

std::array<CLI::Option*, 7> AddWorldOptions(CLI::App& command, std::optional<std::uint64_t>& seed,
                                            std::optional<int>& trials, std::vector<std::string>& clips,
                                            std::string& joint_map, std::string& clip_facts) {
  const auto tell = [&clip_facts](const std::string& key) {
    return [&clip_facts, key](const std::string& value) { clip_facts += key + ": " + value + "\n"; };
  };
  return {
      AddSeed(command, seed, "Seed of all worlds (default: the scenario's, else 1)"),
      command.add_option("--trials", trials, "Trials per condition (default: the scenario's)")
          ->check(CLI::Range(1, 1000000)),
      command.add_option("--clips", clips, "Clips instead of the scenarios' own: builtin:NAME, motion files, patterns"),
      command.add_option(kJointMapOption, joint_map,
                         "Which joints of the clips play which roles (etude clip map writes such a file)"),
      command.add_option_function<std::string>(
          "--unit", tell("unit"), "Unit of the clips: m, cm, mm, in, ft, cmu, or metres per unit (default: found)"),
      command.add_option_function<std::string>("--up", tell("up"), "Axis of the clips that points up (default: found)")
          ->check(CLI::IsMember({"y", "z"})),
      command
          .add_option_function<std::string>("--rate", tell("rate"),
                                            "Frames per second of the clips (default: their own)")
          ->check(NumberWithin(1, 1000, "rate in Hz"))};
}

void AddUnsealed(CLI::App& command, Sealing& sealing) {
  command.add_flag_callback(
      "--unsealed", [&sealing] { sealing = Sealing::kIgnored; },
      "Read a run although its folder was changed, and say so");
}

void AddOutsideRules(CLI::App& command, OutsideRules& rules) {
  command.add_flag("!--no-fence", rules.is_fenced, "Run methods outside without a fence, to debug them");
  command.add_flag("--allow-exec", rules.allow_exec, "Run the programs that a manifest, a run or a pack names");
}

std::function<std::string(const std::string&)> NumberWithin(double low, double high, const std::string& kind) {
  return [=](const std::string& text) -> std::string {
    double number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    const bool is_number = error == std::errc() && end == text.data() + text.size();
    if (is_number && number >= low && number <= high) return "";
    return fmt::format("'{}' is no {}; allowed: {} to {}", text, kind, low, high);
  };
}

void DefineCommands(CLI::App& app, const std::string& command_line, Action& action) {
  app.require_subcommand(1);
  DefineRun(app, command_line, action);
  DefineScenario(app, action);
  DefineMerge(app, command_line, action);
  DefineReport(app, action);
  DefineRows(app, action);
  DefineReplay(app, action);
  DefineCite(app, action);
  DefineVerify(app, action);
  DefineGate(app, action);
  DefineCompare(app, action);
  DefineExport(app, action);
  DefineScore(app, command_line, action);
  DefineCheckMethod(app, action);
  DefineList(app, action);
  DefineClip(app, action);
  DefineBridge(app, action);
  DefineTrain(app, action);
  DefineTeach(app, action);
  DefineRecognise(app, action);
  DefineSensor(app, action);
  DefineCalibrate(app, action);
  DefineCapture(app, command_line, action);
  DefineCoach(app, action);
  DefineCrowd(app, action);
  DefineOptionTree(app, action);
  CLI::App* worker = app.add_subcommand("worker", "What the program starts for itself");
  worker->group("");  // hidden
  worker->callback([&action] { action = [] { return RunWorker(std::cin, std::cout); }; });
  RefuseEmptyValues(app);
  AddExamples(app);
}

}  // namespace etude
