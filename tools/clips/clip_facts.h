#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/motion/body.h"
#include "engine/motion/motion_faults.h"
#include "engine/motion/statistics.h"
#include "io/clips/open_clip.h"
#include "io/files/json.h"

namespace etude {

/// The figure in a file.
struct FigureFacts {
  std::size_t meshes = 0;
  std::size_t triangles = 0;
  std::vector<std::string> materials;
};

/// The facts about a clip's body motion.
struct BodyFacts {
  std::array<std::string, kRoleCount> joints;  ///< by Index(role): the name of the file's joint that plays the role
  std::array<std::vector<std::string>, kRoleCount> markers = {};  ///< MadeBody::markers
  /// Roles without a joint of their own; such a role is rigidly attached to the joint that `joints` lists for it.
  std::vector<Role> composed;
  std::string unit;
  double metres_per_unit = 0;
  UpFinding up = {};  ///< the file's up axis, and the evidence for this axis
  double floor = 0;   ///< height of the floor in the file, in the file's unit
  bool dropped_t_pose = false;
  std::vector<std::string> changes;  ///< the changes made to the file's body (BodyConversion::changes)
  MotionStatistics motion;
  /// The motion's faults at the file's own rate and heights (FaultsOf); absent if faults were not searched for.
  std::optional<MotionFaults> faults = {};
};

/// The facts of a clip that `etude clip info` shows. If a fact cannot be determined, it is missing, and `complaint`
/// says why.
struct ClipFacts {
  std::string name;
  std::string source;
  std::optional<ClipFormat> format;  ///< the file's format; absent if the file could not be read
  std::size_t frames = 0;
  double rate_hz = 0;
  double duration_s = 0;
  std::size_t joints = 0;  ///< number of joints, without end sites
  std::size_t end_sites = 0;
  FigureFacts figure;
  std::optional<BodyFacts> body;
  std::optional<Error> complaint;
};

/// Lists, for users, the markers by which a role is played: "'LASI' + 'RASI'", or "by rule".
std::string DescribeMarkers(const std::vector<std::string>& markers);
/// Returns true if a body was made from markers.
bool HasMarkers(const std::array<std::vector<std::string>, kRoleCount>& markers);

/// Collects the facts of every clip that a reference stands for; ExpandReference must have returned the reference. The
/// result is never empty: a file without clips also gives facts, and an unreadable file gives only the error message.
std::vector<ClipFacts> FactsOf(const std::string& reference, const OpenOptions& options);
/// Collects the facts of a clip whose roles are known, without its faults.
ClipFacts FactsOf(const OpenedClip& clip);
/// Finds the faults of a clip's motion with FindFaultsInPlace, at the rate and the heights of the clip's file. Returns
/// nullopt if UnderstandClip fails at that rate.
std::optional<MotionFaults> FaultsOf(const SourceClip& clip, const OpenOptions& options);

/// Writes the facts as a paragraph for people. Roles are left out if they are played by the same joints as in `before`.
std::string FactsAsText(const ClipFacts& facts, const ClipFacts* before = nullptr);
/// Writes the facts as a caption: "BVH · 22.9 s at 120 Hz · 31 joints · 1.59 m tall · feet slide 0.6 cm/s · 1 unit =
/// 5.644 cm (CMU)".
std::string FactsAsLine(const ClipFacts& facts);
/// Returns the facts as JSON (docs/schemas/clip-info.schema.json).
Json FactsAsJson(const std::vector<ClipFacts>& facts);

}  // namespace etude
