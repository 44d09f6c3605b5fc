#include "engine/formats/json_text.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace etude {
namespace {

/// Returns the position of byte `index`, which may be the end of the text.
Place PlaceOf(std::string_view text, std::size_t index, const std::string& file) {
  const std::string_view before = text.substr(0, index);
  const std::size_t start = before.rfind('\n') + 1;  // 0 on the first line, where rfind returns npos
  return {file, static_cast<int>(1 + std::ranges::count(before, '\n')), static_cast<int>(before.size() - start + 1)};
}

}  // namespace

Result<nlohmann::json> ParseJsonText(std::string_view text, const std::string& file) {
  if (const std::size_t zero = text.find('\0'); zero != std::string_view::npos) {
    return Fail(PlaceOf(text, zero, file), "found a zero byte; allowed: JSON text without zero bytes");
  }
  try {
    return nlohmann::json::parse(text);
  } catch (const nlohmann::json::parse_error& error) {
    const std::size_t index = error.byte == 0 ? 0 : error.byte - 1;  // the parser counts from 1
    return Fail(PlaceOf(text, std::min(index, text.size()), file), "from this place on, the text is not valid JSON");
  } catch (const nlohmann::json::exception& error) {
    return Fail({file, 0, 0}, "no readable JSON: {}", error.what());
  }
}

}  // namespace etude
