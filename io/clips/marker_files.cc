#include "io/clips/marker_files.h"

#include <algorithm>
#include <array>
#include <utility>

#include "engine/base/text.h"
#include "engine/formats/c3d.h"
#include "engine/formats/joint_csv.h"
#include "engine/formats/motive_csv.h"
#include "engine/formats/point_table.h"
#include "engine/formats/row_clock.h"
#include "engine/retargeting/array_evidence.h"
#include "engine/retargeting/joint_arrays.h"
#include "engine/retargeting/rig.h"
#include "sim/choreography/canonical_body.h"

namespace etude {

std::optional<UpAxis> ToldUp(const OpenOptions& options) {
  return options.body.up || !options.roles ? options.body.up : options.roles->up;
}
std::optional<double> ToldUnit(const OpenOptions& options) {
  return options.body.metres_per_unit || !options.roles ? options.body.metres_per_unit : options.roles->metres_per_unit;
}
bool KeepsFloor(const OpenOptions& options) {
  return options.body.keep_floor || (options.roles && options.roles->keep_floor);
}

ArrayOptions ToldOfArrays(const OpenOptions& options) {
  return {.rate_hz = options.roles ? options.roles->rate_hz : std::nullopt,
          .metres_per_unit = ToldUnit(options),
          .up = ToldUp(options)};
}

MarkerOptions ToldOfMarkers(const OpenOptions& options, UpRule rule) {
  if (const auto up = ToldUp(options)) rule = {.axis = AxisOf(*up), .evidence = UpEvidence::kTold, .source = "told"};
  MarkerOptions told{
      .up = std::move(rule),
      .keep_floor = KeepsFloor(options),
      .metres_per_unit = ToldUnit(options),
      .set = options.roles && options.marker_set.empty() ? options.roles->marker_set : options.marker_set,
      .keeps_shown = options.keeps_shown,
      .keeps_others = options.keeps_others};
  if (!options.roles) return told;
  for (const auto& [role, joint] : options.roles->joints) told.roles[role] = joint.name;
  return told;
}

Result<ClipFile> FileOfMarkers(ClipFormat format, MarkerMotion markers, const std::string& path,
                               const MarkerOptions& options) {
  const std::optional<double> file_start_s = markers.start_s;
  ASSIGN_OR_RETURN(auto bodies, FindMarkerBodies(std::move(markers), path, options));
  ClipFile file{.format = format, .figure = {.name = "", .skeleton = {}, .materials = {}, .meshes = {}}, .clips = {}};
  for (MarkerBody& body : bodies) {
    file.clips.push_back(RigClip(body.motion, StandingPose(), body.name));
    const double cut_s = static_cast<double>(body.first_frame) / body.motion.rate_hz;
    const auto start_s = file_start_s ? std::optional(*file_start_s + cut_s) : std::nullopt;
    file.bodies.push_back({body.changes, body.up, body.floor, body.is_floor_known, body.first_frame, start_s,
                           std::move(body.others), std::move(body.markers), std::move(body.doubts)});
    if (options.keeps_shown) file.shown.push_back(std::move(body.shown));
  }
  file.figure.skeleton = file.clips.front().skeleton;
  return file;
}

Result<ClipFile> FileOfJoints(ClipFormat format, const RawMotion& motion, const std::string& path,
                              OpenOptions options) {
  options.body.up.reset();
  if (options.roles) options.roles->up.reset();
  options.body.metres_per_unit = 1;
  options.body.keep_floor = options.body.keep_floor || !motion.is_of_camera;
  MarkerOptions told = ToldOfMarkers(options, RawArraysUp());
  told.is_of_camera = motion.is_of_camera;
  ASSIGN_OR_RETURN(auto file, FileOfMarkers(format, MarkersOf(motion), path, told));
  const auto add = [](const std::vector<std::string>& from, std::vector<std::string>& said) {
    said.insert(said.end(), from.begin(), from.end());
  };
  for (MadeBody& body : file.bodies) {
    add(motion.notes, body.changes);
    add(motion.doubts, body.doubts);
  }
  for (RawMotion& shown : file.shown) add(motion.notes, shown.notes);
  return file;
}

namespace {

Result<MarkerFile> ReadJointTable(std::string_view text, const std::string& path) {
  ASSIGN_OR_RETURN(const auto csv, ReadJointCsv(text, path));
  ASSIGN_OR_RETURN(auto markers, LayOnClock(csv, path));
  return MarkerFile{ClipFormat::kCsv, std::move(markers), JointCsvUp(), csv.rate_hz.has_value()};
}

Result<MarkerFile> ReadTableOfPoints(std::string_view text, const std::string& path) {
  ASSIGN_OR_RETURN(auto table, ReadPointTable(text, path));
  ASSIGN_OR_RETURN(auto markers, LayOnClock(std::move(table.rows), path));
  if (!table.has_unit) ScaleToPerson(markers);
  return MarkerFile{ClipFormat::kCsv, std::move(markers), TableUp(), table.has_rate, "table"};
}

}  // namespace

std::optional<Result<MarkerFile>> ReadMarkers(std::string_view bytes, const std::string& path) {
  const auto with = [](ClipFormat format, Result<MarkerMotion> read, UpRule rule) -> Result<MarkerFile> {
    if (!read) return tl::unexpected(read.error());
    return MarkerFile{format, *std::move(read), std::move(rule)};
  };
  // A blank line before the P of PathFileType looks like the first two bytes of a C3D, so test for TRC first.
  const std::string_view heading = FirstLine(bytes);
  if (heading.starts_with("PathFileType")) return with(ClipFormat::kTrc, ReadTrc(bytes, path), TrcUp());
  if (IsC3d(bytes)) {
    auto read = ReadC3d(bytes, path);
    if (!read) return tl::unexpected(read.error());
    return MarkerFile{ClipFormat::kC3d, std::move(read->markers), C3dUp(read->up, read->is_up_negative)};
  }
  if (IsMotiveCsv(bytes)) return with(ClipFormat::kMotive, ReadMotiveCsv(bytes, path), MotiveUp());
  if (IsJointCsv(heading)) return ReadJointTable(bytes, path);
  if (IsPointTable(bytes)) return ReadTableOfPoints(bytes, path);
  return std::nullopt;
}

std::optional<UpRule> UpRuleOf(ClipFormat format) {
  switch (format) {
    case ClipFormat::kGltf:
    case ClipFormat::kGlb:
      return GltfUp();
    case ClipFormat::kFbx: {
      UpRule of_file = GltfUp();  // assimp has already rotated the scene by the file's own settings
      of_file.evidence = UpEvidence::kFile;
      of_file.source = "the up axis in the file's settings";
      return of_file;
    }
    case ClipFormat::kDeepMimic:
      return DeepMimicUp();
    case ClipFormat::kAmass:
      return AmassUp();
    default:
      return std::nullopt;
  }
}

bool IsOfAnimations(ClipFormat format) {
  return format == ClipFormat::kGltf || format == ClipFormat::kGlb || format == ClipFormat::kFbx;
}

bool IsOfMarkers(ClipFormat format) {
  constexpr std::array kFormats = {ClipFormat::kC3d, ClipFormat::kTrc,    ClipFormat::kCsv, ClipFormat::kNpz,
                                   ClipFormat::kNpy, ClipFormat::kMotive, ClipFormat::kBids};
  return std::ranges::find(kFormats, format) != kFormats.end();
}

}  // namespace etude
