#include <fmt/core.h>

#include <algorithm>
#include <set>

#include "engine/base/names.h"
#include "io/drawing/escape.h"
#include "reports/plots/verdicts.h"
#include "reports/words/answer.h"
#include "reports/words/figures.h"
#include "reports/words/judged.h"

namespace etude {
namespace {

constexpr std::size_t kMaxTabled = 1;
constexpr std::size_t kMaxMethods = 16;
constexpr std::size_t kMaxSessions = 5;
// Maximum number of moves per confusion table, which has a cell for each pair of moves.
constexpr std::size_t kMaxMoves = 60;

using Verdicts = std::map<std::size_t, MethodVerdicts>;

std::string Framed(const std::string& caption, const std::string& head, const std::string& body) {
  return fmt::format(
      "<figure><figcaption>{}</figcaption><div class=\"scroll\" tabindex=\"0\"><table class=\"verdict-table\"><thead>"
      "<tr>{}</tr></thead><tbody>{}</tbody></table></div></figure>",
      EscapeMarkup(caption), head, body);
}

std::string Head(const std::string& text, bool is_number = true) {
  return fmt::format("<th scope=\"col\"{}>{}</th>", is_number ? " class=\"n\"" : "", EscapeMarkup(text));
}

std::string ShareText(const FaultCount& count) {
  return count.all == 0 ? std::string(kNoValue) : fmt::format("{:.0f}", 100.0 * count.found / count.all);
}

std::string FaultTable(const ScenarioSummary& scenario, const std::string& prefix, const Verdicts& verdicts) {
  std::map<std::string, std::map<std::size_t, std::pair<FaultCount, FaultCount>>> by_fault;
  std::string head = Head("fault", false) + Head("performances");
  for (const auto& [method, of_method] : verdicts) {
    for (const auto& [fault, counts] : FoundByFault(of_method.performances)) by_fault[fault][method] = counts;
    head += Head(scenario.methods[method]);
  }
  if (by_fault.empty()) return "";
  std::string body;
  for (const auto& [fault, of_methods] : by_fault) {
    const auto& [slight, bad] = of_methods.begin()->second;
    body += fmt::format("<tr><th scope=\"row\">{}</th><td class=\"n\">{} · {}</td>", EscapeMarkup(WithSpaces(fault)),
                        slight.all, bad.all);
    for (const auto& [method, of_method] : verdicts) {
      const auto found = of_methods.find(method);
      const auto [few, many] = found == of_methods.end() ? std::pair<FaultCount, FaultCount>{} : found->second;
      body += fmt::format("<td class=\"n\">{} · {}</td>", ShareText(few), ShareText(many));
    }
    body += "</tr>";
  }
  return Framed(prefix +
                    "percentage of faulty performances that are judged wrong, by the worst fault: slight (severity up "
                    "to 0.5) · bad",
                head, body);
}

/// Returns the name of the session of a trial: the name of the recorded person, or the trial's number for a simulated
/// person.
std::string SessionName(const RunData& run, const ScenarioSummary& scenario, int trial) {
  for (const Row& row : run.rows) {
    if (row.scenario == scenario.name && row.trial == trial && !row.clip.empty()) return row.clip;
  }
  return fmt::format("trial {}", trial);
}

std::string SessionTable(const RunData& run, const ScenarioSummary& scenario, const std::string& prefix,
                         const Verdicts& verdicts) {
  const std::string asked = MethodInQuestion(scenario);
  const auto found = verdicts.find(IndexOf(scenario, asked));
  const auto method = found != verdicts.end() ? found : verdicts.begin();
  const std::vector<SessionMistakes> worst = WorstSessions(method->second.performances);
  if (worst.empty()) return "";
  std::string body;
  for (const SessionMistakes& session : std::span(worst).first(std::min(worst.size(), kMaxSessions))) {
    body += fmt::format("<tr><th scope=\"row\">{}</th><td class=\"n\">{} of {}</td><td class=\"n\">{} of {}</td></tr>",
                        EscapeMarkup(SessionName(run, scenario, session.person)), session.missed, session.right,
                        session.praised, session.wrong);
  }
  return Framed(
      fmt::format("{}the sessions with the most errors of {}", prefix, scenario.methods[method->first]),
      Head("session", false) + Head("right performances judged wrong") + Head("wrong performances judged right"), body);
}

std::string ConfusionTable(const std::string& caption, const MoveConfusion& confusion) {
  std::string head = Head("danced", false), body;
  for (const std::string& move : confusion.moves) {
    head += fmt::format("<th scope=\"col\" class=\"n upright\"><span>{}</span></th>", EscapeMarkup(WithSpaces(move)));
  }
  head += "<th scope=\"col\" class=\"n upright\"><span>nothing</span></th>";
  std::vector<std::string> columns = confusion.moves;
  columns.emplace_back();
  for (const std::string& danced : confusion.moves) {
    const int all = confusion.Danced(danced);
    if (all == 0) continue;
    body += fmt::format("<tr><th scope=\"row\">{} <small>{}</small></th>", EscapeMarkup(WithSpaces(danced)), all);
    for (const std::string& named : columns) {
      const auto found = confusion.counts.find({danced, named});
      const double share = found == confusion.counts.end() ? 0 : 100.0 * found->second / all;
      body +=
          share == 0 ? "<td></td>" : fmt::format("<td class=\"n\" style=\"--share:{:.0f}%\">{:.0f}</td>", share, share);
    }
    body += "</tr>";
  }
  return Framed(caption, head, body);
}

std::string Confusions(const ScenarioSummary& scenario, const std::string& prefix, const Verdicts& verdicts) {
  std::string open, folded;
  const std::string asked = MethodInQuestion(scenario);
  for (const auto& [method, of_method] : verdicts) {
    const MoveConfusion confusion = ConfusionOf(of_method.performances);
    if (confusion.counts.empty() || confusion.moves.size() > kMaxMoves || method >= kMaxMethods) continue;
    const std::string& name = scenario.methods[method];
    std::string& html = name == asked || asked.empty() ? open : folded;
    html += ConfusionTable(
        fmt::format("{}percentage of each danced move (rows) that {} recognised as another move (columns)", prefix,
                    name),
        confusion);
  }
  if (folded.empty()) return open;
  return open + "<details><summary>Confused moves of the other methods</summary>" + folded + "</details>";
}

}  // namespace

int MoveConfusion::Danced(const std::string& move) const {
  int all = 0;
  for (const auto& [pair, count] : counts) all += pair.first == move ? count : 0;
  return all;
}

MoveConfusion ConfusionOf(std::span<const JudgedPerformance> performances) {
  MoveConfusion confusion;
  std::set<std::string> moves;
  for (const JudgedPerformance& one : performances) {
    if (one.danced.empty() || !one.named) continue;
    ++confusion.counts[{one.danced, *one.named}];
    moves.insert(one.danced);
    if (!one.named->empty()) moves.insert(*one.named);
  }
  confusion.moves.assign(moves.begin(), moves.end());
  return confusion;
}

std::map<std::string, std::pair<FaultCount, FaultCount>> FoundByFault(std::span<const JudgedPerformance> performances) {
  std::map<std::string, std::pair<FaultCount, FaultCount>> counts;
  for (const JudgedPerformance& one : performances) {
    if (one.fault.empty() || !(one.severity > 0)) continue;
    auto& [slight, bad] = counts[one.fault];
    FaultCount& count = one.severity <= 0.5 ? slight : bad;
    ++count.all;
    count.found += !one.is_called;
  }
  return counts;
}

std::vector<SessionMistakes> WorstSessions(std::span<const JudgedPerformance> performances) {
  std::map<int, SessionMistakes> sessions;
  for (const JudgedPerformance& one : performances) {
    if (one.truth == 0.5) continue;
    SessionMistakes& session = sessions[one.person];
    session.person = one.person;
    const bool is_right = one.truth > 0.5;
    ++(is_right ? session.right : session.wrong);
    if (is_right && !one.is_called) ++session.missed;
    if (!is_right && one.is_called) ++session.praised;
  }
  std::vector<SessionMistakes> worst;
  for (const auto& [person, session] : sessions) {
    if (session.missed + session.praised > 0) worst.push_back(session);
  }
  std::ranges::stable_sort(worst, std::ranges::greater{}, &SessionMistakes::Share);
  return worst;
}

std::string VerdictTablesHtml(const RunData& run, const ScenarioSummary& scenario) {
  std::string html;
  std::size_t count = 0;
  for (const ConditionSummary& condition : scenario.conditions) {
    const Verdicts verdicts = VerdictsUnder(run, scenario, condition);
    if (verdicts.empty() || ++count > kMaxTabled) continue;
    const std::string label = ConditionLabel(condition.condition), prefix = label.empty() ? "" : label + ": ";
    html += FaultTable(scenario, prefix, verdicts) + SessionTable(run, scenario, prefix, verdicts) +
            Confusions(scenario, prefix, verdicts);
  }
  if (html.empty()) return "";
  return "<details><summary>Faults that were found, worst sessions, confused moves</summary>" + html +
         LeftOutHtml(count, kMaxTabled, "conditions", "series/") + "</details>";
}

}  // namespace etude
