#include "engine/retargeting/map_file.h"

#include <algorithm>

#include "engine/base/names.h"
#include "engine/document/fields.h"
#include "engine/document/node.h"

namespace etude {
namespace {

std::vector<std::string> AllRoleNames() {
  std::vector<std::string> names;
  for (const Role role : AllRoles()) names.emplace_back(RoleName(role));
  return names;
}

/// Puts a name in double quotes, as YAML reads it back.
std::string Quoted(std::string_view name) {
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

}  // namespace

Result<TaughtRoles> ReadJointMapFile(std::string_view yaml, const std::string& file) {
  ASSIGN_OR_RETURN(const auto document, ParseYaml(yaml, file));
  Fields fields(document, "a joint map");
  const Node* roles = fields.Raw("roles");
  RETURN_IF_ERROR(fields.Finish());
  if (roles == nullptr || roles->kind != Node::Kind::kMapping || roles->entries.empty()) {
    return Fail(roles == nullptr ? document.place : roles->place,
                "'roles' must name joints (left_elbow: LForeArm), found {}",
                roles == nullptr ? "nothing" : Describe(*roles));
  }
  TaughtRoles taught;
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
  std::string text = "# Which joint plays which role. Roles that are left out are found by themselves.\nroles:\n";
  for (const Role role : AllRoles()) {
    const int joint = map[role].joint;
    const std::string& name = skeleton.joints[joint].name;
    const bool is_composed = std::ranges::find(map.composed, role) != map.composed.end();
    if (is_composed) {
      text += fmt::format("  # {}: no joint; a point that rides on {}\n", RoleName(role), Quoted(name));
    } else if (skeleton.Find(name) != joint) {
      text += fmt::format("  # {}: the joint {} that is not the first of this name\n", RoleName(role), Quoted(name));
    } else {
      text += fmt::format("  {}: {}\n", RoleName(role), Quoted(name));
    }
  }
  text += "# Joints without a role:\n";
  for (std::size_t i = 0; i < skeleton.joints.size(); ++i) {
    const bool is_used =
        std::ranges::any_of(map.points, [&](const RolePoint& point) { return point.joint == static_cast<int>(i); });
    if (!is_used) text += fmt::format("#   {}\n", Quoted(skeleton.joints[i].name));
  }
  return text;
}

}  // namespace etude
