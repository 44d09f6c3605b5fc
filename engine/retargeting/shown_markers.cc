#include "engine/retargeting/shown_markers.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "engine/retargeting/up_axis.h"

namespace etude {

RawMotion AsShown(double scale, const MarkerMotion& markers, const MarkerSet& set, const MarkerColumns& columns,
                  const std::vector<JointPositions>& seen, const glm::dvec3& up) {
  RawMotion shown;
  shown.rate_hz = markers.rate_hz;
  shown.start_s = markers.start_s;
  shown.notes = {"markers: " + set.name};
  if (scale != 1)
    shown.notes[0] += fmt::format("; by the height of the body, the unit is {:g} times the file's unit", scale);
  if (!markers.remark.empty()) shown.notes[0] += "; " + markers.remark;
  std::vector<std::size_t> own;
  for (const auto& [name, column] : columns) {
    const std::string& full = markers.names[column];
    const std::size_t begin = full.rfind(':') + 1;  // 0 without ':'
    const bool is_end = MarkerKey(full).ends_with(name);
    shown.joints.push_back(full.substr(is_end ? full.size() - name.size() : begin, name.size()));
    own.push_back(column);
  }
  // A role is played by the marker at its joint or, if the joint must be computed from markers, by a joint that is
  // added.
  std::vector<Role> computed;
  const bool is_on_skin = set.has_skin_limbs || set.has_skin_shoulders;
  for (const Role role : AllRoles()) {
    if (!Determines(set, columns, role)) continue;
    const auto is_it = [&](const MarkerRule& rule) { return rule.role == role && HasAll(columns, rule.markers); };
    const auto rule = std::ranges::find_if(set.rules, is_it);
    if (!is_on_skin && rule != set.rules.end() && rule->markers.size() == 1) {
      shown.roles[Index(role)] = static_cast<int>(std::distance(columns.begin(), columns.find(rule->markers[0])));
      continue;
    }
    computed.push_back(role);
    shown.roles[Index(role)] = static_cast<int>(shown.joints.size());
    shown.added.push_back(shown.roles[Index(role)]);
    shown.joints.emplace_back(RoleName(role));
  }
  shown.positions.reserve(markers.frames.size() * shown.joints.size());
  const auto add = [&](const MarkerPosition& place, double by) {
    shown.positions.push_back(place ? TurnedUp(by * *place, up) : NotSeen());
  };
  for (std::size_t t = 0; t < markers.frames.size(); ++t) {
    for (const std::size_t column : own) add(markers.frames[t][column], scale);
    for (const Role role : computed) add(seen[t][Index(role)], 1);
  }
  return shown;
}

}  // namespace etude
