#include "engine/base/names.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "engine/base/text.h"
#include "engine/base/utf8.h"

namespace etude {
namespace {

/// Returns the Damerau-Levenshtein distance in its "optimal string alignment" form, ignoring case.
int EditDistance(std::string_view a, std::string_view b) {
  const auto same = [](char x, char y) { return ToLower(x) == ToLower(y); };
  std::vector<std::vector<int>> cost(a.size() + 1, std::vector<int>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) cost[i][0] = static_cast<int>(i);
  for (std::size_t j = 0; j <= b.size(); ++j) cost[0][j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const int replace = same(a[i - 1], b[j - 1]) ? 0 : 1;
      cost[i][j] = std::min({cost[i - 1][j] + 1, cost[i][j - 1] + 1, cost[i - 1][j - 1] + replace});
      if (i > 1 && j > 1 && same(a[i - 1], b[j - 2]) && same(a[i - 2], b[j - 1])) {
        cost[i][j] = std::min(cost[i][j], cost[i - 2][j - 2] + 1);
      }
    }
  }
  return cost[a.size()][b.size()];
}

/// Latin letters and the combining mark that each consists of, together with the ASCII letter at the same place.
struct MarkedLetters {
  std::string_view mark, letters, marked;
};

constexpr MarkedLetters kMarkedLetters[] = {
    {"\u0300", "AEINOUaeinou", "ÀÈÌǸÒÙàèìǹòù"},
    {"\u0301", "ACEILNORSUYZaceilnorsuyz", "ÁĆÉÍĹŃÓŔŚÚÝŹáćéíĺńóŕśúýź"},
    {"\u0302", "ACEGHIJOSUWYaceghijosuwy", "ÂĈÊĜĤÎĴÔŜÛŴŶâĉêĝĥîĵôŝûŵŷ"},
    {"\u0303", "AINOUainou", "ÃĨÑÕŨãĩñõũ"},
    {"\u0304", "AEIOUaeiou", "ĀĒĪŌŪāēīōū"},
    {"\u0306", "AEGIOUaegiou", "ĂĔĞĬŎŬăĕğĭŏŭ"},
    {"\u0307", "CEGIZcegz", "ĊĖĠİŻċėġż"},
    {"\u0308", "AEIOUYaeiouy", "ÄËÏÖÜŸäëïöüÿ"},
    {"\u030a", "AUau", "ÅŮåů"},
    {"\u030b", "OUou", "ŐŰőű"},
    {"\u030c", "ACDEGIKLNORSTUZacdegiklnorstuz", "ǍČĎĚǦǏǨĽŇǑŘŠŤǓŽǎčďěǧǐǩľňǒřšťǔž"},
    {"\u0326", "STst", "ȘȚșț"},
    {"\u0327", "CGKLNRSTcgklnrst", "ÇĢĶĻŅŖŞŢçģķļņŗşţ"},
    {"\u0328", "AEIUaeiu", "ĄĘĮŲąęįų"},
};

/// Returns the text with each of these accented letters as one character (Unicode's form NFC), even if the text has it
/// as two (NFD, as in macOS's file names).
std::string Composed(std::string_view text) {
  std::string composed;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const auto* marked = std::ranges::find_if(kMarkedLetters, [&](const MarkedLetters& letters) {
      return text.substr(at + 1).starts_with(letters.mark) && letters.letters.find(text[at]) != std::string_view::npos;
    });
    if (marked == std::end(kMarkedLetters)) {
      composed += text[at];
      continue;
    }
    constexpr std::size_t kBytes = 2;  // of each marked letter and of each mark
    composed += marked->marked.substr(kBytes * marked->letters.find(text[at]), kBytes);
    at += kBytes;
  }
  return composed;
}

}  // namespace

std::string NearestName(std::string_view name, std::span<const std::string> known) {
  constexpr std::size_t kMaxComparedLength = 100;
  if (name.size() > kMaxComparedLength) return "";
  std::string best;
  int best_distance = 1 + static_cast<int>(name.size()) / 3;
  for (const std::string& candidate : known) {
    const int distance = EditDistance(name, candidate);
    if (distance <= best_distance && (best.empty() || distance < best_distance)) {
      best_distance = distance;
      best = candidate;
    }
  }
  return best;
}

std::string UnknownName(std::string_view kind, std::string_view name, std::span<const std::string> known) {
  const std::string nearest = NearestName(name, known);
  const std::string hint = nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest);
  constexpr std::size_t kMaxShown = 60;
  return fmt::format("unknown {} '{}'{} Allowed: {}", kind, name.substr(0, kMaxShown), nearest.empty() ? "." : hint,
                     Join(known));
}

std::string Join(std::span<const std::string> items, std::string_view separator) {
  return fmt::format("{}", fmt::join(items, separator));
}

std::string WithSpaces(std::string name) {
  std::ranges::replace(name, '_', ' ');
  return name;
}

std::string ComparedName(std::string_view name) {
  std::string letters;
  for (const char c : Composed(name)) {
    if (c != ' ') letters += ToLower(c);
  }
  return letters;
}

std::string Quote(std::string_view text) {
  if (text.empty()) return "the end of the line or file";
  constexpr std::size_t kShown = 40;
  std::string quoted = "'";
  std::size_t shown = 0, at = 0;
  for (; at < text.size() && shown < kShown; ++shown) {
    const auto [code, length] = FirstCharacter(text.substr(at));
    const bool is_seen = length > 0 && code >= ' ' && code != 0x7f && !IsHidden(code);
    quoted += is_seen ? text.substr(at, length) : "?";
    at += is_seen ? length : 1;
  }
  return quoted + (at < text.size() ? "…'" : "'");
}

}  // namespace etude
