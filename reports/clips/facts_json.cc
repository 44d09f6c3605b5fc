#include <algorithm>
#include <nlohmann/json.hpp>

#include "bench/files/json.h"
#include "reports/clips/clip_facts.h"

namespace etude {
namespace {

Json JsonOf(const BodyFacts& body) {
  Json roles = Json::object();
  for (const Role role : AllRoles()) {
    const bool composed = std::ranges::find(body.composed, role) != body.composed.end();
    roles[std::string(RoleName(role))] = {{"joint", body.joints[Index(role)]}, {"composed", composed}};
  }
  const MotionStatistics& motion = body.motion;
  return {{"unit", body.unit},
          {"metres_per_unit", body.metres_per_unit},
          {"up", body.up == UpAxis::kY ? "y" : "z"},
          {"floor_units", body.floor},
          {"dropped_t_pose", body.dropped_t_pose},
          {"note", body.note},
          {"stature_m", motion.stature_m},
          {"travelled_m", motion.travelled_m},
          {"speed_median_m_s", motion.speed_median_m_s},
          {"speed_p95_m_s", motion.speed_p95_m_s},
          {"speed_peak_m_s", motion.speed_peak_m_s},
          {"fastest", RoleName(motion.fastest)},
          {"foot_slide_m_s", motion.foot_slide_m_s},
          {"lowest_foot_m", motion.lowest_foot_m},
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

}  // namespace

Result<std::string> FactsAsJson(const std::vector<ClipFacts>& facts) {
  Json clips = Json::array();
  for (const ClipFacts& clip : facts) clips.push_back(JsonOf(clip));
  return WriteJson({{"schema_version", 1}, {"clips", std::move(clips)}});
}

}  // namespace etude
