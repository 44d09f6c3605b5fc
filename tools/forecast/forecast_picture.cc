#include <fmt/core.h>

#include <algorithm>
#include <array>

#include "engine/base/base64.h"
#include "io/drawing/canvas.h"
#include "io/drawing/escape.h"
#include "io/drawing/look.h"
#include "io/drawing/numbers.h"
#include "io/drawing/table.h"
#include "io/drawing/tool_page.h"
#include "tools/forecast/forecast_rig.h"

namespace etude {
namespace {

constexpr int kWidth = 1280, kHeight = 580, kMargin = 20;
constexpr double kPlanSize = 360, kPlanTop = 74;
constexpr int kPanelsInRow = 5;
constexpr double kPanel = 160, kPanelGap = 12, kPanelsLeft = 418, kPanelTitle = 22;
constexpr double kTitleSize = 18, kTextSize = 13, kTickSize = 11;
constexpr Paint kUnseen{0.25, 0.27, 0.29, 1};

/// The errors at the ends of the colour scale, mm. The upper end is the 95th percentile.
struct Scale {
  double low = 0, high = 1;
};

Scale ScaleOf(const RigForecast& forecast) {
  double low = *forecast.worst.error_mm;
  for (const ForecastPlace& place : forecast.places) low = std::min(low, place.error_mm.value_or(low));
  return {low, std::max(forecast.p95_mm, low + 1e-3)};
}

/// Returns the colour of a share of the scale: from dark blue (small) over green to yellow (large).
Paint ColourOf(double share) {
  constexpr std::array<Paint, 5> kStops = {
      {{0.27, 0.00, 0.33}, {0.23, 0.32, 0.55}, {0.13, 0.57, 0.55}, {0.37, 0.79, 0.38}, {0.99, 0.91, 0.14}}};
  const double at = std::clamp(share, 0.0, 1.0) * (kStops.size() - 1);
  const std::size_t below = std::min(static_cast<std::size_t>(at), kStops.size() - 2);
  const double rest = at - static_cast<double>(below);
  const Paint &a = kStops[below], &b = kStops[below + 1];
  return {a.r + rest * (b.r - a.r), a.g + rest * (b.g - a.g), a.b + rest * (b.b - a.b), 1};
}

/// Draws the errors at all places of one height as a map, true to scale. Like the plan, it is seen from above: x to the
/// right, z downwards.
void DrawHeight(Canvas& canvas, const RigForecast& forecast, const ForecastOptions& options, const Scale& scale,
                int height, double left, double top) {
  const ForecastPlace* places = &forecast.places[static_cast<std::size_t>(height) * kForecastRows * kForecastColumns];
  const glm::dvec2 size(options.size_m.x, options.size_m.z), drawn = kPanel / std::max(size.x, size.y) * size;
  const glm::dvec2 cell = drawn / glm::dvec2(kForecastColumns, kForecastRows);
  canvas.DrawText({left, top - 7}, fmt::format("{:.2f} m high", places->place_m.y), kTextSize, kSoftInk, kPanel);
  for (int z = 0; z < kForecastRows; ++z) {
    for (int x = 0; x < kForecastColumns; ++x) {
      const auto& error = places[z * kForecastColumns + x].error_mm;
      const Paint paint = error ? ColourOf((*error - scale.low) / (scale.high - scale.low)) : kUnseen;
      const glm::dvec2 from = glm::round(cell * glm::dvec2(x, z)), to = glm::round(cell * glm::dvec2(x + 1, z + 1));
      canvas.FillBox({left + from.x, top + from.y, to.x - from.x, to.y - from.y}, paint);
    }
  }
  // Label the ends of the x axis below each map, and the ends of the z axis at the left of the first map of each row.
  const auto label = [&](const glm::dvec2& at, double share, const char* axis, double metres) {
    const std::string text = fmt::format("{}{:.1f}", axis, metres);
    canvas.DrawText({at.x - share * canvas.TextWidth(text, kTickSize), at.y}, text, kTickSize, kSoftInk, kPanel);
  };
  const glm::dvec2 low = forecast.middle_m - 0.5 * size, high = forecast.middle_m + 0.5 * size;
  constexpr double kWide = 80;
  const double inside = drawn.x < kWide ? 1 : 0;
  label({left, top + drawn.y + 14}, inside, "x ", low.x);
  label({left + drawn.x, top + drawn.y + 14}, 1 - inside, "", high.x);
  if (height % kPanelsInRow == 0) {
    label({left - 4, top + 9}, 1, "z ", low.y);
    label({left - 4, top + std::max(drawn.y, 22.0)}, 1, "", high.y);
  }
  const glm::dvec3 off = forecast.worst.place_m - places->place_m;
  if (off.y != 0) return;
  const auto* worst = std::ranges::find(places, places + kForecastRows * kForecastColumns, forecast.worst.place_m,
                                        &ForecastPlace::place_m);
  const auto index = static_cast<int>(worst - places);
  const glm::dvec2 at(index % kForecastColumns, index / kForecastColumns);
  canvas.DrawRing(glm::dvec2(left, top) + cell * (at + 0.5), 8, 2, kInk);
}

/// Draws the plan from above: the cameras, the volume, and the best place for one more camera.
void DrawPlan(Canvas& canvas, const RigForecast& forecast, const ForecastOptions& options) {
  // Choose the scale so that the volume and all cameras fit, including the added camera.
  const glm::dvec2 half(options.size_m.x / 2, options.size_m.z / 2);
  glm::dvec2 low = forecast.middle_m - half, high = forecast.middle_m + half;
  const auto include = [&](const glm::dvec3& p) {
    low = glm::min(low, glm::dvec2(p.x, p.z));
    high = glm::max(high, glm::dvec2(p.x, p.z));
  };
  for (const auto& [name, camera] : forecast.cameras) include(camera.p_WC);
  for (const RigWorth& worth : forecast.worths) {
    if (worth.added_m) include(*worth.added_m);
  }
  constexpr double kRim = 24;
  const double scale = (kPlanSize - 2 * kRim) / std::max(high.x - low.x, high.y - low.y);
  const glm::dvec2 corner = glm::dvec2(kMargin, kPlanTop) + 0.5 * (glm::dvec2(kPlanSize) - scale * (high - low));
  const auto at = [&](const glm::dvec2& p) { return corner + scale * (p - low); };
  // Draw the plan's background and the volume.
  canvas.FillBox({kMargin, kPlanTop, kPlanSize, kPlanSize}, {0.13, 0.145, 0.16, 1}, kPanelRadius);
  const glm::dvec2 from = at(forecast.middle_m - half), size = 2.0 * scale * half;
  canvas.FillBox({from.x, from.y, size.x, size.y}, kUnseen);
  // Draw each camera as a dot with a line in the camera's direction, and record the boxes that dot and line cover.
  struct Mark {
    glm::dvec2 spot;
    std::string name;
    bool is_below;  ///< true: the name should stand below the dot rather than above it
    Paint paint;
  };
  std::vector<Mark> marks;
  std::vector<Box> taken;
  const auto draw_camera = [&](const glm::dvec3& place, const glm::dvec2& towards, const std::string& name,
                               const Paint& paint) {
    const glm::dvec2 spot = at({place.x, place.z});
    canvas.DrawDot(spot, 6, paint);
    const double length = glm::length(towards);
    const glm::dvec2 tip = length > 0 ? spot + 24.0 / length * towards : spot;
    canvas.DrawLine(spot, tip, 2.5, paint);
    const glm::dvec2 least = glm::min(spot - 6.0, tip), extent = glm::max(spot + 6.0, tip) - least;
    taken.push_back({least.x, least.y, extent.x, extent.y});
    marks.push_back({spot, name, towards.y < 0, paint});
  };
  for (const auto& [name, camera] : forecast.cameras) {
    const glm::dvec3 axis = glm::transpose(camera.R_CW)[2];
    draw_camera(camera.p_WC, {axis.x, axis.z}, name, kAccent);
  }
  for (const RigWorth& worth : forecast.worths) {
    if (worth.added_m)
      draw_camera(*worth.added_m, forecast.middle_m - glm::dvec2(worth.added_m->x, worth.added_m->z), "one more",
                  kWarm);
  }
  // Write each name below or above its dot, at the first height where nothing else stands.
  for (const Mark& mark : marks) {
    const double width = std::min(canvas.TextWidth(mark.name, kTextSize), 120.0);
    const double left = std::clamp(mark.spot.x - width / 2, kMargin + 4.0, kMargin + kPlanSize - width - 4);
    Box box;
    for (const double down : {22.0, -10.0, 38.0, -26.0, 54.0, -42.0}) {
      box = {left, mark.spot.y + (mark.is_below ? down : 12 - down) - kTextSize, width, kTextSize};
      const auto meets = [&](const Box& other) {
        return box.x < other.x + other.width && other.x < box.x + box.width && box.y < other.y + other.height &&
               other.y < box.y + box.height;
      };
      if (std::ranges::none_of(taken, meets)) break;
    }
    taken.push_back(box);
    canvas.DrawText({left, box.y + kTextSize}, mark.name, kTextSize, mark.paint, 120);
  }
}

void DrawScale(Canvas& canvas, const Scale& scale) {
  canvas.DrawText({kMargin, kPlanTop + kPlanSize + 18}, "From above: x to the right, z downwards, in m", kTextSize,
                  kSoftInk, kPlanSize);
  constexpr double kTop = kPlanTop + kPlanSize + 50, kLong = 240, kThick = 14;
  canvas.DrawText({kMargin, kTop - 9}, "Root mean square error of a point, mm", kTextSize, kInk, kPlanSize);
  for (int i = 0; i < static_cast<int>(kLong); ++i)
    canvas.FillBox({kMargin + i * 1.0, kTop, 1.0, kThick}, ColourOf(i / kLong));
  canvas.DrawText({kMargin, kTop + 30}, fmt::format("{:.1f}", scale.low), kTextSize, kSoftInk, 80);
  canvas.DrawText({kMargin + kLong - 50, kTop + 30}, fmt::format("{:.1f} or more", scale.high), kTextSize, kSoftInk,
                  140);
  canvas.FillBox({kMargin, kTop + 44, kThick, kThick}, kUnseen);
  canvas.DrawText({kMargin + 22, kTop + 56}, "fewer than two cameras see this place", kTextSize, kSoftInk, kPlanSize);
  canvas.DrawRing({kMargin + 7, kTop + 76}, 6, 2, kInk);
  canvas.DrawText({kMargin + 22, kTop + 81}, "place of the largest error", kTextSize, kSoftInk, kPlanSize);
}

std::string CamerasHtml(const RigForecast& forecast) {
  Table table{.label = "Cameras", .columns = {{.head = "Camera", .is_row_head = true}}};
  for (const char* head : {"x, m", "z, m", "Height, m"}) table.columns.push_back({.head = head, .is_number = true});
  for (const auto& [name, camera] : forecast.cameras) {
    const glm::dvec3& p = camera.p_WC;
    table.rows.push_back({{name, fmt::format("{:.2f}", p.x), fmt::format("{:.2f}", p.z), fmt::format("{:.2f}", p.y)}});
  }
  std::string doubts;
  for (const std::string& doubt : forecast.doubts) doubts += fmt::format("<p>{}.</p>", EscapeMarkup(doubt));
  return fmt::format("<p>{}.</p>{}{}", EscapeMarkup(forecast.placed), doubts, TableHtml(table));
}

std::string JointsHtml(const RigForecast& forecast) {
  if (forecast.joints.empty()) return "<p>There is no place where two cameras see all joints of a standing body.</p>";
  Table table{.label = "Joints", .columns = {{.head = "Joint", .is_row_head = true}}};
  for (const char* head :
       {"Keypoints, px", "Triangulated, mm", "Fitted, mm", "Limb triangulated, degrees", "Limb fitted, degrees"})
    table.columns.push_back({.head = head, .is_number = true});
  for (const ForecastJoint& joint : forecast.joints) {
    const auto degrees = [&](double value) {
      return joint.role == Role::kHipCentre ? std::string(kNoValue) : fmt::format("{:.1f}", value);
    };
    table.rows.push_back(
        {{RoleName(joint.role), joint.noise_px ? fmt::format("{:.1f}", *joint.noise_px) : std::string(kNoValue),
          fmt::format("{:.1f}", joint.point_mm), fmt::format("{:.1f}", joint.body_mm), degrees(joint.point_deg),
          degrees(joint.body_deg)}});
  }
  return fmt::format(
             "<p>Root mean square errors of a standing person, over the {:.0f} % of the floor where two cameras see "
             "every joint. Triangulated: the error of each joint on its own. Fitted: the error of the same joint, if a "
             "body is fitted to all joints at once. Limb: the error of the direction of the limb that ends in the "
             "joint.</p>",
             100 * forecast.bodies) +
         TableHtml(table);
}

std::string WorthsHtml(const RigForecast& forecast) {
  Table table{.label = "Changes",
              .columns = {{.head = "The rig", .is_row_head = true},
                          {.head = "Median error, mm", .is_number = true},
                          {.head = "Visible places", .is_number = true}}};
  for (const RigWorth& worth : forecast.worths) {
    table.rows.push_back(
        {{worth.change, fmt::format("{:.1f}", worth.median_mm), fmt::format("{:.0f} %", 100 * worth.seen)}});
  }
  return "<p>Median error: of a triangulated point, over the places that two cameras of the present rig see. Visible "
         "places: the share of all places that two cameras of the changed rig see.</p>" +
         TableHtml(table);
}

}  // namespace

std::string ForecastPicture(const RigForecast& forecast, const ForecastOptions& options) {
  Canvas canvas(kWidth, kHeight);
  canvas.FillBox({0, 0, kWidth, kHeight}, kBackdrop);
  canvas.DrawText({kMargin, 34}, "Expected error over the volume", kTitleSize, kInk, kWidth - 2 * kMargin, true);
  canvas.DrawText({kMargin, 58}, AssumedWords(forecast, options), kTextSize, kSoftInk, kWidth - 2 * kMargin);
  DrawPlan(canvas, forecast, options);
  const Scale scale = ScaleOf(forecast);
  DrawScale(canvas, scale);
  for (int height = 0; height < kForecastHeights; ++height) {
    const int column = height % kPanelsInRow, row = height / kPanelsInRow;
    DrawHeight(canvas, forecast, options, scale, height, kPanelsLeft + column * (kPanel + kPanelGap),
               kPlanTop + kPanelTitle + row * (kPanel + kPanelTitle + 2 * kPanelGap));
  }
  return canvas.Png();
}

std::string ForecastPage(const RigForecast& forecast, const ForecastOptions& options) {
  const std::string picture = fmt::format(
      "<figure class=\"film\"><img width=\"{}\" height=\"{}\" src=\"data:image/png;base64,{}\" alt=\"Heat maps by "
      "height\"></figure>",
      kWidth, kHeight, Base64(ForecastPicture(forecast, options)));
  return WriteToolPage({.kind = "forecast",
                        .title = options.rig,
                        .verdict = FoundWords(forecast) + ".",
                        .version = options.version,
                        .command = options.command_line},
                       fmt::format("<p>{}.</p>{}<section class=\"card\"><h2>What would help</h2>{}</section>\n"
                                   "<section class=\"card\"><h2>Errors of a person in the volume</h2>{}</section>\n"
                                   "<section class=\"card\"><h2>The cameras</h2>{}</section>\n",
                                   EscapeMarkup(AssumedWords(forecast, options)), picture, WorthsHtml(forecast),
                                   JointsHtml(forecast), CamerasHtml(forecast)));
}

}  // namespace etude
