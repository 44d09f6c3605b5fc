#include "reports/paper/paper_a.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/fuzzy/fuzzy_system.h"
#include "io/drawing/escape.h"
#include "io/drawing/panel.h"
#include "io/drawing/table.h"

namespace etude {
namespace {

// Size and margins of the plot of one feature, in units that the page scales. The names of the terms are written above
// the curves, and the numbers of the axis below the axis.
constexpr double kPanelWide = 240, kPanelHeight = 150, kPanelTop = 22, kBase = 118;
constexpr double kPanelMargin = 24, kPanelRim = 10;
constexpr Axis kGrades{.low = 0, .high = 1, .from = kBase, .to = kPanelTop};

class MembershipPanel {
 public:
  explicit MembershipPanel(const Universe& universe)
      : universe_(universe),
        inputs_{.low = universe.low, .high = universe.high, .from = kPanelMargin, .to = kPanelWide - kPanelRim} {}

  std::string Grid() const {
    std::string svg;
    for (const double grade : {0.0, 0.5, 1.0}) {
      svg += fmt::format("<path d=\"M{} {:.1f}H{}\"/>", inputs_.from, kGrades.At(grade), inputs_.to) +
             PanelText(inputs_.from - 5, kGrades.At(grade) + 4, TickText(grade), "end");
    }
    return svg;
  }

  std::string Curve(const Shape& shape, std::size_t style) const {
    constexpr int kSteps = 120;
    std::vector<double> inputs = Bends(shape);
    for (int i = 0; i <= kSteps; ++i) {
      inputs.push_back(universe_.low + (universe_.high - universe_.low) * i / kSteps);
    }
    std::ranges::sort(inputs);
    std::string points;
    for (double x : inputs) points += fmt::format("{:.1f},{:.1f} ", inputs_.At(x), kGrades.At(GradeOf(shape, x)));
    points.pop_back();
    return fmt::format("<polyline class=\"c{}\" points=\"{}\"/>", style % 8, points);
  }

  std::string Label(const Shape& shape, std::string_view name) const {
    const Cut top = CutOf(shape, 1);
    const double peak = 0.5 * (std::max(top.low, universe_.low) + std::min(top.high, universe_.high));
    // If a peak is nearer to an edge of the plot than this, the term's name begins or ends at the peak. If the name
    // were centred at the peak, it would be cut off.
    const double room = 0.15 * (universe_.high - universe_.low);
    const char* anchor = peak < universe_.low + room ? "start" : peak > universe_.high - room ? "end" : "middle";
    return PanelText(inputs_.At(peak), kPanelTop - 8, name, anchor);
  }

  /// Returns the numbers below the axis as SVG. A number that is too close to the previous number is written in a
  /// second row.
  std::string Numbers(std::vector<double> marks) const {
    marks.insert(marks.end(), {universe_.low, universe_.high});
    std::ranges::sort(marks);
    marks.erase(std::unique(marks.begin(), marks.end()), marks.end());
    constexpr double kMinGap = 22;
    std::string svg;
    std::array<double, 2> last = {-kMinGap, -kMinGap};  // the position of the last number in each row
    for (double mark : marks) {
      const double x = inputs_.At(mark);
      const std::size_t row = x - last[0] < kMinGap ? 1 : 0;
      if (x - last[row] < kMinGap) continue;  // neither row has space for the number: leave it out
      last[row] = x;
      svg += fmt::format("<path d=\"M{:.1f} {}v4\"/>", x, kBase) +
             PanelText(x, kBase + 14 + 13 * static_cast<double>(row), TickText(mark), "middle");
    }
    return svg;
  }

  /// Returns the inputs within the universe at which the slope of a piecewise linear membership function changes.
  std::vector<double> Bends(const Shape& shape) const {
    std::vector<double> bends;
    for (double grade : {1.0, 0.0}) {
      if (grade == 0 && std::holds_alternative<Gaussian>(shape)) continue;  // a Gaussian has no bend at 0
      const Cut cut = CutOf(shape, grade);
      bends.insert(bends.end(), {cut.low, cut.high});
    }
    std::erase_if(bends, [&](double x) { return x < universe_.low || x > universe_.high; });
    return bends;
  }

