#include "reports/pose_pairs.h"

#include <fmt/core.h>

#include <algorithm>
#include <vector>

#include "reports/words/escape.h"
#include "reports/words/figures.h"
#include "reports/words/left_out.h"

namespace etude {
namespace {

constexpr std::string_view kLegend =
    "Apart: the worst joint, once headings and hips are laid onto each other. ✗: called alike, though a joint is more "
    "than 20 cm off. Beside it what the method measured: the fuzzy distance, or centimetres.";

struct PosePair {
  std::string name, gap;
  std::vector<std::string> verdicts;  ///< one per method
};

std::string VerdictOf(const Row& row) {
  const auto alike = ValueOf(row, "called_alike");
  if (!alike) return std::string(kNoValue);
  std::string text = *alike > 0 ? "alike" : "apart";
  // A joint distance where the method has one: the fuzzy distance is told of every pair.
  if (const auto joints = ValueOf(row, "joint_distance_cm")) {
    text += fmt::format(" {} cm", FormatNumber(*joints));
  } else if (const auto d = ValueOf(row, "fuzzy_distance")) {
    text += fmt::format(" {}", FormatFixed(*d, 3));
  }
  const auto is_false = ValueOf(row, "false_smooth");
  return is_false && *is_false > 0 ? "✗ " + text : text;
}

std::vector<PosePair> PairsOf(const RunData& run, const ScenarioSummary& scenario) {
  std::vector<PosePair> pairs;
  // Under a sweep, or with many pairs a world, a pair has no single verdict.
  if (scenario.task != "pose-distance" || scenario.conditions.size() != 1) return pairs;
  for (const Row& row : run.rows) {
    if (row.scenario != scenario.name) continue;
    const auto alike = ValueOf(row, "called_alike");
    if (alike && *alike > 0 && *alike < 1) return {};
    const auto method = std::ranges::find(scenario.methods, row.method);
    if (row.clip.empty() || method == scenario.methods.end()) continue;
    const bool is_first = method == scenario.methods.begin();
    if (is_first && std::ranges::find(pairs, row.clip, &PosePair::name) == pairs.end()) {
      const auto gap = ValueOf(row, "pose_gap_cm");
      pairs.push_back({row.clip, gap ? FormatNumber(*gap) + " cm" : std::string(kNoValue),
                       std::vector<std::string>(scenario.methods.size(), std::string(kNoValue))});
    }
    const auto pair = std::ranges::find(pairs, row.clip, &PosePair::name);
    if (pair == pairs.end()) continue;
    pair->verdicts[static_cast<std::size_t>(method - scenario.methods.begin())] = VerdictOf(row);
  }
  return pairs;
}

}  // namespace

std::string PosePairsHtml(const RunData& run, const ScenarioSummary& scenario) {
  const std::vector<PosePair> pairs = PairsOf(run, scenario);
  if (pairs.empty()) return "";
  std::string html =
      "<details open><summary>Pair by pair</summary><div class=\"scroll\" tabindex=\"0\" role=\"region\" "
      "aria-label=\"Pair by pair\"><table class=\"glance\"><thead><tr><th scope=\"col\">Poses</th>"
      "<th scope=\"col\" class=\"n\">Apart</th>";
  for (const std::string& method : scenario.methods) {
    html += fmt::format("<th scope=\"col\" class=\"n\">{}</th>", EscapeMarkup(method));
  }
  html += "</tr></thead><tbody>";
  for (std::size_t i = 0; i < std::min(pairs.size(), kMostListed); ++i) {
    html +=
        fmt::format("<tr><th scope=\"row\">{}</th><td class=\"n\">{}</td>", EscapeMarkup(pairs[i].name), pairs[i].gap);
    for (const std::string& verdict : pairs[i].verdicts) html += fmt::format("<td class=\"n\">{}</td>", verdict);
    html += "</tr>";
  }
  return html + "</tbody></table></div>" + LeftOutHtml(pairs.size(), kMostListed, "pairs", "cells.jsonl") +
         fmt::format("<p class=\"quiet legend\">{}</p></details>", kLegend);
}

std::string PosePairsMarkdown(const RunData& run, const ScenarioSummary& scenario) {
  const std::vector<PosePair> pairs = PairsOf(run, scenario);
  if (pairs.empty()) return "";
  std::string head = "| poses | apart |", rule = "|---|--:|";
  for (const std::string& method : scenario.methods) {
    head += fmt::format(" {} |", EscapeMarkdown(method));
    rule += "--:|";
  }
  std::string text = fmt::format("\n{}\n{}\n", head, rule);
  for (std::size_t i = 0; i < std::min(pairs.size(), kMostListed); ++i) {
    text += fmt::format("| {} | {} |", EscapeMarkdown(pairs[i].name), pairs[i].gap);
    for (const std::string& verdict : pairs[i].verdicts) text += fmt::format(" {} |", verdict);
    text += '\n';
  }
  const std::string rest = LeftOutWords(pairs.size(), kMostListed, "pairs", "cells.jsonl");
  return fmt::format("{}\n{}{}{}\n", text, rest, rest.empty() ? "" : " ", kLegend);
}

}  // namespace etude
