#include "engine/motion/side_names.h"

#include <array>
#include <vector>

namespace etude {
namespace {

struct Turn {
  std::string_view from, to;
};
// Long ones first: what begins with "left" also begins with "l".
constexpr std::array<Turn, 10> kTurns = {{
    {"left", "right"},
    {"Left", "Right"},
    {"LEFT", "RIGHT"},
    {"right", "left"},
    {"Right", "Left"},
    {"RIGHT", "LEFT"},
    {"l", "r"},
    {"L", "R"},
    {"r", "l"},
    {"R", "L"},
}};

bool IsLower(char c) { return c >= 'a' && c <= 'z'; }
bool IsUpper(char c) { return c >= 'A' && c <= 'Z'; }
bool IsLetter(char c) { return IsLower(c) || IsUpper(c); }
bool IsDigit(char c) { return c >= '0' && c <= '9'; }

/// Behind the namespace: "mixamorig:LeftArm".
std::size_t StartOfName(std::string_view name) { return name.find_last_of(':') + 1; }

/// Behind the word that begins at `at`: "Left|Arm", "l|Shldr", "L|Thigh", "upper|_arm".
std::size_t EndOfWord(std::string_view name, std::size_t at) {
  std::size_t end = at + 1;
  for (; end < name.size() && IsLetter(name[end]); ++end) {
    const bool capital_after_small = IsLower(name[end - 1]) && IsUpper(name[end]);
    const bool last_of_capitals =
        IsUpper(name[end - 1]) && IsUpper(name[end]) && end + 1 < name.size() && IsLower(name[end + 1]);
    if (capital_after_small || last_of_capitals) break;
  }
  return end;
}

std::string Replaced(std::string_view name, std::size_t at, const Turn& turn) {
  return std::string(name.substr(0, at)).append(turn.to).append(name.substr(at + turn.from.size()));
}

/// The other side's names of a joint whose own may begin with a side, most likely first.
std::vector<std::string> IfGlued(std::string_view name) {
  std::vector<std::string> others;
  const std::size_t start = StartOfName(name);
  for (const Turn& turn : kTurns) {
    if (name.substr(start).starts_with(turn.from)) others.push_back(Replaced(name, start, turn));
  }
  return others;
}

}  // namespace

std::string OtherSide(std::string_view name) {
  for (std::size_t at = StartOfName(name); at < name.size();) {
    if (!IsLetter(name[at])) {
      ++at;
      continue;
    }
    const std::size_t end = EndOfWord(name, at);
    const std::string_view word = name.substr(at, end - at);
    const bool is_numbered = word.size() == 1 && end < name.size() && IsDigit(name[end]);  // "L5"
    for (const Turn& turn : kTurns) {
      if (word == turn.from && !is_numbered) return Replaced(name, at, turn);
    }
    at = end;
  }
  return std::string(name);
}

Skeleton WithSidesSwapped(Skeleton skeleton) {
  std::vector<std::string> names;
  for (const Joint& joint : skeleton.joints) {
    std::string& name = names.emplace_back(OtherSide(joint.name));
    if (name != joint.name) continue;
    for (std::string& other : IfGlued(joint.name)) {
      if (skeleton.Find(other) < 0) continue;
      name = std::move(other);
      break;
    }
  }
  for (std::size_t i = 0; i < names.size(); ++i) skeleton.joints[i].name = std::move(names[i]);
  return skeleton;
}

}  // namespace etude
