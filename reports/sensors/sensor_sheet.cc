#include "reports/sensors/sensor_sheet.h"

#include <algorithm>

#include "reports/films/look.h"

namespace etude {
namespace {

constexpr double kPictureWidth = 260, kPictureHeight = 195;
constexpr double kMargin = 16, kGap = 6, kHead = 40, kRowTitle = 26, kCaption = 20;
constexpr double kTitleSize = 18, kRowSize = 14, kCaptionSize = 12.5;
constexpr double kLargestSheet = 16'000;
constexpr double kRowHeight = kRowTitle + kPictureHeight + kCaption + kGap;

Paint PaintOf(const Rgb8& colour) { return {colour.r / 255.0, colour.g / 255.0, colour.b / 255.0, 1}; }

// The largest box of the picture's shape in the middle of another.
Box Inside(const ColourImage& picture, const Box& box) {
  const double scale = std::min(box.width / picture.width, box.height / picture.height);
  const double width = scale * picture.width, height = scale * picture.height;
  return {box.x + (box.width - width) / 2, box.y + (box.height - height) / 2, width, height};
}

void DrawMarks(Canvas& canvas, const SheetPicture& shown, const Box& box) {
  const glm::dvec2 scale{box.width / shown.picture.width, box.height / shown.picture.height};
  const Box picture{0, 0, static_cast<double>(shown.picture.width), static_cast<double>(shown.picture.height)};
  const auto inside = [&](const glm::dvec2& p) {
    return p.x >= 0 && p.y >= 0 && p.x <= picture.width && p.y <= picture.height;
  };
  for (const SheetMark& mark : shown.marks) {
    if (!inside(mark.a) || !inside(mark.b)) continue;  // nothing is drawn over the neighbours
    const glm::dvec2 corner{box.x, box.y};
    if (mark.a == mark.b) {
      canvas.DrawDot(corner + mark.a * scale, 3, PaintOf(mark.colour));
    } else {
      canvas.DrawLine(corner + mark.a * scale, corner + mark.b * scale, 1.8, PaintOf(mark.colour));
    }
  }
}

void DrawRow(Canvas& canvas, const SheetRow& row, double y) {
  canvas.DrawText({kMargin, y + 17}, row.title, kRowSize, kInk, canvas.width() - 2 * kMargin, true);
  double x = kMargin;
  for (const SheetPicture& shown : row.pictures) {
    const Box box = Inside(shown.picture, {x, y + kRowTitle, kPictureWidth, kPictureHeight});
    canvas.DrawImage(shown.picture, box);
    DrawMarks(canvas, shown, box);
    canvas.DrawText({x, y + kRowTitle + kPictureHeight + 15}, shown.caption, kCaptionSize, kSoftInk, kPictureWidth);
    x += kPictureWidth + kGap;
  }
}

}  // namespace

Result<std::string> DrawSensorSheet(const SensorSheet& sheet) {
  std::size_t columns = 0;
  for (const SheetRow& row : sheet.rows) columns = std::max(columns, row.pictures.size());
  if (columns == 0) return Fail({}, "there is no picture to show");
  const double width = 2 * kMargin + static_cast<double>(columns) * (kPictureWidth + kGap) - kGap;
  const double height = kHead + static_cast<double>(sheet.rows.size()) * kRowHeight + kMargin;
  if (width > kLargestSheet || height > kLargestSheet) {
    return Fail({}, "the sheet would have {:g} × {:g} pixels; allowed: {:g} a side", width, height, kLargestSheet);
  }
  Canvas canvas(static_cast<int>(width), static_cast<int>(height));
  canvas.FillBox({0, 0, width, height}, kBackdrop);
  canvas.DrawText({kMargin, 27}, sheet.title, kTitleSize, kInk, width - 2 * kMargin, true);
  for (std::size_t i = 0; i < sheet.rows.size(); ++i) {
    DrawRow(canvas, sheet.rows[i], kHead + static_cast<double>(i) * kRowHeight);
  }
  return canvas.Png();
}

}  // namespace etude
