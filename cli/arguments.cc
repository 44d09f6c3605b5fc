#include "cli/arguments.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <map>
#include <string_view>
#include <variant>

#include "bench/results/folder.h"
#include "bench/run/outside_programs.h"
#include "bench/run/worker.h"
#include "cli/commands.h"
#include "engine/base/names.h"
#include "engine/base/text.h"
#include "engine/retargeting/marker_sets.h"
#include "io/process/closed_environment.h"

namespace etude {
namespace {

/// Returns example command lines for every command. A key is a command's words without "etude".
const std::map<std::string_view, std::vector<std::string_view>>& ExamplesByCommand() {
  static const std::map<std::string_view, std::vector<std::string_view>> examples = {
      // Each entry holds the words of a command, then its examples.
      {"run", {"etude run quick", "etude run full/ik_weights --trials 50 -o out/try", "etude run mine.yaml --resume"}},
      {"evaluate",
       {"etude evaluate truth.bvh mine.trc", "etude evaluate truth 'first=a/*.npz' second=b -o out/two",
        "etude evaluate --pairs pairs.csv --joints h36m-17"}},
      {"scenario", {"etude scenario copy quick mine", "etude scenario copy full/ik_weights .", "etude list scenarios"}},
      {"list", {"etude list scenarios", "etude list methods", "etude list metrics"}},
      {"clip",
       {"etude clip info walk.bvh", "etude clip render walk.bvh -o walk.mp4", "etude clip convert walk.bvh walk.glb"}},
      {"sensor",
       {"etude sensor stats take.txt", "etude sensor fit take.txt --reference optical.csv -o mine.yaml",
        "etude sensor stats take.txt --reference optical.csv --simulate v2"}},
      {"list recordings", {"etude list recordings", "etude list recordings > recordings.md", "etude rows out/quick-1"}},
      {"scenario copy",
       {"etude scenario copy full/ik_weights .", "etude scenario copy quick mine",
        "etude scenario copy paper/coach ."}},
      {"merge",
       {"etude merge part-1 part-2 -o out/whole", "etude merge shards/* -o out/quick --overwrite",
        "etude merge out/quick-1-*-of-8 -o out/quick"}},
      {"report",
       {"etude report out/quick-1", "etude report out/quick-1 --no-video",
        "etude report out/mine --blind played crossfade-now"}},
      {"blind",
       {"etude blind out/mine/blind/*.key.json answers/*.json", "etude blind key.json anna.json ben.json --json",
        "etude blind a.key.json b.key.json answers/*.json"}},
      {"rows",
       {"etude rows out/many -o many.jsonl", "etude rows out/quick-1 | head -3", "etude rows out/copied --unsealed"}},
      {"replay",
       {"etude replay out/quick-1 --sample 20",
        "etude replay out/quick-1 --cell ik-weights/joint_noise_deg=5/003/fixed --pack cell.etude",
        "etude replay cell.etude"}},
      {"verify",
       {"etude verify out/quick-1", "etude verify out/quick-1 --sample all --sign ~/.minisign/minisign.key",
        "etude verify results --check minisign.pub"}},
      {"cite", {"etude cite out/quick-1", "etude cite out/quick-1 > etude.bib", "etude cite results/paper-table-2"}},
      {"gate",
       {"etude gate out/ci --baseline baseline.json", "etude gate out/ci --baseline baseline.json --update",
        "etude gate mine.yaml --self-test --repetitions 10"}},
      {"compare",
       {"etude compare out/before out/after", "etude compare out/quick-1 out/quick-2",
        "etude compare out/here out/copied --unsealed"}},
      {"export",
       {"etude export quick/ik -o problems", "etude export full/capture_rivals -o takes --depth --trials 2",
        "etude export mine.yaml -o problems --seed 7"}},
      {"score",
       {"etude score problems answers -o out/mine --name mine", "etude score problems answers -o out/mine --alone",
        "etude score quick/ik answers -o out/mine --allow-missing"}},
      {"check-method",
       {"etude check-method --task ik -- python3 ik_dls.py",
        "etude check-method --task coach --seat recogniser -- python3 mine.py",
        "etude check-method --task capture --time 60 -- ./capture"}},
      {"list methods", {"etude list methods", "etude list methods | less", "etude list methods | grep -A9 transition"}},
      {"list clips",
       {"etude list clips", "etude clip render builtin:groove -o groove.mp4", "etude clip info builtin:acts"}},
      {"list scenarios", {"etude list scenarios", "etude list scenarios quick", "etude list scenarios mine/"}},
      {"list metrics",
       {"etude list metrics", "etude list metrics --json > metrics.json", "etude list metrics --markdown"}},
      {"list faults",
       {"etude list faults", "etude evaluate --alone walk.bvh",
        "etude evaluate --alone 'mocap/*.bvh' --limits recorded"}},
      {"list keys",
       {"etude list keys", "etude list keys --schema > scenario.schema.json", "etude list keys --markdown"}},
      {"clip info",
       {"etude clip info walk.bvh", "etude clip info 'mocap/*.bvh' --json",
        "etude clip info dance.glb#Samba --unit cm"}},
      {"clip convert",
       {"etude clip convert walk.bvh walk.glb", "etude clip convert walk.bvh walk.csv --trim 1.5:4",
        "etude clip convert builtin:groove groove.glb --character bear"}},
      {"clip render",
       {"etude clip render walk.bvh -o walk.mp4", "etude clip render 'mocap/*.bvh' -o mocap.png",
        "etude clip render dance.glb -o dance.mp4 --view side"}},
      {"clip contacts",
       {"etude clip contacts walk.bvh -o walk.svg", "etude clip contacts builtin:groove -o groove.svg",
        "etude clip contacts dance.glb#Jump -o jump.svg --overwrite"}},
      {"clip map",
       {"etude clip map walk.bvh", "etude clip map odd.bvh -o map.yaml",
        "etude clip map odd.bvh --joint-map map.yaml"}},
      {"clip grades",
       {"etude clip grades walk.bvh", "etude clip grades walk.bvh -o grades.csv",
        "etude clip grades 'mocap/*.bvh' --fuzzy mine.yaml"}},
      {"bridge",
       {"etude bridge 'mocap/*.bvh' -o tags.xml", "etude bridge 'mocap/*.bvh' --to wave.bvh",
        "etude bridge --check tags.xml 'mocap/*.bvh'"}},
      {"transition",
       {"etude transition walk.bvh kick.bvh --at 2.5 -o out.bvh",
        "etude transition builtin:groove builtin:clap --at 1 -o out.bvh --choice motion-matching --join "
        "inertialised-spring",
        "etude transition lie.bvh run.bvh --at 3 -o out.glb --library 'mocap/*.bvh' --wait 2"}},
      {"train",
       {"etude train 'builtin:*' 'mocap/*.bvh' -o tuned.yaml --hold-out 'mass_*'",
        "etude train 'builtin:*' -o tuned.yaml --method adaptive",
        "etude train 'builtin:*' -o learnt.yaml --recogniser"}},
      {"teach",
       {"etude teach takes/*.txt --labels labels.csv -o moves.yaml", "etude teach wave.bvh bow.bvh -o moves.yaml",
        "etude teach takes/ --labels tags/ -o moves.yaml --format kinect-v1"}},
      {"recognise",
       {"etude recognise new.txt --moves moves.yaml",
        "device | etude recognise - --moves moves.yaml --format kinect-v2",
        "etude recognise joints/ --labels actionLabel.txt --leave-one-person-out --recogniser dtw"}},
      {"sensor stats",
       {"etude sensor stats take.txt", "etude sensor stats take.txt --reference optical.csv",
        "etude sensor stats take.txt --reference optical.csv --simulate v2"}},
      {"sensor fit",
       {"etude sensor fit take.txt --reference optical.csv -o mine.yaml",
        "etude sensor fit take.txt --reference optical.csv -o mine.yaml --base v1",
        "etude sensor fit take.txt --reference optical.csv -o mine.yaml --steps 3"}},
      {"calibrate",
       {"etude calibrate --print board.png", "etude calibrate pairs.csv --size 1920x1080 -o rig.yaml",
        "etude calibrate a.mp4 b.mp4 --board charuco:5x7x0.04 --sync 2 --picture found.png -o rig.yaml"}},
      {"forecast",
       {"etude forecast rig.yaml", "etude forecast rig.yaml --noise-px 8 --size 4,2,4 --report rig.html",
        "etude forecast Calib.toml --dropout 0.1 --picture map.png --table map.csv"}},
      {"capture",
       {"etude capture --rig rig.yaml left.mp4 right.mp4 --keypoints json/ -o motion.bvh",
        "etude capture --rig rig.yaml cam1.mp4 cam2.mp4 --silhouettes --stature 1.8 -o motion.bvh --report page.html",
        "etude capture --rig rig.yaml left.mp4 right.mp4 --marks marks/ -o motion.trc"}},
      {"coach",
       {"etude coach warm_up --stream take.csv --brief", "my_sensor | etude coach groove --stream - | my_stage",
        "etude coach my_song.yaml --beats my_song.txt --click clicks.wav --stream - --policy after-n"}},
      {"crowd",
       {"etude crowd", "etude crowd -o crowd.mp4 --seconds 10", "etude crowd --characters 200 --rate 120 --float"}},
      {"completion",
       {"etude completion bash > ~/.local/share/bash-completion/completions/etude",
        "etude completion zsh > ~/.zfunc/_etude", "etude completion fish > ~/.config/fish/completions/etude.fish"}},
  };
  return examples;
}

void AddTo(CLI::App& command, const std::string& words, const std::string& inherited) {
  std::string footer = command.get_footer() == inherited ? "" : command.get_footer();
  if (const auto own = ExamplesByCommand().find(words); own != ExamplesByCommand().end()) {
    if (!footer.empty()) footer += "\n\n";
    footer += "Examples:";
    for (const std::string_view line : own->second) footer += "\n  " + std::string(line);
  }
  command.footer(footer);
  for (CLI::App* sub : command.get_subcommands([](const CLI::App* one) { return !one->get_name().empty(); })) {
    AddTo(*sub, words + " " + sub->get_name(), inherited);
  }
}

/// Appends examples to the help of every command; `tests/cli/help_test.py` checks the examples against the options.
void AddExamples(CLI::App& app) {
  for (CLI::App* command : app.get_subcommands([](const CLI::App* one) { return !one->get_name().empty(); })) {
    AddTo(*command, command->get_name(), app.get_footer());
  }
}

/// Makes all options refuse empty values, which most often come from an unset shell variable.
void RefuseEmptyValues(CLI::App& command) {
  const CLI::Validator not_empty([](std::string& text) { return text.empty() ? "must not be empty" : ""; }, "");
  for (CLI::Option* option : command.get_options()) {
    if (option->get_items_expected_max() > 0) option->check(not_empty);
  }
  for (CLI::App* inner : command.get_subcommands([](CLI::App*) { return true; })) RefuseEmptyValues(*inner);
}

/// Returns the range of seeds that every JSON reader represents exactly: integers from 0 to 2^53.
const CLI::Range& SeedRange() {
  static const CLI::Range range(std::uint64_t{0}, std::uint64_t{1} << 53);
  return range;
}

}  // namespace

CLI::Option* AddSeed(CLI::App& command, std::uint64_t& seed, const std::string& help) {
  return command.add_option("--seed", seed, help)->check(SeedRange());
}

CLI::Option* AddSeed(CLI::App& command, std::optional<std::uint64_t>& seed, const std::string& help) {
  return command.add_option("--seed", seed, help)->check(SeedRange());
}

CLI::Option* AddSeedFile(CLI::App& command, std::string& file) {
  CLI::Option* option =
      command.add_option("--seed-file", file,
                         "A file with a secret key from which all worlds are drawn: 64 hexadecimal digits or 32 bytes. "
                         "The environment variable ETUDE_SEED_KEY can contain the digits instead");
  if (CLI::Option* seed = command.get_option_no_throw("--seed")) option->excludes(seed);
  return option;
}

Result<std::optional<SecretKey>> TakeSecretKey(const std::string& file, bool has_seed) {
  ASSIGN_OR_RETURN(auto key, FindSecretKey(file));
  if (key && has_seed) return Fail({kKeyVariable}, "and --seed are both set; use only one of them");
  if (struct stat status{}; key && ::stat(key->file.c_str(), &status) == 0 && (status.st_mode & S_IROTH) != 0) {
    Complain({{file}, "can be read by other users; `chmod 600` protects the key"});
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

void AddReuseKey(CLI::App& command, bool& reuse_key) {
  command
      .add_flag("--reuse-key", reuse_key,
                "Accept a key that was used before, although its worlds may no longer be secret")
      ->needs(command.get_option("--seed-file"));
}

CLI::Option* AddJobs(CLI::App& command, int& jobs) {
  return command.add_option("-j,--jobs", jobs, "Number of worker processes (default: one per processor)")
      ->check(CLI::Range(1, 1024));
}

CLI::Option* AddOverwrite(CLI::App& command, bool& overwrite, const std::string& help) {
  return command.add_flag("--overwrite", overwrite, help);
}

CLI::Option* AddUnit(CLI::App& command, const std::string& of, std::string& clip_facts) {
  return command.add_option_function<std::string>(
      "--unit", [&clip_facts](const std::string& value) { clip_facts += "unit: " + value + "\n"; },
      "Unit of the " + of + ": m, cm, mm, in, ft, cmu, or a number of metres per unit (default: estimated)");
}

CLI::Option* AddUp(CLI::App& command, const std::string& of, std::string& clip_facts) {
  return command
      .add_option_function<std::string>(
          "--up", [&clip_facts](const std::string& value) { clip_facts += "up: " + value + "\n"; },
          "Axis of the " + of + " that points up (default: estimated)")
      ->check(OneOf({"y", "z"}));
}

std::array<CLI::Option*, 9> AddWorldOptions(CLI::App& command, std::optional<std::uint64_t>& seed,
                                            std::optional<int>& trials, std::vector<std::string>& clips,
                                            std::string& joint_map, std::string& clip_facts) {
  const auto tell = [&clip_facts](const std::string& key) {
    return [&clip_facts, key](const std::string& value) { clip_facts += key + ": " + value + "\n"; };
  };
  // These options have defaults that come from scenarios or clips; the help of each option names the default.
  return {
      AddSeed(command, seed, "Seed of the random numbers of all worlds (default: the scenario's seed, otherwise 1)"),
      command.add_option("--trials", trials, "Number of trials per condition (default: the scenario's number)")
          ->check(CLI::Range(1, 1000000)),
      command.add_option(
          "--clips", clips,
          "Clips that replace the clips of the scenarios: builtin:NAME, motion files, or patterns of file names"),
      command.add_option(
          kJointMapOption, joint_map,
          "A joint map: a file that assigns joints of the clips to roles (`etude clip map` writes such a file)"),
      AddUnit(command, "clips", clip_facts),
      AddUp(command, "clips", clip_facts),
      command
          .add_option_function<std::string>("--rate", tell("rate"),
                                            "Frames per second of the clips (default: the rate that each clip states)")
          ->check(NumberWithin(1, 1000, "rate in Hz")),
      command.add_flag_callback(
          "--keep-floor", [&clip_facts] { clip_facts += "keep_floor: true\n"; },
          "Keep the heights of the clips, instead of placing the bodies on the floor"),
      command
          .add_option_function<std::string>(
              "--marker-set", tell("marker_set"),
              "The marker set of the clips (default: the most suitable set that the clips contain)")
          ->check(OneOf(MarkerSetKeys()))};
}

void AddUnsealed(CLI::App& command, Sealing& sealing) {
  command.add_flag_callback(
      "--unsealed", [&sealing] { sealing = Sealing::kIgnored; },
      "Read a run or baseline even if its files were changed, and print a warning");
}

void AddOutsideRules(CLI::App& command, OutsideRules& rules) {
  command.add_flag("!--no-fence", rules.is_fenced,
                   "Run outside methods without their sandbox (the fence), to debug them");
  command.add_flag("--allow-exec", rules.allow_exec,
                   "Allow Etude to run programs that a manifest, a run or a packed cell specifies");
}

CLI::Validator OneOf(const std::vector<std::string>& names) {
  CLI::Validator check = CLI::IsMember(names);
  check.operation([names](const std::string& text) {
    return std::ranges::find(names, text) != names.end() ? "" : UnknownName("value", text, names);
  });
  return check;
}

std::function<std::string(const std::string&)> NumberWithin(double low, double high, const std::string& kind) {
  return [=](const std::string& text) -> std::string {
    const auto number = ParseNumber<double>(text);
    if (number && *number >= low && *number <= high) return "";
    return fmt::format("'{}' is not a {}; allowed: {} to {}", text, kind, low, high);
  };
}

namespace {

using Define = void (*)(CLI::App&, Action&);
/// Defines a command whose command line is recorded in host.json.
using DefineRecorded = void (*)(CLI::App&, const std::string& command_line, Action&);

struct Command {
  std::string_view name;
  const char* group;  // the heading in `etude --help`; "" hides the command
  std::variant<Define, DefineRecorded> define;
};

void DefineWorker(CLI::App& app, Action& action) {
  app.add_subcommand("worker", "For internal use")->callback([&action] {
    action = [] { return RunWorker(std::cin, std::cout); };
  });
}

constexpr const char *kJudge = "Run and judge", *kMotions = "Your motions", *kPeople = "Your recordings of people",
                     *kCameras = "Your cameras", *kShare = "Share";

/// The commands in the order of the help, which lists groups in the order of their first commands.
constexpr Command kCommands[] = {
    {"run", kJudge, DefineRun},
    {"evaluate", kJudge, DefineEvaluate},
    {"scenario", kJudge, DefineScenario},
    {"merge", kJudge, DefineMerge},
    {"report", kJudge, DefineReport},
    {"rows", kJudge, DefineRows},
    {"blind", kJudge, DefineBlind},
    {"replay", kJudge, DefineReplay},
    {"verify", kJudge, DefineVerify},
    {"gate", kJudge, DefineGate},
    {"compare", kJudge, DefineCompare},
    {"check-method", kJudge, DefineCheckMethod},
    {"list", kJudge, DefineList},
    {"clip", kMotions, DefineClip},
    {"bridge", kMotions, DefineBridge},
    {"transition", kMotions, DefineTransition},
    {"crowd", kMotions, DefineCrowd},
    {"train", kMotions, DefineTrain},
    {"teach", kPeople, DefineTeach},
    {"recognise", kPeople, DefineRecognise},
    {"coach", kPeople, DefineCoach},
    {"sensor", kPeople, DefineSensor},
    {"calibrate", kCameras, DefineCalibrate},
    {"forecast", kCameras, DefineForecast},
    {"capture", kCameras, DefineCapture},
    {"cite", kShare, DefineCite},
    {"export", kShare, DefineExport},
    {"score", kShare, DefineScore},
    {"completion", kShare, DefineCompletion},
    {"man", "", DefineManual},
    {"worker", "", DefineWorker},
};
/// The commands that print every command's options.
constexpr std::string_view kNeedAll[] = {"completion", "man"};

}  // namespace

void DefineCommands(CLI::App& app, std::string_view wanted, const std::string& command_line, Action& action) {
  app.require_subcommand(1);
  app.option_defaults()->always_capture_default();  // the help shows every default
  const bool is_one = std::ranges::find(kCommands, wanted, &Command::name) != std::end(kCommands) &&
                      std::ranges::find(kNeedAll, wanted) == std::end(kNeedAll);
  for (const Command& command : kCommands) {
    if (is_one && command.name != wanted) continue;
    if (const auto* define = std::get_if<Define>(&command.define)) {
      (*define)(app, action);
    } else {
      std::get<DefineRecorded>(command.define)(app, command_line, action);
    }
    app.get_subcommand(std::string(command.name))->group(command.group);
  }
  RefuseEmptyValues(app);
  AddExamples(app);
}

}  // namespace etude
