#pragma once

#include <functional>
#include <string>

namespace CLI {
class App;
}

namespace etude {

/// What the command line asked for; gives the exit code.
using Action = std::function<int()>;

/// Defines every command with its options. Parsing a command line with `app` then leaves the chosen one in `action`.
/// `command_line` is kept in host.json.
void DefineCommands(CLI::App& app, const std::string& command_line, Action& action);

}  // namespace etude
