#include "tools/capture/capture_page.h"

#include <fmt/core.h>

#include <algorithm>
#include <iterator>

#include "engine/base/base64.h"
#include "io/drawing/escape.h"
#include "io/drawing/marks.h"
#include "io/drawing/panel.h"
#include "io/drawing/table.h"
#include "io/drawing/tool_page.h"

namespace etude {
namespace {

constexpr double kHeight = 190, kTop = 8, kBottom = 166, kWide = 900, kRight = 890;

/// Returns the curve as an SVG path. If there are more frames than points, each point is the maximum of several frames.
std::string PathOf(const TakeCurve& curve, const Axis& across, const Axis& up, double rate_hz) {
  constexpr std::size_t kMaxPoints = 450;
  const std::size_t stride = (curve.values.size() + kMaxPoints - 1) / kMaxPoints;
  std::string path;
  bool is_down = false;
  for (std::size_t from = 0; from < curve.values.size(); from += stride) {
    std::optional<double> largest;
    for (std::size_t i = from; i < std::min(from + stride, curve.values.size()); ++i) {
      if (curve.values[i]) largest = std::max(largest.value_or(*curve.values[i]), *curve.values[i]);
    }
    if (largest) {
      path += fmt::format("{}{:.1f} {:.1f}", is_down ? "L" : "M", across.At(static_cast<double>(from) / rate_hz),
                          up.At(*largest));
    }
    is_down = largest.has_value();
  }
  return path;
}

/// Returns a figure that shows curves over time, with a legend.
std::string CurvesHtml(const std::vector<TakeCurve>& curves, double rate_hz, std::string_view caption) {
  std::vector<double> all;
  std::size_t frames = 1;
  for (const TakeCurve& curve : curves) {
    frames = std::max(frames, curve.values.size());
    std::ranges::copy(KnownOf(curve.values), std::back_inserter(all));
  }
  if (all.empty()) return "";
  Axis up = AxisAroundZero(all);
  up.from = kBottom, up.to = kTop;
  const Axis across{.low = 0, .high = static_cast<double>(frames) / rate_hz, .from = kPanelLeft, .to = kRight};
  std::string svg = BeginPanel(kHeight, caption, kWide, "plot wide") + HorizontalAxisGrid(across, kTop, kBottom) +
                    VerticalAxisGrid(up, kPanelLeft, kRight);
  std::string legend;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    svg += MethodLine(i, PathOf(curves[i], across, up, rate_hz));
    legend += fmt::format("<span class=\"method\">{} {}</span> ", LineKeySvg(i), EscapeMarkup(curves[i].name));
  }
  return fmt::format(
      "<figure class=\"plots\"><figcaption>{}</figcaption>{}</svg><p class=\"quiet legend\">{}</p></figure>",
      EscapeMarkup(caption), svg, legend);
}

/// Writes a table in which all columns but the first hold numbers.
std::string NumbersHtml(const std::vector<std::string>& heads, const std::vector<std::vector<std::string>>& rows) {
  Table table{.label = heads.front()};
  for (const std::string& head : heads) table.columns.push_back({.head = head, .is_number = !table.columns.empty()});
  for (const auto& row : rows) table.rows.push_back({{row.begin(), row.end()}});
  return TableHtml(table);
}

std::string FilmHtml(const CapturePage& page) {
  const std::string caption = EscapeMarkup(page.still.caption);
  const std::string poster = "data:image/png;base64," + Base64(page.still.png);
  if (page.mp4.empty()) {
    return page.still.png.empty()
               ? ""
               : fmt::format(
                     "<figure class=\"film\"><img width=\"{}\" height=\"{}\" src=\"{}\" alt=\"{}\"><figcaption>{} The "
                     "film is too large for this page{}.</figcaption></figure>",
                     page.still.width, page.still.height, poster, caption, caption,
                     page.film.empty() ? "" : ": " + EscapeMarkup(page.film));
  }
  return fmt::format(
      "<figure class=\"film\"><video controls loop muted playsinline width=\"{}\" height=\"{}\" poster=\"{}\" "
      "src=\"data:video/mp4;base64,{}\" aria-label=\"{}\"></video><figcaption>{}</figcaption></figure>",
      page.still.width, page.still.height, poster, Base64(page.mp4), caption, caption);
}

std::string ToldHtml(const CapturePage& page) {
  if (page.told.empty()) return "";
  std::string html = "<section class=\"card\"><h2>Findings and corrections</h2><ul>";
  for (const std::string& line : page.told) {
    const bool is_doubt = line.starts_with("doubtful");
    html += fmt::format("<li>{}{}</li>", is_doubt ? "<span class=\"badge open\">doubtful</span> " : "",
                        EscapeMarkup(is_doubt ? line.substr(line.find(':') + 1) : line));
  }
  return html + "</ul></section>\n";
}

std::string ResidualsHtml(const CameraResiduals& residuals, double rate_hz) {
  // Write one table row for each camera: number of frames, median, 95th percentile, and the share of rejected
  // keypoints.
  std::vector<TakeCurve> curves;
  std::vector<std::vector<std::string>> rows;
  std::vector<std::string> heads = {"Camera", "Frames", "Median, " + residuals.unit, "95 %, " + residuals.unit};
  const bool has_keypoints =
      std::ranges::any_of(residuals.cameras, [](const auto& camera) { return camera.left_out.has_value(); });
  if (has_keypoints) heads.emplace_back("Outliers among keypoints");
  for (const CapturedCamera& camera : residuals.cameras) {
    curves.push_back(camera.residual);
    std::vector<double> values = KnownOf(camera.residual.values);
    std::ranges::sort(values);
    const auto rank = [&](double share) {
      if (values.empty()) return std::string("—");
      return fmt::format("{:.1f}", values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))]);
    };
    constexpr double kMedian = 0.5, k95Percent = 0.95, kPercent = 100;
    rows.push_back({camera.name, fmt::format("{}", values.size()), rank(kMedian), rank(k95Percent)});
    if (has_keypoints) rows.back().push_back(fmt::format("{:.1f} %", kPercent * camera.left_out.value_or(0)));
  }
  return CurvesHtml(curves, rate_hz, residuals.caption) + NumbersHtml(heads, rows);
}

