#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/motion/body.h"
#include "engine/motion/rest_body.h"
#include "engine/motion/statistics.h"
#include "io/clips/open_clip.h"
#include "io/files/json.h"

namespace etude {

/// Says in plain words what no person does, so that the file or how it is read is likely at fault (ours): a fastest
/// joint of over 10 m/s in the median frame, joints (finger tips aside) over 5 cm below the floor, nothing within
/// 15 cm above the floor for over a second. `motion` is in metres with its floor at y = 0. Empty: nothing of the kind.
std::vector<std::string> RemarksOn(const BodyMotion& motion, const MotionStatistics& statistics);

/// Says how far a skeleton whose limbs keep their lengths stays off a motion whose joints slide, from 2 mm on in the
/// mean (`MeasureRigidMisfit`): so much no capture by such a skeleton can mend. Nothing below.
/// @param rest who moves
std::optional<std::string> RemarkOnSliding(const BodyMotion& motion, const RestBody& rest);

/// The figure that a file brings with it.
struct FigureFacts {
  std::size_t meshes = 0;
  std::size_t triangles = 0;
  std::vector<std::string> materials;
};

/// The facts that a clip's twenty joints tell.
struct BodyFacts {
  std::array<std::string, kRoleCount> joints;  ///< by Index(role): who plays it
  std::vector<Role> composed;                  ///< roles that only ride on that joint
  std::string unit;
  double metres_per_unit = 0;
  UpAxis up = UpAxis::kY;
  double floor = 0;  ///< in the file's unit
  bool dropped_t_pose = false;
  std::string note;
  MotionStatistics motion;
  std::vector<std::string> remarks;  ///< RemarksOn
};

/// The facts of a clip, as `etude clip info` tells them; what cannot be known is left out, with the complaint.
struct ClipFacts {
  std::string name;
  std::string source;
  std::optional<ClipFormat> format;  ///< none: the file could not be read
  std::size_t frames = 0;
  double rate_hz = 0;
  double duration_s = 0;
  std::size_t joints = 0;  ///< without end sites
  std::size_t end_sites = 0;
  FigureFacts figure;
  std::optional<BodyFacts> body;
  std::optional<Error> complaint;
};

/// Collects the facts of every clip behind a reference (as ExpandReference gives them). Never empty: a file without a
/// clip gives facts as well, and one that cannot be read its complaint alone.
std::vector<ClipFacts> FactsOf(const std::string& reference, const OpenOptions& options);
/// Collects the facts of a clip that is understood.
ClipFacts FactsOf(const OpenedClip& clip);

/// Writes the facts as a paragraph for people. Roles that `before` had as well are not told again.
std::string FactsAsText(const ClipFacts& facts, const ClipFacts* before = nullptr);
/// Writes the facts as a line under a picture: "BVH · 22.9 s at 120 Hz · 31 joints · 1.59 m tall · feet slide 0.6 cm/s
/// · 1 unit = 5.644 cm (CMU)".
std::string FactsAsLine(const ClipFacts& facts);
/// Writes the facts as one line of JSON (docs/schemas/clip-info.schema.json).
Json FactsAsJson(const std::vector<ClipFacts>& facts);

}  // namespace etude
