#include "io/clips/raw_motions.h"

#include <algorithm>
#include <fstream>

#include "engine/base/digest.h"
#include "engine/base/names.h"
#include "engine/formats/kimodo.h"
#include "engine/formats/npz.h"
#include "engine/retargeting/joint_arrays.h"
#include "engine/retargeting/orientation.h"
#include "io/clips/references.h"
#include "io/files/files.h"

namespace etude {
namespace {

/// Appends the hip centre, midway between the hips, unless a joint of the file has that role. It gets the orientation
/// of the joint that carries the left hip.
void AddHipCentre(RawMotion& raw) {
  const int left = raw.roles[Index(Role::kLeftHip)], right = raw.roles[Index(Role::kRightHip)];
  if (raw.roles[Index(Role::kHipCentre)] >= 0 || left < 0 || right < 0) return;
  const std::size_t joints = raw.joints.size(), frames = raw.FrameCount();
  // Copy each frame with one joint more.
  std::vector<glm::dvec3> positions;
  positions.reserve(frames * (joints + 1));
  std::vector<glm::dquat> rotations;
  for (std::size_t f = 0; f < frames; ++f) {
    for (std::size_t j = 0; j < joints; ++j) positions.push_back(raw.At(f, j));
    positions.push_back(0.5 * (raw.At(f, left) + raw.At(f, right)));
    if (raw.rotations.empty()) continue;
    rotations.insert(rotations.end(), raw.rotations.begin() + static_cast<std::ptrdiff_t>(f * joints),
                     raw.rotations.begin() + static_cast<std::ptrdiff_t>((f + 1) * joints));
    const int carrier = raw.parents[left];
    rotations.push_back(carrier < 0 ? glm::dquat(1, 0, 0, 0) : raw.rotations[f * joints + carrier]);
  }
  // Add the joint's role, name, parent and rest pose.
  raw.positions = std::move(positions);
  raw.rotations = std::move(rotations);
  raw.roles[Index(Role::kHipCentre)] = static_cast<int>(joints);
  raw.added.push_back(static_cast<int>(joints));
  raw.joints.emplace_back(kMidwayHips);
  if (raw.parents.empty()) return;
  const int carrier = raw.parents[left];
  raw.parents.push_back(carrier);
  if (raw.rotations.empty()) return;
  raw.rest_positions.push_back(0.5 * (raw.rest_positions[left] + raw.rest_positions[right]));
  raw.rest_rotations.push_back(carrier < 0 ? glm::dquat(1, 0, 0, 0) : raw.rest_rotations[carrier]);
}

RawMotion OfMarkers(const MarkerMotion& shown) {
  RawMotion raw;
  raw.rate_hz = shown.rate_hz;
  raw.joints = shown.names;
  for (const Role role : AllRoles()) {
    const auto found = std::ranges::find(shown.names, RoleName(role));
    if (found != shown.names.end()) raw.roles[Index(role)] = static_cast<int>(found - shown.names.begin());
  }
  raw.positions.reserve(shown.frames.size() * shown.names.size());
  for (const auto& frame : shown.frames) {
    for (const auto& place : frame) raw.positions.push_back(place.value_or(NotSeen()));
  }
  raw.notes.push_back("markers: " + shown.remark);
  return raw;
}

/// Returns the rotation of axes that may be scaled.
glm::dquat RotationOf(const glm::dmat3& axes) {
  const auto unit = [](const glm::dvec3& axis) { return glm::dot(axis, axis) > 0 ? glm::normalize(axis) : axis; };
  return glm::normalize(glm::quat_cast(glm::dmat3(unit(axes[0]), unit(axes[1]), unit(axes[2]))));
}

/// Converts a clip with a skeleton; `unit` is the length of its unit in metres.
RawMotion OfSkeleton(const Clip& clip, double unit, UpAxis up) {
  // The rotation of Upright: X stays, Z becomes Y.
  const glm::dquat turn =
      up == UpAxis::kY ? glm::dquat(1, 0, 0, 0) : glm::quat_cast(glm::dmat3(1, 0, 0, 0, 0, -1, 0, 1, 0));
  RawMotion raw;
  raw.rate_hz = clip.rate_hz;
  // Copy the joints, their rest pose and the frames, in the world with Y up.
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

std::string NamesOf(const std::vector<Role>& roles) {
  std::vector<std::string> names;
  for (const Role role : roles) names.emplace_back(RoleName(role));
  return Join(names);
}

/// Returns notes on what was converted and assumed.
std::vector<std::string> NotesOn(const OpenedClip& opened) {
  const BodyConversion& body = opened.body;
  std::vector<std::string> notes = {fmt::format("1 unit = {:.4g} cm ({})", 100 * body.metres_per_unit, body.unit)};
  if (body.unit == "unknown" || body.unit == "scaled") notes.back() += ", estimated from the body's stature";
  if (body.up == UpAxis::kZ) notes.emplace_back("turned upright from Z up");
  if (!opened.map.composed.empty()) notes.push_back("has no " + NamesOf(opened.map.composed));
  if (!opened.map.by_anatomy.empty()) {
    notes.push_back("roles found by the skeleton's shape: " + NamesOf(opened.map.by_anatomy));
  }
  notes.insert(notes.end(), opened.source.remarks.begin(), opened.source.remarks.end());
  return notes;
}

/// Returns what an .npz file says of contacts; empty if it says nothing.
Result<std::vector<bool>> ContactsIn(const std::string& reference, std::size_t frames) {
  const std::string path = FileOf(Split(reference).path);
  ASSIGN_OR_RETURN(const auto bytes, ReadWholeFile(path));
  ASSIGN_OR_RETURN(const auto arrays, ReadNpz(bytes, path));
  ASSIGN_OR_RETURN(const auto contacts, ReadFootContacts(arrays, frames, path));
  return contacts.value_or(std::vector<bool>{});
}

}  // namespace

Result<RawMotion> RawMotionOf(SourceClip source, const OpenOptions& options, bool keeps_rig) {
  const std::string name = source.source;
  const ClipFormat format = source.format;
  RawMotion raw;
  if (source.shown != nullptr) {
    raw = OfMarkers(*source.shown);
  } else {
    // UnderstandClip finds roles, unit and up axis; its resampling and the floor that it finds are not used.
    const bool is_body = source.format == ClipFormat::kBuiltin || source.made.has_value();
    OpenOptions how = options;
    how.body.drop_t_pose = false;
    how.body.floor = 0;
    ASSIGN_OR_RETURN(const auto opened, UnderstandClip(std::move(source), how));
    raw = OfSkeleton(opened.source.clip, opened.body.metres_per_unit, opened.body.up);
    for (const Role role : AllRoles()) {
      const bool is_composed = std::ranges::find(opened.map.composed, role) != opened.map.composed.end();
      // The joint that carries both hips is not midway between them.
      const bool is_carrier = role == Role::kHipCentre && !is_body;
      if (!is_composed && !is_carrier) raw.roles[Index(role)] = opened.map[role].joint;
    }
    if (is_body && !keeps_rig) {
      raw.rotations.clear();  // made up by RigClip
      raw.rest_rotations.clear();
      raw.rest_positions.clear();
    } else {
      raw.notes = NotesOn(opened);
    }
  }
  raw.name = name;
  AddHipCentre(raw);
  if (format == ClipFormat::kNpz || format == ClipFormat::kAmass) {
    ASSIGN_OR_RETURN(raw.contacts, ContactsIn(name, raw.FrameCount()));
  }
  if (raw.positions.empty()) return Fail({name}, "no frames; at least one is needed");
  return raw;
}

namespace {

/// Returns true if a reference is the name of a ZIP file, as .npz files are.
bool BeginsAsZip(const std::string& reference) {
  std::string head(4, '\0');
  std::ifstream file(reference, std::ios::binary);
  return file.read(head.data(), static_cast<std::streamsize>(head.size())) && IsZip(head);
}

/// Converts arrays of positions, with no character in between.
Result<RawMotion> OfArrays(const Npz& arrays, const std::string& reference, const OpenOptions& options) {
  ASSIGN_OR_RETURN(auto raw, ReadRawNpz(arrays, reference));
  if (options.roles && options.roles->rate_hz) raw.rate_hz = *options.roles->rate_hz;
  AddHipCentre(raw);
  return raw;
}

}  // namespace

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

Result<RawMotion> OpenRawMotion(const std::string& reference, const OpenOptions& options) {
  if (BeginsAsZip(reference)) {
    ASSIGN_OR_RETURN(const auto bytes, ReadWholeFile(reference, kMaxClipFileBytes));
    ASSIGN_OR_RETURN(const auto arrays, ReadNpz(bytes, reference));
    if (IsBodyNpz(arrays)) return OfArrays(arrays, reference, options);
  }
  OpenOptions how = options;
  how.keeps_shown = true;
  ASSIGN_OR_RETURN(auto clip, ReadOneClip(reference, how));
  return RawMotionOf(std::move(clip), options);
}

}  // namespace etude
