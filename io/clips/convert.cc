#include "io/clips/convert.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <string_view>

#include "engine/base/names.h"
#include "engine/base/text.h"
#include "engine/formats/bvh.h"
#include "engine/formats/c3d.h"
#include "engine/formats/gltf/gltf.h"
#include "engine/formats/joint_csv.h"
#include "engine/formats/trc.h"
#include "engine/motion/edit.h"
#include "engine/retargeting/joint_arrays.h"
#include "engine/retargeting/opensim_motion.h"
#include "engine/retargeting/proportions.h"
#include "engine/retargeting/rig.h"
#include "sim/character/characters.h"
#include "sim/choreography/canonical_body.h"

namespace etude {
namespace {

bool ParseSeconds(std::string_view text, double& seconds) {
  if (text.empty()) return true;  // an end of the span that has no text stays open
  const auto value = ParseFinite(text);
  seconds = value.value_or(-1);
  return seconds >= 0;
}

// The maximum size of a resampled clip, bytes; reading a BVH file has the same limit.
constexpr double kMaxResampledBytes = 1e9;

/// Converts a clip of another unit and up axis to metres and Y up.
Clip InMetres(Clip clip, double metres_per_unit, UpAxis up) {
  const double half = glm::radians(-90.0) / 2;
  const glm::dquat upright =
      up == UpAxis::kY ? glm::dquat(1, 0, 0, 0) : glm::dquat(std::cos(half), std::sin(half), 0, 0);
  const auto convert = [&](LocalTransform& local, bool is_root) {
    local.translation *= metres_per_unit;
    if (!is_root) return;
    local.translation = upright * local.translation;
    local.rotation = upright * local.rotation;
  };
  for (std::size_t i = 0; i < clip.skeleton.joints.size(); ++i) {
    Joint& joint = clip.skeleton.joints[i];
    convert(joint.rest, joint.parent < 0);
    for (LocalPose& frame : clip.frames) convert(frame[i], joint.parent < 0);
  }
  return clip;
}

Result<Clip> Edited(const SourceClip& source, const ConvertOptions& options) {
  auto edited = TrimTo(source, options.trim);
  if (!edited) return edited;
  if (options.rate_hz) {
    const double frames = 1 + edited->DurationSeconds() * *options.rate_hz;
    const double bytes = frames * static_cast<double>(edited->skeleton.joints.size() * sizeof(LocalTransform));
    if (bytes > kMaxResampledBytes) {
      return Fail({}, "{:.0f} frames of {} joints would take {:.1f} GB; allowed: at most {:.0f} GB", frames,
                  edited->skeleton.joints.size(), bytes / 1e9, kMaxResampledBytes / 1e9);
    }
    *edited = Resample(*edited, *options.rate_hz);
  }
  if (options.mirror) *edited = Mirror(*edited);
  return edited;
}

/// Returns the time at which the converted part begins, by the file's own clock; a file without a clock begins at 0 s.
double StartOf(const SourceClip& source, const ConvertOptions& options) {
  const double rate_hz = source.clip.rate_hz, hidden_s = HiddenStart(source);
  const double trimmed_s = options.trim ? std::max(0.0, options.trim->from_s - hidden_s) : 0;
  return (source.made ? source.made->start_s.value_or(hidden_s) : 0) + std::round(trimmed_s * rate_hz) / rate_hz;
}

/// Describes when a motion begins, for a format without a clock, and for C3D, which counts time in whole frames; "" if
/// the output has the time of the input.
std::string DescribeStart(double start_s, double rate_hz, std::size_t frames, MotionFormat format) {
  using enum MotionFormat;
  constexpr double kSame_s = 1e-6;
  double written_s = start_s;
  if (format == kBvh || format == kGlb || format == kBids) written_s = 0;
  if (format == kC3d) written_s = StartInC3d(start_s, rate_hz, frames);
  if (std::abs(written_s - start_s) < kSame_s) return "";
  return fmt::format("time {:.6g} {}of the output is the time {:.10g} s of the input", written_s,
                     written_s == 0 ? "" : "s ", start_s);
}

/// Adds the user's edits to the list of changes. `from_hz` is the clip's own rate; or it is the wanted rate if
/// UnderstandClip has resampled the clip and described this.
void AddEdits(double from_hz, const ConvertOptions& options, std::vector<std::string>& changes) {
  if (options.trim) changes.emplace_back("trimmed");
  if (std::string said = DescribeResampling(from_hz, options.rate_hz.value_or(from_hz)); !said.empty()) {
    changes.push_back(std::move(said));
  }
  if (options.mirror) changes.emplace_back("mirrored: left and right are exchanged");
}

/// Finds the unit and the up axis of a clip that is not from a glTF file. If no roles are found, `options` must give
/// the unit.
Result<BodyConversion> FindUnit(const SourceClip& source, const OpenOptions& options) {
  auto opened = UnderstandClip(source, options);
  if (opened) return std::move(opened->body);
  if (options.body.metres_per_unit) {
    BodyConversion told;
    told.metres_per_unit = *options.body.metres_per_unit;
    told.up = options.body.up.value_or(UpAxis::kY);
    told.unit = "given";
    return told;
  }
  opened.error().message +=
      "; use --unit to state the unit, because GLB files are in metres and Etude found no roles from which it could "
      "estimate the unit";
  return tl::unexpected(std::move(opened.error()));
}

Result<Converted> ConvertOwnSkeletons(std::vector<SourceClip> sources, MotionFormat format,
                                      const ConvertOptions& options) {
  Converted converted{.bytes = "", .note = "own skeleton", .changes = {}};
  std::vector<Clip> clips;
  // Edit each clip. GLB requires metres and Y up, so clips that are not from a glTF file are converted.
  for (const SourceClip& source : sources) {
    if (std::string said =
            DescribeStart(StartOf(source, options), source.clip.rate_hz, source.clip.frames.size(), format);
        !said.empty()) {
      converted.changes.push_back(std::move(said));
    }
    auto edited = Edited(source, options);
    if (!edited) return Fail({source.source, 0, 0}, "{}", edited.error().message);
    if (format == MotionFormat::kGlb && source.format != ClipFormat::kGltf && source.format != ClipFormat::kGlb) {
      ASSIGN_OR_RETURN(const auto unit, FindUnit(source, options.open));
      *edited = InMetres(std::move(*edited), unit.metres_per_unit, unit.up);
      if (clips.empty()) {
        converted.changes.push_back(
            fmt::format("in metres, 1 unit = {:.4g} cm ({})", 100 * unit.metres_per_unit, unit.unit));
        if (std::string turn = DescribeTurn(unit.found_up); !turn.empty()) converted.changes.push_back(std::move(turn));
        if (!unit.found_up.doubt.empty()) converted.changes.push_back(unit.found_up.doubt);
      }
    }
    clips.push_back(std::move(*edited));
  }
  // Report what the file's reader found, and, if the body is understood, doubts about the body.
  const auto say = [&](const std::vector<std::string>& texts) {
    for (const std::string& text : texts) {
      if (std::ranges::find(converted.changes, text) == converted.changes.end()) converted.changes.push_back(text);
    }
  };
  if (sources.front().made) say(sources.front().made->changes);
  say(sources.front().remarks);
  if (const auto opened = UnderstandClip(sources.front(), options.open)) say(opened->body.doubts);
  // Write BVH; or write GLB, with the file's own meshes if the meshes still fit the skeleton.
  AddEdits(sources.front().clip.rate_hz, options, converted.changes);
  if (format == MotionFormat::kBvh) {
    converted.bytes = WriteBvh(std::move(clips.front()));
    return converted;
  }
  const SourceClip& first = sources.front();
  const bool keeps_meshes = first.character && !options.mirror && options.performer == Performer::kFile;
  if (first.character && options.mirror) {
    converted.changes.emplace_back("Etude left out the meshes, because they do not fit the mirrored skeleton");
  }
  const Character bones{first.name, clips.front().skeleton, {}, {}};
  converted.bytes = WriteGlb(keeps_meshes ? *first.character : bones, clips);
  return converted;
}

Character PerformerOf(Performer performer, const BodyPose& rest, const std::string& name) {
  if (performer == Performer::kBear) return BearCharacter();
  if (performer == Performer::kMannequin) return MannequinCharacter();
  return {name, BodySkeleton(rest), {}, {}};
}

Result<Converted> ConvertBodies(std::vector<SourceClip> sources, MotionFormat format, const ConvertOptions& options) {
  const bool has_figure = options.performer == Performer::kBear || options.performer == Performer::kMannequin;
  OpenOptions open = options.open;
  open.body.rate_hz = options.rate_hz.value_or(kJudgedRateHz);
  const bool is_canonical = options.retarget || has_figure;
  Converted converted;
  std::vector<Clip> clips;
  BodyPose rest = StandingPose();
  // Trim each clip, and turn it into a body motion; mirror and retarget it if the options require this.
  for (SourceClip& source : sources) {
    const double source_hz = source.clip.rate_hz, from_s = StartOf(source, options);
    auto part = TrimTo(source, options.trim);
    if (!part) return Fail({source.source, 0, 0}, "{}", part.error().message);
    source.clip = std::move(*part);
    ASSIGN_OR_RETURN(auto opened, UnderstandClip(std::move(source), open));
    for (std::string& change : opened.body.changes) {
      if (std::ranges::find(converted.changes, change) == converted.changes.end()) {
        converted.changes.push_back(std::move(change));
      }
    }
    BodyMotion motion = std::move(opened.body.motion);
    if (options.mirror) motion = Mirror(motion);
    if (is_canonical) motion = Retarget(motion, StandingPose());
    const std::string& name = opened.source.name;
    // Write the formats that hold one motion of joints.
    const double start_s = from_s + static_cast<double>(opened.body.dropped_frames) / source_hz;
    if (format == MotionFormat::kTrc) converted.bytes = WriteTrc(JointMarkers(motion, start_s), name);
    if (format == MotionFormat::kBids) converted.files = WriteMotionBids(motion, name, options.version);
    if (format == MotionFormat::kCsv) converted.bytes = WriteJointCsv(motion, start_s);
    if (format == MotionFormat::kC3d) converted.bytes = WriteC3d(JointMarkers(motion, start_s));
    // The rest pose of a body with its own proportions is the canonical stance, scaled to this body's limb lengths.
    if (!is_canonical && clips.empty()) rest = Retarget({.poses = {rest}}, motion.poses.front()).poses.front();
    if (format == MotionFormat::kNpz) converted.bytes = WriteBodyNpz(motion, rest, start_s);
    if (format == MotionFormat::kMot) converted.bytes = WriteOpenSimMotion(motion, rest, name, start_s);
    if (std::string said = DescribeStart(start_s, motion.rate_hz, motion.poses.size(), format); !said.empty())
      converted.changes.push_back(std::move(said));
    clips.push_back(RigClip(motion, rest, opened.source.clip.name));
  }
  AddEdits(open.body.rate_hz, options, converted.changes);
  if (is_canonical) converted.changes.emplace_back("retargeted to the canonical proportions, 1.70 m tall");
  converted.note = clips.size() == 1 ? "as a body" : fmt::format("{} clips as bodies", clips.size());
  // Write the formats that hold a skeleton, after all clips are known.
  if (format == MotionFormat::kBvh) converted.bytes = WriteBvh(clips.front());
  if (format == MotionFormat::kGlb) {
    converted.bytes = WriteGlb(PerformerOf(options.performer, rest, clips.front().name), clips);
  }
  return converted;
}

}  // namespace

Result<TimeSpan> ParseTimeSpan(const std::string& text) {
  TimeSpan span{0, std::numeric_limits<double>::infinity()};
  const std::size_t colon = text.find(':');
  const bool is_span = colon != std::string::npos &&
                       ParseSeconds(std::string_view(text).substr(0, colon), span.from_s) &&
                       ParseSeconds(std::string_view(text).substr(colon + 1), span.to_s);
  if (!is_span) {
    return Fail({}, "{} is not a time range; allowed: FROM:TO in seconds, such as 1.5:4, 2: or :3", Quote(text));
  }
  if (span.to_s < span.from_s) return Fail({}, "{} ends before it starts", Quote(text));
  return span;
}

Result<Clip> TrimTo(const SourceClip& source, const std::optional<TimeSpan>& span) {
  const Clip& clip = source.clip;
  if (!span) return clip;
  const double hidden_s = HiddenStart(source);
  if (span->to_s < hidden_s) {
    return Fail({}, "the part ends at {:g} s, but the whole body is seen only from {:.2f} s on", span->to_s, hidden_s);
  }
  const double from_s = std::max(0.0, span->from_s - hidden_s);
  const bool is_open = span->to_s == std::numeric_limits<double>::infinity();
  return Trim(clip, from_s, is_open ? std::max(from_s, clip.DurationSeconds()) : span->to_s - hidden_s);
}

Result<MotionFormat> FormatOfName(const std::string& path) {
  const std::string extension = std::filesystem::path(path).extension().string();
  if (extension == ".bvh") return MotionFormat::kBvh;
  if (extension == ".glb") return MotionFormat::kGlb;
  if (extension == ".trc") return MotionFormat::kTrc;
  if (extension == ".csv") return MotionFormat::kCsv;
  if (extension == ".c3d") return MotionFormat::kC3d;
  if (extension == ".npz") return MotionFormat::kNpz;
  if (extension == ".mot") return MotionFormat::kMot;
  return Fail({path, 0, 0},
              "Etude cannot write files with this ending; allowed: .bvh, .glb, .trc, .csv, .c3d, .npz, .mot");
}

Result<Converted> ConvertClips(std::vector<SourceClip> clips, MotionFormat format, const ConvertOptions& options) {
  const bool has_figure = options.performer == Performer::kBear || options.performer == Performer::kMannequin;
  if (has_figure && format != MotionFormat::kGlb)
    return Fail({}, "only GLB files can contain a character; write a .glb file");
  if (clips.size() > 1 && format != MotionFormat::kGlb) {
    std::vector<std::string> names;
    for (const SourceClip& clip : clips) names.push_back(clip.clip.name);
    return Fail({clips.front().source, 0, 0},
                "only GLB files can contain several animations; choose one of the {} animations with FILE#NAME: {}",
                clips.size(), Join(names));
  }
  const bool has_only_joints = format != MotionFormat::kBvh && format != MotionFormat::kGlb;
  const bool as_body = options.ground || options.retarget || has_figure || has_only_joints;
  return as_body ? ConvertBodies(std::move(clips), format, options)
                 : ConvertOwnSkeletons(std::move(clips), format, options);
}

}  // namespace etude
