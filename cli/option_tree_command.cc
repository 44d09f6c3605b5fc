#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <functional>
#include <memory>

#include "bench/run/shipped.h"
#include "cli/commands.h"
#include "cli/output_file.h"
#include "engine/base/names.h"
#include "io/files/files.h"

// Texts that are generated from the option tree: shell completion, manual pages, and a page of all commands.

namespace etude {
namespace {

constexpr const char* kShellArgument = "shell";

std::vector<std::string> Shells() { return {"bash", "zsh", "fish"}; }

std::vector<const CLI::App*> CommandsOf(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App* sub) { return !sub->get_name().empty() && !sub->get_group().empty(); });
}

/// Calls `use` for the program and for every command and subcommand, with the words that name the command: "clip info".
void ForEachCommand(const CLI::App& app, const std::string& words,
                    const std::function<void(const CLI::App& command, const std::string& words)>& use) {
  use(app, words);
  for (const CLI::App* command : CommandsOf(app)) {
    ForEachCommand(*command, words.empty() ? command->get_name() : words + " " + command->get_name(), use);
  }
}

/// Returns the options of a command, and the names of each option: "-o", "--output".
std::vector<std::pair<const CLI::Option*, std::vector<std::string>>> OptionsOf(const CLI::App& command) {
  std::vector<std::pair<const CLI::Option*, std::vector<std::string>>> options;
  for (const CLI::Option* option : command.get_options()) {
    std::vector<std::string> names;
    for (const std::string& name : option->get_snames()) names.push_back("-" + name);
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    if (!names.empty()) options.emplace_back(option, std::move(names));
  }
  return options;
}

constexpr std::string_view kHelp = "help";  ///< "etude help COMMAND"; main turns it into "etude COMMAND --help"

/// Returns the values, other than files, that a shell can offer for a command's arguments: the shells, or the scenarios
/// and suites that come with etude.
std::vector<std::string> ArgumentsOf(const CLI::App& command) {
  const auto asks_for = [&](const char* argument) { return command.get_option_no_throw(argument) != nullptr; };
  if (asks_for(kShellArgument)) return Shells();
  if (!asks_for("scenarios") && !asks_for("scenario")) return {};
  std::vector<std::string> names = ShippedScenarios();
  names.insert(names.end(), {"quick", "paper", "full"});
  return names;
}

/// Returns all words that may follow a command: the command's subcommands, options and values of arguments.
std::string FollowersOf(const CLI::App& command) {
  std::vector<std::string> words;
  for (const CLI::App* sub : CommandsOf(command)) words.push_back(sub->get_name());
  if (command.get_parent() == nullptr) words.emplace_back(kHelp);
  for (const auto& [option, names] : OptionsOf(command)) words.insert(words.end(), names.begin(), names.end());
  std::ranges::move(ArgumentsOf(command), std::back_inserter(words));
  return Join(words, " ");
}

/// Returns the branches of a shell's `case`, one per command. `write` makes a branch from a command's words and from
/// the words that may follow the command.
std::string Cases(const CLI::App& app,
                  const std::function<std::string(const std::string&, const std::string&)>& write) {
  std::string text;
  ForEachCommand(
      app, "", [&](const CLI::App& command, const std::string& words) { text += write(words, FollowersOf(command)); });
  return text;
}

/// The code for bash and zsh that finds the command's words before the cursor: words without a dash that lead to a
/// known command. `help` does not count as a command, so commands are also offered after `help`.
constexpr std::string_view kFindCommand = R"(  local at="" word
  for word in "${before[@]}"; do
    case "${at:+$at }$word" in
      COMMANDS) at="${at:+$at }$word" ;;
    esac
  done
)";

std::string FindCommand(const CLI::App& app) {
  std::vector<std::string> commands;
  ForEachCommand(app, "", [&](const CLI::App&, const std::string& words) {
    if (!words.empty()) commands.push_back("'" + words + "'");
  });
  std::string text(kFindCommand);
  return text.replace(text.find("COMMANDS"), std::string_view("COMMANDS").size(), Join(commands, "|"));
}

