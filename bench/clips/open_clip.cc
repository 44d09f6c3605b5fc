#include "bench/clips/open_clip.h"

#include <algorithm>
#include <filesystem>

#include "bench/clips/builtin_clip.h"
#include "bench/clips/references.h"
#include "engine/base/names.h"
#include "engine/motion/edit.h"
#include "engine/retargeting/rig.h"
#include "sim/choreography/stance.h"

namespace etude {
namespace {

namespace fs = std::filesystem;

Result<std::vector<SourceClip>> ReadBuiltin(const std::string& reference) {
  ASSIGN_OR_RETURN(const auto builtin, LoadBuiltinClip(reference.substr(kBuiltinPrefix.size()), {}));
  Clip clip = RigClip(builtin.motion, StandingPose(), reference.substr(kBuiltinPrefix.size()));
  return std::vector<SourceClip>{{reference, reference, ClipFormat::kBuiltin, std::move(clip), nullptr}};
}

/// The clip of that name; exporters write "Armature|Jump", where "Jump" alone does if there is but one.
std::vector<Clip>::iterator FindAnimation(std::vector<Clip>& clips, const std::string& name) {
  const auto exactly = std::ranges::find(clips, name, &Clip::name);
  if (exactly != clips.end()) return exactly;
  const auto ends_so = [&](const Clip& clip) { return clip.name.ends_with("|" + name); };
  return std::ranges::count_if(clips, ends_so) == 1 ? std::ranges::find_if(clips, ends_so) : clips.end();
}

/// The one animation that was asked for, or all.
Result<void> KeepWanted(const SplitReference& wanted, const Character& figure, std::vector<Clip>& clips) {
  if (clips.empty()) {
    return Fail({wanted.path, 0, 0}, "holds no animation, only a figure (joints: {}, meshes: {})",
                figure.skeleton.joints.size(), figure.meshes.size());
  }
  if (!wanted.animation) return {};
  const auto named = FindAnimation(clips, *wanted.animation);
  if (named == clips.end()) {
    std::vector<std::string> names;
    for (const Clip& clip : clips) names.push_back(clip.name);
    return Fail({wanted.path, 0, 0}, "{}", UnknownName("animation", *wanted.animation, names));
  }
  Clip only = std::move(*named);
  clips.clear();
  clips.push_back(std::move(only));
  return {};
}

const TaughtRoles* TaughtBy(const OpenOptions& options) { return options.roles ? &*options.roles : nullptr; }

/// A skeleton without roles has no ground; UnderstandClip says what it lacks.
std::optional<Ground> GroundOf(const ClipFile& file, const std::string& path, const OpenOptions& options) {
  if (file.clips.size() < 2) return std::nullopt;
  const auto map = FindJointMap(file.clips.front().skeleton, path, TaughtBy(options));
  return map ? FindGround(file.clips, *map, options.body) : std::nullopt;
}

/// Our own skeleton: a joint of the name of every role, exactly there.
Result<OpenedClip> UnderstandBuiltin(SourceClip source, const BodyOptions& options) {
  OpenedClip opened{.source = std::move(source), .map = {}, .body = {}};
  for (const Role role : AllRoles()) {
    opened.map.points[Index(role)].joint = opened.source.clip.skeleton.Find(std::string(RoleName(role)));
  }
  opened.body = {.metres_per_unit = 1, .unit = "metre", .note = "the canonical body", .motion = {}};
  const Clip clip = Resample(opened.source.clip, options.rate_hz);
  opened.body.motion.rate_hz = options.rate_hz;
  std::vector<GlobalTransform> globals;
  for (const LocalPose& frame : clip.frames) {
    ComputeGlobals(clip.skeleton, frame, globals);
    opened.body.motion.poses.push_back(Evaluate(opened.map, globals));
  }
  return opened;
}

}  // namespace

Result<std::vector<SourceClip>> ReadClips(const std::string& reference, const OpenOptions& options) {
  if (reference.starts_with(kBuiltinPrefix)) return ReadBuiltin(reference);
  const SplitReference wanted = Split(reference);
  ASSIGN_OR_RETURN(auto file, ReadClipFile(wanted.path));
  const std::string stem = fs::path(wanted.path).stem().string();
  if (file.format == ClipFormat::kBvh || file.format == ClipFormat::kDeepMimic) {
    if (wanted.animation) {
      return Fail({wanted.path, 0, 0}, "a {} file has one motion; '#{}' chooses one of a glTF file",
                  FormatName(file.format), *wanted.animation);
    }
    return std::vector<SourceClip>{{stem, wanted.path, file.format, std::move(file.clips.front()), nullptr}};
  }
  const std::optional<Ground> ground = GroundOf(file, wanted.path, options);
  RETURN_IF_ERROR(KeepWanted(wanted, file.figure, file.clips));
  const bool has_meshes = !file.figure.meshes.empty();
  const auto figure = has_meshes ? std::make_shared<const Character>(std::move(file.figure)) : nullptr;
  std::vector<SourceClip> clips;
  for (Clip& clip : file.clips) {
    const std::string animation = "#" + clip.name;
    clips.push_back({stem + animation, wanted.path + animation, file.format, std::move(clip), figure, ground});
  }
  return clips;
}

Result<OpenedClip> UnderstandClip(SourceClip source, const OpenOptions& options) {
  if (source.format == ClipFormat::kBuiltin) return UnderstandBuiltin(std::move(source), options.body);
  ASSIGN_OR_RETURN(auto map, FindJointMap(source.clip.skeleton, source.source, TaughtBy(options)));
  BodyOptions told = options.body;
  if (source.ground) {
    told.up = source.ground->up;
    told.floor = source.ground->floor;
  }
  ASSIGN_OR_RETURN(auto body, ToBodyMotion(source.clip, map, source.source, told));
  return OpenedClip{std::move(source), std::move(map), std::move(body)};
}

}  // namespace etude
