#pragma once

#include <span>
#include <string>
#include <string_view>

#include "engine/motion/body.h"
#include "engine/retargeting/orientation.h"

namespace etude {

/// What decides which axis of a file points up, from the strongest: the user, the file itself, the rule of its format,
/// and last the posture of the body.
enum class UpEvidence { kTold, kFile, kFormat, kPosture };
/// Returns "told", "file", "format" or "posture".
std::string_view UpEvidenceName(UpEvidence evidence);

/// What is known about a file's up axis without its motion.
struct UpRule {
  glm::dvec3 axis{0, 1, 0};  ///< with kPosture it is only the usual axis, and posture may overrule it
  UpEvidence evidence = UpEvidence::kPosture;
  std::string source = "the usual axis";  ///< what the axis is: "the usual axis of TRC files", "the rule of AMASS"
  bool is_of_rest = false;            ///< the body at rest stands along `axis`: a still stance elsewhere is no evidence
  bool is_y_or_z = false;             ///< no other axis is considered
};

/// The up axis of a file, and what it follows from.
struct UpFinding {
  glm::dvec3 axis{0, 1, 0};
  UpEvidence evidence = UpEvidence::kPosture;
  std::string source = "";
  std::string doubt = "";  ///< a sentence for people if the posture speaks against the axis or tells nothing; else ""
};

/// Finds the axis that points up (ours). The rule's axis holds, unless its evidence is kPosture and the whole motion
/// speaks for another axis: the body is upright along that one and hardly ever along the usual one, and
/// - the lowest joint stays at one height along it, but not along the usual axis (people who lie, crawl or stand on
///   their hands keep a floor), or
/// - it walks: it travels across that axis while one foot stands, or
/// - its weight is over its feet along that axis throughout (a person who lies is not in balance on the soles), it
///   moves, and the floor is stiller along it; or it stands quite still and straight, as in static trials.
/// In doubt the usual axis holds. `poses` are in the file's unit and axes, at `rate_hz`; there is at least one. A missing
/// toe is at its ankle.
UpFinding FindUp(std::span<const BodyPose> poses, double rate_hz, const UpRule& rule);

/// Finds it for a clip with a skeleton, Y or Z: the usual axis is the one along which the body stands at rest, else Y.
UpFinding FindUp(const BodyPose& rest, std::span<const BodyPose> poses, double rate_hz);

/// What formats tell of their up axis. TRC, C3D without Y_SCREEN, and joint arrays have only a usual axis.
UpRule TrcUp();
/// `axis` is 'X', 'Y' or 'Z' by the file's Y_SCREEN, or 0. Without that word Z is usual, as biomechanists have it.
UpRule C3dUp(char axis, bool is_negative);
UpRule ArrayUp();
UpRule JointCsvUp();
UpRule MotiveUp();
UpRule AmassUp();
UpRule GltfUp();
UpRule DeepMimicUp();

/// Returns the name of an axis of the file: "Y", "−Z".
std::string AxisName(const glm::dvec3& axis);
/// Returns the axis that "y", "z", "-y" and so on name.
glm::dvec3 AxisOf(UpAxis up);
/// Describes a turn for people: "turned upright from Z up (the rule of AMASS)"; "" for Y.
std::string DescribeTurn(const UpFinding& up);

/// Rotates a point so that `up`, an axis of the file, becomes Y; a body that faced −Y along Z faces +Z.
glm::dvec3 TurnedUp(const glm::dvec3& point, const glm::dvec3& up);

}  // namespace etude
