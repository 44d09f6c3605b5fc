#include "engine/retargeting/map_file.h"

#include <algorithm>
#include <utility>

#include "engine/base/names.h"
#include "engine/base/text.h"
#include "engine/document/fields.h"
#include "engine/document/node.h"
#include "engine/retargeting/marker_sets.h"

namespace etude {
namespace {

std::vector<std::string> AllRoleNames() {
  std::vector<std::string> names;
  for (const Role role : AllRoles()) names.emplace_back(RoleName(role));
  return names;
}

}  // namespace

std::string QuotedInYaml(std::string_view name) {
  std::string quoted = "\"";
  for (const char c : name) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') quoted += '\\';
    if (code < 0x20 || code == 0x7f) {
      quoted += fmt::format("\\x{:02x}", code);
    } else {
      quoted += c;
    }
  }
  return quoted + "\"";
}

Result<double> ReadUnit(std::string_view text, const Place& place) {
  constexpr std::pair<std::string_view, double> kNames[] = {{"m", 1},       {"cm", 0.01},   {"mm", 0.001},
                                                            {"in", 0.0254}, {"ft", 0.3048}, {"cmu", 0.0254 / 0.45}};
  for (const auto& [name, metres] : kNames) {
    if (text == name) return metres;
  }
  constexpr double kMin_m = 1e-6, kMax_m = 1e3;
  const auto metres = ParseNumber<double>(text);
  if (metres && *metres >= kMin_m && *metres <= kMax_m) return *metres;
  return Fail(place, "{} is not a unit; allowed: m, cm, mm, in, ft, cmu (5.64 cm), or the metres in one unit",
              Quote(text));
}

Result<JointMapOverrides> ReadJointMapFile(std::string_view yaml, const std::string& file) {
  // Read unit, up axis and rate.
  ASSIGN_OR_RETURN(const auto document, ParseYaml(yaml, file));
  Fields fields(document, "a joint map");
  const Node* roles = fields.Raw("roles");
  const Node* unit = fields.Raw("unit");
  const std::string up = fields.Choice("up", {"y", "z"}, "");
  constexpr double kMinRate_hz = 0.1, kMaxRate_hz = 10'000;
  JointMapOverrides taught;
  taught.rate_hz = fields.OptionalNumber("rate", {kMinRate_hz, kMaxRate_hz});
  taught.keep_floor = fields.Choice("keep_floor", {"true", "false"}, "false") == "true";
  taught.marker_set = fields.Choice("marker_set", MarkerSetKeys(), "");
  RETURN_IF_ERROR(fields.Finish());
  if (!up.empty()) taught.up = up == "z" ? UpAxis::kZ : UpAxis::kY;
  if (unit != nullptr) {
    ASSIGN_OR_RETURN(taught.metres_per_unit, ReadUnit(unit->scalar, unit->place));
  }
  // Read the roles. The key `roles` may be missing if the file has at least one of the other keys.
  const bool tells_else = unit != nullptr || taught.up || taught.rate_hz || taught.keep_floor ||
                          !taught.marker_set.empty();
  if (roles == nullptr && tells_else) return taught;
  if (roles == nullptr || roles->kind != Node::Kind::kMapping || roles->entries.empty()) {
    return Fail(roles == nullptr ? document.place : roles->place,
                "'roles' must map roles to joint names (left_elbow: LForeArm), found {}",
                roles == nullptr ? "nothing" : Describe(*roles));
  }
  for (const Node::Entry& entry : roles->entries) {
    const std::optional<Role> role = FindRole(entry.key);
    if (!role) return Fail(entry.place, "{}", UnknownName("role", entry.key, AllRoleNames()));
    if (entry.value.kind != Node::Kind::kScalar) {
      return Fail(entry.value.place, "'{}' must be a joint's name, found {}", entry.key, Describe(entry.value));
    }
    taught.joints[*role] = {entry.value.scalar, entry.value.place};
  }
  return taught;
}

std::string WriteJointMapFile(const Skeleton& skeleton, const JointMap& map) {
  std::string text = "# Which joint plays which role. Roles that are left out are found automatically.\nroles:\n";
  for (const Role role : AllRoles()) {
    const int joint = map[role].joint;
    const std::string& name = skeleton.joints[joint].name;
    const bool is_composed = std::ranges::find(map.composed, role) != map.composed.end();
    if (is_composed) {
      text += fmt::format("  # {}: the file has no such joint; Etude uses a point fixed to {}\n", RoleName(role),
                          QuotedInYaml(name));
    } else if (skeleton.Find(name) != joint) {
      text += fmt::format("  # {}: the joint {}, but not the first joint with this name\n", RoleName(role),
                          QuotedInYaml(name));
    } else {
      text += fmt::format("  {}: {}\n", RoleName(role), QuotedInYaml(name));
    }
  }
  text += "# Joints without a role:\n";
  for (std::size_t i = 0; i < skeleton.joints.size(); ++i) {
    const bool is_used =
        std::ranges::any_of(map.points, [&](const RolePoint& point) { return point.joint == static_cast<int>(i); });
    if (!is_used) text += fmt::format("#   {}\n", QuotedInYaml(skeleton.joints[i].name));
  }
  return text;
}

}  // namespace etude
