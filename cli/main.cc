#include <fcntl.h>
#include <fmt/ranges.h>
#include <sys/resource.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <csignal>
#include <exception>
#include <filesystem>
#include <memory>
#include <new>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "bench/results/npy.h"
#include "cli/arguments.h"
#include "cli/commands.h"
#include "cli/interrupt.h"
#include "cli/visible_output.h"
#include "engine/base/machine.h"
#include "engine/base/names.h"
#include "engine/base/utf8.h"
#include "io/drawing/escape.h"
#include "io/process/closed_environment.h"
#include "io/process/heap.h"
#include "sim/render/renderer.h"

namespace etude {
namespace {

constexpr const char* kAbout =
    "Etude is a simulator and benchmark for interactive human motion. It simulates scenes (\"worlds\") with known "
    "truth, runs\n"
    "methods on them, and reports which method is better, by how much, and with what confidence.\n";

constexpr const char* kExamples =
    "\n"
    "Try:\n"
    "  etude run quick                                run the quick suite; the result folder is out/quick-1\n"
    "  etude run quick --clips '~/mocap/*.bvh'        run the quick suite on your own motion capture\n"
    "  etude report out/quick-1                       write a page, tables, a JUnit file and a video of a run\n"
    "  etude run quick --resume                       continue a run that was interrupted\n"
    "  etude gate out/quick-1 --baseline FILE         compare a run with a baseline, for a CI server\n"
    "  etude run paper                                test the claims of the papers in the situations of the papers\n"
    "  etude list methods                             list methods; likewise keys, metrics, clips, scenarios\n"
    "  etude clip render '~/mocap/*.bvh' -o mocap.png      draw clips; see also clip info, clip convert, clip map\n"
    "  etude bridge '~/mocap/*.bvh' -o tags.xml       find the frames that suit transitions between these clips\n"
    "  etude train 'builtin:*' -o mine.yaml           learn a fuzzy system from clips, for the key `fuzzy` of a "
    "scenario\n"
    "  etude teach takes/*.txt --labels labels.csv -o moves.yaml      learn moves from recordings of people\n"
    "  etude recognise new.txt --moves moves.yaml     recognise these moves in a recording or a live stream\n"
    "  etude calibrate left/ right/ -o rig.yaml       calibrate cameras from pictures of a board or measured points\n"
    "  etude capture --rig rig.yaml left.mp4 right.mp4 --keypoints json/ -o motion.bvh     recover a motion from "
    "films\n\n"
    "Exit codes: 0 success; 1 a method has no answer (gate: a regression; replay, verify: a difference); 2 invalid "
    "input,\n"
    "nothing is written; 3 the run is incomplete, or this machine prevented the command; 130 interrupted.";

/// Lists the options and subcommands that may be used in place of a wrong word.
std::vector<std::string> KnownWords(const CLI::App& app) {
  std::vector<std::string> known;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App* sub) { return !sub->get_name().empty(); })) {
    if (!command->get_group().empty()) known.push_back(command->get_name());
  }
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
  }
  return known;
}

int ComplainOfArguments(const CLI::App& app, const CLI::ParseError& error) {
  const CLI::App* command = &app;
  std::string words;  // the words of the command, each followed by a space
  while (!command->get_subcommands().empty()) {
    command = command->get_subcommands().front();
    words += command->get_name() + " ";
  }
  // If there is an unknown word, report this word instead of CLI11's error, which is often only its consequence, such
  // as a missing argument. Words after "--" belong to another program.
  std::vector<std::string> extras = app.remaining(true);
  extras.erase(std::ranges::find(extras, "--"), extras.end());
  std::string message = error.what();
  // Tell which values an option needs if their number is wrong.
  if (const CLI::Option* option = command->get_option_no_throw(message.substr(0, message.find(':')));
      option != nullptr && error.get_name() == "ArgumentMismatch") {
    message += fmt::format(": {}", option->get_description());
  }
  if (!extras.empty()) {
    message =
        UnknownName(extras.front().starts_with("-") ? "option" : "argument", extras.front(), KnownWords(*command));
  }
  return Complain(Error{{}, fmt::format("{} (etude {}--help explains)", message, words)});
}

/// Formats help identically in every run and with every version of CLI11. CLI11 orders excluded options by memory
/// addresses, and versions of CLI11 write defaults differently.
class OrderedHelp : public CLI::Formatter {
 public:
  std::string make_option_opts(const CLI::Option* option) const override {
    std::string text;
    if (option->get_type_size() != 0) {
      if (!option->get_type_name().empty()) text += " " + get_label(option->get_type_name());
      // Do not show a default that the description already states in words, or an empty list.
      const std::string value = option->get_default_str();
      const bool is_stated =
          option->get_required() || option->get_description().find("(default: ") != std::string::npos;
      if (!value.empty() && value != "[]" && value != "{}" && !is_stated) text += "=" + value;
      if (option->get_expected_max() == CLI::detail::expected_max_vector_size) {
        text += " ...";
      } else if (option->get_expected_min() > 1) {
        text += fmt::format(" x {}", option->get_expected());
      }
      if (option->get_required()) text += " " + get_label("REQUIRED");
    }
    return text + Others("Needs", option->get_needs()) + Others("Excludes", option->get_excludes());
  }

 private:
  std::string Others(const char* label, const std::set<CLI::Option*>& others) const {
    std::vector<std::string> names;
    for (const CLI::Option* other : others) names.push_back(other->get_name());
    std::ranges::sort(names);
    return names.empty() ? "" : fmt::format(" {}: {}", get_label(label), fmt::join(names, " "));
  }
};

