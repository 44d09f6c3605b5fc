#include "engine/base/result.h"

#include "engine/base/utf8.h"

namespace etude {

std::string ToString(const Place& place) {
  if (place.line == 0) return place.file;
  if (place.column == 0) return fmt::format("{}:{}", place.file, place.line);
  return fmt::format("{}:{}:{}", place.file, place.line, place.column);
}

std::string ToString(const Error& error) {
  const std::string where = ToString(error.place);
  return Visible((error.kind == ErrorKind::kMachine ? "this machine: " : "") + (where.empty() ? "" : where + ": ") +
                 error.message);
}

}  // namespace etude
