#include "reports/plots/pairs.h"

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <span>
#include <vector>

#include "bench/model/recording.h"
#include "bench/recordings/evaluation_extras.h"
#include "io/drawing/escape.h"
#include "io/drawing/numbers.h"
#include "io/drawing/panel.h"
#include "reports/plots/curve_plot.h"
#include "reports/words/cell_series.h"
#include "reports/words/figures.h"
#include "reports/words/judged.h"

namespace etude {
namespace {

constexpr std::size_t kMaxPairs = 12;
constexpr std::size_t kMaxPictures = 3;  // maximum number of pictures of worst frames per method
constexpr const char* kCurves[] = {"mpjpe_unaligned_mm", "mpjpe_root_mm"};

/// The cells of one pair of motion files, in the order of the scenario's methods.
struct Pair {
  std::string name;
  std::vector<const Row*> cells;
  double worst_mm = 0;  ///< the largest value of kCurves[0] over all frames and methods
};

/// Returns the indices of the frames with the largest errors, the largest first (non-maximum suppression: frames near a
/// worse frame are left out).
std::vector<std::size_t> WorstFrames(const std::vector<double>& errors) {
  const std::size_t apart = std::max<std::size_t>(1, errors.size() / 10);
  std::vector<std::size_t> order(errors.size()), worst;
  for (std::size_t f = 0; f < order.size(); ++f) order[f] = f;
  std::ranges::stable_sort(order, std::greater(), [&](std::size_t f) { return errors[f]; });
  for (const std::size_t f : order) {
    const bool is_near = std::ranges::any_of(worst, [&](std::size_t g) { return f < g + apart && g < f + apart; });
    if (!is_near) worst.push_back(f);
    if (worst.size() == kMaxPictures) break;
  }
  return worst;
}

/// Returns how many frames share one point of a curve.
std::size_t FramesPerPoint(std::size_t frames) {
  constexpr std::size_t kMaxDrawn = 80;
  return (frames + kMaxDrawn - 1) / kMaxDrawn;
}

/// Reduces a curve to the largest value of each interval of frames, so that no peak is lost if there are more frames
/// than points.
PlotCurve PeaksOf(const std::vector<double>& errors, std::size_t style) {
  const std::size_t stretch = FramesPerPoint(errors.size());
  PlotCurve curve{.style = style, .values = {}, .at = {}};
  for (std::size_t begin = 0; begin < errors.size(); begin += stretch) {
    const auto part = std::span(errors).subspan(begin, std::min(stretch, errors.size() - begin));
    const auto peak = std::ranges::max_element(part);
    curve.values.push_back(*peak);
    curve.at.push_back(static_cast<double>(begin) + static_cast<double>(peak - part.begin()));
  }
  return curve;
}

std::string CurvesSvg(const Pair& pair, const CellSeriesIndex& series, const ScenarioSummary& scenario,
                      const std::string& metric) {
  constexpr double kTall = 150, kUpper = 8, kLower = 128;
  // Draw one curve for each method, on an axis from 0 to the largest value.
  std::vector<PlotCurve> curves;
  std::vector<double> all = {0}, frames = {0, 1};
  std::size_t stretch = 1;
  for (const Row* cell : pair.cells) {
    const std::vector<double>* errors = series.Find(*cell, metric);
    if (errors == nullptr || errors->empty()) continue;
    curves.push_back(PeaksOf(*errors, IndexOf(scenario, cell->method)));
    all.insert(all.end(), errors->begin(), errors->end());
    frames.push_back(static_cast<double>(errors->size()) - 1);
    stretch = std::max(stretch, FramesPerPoint(errors->size()));
  }
  if (curves.empty()) return "";
  Axis up = AxisOf(all, 0), across = AxisOf(frames, 0);
  up.from = kLower, up.to = kUpper, across.from = kPanelLeft, across.to = kPanelRight;
  const std::string caption =
      fmt::format("{}, {}, {}", WordsFor(metric).label, UnitOf(WordsFor(metric)),
                  stretch == 1 ? "by frame" : fmt::format("maximum of every {} frames", stretch));
  std::string svg = BeginPanel(kTall, caption, kPanelWidth, "panel") + VerticalAxisGrid(up) +
                    HorizontalAxisGrid(across, kUpper, kLower);
  for (const PlotCurve& curve : curves) svg += CurveLine(curve, across, up);
  return fmt::format("<figure><figcaption>{}</figcaption>{}</svg></figure>", EscapeMarkup(caption), svg);
}

/// Draws one frame of the true motion (faint) and of the answer. The view is along the horizontal axis from which the
/// skeletons look widest.
std::string FrameSvg(const RawMotion& truth, const RawMotion& answer, std::size_t frame, std::size_t style,
                     const std::string& words) {
  constexpr double kWide = 150, kTall = 190, kMargin = 8;
  glm::dvec3 low(1e300), high(-1e300);
  for (const RawMotion* motion : {&truth, &answer}) {
    for (std::size_t j = 0; j < motion->joints.size(); ++j) {
      if (!IsSeen(motion->At(frame, j))) continue;
      low = glm::min(low, motion->At(frame, j));
      high = glm::max(high, motion->At(frame, j));
    }
  }
  if (low.x > high.x) return "";
  const glm::dvec3 size = high - low, middle = 0.5 * (low + high);
  const int side = size.z > size.x ? 2 : 0;
  const double scale =
      std::min((kWide - 2 * kMargin) / std::max(size[side], 0.1), (kTall - 2 * kMargin) / std::max(size.y, 0.1));
  std::string svg = BeginPanel(kTall, words, kWide, "panel");
  for (const RawMotion* motion : {&truth, &answer}) {
    for (std::size_t j = 0; j < motion->joints.size(); ++j) {
      const int parent = motion->parents[j];
      const glm::dvec3 &to = motion->At(frame, j), &from = parent < 0 ? to : motion->At(frame, parent);
      if (!IsSeen(to) || !IsSeen(from)) continue;
      const auto x = [&](const glm::dvec3& p) { return kWide / 2 + scale * (p[side] - middle[side]); };
      const auto y = [&](const glm::dvec3& p) { return kTall / 2 - scale * (p.y - middle.y); };
      svg += fmt::format("<polyline class=\"{}\" points=\"{:.1f},{:.1f} {:.1f},{:.1f}\"/>",
                         motion == &truth ? "truth" : fmt::format("c{}", style % 8), x(from), y(from), x(to), y(to));
    }
  }
  return svg + "</svg>";
}

/// Returns pictures of the worst frames of a recorded cell, each with a button that shows the frame in the viewer.
std::string WorstFramesHtml(const Row& cell, const std::vector<double>* errors, const Recording* recording,
                            std::size_t style) {
  if (recording == nullptr || errors == nullptr) return "";
  const auto motions = ReadEvaluationExtras(recording->extras_json);
  if (!motions) return "<p>" + EscapeMarkup(motions.error().message) + "</p>";
  const auto& [truth, answer] = *motions;
  std::string html;
  for (const std::size_t frame : WorstFrames(*errors)) {
    constexpr double kToSee_mm = 1;
    if (frame >= truth.FrameCount() || (*errors)[frame] < kToSee_mm) continue;
    const std::string words = fmt::format("{}: {} mm after {} s", cell.method, FormatNumber((*errors)[frame]),
                                          FormatFixed(static_cast<double>(frame) / truth.rate_hz, 2));
    html +=
        fmt::format("<div>{}<button type=\"button\" data-cell=\"{}\" data-frame=\"{}\">{}</button></div>",
                    FrameSvg(truth, answer, frame, style, words), EscapeMarkup(cell.Id()), frame, EscapeMarkup(words));
  }
  return html.empty() ? "" : "<div class=\"frames\">" + html + "</div>";
}

std::vector<Pair> PairsOf(const RunData& run, const ScenarioSummary& scenario, const CellSeriesIndex& series) {
  std::vector<Pair> pairs;
  if (scenario.conditions.empty()) return pairs;
  std::map<std::string, std::size_t> index_of;
  for (const Row* row : RowsUnder(run, scenario.name, scenario.conditions.front().condition)) {
    const auto [entry, is_new] = index_of.emplace(row->clip, pairs.size());
    if (is_new) pairs.push_back({.name = row->clip, .cells = {}});
    Pair& pair = pairs[entry->second];
    pair.cells.push_back(row);
    const std::vector<double>* errors = series.Find(*row, kCurves[0]);
    if (errors != nullptr && !errors->empty()) pair.worst_mm = std::max(pair.worst_mm, std::ranges::max(*errors));
  }
  std::erase_if(pairs, [&](const Pair& pair) {
    return std::ranges::none_of(pair.cells, [&](const Row* row) { return series.Find(*row, kCurves[0]) != nullptr; });
  });
  std::ranges::stable_sort(pairs, std::greater(), &Pair::worst_mm);
  return pairs;
}

}  // namespace

bool ShowsPairs(const ScenarioSummary& scenario) { return scenario.task == "evaluation"; }

std::string PairsHtml(const RunData& run, const ScenarioSummary& scenario) {
  if (!ShowsPairs(scenario)) return "";
  const CellSeriesIndex series(run);
  const KeptCells kept(run);
  const std::vector<Pair> pairs = PairsOf(run, scenario, series);
  if (pairs.empty()) return "";
  std::string html = CurveLegend(scenario.methods,
                                 "Grey bodies show the truth. Pictures and motions exist only for recorded cells "
                                 "(option <code>--keep motions</code>).");
  for (std::size_t i = 0; i < std::min(pairs.size(), kMaxPairs); ++i) {
    const Pair& pair = pairs[i];
    std::string curves, frames;
    for (const char* metric : kCurves) curves += CurvesSvg(pair, series, scenario, metric);
    for (const Row* cell : pair.cells) {
      frames += WorstFramesHtml(*cell, series.Find(*cell, kCurves[0]), kept.Find(cell->Id()),
                                IndexOf(scenario, cell->method));
    }
    html += fmt::format(
        "<details{}><summary>{}: largest error {} mm ({})</summary><div class=\"panels\">{}</div>{}</details>",
        i == 0 ? " open" : "", EscapeMarkup(pair.name), FormatNumber(pair.worst_mm), WordsFor(kCurves[0]).label, curves,
        frames);
  }
  return html + LeftOutHtml(pairs.size(), kMaxPairs, "pairs", "series/");
}

}  // namespace etude
