#include <fmt/core.h>

#include <algorithm>

#include "bench/files/files.h"
#include "cli/clip_commands.h"
#include "cli/clip_reading.h"
#include "cli/commands.h"
#include "cli/move_table.h"
#include "cli/output_file.h"
#include "engine/base/names.h"

namespace etude {
namespace {

void PrintRoles(const Skeleton& skeleton, const JointMap& map) {
  for (const Role role : AllRoles()) {
    const bool composed = std::ranges::find(map.composed, role) != map.composed.end();
    fmt::print("{:<16} {}{}\n", RoleName(role), Quote(skeleton.joints[map[role].joint].name),
               composed ? " (composed: no joint plays it, a point that rides on this one does)" : "");
  }
}

std::vector<std::string> UnusedJoints(const Skeleton& skeleton, const JointMap& map) {
  std::vector<std::string> unused;
  for (std::size_t i = 0; i < skeleton.joints.size(); ++i) {
    const auto plays = [&](const RolePoint& point) { return point.joint == static_cast<int>(i); };
    const Joint& joint = skeleton.joints[i];
    if (!joint.is_end_site && std::ranges::none_of(map.points, plays)) unused.push_back(Quote(joint.name));
  }
  return unused;
}

/// For a skeleton whose roles were not found: every role to be filled in, and the names to choose from.
std::string EmptyMapFile(const Skeleton& skeleton) {
  std::string text = "# Write the joint behind each role. Roles that are found anyway may be left out.\nroles:\n";
  for (const Role role : AllRoles()) text += fmt::format("  # {}:\n", RoleName(role));
  text += "# The joints of the file:\n";
  for (const Joint& joint : skeleton.joints) text += fmt::format("#   {}\n", Quote(joint.name));
  return text;
}

Result<void> Save(const ClipMapOptions& options, const std::string& text) {
  return options.output.empty() ? Result<void>() : WriteFileAtomically(options.output, text);
}

}  // namespace

int ClipMapCommand(const ClipMapOptions& options) {
  if (!options.output.empty()) {
    if (auto free = CheckOutput(options.output, options.overwrite); !free) return Complain(free.error());
  }
  const auto reading = ReadOptions({.joint_map = options.joint_map, .unit = "", .up = ""});
  if (!reading) return Complain(reading.error());
  // All animations of a file move the same skeleton: the first one shows it.
  const auto clips = ReadClips(options.clip);
  if (!clips) return Complain(clips.error());
  const SourceClip& clip = clips->front();
  const Skeleton& skeleton = clip.clip.skeleton;
  const auto map = FindJointMap(skeleton, options.clip, reading->roles ? &*reading->roles : nullptr);
  if (!map) {
    // Who has a map already mends that one, which may be the very file that would be written.
    if (options.joint_map.empty() && !options.output.empty()) {
      if (auto saved = Save(options, EmptyMapFile(skeleton)); !saved) return Complain(saved.error());
      TellWritten(options.output);
      fmt::print("Next: fill it in, then --joint-map {}\n", options.output);
    }
    return Complain(map.error());
  }
  PrintRoles(skeleton, *map);
  PrintList("joints without a role:", UnusedJoints(skeleton, *map));
  if (auto saved = Save(options, WriteJointMapFile(skeleton, *map)); !saved) return Complain(saved.error());
  if (!options.output.empty()) TellWritten(options.output);
  return kSuccess;
}

}  // namespace etude
