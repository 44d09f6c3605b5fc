#include "reports/words/escape.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <utility>

namespace etude {
namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";

// The length of the well-formed UTF-8 sequence at the start of `text` that XML 1.0 allows, or 0.
std::size_t CharacterLength(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  if (first < 0x80) return first >= 0x20 || first == '\t' || first == '\n' || first == '\r' ? 1 : 0;
  const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return 0;
  }
  // Overlong forms, surrogates, U+FFFE and U+FFFF, and what lies above U+10FFFF.
  if (first == 0xE0 && byte(1) < 0xA0) return 0;
  if (first == 0xED && byte(1) >= 0xA0) return 0;
  if (first == 0xEF && byte(1) == 0xBF && byte(2) >= 0xBE) return 0;
  if (first == 0xF0 && byte(1) < 0x90) return 0;
  if (first == 0xF4 && byte(1) >= 0x90) return 0;
  return length;
}

using LatexRow = std::pair<std::string_view, std::string_view>;
constexpr std::array<LatexRow, 31> kLatex{{
    {"\\", "\\textbackslash{}"},
    {"{", "\\{"},
    {"}", "\\}"},
    {"&", "\\&"},
    {"%", "\\%"},
    {"$", "\\$"},
    {"#", "\\#"},
    {"_", "\\_"},
    {"~", "\\textasciitilde{}"},
    {"^", "\\textasciicircum{}"},
    {"<", "\\textless{}"},
    {">", "\\textgreater{}"},
    {"|", "\\textbar{}"},
    {"\"", "''"},
    {"`", "\\textasciigrave{}"},
    {"\n", " "},
    {"\r", " "},
    {"\t", " "},
    {"−", "$-$"},
    {"–", "--"},
    {"—", "---"},
    {"×", "$\\times$"},
    {"±", "$\\pm$"},
    {"≤", "$\\le$"},
    {"≥", "$\\ge$"},
    {"°", "$^\\circ$"},
    {"“", "``"},
    {"”", "''"},
    {"‘", "`"},
    {"’", "'"},
    {"†", "\\dag{}"},
}};

// The number of the character whose well-formed UTF-8 `bytes` are.
unsigned CodePoint(std::string_view bytes) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(bytes[i]); };
  if (bytes.size() == 1) return byte(0);
  unsigned code = byte(0) & (0xFFu >> (bytes.size() + 1));
  for (std::size_t i = 1; i < bytes.size(); ++i) code = code << 6 | (byte(i) & 0x3Fu);
  return code;
}

// ASCII, and Western letters with their accents, which every LaTeX font can compose.
bool IsInEveryFont(unsigned code) {
  if (code < 0x80) return true;
  const bool needs_other_fonts =
      code == 0xD0 || code == 0xD7 || code == 0xDE || code == 0xF0 || code == 0xF7 || code == 0xFE;
  return code >= 0xC0 && code <= 0xFF && !needs_other_fonts;
}

std::string NumberOf(std::string_view character) { return fmt::format("[U+{:04X}]", CodePoint(character)); }

// Unicode's embeddings, overrides and isolates: unseen, they turn around what follows them.
bool TurnsText(std::string_view character) {
  if (character.size() != 3) return false;
  const unsigned code = CodePoint(character);
  return (code >= 0x202A && code <= 0x202E) || (code >= 0x2066 && code <= 0x2069);
}

std::string LatexOf(std::string_view character) {
  for (const auto& [plain, latex] : kLatex) {
    if (plain == character) return std::string(latex);
  }
  return IsInEveryFont(CodePoint(character)) ? std::string(character) : NumberOf(character);
}

}  // namespace

std::string EscapeMarkup(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  while (!text.empty()) {
    const std::size_t length = CharacterLength(text);
    if (length == 0) {
      out += kReplacement;
      text.remove_prefix(1);
      continue;
    }
    switch (text[0]) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&#39;";
        break;
      default:
        if (TurnsText(text.substr(0, length))) {
          out += NumberOf(text.substr(0, length));
        } else {
          out += text.substr(0, length);
        }
    }
    text.remove_prefix(length);
  }
  return out;
}

std::string EscapeScriptJson(std::string_view json) {
  std::string out;
  out.reserve(json.size());
  for (const char c : json) {
    // "<" stands only inside JSON strings, where its escape means the same.
    if (c == '<') {
      out += "\\u003c";
    } else {
      out += c;
    }
  }
  return out;
}

std::string EscapeMarkdown(std::string_view text) {
  constexpr std::string_view kSpecial = "\\`*_[]<>#|&$~";
  std::string out;
  while (!text.empty()) {
    const std::size_t length = std::max<std::size_t>(CharacterLength(text), 1);
    const std::string_view character = text.substr(0, length);
    if (kSpecial.find(text[0]) != std::string_view::npos) out += '\\';
    if (text[0] == '\n' || text[0] == '\r') {
      out += ' ';
    } else if (TurnsText(character)) {
      out += EscapeMarkdown(NumberOf(character));
    } else {
      out += character;
    }
    text.remove_prefix(length);
  }
  return out;
}

std::string EscapeLatex(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const std::size_t length = CharacterLength(text);
    if (text[0] == '-' && out.ends_with('-')) out += "{}";  // two hyphens would become a dash
    out += LatexOf(length == 0 ? kReplacement : text.substr(0, length));
    text.remove_prefix(length == 0 ? 1 : length);
  }
  // In a table's first column they would be taken for an option of the line break before them.
  const std::size_t first = out.find_first_not_of(' ');
  const bool is_option = first != std::string::npos && (out[first] == '[' || out[first] == '*');
  return is_option ? "{}" + out : out;
}

std::string EscapeCsv(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"') out += '"';
    out += c;
  }
  return out + '"';
}

std::string MotionFileOf(const std::string& cell) {
  std::string name = cell;
  std::ranges::replace(name, '/', '~');
  return name + ".bvh";
}

std::string UrlPath(std::string_view path) {
  std::string out;
  for (const char c : path) {
    const auto byte = static_cast<unsigned char>(c);
    const bool is_plain = std::isalnum(byte) != 0 || std::string_view("-_.~/").find(c) != std::string_view::npos;
    out += is_plain ? std::string(1, c) : fmt::format("%{:02X}", byte);
  }
  return out;
}

std::string FileNameOf(const std::string& scenario, std::size_t index) {
  std::string name = scenario;
  std::ranges::replace_if(
      name, [](unsigned char c) { return std::isalnum(c) == 0 && c != '-' && c != '_'; }, '_');
  return name == scenario ? name : fmt::format("{}-{}", name, index + 1);
}

std::string ShellWord(std::string_view text) {
  constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./=,:@%+-";
  if (!text.empty() && text.find_first_not_of(kPlain) == std::string_view::npos) return std::string(text);
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

}  // namespace etude
