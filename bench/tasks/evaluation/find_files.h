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

/// Finds the pairs of files of task evaluation (TaskKind::find_files), sorted by name. A folder stands for the motion
/// files in it, recognised by their extensions. The pairs are those of the CSV file that the condition names (`pairs`).
/// Without a CSV file, a truth and an answer are a pair if their file names are equal apart from the extension; if
/// the condition names a single truth and a method a single answer, by their files' own names, they are a pair whatever
/// these names. An answer without a
/// truth is left out. Fails if two truths, or two answers of a method, have the same name; if a method has no answer
/// for any truth; if there are more than kMaxPairs pairs; if the CSV file is invalid; and if an answer is a link that
/// the scenario does not name itself.
Result<FoundFiles> FindEvaluatedFiles(const Node& condition, std::span<const Node> methods,
                                      const std::map<std::string, std::string>& texts);

/// The treatment of links among the files that a folder or a pattern stands for.
enum class Links { kAllowed, kRefused };

/// Lists the files that references stand for, in the order of the references. A folder stands for the motion files in
/// it, a BIDS data set for the recordings of all people. Folders in a folder are not searched; those with motion files
/// are added to `left_out`. Fails at `place` if a reference stands for no file or for more
/// than kMaxPairs files, or if a file is a link and links are refused.
Result<std::vector<std::string>> ExpandFiles(const std::vector<std::string>& references, Links links,
                                             const Place& place, std::vector<LeftOutFile>& left_out);

/// Returns the name of a reference: its file name without folder and extension, with the clip after '#'. The name of a
/// Motion-BIDS recording leaves out the tracking system, so that truth and answers have the same name.
std::string NameOfReference(const std::string& reference);

/// Sets the unit of each world to the person in its name (PersonIn). Names that differ only in case (A–Z) or spaces are
/// one person, by the first name's spelling. `people` must not be empty. Fails at `place` if a
/// name contains no person.
Result<void> FindPeople(const std::string& people, const Place& place, std::vector<JudgedFiles>& worlds);

/// Returns the part of `name` for which "{person}" stands in a pattern, where '*' stands for any text. If several parts
/// are possible, returns the leftmost and, among these, the shortest. Returns nothing if the name does not match.
std::optional<std::string> PersonIn(std::string_view pattern, std::string_view name);

}  // namespace etude
