#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/settings.h"

namespace etude {

/// The verdict on a window.
enum class WindowVerdict {
  kRight,
  kWrong,
  kUnknown,  ///< the player was not seen, or the one who knows did not say
};

/// The coach's memory of one move, or of all of them.
struct MoveMemory {
  int judged = 0;           ///< windows that came to right or wrong
  int mistakes = 0;         ///< of them wrong
  int mistakes_in_row = 0;  ///< since the last right one
  int corrections = 0;      ///< given
};

/// The facts that a policy decides by, once a window has closed.
struct PolicyInput {
  WindowVerdict verdict = WindowVerdict::kUnknown;
  double evidence = 0;    ///< Evidence::asked at the window's end
  double right_from = 0;  ///< from which evidence on a performance counts as right, > 0
  MoveMemory move;        ///< of the move asked for, this window included
};

struct PolicyDecision {
  bool corrects = false;
  std::string why;  ///< one sentence with numbers
};

/// A rule for when the coach interrupts, by its name in scenario files. All policies are pure functions.
struct Policy {
  std::string name;
  std::string description;     ///< one line, for people
  bool asks_truth = false;     ///< the verdict is CoachInput::told_right, not the recogniser's
  bool takes_moments = false;  ///< it corrects at CoachInput::moment and at no other time
  std::vector<NumberSetting> settings = {};
  /// `values`: one per setting, in their order; none at all: the defaults.
  PolicyDecision (*decide)(const PolicyInput& input, std::span<const double> values) = nullptr;
};

/// Lists all policies, paper A's first: at-first-mistake, never, after-n, confidence, fading, oracle, yoked.
std::span<const Policy> AllPolicies();
std::vector<std::string> PolicyNames();
/// Lists the policies that need neither the truth nor another session, and so can coach real people.
std::vector<std::string> LivePolicyNames();
/// Returns the policy of that name, null when there is none.
const Policy* FindPolicy(std::string_view name);

}  // namespace etude
