#include "tools/clips/clip_facts.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "engine/base/names.h"
#include "io/clips/body_in_place.h"
#include "io/drawing/numbers.h"

namespace etude {
namespace {

/// Returns the name of a material: "Fur", or "Fur (texture of 1024 x 1024)".
std::string NameOf(const Material& material) {
  if (!material.texture) return material.name;
  const ColourImage& picture = material.texture->picture;
  return fmt::format("{} (texture of {} x {})", material.name, picture.width, picture.height);
}

FigureFacts FactsOfFigure(const Character& figure) {
  FigureFacts facts;
  facts.meshes = figure.meshes.size();
  if (figure.meshes.empty()) return facts;
  for (const SkinnedMesh& mesh : figure.meshes) facts.triangles += mesh.triangles.size();
  for (const Material& material : figure.materials) facts.materials.push_back(NameOf(material));
  return facts;
}

void CountJoints(const Skeleton& skeleton, ClipFacts& facts) {
  facts.end_sites = static_cast<std::size_t>(std::ranges::count_if(skeleton.joints, &Joint::is_end_site));
  facts.joints = skeleton.joints.size() - facts.end_sites;
}

ClipFacts FactsOfSource(const SourceClip& source) {
  ClipFacts facts;
  facts.name = source.name;
  facts.source = source.source;
  facts.format = source.format;
  facts.frames = source.clip.frames.size();
  facts.rate_hz = source.clip.rate_hz;
  facts.duration_s = source.clip.DurationSeconds();
  CountJoints(source.clip.skeleton, facts);
  if (source.character) facts.figure = FactsOfFigure(*source.character);
  return facts;
}

BodyFacts FactsOfBody(const OpenedClip& clip) {
  const BodyConversion& body = clip.body;
  BodyFacts facts{.joints = {},
                  .composed = clip.map.composed,
                  .unit = body.unit,
                  .metres_per_unit = body.metres_per_unit,
                  .up = body.found_up,
                  .floor = body.floor,
                  .dropped_t_pose = body.dropped_frames > 0,
                  .changes = body.changes,
                  .motion = ComputeStatistics(body.motion)};
  for (const Role role : AllRoles()) {
    facts.joints[Index(role)] = clip.source.clip.skeleton.joints[clip.map[role].joint].name;
  }
  if (clip.source.made) facts.markers = clip.source.made->markers;
  return facts;
}

/// Collects the facts of a file from which no clip could be read.
ClipFacts FactsWithoutClip(const std::string& reference, const OpenOptions& options, Error complaint) {
  ClipFacts facts;
  facts.name = facts.source = reference;
  facts.complaint = std::move(complaint);
  const auto file = ReadClipFile(reference, std::nullopt, options);
  if (!file) return facts;
  facts.format = file->format;
  CountJoints(file->figure.skeleton, facts);
  facts.figure = FactsOfFigure(file->figure);
  return facts;
}

/// Returns sentences about the faults that were found in the motion.
std::vector<std::string> RemarksOf(const BodyFacts& body) {
  return body.faults ? FaultSentences(body.faults->faults) : std::vector<std::string>();
}

Json JsonOf(const MotionFaults& found) {
  Json faults = Json::array();
  for (const MotionFault& fault : found.faults) {
    faults.push_back({{"kind", FaultName(fault.kind)},
                      {"from_s", fault.from_s},
                      {"to_s", fault.to_s},
                      {"joint", fault.joint ? Json(RoleName(*fault.joint)) : Json()},
                      {"size", fault.size},
                      {"unit", FaultUnit(fault.kind)},
                      {"text", fault.text}});
  }
  return {{"floor_m", found.floor_m}, {"floor_is_found", found.is_floor_found}, {"list", std::move(faults)}};
}

Json OrNull(const std::optional<double>& value) { return value ? Json(*value) : Json(); }

/// Returns "y", "-z", …
std::string AxisLetter(const glm::dvec3& axis) {
  const bool is_negative = axis.x + axis.y + axis.z < 0;
  return std::string(is_negative ? "-" : "") + (axis.x != 0 ? "x" : axis.y != 0 ? "y" : "z");
}

Json JsonOf(const BodyFacts& body) {
  // Write the joint of each role.
  Json roles = Json::object();
  for (const Role role : AllRoles()) {
    const bool composed = std::ranges::find(body.composed, role) != body.composed.end();
    Json& shown = roles[std::string(RoleName(role))];
    shown = {{"joint", body.joints[Index(role)]}, {"composed", composed}};
    if (HasMarkers(body.markers)) shown["markers"] = body.markers[Index(role)];
  }
  // Write the facts of the whole body: unit and axes, then the motion.
  const MotionStatistics& motion = body.motion;
  const FootSlide& slide = motion.foot_slide;
  return {{"unit", body.unit},
          {"metres_per_unit", body.metres_per_unit},
          {"up", AxisLetter(body.up.axis)},
          {"up_evidence", UpEvidenceName(body.up.evidence)},
          {"up_doubt", body.up.doubt.empty() ? Json() : Json(body.up.doubt)},
          {"floor_units", body.floor},
          {"dropped_t_pose", body.dropped_t_pose},
          {"changes", body.changes},
          {"note", Join(body.changes, "; ")},
          {"stature_m", motion.stature_m},
          {"travelled_m", motion.travelled_m},
          {"speed_median_m_s", motion.speed_median_m_s},
          {"speed_p95_m_s", motion.speed_p95_m_s},
          {"speed_peak_m_s", motion.speed_peak_m_s},
          {"fastest", RoleName(motion.fastest)},
          {"foot_slide_m_s", OrNull(slide.mean)},
          {"foot_slide_left_m_s", OrNull(slide.of_foot[0])},
          {"foot_slide_right_m_s", OrNull(slide.of_foot[1])},
          {"stance_left_share", slide.stance_share[0]},
          {"stance_right_share", slide.stance_share[1]},
          {"lowest_foot_m", motion.lowest_foot_m},
          {"faults", body.faults ? JsonOf(*body.faults) : Json()},
          {"remarks", RemarksOf(body)},
          {"roles", std::move(roles)}};
}

Json JsonOf(const ClipFacts& facts) {
  const bool is_read = facts.format.has_value();
  Json json = {{"name", facts.name},
               {"source", facts.source},
               {"format", is_read ? Json(FormatName(*facts.format)) : Json()},
               {"complaint", facts.complaint ? Json(ToString(*facts.complaint)) : Json()}};
  if (!is_read) return json;
  json["frames"] = facts.frames;
  json["rate_hz"] = facts.frames > 0 ? Json(facts.rate_hz) : Json();
  json["duration_s"] = facts.duration_s;
  json["joints"] = facts.joints;
  json["end_sites"] = facts.end_sites;
  json["meshes"] = facts.figure.meshes;
  json["triangles"] = facts.figure.triangles;
  json["materials"] = facts.figure.materials;
  json["body"] = facts.body ? JsonOf(*facts.body) : Json();
  return json;
}

constexpr std::size_t kLineWidth = 110;

std::string Line(const std::string& title, const std::string& text) { return fmt::format("  {:<8} {}\n", title, text); }

/// Writes items one after the other, in as many lines as the items need.
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

std::string CmPerSecond(const std::optional<double>& speed_m_s) {
  return speed_m_s ? fmt::format("{:.1f} cm/s", 100 * *speed_m_s) : std::string(kNoValue);
}

std::string DescribeEvidence(const UpFinding& up) {
  return up.evidence == UpEvidence::kTold ? "told" : up.source.empty() ? "by itself" : up.source;
}

std::string BodyLines(const BodyFacts& body) {
  const MotionStatistics& motion = body.motion;
  const FootSlide& slide = motion.foot_slide;
  std::string feet = "no foot is ever on the floor";
  if (slide.mean) {
    feet = "feet on the floor slide " + CmPerSecond(slide.mean);
    if (slide.of_foot[0] && slide.of_foot[1]) {
      feet += fmt::format(" (left {}, right {})", CmPerSecond(slide.of_foot[0]), CmPerSecond(slide.of_foot[1]));
    }
  }
  std::string remarks;
  for (const std::string& remark : RemarksOf(body)) remarks += Line("remark", remark);
  // The first change (the unit or the marker set) is printed beside the stature; every other change gets its own line.
  std::string changes;
  for (std::size_t i = 1; i < body.changes.size(); ++i) changes += Line("changed", body.changes[i]);
  return Line("body", fmt::format("height {:.2f} m, measured along the joints; {}; {} up ({})", motion.stature_m,
                                  body.changes.front(), AxisName(body.up.axis), DescribeEvidence(body.up))) +
         changes +
         Line("motion", fmt::format("travels {:.1f} m; speed of the fastest joint: median {:.2f}, 95th percentile "
                                    "{:.2f}, peak {:.2f} m/s ({}); {}",
                                    motion.travelled_m, motion.speed_median_m_s, motion.speed_p95_m_s,
                                    motion.speed_peak_m_s, RoleName(motion.fastest), feet)) +
         remarks;
}

std::vector<std::string> RoleItems(const BodyFacts& body) {
  std::vector<std::string> items;
  for (const Role role : AllRoles()) {
    if (HasMarkers(body.markers)) {
      items.push_back(fmt::format("{} = {}", RoleName(role), DescribeMarkers(body.markers[Index(role)])));
      continue;
    }
    const bool composed = std::ranges::find(body.composed, role) != body.composed.end();
    items.push_back(
        fmt::format("{} {}{}", RoleName(role), composed ? "composed on " : "= ", Quote(body.joints[Index(role)])));
  }
  return items;
}

}  // namespace

std::string DescribeMarkers(const std::vector<std::string>& markers) {
  std::vector<std::string> quoted;
  for (const std::string& marker : markers) quoted.push_back(Quote(marker));
  return quoted.empty() ? "by rule" : Join(quoted, " + ");
}

bool HasMarkers(const std::array<std::vector<std::string>, kRoleCount>& markers) {
  return std::ranges::any_of(markers, [](const auto& of_role) { return !of_role.empty(); });
}

std::vector<ClipFacts> FactsOf(const std::string& reference, const OpenOptions& options) {
  OpenOptions with_gaps = options;  // keep gaps, so that joints that the file does not show have no faults
  with_gaps.keeps_shown = with_gaps.keeps_others = true;
  auto clips = ReadClips(reference, with_gaps);
  if (!clips) return {FactsWithoutClip(reference, options, clips.error())};
  std::vector<ClipFacts> all;
  for (SourceClip& clip : *clips) {
    ClipFacts facts = FactsOfSource(clip);
    auto faults = FaultsOf(clip, options);
    const auto opened = UnderstandClip(std::move(clip), options);
    if (opened) {
      facts.body = FactsOfBody(*opened);
      facts.body->faults = std::move(faults);
    } else {
      facts.complaint = opened.error();
    }
    all.push_back(std::move(facts));
  }
  return all;
}

ClipFacts FactsOf(const OpenedClip& clip) {
  ClipFacts facts = FactsOfSource(clip.source);
  facts.body = FactsOfBody(clip);
  return facts;
}

std::optional<MotionFaults> FaultsOf(const SourceClip& clip, const OpenOptions& options) {
  const auto body = BodyInPlaceOf(clip, options);
  if (!body) return std::nullopt;
  return FindFaultsInPlace(*body).found;
}

Json FactsAsJson(const std::vector<ClipFacts>& facts) {
  Json clips = Json::array();
  for (const ClipFacts& clip : facts) clips.push_back(JsonOf(clip));
  return {{"clips", std::move(clips)}};
}

std::string FactsAsText(const ClipFacts& facts, const ClipFacts* before) {
  std::string text = facts.name == facts.source ? facts.name : fmt::format("{}  ({})", facts.name, facts.source);
  text += "\n";
  if (facts.format) text += FileLine(facts) + FigureLine(facts.figure);
  if (facts.body) {
    text += BodyLines(*facts.body);
    const bool as_before = before != nullptr && before->body && before->body->joints == facts.body->joints &&
                           before->body->markers == facts.body->markers;
    text += as_before ? Line("roles", "as above") : WrappedLine("roles", RoleItems(*facts.body));
  }
  if (facts.complaint) text += Line("but", facts.complaint->message);
  return text;
}

std::string FactsAsLine(const ClipFacts& facts) {
  std::string text = fmt::format("{} · {:.1f} s at {:.4g} Hz · {}", FormatName(*facts.format), facts.duration_s,
                                 facts.rate_hz, Plural(static_cast<long long>(facts.joints), "joint"));
  if (!facts.body) return text;
  return text + fmt::format(" · {:.2f} m tall · feet slide {} · {}", facts.body->motion.stature_m,
                            CmPerSecond(facts.body->motion.foot_slide.mean), Join(facts.body->changes, "; "));
}

}  // namespace etude
