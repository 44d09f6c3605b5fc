#include "tools/clips/contact_sheet.h"

#include <fmt/core.h>

#include <algorithm>

#include "io/drawing/look.h"
#include "tools/clips/clip_facts.h"

namespace etude {
namespace {

constexpr double kSheetDetail = 2;
constexpr int kMargin = 16;
constexpr int kGap = 6;
constexpr int kTitle = 46;       // space for a clip's name and facts above the clip's pictures
constexpr double kLegend = 190;  // space reserved for the legend beside the first clip's name
constexpr int kMinSheetWidth = 640;  // minimum width of a sheet, so that titles fit
constexpr double kNameSize = 16, kFactsSize = 12.5, kTimeSize = 12;

int RowsOf(int pictures, int columns) { return (pictures + columns - 1) / columns; }

void DrawTitle(Canvas& canvas, const ClipFacts& facts, double y, double room) {
  canvas.DrawText({kMargin, y + 18}, facts.name, kNameSize, kInk, room, true);
  canvas.DrawText({kMargin, y + 37}, FactsAsLine(facts), kFactsSize, kSoftInk, room);
}

/// Draws the pictures of a clip in rows of `columns`, from `y` downwards.
void DrawPictures(Canvas& canvas, const Shot& shot, const std::vector<int>& frames, const SheetOptions& options,
                  double y, Studio& studio, Renderer& renderer) {
  for (int k = 0; k < static_cast<int>(frames.size()); ++k) {
    const int frame = frames[static_cast<std::size_t>(k)];
    const int column = k % options.columns, row = k / options.columns;
    const Box box{static_cast<double>(kMargin + column * (options.width + kGap)), y + row * (options.height + kGap),
                  static_cast<double>(options.width), static_cast<double>(options.height)};
    shot.Draw(canvas, box, studio, renderer, frame);
    canvas.DrawText({box.x + 10, box.y + 20}, fmt::format("{:.2f} s", shot.SecondsAt(frame)), kTimeSize, kSoftInk,
                    box.width);
  }
}

}  // namespace

Result<std::string> DrawContactSheet(std::vector<ClipActor> actors, const SheetOptions& options, Renderer& renderer) {
  std::vector<Shot> shots;
  std::vector<std::vector<int>> frames;
  int columns = 1, height = kMargin;
  // Choose the frames of each clip and measure the sheet.
  for (ClipActor& actor : actors) {
    shots.emplace_back(std::move(actor), options.from, 0);
    frames.push_back(SpreadFrames(shots.back(), options.frames));
    const int pictures = static_cast<int>(frames.back().size());
    columns = std::max(columns, std::min(options.columns, pictures));
    height += kTitle + RowsOf(pictures, options.columns) * (options.height + kGap) + kMargin;
  }
  const int width = std::max(2 * kMargin + columns * (options.width + kGap) - kGap, kMinSheetWidth);
  if (width > kMaxSheetSide || height > kMaxSheetSide) {
    return Fail({},
                "the sheet would have {} × {} pixels; allowed: at most {} pixels per side. Use fewer clips, or fewer "
                "or smaller pictures",
                width, height, kMaxSheetSide);
  }
  // Use one scale for all clips.
  ViewBounds bounds;
  for (std::size_t i = 0; i < shots.size(); ++i) shots[i].Include(frames[i], bounds);
  Studio studio(options.width, options.height, kSheetDetail, bounds);

  Canvas canvas(width, height);
  canvas.FillBox({0, 0, static_cast<double>(width), static_cast<double>(height)}, kBackdrop);
  DrawLegend(canvas, width - kMargin, kMargin + 14);
  // Draw the title and the pictures of each clip.
  double y = kMargin;
  for (std::size_t i = 0; i < shots.size(); ++i) {
    const double legend = i == 0 ? kLegend : 0;
    DrawTitle(canvas, FactsOf(shots[i].actor().clip()), y, width - 2 * kMargin - legend);
    y += kTitle;
    DrawPictures(canvas, shots[i], frames[i], options, y, studio, renderer);
    y += RowsOf(static_cast<int>(frames[i].size()), options.columns) * (options.height + kGap) + kMargin;
  }
  return canvas.Png();
}

}  // namespace etude
