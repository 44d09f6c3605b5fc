#include "engine/base/result.h"

namespace etude {
namespace {

/// Replaces control characters by spaces, so that a quoted file cannot break the line or command a terminal.
std::string WithoutControls(std::string text) {
  for (char& c : text) {
    if ((c >= 0 && c < ' ') || c == 0x7f) c = ' ';
  }
  return text;
}

}  // namespace

std::string ToString(const Place& place) {
  if (place.line == 0) return place.file;
  if (place.column == 0) return fmt::format("{}:{}", place.file, place.line);
  return fmt::format("{}:{}:{}", place.file, place.line, place.column);
}

std::string ToString(const Error& error) {
  const std::string where = ToString(error.place);
  return WithoutControls(where.empty() ? error.message : where + ": " + error.message);
}

}  // namespace etude
