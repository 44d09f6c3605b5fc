#include "cli/pair_notes.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string_view>

#include "bench/model/reasons.h"
#include "bench/results/folder.h"
#include "bench/results/row_json.h"
#include "cli/commands.h"
#include "io/files/json.h"

namespace etude {

void NoteKinds::Add(const std::string& method, const std::string& head, const std::string& reason) {
  const auto [place, is_new] = places_.emplace(method + ": " + KindOfReason(reason), kinds_.size());
  if (is_new) kinds_.emplace_back(head + ": " + reason, 0);
  ++kinds_[place->second].second;
}

std::vector<std::string> NoteKinds::Lines() const {
  std::vector<std::string> lines;
  for (const auto& [line, count] : kinds_) {
    lines.push_back(count == 1 ? line : fmt::format("{} (and {} similar)", line, count - 1));
  }
  return lines;
}

void DoubtList::Add(const Row& row) {
  for (const std::string& doubt : DoubtsIn(row.result.reason)) {
    const bool is_of_truth = doubt.starts_with(kDoubtedTruth);
    const std::string head = is_of_truth ? row.clip : fmt::format("{}, {}", row.method, row.clip);
    std::string line = head + ": " + doubt;
    if (!known_.insert(line).second) continue;
    kinds_.Add(is_of_truth ? "" : row.method, head, doubt);
    lines_.push_back(std::move(line));
  }
}

void DoubtList::Tell() const {
  for (const std::string& line : FirstLines(kinds_.Lines(), 20, "other kinds of doubts; see `etude rows`"))
    fmt::print(stderr, "{}\n", line);
}

DoubtList DoubtsOf(const RunData& run) {
  DoubtList doubts;
  ForEachRow(run, [&](const Row& row, std::size_t) { doubts.Add(row); });
  return doubts;
}

Result<PairNotes> ReadPairNotes(const std::filesystem::path& folder) {
  PairNotes notes;
  RETURN_IF_ERROR(WriteRows(folder, Sealing::kRequired, [&](std::string_view text) -> Result<void> {
    ASSIGN_OR_RETURN(const auto json, ReadJson(std::string(text), folder.string()));
    ASSIGN_OR_RETURN(const auto row, DecodeRow(json, {folder.string()}));
    const std::string under = row.condition.empty() ? "" : ", " + ConditionLabel(row.condition);
    const std::string head = fmt::format("{}, {}{}", row.method, row.clip, under);
    const bool is_judged = row.result.status == Status::kOk;
    (is_judged ? notes.judged : notes.not_judged)
        .Add(row.method + under, head, std::string(WithoutDoubts(row.result.reason)));
    notes.doubts.Add(row);
    if (!is_judged) notes.every_not_judged.push_back(fmt::format("{}: {}", head, WithoutDoubts(row.result.reason)));
    return {};
  }));
  return notes;
}

void PrintPairNotes(const PairNotes& notes) {
  const auto print = [](const NoteKinds& kinds) {
    for (const std::string& line :
         FirstLines(kinds.Lines(), 10, "other notes; `etude rows` prints all cells with their notes"))
      fmt::print("  {}\n", line);
  };
  print(notes.judged);
  if (!notes.every_not_judged.empty()) fmt::print("{} not judged:\n", notes.every_not_judged.size());
  print(notes.not_judged);
}

}  // namespace etude
