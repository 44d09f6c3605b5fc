#include "engine/formats/length_units.h"

#include <utility>

#include "engine/base/text.h"

namespace etude {

std::optional<double> MetresOfUnit(std::string_view name) {
  constexpr std::pair<std::string_view, double> kUnits[] = {
      {"m", 1},        {"meter", 1},          {"meters", 1},          {"metre", 1},          {"metres", 1},
      {"cm", 0.01},    {"centimeter", 0.01},  {"centimeters", 0.01},  {"centimetre", 0.01},  {"centimetres", 0.01},
      {"mm", 0.001},   {"millimeter", 0.001}, {"millimeters", 0.001}, {"millimetre", 0.001}, {"millimetres", 0.001},
      {"in", 0.0254},  {"inch", 0.0254},      {"inches", 0.0254},     {"ft", 0.3048},        {"foot", 0.3048},
      {"feet", 0.3048}};
  for (const auto& [unit, metres] : kUnits) {
    if (EqualsIgnoringCase(unit, name)) return metres;
  }
  return std::nullopt;
}

}  // namespace etude
