#include "reports/faulty_clips.h"

#include <fmt/format.h>

#include <algorithm>

#include "io/drawing/numbers.h"
#include "io/drawing/table.h"
#include "reports/words/figures.h"

namespace etude {
namespace {

constexpr std::string_view kTask = "plausibility", kWithin = "within_limits";

}  // namespace

std::string FaultyClipsSection(const RunData& run) {
  // Collect the clips with faults.
  std::vector<TableRow> beyond, others;
  std::size_t judged = 0;
  ForEachRow(run, [&](const Row& row, std::size_t) {
    if (row.task != kTask || row.result.status != Status::kOk) return;
    ++judged;
    const auto faults = ValueOf(row, "faults").value_or(0);
    const bool is_beyond = ValueOf(row, kWithin) == 0.0;
    if (faults == 0 && !is_beyond) return;
    TableRow line{
        .cells = {
            row.clip, row.method, {fmt::format("{:g}", faults), faults}, is_beyond ? "beyond" : "", row.result.reason}};
    (is_beyond ? beyond : others).push_back(std::move(line));
  });
  if (judged == 0) return "";
  // Write the table.
  const std::size_t all = beyond.size() + others.size();
  std::string html = fmt::format(
      "<section class=\"card\" id=\"faults\"><h2>Clips with faults</h2><p>{} of {} show what no person does{}.</p>",
      all, Plural(static_cast<long long>(judged), "clip"),
      beyond.empty() ? "" : fmt::format("; {} exceed their limits", beyond.size()));
  Table table{.label = "Clips with faults",
              .columns = {{.head = "Clip", .is_row_head = true},
                          {"Method"},
                          {.head = "Faults", .is_number = true, .is_sortable = true},
                          {"Limits"},
                          {"What, when, and in which file"}}};
  for (std::vector<TableRow>* rows : {&beyond, &others}) {
    for (TableRow& row : *rows) {
      if (table.rows.size() < kMaxTableRows) table.rows.push_back(std::move(row));
    }
  }
  if (all > 0) html += TableHtml(table) + LeftOutHtml(all, kMaxTableRows, "clips", "cells.jsonl");
  return html + "</section>\n";
}

std::vector<JunitCase> LimitCases(const RunData& run, const std::string& scenario) {
  std::vector<JunitCase> cases;
  for (const Row& row : run.rows) {
    const auto is_within = row.scenario == scenario ? ValueOf(row, kWithin) : std::nullopt;
    if (!is_within || row.task != kTask) continue;
    cases.push_back({fmt::format("{}, {}", row.method, row.clip),
                     *is_within > 0 ? ClaimOutcome::kMet : ClaimOutcome::kUnmet, row.result.reason});
  }
  return cases;
}

}  // namespace etude
