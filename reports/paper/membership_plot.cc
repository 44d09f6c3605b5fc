#include "reports/paper/membership_plot.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <vector>

#include "reports/words/escape.h"

namespace etude {
namespace {

// The panel in its own units; the page scales it. Above the curves stand the terms, below the axis two rows of numbers.
constexpr double kPanelWidth = 240, kPanelHeight = 150;
constexpr double kPanelLeft = 24, kPanelRight = 10, kPanelTop = 22, kPanelBottom = 32;
constexpr double kBase = kPanelHeight - kPanelBottom;

class MembershipPanel {
 public:
  explicit MembershipPanel(const Universe& universe) : universe_(universe) {}

  double Across(double input) const {
    return kPanelLeft +
           (kPanelWidth - kPanelLeft - kPanelRight) * (input - universe_.low) / (universe_.high - universe_.low);
  }
  static double Down(double grade) { return kPanelTop + (kBase - kPanelTop) * (1 - grade); }

  std::string Curve(const Shape& shape, std::size_t style) const {
    constexpr int kSteps = 120;
    std::vector<double> inputs = Bends(shape);
    for (int i = 0; i <= kSteps; ++i) {
      inputs.push_back(universe_.low + (universe_.high - universe_.low) * i / kSteps);
    }
    std::ranges::sort(inputs);
    std::string points;
    for (double x : inputs) points += fmt::format("{:.1f},{:.1f} ", Across(x), Down(GradeOf(shape, x)));
    points.pop_back();
    return fmt::format("<polyline class=\"c{}\" points=\"{}\"/>", style % 8, points);
  }

  std::string Label(const Shape& shape, std::string_view name) const {
    const Cut top = CutOf(shape, 1);
    const double peak = 0.5 * (std::max(top.low, universe_.low) + std::min(top.high, universe_.high));
    const double room = 0.15 * (universe_.high - universe_.low);  // a middle name there would leave the panel
    const char* anchor = peak < universe_.low + room ? "start" : peak > universe_.high - room ? "end" : "middle";
    return fmt::format("<text x=\"{:.1f}\" y=\"{}\" text-anchor=\"{}\">{}</text>", Across(peak), kPanelTop - 8, anchor,
                       EscapeMarkup(std::string(name)));
  }

  /// Numbers along the axis; one too near to its neighbour stands a row lower.
  std::string Numbers(std::vector<double> marks) const {
    marks.insert(marks.end(), {universe_.low, universe_.high});
    std::ranges::sort(marks);
    marks.erase(std::unique(marks.begin(), marks.end()), marks.end());
    constexpr double kNear = 22;
    std::string svg;
    std::array<double, 2> last = {-kNear, -kNear};  // where the rows' last numbers stand
    for (double mark : marks) {
      const double x = Across(mark);
      const std::size_t row = x - last[0] < kNear ? 1 : 0;
      if (x - last[row] < kNear) continue;  // no room in either
      last[row] = x;
      svg += fmt::format("<path d=\"M{:.1f} {}v4\"/><text x=\"{:.1f}\" y=\"{}\" text-anchor=\"middle\">{:g}</text>", x,
                         kBase, x, kBase + 14 + 13 * static_cast<double>(row), mark);
    }
    return svg;
  }

  /// Where a straight-sided function bends, within the universe.
  std::vector<double> Bends(const Shape& shape) const {
    std::vector<double> bends;
    for (double grade : {1.0, 0.0}) {
      if (grade == 0 && std::holds_alternative<Gaussian>(shape)) continue;  // has no foot
      const Cut cut = CutOf(shape, grade);
      bends.insert(bends.end(), {cut.low, cut.high});
    }
    std::erase_if(bends, [&](double x) { return x < universe_.low || x > universe_.high; });
    return bends;
  }

 private:
  Universe universe_;
};

}  // namespace

std::string MembershipPlotSvg(Feature feature, const Memberships& memberships, const std::string& title) {
  const MembershipPanel panel(memberships.universes[static_cast<std::size_t>(feature)]);
  std::string svg = fmt::format("<svg class=\"panel\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">",
                                kPanelWidth, kPanelHeight, EscapeMarkup(title));
  for (double grade : {0.0, 0.5, 1.0}) {
    const double y = MembershipPanel::Down(grade);
    svg += fmt::format("<path d=\"M{} {:.1f}H{}\"/><text x=\"{}\" y=\"{:.1f}\" class=\"y\">{:g}</text>", kPanelLeft, y,
                       kPanelWidth - kPanelRight, kPanelLeft - 5, y + 4, grade);
  }
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

}  // namespace etude
