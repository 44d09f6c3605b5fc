#include "io/clips/clip_file.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "engine/base/names.h"
#include "engine/base/text.h"
#include "engine/base/utf8.h"
#include "engine/formats/acclaim.h"
#include "engine/formats/amass.h"
#include "engine/formats/array_clock.h"
#include "engine/formats/bvh.h"
#include "engine/formats/deepmimic.h"
#include "engine/formats/gltf/gltf.h"
#include "engine/formats/kimodo.h"
#include "engine/formats/motion_bids.h"
#include "engine/formats/npz.h"
#include "engine/formats/text_scanner.h"
#include "engine/retargeting/exchanged_sides.h"
#include "engine/retargeting/joint_arrays.h"
#include "engine/retargeting/opensim_motion.h"
#include "engine/retargeting/rig.h"
#include "io/clips/bids_files.h"
#include "io/clips/fbx.h"
#include "io/clips/marker_files.h"
#include "io/clips/other_files.h"
#include "io/files/files.h"
#include "io/files/json.h"
#include "io/images/image_files.h"
#include "sim/camera/jpeg.h"
#include "sim/choreography/canonical_body.h"

namespace etude {
namespace {

namespace fs = std::filesystem;

/// Reads files. Fails as soon as the total size of all files read so far exceeds kMaxClipFileBytes.
class CappedReader {
 public:
  Result<std::string> Read(const fs::path& path) {
    std::error_code not_there;  // the error is ignored, because ReadWholeFile describes a missing file better
    const std::uintmax_t size = fs::file_size(path, not_there);
    if (!not_there && size > left_) {
      return Fail({path.string(), 0, 0}, "found {} MB; allowed: at most {} MB for a motion and its files together",
                  (size + 999'999) / 1'000'000, kMaxClipFileBytes / 1'000'000);
    }
    if (fs::is_directory(path, not_there)) {
      return Fail({path.string()}, "is no file, but a folder; allowed: a file, or a pattern in quotes such as '{}'",
                  (path / "*.bvh").string());
    }
    auto bytes = ReadWholeFile(path);
    if (bytes) left_ -= std::min<std::uintmax_t>(left_, bytes->size());
    return bytes;
  }

 private:
  std::uintmax_t left_ = kMaxClipFileBytes;
};

Result<std::string> ReadBeside(const std::string& path, const std::string& uri, CappedReader& reader) {
  const auto fail = [&](const std::string& why) {
    return Fail({path, 0, 0}, "Etude cannot read {}, to which this file refers: {}", Quote(uri), why);
  };
  std::error_code error;
  const fs::path folder = fs::canonical(fs::path(path), error).parent_path();
  const fs::path file = fs::canonical(folder / uri, error);
  if (error) return fail(error.message());
  // A link may point anywhere, so compare the resolved paths.
  const auto ends = std::ranges::mismatch(folder, file);
  if (ends.in1 != folder.end()) return fail("the path is a link to another folder");
  auto bytes = reader.Read(file);
  if (!bytes) return fail(bytes.error().message);
  return bytes;
}

Result<ColourImage> DecodeTexture(std::string_view bytes, std::size_t max_pixels) {
  return bytes.starts_with("\x89PNG") ? DecodeColourPng(bytes, max_pixels) : ReadJpeg(bytes, max_pixels);
}

ClipFile FileOfOne(ClipFormat format, Clip clip, std::vector<std::string> remarks = {}) {
  ClipFile file{.format = format,
                .figure = {.name = clip.name, .skeleton = clip.skeleton, .materials = {}, .meshes = {}},
                .clips = {}};
  file.clips.push_back(std::move(clip));
  file.remarks = std::move(remarks);
  return file;
}

/// Makes a clip file of a motion whose joints are already the twenty canonical ones. `notes` states the source of the
/// motion and every change to the motion.
ClipFile FileOfBody(ClipFormat format, const BodyMotion& motion, const std::string& path,
                    std::vector<std::string> notes) {
  ClipFile file = FileOfOne(format, RigClip(motion, StandingPose(), fs::path(path).stem().string()));
  file.bodies = {{.changes = std::move(notes)}};
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
              "an Acclaim motion needs a skeleton file, but its folder contains {} .asf files; allowed: exactly one, "
              "or one with a name that begins the motion's name ('01.asf' for '01_01.amc')",
              found.empty() ? "no" : std::to_string(found.size()));
}

Result<Clip> ReadAcclaim(std::string_view bytes, const std::string& path, CappedReader& reader, AcclaimFacts& facts) {
  ASSIGN_OR_RETURN(const auto skeleton_path, AcclaimSkeletonBeside(path));
  ASSIGN_OR_RETURN(const auto text, reader.Read(skeleton_path));
  ASSIGN_OR_RETURN(const auto skeleton, ReadAcclaimSkeleton(text, skeleton_path));
  return ReadAcclaimMotion(bytes, skeleton, path, &facts);
}

/// Returns the roles that the bones of a VRM file play. Spine, hands, feet and crown are left to FindJointMap.
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

/// Reads JSON files that describe a recording of Motion-BIDS (FindBidsFiles); files of higher folders come first; their
/// values apply unless files of lower folders override them. Returns an object; an empty one if there is no file.
Result<Json> ReadBidsJson(const std::vector<std::string>& files, CappedReader& reader) {
  Json all = Json::object();
  for (const std::string& file : files) {
    ASSIGN_OR_RETURN(const auto text, reader.Read(file));
    ASSIGN_OR_RETURN(const Json json, ReadJson(text, file));
    if (json.is_object()) all.update(json);
  }
  return all;
}

/// Returns the nearest of the files, or else the name of the file that should be beside the recording.
std::string NearestOr(const std::vector<std::string>& files, const std::string& beside) {
  return files.empty() ? beside : files.back();
}

/// Reads the rate, and the text that stands for a missing value, from the _motion.json of Motion-BIDS.
Result<BidsFacts> ReadBidsFacts(const std::string& path, const std::string& stem, CappedReader& reader) {
  const std::vector<std::string> files = FindBidsFiles(path, "motion.json");
  const std::string file = NearestOr(files, stem + "_motion.json");
  ASSIGN_OR_RETURN(const Json json, ReadBidsJson(files, reader));
  if (files.empty()) RETURN_IF_ERROR(reader.Read(file));  // the error says which file is missing
  const auto rate = json.find("SamplingFrequency");
  constexpr double kMinRate_hz = 0.1, kMaxRate_hz = 10'000;
  BidsFacts facts{.rate_hz = rate != json.end() && rate->is_number() ? rate->get<double>() : 0};
  if (const auto missing = json.find("MissingValues"); missing != json.end()) {
    facts.missing = missing->is_string() ? missing->get<std::string>() : missing->dump();
  }
  if (facts.rate_hz >= kMinRate_hz && facts.rate_hz <= kMaxRate_hz) return facts;
  return Fail({file}, "SamplingFrequency is missing or out of range; allowed: a number from {:g} to {:g} Hz",
              kMinRate_hz, kMaxRate_hz);
}

/// Returns the rule for the up axis of a Motion-BIDS recording. The optional file _channels.json states the axes of its
/// reference frames. Fails if two of them differ. Only the frames named in `used` count, or all if `used` is empty.
Result<UpRule> UpOfBids(const std::string& path, const std::set<std::string, std::less<>>& used, CappedReader& reader) {
  UpRule rule = ArrayUp();
  const std::vector<std::string> files = FindBidsFiles(path, "channels.json");
  ASSIGN_OR_RETURN(const Json json, ReadBidsJson(files, reader));
  const Json frames = json.value("reference_frame", Json());
  const Json levels = frames.is_object() ? frames.value("Levels", Json()) : Json();
  std::string stated;
  for (const auto& [name, level] : levels.items()) {
    if (!used.empty() && !used.contains(name)) continue;
    const auto axes = level.is_object() ? level.value("SpatialAxes", Json()) : Json();
    const auto up = axes.is_string() ? UpOfSpatialAxes(axes.get<std::string>()) : std::nullopt;
    if (!up) continue;
    if (!stated.empty() && stated != axes.get<std::string>()) {
      return Fail({files.back()},
                  "found reference frames with the SpatialAxes {} and {}; allowed: the same SpatialAxes for all "
                  "reference frames",
                  stated, axes.get<std::string>());
    }
    stated = axes.get<std::string>();
    rule = {.axis = *up, .evidence = UpEvidence::kFile, .source = "its SpatialAxes"};
  }
  return rule;
}

/// Makes a clip file from an array of joints, whose clock other arrays may state. `said` describes how the array was
/// turned to Y up; it is appended to the clip's remark.
Result<ClipFile> FileOfArray(const NumberArray& array, const std::optional<std::string>& layout,
                             const std::string& path, const OpenOptions& options, ArrayClock clock = {},
                             const std::string& said = "") {
  // If the array was turned, the array's up axis is known. A search for the up axis could turn a handstand into a
  // stance.
  const bool is_known = !said.empty();
  ASSIGN_OR_RETURN(auto joints, JointsOfArray(array, layout, path, is_known ? UpAxis::kY : ToldUp(options)));
  MarkerMotion motion = std::move(joints.motion);
  if (is_known) motion.remark += "; " + said;
  const bool has_rate = clock.IsStated() || ToldOfArrays(options).rate_hz;
  if (std::string doubt = has_rate ? "" : DescribeFewFrames(motion); !doubt.empty()) motion.remark += "; " + doubt;
  ASSIGN_OR_RETURN(motion, LayOnClock(std::move(motion), std::move(clock), path));
  MarkerOptions told = ToldOfMarkers(options, is_known ? CameraUp() : ArrayUp());
  told.layout = std::move(joints.layout);
  const bool has_own_names = std::ranges::find(motion.names, RoleName(Role::kLeftHip)) != motion.names.end();
  if (told.set.empty() && has_own_names) told.set = "etude";  // some layouts use the names of a known marker set
  told.is_of_camera = is_known || joints.is_of_camera;
  ASSIGN_OR_RETURN(auto file,
                   FileOfMarkers(is_known ? ClipFormat::kNpz : ClipFormat::kNpy, std::move(motion), path, told));
  file.has_rate = has_rate;
  return file;
}

/// Reads arrays: bodies that Etude wrote, motions of AMASS and Kimodo, or positions of joints.
Result<ClipFile> FileOfArrays(std::string_view bytes, const std::optional<std::string>& layout, const std::string& path,
                              const OpenOptions& options) {
  ASSIGN_OR_RETURN(const auto arrays, ReadNpz(bytes, path));
  if (IsBodyNpz(arrays)) {
    ASSIGN_OR_RETURN(auto raw, ReadRawNpz(arrays, path, ToldOfArrays(options)));
    if (const auto motion = BodyOf(raw)) {
      raw.Doubt(DescribeExchangedJoints(RolesIn(raw), raw.rate_hz));
      std::vector<std::string> notes = {"Etude's own arrays"};
      notes.insert(notes.end(), raw.notes.begin(), raw.notes.end());
      ClipFile file = FileOfBody(ClipFormat::kNpz, *motion, path, std::move(notes));
      file.bodies[0].doubts = raw.doubts;
      file.bodies[0].start_s = raw.start_s;
      file.bodies[0].is_floor_known = !raw.is_of_camera;
      if (const auto up = ToldUp(options)) file.bodies[0].up = {.axis = AxisOf(*up), .evidence = UpEvidence::kTold};
      return file;
    }
    // If the joints are not the twenty canonical ones, or if tracks have gaps, find the body by the joints' names.
    return FileOfJoints(ClipFormat::kNpz, raw, path, options);
  }
  const std::optional<double> told_hz = ToldOfArrays(options).rate_hz;
  std::vector<std::string> remarks;
  if (IsKimodoNpz(arrays)) {
    ASSIGN_OR_RETURN(auto clip, ReadKimodo(arrays, path, told_hz, remarks));
    ClipFile file = FileOfOne(ClipFormat::kNpz, std::move(clip), std::move(remarks));
    file.roles = JointMapOverrides{.joints = {}, .metres_per_unit = 1, .up = UpAxis::kY};
    return file;
  }
  std::string note;
  ASSIGN_OR_RETURN(const auto joints, JointsOfSam(arrays, path, note));
  if (joints) {
    ArrayClock clock;
    if (!told_hz) {
      ASSIGN_OR_RETURN(clock, ClockOfArrays(arrays, joints->shape[0], path));
    }
    return FileOfArray(*joints, layout, path, options, std::move(clock), note);
  }
  ASSIGN_OR_RETURN(auto clip, ReadAmass(arrays, path, told_hz, &remarks));
  return FileOfOne(ClipFormat::kAmass, std::move(clip), std::move(remarks));
}

constexpr std::string_view kBidsEnd = "_motion.tsv";

/// Reads Motion-BIDS: a table of numbers; two files beside it, or in folders above, hold the columns' names and the
/// rate.
Result<ClipFile> FileOfBids(std::string_view bytes, const std::string& path, const OpenOptions& options,
                            CappedReader& reader) {
  const std::string stem = path.substr(0, path.size() - kBidsEnd.size());
  const std::string named = NearestOr(FindBidsFiles(path, "channels.tsv"), stem + "_channels.tsv");
  ASSIGN_OR_RETURN(const auto channels, reader.Read(named));
  ASSIGN_OR_RETURN(const BidsFacts facts, ReadBidsFacts(path, stem, reader));
  ASSIGN_OR_RETURN(auto joints, ReadMotionBids(bytes, channels, facts, {path, named}));
  ASSIGN_OR_RETURN(auto up, UpOfBids(path, FramesOfBids(channels), reader));
  return FileOfMarkers(ClipFormat::kBids, std::move(joints), path, ToldOfMarkers(options, std::move(up)));
}

/// Reads glTF, GLB, and FBX, which is converted to GLB first.
Result<ClipFile> FileOfScene(ClipFormat format, std::string_view bytes, const std::string& path, CappedReader& reader) {
  const bool is_fbx = format == ClipFormat::kFbx;
  ClipFile file;
  file.format = format;
  FbxMotion fbx;
  if (is_fbx) {
    ASSIGN_OR_RETURN(fbx, ReadFbx(bytes, path));
    file.remarks.push_back("read by " + fbx.reader);
    if (!fbx.remark.empty()) file.remarks.push_back(fbx.remark);
  }
  auto read = ReadGltf(
      is_fbx ? fbx.glb : bytes, path, [&](const std::string& uri) { return ReadBeside(path, uri, reader); },
      DecodeTexture);
  if (!read && is_fbx) return Fail({path}, "the motion of the FBX file cannot be used: {}", read.error().message);
  ASSIGN_OR_RETURN(auto content, std::move(read));
  for (std::string& remark : content.remarks) file.remarks.push_back(std::move(remark));
  file.figure = std::move(content.character);
  file.clips = std::move(content.clips);
  file.roles = RolesOfBones(content.bones, file.figure.skeleton);
  file.skinned = std::move(content.skinned);
  return file;
}

}  // namespace

std::string_view FormatName(ClipFormat format) {
  constexpr std::array kNames = {"BVH",    "glTF", "GLB",         "FBX",       "DeepMimic", "Acclaim",
                                 "AMASS",  "C3D",  "TRC",         "CSV",       "NPZ",       "NPY",
                                 "Motive", "MOT",  "Motion-BIDS", "recording", "built-in"};
  return kNames[static_cast<std::size_t>(format)];
}

Result<ClipFile> ReadClipFile(const std::string& path, const std::optional<std::string>& layout,
                              const OpenOptions& options) {
  CappedReader reader;
  ASSIGN_OR_RETURN(auto bytes, reader.Read(path));
  bytes.erase(0, bytes.size() - WithoutByteOrderMark(bytes).size());
  TextScanner scanner(bytes, path);
  const bool has_text = scanner.SkipToText();
  const Token first = has_text ? scanner.Next() : Token{};

  // Try arrays and tables of numbers.
  if (IsZip(bytes)) return FileOfArrays(bytes, layout, path, options);
  if (IsNpy(bytes)) {
    ASSIGN_OR_RETURN(const auto array, ReadNpy(bytes, path));
    return FileOfArray(array, layout, path, options);
  }
  if (path.ends_with(kBidsEnd)) return FileOfBids(bytes, path, options, reader);
  // Try markers, and recordings of runs.
  if (auto read = ReadMarkers(bytes, path)) {
    ASSIGN_OR_RETURN(auto markers, *std::move(read));
    MarkerOptions told = ToldOfMarkers(options, std::move(markers.rule));
    told.layout = markers.layout;
    ASSIGN_OR_RETURN(auto file, FileOfMarkers(markers.format, std::move(markers.markers), path, told));
    file.has_rate = markers.has_rate;
    return file;
  }
  if (options.recorded != nullptr && options.recorded->IsRecording(bytes))
    return options.recorded->Read(bytes, path, options);
  // Try text formats of bodies: OpenSim's angles and DeepMimic's motions.
  if (first.text == "Coordinates" && HasModelOfAngles(bytes)) {
    std::string note = "the angles belong to the model in the file's header";
    double start_s = 0;
    ASSIGN_OR_RETURN(const auto motion, ReadOpenSimMotion(bytes, path, &note, &start_s));
    ClipFile file = FileOfBody(ClipFormat::kMot, motion, path, {note});
    file.bodies[0].start_s = start_s;
    return file;
  }
  if (first.text == "{" && IsDeepMimicMotion(bytes)) {
    ASSIGN_OR_RETURN(auto clip, ReadDeepMimicMotion(bytes, path));
    return FileOfOne(ClipFormat::kDeepMimic, std::move(clip));
  }
  // Try scenes.
  if (first.text == "{" && bytes.find("\"asset\"") == std::string::npos) {
    return Fail(scanner.At(first), "{}", DescribeOtherFile(bytes, first.text));
  }
  if (first.text == "{") return FileOfScene(ClipFormat::kGltf, bytes, path, reader);
  if (bytes.starts_with("glTF")) return FileOfScene(ClipFormat::kGlb, bytes, path, reader);
  if (IsFbx(bytes)) return FileOfScene(ClipFormat::kFbx, bytes, path, reader);
  // Try Acclaim and BVH; the error message of the BVH reader describes any other file.
  if (IsAcclaimMotion(bytes)) {
    AcclaimFacts facts;
    ASSIGN_OR_RETURN(auto clip, ReadAcclaim(bytes, path, reader, facts));
    ClipFile file = FileOfOne(ClipFormat::kAcclaim, std::move(clip), std::move(facts.remarks));
    file.has_rate = facts.has_rate;
    return file;
  }
  if (!EqualsIgnoringCase(first.text, "HIERARCHY")) {
    return Fail(scanner.At(first),
                "found {}; allowed: BVH (it begins with HIERARCHY), glTF 2.0 (.glb, .gltf), FBX, Acclaim's .amc, "
                "AMASS's .npz, C3D, TRC, joint CSV, Motive's CSV, _motion.tsv of Motion-BIDS, .npy of joints, .mot "
                "written by Etude, DeepMimic's motions",
                DescribeOtherFile(bytes, first.text));
  }
  std::vector<std::string> remarks;
  ASSIGN_OR_RETURN(auto clip, ReadBvh(bytes, path, &remarks, ToldOfArrays(options).rate_hz));
  return FileOfOne(ClipFormat::kBvh, std::move(clip), std::move(remarks));
}

}  // namespace etude
