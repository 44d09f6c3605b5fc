#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/tasks/base/task.h"

namespace etude {

/// The maximum number of pairs of one scenario.
constexpr std::size_t kMaxPairs = 100'000;

/// TaskKind::find_files of task evaluation. A folder stands for the motion files in it, by their names' extensions.
/// Pairs are those of a CSV, or else a truth with the answers whose file names are its own but for the extension; if
/// there is one truth and one answer of each method, they are a pair whatever their names. Pairs are sorted by name.
/// Fails if two truths, or two answers of a method, have one name; if a method has no answer for any truth; for more
/// than kMaxPairs; for a CSV that is none; and for answers that are links, unless each is named. An answer without
/// truth is left out.
Result<FoundFiles> FindEvaluatedFiles(const Node& condition, std::span<const Node> methods,
                                      const std::map<std::string, std::string>& texts);

/// Says what happens to links among the files that a folder or a pattern stands for.
enum class Links { kAllowed, kRefused };

/// Lists the files that references stand for, in their order; a folder stands for the motion files in it, a BIDS data
/// set for the recordings of all people. Fails at `place` if one stands for none, for more than kMaxPairs, or for a
/// link that is refused.
Result<std::vector<std::string>> ExpandFiles(const std::vector<std::string>& references, Links links,
                                             const Place& place);

/// Splits a line at its commas. A carriage return at its end is dropped.
std::vector<std::string> SplitAtCommas(std::string_view line);

/// Returns the name of a reference: its file's without folder and extension, and the clip behind '#'. A Motion-BIDS
/// recording's is without its tracking system, so that truth and answers have one name.
std::string NameOfReference(const std::string& reference);

/// Sets the unit of each world to the person in its name (PersonIn); `people` must not be empty. Fails at `place` for a
/// name without one.
Result<void> FindPeople(const std::string& people, const Place& place, std::vector<JudgedFiles>& worlds);

/// Returns the part of `name` that "{person}" stands for in a pattern whose '*' stand for any text: the leftmost, then
/// shortest. Nothing if the name does not match.
std::optional<std::string> PersonIn(std::string_view pattern, std::string_view name);

}  // namespace etude