std::string BashCompletion(const CLI::App& app) {
  const auto branch = [](const std::string& words, const std::string& followers) {
    return fmt::format("    '{}') known='{}' ;;\n", words, followers);
  };
  return "# Completion of etude for bash, made by `etude completion bash`.\n_etude() {\n"
         "  local before=(\"${COMP_WORDS[@]:1:COMP_CWORD-1}\") known=\n" +
         FindCommand(app) + "  case \"$at\" in\n" + Cases(app, branch) +
         "  esac\n  COMPREPLY=($(compgen -W \"$known\" -- \"${COMP_WORDS[COMP_CWORD]}\"))\n}\n"
         "complete -o default -o bashdefault -F _etude etude\n";
}

std::string ZshCompletion(const CLI::App& app) {
  const auto branch = [](const std::string& words, const std::string& followers) {
    return fmt::format("    '{}') known=({}) ;;\n", words, followers);
  };
  return "#compdef etude\n# Completion of etude for zsh, made by `etude completion zsh`.\n"
         "local -a before known\nbefore=(\"${(@)words[2,CURRENT-1]}\")\n" +
         FindCommand(app) + "case \"$at\" in\n" + Cases(app, branch) + "esac\ncompadd -- \"${known[@]}\"\n_files\n";
}

std::string FishCompletion(const CLI::App& app) {
  const auto quoted = [](std::string text) {
    for (std::size_t at = 0; (at = text.find_first_of("'\\", at)) != std::string::npos; at += 2) text.insert(at, "\\");
    return "'" + text + "'";
  };
  std::string text = "# Completion of etude for fish, made by `etude completion fish`.\n";
  std::vector<std::string> helped;
  ForEachCommand(app, "", [&](const CLI::App& command, const std::string& words) {
    // Write the condition under which fish offers the words that may follow the command.
    std::string when = "__fish_use_subcommand";
    if (!words.empty()) {
      when.clear();
      for (std::size_t from = 0; from <= words.size();) {
        const std::size_t end = std::min(words.find(' ', from), words.size());
        when += (from == 0 ? "" : "; and ") + ("__fish_seen_subcommand_from " + words.substr(from, end - from));
        from = end + 1;
      }
    }
    // Offer subcommands, values of arguments, and options.
    for (const CLI::App* sub : CommandsOf(command)) {
      text +=
          fmt::format("complete -c etude -n '{}' -a {} -d {}\n", when, sub->get_name(), quoted(sub->get_description()));
      if (words.empty()) helped.push_back(sub->get_name());
    }
    if (const auto arguments = ArgumentsOf(command); !arguments.empty()) {
      text += fmt::format("complete -c etude -n '{}' -a {}\n", when, quoted(Join(arguments, " ")));
    }
    for (const auto& [option, names] : OptionsOf(command)) {
      text += fmt::format("complete -c etude -n '{}'", when);
      for (const std::string& name : names) {
        text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
      }
      text += fmt::format("{} -d {}\n", option->get_items_expected_max() > 0 ? " -r" : "",
                          quoted(option->get_description()));
    }
  });
  // Offer the commands again after `help`.
  return text + fmt::format(
                    "complete -c etude -n __fish_use_subcommand -a {0} -d 'What a command does'\n"
                    "complete -c etude -n '__fish_seen_subcommand_from {0}' -a {1}\n",
                    kHelp, quoted(Join(helped, " ")));
}

/// Escapes text for troff, so that no line is read as a troff request, and no dash as a hyphen.
std::string Troff(const std::string& text) {
  std::string result;
  bool starts_line = true;
  for (const char c : text) {
    if (starts_line && (c == '.' || c == '\'')) result += "\\&";
    if (c == '\\') {
      result += "\\e";
    } else if (c == '-') {
      result += "\\-";
    } else {
      result += c;
    }
    starts_line = c == '\n';
  }
  return result;
}

