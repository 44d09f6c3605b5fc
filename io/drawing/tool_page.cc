#include "io/drawing/tool_page.h"

#include <fmt/core.h>

#include "io/drawing/assets/assets.h"
#include "io/drawing/escape.h"
#include "io/drawing/marks.h"

namespace etude {

std::string WriteToolPage(const ToolPage& page, std::string_view content_html) {
  const bool has_script = !page.script.empty();
  std::string html = fmt::format(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta "
      "http-equiv=\"Content-Security-Policy\" "
      "content=\"default-src 'none'; style-src 'unsafe-inline'; img-src data:; media-src data:{5}\"><meta "
      "name=\"viewport\" content=\"width=device-width, initial-scale=1\"><meta name=\"color-scheme\" "
      "content=\"light dark\"><title>{0} · Etude</title><style>{1}{2}.plot.wide {{ max-width: none; "
      "}}</style></head>\n"
      "<body><main><header><p class=\"eyebrow\">Etude · {3}</p><h1>{0}</h1><p "
      "class=\"verdict\">{4}</p></header>",
      EscapeMarkup(page.title), ReportCss(), MarksCss(), page.kind, EscapeMarkup(page.verdict),
      has_script ? "; script-src 'unsafe-inline'" : "");
  html += content_html;
  html += fmt::format("<footer><dl><div><dt>Etude</dt><dd>{}</dd></div>", EscapeMarkup(page.version));
  if (!page.command.empty()) html += fmt::format("<div><dt>Command</dt><dd>{}</dd></div>", EscapeMarkup(page.command));
  html += "</dl></footer></main>";
  if (has_script) html += fmt::format("<script>{}</script>", page.script);
  return html + "</body></html>\n";
}

}  // namespace etude