bool output_was_closed = false;

/// Refuses arguments that are not UTF-8, because manifests, rows and pages would contain them and are UTF-8.
Result<void> CheckNames(std::span<char*> arguments) {
  for (std::size_t i = 1; i < arguments.size(); ++i) {
    if (CheckUtf8(arguments[i], "")) continue;
    return Fail({fmt::format("argument {}", i)}, "is not UTF-8 text; allowed: names in UTF-8");
  }
  std::error_code error;
  const std::string here = std::filesystem::current_path(error).string();
  if (!CheckUtf8(here, ""))
    return Fail({}, "the name of the working folder is not UTF-8 text; start Etude in another folder");
  return {};
}

/// Opens the standard streams that the parent has closed. Without this, the next opened file would get the number of a
/// standard stream, and printed text would go into this file.
void OpenStandardStreams() {
  output_was_closed = ::fcntl(STDOUT_FILENO, F_GETFD) < 0;
  for (int descriptor = ::open("/dev/null", O_RDWR); descriptor >= 0; descriptor = ::dup(descriptor)) {
    if (descriptor <= STDERR_FILENO) continue;
    ::close(descriptor);
    break;
  }
}

/// Raises the stack limit to the kernel's usual 8 MiB, if that is allowed. Fails if less than 1 MiB is allowed, because
/// some libraries would overflow such a stack.
Result<void> TakeStack() {
  constexpr rlim_t kUsualStack = rlim_t{8} << 20, kMinStack = rlim_t{1} << 20;
  rlimit limit{};
  if (::getrlimit(RLIMIT_STACK, &limit) != 0 || limit.rlim_cur >= kUsualStack) return {};
  limit.rlim_cur = std::min(limit.rlim_max, kUsualStack);
  ::setrlimit(RLIMIT_STACK, &limit);
  if (limit.rlim_cur >= kMinStack) return {};
  return FailOfMachine("the stack size is limited to {} KiB; Etude needs at least {} KiB (set it with `ulimit -s`)",
                       limit.rlim_cur >> 10, kMinStack >> 10);
}

int Main(int argc, char** argv) {
  // The launcher sets the environment before this program starts, so that results do not depend on the shell's
  // variables.
  if (const std::string other = FirstDifferenceFromClosed(); !other.empty()) {
    return Complain({{},
                     fmt::format("the environment is not the one that the program `etude` sets ('{}'); start `etude`, "
                                 "which starts this program",
                                 other)});
  }
  if (auto named = CheckNames({argv, static_cast<std::size_t>(argc)}); !named) return Complain(named.error());
  CLI::App app(kAbout, "etude");
  app.formatter(std::make_shared<OrderedHelp>());
  app.footer(kExamples);
  app.set_version_flag("--version", ETUDE_VERSION);
  static char help[] = "--help";
  if (argc > 1 && std::string_view(argv[1]) == "help") {  // "etude help run" becomes "etude run --help"
    std::rotate(argv + 1, argv + 2, argv + argc);
    argv[argc - 1] = help;
  }
  std::string command_line = "etude";
  for (int i = 1; i < argc; ++i) command_line += " " + ShellWord(argv[i]);
  Action action;
  const std::string_view command = argc > 1 ? argv[1] : "", subcommand = argc > 2 ? argv[2] : "";
  DefineCommands(app, command, command_line, action);
  // Parse the command line. Unknown words are an error even after --help.
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help_or_version) {
    if (!app.remaining(true).empty()) return ComplainOfArguments(app, help_or_version);
    return app.exit(help_or_version);
  } catch (const CLI::ParseError& error) {
    return ComplainOfArguments(app, error);
  }
  if (auto choice = CheckRendererChoice(); !choice) return Complain(choice.error());
  if (command == "report" || (command == "clip" && subcommand == "render")) DrawAsFastAsPossible();
  EndWhenInterrupted();
  return action();
}

}  // namespace

bool OutputWasClosed() { return output_was_closed; }

}  // namespace etude

int main(int argc, char** argv) {
  etude::OpenStandardStreams();
  // The parent may have set SIGCHLD to be ignored, which would lose the exit status of this process's children.
  std::signal(SIGCHLD, SIG_DFL);
  etude::ExitOnTruncatedMapping();
  etude::PrepareHeap();
  std::signal(SIGXFSZ, SIG_IGN);  // a write beyond a file-size limit then fails with an error that is reported
  if (auto stack = etude::TakeStack(); !stack) return etude::Complain(stack.error());
  etude::MakeOutputSafe();
  try {
    const int code = etude::Main(argc, argv);
    if (std::fflush(stdout) == 0 && etude::OutputError() == 0) return code;
    const int error = etude::OutputError() != 0 ? etude::OutputError() : errno;
    return etude::Complain(etude::CannotWrite("standard output", "cannot be written", error).value());
  } catch (const std::bad_alloc&) {
    return etude::Complain(etude::FailOfMachine("out of memory").value());
  } catch (const std::filesystem::filesystem_error& error) {
    return etude::Complain({{}, error.what()});
  } catch (const std::system_error& error) {  // thrown by fmt if the output cannot be written
    return etude::Complain(etude::CannotWrite("standard output", "cannot be written", error.code().value()).value());
  } catch (const std::exception& error) {
    return etude::Complain({{}, error.what()});
  }
}
