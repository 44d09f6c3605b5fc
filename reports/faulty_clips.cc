#include "reports/faulty_clips.h"

#include <fmt/format.h>

#include "io/drawing/escape.h"
#include "io/drawing/numbers.h"
#include "io/drawing/table.h"
#include "reports/words/figures.h"

namespace etude {
namespace {

constexpr std::string_view kTask = "plausibility", kWithin = "within_limits";

/// The clips that show faults, and the clips whose answers could not be judged.
struct FaultyClips {
  Table table;  ///< clips that exceed their fault limits come first, clips that could not be judged last
  /// Says how many clips have no fault and how many could not be judged; empty if the run judged no clips.
  std::string sentence;
  std::size_t rows = 0;  ///< number of clips to list; `table` may show only the first ones
};

/// Collects the faulty clips of a run; the table has at most `most` rows.
FaultyClips FaultyClipsOf(const RunData& run, std::size_t most) {
  FaultyClips found;
  std::vector<TableRow> beyond, others, unjudged;
  std::size_t judged = 0;
  // Sort the clips into clips that exceed their fault limits, other faulty clips, and clips that could not be judged.
  ForEachRow(run, [&](const Row& row, std::size_t) {
    if (row.task != kTask || row.result.status == Status::kSkipped) return;
    if (row.result.status != Status::kOk) {
      unjudged.push_back({.cells = {row.clip, row.method, std::string(kNoValue), "not judged", row.result.reason}});
      return;
    }
    ++judged;
    const auto faults = ValueOf(row, "faults").value_or(0);
    const bool is_beyond = ValueOf(row, kWithin) == 0.0;
    if (faults == 0 && !is_beyond) return;
    TableRow line{
        .cells = {
            row.clip, row.method, {fmt::format("{:g}", faults), faults}, is_beyond ? "beyond" : "", row.result.reason}};
    (is_beyond ? beyond : others).push_back(std::move(line));
  });
  if (judged + unjudged.size() == 0) return found;
  // Write a sentence that counts the clips of each kind.
  found.rows = beyond.size() + others.size() + unjudged.size();
  const auto count = [&](std::size_t clips, std::string_view how) {
    if (clips > 0) found.sentence += fmt::format(", {} {}", clips, how);
  };
  found.sentence = fmt::format("{} of {} without a fault", judged - beyond.size() - others.size(),
                               Plural(static_cast<long long>(judged), "clip"));
  count(beyond.size(), "beyond the limits");
  count(unjudged.size(), "more could not be judged");
  found.sentence += ". The command “etude list faults” explains each fault.";
  // Write the table with at most `most` rows.
  found.table = {.label = "Clips with faults",
                 .columns = {{.head = "Clip", .is_row_head = true},
                             {"Method"},
                             {.head = "Faults", .is_number = true, .is_sortable = true},
                             {"Limits"},
                             {"Fault, time and file"}}};
  for (std::vector<TableRow>* rows : {&beyond, &others, &unjudged}) {
    for (TableRow& row : *rows) {
      if (found.table.rows.size() < most) found.table.rows.push_back(std::move(row));
    }
  }
  return found;
}

}  // namespace

std::string FaultyClipsSection(const RunData& run) {
  const FaultyClips found = FaultyClipsOf(run, kMaxTableRows);
  if (found.sentence.empty()) return "";
  std::string html =
      fmt::format("<section class=\"card\" id=\"faults\"><h2>Clips with faults</h2><p>{}</p>", found.sentence);
  if (found.rows > 0) html += TableHtml(found.table) + LeftOutHtml(found.rows, kMaxTableRows, "clips", "cells.jsonl");
  return html + "</section>\n";
}

std::string FaultyClipsMarkdown(const RunData& run) {
  const FaultyClips found = FaultyClipsOf(run, kMaxListed);
  if (found.sentence.empty()) return "";
  std::string text = fmt::format("\n## Clips with faults\n\n{}\n", found.sentence);
  if (found.rows > 0) text += "\n" + TableMarkdown(found.table);
  const std::string rest = LeftOutWords(found.rows, kMaxListed, "clips", "cells.jsonl");
  return rest.empty() ? text : text + fmt::format("\n{}\n", EscapeMarkdown(rest));
}

std::vector<JunitCase> ClipCases(const RunData& run, const std::string& scenario) {
  std::vector<JunitCase> cases;
  ForEachRow(run, [&](const Row& row, std::size_t) {
    if (row.scenario != scenario || row.task != kTask || row.result.status == Status::kSkipped) return;
    const bool is_met = row.result.status == Status::kOk && ValueOf(row, kWithin) != 0.0;
    const bool has_faults = ValueOf(row, "faults").value_or(0) > 0;
    cases.push_back({fmt::format("{}, {}", row.method, row.clip), is_met ? ClaimOutcome::kMet : ClaimOutcome::kUnmet,
                     row.result.reason, is_met && has_faults ? row.result.reason : ""});
  });
  return cases;
}

}  // namespace etude
