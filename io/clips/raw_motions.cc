#include "io/clips/raw_motions.h"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "engine/base/digest.h"
#include "engine/base/names.h"
#include "engine/base/text.h"
#include "engine/base/utf8.h"
#include "engine/formats/kimodo.h"
#include "engine/formats/npz.h"
#include "engine/retargeting/data_set_names.h"
#include "engine/retargeting/joint_arrays.h"
#include "engine/retargeting/marker_repairs.h"
#include "engine/retargeting/marker_sets.h"
#include "engine/retargeting/orientation.h"
#include "io/clips/marker_files.h"
#include "io/clips/references.h"
#include "io/files/files.h"

namespace etude {
namespace {

/// Returns the rotation part of a matrix of axes that may be scaled.
glm::dquat RotationOf(const glm::dmat3& axes) {
  const auto unit = [](const glm::dvec3& axis) { return glm::dot(axis, axis) > 0 ? glm::normalize(axis) : axis; };
  return glm::normalize(glm::quat_cast(glm::dmat3(unit(axes[0]), unit(axes[1]), unit(axes[2]))));
}

/// Converts a clip with a skeleton; `unit` is the length of the clip's unit in metres.
RawMotion OfSkeleton(const Clip& clip, double unit, UpAxis up) {
  // The rotation that Upright applies: X stays, Z becomes Y.
  const glm::dquat turn =
      up == UpAxis::kY ? glm::dquat(1, 0, 0, 0) : glm::quat_cast(glm::dmat3(1, 0, 0, 0, 0, -1, 0, 1, 0));
  RawMotion raw;
  raw.rate_hz = clip.rate_hz;
  // Copy the joints, the rest pose and the frames, in the world with Y up.
  for (const Joint& joint : clip.skeleton.joints) {
    if (joint.is_end_site) raw.added.push_back(static_cast<int>(raw.joints.size()));
    raw.joints.push_back(joint.name);
    raw.parents.push_back(joint.parent);
  }
  raw.positions.reserve(clip.frames.size() * raw.joints.size());
  raw.rotations.reserve(clip.frames.size() * raw.joints.size());
  std::vector<GlobalTransform> globals;
  ComputeGlobals(clip.skeleton, RestPose(clip.skeleton), globals);
  for (const GlobalTransform& joint : globals) {
    raw.rest_positions.push_back(Upright(unit * joint.position, up));
    raw.rest_rotations.push_back(turn * RotationOf(joint.axes));
  }
  for (const LocalPose& frame : clip.frames) {
    ComputeGlobals(clip.skeleton, frame, globals);
    for (const GlobalTransform& joint : globals) {
      raw.positions.push_back(Upright(unit * joint.position, up));
      raw.rotations.push_back(turn * RotationOf(joint.axes));
    }
  }
  return raw;
}

/// Returns true if the joint from which both hips branch is a pelvis by its name or its position, or if the user's
/// roles name the hip centre.
bool CarriesAsPelvis(const RawMotion& raw, const JointMap& map, const JointMapOverrides* told) {
  if (told != nullptr && told->joints.contains(Role::kHipCentre)) return true;
  const std::string name = InLowerCase(raw.joints[map[Role::kHipCentre].joint]);
  if (name.ends_with("hips") || name.ends_with("pelvis")) return true;
  // Distance from the hips' middle in thigh lengths. Pelvises of 4 libraries: ≤ 0.33; OpenNI's torso: 0.44–0.50.
  constexpr double kMaxThighs = 0.4;
  const auto at_rest = [&](Role role) { return raw.rest_positions[map[role].joint]; };
  const glm::dvec3 left = at_rest(Role::kLeftHip), right = at_rest(Role::kRightHip);
  const double thighs = glm::distance(left, at_rest(Role::kLeftKnee)) + glm::distance(right, at_rest(Role::kRightKnee));
  return glm::distance(at_rest(Role::kHipCentre), 0.5 * (left + right)) <= kMaxThighs * 0.5 * thighs;
}

std::string NamesOf(const std::vector<Role>& roles) {
  std::vector<std::string> names;
  for (const Role role : roles) names.emplace_back(RoleName(role));
  return Join(names);
}

/// Returns notes on the conversions and assumptions that were made.
std::vector<std::string> NotesOn(const OpenedClip& opened) {
  const BodyConversion& body = opened.body;
  std::vector<std::string> notes = {fmt::format("1 unit = {:.4g} cm ({})", 100 * body.metres_per_unit, body.unit)};
  if (body.unit == "unknown" || body.unit == "scaled") notes.back() += ", estimated from the body's height";
  if (body.up == UpAxis::kZ) notes.emplace_back("turned upright from Z up");
  if (!opened.map.composed.empty()) notes.push_back("has no " + NamesOf(opened.map.composed));
  if (!opened.map.by_anatomy.empty()) {
    notes.push_back("roles found by the skeleton's shape: " + NamesOf(opened.map.by_anatomy));
  }
  notes.insert(notes.end(), opened.source.remarks.begin(), opened.source.remarks.end());
  notes.insert(notes.end(), body.doubts.begin(), body.doubts.end());
  return notes;
}

/// Returns the foot contacts that an .npz file stores; empty if it stores none.
Result<std::vector<bool>> ContactsIn(const std::string& reference, std::size_t frames) {
  const std::string path = FileOf(Split(reference).path);
  ASSIGN_OR_RETURN(const auto bytes, ReadWholeFile(path));
  ASSIGN_OR_RETURN(const auto arrays, ReadNpz(bytes, path));
  ASSIGN_OR_RETURN(const auto contacts, ReadFootContacts(arrays, frames, path));
  return contacts.value_or(std::vector<bool>{});
}

/// Returns true if a reference is the name of a ZIP file, as .npz files are.
bool BeginsAsZip(const std::string& reference) {
  std::string head(4, '\0');
  std::ifstream file(reference, std::ios::binary);
  return file.read(head.data(), static_cast<std::streamsize>(head.size())) && IsZip(head);
}

/// Returns true if the joints' names state a joint for every needed role, no role is played by the mean of several
/// joints, and the user's joint map names none of these joints.
bool HasTheRoles(const RawMotion& raw, const OpenOptions& options) {
  const auto is_told = [&](const std::string& joint) {
    const auto names = [&](const auto& told) { return MarkerKey(told.second.name) == MarkerKey(joint); };
    return options.roles && std::ranges::any_of(options.roles->joints, names);
  };
  const auto known = FindDataSet(raw.joints);
  const auto is_mean = [](const KnownJoint& one) { return one.points.size() > 1; };
  if (known && std::ranges::any_of(known->joints, is_mean)) return false;
  return std::ranges::none_of(kNeededJoints, [&](Role role) { return raw.roles[Index(role)] < 0; }) &&
         std::ranges::none_of(raw.joints, is_told);
}

/// Converts markers that no set explains: joints without roles, with the unit and the up axis that the file states.
RawMotion OfUnknownMarkers(const MarkerFile& file, const std::string& reference, const OpenOptions& options,
                           const std::string& why) {
  const MarkerOptions told = ToldOfMarkers(options, file.rule);
  const double scale = told.metres_per_unit.value_or(file.markers.metres_per_unit) / file.markers.metres_per_unit;
  RawMotion raw;
  raw.name = reference;
  raw.rate_hz = file.markers.rate_hz;
  raw.start_s = file.markers.start_s;
  if (options.roles && options.roles->rate_hz) {
    raw.rate_hz = *options.roles->rate_hz;
    raw.start_s.reset();
  }
  raw.joints = file.markers.names;
  for (const auto& frame : file.markers.frames) {
    for (const MarkerPosition& place : frame) {
      raw.positions.push_back(place ? TurnedUp(scale * *place, told.up.axis) : NotSeen());
    }
  }
  raw.notes = {why, fmt::format("{} is up ({})", AxisName(told.up.axis), told.up.source)};
  return raw;
}

/// Converts arrays of positions directly, without a skeleton.
Result<RawMotion> OfArrays(const Npz& arrays, const std::string& reference, const OpenOptions& options) {
  ASSIGN_OR_RETURN(auto raw, ReadRawNpz(arrays, reference, ToldOfArrays(options)));
  const auto body = BodyOf(raw);
  if (body) raw.Doubt(DescribeImpossibleHeight(body->poses));
  if (raw.roles[Index(Role::kHipCentre)] < 0) AddMidwayHips(raw);
  return raw;
}

}  // namespace

Result<RawMotion> RawMotionOf(SourceClip source, const OpenOptions& options, bool keeps_rig) {
  const std::string name = source.source;
  const ClipFormat format = source.format;
  RawMotion raw;
  if (source.shown != nullptr) {
    raw = *source.shown;
    if (source.made) std::ranges::for_each(source.made->doubts, [&](const std::string& said) { raw.Doubt(said); });
  } else {
    // UnderstandClip finds roles, unit and up axis; the resampled motion and the floor that it computes are not used
    // here.
    const bool is_body = source.format == ClipFormat::kBuiltin || source.made.has_value();
    const std::optional<double> start_s = source.made ? source.made->start_s : std::nullopt;
    OpenOptions how = options;
    how.body.drop_t_pose = false;
    how.body.floor = 0;
    ASSIGN_OR_RETURN(const auto opened, UnderstandClip(std::move(source), how));
    raw = OfSkeleton(opened.source.clip, opened.body.metres_per_unit, opened.body.up);
    raw.start_s = start_s;
    for (const Role role : AllRoles()) {
      const bool is_composed = std::ranges::find(opened.map.composed, role) != opened.map.composed.end();
      if (!is_composed) raw.roles[Index(role)] = opened.map[role].joint;
    }
    const JointMapOverrides* told = options.roles ? &*options.roles : nullptr;
    if (!is_body && !CarriesAsPelvis(raw, opened.map, told)) raw.roles[Index(Role::kHipCentre)] = -1;
    if (is_body && !keeps_rig) {
      raw.rotations.clear();  // RigClip computed these rotations; the file has none
      raw.rest_rotations.clear();
      raw.rest_positions.clear();
    } else {
      raw.notes = NotesOn(opened);
    }
    for (const std::string& doubt : opened.body.doubts) raw.Doubt(doubt);
  }
  raw.name = name;
  if (raw.roles[Index(Role::kHipCentre)] < 0) AddMidwayHips(raw);
  if (format == ClipFormat::kNpz || format == ClipFormat::kAmass) {
    ASSIGN_OR_RETURN(raw.contacts, ContactsIn(name, raw.FrameCount()));
  }
  if (raw.positions.empty()) return Fail({name}, "the motion has no frames; allowed: at least one");
  return raw;
}

Result<std::string> DigestOfFile(const std::string& reference, const OpenOptions& options) {
  if (reference.starts_with(kBuiltinPrefix)) return Digest().Add(std::string_view(reference)).Hex();
  SplitReference wanted = Split(reference);
  if (options.recorded != nullptr) {
    ASSIGN_OR_RETURN(wanted, options.recorded->Find(wanted));
  }
  Digest digest;
  RETURN_IF_ERROR(ReadInChunks(FileOf(wanted.path), [&](std::string_view bytes) { digest.Add(bytes); }));
  return digest.Hex();
}

Result<RawMotion> OpenRawMotion(const std::string& reference, const OpenOptions& options, bool keeps_rig) {
  OpenOptions how = options;
  how.keeps_shown = true;
  if (BeginsAsZip(reference)) {
    ASSIGN_OR_RETURN(const auto bytes, ReadWholeFile(reference, kMaxClipFileBytes));
    ASSIGN_OR_RETURN(const auto arrays, ReadNpz(bytes, reference));
    if (IsBodyNpz(arrays)) {
      ASSIGN_OR_RETURN(auto raw, OfArrays(arrays, reference, options));
      if (HasTheRoles(raw, options)) return raw;
      // The names may be those of a marker set or of a known skeleton, in which ReadOneClip finds the body.
      auto clip = ReadOneClip(reference, how);
      return clip ? RawMotionOf(*std::move(clip), options) : raw;
    }
  }
  auto clip = ReadOneClip(reference, how);
  if (clip) return RawMotionOf(*std::move(clip), options, keeps_rig);
  // Markers that no set explains can still be compared by their names.
  const std::string path = FileOf(Split(reference).path);
  std::error_code none;
  if (!std::filesystem::is_regular_file(path, none)) return tl::unexpected(clip.error());
  ASSIGN_OR_RETURN(const auto bytes, ReadWholeFile(path, kMaxClipFileBytes));
  const auto read = ReadMarkers(WithoutByteOrderMark(bytes), path);
  if (!read || !*read) return tl::unexpected(clip.error());
  MarkerFile file = **read;
  RepairMarkers(file.markers);
  const std::string why = DescribeUnknownMarkers(file.markers, ToldOfMarkers(options, file.rule));
  if (why.empty()) return tl::unexpected(clip.error());
  return OfUnknownMarkers(file, reference, options, why);
}

}  // namespace etude
