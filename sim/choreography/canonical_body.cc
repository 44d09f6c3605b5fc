#include "sim/choreography/canonical_body.h"

#include <array>
#include <cmath>

#include "engine/base/angles.h"
#include "engine/base/directions.h"
#include "engine/base/smoothstep.h"
#include "sim/choreography/leg.h"
#include "sim/choreography/rotations.h"

namespace etude {
namespace {

using enum MiddleControl;
using enum SideControl;
using enum Role;

struct ArmRoles {
  Role shoulder, elbow, wrist, hand;
};
struct LegRoles {
  Role hip, knee, ankle, foot;
};

ArmRoles ArmOf(Side side) {
  if (side == Side::kLeft) return {kLeftShoulder, kLeftElbow, kLeftWrist, kLeftHand};
  return {kRightShoulder, kRightElbow, kRightWrist, kRightHand};
}

LegRoles LegOf(Side side) {
  if (side == Side::kLeft) return {kLeftHip, kLeftKnee, kLeftAnkle, kLeftFoot};
  return {kRightHip, kRightKnee, kRightAnkle, kRightFoot};
}

/// Trunk and neck, upward from the hip centre. Returns the chest's orientation.
glm::dmat3 PlaceTrunk(const Controls& controls, const BodyDimensions& body, const glm::dmat3& pelvis, BodyPose& pose) {
  // The lower spine takes part of every bend: a back is an arc, not a hinge.
  constexpr double kLowerShare = 0.55;
  const auto bent = [&](double share) {
    return pelvis *
           TurnSideBend(share * controls[kTrunkTurn], share * controls[kTrunkSide], share * controls[kTrunkBend]);
  };
  const glm::dmat3 chest = bent(1);
  pose[kSpine] = pose[kHipCentre] + bent(kLowerShare) * glm::dvec3(0, body.spine, 0);
  pose[kShoulderCentre] = pose[kSpine] + chest * glm::dvec3(0, body.chest, 0);

  // Dancers keep their eyes on the audience: the neck takes back most of the body's turn.
  constexpr double kGazeShare = 0.7;
  const double gaze = -kGazeShare * (controls[kHipsTurn] + controls[kTrunkTurn]);
  const glm::dmat3 neck = chest * TurnSideBend(controls[kNeckTurn] + gaze, controls[kNeckSide], controls[kNeckBend]);
  pose[kHead] = pose[kShoulderCentre] + neck * glm::dvec3(0, body.head_rise, 0.015);
  return chest;
}

void PlaceArm(const Controls& controls, const BodyDimensions& body, Side side, const glm::dmat3& chest,
              BodyPose& pose) {
  const double out = side == Side::kLeft ? 1 : -1;
  const glm::dmat3 upper = RotationX(-controls.Of(side, kArmForward)) * RotationZ(out * controls.Of(side, kArmSide)) *
                           RotationY(out * controls.Of(side, kArmTwist));
  const glm::dvec3 down(0, -1, 0);

  // The shoulder blade follows a rising arm: beyond 60 degrees the shoulder itself goes up.
  constexpr double kFullRise = Radians(24);
  const double raise = AngleBetween(upper * down, down);
  const double rise = kFullRise * Smoothstep(Radians(60), Radians(175), raise);
  const glm::dvec3 shoulder =
      RotationZ(out * rise) * glm::dvec3(out * body.shoulder_half_width, -body.shoulder_fall, 0);

  const ArmRoles roles = ArmOf(side);
  const glm::dmat3 forearm = upper * RotationX(-controls.Of(side, kElbow));
  const glm::dmat3 hand = forearm * RotationX(-controls.Of(side, kWrist));
  pose[roles.shoulder] = pose[kShoulderCentre] + chest * shoulder;
  pose[roles.elbow] = pose[roles.shoulder] + chest * upper * down * body.upper_arm;
  pose[roles.wrist] = pose[roles.elbow] + chest * forearm * down * body.forearm;
  pose[roles.hand] = pose[roles.wrist] + chest * hand * down * body.hand;
}

glm::dvec3 HipOffset(const BodyDimensions& body, Side side, const glm::dmat3& pelvis) {
  return pelvis * glm::dvec3(side == Side::kLeft ? body.hip_half_width : -body.hip_half_width, 0, 0);
}

/// The smaller of both, rounded off where they come within some millimetres of each other.
double SmoothMin(double a, double b) {
  constexpr double kEase = 0.004;
  return 0.5 * (a + b - std::hypot(a - b, kEase));
}

/// The hips' place: where the choreography wants them, lowered until standing legs reach the floor.
glm::dvec3 PlaceHips(const Controls& controls, const BodyDimensions& body, const glm::dmat3& pelvis) {
  const glm::dvec3 wanted(controls[kHipsSide], body.HipHeight() - controls[kHipsDrop] + controls[kJump],
                          controls[kHipsAhead]);
  const auto limit = [&](Side side) {
    const glm::dvec3 offset = HipOffset(body, side, pelvis);
    return HighestHip(controls, body, side, wanted + offset) - offset.y;
  };
  return {wanted.x, SmoothMin(wanted.y, SmoothMin(limit(Side::kLeft), limit(Side::kRight))), wanted.z};
}

/// The controls with their metres in proportion to the body's legs.
Controls InProportion(const Controls& controls, const BodyDimensions& body) {
  constexpr std::array kMiddle = {kHipsSide, kHipsAhead, kHipsDrop, kJump};
  constexpr std::array kOfASide = {kFootSide, kFootAhead, kFootLift};
  const double scale = body.HipHeight() / CanonicalBody::kHipHeight;
  Controls scaled = controls;
  for (MiddleControl control : kMiddle) scaled[control] *= scale;
  for (Side side : {Side::kLeft, Side::kRight}) {
    for (SideControl control : kOfASide) scaled.Of(side, control) *= scale;
  }
  return scaled;
}

}  // namespace

BodyPose PoseOf(const Controls& canonical, const BodyDimensions& body) {
  const Controls controls = InProportion(canonical, body);
  BodyPose pose;
  const glm::dmat3 pelvis = RotationY(controls[kHipsTurn]) * RotationZ(controls[kHipsTilt]);
  pose[kHipCentre] = PlaceHips(controls, body, pelvis);
  const glm::dmat3 chest = PlaceTrunk(controls, body, pelvis, pose);
  for (Side side : {Side::kLeft, Side::kRight}) {
    PlaceArm(controls, body, side, chest, pose);
    const LegRoles roles = LegOf(side);
    const LegJoints leg = PlaceLeg(controls, body, side, pelvis, pose[kHipCentre] + HipOffset(body, side, pelvis));
    pose[roles.hip] = leg.hip;
    pose[roles.knee] = leg.knee;
    pose[roles.ankle] = leg.ankle;
    pose[roles.foot] = leg.toe;
  }
  return pose;
}

}  // namespace etude
