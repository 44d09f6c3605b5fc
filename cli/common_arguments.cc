#include "cli/common_arguments.h"

#include <CLI/CLI.hpp>

namespace etude {
namespace {

/// Whole numbers up to 2^53 are exact wherever JSON is read.
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

CLI::Option* AddJobs(CLI::App& command, int& jobs) {
  return command.add_option("-j,--jobs", jobs, "Worker processes (default: one per processor)")
      ->check(CLI::Range(1, 1024));
}

CLI::Option* AddOverwrite(CLI::App& command, bool& overwrite, const std::string& help) {
  return command.add_flag("--overwrite", overwrite, help);
}

}  // namespace etude
