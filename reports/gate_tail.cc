#include "reports/gate_tail.h"

#include <fmt/core.h>

#include "bench/model/row.h"
#include "reports/gate_table.h"
#include "reports/words/figures.h"

namespace etude {
namespace {

constexpr const char* kTo = " → ";

/// A word of a command line, in quotes when a shell would take it apart.
std::string ShellWord(const std::string& text) {
  constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./=,:@%+-";
  if (!text.empty() && text.find_first_not_of(kPlain) == std::string::npos) return text;
  std::string quoted = "'";
  for (char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string ValuesText(const TailWorld& world, const std::string& metric) {
  const std::string ended_before(StatusName(StatusOf(world.ended_before)));
  const std::string ended_after(StatusName(StatusOf(world.ended_after)));
  if (metric == kOkShare) return ended_before + kTo + ended_after;
  const MetricWords words = GateWordsFor(metric);
  const std::string before = FormatValue(world.before, words), after = FormatValue(world.after, words);
  if (!world.after) return fmt::format("{}{}no value ({})", before, kTo, ended_after);
  if (before != after) return before + kTo + after;
  return fmt::format("{}{}{}", *world.before, kTo, *world.after);  // far apart only beside what matters
}

}  // namespace

std::vector<TailLine> TailLines(const MetricMove& move, const std::string& run_folder, std::size_t most) {
  const MoveIdentity& identity = move.identity;
  const std::string folder = run_folder.empty() ? "RUN" : ShellWord(run_folder);
  const std::string about = identity.scenario + (identity.condition == "-" ? "" : ", " + identity.condition);
  const std::string label = GateWordsFor(identity.metric).label;
  std::vector<TailLine> lines;
  for (std::size_t i = 0; i < std::min(most, move.tail.size()); ++i) {
    const TailWorld& world = move.tail[i];
    const std::string cell =
        fmt::format("{}/{}/{:03}/{}", identity.scenario, identity.condition, world.trial, identity.method);
    lines.push_back({fmt::format("{}, trial {}, {}: {} {}", about, world.trial, identity.method, label,
                                 ValuesText(world, identity.metric)),
                     fmt::format("etude replay {} --cell {}", folder, ShellWord(cell))});
  }
  if (move.tail.size() > most) {
    lines.push_back(
        {fmt::format("… and {} of {}, {}, {}", Plural(std::ssize(move.tail) - std::ssize(lines), "more world"), about,
                     identity.method, label),
         ""});
  }
  return lines;
}

std::vector<TailLine> TailLines(const GateReport& report, bool failing, std::size_t most_each, std::size_t most) {
  std::vector<TailLine> lines;
  long long left_out = 0;
  for (const MetricMove& move : report.comparison.moves) {
    if (move.tail.empty() || IsRegression(move) != failing) continue;
    if (lines.size() >= most) {
      left_out += std::ssize(move.tail);
      continue;
    }
    for (TailLine& line : TailLines(move, report.run_folder, most_each)) lines.push_back(std::move(line));
  }
  if (left_out > 0) lines.push_back({fmt::format("… and {} of other comparisons", Plural(left_out, "more world")), ""});
  return lines;
}

}  // namespace etude
