#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reports/words/judged.h"

namespace etude {

/// What a verdict on the worlds that were run speaks of: "these worlds", "these people", "these clips".
std::string_view TheseUnits(SamplingUnit unit);
/// What one beyond them speaks of: "other worlds", "other people", "other clips".
std::string_view OtherUnits(SamplingUnit unit);

/// What comparisons say beyond their worlds, over all conditions.
struct BeyondFinding {
  bool on_these_only = true;       ///< under no condition is there a verdict beyond these worlds
  bool as_on_these = false;        ///< under every condition there is one, the same as on these worlds
  std::optional<Verdict> verdict = {};  ///< that all conditions with a verdict agree in
  std::string words = {};          ///< "for other clips: worse", "on these clips only (4 clips, 6 are needed)"
};
BeyondFinding BeyondInWords(const std::vector<Judged>& judged, SamplingUnit unit);

/// The same of one comparison, in as few words as a table's cell or an XML attribute takes.
std::string ShortBeyond(const Comparison& comparison, SamplingUnit unit);

}  // namespace etude
