#include "io/drawing/tool_page.h"

#include <fmt/core.h>

#include "io/drawing/assets/assets.h"
#include "io/drawing/escape.h"
#include "io/drawing/marks.h"

namespace etude {

std::string WriteToolPage(const ToolPage& page, std::string_view content_html) {
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta "
      "http-equiv=\"Content-Security-Policy\" "
      "content=\"default-src 'none'; style-src 'unsafe-inline'; img-src data:; media-src data:\"><meta "
      "name=\"viewport\" content=\"width=device-width, initial-scale=1\"><meta name=\"color-scheme\" "
      "content=\"light dark\"><title>{0} · Etude</title><style>{1}{2}.plot.wide {{ max-width: none; "
      "}}</style></head>\n"
      "<body><main><header><p class=\"eyebrow\">Etude · {3}</p><h1>{0}</h1><p "
      "class=\"verdict\">{4}</p></header>{5}"
      "<footer><dl><div><dt>Etude</dt><dd>{6}</dd></div><div><dt>Command</dt><dd>{7}</dd></div></dl></footer>"
      "</main></body></html>\n",
      EscapeMarkup(page.title), ReportCss(), MarksCss(), page.kind, EscapeMarkup(page.verdict), content_html,
      EscapeMarkup(page.version), EscapeMarkup(page.command));
}

}  // namespace etude