std::string CamerasHtml(const CapturePage& page) {
  std::string html = "<section class=\"card\"><h2>Agreement of the cameras</h2>";
  for (const CameraResiduals& residuals : page.residuals) html += ResidualsHtml(residuals, page.rate_hz);
  return html + "</section>\n";
}

std::string BodyHtml(const CapturePage& page) {
  std::vector<std::vector<std::string>> lengths, fit;
  for (const auto& [name, cm] : page.lengths_cm) lengths.push_back({name, fmt::format("{:.1f}", cm)});
  for (const auto& [name, mm] : page.fit)
    fit.push_back({name, fmt::format("{:.1f}", mm[0]), fmt::format("{:.1f}", mm[1])});
  return "<section class=\"card\"><h2>Feet and floor</h2>" +
         CurvesHtml(page.feet_cm, page.rate_hz,
                    "Height of each foot's lowest joint above the floor, in cm, over time in s") +
         "</section>\n<section class=\"card\"><h2>The body</h2><p>" + EscapeMarkup(page.limbs) + "</p>" +
         NumbersHtml({"Limb", "Length, cm"}, lengths) +
         (fit.empty() ? ""
                      : "<p>Distance from each joint of the skeleton to the point that the joint was fitted to:</p>" +
                            NumbersHtml({"Joint", "Median, mm", "95 %, mm"}, fit)) +
         "</section>\n";
}

}  // namespace

std::vector<double> KnownOf(const std::vector<std::optional<double>>& values) {
  std::vector<double> known;
  for (const auto& value : values) {
    if (value) known.push_back(*value);
  }
  return known;
}

std::string WriteCapturePage(const CapturePage& page) {
  return WriteToolPage({.kind = "capture", .title = page.title, .verdict = page.verdict, .version = page.version,
                        .command = page.command},
                       FilmHtml(page) + ToldHtml(page) + CamerasHtml(page) + BodyHtml(page));
}

}  // namespace etude
