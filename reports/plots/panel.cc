#include "reports/plots/panel.h"

#include <fmt/core.h>

#include "reports/words/escape.h"

namespace etude {
namespace {

/// At most so many characters, an ellipsis counting as one; never within a character.
std::string Cut(std::string_view text, std::size_t most) {
  std::size_t characters = 0, end = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool begins = (static_cast<unsigned char>(text[i]) & 0xC0) != 0x80;
    if (begins && characters++ + 1 == most) end = i;
  }
  return characters <= most ? std::string(text) : std::string(text.substr(0, end)) + "…";
}

}  // namespace

std::string BeginPanel(double height, std::string_view words, std::string_view rest) {
  return fmt::format("<svg class=\"plot\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\"{}>", kPanelWidth, height,
                     EscapeMarkup(words), rest);
}

std::string UprightGrid(const Axis& axis) {
  std::string svg;
  for (const double tick : axis.Ticks()) {
    svg += fmt::format("<path d=\"M{} {:.1f}H{}\"/>", kPanelLeft, axis.At(tick), kPanelRight) +
           PanelText(kPanelLeft - 5, axis.At(tick) + 4, TickText(tick), "end");
  }
  return svg;
}

std::string LyingGrid(const Axis& axis, double top, double bottom) {
  std::string svg;
  for (const double tick : axis.Ticks()) {
    svg += fmt::format("<path d=\"M{:.1f} {}V{}\"/>", axis.At(tick), top, bottom) +
           PanelText(axis.At(tick), bottom + 13, TickText(tick), "middle");
  }
  return svg;
}

std::string PanelText(double x, double y, std::string_view text, std::string_view anchor, std::size_t most) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>", x, y, anchor,
                     EscapeMarkup(Cut(text, most)));
}

}  // namespace etude