 private:
  Universe universe_;
  Axis inputs_;
};

constexpr std::string_view kFuzzyKey = "fuzzy", kBuiltin = "builtin:";

/// Returns the paper's fuzzy system, then the built-in fuzzy systems that the scenario sweeps. Fuzzy systems from files
/// are left out, because results do not contain their functions.
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
  const std::string_view legend =
      "Defuzzification computes a value from its membership grades. For each method of defuzzification, the table "
      "shows the mean difference between the original value and the computed value, over the whole axis.";
  Table table{.label = fmt::format("Defuzzification with the membership functions of {}", system.name),
              .style = "printed",
              .columns = {{.head = "feature", .is_row_head = true}}};
  for (Defuzzification method : AllDefuzzifications()) {
    table.columns.push_back({.head = std::string(DefuzzificationName(method)), .is_number = true});
  }
  for (const PaperAFigure& figure : PaperAFigures()) {
    table.rows.push_back({{FeatureNames(figure.feature)}});
    for (Defuzzification method : AllDefuzzifications()) {
      const double error = MeanRoundTripError(figure.feature, system.memberships, method);
      table.rows.back().cells.emplace_back(fmt::format("{:.1f}", error));
    }
  }
  return fmt::format("<p class=\"quiet legend\">{}</p>{}", legend, TableHtml(table));
}

Table PaperTerms() {
  Table table{.columns = {{.head = "figure", .is_number = true},
                          {"feature"},
                          {"term"},
                          {"shape"},
                          {.head = "equation", .is_number = true}}};
  for (const PaperAFigure& figure : PaperAFigures()) {
    std::size_t t = 0;
    for (const Term& term : TermsOf(figure.feature)) {
      std::string words = WriteShape(PaperMemberships().shapes[FirstTermOf(figure.feature) + t]);
      words = words.substr(1, words.size() - 2);  // removes the braces
      table.rows.push_back({{fmt::format("{}", figure.number), FeatureNames(figure.feature), term.name, words,
                             fmt::format("{}", figure.equations[t++])}});
    }
  }
  return table;
}

constexpr std::string_view kMisprints =
    "Etude corrects these misprints: equation 9 is printed as a second “sit”, but means “stand”; the distance is "
    "equation 1, but the text says 7; “hands (RF, LF, RFK, LFK)” means RH, LH, RHE, LHE.";

}  // namespace

const std::vector<PaperAFigure>& PaperAFigures() {
  using enum Feature;
  static const std::vector<PaperAFigure> figures = {
      {5, kRH, "arm raise", "degrees between the upper arm and straight down", {2, 3, 4}, ""},
      {6,
       kRHE,
       "elbow bent",
       "degrees between upper arm and forearm",
       {5, 6},
       "The grades do not sum to 1, as in the paper."},
      {7,
       kPosture,
       "lying to jumping",
       "height of the body's centre, standing = 80",
       {7, 8, 9, 10},
       "Equation 9 is printed as a second “sit”, but means “stand”."},
      {8, kTrunk, "trunk bent", "180 degrees minus the lean", {12, 11}, "The grades do not sum to 1, as in the paper."},
      {9, kRF, "leg spread", "degrees between the thigh and straight down", {13, 14}, ""},
      {10, kRFK, "knee bent", "degrees inside the knee", {16, 15}, "The grades do not sum to 1, as in the paper."},
  };
  return figures;
}

double MeanRoundTripError(Feature feature, const Memberships& memberships, Defuzzification method) {
  constexpr int kSteps = 120;
  const Universe& universe = memberships.universes[static_cast<std::size_t>(feature)];
  double sum = 0;
  int count = 0;
  for (int i = 0; i <= kSteps; ++i) {
    PoseFeatures pose;
    pose[feature] = universe.low + (universe.high - universe.low) * i / kSteps;
    const auto back = DefuzzifyFeature(Fuzzify(pose, memberships), feature, memberships, method);
    if (!back) continue;  // no term has a grade above 0, so there is nothing to defuzzify
    sum += std::abs(*back - pose[feature]);
    ++count;
  }
  return count > 0 ? sum / count : 0;
}

std::string MembershipPlotSvg(Feature feature, const Memberships& memberships, const std::string& title) {
  const MembershipPanel panel(memberships.universes[static_cast<std::size_t>(feature)]);
  std::string svg = BeginPanel(kPanelHeight, title, kPanelWide, "panel") + panel.Grid();
  std::vector<double> marks;
  std::string curves, labels;
  for (std::size_t t = 0; t < TermsOf(feature).size(); ++t) {
    const Shape& shape = memberships.shapes[FirstTermOf(feature) + t];
    std::ranges::copy(panel.Bends(shape), std::back_inserter(marks));
    curves += panel.Curve(shape, t);
    labels += panel.Label(shape, TermsOf(feature)[t].name);
  }
  return svg + panel.Numbers(marks) + curves + labels + "</svg>";
}

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
                        is_paper ? "Paper A’s figures 5 to 10: membership grades of poses in each term"
                                 : fmt::format("The same features in the fuzzy system {}", EscapeMarkup(system.name)),
                        is_paper ? EscapeMarkup(std::string(kMisprints)) : "");
    for (const PaperAFigure& figure : PaperAFigures()) html += FigureHtml(figure, system, is_paper);
    html += "</div>" + RoundTripHtml(system) + "</details>";
  }
  return html;
}

std::string PaperAMarkdown(const ScenarioSummary& scenario) {
  if (!ShowsPaperA(scenario)) return "";
  return fmt::format(
      "\n<details><summary>Paper A's figures 5 to 10: membership functions</summary>\n\n{}\n{}\n</details>\n",
      EscapeMarkdown(kMisprints), TableMarkdown(PaperTerms()));
}

std::string PaperALatex(const ScenarioSummary& scenario) {
  if (!ShowsPaperA(scenario)) return "";
  return fmt::format("\n\\begin{{table}}[!htbp]\n\\centering\\small\n\\caption{{{}. {}}}\n{}\\end{{table}}\n",
                     EscapeLatex("Membership functions of paper A's figures 5 to 10"), EscapeLatex(kMisprints),
                     TableLatex(PaperTerms()));
}

}  // namespace etude
