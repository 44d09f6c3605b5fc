#include <fmt/core.h>

#include <algorithm>

#include "engine/base/names.h"
#include "reports/clips/clip_facts.h"
#include "reports/words/figures.h"

namespace etude {
namespace {

constexpr std::size_t kLineWidth = 110;

std::string Line(const std::string& title, const std::string& text) { return fmt::format("  {:<8} {}\n", title, text); }

/// Items behind each other, in as many lines as they need.
std::string WrappedLine(const std::string& title, const std::vector<std::string>& items) {
  std::string lines, line;
  for (const std::string& item : items) {
    if (!line.empty() && line.size() + 2 + item.size() > kLineWidth) {
      lines += Line(lines.empty() ? title : "", line + ",");
      line.clear();
    }
    line += (line.empty() ? "" : ", ") + item;
  }
  return lines + Line(lines.empty() ? title : "", line);
}

std::string FileLine(const ClipFacts& facts) {
  std::string text(FormatName(*facts.format));
  if (facts.frames > 0) {
    text += fmt::format(", {} at {:.6g} Hz, {:.2f} s", Plural(static_cast<long long>(facts.frames), "frame"),
                        facts.rate_hz, facts.duration_s);
  }
  text += "; " + Plural(static_cast<long long>(facts.joints), "joint");
  if (facts.end_sites > 0) text += ", " + Plural(static_cast<long long>(facts.end_sites), "end site");
  return Line("file", text);
}

std::string FigureLine(const FigureFacts& figure) {
  if (figure.meshes == 0) return "";
  const bool one = figure.meshes == 1;
  return Line("figure", fmt::format("{} mesh{}, {}; materials: {}", figure.meshes, one ? "" : "es",
                                    Plural(static_cast<long long>(figure.triangles), "triangle"),
                                    figure.materials.empty() ? std::string(kNoValue) : Join(figure.materials)));
}

std::string BodyLines(const BodyFacts& body) {
  const MotionStatistics& motion = body.motion;
  return Line("body",
              fmt::format("{:.2f} m tall; {}; {} up", motion.stature_m, body.note, body.up == UpAxis::kY ? "Y" : "Z")) +
         Line("motion",
              fmt::format("travels {:.1f} m; fastest joint: median {:.2f}, 95 % {:.2f}, peak {:.2f} m/s ({}); "
                          "feet slide {:.1f} cm/s",
                          motion.travelled_m, motion.speed_median_m_s, motion.speed_p95_m_s, motion.speed_peak_m_s,
                          RoleName(motion.fastest), 100 * motion.foot_slide_m_s));
}

std::vector<std::string> RoleItems(const BodyFacts& body) {
  std::vector<std::string> items;
  for (const Role role : AllRoles()) {
    const bool composed = std::ranges::find(body.composed, role) != body.composed.end();
    items.push_back(
        fmt::format("{} {}{}", RoleName(role), composed ? "composed on " : "= ", Quote(body.joints[Index(role)])));
  }
  return items;
}

}  // namespace

std::string FactsAsText(const ClipFacts& facts, const ClipFacts* before) {
  std::string text = facts.name == facts.source ? facts.name : fmt::format("{}  ({})", facts.name, facts.source);
  text += "\n";
  if (facts.format) text += FileLine(facts) + FigureLine(facts.figure);
  if (facts.body) {
    text += BodyLines(*facts.body);
    const bool as_before = before != nullptr && before->body && before->body->joints == facts.body->joints;
    text += as_before ? Line("roles", "as above") : WrappedLine("roles", RoleItems(*facts.body));
  }
  if (facts.complaint) text += Line("but", facts.complaint->message);
  return text;
}

std::string FactsAsLine(const ClipFacts& facts) {
  std::string text = fmt::format("{} · {:.1f} s at {:.4g} Hz · {}", FormatName(*facts.format), facts.duration_s,
                                 facts.rate_hz, Plural(static_cast<long long>(facts.joints), "joint"));
  if (!facts.body) return text;
  return text + fmt::format(" · {:.2f} m tall · feet slide {:.1f} cm/s · {}", facts.body->motion.stature_m,
                            100 * facts.body->motion.foot_slide_m_s, facts.body->note);
}

}  // namespace etude
