#include "cli/move_table.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>

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

/// Returns the number of characters, not bytes: continuation bytes of UTF-8 do not count.
std::size_t WidthOf(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
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
    for (std::size_t c = 0; c < kMoveColumns; ++c) widths[c] = std::max(widths[c], WidthOf(line[c]));
  }
  for (const Line& line : lines) {
    std::string text = " ";
    for (std::size_t c = 0; c < kMoveColumns; ++c)
      text += " " + line[c] + std::string(widths[c] - WidthOf(line[c]) + 1, ' ');
    fmt::print("{}\n", text.substr(0, text.find_last_not_of(' ') + 1));
  }
  if (rows.size() > max_rows) fmt::print("  … and {} more\n", rows.size() - max_rows);
}

void PrintVersions(const std::string& before, const std::string& before_version, const std::string& after,
                   const std::string& after_version) {
  if (before_version == ETUDE_VERSION && after_version == ETUDE_VERSION) return;
  fmt::print("Versions of Etude differ: {} was made by {}, {} by {}; this is Etude {}\n", before, before_version,
             after, after_version, ETUDE_VERSION);
}

}  // namespace etude
