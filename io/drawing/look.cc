#include "io/drawing/look.h"

#include <algorithm>
#include <sstream>

#include "io/drawing/marks.h"

namespace etude {
namespace {

constexpr double kMargin = 16;
constexpr double kTagSize = 17, kTagHeight = 30, kTagInset = 12;
constexpr double kStrongSize = 24, kStrongLine = 28;
constexpr double kSoftSize = 18, kSoftLine = 23;

}  // namespace

Paint MethodPaint(std::size_t method) {
  const std::string hex(kPlotColours[method % kPlotColours.size()].dark.substr(1));
  const auto part = [&](std::size_t at) { return std::stoi(hex.substr(at, 2), nullptr, 16) / 255.0; };
  return {part(0), part(2), part(4), 1};
}

void DrawTag(Canvas& canvas, const Box& panel, const std::string& text, double free) {
  const double width = std::min(canvas.TextWidth(text, kTagSize, true) + 20, panel.width - 2 * kTagInset - free);
  canvas.FillBox({panel.x + kTagInset, panel.y + kTagInset, width, kTagHeight}, {0.05, 0.06, 0.07, 0.72},
                 kTagHeight / 2);
  canvas.DrawText({panel.x + kTagInset + 10, panel.y + 33}, text, kTagSize, kInk, width - 19, true);
}

void DrawMark(Canvas& canvas, const Box& panel, const std::string& text) {
  const double width = canvas.TextWidth(text, kTagSize, true) + 20;
  const double x = panel.x + panel.width - kTagInset - width;
  canvas.FillBox({x, panel.y + kTagInset, width, kTagHeight}, kWarm, kTagHeight / 2);
  canvas.DrawText({x + 10, panel.y + 33}, text, kTagSize, kBackdrop, width, true);
}

std::vector<std::string> LinesOf(const Canvas& canvas, const std::string& words, double size, double room, bool bold) {
  std::vector<std::string> lines;
  std::istringstream read(words);
  for (std::string word; read >> word;) {
    if (!lines.empty() && canvas.TextWidth(lines.back() + " " + word, size, bold) <= room) {
      lines.back() += " " + word;
    } else {
      lines.push_back(word);
    }
  }
  return lines;
}

void DrawCaption(Canvas& canvas, const Box& panel, const std::string& strong, const std::string& soft) {
  const double room = panel.width - 2 * kMargin;
  const auto strong_lines = LinesOf(canvas, strong, kStrongSize, room, true);
  const auto soft_lines = LinesOf(canvas, soft, kSoftSize, room, false);
  const double more_soft = kSoftLine * static_cast<double>(std::max<std::size_t>(soft_lines.size(), 1) - 1);
  const double strong_height = kStrongLine * static_cast<double>(strong_lines.size());
  const double bottom = panel.y + panel.height;
  const double shade = 54 + more_soft + (strong_lines.empty() ? 0 : strong_height + 6);
  canvas.FillShade({panel.x, panel.y + panel.height - shade, panel.width, shade}, {0.03, 0.04, 0.05, 0},
                   {0.03, 0.04, 0.05, 0.82});
  double y = bottom - 16 - more_soft - strong_height;
  for (const std::string& line : strong_lines) {
    canvas.DrawText({panel.x + kMargin, y}, line, kStrongSize, kInk, room, true);
    y += kStrongLine;
  }
  for (const std::string& line : soft_lines) {
    canvas.DrawText({panel.x + kMargin, y}, line, kSoftSize, kSoftInk, room);
    y += kSoftLine;
  }
}

}  // namespace etude
