#include "io/files/json.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "engine/base/utf8.h"
#include "io/files/files.h"

namespace etude {
namespace {

constexpr int kMaxNesting = 100;  // limits the recursion of functions that walk over values

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

/// Returns true if a CBOR value nests at most kMaxNesting deep and has no tags or indefinite lengths. Json::from_cbor
/// recurses for each level, so the depth is checked first. Truncated input is left to from_cbor, which detects
/// truncation.
bool IsShallowCbor(std::string_view bytes) {
  std::vector<std::uint64_t> open = {1};  // for each open list or map: the number of its values that are still to come
  for (std::size_t at = 0; at < bytes.size() && !open.empty();) {
    const auto first = static_cast<unsigned char>(bytes[at++]);
    const int kind = first >> 5;
    std::uint64_t count = first & 31;
    if (count >= 24) {
      if (count > 27) return false;
      std::uint64_t told = 0;
      for (std::size_t left = std::size_t{1} << (count - 24); left > 0 && at < bytes.size(); --left) {
        told = told << 8 | static_cast<unsigned char>(bytes[at++]);
      }
      count = told;
    }
    --open.back();
    if (kind == 2 || kind == 3) at += std::min<std::uint64_t>(count, bytes.size() - at);
    if (kind == 4) open.push_back(count);
    if (kind == 5) open.push_back(count > bytes.size() ? count : 2 * count);
    if (kind == 6 || open.size() > kMaxNesting + 1) return false;
    while (!open.empty() && open.back() == 0) open.pop_back();
  }
  return true;
}

/// Replaces invisible characters (IsHidden) by escaped code points, which give the same value when read.
std::string WithHiddenEscaped(std::string json) {
  const auto is_ascii = [](char c) { return static_cast<unsigned char>(c) < 0x80; };
  if (std::ranges::all_of(json, is_ascii)) return json;
  std::string escaped;
  for (std::string_view rest = json; !rest.empty();) {
    const auto [code, length] = FirstCharacter(rest);
    const auto number = static_cast<std::uint32_t>(code);
    if (!IsHidden(code)) {
      escaped += rest.substr(0, length);
    } else if (number < 0x10000) {
      escaped += fmt::format("\\u{:04x}", number);
    } else {
      escaped += fmt::format("\\u{:04x}\\u{:04x}", 0xd7c0 + (number >> 10), 0xdc00 + (number & 0x3ff));
    }
    rest.remove_prefix(length);
  }
  return escaped;
}

}  // namespace

void DeleteJson::operator()(Json* json) const { delete json; }

Result<std::string> WriteJson(const Json& json) {
  if (const auto path = FindNonFinite(json)) return Fail({}, "{} is not a finite number", *path);
  return WithHiddenEscaped(json.dump(-1, ' ', false, Json::error_handler_t::replace));
}

std::string ShowJson(const Json& json) {
  if (json.is_number_float() && !std::isfinite(json.get<double>())) return fmt::format("{}", json.get<double>());
  if (json.is_array()) return fmt::format("a list of {}", json.size());
  if (json.is_object()) return "an object";
  constexpr std::size_t kMaxShownLength = 40;
  std::string text = json.dump(-1, ' ', true, Json::error_handler_t::replace);  // ASCII, so no cut splits a character
  return text.size() <= kMaxShownLength ? text : text.substr(0, kMaxShownLength) + "…";
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
  if (NestingOf(text) > kMaxNesting) return Fail({file, line, 0}, "nested more than {} levels deep", kMaxNesting);
  // The parser stops at a zero byte and ignores what follows.
  if (text.find('\0') != std::string::npos)
    return Fail({file, line, 0}, "not valid JSON: the text contains a zero byte");
  try {
    return Json::parse(text);
  } catch (const Json::exception& error) {
    return Fail({file, line, 0}, "not valid JSON: {}", error.what());
  }
}

Result<Json> ReadJsonFile(const FilePath& path) {
  ASSIGN_OR_RETURN(const auto text, ReadWholeFile(path));
  return ReadJson(text, path.string());
}

Result<Json> ReadCbor(std::string_view bytes, const std::string& file) {
  if (!IsShallowCbor(bytes))
    return Fail({file}, "the file is not CBOR as Etude writes it, or it is nested more than {} levels deep",
                kMaxNesting);
  try {
    return Json::from_cbor(bytes);
  } catch (const Json::exception& error) {
    return Fail({file}, "not valid CBOR: {}", error.what());
  }
}

}  // namespace etude
