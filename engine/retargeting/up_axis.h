#pragma once

#include <span>
#include <string>
#include <string_view>

#include "engine/motion/body.h"
#include "engine/retargeting/orientation.h"

namespace etude {

/// The evidence for the axis of a file that points up, from the strongest: the user, the file itself, the rule of its
/// format, and the posture of the body.
enum class UpEvidence { kTold, kFile, kFormat, kPosture };
/// Returns "told", "file", "format" or "posture".
std::string_view UpEvidenceName(UpEvidence evidence);

/// What is known about a file's up axis without its motion.
struct UpRule {
  glm::dvec3 axis{0, 1, 0};  ///< with kPosture it is only the usual axis, which the posture may overrule
  UpEvidence evidence = UpEvidence::kPosture;
  /// Text that describes the axis: "the usual axis of TRC files", "the rule of AMASS".
  std::string source = "the usual axis";
  /// The body at rest stands along `axis`, so a still stance along another axis is no evidence.
  bool is_of_rest = false;
  bool is_y_or_z = false;             ///< no other axis is considered
};

/// The up axis of a file, and what it follows from.
struct UpFinding {
  glm::dvec3 axis{0, 1, 0};
  UpEvidence evidence = UpEvidence::kPosture;
  std::string source = "";
  /// A sentence for people if the posture contradicts the axis or shows nothing; otherwise empty.
  std::string doubt = "";
};

/// Finds the axis that points up (ours). It is the rule's axis, unless the rule's evidence is kPosture and the whole
/// motion is evidence for another axis: the body is upright along that axis and hardly ever along the usual one, and
/// - the lowest joint stays at one height along it, but not along the usual axis (this also holds for people who lie,
///   crawl or stand on their hands), or
/// - it walks: it travels across that axis while one foot stands, or
/// - the file or its format states the usual axis, along which it stands on its head, but not on its hands, or
/// - its weight is always over its feet along that axis (which is not so for a person who lies), and either it moves
///   and the lowest joint's height varies less along it, or it stands quite still and straight, as in static trials.
/// In case of doubt, the usual axis is taken. `poses` are in the file's unit and axes, at `rate_hz`; there is at least
/// one. For a missing toe the position of its ankle is used.
UpFinding FindUp(std::span<const BodyPose> poses, double rate_hz, const UpRule& rule);

/// Finds the up axis, Y or Z, of a clip with a skeleton: the usual axis is the one along which the body stands at rest,
/// otherwise Y.
UpFinding FindUp(const BodyPose& rest, std::span<const BodyPose> poses, double rate_hz);

/// What formats state about their up axis. TRC, C3D without Y_SCREEN, and joint arrays have only a usual axis.
UpRule TrcUp();
/// `axis` is 'X', 'Y' or 'Z' by the file's Y_SCREEN, or 0 if the file has no such entry. Z is then the usual axis, by
/// the convention of biomechanics.
UpRule C3dUp(char axis, bool is_negative);
UpRule ArrayUp();
UpRule RawArraysUp();  ///< of ReadRawNpz, which has turned them
UpRule JointCsvUp();
UpRule MotiveUp();
UpRule AmassUp();
UpRule GltfUp();
UpRule DeepMimicUp();

/// Returns the name of an axis of the file: "Y", "−Z".
std::string AxisName(const glm::dvec3& axis);
/// Returns the axis that "y", "z", "-y" and so on name.
glm::dvec3 AxisOf(UpAxis up);
/// Describes a rotation for people: "turned upright from Z up (the rule of AMASS)"; "" for Y.
std::string DescribeTurn(const UpFinding& up);

/// Rotates a point so that `up`, an axis of the file, becomes Y; a body that faced −Y along Z faces +Z.
glm::dvec3 TurnedUp(const glm::dvec3& point, const glm::dvec3& up);

}  // namespace etude
