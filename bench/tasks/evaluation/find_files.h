#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>

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

/// Returns the part of `name` that "{person}" stands for in a pattern whose '*' stand for any text: the leftmost, then
/// shortest. Nothing if the name does not match.
std::optional<std::string> PersonIn(std::string_view pattern, std::string_view name);

}  // namespace etude
