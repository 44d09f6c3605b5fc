#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/settings.h"

namespace etude {

/// The verdict on the performance in a window, which is the time in which the player is judged.
enum class WindowVerdict {
  kRight,
  kWrong,
  kUnknown,  ///< the player was not seen, or the oracle's truth is missing
};

/// The coach's memory of the player's performances of one move, or of all moves.
struct MoveMemory {
  int judged = 0;           ///< number of windows with a verdict of right or wrong
  int mistakes = 0;         ///< number of windows with the verdict wrong
  int mistakes_in_row = 0;  ///< number of consecutive wrong windows since the last right one
  int corrections = 0;
};

/// The input of a policy when a window has closed.
struct PolicyInput {
  WindowVerdict verdict = WindowVerdict::kUnknown;
  double evidence = 0;    ///< Evidence::asked at the window's end
  double right_from = 0;  ///< the evidence at which a performance counts as right, > 0
  MoveMemory move;        ///< the memory of the requested move, including this window
};

struct PolicyDecision {
  bool corrects = false;
  std::string why;  ///< reason for the decision: one sentence with numbers
};

/// A rule that decides when the coach interrupts, with its name in scenario files. A policy is a pure function.
struct Policy {
  std::string name;
  std::string description;     ///< one line for users
  bool asks_truth = false;     ///< true if the verdict comes from CoachInput::told_right instead of the recogniser
  bool takes_moments = false;  ///< true if the policy corrects only when CoachInput::moment is set
  std::vector<NumberSetting> settings = {};
  /// Decides after a window has closed. `values` has one value per setting, in order; if empty, the defaults apply.
  PolicyDecision (*decide)(const PolicyInput& input, std::span<const double> values) = nullptr;
};

/// Returns all policies, paper A's first: at-first-mistake, never, after-n, confidence, fading, oracle, yoked.
std::span<const Policy> AllPolicies();
std::vector<std::string> PolicyNames();
/// Returns the names of the policies that need neither the truth nor another session, so that they can coach real
/// people.
std::vector<std::string> LivePolicyNames();
/// Returns the policy called `name`, or null if there is none.
const Policy* FindPolicy(std::string_view name);

}  // namespace etude
