#pragma once

#include <string>
#include <vector>

#include "io/drawing/canvas.h"

namespace etude {

/// The colours of films, in one place so that all panels look alike.
inline constexpr Paint kBackdrop{0.078, 0.090, 0.102, 1};
inline constexpr Paint kInk{0.95, 0.955, 0.96, 1};
inline constexpr Paint kSoftInk{0.80, 0.83, 0.85, 1};
inline constexpr Paint kAccent{0.42, 0.76, 0.80, 1};
inline constexpr Paint kWarm{0.96, 0.68, 0.33, 1};
inline constexpr int kPanelRadius = 10;

/// Returns the colour of the method with this index in the scenario; the page uses the same colour
/// (io/drawing/marks.h).
Paint MethodPaint(std::size_t method);

/// Draws a small label in the upper left corner that says what the panel shows. `free` pixels to the right of the label
/// stay free.
void DrawTag(Canvas& canvas, const Box& panel, const std::string& text, double free = 0);

/// Draws a small bright label in the upper right corner for an event that has just happened.
void DrawMark(Canvas& canvas, const Box& panel, const std::string& text);

/// Breaks words into lines no wider than `room`; a single word may be wider.
std::vector<std::string> LinesOf(const Canvas& canvas, const std::string& words, double size, double room, bool bold);

/// Draws `strong` (bold, may be empty) and, below it, `soft` in the lower left corner over a soft shade, in as many
/// lines as the texts need.
void DrawCaption(Canvas& canvas, const Box& panel, const std::string& strong, const std::string& soft);

}  // namespace etude
