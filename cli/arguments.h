#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench/run/secret_key.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace etude {

struct OutsideRules;
enum class Sealing;

/// The command that a command line asks for; gives the exit code.
using Action = std::function<int()>;

/// Defines every command with its options. Parsing a command line with `app` then leaves the chosen one in `action`.
/// `command_line` is kept in host.json.
void DefineCommands(CLI::App& app, const std::string& command_line, Action& action);

// Options that several commands have.

/// Adds --seed; without a value of its own `seed` keeps its default, which the help tells.
CLI::Option* AddSeed(CLI::App& command, std::uint64_t& seed, const std::string& help);
/// Adds --seed where nothing stands for what a scenario, or the program, has by default.
CLI::Option* AddSeed(CLI::App& command, std::optional<std::uint64_t>& seed, const std::string& help);
/// Adds --seed-file, of every command that throws the dice of worlds; it stands in the place of --seed.
CLI::Option* AddSeedFile(CLI::App& command, std::string& file);
/// Reads the key of secret worlds, if there is one; says when others can read its file, and refuses a seed beside it.
Result<std::optional<SecretKey>> TakeSecretKey(const std::string& file, bool has_seed = false);
/// Adds --seed-file, and makes an action that takes the key into `key` before it goes on to `act`, or complains. `seed`
/// is that of --seed; null where there is none. Both belong to what `act` keeps.
Action WithSecretKey(CLI::App& command, const std::optional<std::uint64_t>* seed, std::optional<SecretKey>& key,
                     const Action& act);
/// Adds --reuse-key, of commands with a --seed-file that refuse a key that was used before.
void AddReuseKey(CLI::App& command, bool& reuse_key);
/// Adds -j, --jobs.
CLI::Option* AddJobs(CLI::App& command, int& jobs);
/// Adds --overwrite.
CLI::Option* AddOverwrite(CLI::App& command, bool& overwrite, const std::string& help = "Replace a file that is there");
/// The names of the option of a joint-map file, of every command that opens clips.
constexpr const char* kJointMapOption = "--joint-map,--map";
/// Adds --seed, --trials, --clips, --joint-map, --unit, --up and --rate, of every command that makes worlds of
/// scenarios; the last three become lines of a joint-map file in `clip_facts`. The third option is --clips.
std::array<CLI::Option*, 7> AddWorldOptions(CLI::App& command, std::optional<std::uint64_t>& seed,
                                            std::optional<int>& trials, std::vector<std::string>& clips,
                                            std::string& joint_map, std::string& clip_facts);
/// Adds --unsealed, of every command that reads a run.
void AddUnsealed(CLI::App& command, Sealing& sealing);
/// Adds --no-fence and --allow-exec, of every command that runs methods outside.
void AddOutsideRules(CLI::App& command, OutsideRules& rules);

/// Checks an option's text: gives "" for a number from `low` to `high`, else the complaint. CLI::Range would let NaN
/// through. `kind` says what the number is: "rate in Hz".
std::function<std::string(const std::string& text)> NumberWithin(double low, double high, const std::string& kind);

}  // namespace etude
