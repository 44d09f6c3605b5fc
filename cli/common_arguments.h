#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace etude {

/// --seed; without a value of its own `seed` keeps its default, which the help tells.
CLI::Option* AddSeed(CLI::App& command, std::uint64_t& seed, const std::string& help);
/// The same where the default is somebody else's.
CLI::Option* AddSeed(CLI::App& command, std::optional<std::uint64_t>& seed, const std::string& help);

/// -j, --jobs.
CLI::Option* AddJobs(CLI::App& command, int& jobs);

/// --overwrite.
CLI::Option* AddOverwrite(CLI::App& command, bool& overwrite, const std::string& help = "Replace a file that is there");

}  // namespace etude
