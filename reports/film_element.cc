#include "reports/film_element.h"

#include <fmt/core.h>

#include <span>
#include <string_view>

#include "reports/words/escape.h"

namespace etude {
namespace {

std::string DataUri(std::string_view type, const std::string& bytes) {
  const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
  return fmt::format("data:{};base64,{}", type, Base64(std::span(data, bytes.size())));
}

}  // namespace

std::string ImageElement(const Picture& picture) {
  return fmt::format("<img width=\"{}\" height=\"{}\" alt=\"{}\" src=\"{}\">", picture.width, picture.height,
                     EscapeMarkup(picture.caption), DataUri("image/png", picture.png));
}

std::string FilmElement(const Film& film, bool plays_at_once) {
  const Picture& poster = film.poster;
  if (film.mp4.empty() && poster.png.empty()) {
    return film.why_not.empty() ? "" : fmt::format("<p class=\"quiet\">{}</p>", EscapeMarkup(film.why_not));
  }
  const std::string caption = EscapeMarkup(poster.caption);
  if (film.mp4.empty()) {
    return fmt::format("<figure class=\"film\">{}<figcaption>{} {}</figcaption></figure>", ImageElement(poster),
                       caption, EscapeMarkup(film.why_not));
  }
  return fmt::format(
      "<figure class=\"film\"><video controls loop muted playsinline{} width=\"{}\" height=\"{}\" poster=\"{}\" "
      "src=\"{}\" aria-label=\"{}\"></video><figcaption>{} <code>video/{}</code></figcaption></figure>",
      plays_at_once ? " autoplay" : "", poster.width, poster.height, DataUri("image/png", poster.png),
      DataUri("video/mp4", film.mp4), caption, caption, EscapeMarkup(film.file));
}

}  // namespace etude
