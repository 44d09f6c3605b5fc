#include "cli/named_results.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "bench/scenario/methods.h"
#include "engine/base/names.h"
#include "engine/retargeting/map_file.h"

namespace etude {
namespace {

/// Returns a plain name for a pattern: the name of the pattern's folder if the pattern has wildcards, else the name of
/// the file.
std::string NameFor(const std::string& pattern) {
  const std::filesystem::path path = pattern.ends_with('/') ? pattern.substr(0, pattern.size() - 1) : pattern;
  const bool is_pattern = path.filename().string().find_first_of("*?[") != std::string::npos;
  std::string name = (is_pattern ? path.parent_path().filename() : path.stem()).string();
  std::ranges::replace_if(
      name, [](char c) { return !IsPlainName(std::string(1, c)) && c != '-' && c != '.'; }, '_');
  return IsPlainName(name) ? name : "result";
}

/// Reads an argument NAME=PATTERN; returns nullopt if the argument has no name.
std::optional<NamedResult> ReadNamed(const std::string& argument) {
  const std::size_t equals = argument.find('=');
  std::error_code none;
  const bool is_named = equals != std::string::npos && IsPlainName(argument.substr(0, equals)) &&
                        !std::filesystem::exists(argument, none);
  if (!is_named) return std::nullopt;
  return NamedResult{argument.substr(0, equals), {argument.substr(equals + 1)}};
}

tl::unexpected<Error> NeedsName(const std::string& argument) {
  return Fail(
      {}, "{} has no name; allowed if there are several results: NAME=PATTERN, in quotes if the pattern contains '*'",
      Quote(argument));
}

}  // namespace

Result<std::vector<NamedResult>> ReadResults(std::span<const std::string> arguments) {
  std::vector<NamedResult> results;
  for (const std::string& argument : arguments) {
    auto named = ReadNamed(argument);
    if (!named && arguments.size() > 1) return NeedsName(argument);
    results.push_back(named ? std::move(*named) : NamedResult{NameFor(argument), {argument}});
  }
  return results;
}

Result<std::vector<NamedResult>> ReadMotions(std::span<const std::string> arguments) {
  if (arguments.empty()) return Fail({}, "`etude evaluate --alone` needs motions: files, folders or patterns");
  std::vector<NamedResult> named;
  NamedResult unnamed{arguments.size() == 1 ? NameFor(arguments.front()) : "motions", {}};
  for (const std::string& argument : arguments) {
    if (auto one = ReadNamed(argument)) {
      named.push_back(std::move(*one));
    } else {
      unnamed.patterns.push_back(argument);
    }
  }
  if (named.empty()) return std::vector{unnamed};
  if (!unnamed.patterns.empty()) return NeedsName(unnamed.patterns.front());
  return named;
}

std::string MethodsInYaml(std::span<const NamedResult> results) {
  std::string text = "methods:\n";
  for (const NamedResult& result : results) {
    std::vector<std::string> quoted;
    for (const std::string& pattern : result.patterns) quoted.push_back(QuotedInYaml(pattern));
    text += fmt::format("  - {{name: {}{}}}\n", QuotedInYaml(result.name),
                        quoted.empty() ? "" : fmt::format(", answers: [{}]", Join(quoted)));
  }
  return text;
}

}  // namespace etude
