#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/run/secret_key.h"

namespace CLI {
class App;
class Option;
class Validator;
}  // namespace CLI

namespace etude {

struct OutsideRules;
enum class Sealing;

/// Runs the chosen command; returns the command's exit code.
using Action = std::function<int()>;

/// Defines the command `wanted` and its options. Defines every command if `wanted` is not the name of a command, or if
/// this command prints all commands. When `app` parses a command line, the chosen command is stored in `action`.
/// `command_line` is recorded in host.json.
void DefineCommands(CLI::App& app, std::string_view wanted, const std::string& command_line, Action& action);

// The functions below add options that several commands share.

/// Adds --seed. If the option is not given, `seed` keeps the value that it had before. The help shows this value as the
/// default.
CLI::Option* AddSeed(CLI::App& command, std::uint64_t& seed, const std::string& help);
/// Adds --seed. If the option is not given, `seed` is nullopt; the scenario's or the program's default then applies.
CLI::Option* AddSeed(CLI::App& command, std::optional<std::uint64_t>& seed, const std::string& help);
/// Adds --seed-file, for every command that draws the random numbers of worlds. The command refuses --seed together
/// with --seed-file.
CLI::Option* AddSeedFile(CLI::App& command, std::string& file);
/// Reads the key of secret worlds; nullopt if `file` is "". Warns if other users can read the file; fails if a seed is
/// also given.
Result<std::optional<SecretKey>> TakeSecretKey(const std::string& file, bool has_seed = false);
/// Adds --seed-file and returns an action that reads the key into `key` and then runs `act`, or complains if the key
/// cannot be read. `seed` is the value of --seed, or null for a command without that option. `seed` and `key` must live
/// as long as `act`.
Action WithSecretKey(CLI::App& command, const std::optional<std::uint64_t>* seed, std::optional<SecretKey>& key,
                     const Action& act);
/// Adds --reuse-key, for commands with --seed-file, which otherwise refuse a key that was used before.
void AddReuseKey(CLI::App& command, bool& reuse_key);
/// Adds -j, --jobs.
CLI::Option* AddJobs(CLI::App& command, int& jobs);
/// Adds --overwrite.
CLI::Option* AddOverwrite(CLI::App& command, bool& overwrite, const std::string& help = "Replace an existing file");
/// The names of the joint-map option, for every command that opens clips.
constexpr const char* kJointMapOption = "--joint-map,--map";
/// AddUnit adds --unit, and AddUp adds --up. The help says "clips" or "files", as stated by `of`. The option's value is
/// added to `clip_facts` as a line of a joint-map file.
CLI::Option* AddUnit(CLI::App& command, const std::string& of, std::string& clip_facts);
CLI::Option* AddUp(CLI::App& command, const std::string& of, std::string& clip_facts);
/// Adds --seed, --trials, --clips, --joint-map, --unit, --up, --rate, --keep-floor and --marker-set, for every command
/// that makes worlds from scenarios. The values of the last five are written to `clip_facts` as lines of a joint-map
/// file. The third element of the result is --clips.
std::array<CLI::Option*, 9> AddWorldOptions(CLI::App& command, std::optional<std::uint64_t>& seed,
                                            std::optional<int>& trials, std::vector<std::string>& clips,
                                            std::string& joint_map, std::string& clip_facts);
/// Adds --unsealed, for every command that reads a run.
void AddUnsealed(CLI::App& command, Sealing& sealing);
/// Adds --no-fence and --allow-exec, for every command that runs external methods.
void AddOutsideRules(CLI::App& command, OutsideRules& rules);

/// Returns a check that an option's text is one of `names`. The help lists all names; the error message about another
/// text suggests the nearest name.
CLI::Validator OneOf(const std::vector<std::string>& names);
/// Returns a function that checks an option's text: that function returns "" for a number from `low` to `high`, else an
/// error message. (CLI::Range would accept NaN.) `kind` names the quantity in error messages: "rate in Hz".
std::function<std::string(const std::string& text)> NumberWithin(double low, double high, const std::string& kind);

}  // namespace etude