std::string ManualPage(const CLI::App& command, const std::string& words) {
  std::string title = words.empty() ? "etude" : "etude " + words;
  std::ranges::replace(title, ' ', '-');
  // Write the name and the synopsis.
  const std::string about = command.get_description();
  const std::string brief = about.substr(0, about.find('\n'));
  std::string text = fmt::format(".TH {} 1 \"\" \"Etude {}\"\n.SH NAME\n{} \\- {}\n.SH SYNOPSIS\n.B etude {}\n", title,
                                 ETUDE_VERSION, Troff(title), Troff(brief), Troff(words));
  std::string arguments, told;
  for (const CLI::Option* option : command.get_options()) {
    if (!option->get_positional()) continue;
    const std::string name = option->get_name(true) + (option->get_items_expected_max() > 1 ? " ..." : "");
    arguments += option->get_required() ? name + " " : "[" + name + "] ";
    told += fmt::format(".TP\n.I {}\n{}\n", Troff(option->get_name(true)), Troff(option->get_description()));
  }
  // Write the description, the arguments, and the subcommands.
  if (!CommandsOf(command).empty()) arguments += "COMMAND ";
  text += Troff(arguments + "[options]") + "\n.SH DESCRIPTION\n.nf\n" + Troff(about) + "\n.fi\n";
  if (!told.empty()) text += ".SH ARGUMENTS\n" + told;
  if (!CommandsOf(command).empty()) text += ".SH COMMANDS\n";
  for (const CLI::App* sub : CommandsOf(command)) {
    text +=
        fmt::format(".TP\n.BR {}\n{}\n", Troff(title + "-" + sub->get_name()) + " (1)", Troff(sub->get_description()));
  }
  // Write the options and the examples.
  text += ".SH OPTIONS\n";
  for (const auto& [option, names] : OptionsOf(command)) {
    const std::string type = option->get_type_name();  // for example "INT:INT in [1 - 1024]"
    const bool takes_value = option->get_items_expected_max() > 0;
    text += fmt::format(".TP\n\\fB{}\\fR{}\n{}\n", Troff(Join(names)),
                        takes_value ? " \\fI" + Troff(type.substr(0, type.find(':'))) + "\\fR" : "",
                        Troff(option->get_description()));
  }
  if (const std::string footer = command.get_footer(); !footer.empty()) {
    text += ".SH EXAMPLES\n.nf\n" + Troff(footer) + "\n.fi\n";
  }
  return text;
}

Result<int> WriteManual(const CLI::App& app, const std::string& folder) {
  Result<void> written;
  ForEachCommand(app, "", [&](const CLI::App& command, const std::string& words) {
    std::string name = words.empty() ? "etude" : "etude " + words;
    std::ranges::replace(name, ' ', '-');
    if (written) written = WriteFileAtomically(folder + "/" + name + ".1", ManualPage(command, words));
  });
  RETURN_IF_ERROR(written);
  TellWritten(folder);
  return kSuccess;
}

/// Returns docs/reference/commands.md: the output of each command's `--help`.
std::string CommandsPage(const CLI::App& app) {
  std::string text =
      "# Every command\n\n`scripts/docs` writes this page from the help text of each command. A test compares the page "
      "with these texts.\n";
  ForEachCommand(app, "", [&](const CLI::App& command, const std::string& words) {
    if (words.empty()) return;
    const std::size_t above = words.rfind(' ');
    const std::string help = command.help("etude" + (above == std::string::npos ? "" : " " + words.substr(0, above)));
    const std::size_t first = help.find_first_not_of('\n'), last = help.find_last_not_of('\n');
    text += fmt::format("\n## etude {}\n\n```text\n{}\n```\n", words, help.substr(first, last + 1 - first));
  });
  return text;
}

}  // namespace

void DefineCompletion(CLI::App& app, Action& action) {
  auto shell = std::make_shared<std::string>();
  CLI::App* completion =
      app.add_subcommand("completion", "Print a script with which a shell completes commands and options of etude");
  completion->add_option(kShellArgument, *shell, "bash, zsh or fish")->required()->check(OneOf(Shells()));
  completion->callback([shell, &app, &action] {
    action = [shell, &app] {
      fmt::print("{}", *shell == "bash"  ? BashCompletion(app)
                       : *shell == "zsh" ? ZshCompletion(app)
                                         : FishCompletion(app));
      return kSuccess;
    };
  });
}

void DefineManual(CLI::App& app, Action& action) {
  auto folder = std::make_shared<std::string>();
  auto as_page = std::make_shared<bool>(false);
  CLI::App* manual = app.add_subcommand("man", "Write the manual pages into a folder")->require_option(1);
  manual->add_option("folder", *folder);
  manual->add_flag("--markdown", *as_page, "Print all manual pages as a single page instead");
  manual->callback([=, &app, &action] {
    action = [=, &app]() -> int {
      if (!*as_page) return Finish(WriteManual(app, *folder));
      fmt::print("{}", CommandsPage(app));
      return kSuccess;
    };
  });
}

}  // namespace etude
