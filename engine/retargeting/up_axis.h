#pragma once

#include <span>
#include <string>
#include <string_view>

#include "engine/motion/body.h"
#include "engine/retargeting/orientation.h"

namespace etude {

/// The evidence for a file's up axis, from the strongest: the user, the file itself, the rule of its format, or the
/// posture of the body.
enum class UpEvidence { kTold, kFile, kFormat, kPosture };
/// Returns "told", "file", "format" or "posture".
std::string_view UpEvidenceName(UpEvidence evidence);

/// Knowledge about a file's up axis that does not come from its motion.
struct UpRule {
  glm::dvec3 axis{0, 1, 0};  ///< the axis that points up; with kPosture the usual axis, which the posture may overrule
  UpEvidence evidence = UpEvidence::kPosture;
  /// A text that names the source of the axis: "the usual axis of TRC files", "the convention of AMASS".
  std::string source = "the usual axis";
  /// True if the body at rest stands along `axis`; weight over the feet along another axis is then no evidence.
  bool is_of_rest = false;
  bool is_y_or_z = false;             ///< true if only Y and Z can be the up axis
  bool yields_to_walking = false;     ///< true if a body that walks upright along another axis overrules `axis`
};

/// The up axis of a file, and its evidence.
struct UpFinding {
  glm::dvec3 axis{0, 1, 0};
  UpEvidence evidence = UpEvidence::kPosture;
  std::string source = "";
  /// A sentence for users if the posture contradicts the axis or shows nothing; otherwise empty.
  std::string doubt = "";
};

/// Finds the axis that points up (ours). The result is the rule's axis, unless the rule's evidence is kPosture and the
/// whole motion is evidence for another axis. If the file or its format states the axis, evidence for another axis only
/// sets `doubt`, except as UpRule::yields_to_walking says. The motion is evidence for another axis in three cases:
/// - Along the other axis, the body is upright in a tenth of the frames and the lowest joint stays at one height. Along
///   the usual axis, this height varies. In the other frames, people may lie, crawl or stand on their hands.
/// - The body squats or bows in one place: along the other axis, it is upright in three tenths of the frames, with its
///   weight over its feet, the lowest joint stays at one height, and hips or shoulders come down. Along the usual axis,
///   it is never upright. If only the shoulders come down, the lowest joint is not near height 0 along the usual axis, as
///   it is in sit-ups; if the usual axis is a guess, the lowest joint is near height 0 along the other axis.
/// - The body is upright in four fifths of the frames along the other axis, and hardly ever along the usual axis. In
///   addition, one of these is true:
///   - the body walks: it travels perpendicular to the other axis while one foot stands;
///   - the file or its format states the usual axis, and along the usual axis the body stands on its head, but not on
///     its hands;
///   - along the other axis, the body's weight is over its feet (which is false for a person who lies), and the lowest
///     joint's
///     height varies less than along the usual axis;
///   - along the other axis, the body's weight is over its feet, and the body stands quite still and straight, as in
///     static trials;
///   - the body sits upright along the other axis with its feet at one height, and its hands do not carry it along the
///     usual axis. A body that lies with hips and knees at right angles has the same shape; so `doubt` names both, and
///     if the body may lie on one side, the usual axis is kept.
/// A stated axis is not doubted if a body that stands along another axis lies at height 0 along the stated one. The
/// axis of AMASS is also doubted if the body is never upright, and is below its floor or higher than a bed. In case of
/// doubt, the usual axis is taken. If the usual axis is only a guess, `doubt` names Y and Z in two cases: with the
/// usual axis up, the body would climb, lean or float, but with the other one it would be on the floor; or with the
/// usual axis up, nothing shows that the body stands or sits (steps, a floor at height 0, shanks upright below level
/// thighs, hips or shoulders that move over the feet), and with the other one up, the body may be lying. `poses`
/// contains at least one pose, in the file's unit and axes. A missing toe must be at the position of its ankle, and a
/// missing hand at its wrist.
UpFinding FindUp(std::span<const BodyPose> poses, double rate_hz, const UpRule& rule);

/// Finds the up axis, Y or Z, of a clip with a skeleton. The usual axis is the axis along which the rest pose stands
/// upright, or Y if the rest pose stands along neither axis.
UpFinding FindUp(const BodyPose& rest, std::span<const BodyPose> poses, double rate_hz);

/// The rules of formats. For TRC, C3D without Y_SCREEN, tables of points and joint arrays there is no rule, only a
/// usual axis.
UpRule TrcUp();
/// `axis` is 'X', 'Y' or 'Z' as in the file's entry Y_SCREEN, or 0 without that entry. Without that entry, Z is the
/// usual axis, by the convention of biomechanics.
UpRule C3dUp(char axis, bool is_negative);
UpRule TableUp();  ///< for tables of points, which state no axis
UpRule ArrayUp();
UpRule CameraUp();     ///< for arrays that JointsOfSam has already rotated
UpRule RawArraysUp();  ///< for arrays that ReadRawNpz has already rotated
UpRule JointCsvUp();
UpRule OwnJointsUp();  ///< for the joints of files that Etude wrote, such as TRC
UpRule MotiveUp();
UpRule AmassUp();
UpRule GltfUp();
UpRule DeepMimicUp();

/// Returns the name of an axis of the file, such as "Y" or "−Z".
std::string AxisName(const glm::dvec3& axis);
/// Returns the unit vector of the axis.
glm::dvec3 AxisOf(UpAxis up);
/// Describes a rotation for users: "turned upright from Z up (the convention of AMASS)"; "" for Y.
std::string DescribeTurn(const UpFinding& up);

/// Rotates a point so that `up`, an axis of the file, becomes Y. If `up` is Z, a body that faced −Y faces +Z.
glm::dvec3 TurnedUp(const glm::dvec3& point, const glm::dvec3& up);

}  // namespace etude
