#include "io/clips/open_clip.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "engine/base/names.h"
#include "engine/motion/edit.h"
#include "engine/retargeting/body_choice.h"
#include "engine/retargeting/rig.h"
#include "io/clips/marker_files.h"
#include "io/clips/references.h"
#include "sim/choreography/canonical_body.h"

namespace etude {
namespace {

namespace fs = std::filesystem;

Result<std::vector<SourceClip>> ReadBuiltin(const std::string& reference) {
  ASSIGN_OR_RETURN(const auto builtin, LoadBuiltinClip(reference.substr(kBuiltinPrefix.size()), {}));
  Clip clip = RigClip(builtin.motion, StandingPose(), reference.substr(kBuiltinPrefix.size()));
  return std::vector<SourceClip>{{reference, reference, ClipFormat::kBuiltin, std::move(clip), nullptr}};
}

/// Finds the clip named `name`. Exporters write "Armature|Jump"; "Jump" is accepted if only one clip's name ends with
/// "Jump".
std::vector<Clip>::iterator FindAnimation(std::vector<Clip>& clips, const std::string& name) {
  const auto exactly = std::ranges::find(clips, name, &Clip::name);
  if (exactly != clips.end()) return exactly;
  const auto ends_so = [&](const Clip& clip) { return clip.name.ends_with("|" + name); };
  return std::ranges::count_if(clips, ends_so) == 1 ? std::ranges::find_if(clips, ends_so) : clips.end();
}

/// Keeps only the requested animation, or all if none is requested.
Result<void> KeepWanted(const SplitReference& wanted, const Character& figure, std::vector<Clip>& clips) {
  if (clips.empty()) {
    return Fail({wanted.path, 0, 0}, "the file contains no animation, only a character (joints: {}, meshes: {})",
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

/// Returns the roles that the user assigned, else the roles that the file assigns; null if neither does.
const JointMapOverrides* TaughtBy(const OpenOptions& options, const std::optional<JointMapOverrides>& file) {
  if (options.roles && !options.roles->joints.empty()) return &*options.roles;
  return file ? &*file : nullptr;
}

/// Moves the root to the hips if the clip's file has the root at the chest or head. A clip with meshes keeps its
/// skeleton.
void RootAtHips(Clip& clip, bool has_meshes, std::vector<std::string>& remarks) {
  const auto has_scales = [](const LocalPose& pose) {
    return std::ranges::any_of(pose, [](const LocalTransform& local) { return local.scale != glm::dvec3(1); });
  };
  const int root = has_meshes ? -1 : FindNewRoot(clip.skeleton);
  if (root < 0 || has_scales(RestPose(clip.skeleton)) || std::ranges::any_of(clip.frames, has_scales)) return;
  remarks.push_back(fmt::format("root moved to {} from {}", Quote(clip.skeleton.joints[root].name),
                                Quote(clip.skeleton.joints[0].name)));
  clip = WithRootAt(clip, root);
}

/// Finds the up axis, the floor and the stature that all clips of a file with several clips share. Returns nullopt if
/// the skeleton has no roles (UnderstandClip then reports which roles are missing), or if different bodies move.
std::optional<Ground> GroundOf(const ClipFile& file, const std::string& path, const OpenOptions& options) {
  if (file.clips.size() < 2) return std::nullopt;
  const auto body_in = [&](const Clip& clip) {
    return ChooseBody(clip, path, TaughtBy(options, file.roles), file.skinned);
  };
  const auto body = body_in(file.clips.front());
  if (!body) return std::nullopt;
  const auto is_same = [&](const Clip& clip) {
    const auto other = body_in(clip);
    return other && other->map[Role::kLeftHip].joint == body->map[Role::kLeftHip].joint;
  };
  if (!body->doubt.empty() && !std::ranges::all_of(file.clips, is_same)) return std::nullopt;
  BodyOptions told = options.body;
  told.up = ToldUp(options);
  told.up_rule = UpRuleOf(file.format);
  return FindGround(file.clips, body->map, told);
}

/// Removes scales that exist in the frames but not in the rest pose, and adds a remark about these scales. A skeleton
/// without roles is left unchanged.
void TakeScalesOut(ClipFile& file, const std::string& path, const OpenOptions& options) {
  const auto has_scales = [](const Clip& clip) {
    return std::ranges::any_of(clip.frames, [&](const LocalPose& frame) {
      for (std::size_t i = 0; i < frame.size(); ++i) {
        if (frame[i].scale != clip.skeleton.joints[i].rest.scale) return true;
      }
      return false;
    });
  };
  if (std::ranges::none_of(file.clips, has_scales)) return;
  const auto body = ChooseBody(file.clips.front(), path, TaughtBy(options, file.roles), file.skinned);
  if (!body) return;
  if (const auto ratio = UndoScales(file.clips, body->map)) {
    file.remarks.push_back(
        fmt::format("Etude removed scales that only the frames have and that made the body {:.3g} times as tall as in "
                    "the rest pose",
                    *ratio));
  }
}

/// Opens a clip of our own skeleton. This skeleton has one joint for every role, and the joint has the role's name.
Result<OpenedClip> UnderstandBuiltin(SourceClip source, const BodyOptions& options) {
  OpenedClip opened{.source = std::move(source), .map = {}, .body = {}};
  for (const Role role : AllRoles()) {
    opened.map.points[Index(role)].joint = opened.source.clip.skeleton.Find(std::string(RoleName(role)));
  }
  const bool is_ours = opened.source.format == ClipFormat::kBuiltin || opened.source.format == ClipFormat::kRecording;
  opened.body = {.metres_per_unit = 1, .unit = "metre", .motion = {}};
  if (opened.source.made) {
    opened.body.changes = opened.source.made->changes;
    opened.body.doubts = opened.source.made->doubts;
    opened.body.found_up = opened.source.made->up;
    opened.body.floor = opened.source.made->floor_m;
  } else {
    opened.body.changes.emplace_back("the canonical body");
  }
  // Markers have already been turned and scaled as the user's options say. Bodies from Etude's arrays or from OpenSim's
  // angles are turned here.
  const bool is_turned = options.up == UpAxis::kZ && !is_ours && !IsOfMarkers(opened.source.format);
  if (is_turned) {
    opened.body.found_up = {.axis = AxisOf(UpAxis::kZ), .evidence = UpEvidence::kTold};
    opened.body.changes.push_back(DescribeTurn(opened.body.found_up));
  }
  if (!IsOfMarkers(opened.source.format) && (options.metres_per_unit || (is_ours && options.up))) {
    opened.body.changes.emplace_back(
        is_ours ? "Etude uses the unit and up axis of the file instead of the given unit and up axis"
                : "Etude uses the unit of the file instead of the given unit");
  }
  constexpr double kSameRate = 1e-6;  // relative tolerance, because a rate that was computed from times is rounded
  const bool keeps_rate = std::abs(opened.source.clip.rate_hz / options.rate_hz - 1) < kSameRate;
  if (std::string said = DescribeResampling(opened.source.clip.rate_hz, options.rate_hz); !said.empty()) {
    opened.body.changes.push_back(std::move(said));
  }
  const Clip clip = keeps_rate ? opened.source.clip : Resample(opened.source.clip, options.rate_hz);
  opened.body.motion.rate_hz = options.rate_hz;
  // Evaluate the joint positions of every frame.
  std::vector<GlobalTransform> globals;
  for (const LocalPose& frame : clip.frames) {
    ComputeGlobals(clip.skeleton, frame, globals);
    BodyPose pose = Evaluate(opened.map, globals);
    // Evaluate puts the hip centre midway between the hips; a sensor's hip centre may lie elsewhere.
    if (opened.source.format != ClipFormat::kBuiltin) {
      pose[Role::kHipCentre] = globals[opened.map[Role::kHipCentre].joint].position;
    }
    opened.body.motion.poses.push_back(is_turned ? Upright(pose, UpAxis::kZ) : pose);
  }
  opened.body.Doubt(DescribeImpossibleHeight(opened.body.motion.poses));
  opened.body.Doubt(DescribeSlowRate(opened.source.clip.rate_hz));
  return opened;
}

/// Opens a clip of a skeleton or of a body, without telling its doubts.
Result<OpenedClip> Understand(SourceClip source, const OpenOptions& options) {
  const bool is_body = source.format == ClipFormat::kBuiltin || source.made.has_value();
  BodyOptions told = options.body;
  told.up = ToldUp(options);
  told.metres_per_unit = ToldUnit(options);
  told.keep_floor = KeepsFloor(options);
  told.up_rule = UpRuleOf(source.format);
  told.states_metres = IsOfAnimations(source.format);
  if (is_body) return UnderstandBuiltin(std::move(source), told);
  RootAtHips(source.clip, source.character != nullptr, source.remarks);
  ASSIGN_OR_RETURN(auto chosen,
                   ChooseBody(source.clip, source.source, TaughtBy(options, source.roles), source.skinned));
  // The ground that all clips of the file share has priority over the ground of this one clip.
  if (source.ground) {
    if (!told.up) told.found_up = source.ground->found_up;
    told.floor = source.ground->floor;
    told.stature = source.ground->stature;
  }
  ASSIGN_OR_RETURN(auto body, ToBodyMotion(source.clip, chosen.map, source.source, told));
  body.changes.insert(body.changes.end(), source.remarks.begin(), source.remarks.end());
  body.Doubt(chosen.doubt);
  return OpenedClip{std::move(source), std::move(chosen.map), std::move(body)};
}

}  // namespace

double HiddenStart(const SourceClip& source) {
  return source.made ? static_cast<double>(source.made->first_frame) / source.clip.rate_hz : 0;
}

Result<std::vector<SourceClip>> ReadClips(const std::string& reference, const OpenOptions& options) {
  if (reference.starts_with(kBuiltinPrefix)) return ReadBuiltin(reference);
  SplitReference wanted = Split(reference);
  // Replace a reference to a run by the file of the run's recording.
  if (options.recorded != nullptr) {
    ASSIGN_OR_RETURN(wanted, options.recorded->Find(wanted));
  }
  ASSIGN_OR_RETURN(auto file, ReadClipFile(FileOf(wanted.path), wanted.animation, options));
  const std::string stem = fs::path(FileOf(wanted.path)).stem().string();
  const bool is_recording = file.format == ClipFormat::kRecording;
  const auto say = [&](const std::string& remark) {
    for (MadeBody& body : file.bodies) body.changes.push_back(remark);
    if (file.bodies.empty()) file.remarks.push_back(remark);
  };
  if (!is_recording && options.roles && options.roles->rate_hz) {
    for (Clip& clip : file.clips) clip.rate_hz = *options.roles->rate_hz;
    for (MadeBody& body : file.bodies) body.start_s.reset();
    for (RawMotion& shown : file.shown) {
      shown.rate_hz = *options.roles->rate_hz;
      shown.start_s.reset();  // the file's clock has another rate
    }
  } else if (!file.has_rate) {
    say(fmt::format("the file states no rate, so Etude assumes {:g} Hz", file.clips.front().rate_hz));
  }
  // The frames of an animation are its keys, which may be 1 s apart.
  const bool has_animations = IsOfAnimations(file.format);
  const auto is_slow = [&](const Clip& clip) { return has_animations ? clip.rate_hz < 1 : clip.rate_hz <= 1; };
  if (const auto slow = std::ranges::find_if(file.clips, is_slow); slow != file.clips.end() && !is_recording) {
    say(
        fmt::format("frames are {:.3g} s apart: are the times in milliseconds, or are they frame numbers? Use `--rate` "
                    "(for `etude clip convert`: `--file-rate`) to set the rate",
                    1 / slow->rate_hz));
  }
  if (is_recording && wanted.animation == "") wanted.animation = options.recorded->OwnTrack(file.clips);
  const auto shown_of = [&](std::size_t i) {
    return file.shown.empty() ? nullptr : std::make_shared<const RawMotion>(std::move(file.shown[i]));
  };
  // If the file holds one motion and its format has no named animations, refuse '#' in the reference, except for the
  // layout of an .npy array.
  const bool is_one = !has_animations && !is_recording && file.clips.size() == 1;
  if (is_one) {
    if (wanted.animation && file.format != ClipFormat::kNpy) {
      return Fail({wanted.path, 0, 0}, "a {} file has only one motion; '#{}' can only select a motion of a glTF file",
                  FormatName(file.format), *wanted.animation);
    }
    const std::string source = wanted.path + (wanted.animation ? "#" + *wanted.animation : "");
    std::vector<SourceClip> only;  // not an initializer list, which would copy the frames of the clip
    only.push_back({stem, source, file.format, std::move(file.clips.front()), nullptr, std::nullopt,
                    file.bodies.empty() ? std::nullopt : std::optional(file.bodies.front()), file.remarks, file.roles,
                    file.skinned, shown_of(0)});
    return only;
  }
  // If the file holds several clips, undo scales and find the ground that all clips share, before one clip is chosen.
  std::map<std::string, MadeBody> bodies;
  for (std::size_t i = 0; i < file.bodies.size(); ++i) bodies[file.clips[i].name] = file.bodies[i];
  std::map<std::string, std::shared_ptr<const RawMotion>> shown;
  for (std::size_t i = 0; i < file.shown.size(); ++i) shown[file.clips[i].name] = shown_of(i);
  TakeScalesOut(file, wanted.path, options);
  const std::optional<Ground> ground = GroundOf(file, wanted.path, options);
  RETURN_IF_ERROR(KeepWanted(wanted, file.figure, file.clips));
  const bool has_meshes = !file.figure.meshes.empty();
  const auto figure = has_meshes ? std::make_shared<const Character>(std::move(file.figure)) : nullptr;
  // Name each clip after the clip's file and animation.
  std::vector<SourceClip> clips;
  for (Clip& clip : file.clips) {
    const std::string animation = "#" + clip.name;
    const std::string clip_name = clip.name;
    const auto made = bodies.find(clip_name);
    clips.push_back({stem + animation, wanted.path + animation, file.format, std::move(clip), figure, ground,
                     made == bodies.end() ? std::nullopt : std::optional(made->second), file.remarks, file.roles,
                     file.skinned, shown[clip_name]});
  }
  return clips;
}

Result<SourceClip> ReadOneClip(const std::string& reference, const OpenOptions& options) {
  ASSIGN_OR_RETURN(auto clips, ReadClips(reference, options));
  if (clips.size() == 1) return std::move(clips.front());
  std::vector<std::string> names;
  for (const SourceClip& clip : clips) names.push_back(clip.source);
  return Fail({reference}, "the file contains {} motions; choose one of them: {}", clips.size(), Join(names));
}

Result<OpenedClip> UnderstandClip(SourceClip source, const OpenOptions& options) {
  auto opened = Understand(std::move(source), options);
  if (!opened || !options.on_doubt) return opened;
  for (const std::string& doubt : opened->body.doubts) options.on_doubt(opened->source.source, doubt);
  return opened;
}

}  // namespace etude
