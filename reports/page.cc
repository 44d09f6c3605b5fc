#include "reports/page.h"

#include <fmt/core.h>

#include <span>

#include "reports/assets/assets.h"
#include "reports/badge.h"
#include "reports/escape.h"
#include "reports/figures.h"
#include "reports/scenario_card.h"

namespace etude {
namespace {

// Even if a name slipped past the escaping, the page may load nothing from anywhere.
constexpr std::string_view kPolicy =
    "default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'; img-src data:; media-src data:";

std::string DataUri(std::string_view type, const std::string& bytes) {
  const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
  return fmt::format("data:{};base64,{}", type, Base64(std::span(data, bytes.size())));
}

std::string Head(const RunData& run) {
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"{}\">"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">"
      "<meta name=\"color-scheme\" content=\"light dark\"><title>{} · Etude</title><style>{}</style></head>\n",
      kPolicy, EscapeMarkup(run.suite), ReportCss());
}

std::string Hero(const Media& media) {
  if (media.mp4.empty() && media.poster.png.empty()) {
    return fmt::format("<p class=\"quiet\">{}</p>", EscapeMarkup(media.why_no_film));
  }
  if (media.mp4.empty()) {
    return fmt::format("<figure class=\"hero\">{}<figcaption>{} {}</figcaption></figure>", ImageElement(media.poster),
                       EscapeMarkup(media.film_caption), EscapeMarkup(media.why_no_film));
  }
  return fmt::format(
      "<figure class=\"hero\"><video controls loop muted autoplay playsinline width=\"{}\" height=\"{}\" poster=\"{}\" "
      "src=\"{}\" aria-label=\"{}\"></video><figcaption>{}</figcaption></figure>",
      media.poster.width, media.poster.height, DataUri("image/png", media.poster.png), DataUri("video/mp4", media.mp4),
      EscapeMarkup(media.film_caption), EscapeMarkup(media.film_caption));
}

std::string Contents(const RunData& run, const std::vector<ScenarioFindings>& findings) {
  std::string html = "<nav aria-label=\"Questions\"><ol class=\"contents\">";
  for (std::size_t i = 0; i < run.scenarios.size(); ++i) {
    const ScenarioSummary& scenario = run.scenarios[i];
    html += fmt::format("<li><a href=\"#{}\"><span>{}</span>{}</a></li>", CardAnchor(i),
                        EscapeMarkup(scenario.question.empty() ? scenario.name : scenario.question),
                        VerdictBadge(findings[i].answer.verdict));
  }
  return html + "</ol></nav>";
}

constexpr std::string_view kHowToRead = R"(<section class="how"><h2>How to read this</h2>
<p>A <b>world</b> is one simulated trial whose truth is known; every method meets the same worlds, so differences are
taken world by world. Each dot is the median over the worlds (the mean, where it is a share), its bar the 95 % bootstrap
interval. <b>Better</b> and <b>worse</b> mean that the interval of the difference lies clear of zero and matters in
practice; <b>no difference</b>, that it lies within what would matter; <b>inconclusive</b>, that more worlds would be
needed. Whatever failed is counted and named; a missing value is shown as —, never as zero.</p></section>
)";

std::string Footer(const RunData& run, bool has_film) {
  std::string html = "<footer><dl>";
  const auto entry = [&](std::string_view name, const std::string& value) {
    if (!value.empty()) html += fmt::format("<div><dt>{}</dt><dd>{}</dd></div>", name, EscapeMarkup(value));
  };
  entry("Etude", run.program_version);
  entry("Seed", fmt::format("{}", run.seed));
  entry("Took", run.wall_seconds > 0 ? FormatNumber(run.wall_seconds) + " s" : "");
  entry("Machine", run.host);
  entry("Command", run.command_line);
  html +=
      "</dl><p>All tables as CSV: <code>report/tables/</code>; recovered motions as BVH, pictures with depth and "
      "labels as EXR beside them.";
  if (has_film) html += " The film as a file: <code>video/etude.mp4</code>.";
  return html + "</p></footer>";
}

}  // namespace

std::string WritePage(const RunData& run, const Media& media) {
  std::vector<ScenarioFindings> findings;
  for (const ScenarioSummary& scenario : run.scenarios) findings.push_back(FindingsOf(run, scenario));

  std::string html = Head(run);
  html += fmt::format(
      "<body><a class=\"skip\" href=\"#{}\">Skip to the answers</a><main><header><p class=\"eyebrow\">Etude"
      "</p><h1>The {} suite</h1><p class=\"verdict\">{}</p></header>",
      CardAnchor(0), EscapeMarkup(run.suite), EscapeMarkup(FindingsOf(run).sentence));
  html += Hero(media);
  html += Contents(run, findings);
  for (std::size_t i = 0; i < run.scenarios.size(); ++i) html += WriteScenarioCard(run, i, findings[i], media);
  html += kHowToRead;
  html += Footer(run, !media.mp4.empty());
  html += "</main><script>";
  html += ChartJs();
  html += "</script><script>";
  html += ReportJs();
  html += "</script></body></html>\n";
  return html;
}

}  // namespace etude
