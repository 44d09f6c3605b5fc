#include "reports/transitions/distance_table.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "reports/words/escape.h"
#include "reports/words/figures.h"

namespace etude {
namespace {

/// What share of the threshold's square this feature alone takes up; a full bar is all of it.
std::string Bar(double partial, double full, bool has_threshold) {
  const double share = full > 0 ? std::clamp(partial / full, 0.0, 1.0) : 0;
  const bool alone = has_threshold && partial >= full;
  return fmt::format("<td class=\"n\">{}<i class=\"{}\" style=\"width:{:.0f}%\"></i></td>",
                     partial < kLeastShown ? "0" : FormatFixed(partial, 3), alone ? "over" : "", 100 * share);
}

std::string DistanceWords(double distance, std::optional<double> threshold) {
  if (!threshold) return FormatFixed(distance, 3);
  return fmt::format("{} {} {}", FormatFixed(distance, 3), distance < *threshold ? "&lt;" : "≥",
                     fmt::format("{:g}", *threshold));
}

}  // namespace

void DistanceTable::AddWeights(const std::string& method, const FeatureWeights& weights) {
  const auto known = std::ranges::find(weights_, weights, &std::pair<std::string, FeatureWeights>::second);
  if (known == weights_.end()) {
    weights_.emplace_back(method, weights);
  } else {
    known->first += ", " + method;
  }
}

void DistanceTable::AddPoint(const std::string& method, const PointFacts& point, std::optional<double> threshold) {
  points_.push_back({method, point, threshold});
}

std::string DistanceTable::Html() const {
  if (points_.empty()) return "";
  std::string html =
      "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"Partial distances\"><table class=\"partials\">"
      "<thead><tr><th scope=\"col\">Partial distances S·Δ²</th>";
  for (const Feature feature : AllFeatures()) {
    html += fmt::format("<th scope=\"col\" class=\"n\">{}</th>", FeatureName(feature));
  }
  html += "<th scope=\"col\" class=\"n\">Sum d²</th><th scope=\"col\" class=\"n\">d</th></tr></thead><tbody>";
  for (const auto& [methods, weights] : weights_) {
    const bool shared_by_all = weights_.size() == 1;
    html +=
        fmt::format("<tr class=\"weights\"><td>weight S{}</td>", shared_by_all ? "" : EscapeMarkup(" of " + methods));
    for (const double weight : weights) html += fmt::format("<td class=\"n\">{:.3g}</td>", weight);
    html += fmt::format("<td class=\"n\">{}</td><td></td></tr>",
                        fmt::format("{:.3g}", std::accumulate(weights.begin(), weights.end(), 0.0)));
  }
  for (const Point& point : points_) {
    const PerFeature& partials = *point.facts.partials;
    const double sum = std::accumulate(partials.begin(), partials.end(), 0.0);
    const double full = point.threshold ? *point.threshold * *point.threshold : std::ranges::max(partials);
    const std::string clips = point.facts.from.empty() ? "" : fmt::format("{} → {}", point.facts.from, point.facts.to);
    html += fmt::format("<tr><td>{}<small>{}</small></td>", EscapeMarkup(point.method), EscapeMarkup(clips));
    for (const double partial : partials) html += Bar(partial, full, point.threshold.has_value());
    html += fmt::format("<td class=\"n\">{}</td><td class=\"n\">{}</td></tr>", FormatFixed(sum, 3),
                        DistanceWords(point.facts.distance.value_or(std::sqrt(sum)), point.threshold));
  }
  return html + fmt::format(
                    "</tbody></table></div><p class=\"quiet legend\">They sum to d². A full bar alone reaches the "
                    "threshold; without one, it is the largest of its row. {}</p>",
                    EscapeMarkup(std::string(kFeatureLegend)));
}

}  // namespace etude
