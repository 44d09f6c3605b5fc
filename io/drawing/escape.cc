#include "io/drawing/escape.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cstddef>
#include <utility>

#include "engine/base/utf8.h"

namespace etude {
namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";

// Returns the character at the start of `text`; the result's length is 0 if XML 1.0 forbids the character.
Utf8Character AllowedCharacter(std::string_view text) {
  const Utf8Character character = FirstCharacter(text);
  const bool is_control =
      character.code < ' ' && character.code != '\t' && character.code != '\n' && character.code != '\r';
  return is_control || character.code == 0xFFFE || character.code == 0xFFFF ? Utf8Character() : character;
}

constexpr std::pair<char, const char*> kMarkup[] = {
    {'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}, {'\'', "&#39;"}};

using LatexRow = std::pair<std::string_view, std::string_view>;
constexpr std::array<LatexRow, 45> kLatex{{
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
    {"⁰", "$^0$"},
    {"¹", "$^1$"},
    {"²", "$^2$"},
    {"³", "$^3$"},
    {"⁴", "$^4$"},
    {"⁵", "$^5$"},
    {"⁶", "$^6$"},
    {"⁷", "$^7$"},
    {"⁸", "$^8$"},
    {"⁹", "$^9$"},
    {"⁻", "$^-$"},
    {"·", "$\\cdot$"},
    {"…", "\\dots{}"},
    {"µ", "$\\mu$"},
    {"“", "``"},
    {"”", "''"},
    {"‘", "`"},
    {"’", "'"},
    {"†", "\\dag{}"},
}};

// Returns true for ASCII, and for Western letters with accents, which every LaTeX font can compose.
bool IsInEveryFont(char32_t code) {
  if (code < 0x80) return true;
  const bool needs_other_fonts =
      code == 0xD0 || code == 0xD7 || code == 0xDE || code == 0xF0 || code == 0xF7 || code == 0xFE;
  return code >= 0xC0 && code <= 0xFF && !needs_other_fonts;
}

// Returns true for Unicode's embeddings, overrides and isolates: these characters are invisible and reverse the text
// after them.
bool TurnsText(char32_t code) { return (code >= 0x202A && code <= 0x202E) || (code >= 0x2066 && code <= 0x2069); }

std::string LatexOf(std::string_view bytes, char32_t code) {
  for (const auto& [plain, latex] : kLatex) {
    if (plain == bytes) return std::string(latex);
  }
  return IsInEveryFont(code) ? std::string(bytes) : NumberOf(code);
}

}  // namespace

std::string EscapeMarkup(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  while (!text.empty()) {
    // Replace a forbidden character or an invalid byte.
    const auto [code, length] = AllowedCharacter(text);
    if (length == 0) {
      out += kReplacement;
      text.remove_prefix(1);
      continue;
    }
    // Escape the characters of markup.
    const auto* const markup = std::ranges::find(kMarkup, text[0], &std::pair<char, const char*>::first);
    if (markup != std::end(kMarkup)) {
      out += markup->second;
    } else {
      out += TurnsText(code) ? NumberOf(code) : std::string(text.substr(0, length));
    }
    text.remove_prefix(length);
  }
  return out;
}

std::string EscapeScriptJson(std::string_view json) {
  std::string out;
  out.reserve(json.size());
  while (!json.empty()) {
    auto [code, length] = FirstCharacter(json);
    // Decode \uXXXX, so that escaped control characters are also recognised.
    if (code == '\\' && json.size() >= 6 && json[1] == 'u') {
      unsigned number = 0;
      std::from_chars(json.data() + 2, json.data() + 6, number, 16);
      code = number;
      length = 6;
    } else if (code == '\\' && json.size() >= 2) {
      length = 2;  // the character behind a backslash starts no escape of its own
    }
    length = std::max<std::size_t>(length, 1);
    if (code == '<' && length == 1) {
      out += "\\u003c";  // in JSON "<" occurs only inside strings, where \u003c has the same meaning
    } else if (TurnsText(code)) {
      out += NumberOf(code);
    } else {
      out += json.substr(0, length);
    }
    json.remove_prefix(length);
  }
  return out;
}

std::string EscapeMarkdown(std::string_view text) {
  constexpr std::string_view kSpecial = "\\`*_[]<>#|&$~";
  std::string out;
  while (!text.empty()) {
    const auto [code, length] = AllowedCharacter(text);
    if (kSpecial.find(text[0]) != std::string_view::npos) out += '\\';
    if (length == 0) {
      out += kReplacement;
    } else if (code == '\n' || code == '\r') {
      out += ' ';
    } else if (TurnsText(code)) {
      out += EscapeMarkdown(NumberOf(code));
    } else {
      out += text.substr(0, length);
    }
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return out;
}

std::string EscapeLatex(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const auto [code, length] = AllowedCharacter(text);
    if (text[0] == '-' && out.ends_with('-')) out += "{}";  // LaTeX would make a dash of two hyphens
    out += length == 0 ? NumberOf(0xFFFD) : LatexOf(text.substr(0, length), code);
    text.remove_prefix(length == 0 ? 1 : length);
  }
  // In the first column of a table, LaTeX would read '[' or '*' as an option of the preceding line break.
  const std::size_t first = out.find_first_not_of(' ');
  const bool is_option = first != std::string::npos && (out[first] == '[' || out[first] == '*');
  return is_option ? "{}" + out : out;
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
