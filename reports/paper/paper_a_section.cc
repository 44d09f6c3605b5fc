#include "reports/paper/paper_a_section.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>

#include "engine/fuzzy/fuzzy_system.h"
#include "engine/fuzzy/shape_text.h"
#include "reports/paper/membership_plot.h"
#include "reports/paper/paper_a_figures.h"
#include "reports/words/escape.h"

namespace etude {
namespace {

constexpr std::string_view kFuzzyKey = "fuzzy", kBuiltin = "builtin:";

/// The paper's, then those of the program's own that the scenario sweeps. A file's functions are not in the results.
std::vector<FuzzySystem> ShownSystems(const ScenarioSummary& scenario) {
  std::vector<FuzzySystem> systems = {FuzzySystem{}};
  for (const ConditionSummary& condition : scenario.conditions) {
    for (const SweptValue& swept : condition.condition) {
      if (swept.key != kFuzzyKey || !swept.value.starts_with(kBuiltin)) continue;
      auto system = LoadBuiltinFuzzySystem(swept.value.substr(kBuiltin.size()), {});
      if (system && std::ranges::find(systems, system->name, &FuzzySystem::name) == systems.end()) {
        systems.push_back(*std::move(system));
      }
    }
  }
  return systems;
}

std::string FeatureNames(Feature right) {
  const std::string name(FeatureName(right));
  return name.front() == 'R' ? fmt::format("{}, L{}", name, name.substr(1)) : name;
}

std::string EquationWords(const PaperAFigure& figure) {
  const auto [first, last] = std::ranges::minmax(figure.equations);
  return fmt::format("equations {} {} {}", first, last - first == 1 ? "and" : "to", last);
}

std::string FigureHtml(const PaperAFigure& figure, const FuzzySystem& system, bool is_paper) {
  const std::string what = fmt::format("{}: {}", FeatureNames(figure.feature), figure.title);
  const std::string caption = is_paper
                                  ? fmt::format("<b>Figure {}</b>. {} ({}), {}. {}", figure.number, EscapeMarkup(what),
                                                EscapeMarkup(figure.input), EquationWords(figure), figure.repaired)
                                  : fmt::format("{} ({}).", EscapeMarkup(what), EscapeMarkup(figure.input));
  return fmt::format("<figure>{}<figcaption>{}</figcaption></figure>",
                     MembershipPlotSvg(figure.feature, system.memberships, "Membership functions of " + what), caption);
}

std::string RoundTripHtml(const FuzzySystem& system) {
  std::string html =
      "<p class=\"quiet legend\">Back from the grades: the mean difference between what went in and what each method "
      "of "
      "defuzzification gives back, over the whole axis.</p><table class=\"printed\"><thead><tr><th>feature</th>";
  for (Defuzzification method : AllDefuzzifications()) {
    html += fmt::format("<th class=\"n\">{}</th>", DefuzzificationName(method));
  }
  html += "</tr></thead><tbody>";
  for (const PaperAFigure& figure : PaperAFigures()) {
    html += fmt::format("<tr><th>{}</th>", FeatureNames(figure.feature));
    for (Defuzzification method : AllDefuzzifications()) {
      html +=
          fmt::format("<td class=\"n\">{:.1f}</td>", MeanRoundTripError(figure.feature, system.memberships, method));
    }
    html += "</tr>";
  }
  return html + "</tbody></table>";
}

/// One line per term: figure, feature, term, shape, equation.
std::vector<std::array<std::string, 5>> PaperLines() {
  std::vector<std::array<std::string, 5>> lines;
  for (const PaperAFigure& figure : PaperAFigures()) {
    std::size_t t = 0;
    for (const Term& term : TermsOf(figure.feature)) {
      const Shape& shape = PaperMemberships().shapes[FirstTermOf(figure.feature) + t];
      std::string words = WriteShape(shape);
      words = words.substr(1, words.size() - 2);  // without braces
      lines.push_back({fmt::format("{}", figure.number), FeatureNames(figure.feature), std::string(term.name), words,
                       fmt::format("{}", figure.equations[t++])});
    }
  }
  return lines;
}

constexpr std::string_view kMisprints =
    "Repaired misprints: equation 9 (printed a second “sit”, meant is “stand”); the distance is equation 1 (the text "
    "says 7); “hands (RF, LF, RFK, LFK)” are RH, LH, RHE, LHE.";

}  // namespace

bool ShowsPaperA(const ScenarioSummary& scenario) {
  if (scenario.task == "transition" && scenario.name == "paper-bridging") return true;
  return std::ranges::any_of(scenario.conditions, [](const ConditionSummary& condition) {
    return std::ranges::find(condition.condition, kFuzzyKey, &SweptValue::key) != condition.condition.end();
  });
}

std::string PaperAHtml(const ScenarioSummary& scenario) {
  if (!ShowsPaperA(scenario)) return "";
  std::string html;
  for (const FuzzySystem& system : ShownSystems(scenario)) {
    const bool is_paper = html.empty();
    html += fmt::format("<details{}><summary>{}</summary><p class=\"quiet legend\">{}</p><div class=\"memberships\">",
                        is_paper ? " open" : "",
                        is_paper ? "Paper A’s figures 5 to 10: how far a pose belongs to a term"
                                 : fmt::format("The same features in the system {}", EscapeMarkup(system.name)),
                        is_paper ? EscapeMarkup(std::string(kMisprints)) : "");
    for (const PaperAFigure& figure : PaperAFigures()) html += FigureHtml(figure, system, is_paper);
    html += "</div>" + RoundTripHtml(system) + "</details>";
  }
  return html;
}

std::string PaperAMarkdown(const ScenarioSummary& scenario) {
  if (!ShowsPaperA(scenario)) return "";
  std::string text = fmt::format(
      "\n<details><summary>Paper A's figures 5 to 10: membership functions</summary>\n\n{}\n\n"
      "| figure | feature | term | shape | equation |\n|---|---|---|---|---|\n",
      EscapeMarkdown(std::string(kMisprints)));
  for (const auto& line : PaperLines()) {
    for (const std::string& cell : line) text += fmt::format("| {} ", EscapeMarkdown(cell));
    text += "|\n";
  }
  return text + "\n</details>\n";
}

std::string PaperALatex(const ScenarioSummary& scenario) {
  if (!ShowsPaperA(scenario)) return "";
  std::string text = fmt::format(
      "\n\\begin{{table}}[!htbp]\n\\centering\\small\n\\caption{{{}. {}}}\n\\begin{{tabular}}{{rlllr}}\n\\toprule\n"
      "figure & feature & term & shape & equation \\\\\n\\midrule\n",
      EscapeLatex("Membership functions of paper A's figures 5 to 10"), EscapeLatex(std::string(kMisprints)));
  for (const auto& line : PaperLines()) {
    std::string cells;
    for (const std::string& cell : line) cells += (cells.empty() ? "" : " & ") + EscapeLatex(cell);
    text += cells + " \\\\\n";
  }
  return text + "\\bottomrule\n\\end{tabular}\n\\end{table}\n";
}

}  // namespace etude
