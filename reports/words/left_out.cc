#include "reports/words/left_out.h"

#include <fmt/core.h>

#include "reports/words/escape.h"
#include "reports/words/figures.h"

namespace etude {

std::string LeftOutWords(std::size_t total, std::size_t shown, std::string_view things, std::string_view where) {
  if (total <= shown) return "";
  return fmt::format("{} more {} are left out here; {} has all.", FormatCount(static_cast<long long>(total - shown)),
                     things, where);
}

std::string LeftOutHtml(std::size_t total, std::size_t shown, std::string_view things, std::string_view where) {
  const std::string words = LeftOutWords(total, shown, things, where);
  return words.empty() ? "" : fmt::format("<p class=\"quiet legend\">{}</p>", EscapeMarkup(words));
}

}  // namespace etude
