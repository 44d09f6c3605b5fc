#include "reports/film_element.h"

#include <fmt/core.h>

#include <string_view>

#include "engine/base/base64.h"
#include "reports/words/escape.h"

namespace etude {
namespace {

std::string DataUri(std::string_view type, const std::string& bytes) {
  return fmt::format("data:{};base64,{}", type, Base64(bytes));
}

}  // namespace

std::string ImageElement(const Picture& picture) {
  return fmt::format("<img width=\"{}\" height=\"{}\" alt=\"{}\" src=\"{}\">", picture.width, picture.height,
                     EscapeMarkup(picture.caption), DataUri("image/png", picture.png));
}

std::string StillElement(const Still& still) {
  return fmt::format(
      "<figure><img alt=\"{0}\" src=\"data:image/jpeg;base64,{1}\"><figcaption>{0}</figcaption></figure>",
      EscapeMarkup(still.caption), still.jpeg_base64);
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
