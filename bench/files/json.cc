#include "bench/files/json.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

namespace etude {
namespace {

/// The path to the first number that JSON cannot hold.
std::optional<std::string> FindNonFinite(const Json& json) {
  if (json.is_number_float()) return std::isfinite(json.get<double>()) ? std::nullopt : std::optional<std::string>("");
  if (!json.is_structured()) return std::nullopt;
  for (auto it = json.begin(); it != json.end(); ++it) {
    if (const auto inner = FindNonFinite(it.value())) {
      const std::string step = json.is_object() ? it.key() : std::to_string(it - json.begin());
      return "/" + step + *inner;
    }
  }
  return std::nullopt;
}

}  // namespace

void DeleteJson::operator()(Json* json) const { delete json; }

Result<std::string> WriteJson(const Json& json) {
  if (const auto path = FindNonFinite(json)) return Fail({}, "{} is not a finite number", *path);
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

int NestingOf(std::string_view text) {
  int depth = 0, deepest = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_string) {
      if (c == '\\') ++i;
      if (c == '"') in_string = false;
    } else if (c == '"') {
      in_string = true;
    } else if (c == '[' || c == '{') {
      deepest = std::max(deepest, ++depth);
    } else if (c == ']' || c == '}') {
      --depth;
    }
  }
  return deepest;
}

Result<Json> ReadJson(const std::string& text, const std::string& file, int line) {
  constexpr int kDeepest = 100;  // what walks over values recurses
  if (NestingOf(text) > kDeepest) return Fail({file, line, 0}, "nested more than {} deep", kDeepest);
  try {
    return Json::parse(text);
  } catch (const Json::exception& error) {
    return Fail({file, line, 0}, "not valid JSON: {}", error.what());
  }
}

}  // namespace etude
