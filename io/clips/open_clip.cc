#include "io/clips/open_clip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>

#include "engine/base/names.h"
#include "engine/formats/acclaim.h"
#include "engine/formats/amass.h"
#include "engine/formats/bvh.h"
#include "engine/formats/deepmimic.h"
#include "engine/formats/gltf/gltf.h"
#include "engine/formats/kimodo.h"
#include "engine/formats/npz.h"
#include "engine/formats/text_scanner.h"
#include "engine/motion/edit.h"
#include "engine/retargeting/joint_arrays.h"
#include "engine/retargeting/opensim_motion.h"
#include "engine/retargeting/rig.h"
#include "io/clips/fbx.h"
#include "io/clips/marker_files.h"
#include "io/clips/other_files.h"
#include "io/clips/references.h"
#include "io/files/files.h"
#include "io/images/image_files.h"
#include "sim/camera/jpeg.h"
#include "sim/choreography/canonical_body.h"

namespace etude {
namespace {

namespace fs = std::filesystem;

/// Reads files until their total size exceeds kMaxClipFileBytes.
class CappedReader {
 public:
  Result<std::string> Read(const fs::path& path) {
    std::error_code not_there;  // ReadWholeFile reports a missing file better
    const std::uintmax_t size = fs::file_size(path, not_there);
    if (!not_there && size > left_) {
      return Fail({path.string(), 0, 0}, "{} MB; at most {} MB of a clip are read", (size + 999'999) / 1'000'000,
                  kMaxClipFileBytes / 1'000'000);
    }
    auto bytes = ReadWholeFile(path);
    if (bytes) left_ -= std::min<std::uintmax_t>(left_, bytes->size());
    return bytes;
  }

 private:
  std::uintmax_t left_ = kMaxClipFileBytes;
};

Result<std::string> ReadBeside(const std::string& path, const std::string& uri, CappedReader& reader) {
  const auto fail = [&](const std::string& why) { return Fail({path, 0, 0}, "its file {}: {}", Quote(uri), why); };
  std::error_code error;
  const fs::path folder = fs::canonical(fs::path(path), error).parent_path();
  const fs::path file = fs::canonical(folder / uri, error);
  if (error) return fail(error.message());
  // A link may lead anywhere, so compare the resolved paths.
  const auto ends = std::ranges::mismatch(folder, file);
  if (ends.in1 != folder.end()) return fail("a link that leads out of the folder");
  auto bytes = reader.Read(file);
  if (!bytes) return fail(bytes.error().message);
  return bytes;
}

Result<ColourImage> DecodeTexture(std::string_view bytes, std::size_t max_pixels) {
  return bytes.starts_with("\x89PNG") ? DecodeColourPng(bytes, max_pixels) : ReadJpeg(bytes, max_pixels);
}

ClipFile FileOfOne(ClipFormat format, Clip clip) {
  ClipFile file{.format = format,
                .figure = {.name = clip.name, .skeleton = clip.skeleton, .materials = {}, .meshes = {}},
                .clips = {}};
  file.clips.push_back(std::move(clip));
  return file;
}

/// Makes a clip file of a motion that is a body already; `note` says where it comes from.
ClipFile FileOfBody(ClipFormat format, const BodyMotion& motion, const std::string& path, const std::string& note) {
  ClipFile file = FileOfOne(format, RigClip(motion, StandingPose(), fs::path(path).stem().string()));
  file.bodies = {{.changes = {note}}};
  return file;
}

/// Finds the ASF file that belongs to an Acclaim motion.
Result<std::string> AcclaimSkeletonBeside(const std::string& path) {
  const fs::path folder = fs::path(path).parent_path();
  const std::string stem = fs::path(path).stem().string();
  std::vector<std::string> found;
  std::error_code error;
  for (fs::directory_iterator entry(folder.empty() ? "." : folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const std::string ending = entry->path().extension().string();
    if (ending != ".asf" && ending != ".ASF") continue;
    if (entry->path().stem() == stem || stem.starts_with(entry->path().stem().string() + "_")) {
      return entry->path().string();
    }
    found.push_back(entry->path().string());
  }
  if (found.size() == 1) return found.front();
  return Fail({path},
              "an Acclaim motion, whose skeleton is another file: {} .asf files are in its folder; allowed: one, or "
              "one that begins its name ('01.asf' of '01_01.amc')",
              found.empty() ? "no" : std::to_string(found.size()));
}

Result<Clip> ReadAcclaim(std::string_view bytes, const std::string& path, CappedReader& reader) {
  ASSIGN_OR_RETURN(const auto skeleton_path, AcclaimSkeletonBeside(path));
  ASSIGN_OR_RETURN(const auto text, reader.Read(skeleton_path));
  ASSIGN_OR_RETURN(const auto skeleton, ReadAcclaimSkeleton(text, skeleton_path));
  return ReadAcclaimMotion(bytes, skeleton, path);
}

/// Returns the roles that the bones of a VRM file play. Spine, hands, feet and the crown are found as in other files.
std::optional<JointMapOverrides> RolesOfBones(const std::map<std::string, int>& bones, const Skeleton& skeleton) {
  constexpr std::pair<const char*, Role> kBones[] = {
      {"leftUpperArm", Role::kLeftShoulder}, {"rightUpperArm", Role::kRightShoulder},
      {"leftLowerArm", Role::kLeftElbow},    {"rightLowerArm", Role::kRightElbow},
      {"leftHand", Role::kLeftWrist},        {"rightHand", Role::kRightWrist},
      {"leftUpperLeg", Role::kLeftHip},      {"rightUpperLeg", Role::kRightHip},
      {"leftLowerLeg", Role::kLeftKnee},     {"rightLowerLeg", Role::kRightKnee},
      {"leftFoot", Role::kLeftAnkle},        {"rightFoot", Role::kRightAnkle},
      {"neck", Role::kShoulderCentre}};
  JointMapOverrides roles;
  for (const auto& [bone, role] : kBones) {
    const auto found = bones.find(bone);
    if (found == bones.end()) continue;
    const std::string& name = skeleton.joints[found->second].name;
    if (skeleton.Find(name) == found->second) roles.joints[role] = {name, {}};
  }
  return roles.joints.empty() ? std::nullopt : std::optional(std::move(roles));
}

Result<std::vector<SourceClip>> ReadBuiltin(const std::string& reference) {
  ASSIGN_OR_RETURN(const auto builtin, LoadBuiltinClip(reference.substr(kBuiltinPrefix.size()), {}));
  Clip clip = RigClip(builtin.motion, StandingPose(), reference.substr(kBuiltinPrefix.size()));
  return std::vector<SourceClip>{{reference, reference, ClipFormat::kBuiltin, std::move(clip), nullptr}};
}

/// Finds the clip of that name. Exporters write "Armature|Jump"; "Jump" alone is enough if only one name ends so.
std::vector<Clip>::iterator FindAnimation(std::vector<Clip>& clips, const std::string& name) {
  const auto exactly = std::ranges::find(clips, name, &Clip::name);
  if (exactly != clips.end()) return exactly;
  const auto ends_so = [&](const Clip& clip) { return clip.name.ends_with("|" + name); };
  return std::ranges::count_if(clips, ends_so) == 1 ? std::ranges::find_if(clips, ends_so) : clips.end();
}

/// Keeps only the animation that was asked for, or all.
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

/// Returns the roles that the user assigned, else those of the file; null without either.
const JointMapOverrides* TaughtBy(const OpenOptions& options, const std::optional<JointMapOverrides>& file) {
  if (options.roles && !options.roles->joints.empty()) return &*options.roles;
  return file ? &*file : nullptr;
}

/// Moves the root to the hips in clips whose file has it at the chest or head. Clips with meshes keep their skeleton.
void RootAtHips(Clip& clip, bool has_meshes, std::vector<std::string>& remarks) {
  const auto has_scales = [](const LocalPose& pose) {
    return std::ranges::any_of(pose, [](const LocalTransform& local) { return local.scale != glm::dvec3(1); });
  };
  const int root = has_meshes ? -1 : FindNewRoot(clip.skeleton);
  if (root < 0 || has_scales(RestPose(clip.skeleton)) || std::ranges::any_of(clip.frames, has_scales)) return;
  remarks.push_back(fmt::format("rooted at {} instead of {}", Quote(clip.skeleton.joints[root].name),
                                Quote(clip.skeleton.joints[0].name)));
  clip = WithRootAt(clip, root);
}

/// Finds the ground of a file with several clips. Returns nullopt if the skeleton has no roles; UnderstandClip then
/// says which are missing.
std::optional<Ground> GroundOf(const ClipFile& file, const std::string& path, const OpenOptions& options) {
  if (file.clips.size() < 2) return std::nullopt;
  const auto map =
      FindJointMap(file.clips.front().skeleton, path, TaughtBy(options, file.roles), file.clips.front().frames);
  BodyOptions told = options.body;
  told.up = ToldUp(options);
  told.up_rule = UpRuleOf(file.format);
  return map ? FindGround(file.clips, *map, told) : std::nullopt;
}

/// Undoes scales of the frames that the rest pose does not have, and says so in the remarks. A skeleton without roles
/// is left unchanged.
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
  const auto map =
      FindJointMap(file.clips.front().skeleton, path, TaughtBy(options, file.roles), file.clips.front().frames);
  if (!map) return;
  if (const auto ratio = UndoScales(file.clips, *map)) {
    file.remarks.push_back(fmt::format(
        "the frames show a body {:.3g} times as tall as the rest pose, by scales that it has not: undone", *ratio));
  }
}

/// Opens a clip of our own skeleton, which has one joint for every role, with the role's name.
Result<OpenedClip> UnderstandBuiltin(SourceClip source, const BodyOptions& options) {
  OpenedClip opened{.source = std::move(source), .map = {}, .body = {}};
  for (const Role role : AllRoles()) {
    opened.map.points[Index(role)].joint = opened.source.clip.skeleton.Find(std::string(RoleName(role)));
  }
  const bool is_ours = opened.source.format == ClipFormat::kBuiltin || opened.source.format == ClipFormat::kRecording;
  opened.body = {.metres_per_unit = 1, .unit = "metre", .motion = {}};
  if (opened.source.made) {
    for (const std::string& change : opened.source.made->changes) AddChange(change, opened.body);
    opened.body.found_up = opened.source.made->up;
    opened.body.floor = opened.source.made->floor_m;
  } else {
    AddChange("the canonical body", opened.body);
  }
  // Markers were turned and scaled as told when they were read; arrays and angles of ours are turned here.
  const bool is_turned = options.up == UpAxis::kZ && !is_ours && !IsOfMarkers(opened.source.format);
  if (is_turned) {
    opened.body.found_up = {.axis = AxisOf(UpAxis::kZ), .evidence = UpEvidence::kTold};
    AddChange(DescribeTurn(opened.body.found_up), opened.body);
  }
  if (!IsOfMarkers(opened.source.format) && (options.metres_per_unit || (is_ours && options.up))) {
    AddChange(is_ours ? "unit and up axis are its own, not those told" : "its unit is its own, not the one told",
              opened.body);
  }
  constexpr double kSameRate = 1e-6;  // a rate found by a column of times is rounded
  const bool keeps_rate = std::abs(opened.source.clip.rate_hz / options.rate_hz - 1) < kSameRate;
  if (!keeps_rate) {
    AddChange(fmt::format("resampled from {:.6g} to {:.6g} Hz", opened.source.clip.rate_hz, options.rate_hz),
              opened.body);
  }
  const Clip clip = keeps_rate ? opened.source.clip : Resample(opened.source.clip, options.rate_hz);
  opened.body.motion.rate_hz = options.rate_hz;
  // Evaluate the joint positions of every frame.
  std::vector<GlobalTransform> globals;
  for (const LocalPose& frame : clip.frames) {
    ComputeGlobals(clip.skeleton, frame, globals);
    BodyPose pose = Evaluate(opened.map, globals);
    // A sensor's hip centre need not be midway between its hips, where Evaluate puts it.
    if (opened.source.format != ClipFormat::kBuiltin) {
      pose[Role::kHipCentre] = globals[opened.map[Role::kHipCentre].joint].position;
    }
    opened.body.motion.poses.push_back(is_turned ? Upright(pose, UpAxis::kZ) : pose);
  }
  return opened;
}

}  // namespace

std::string_view FormatName(ClipFormat format) {
  constexpr std::array kNames = {"BVH", "glTF", "GLB", "FBX", "DeepMimic", "Acclaim", "AMASS",     "C3D",
                                 "TRC", "CSV",  "NPZ", "NPY", "Motive",    "MOT",     "recording", "built-in"};
  return kNames[static_cast<std::size_t>(format)];
}

Result<ClipFile> ReadClipFile(const std::string& path, const std::optional<std::string>& layout,
                              const OpenOptions& options) {
  CappedReader reader;
  ASSIGN_OR_RETURN(const auto bytes, reader.Read(path));
  TextScanner scanner(bytes, path);
  const bool has_text = scanner.SkipToText();
  const Token first = has_text ? scanner.Next() : Token{};

  ClipFile file;
  // Arrays: our own bodies, motions of AMASS and Kimodo, or positions of joints.
  if (IsZip(bytes)) {
    ASSIGN_OR_RETURN(const auto arrays, ReadNpz(bytes, path));
    if (IsBodyNpz(arrays)) {
      ASSIGN_OR_RETURN(const auto motion, ReadBodyNpz(arrays, path));
      return FileOfBody(ClipFormat::kNpz, motion, path, "Etude's own arrays");
    }
    if (IsKimodoNpz(arrays)) {
      ASSIGN_OR_RETURN(auto clip, ReadKimodo(arrays, path));
      file = FileOfOne(ClipFormat::kNpz, std::move(clip));
      file.roles = JointMapOverrides{.joints = {}, .metres_per_unit = 1, .up = UpAxis::kY};
      file.remarks.push_back("Kimodo's arrays, which tell no rate: 30 Hz is its model's");
      return file;
    }
    ASSIGN_OR_RETURN(auto clip, ReadAmass(arrays, path));
    return FileOfOne(ClipFormat::kAmass, std::move(clip));
  }
  if (IsNpy(bytes)) {
    ASSIGN_OR_RETURN(const auto array, ReadNpy(bytes, path));
    std::string note;
    ASSIGN_OR_RETURN(const auto joints, JointsOfArray(array, layout, path, note));
    ASSIGN_OR_RETURN(file, FileOfMarkers(ClipFormat::kNpy, joints, path, options, ArrayUp()));
    for (MadeBody& body : file.bodies) body.changes.push_back(note);
    file.has_rate = false;
    return file;
  }
  // Markers, and recordings of runs.
  if (auto markers = ReadMarkers(bytes, path, options)) return *std::move(markers);
  if (options.recorded != nullptr && options.recorded->IsRecording(bytes)) return options.recorded->Read(bytes, path);
  // Text formats of bodies: OpenSim's angles and DeepMimic's motions.
  if (first.text == "Coordinates" && HasModelOfAngles(bytes)) {
    std::string note = "angles of the model in the file's head";
    ASSIGN_OR_RETURN(const auto motion, ReadOpenSimMotion(bytes, path, &note));
    return FileOfBody(ClipFormat::kMot, motion, path, note);
  }
  if (first.text == "{" && IsDeepMimicMotion(bytes)) {
    ASSIGN_OR_RETURN(auto clip, ReadDeepMimicMotion(bytes, path));
    return FileOfOne(ClipFormat::kDeepMimic, std::move(clip));
  }
  // glTF, GLB, and FBX, which is converted to GLB first.
  const bool is_fbx = IsFbx(bytes);
  if (first.text == "{" && bytes.find("\"asset\"") == std::string::npos) {
    return Fail(scanner.At(first), "{}", DescribeOtherFile(bytes, first.text));
  }
  if (is_fbx || bytes.starts_with("glTF") || first.text == "{") {
    file.format = is_fbx ? ClipFormat::kFbx : first.text == "{" ? ClipFormat::kGltf : ClipFormat::kGlb;
    FbxMotion fbx;
    if (is_fbx) {
      ASSIGN_OR_RETURN(fbx, ReadFbx(bytes, path));
      file.remarks.push_back("read by " + fbx.reader);
      if (!fbx.remark.empty()) file.remarks.push_back(fbx.remark);
    }
    auto read = ReadGltf(
        is_fbx ? fbx.glb : bytes, path, [&](const std::string& uri) { return ReadBeside(path, uri, reader); },
        DecodeTexture);
    if (!read && is_fbx) return Fail({path}, "an FBX file whose motion is refused: {}", read.error().message);
    ASSIGN_OR_RETURN(auto content, std::move(read));
    for (std::string& remark : content.remarks) file.remarks.push_back(std::move(remark));
    file.figure = std::move(content.character);
    file.clips = std::move(content.clips);
    file.roles = RolesOfBones(content.bones, file.figure.skeleton);
    return file;
  }
  // Acclaim and BVH; any other file is described in the complaint.
  if (IsAcclaimMotion(bytes)) {
    ASSIGN_OR_RETURN(auto clip, ReadAcclaim(bytes, path, reader));
    return FileOfOne(ClipFormat::kAcclaim, std::move(clip));
  }
  constexpr std::string_view kBvhStart = "HIERARCHY";
  if (!std::ranges::equal(first.text, kBvhStart, {}, [](char c) { return c >= 'a' && c <= 'z' ? c - 'a' + 'A' : c; })) {
    return Fail(
        scanner.At(first),
        "{}; allowed: BVH (it begins with HIERARCHY), glTF 2.0 (.glb, .gltf), FBX, Acclaim's .amc, AMASS's .npz, "
        "C3D, TRC, joint CSV, Motive's CSV, .npy of joints, .mot of ours, DeepMimic's motions",
        DescribeOtherFile(bytes, first.text));
  }
  ASSIGN_OR_RETURN(auto clip, ReadBvh(bytes, path, &file.remarks));
  ClipFile read = FileOfOne(ClipFormat::kBvh, std::move(clip));
  read.remarks = std::move(file.remarks);
  return read;
}

Result<std::vector<SourceClip>> ReadClips(const std::string& reference, const OpenOptions& options) {
  if (reference.starts_with(kBuiltinPrefix)) return ReadBuiltin(reference);
  SplitReference wanted = Split(reference);
  // Replace a reference to a run by the file of its recording.
  if (options.recorded != nullptr) {
    ASSIGN_OR_RETURN(wanted, options.recorded->Find(wanted));
  }
  ASSIGN_OR_RETURN(auto file, ReadClipFile(FileOf(wanted.path), wanted.animation, options));
  const std::string stem = fs::path(FileOf(wanted.path)).stem().string();
  const bool is_recording = file.format == ClipFormat::kRecording;
  if (!is_recording && options.roles && options.roles->rate_hz) {
    for (Clip& clip : file.clips) clip.rate_hz = *options.roles->rate_hz;
    for (MarkerMotion& shown : file.shown) shown.rate_hz = *options.roles->rate_hz;
  } else if (!file.has_rate) {
    for (MadeBody& body : file.bodies) {
      body.changes.push_back(fmt::format("no rate in the file: {:g} Hz are assumed", kJudgedRateHz));
    }
  }
  if (is_recording && wanted.animation == "") wanted.animation = options.recorded->OwnTrack(file.clips);
  const auto shown_of = [&](std::size_t i) {
    return file.shown.empty() ? nullptr : std::make_shared<const MarkerMotion>(std::move(file.shown[i]));
  };
  // A file of one motion: a '#' chooses nothing, except the layout of an .npy array.
  const bool has_animations =
      file.format == ClipFormat::kGltf || file.format == ClipFormat::kGlb || file.format == ClipFormat::kFbx;
  const bool is_one = !has_animations && !is_recording && file.clips.size() == 1;
  if (is_one) {
    if (wanted.animation && file.format != ClipFormat::kNpy) {
      return Fail({wanted.path, 0, 0}, "a {} file has one motion; '#{}' chooses one of a glTF file",
                  FormatName(file.format), *wanted.animation);
    }
    const std::string source = wanted.path + (wanted.animation ? "#" + *wanted.animation : "");
    std::vector<SourceClip> only;  // moved into: an initializer list would copy the frames
    only.push_back({stem, source, file.format, std::move(file.clips.front()), nullptr, std::nullopt,
                    file.bodies.empty() ? std::nullopt : std::optional(file.bodies.front()), file.remarks, file.roles,
                    shown_of(0)});
    return only;
  }
  // A file of several clips: undo scales and find the common ground before one clip is chosen.
  std::map<std::string, MadeBody> bodies;
  for (std::size_t i = 0; i < file.bodies.size(); ++i) bodies[file.clips[i].name] = file.bodies[i];
  std::map<std::string, std::shared_ptr<const MarkerMotion>> shown;
  for (std::size_t i = 0; i < file.shown.size(); ++i) shown[file.clips[i].name] = shown_of(i);
  TakeScalesOut(file, wanted.path, options);
  const std::optional<Ground> ground = GroundOf(file, wanted.path, options);
  RETURN_IF_ERROR(KeepWanted(wanted, file.figure, file.clips));
  const bool has_meshes = !file.figure.meshes.empty();
  const auto figure = has_meshes ? std::make_shared<const Character>(std::move(file.figure)) : nullptr;
  // Name each clip after its file and its animation.
  std::vector<SourceClip> clips;
  for (Clip& clip : file.clips) {
    const std::string animation = "#" + clip.name;
    const std::string clip_name = clip.name;
    const auto made = bodies.find(clip_name);
    clips.push_back({stem + animation, wanted.path + animation, file.format, std::move(clip), figure, ground,
                     made == bodies.end() ? std::nullopt : std::optional(made->second), file.remarks, file.roles,
                     shown[clip_name]});
  }
  return clips;
}

Result<OpenedClip> UnderstandClip(SourceClip source, const OpenOptions& options) {
  const bool is_body = source.format == ClipFormat::kBuiltin || source.made.has_value();
  BodyOptions told = options.body;
  told.up = ToldUp(options);
  told.metres_per_unit = ToldUnit(options);
  told.keep_floor = KeepsFloor(options);
  told.up_rule = UpRuleOf(source.format);
  if (is_body) return UnderstandBuiltin(std::move(source), told);
  RootAtHips(source.clip, source.character != nullptr, source.remarks);
  ASSIGN_OR_RETURN(
      auto map, FindJointMap(source.clip.skeleton, source.source, TaughtBy(options, source.roles), source.clip.frames));
  // The ground of the whole file overrides what one clip would show.
  if (source.ground) {
    if (!told.up) told.found_up = source.ground->found_up;
    told.floor = source.ground->floor;
    told.stature = source.ground->stature;
  }
  ASSIGN_OR_RETURN(auto body, ToBodyMotion(source.clip, map, source.source, told));
  for (const std::string& remark : source.remarks) AddChange(remark, body);
  return OpenedClip{std::move(source), std::move(map), std::move(body)};
}

}  // namespace etude
