#include "bench/dataset/layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace etude {
namespace {

constexpr std::size_t kLongestName = 120;  // bytes; file systems take 255

bool IsPlain(char c) {
  const bool is_letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
  return is_letter || (c >= '0' && c <= '9') || std::string_view("._=,+-").find(c) != std::string_view::npos;
}

}  // namespace

std::vector<std::string> ConditionFolders(const Scenario& scenario) {
  std::vector<std::string> folders;
  for (const Condition& condition : scenario.conditions) {
    std::string name = condition.swept.empty() ? "all" : CompactLabel(condition.swept).substr(0, kLongestName);
    std::replace_if(
        name.begin(), name.end(), [](char c) { return !IsPlain(c); }, '_');
    std::string unique = name;
    for (int copy = 2; std::find(folders.begin(), folders.end(), unique) != folders.end(); ++copy) {
      unique = fmt::format("{}~{}", name, copy);
    }
    folders.push_back(std::move(unique));
  }
  return folders;
}

std::string TrialName(int trial) { return fmt::format("{:03}", trial); }

}  // namespace etude
