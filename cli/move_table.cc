#include "cli/move_table.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/facts.h"
#include "reports/gate_table.h"

namespace etude {
namespace {

constexpr std::size_t kMoveColumns = 9;
using Line = std::array<std::string, kMoveColumns>;

Line LineOf(const GateTableRow& row) {
  return {row.verdict,    row.scenario + (row.condition == "-" ? "" : " " + row.condition),
          row.method,     row.metric,
          row.before,     row.after,
          row.difference, row.p,
          row.worlds};
}

}  // namespace

void PrintMoves(const SnapshotComparison& comparison, const std::string& before, const std::string& after,
                std::size_t max_rows) {
  const std::vector<GateTableRow> rows = MovedRows(comparison);
  if (rows.empty()) return;
  std::vector<Line> lines = {{"", "", "method", "metric", before, after, "difference (95 %)", "p (Holm)", "in worlds"}};
  for (std::size_t i = 0; i < std::min(max_rows, rows.size()); ++i) lines.push_back(LineOf(rows[i]));
  std::array<std::size_t, kMoveColumns> widths{};
  for (const Line& line : lines) {
    for (std::size_t c = 0; c < kMoveColumns; ++c) widths[c] = std::max(widths[c], CountCharacters(line[c]));
  }
  for (const Line& line : lines) {
    std::string text = " ";
    for (std::size_t c = 0; c < kMoveColumns; ++c)
      text += " " + line[c] + std::string(widths[c] - CountCharacters(line[c]) + 1, ' ');
    fmt::print("{}\n", text.substr(0, text.find_last_not_of(' ') + 1));
  }
  if (rows.size() > max_rows) fmt::print("  … and {} more\n", rows.size() - max_rows);
}

Json FactsOf(const SnapshotComparison& comparison) {
  Json moves = Json::array();
  for (const MetricMove& move : comparison.moves) {
    if (move.movement == Movement::kSame) continue;
    moves.push_back({{"scenario", move.identity.scenario},
                     {"condition", move.identity.condition},
                     {"method", move.identity.method},
                     {"metric", move.identity.metric},
                     {"movement", MovementWords(move.movement)},
                     {"before", OrNull(move.before)},
                     {"after", OrNull(move.after)},
                     {"worlds", move.worlds},
                     {"differing", move.differing},
                     {"far_worse", move.tail.size()}});
    if (!move.comparison.not_alike.empty()) moves.back()["not_alike"] = move.comparison.not_alike;
  }
  return {{"comparisons", comparison.moves.size()},
          {"moves", std::move(moves)},
          {"only_before", comparison.only_before},
          {"only_after", comparison.only_after},
          {"settings_changed", comparison.settings_changed}};
}

void PrintVersions(const std::string& before, const std::string& before_version, const std::string& after,
                   const std::string& after_version) {
  if (before_version == ETUDE_VERSION && after_version == ETUDE_VERSION) return;
  fmt::print("Versions of Etude differ: {} was made by {}, {} by {}; this is Etude {}\n", before, before_version,
             after, after_version, ETUDE_VERSION);
}

}  // namespace etude
