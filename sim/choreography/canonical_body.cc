#include "sim/choreography/canonical_body.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/base/angles.h"
#include "engine/base/directions.h"
#include "engine/base/smoothstep.h"
#include "sim/choreography/rotations.h"

namespace etude {
namespace {

using enum MiddleControl;
using enum SideControl;
using enum Role;

/// The joints of one leg, metres.
struct LegJoints {
  glm::dvec3 hip, knee, ankle, toe;
};

/// The largest distance from hip to ankle, as a share of the leg's length. A share below 1 prevents fully straight
/// knees, near which the knee's angle would change abruptly.
constexpr double kReach = 0.998;

double LegLength(const BodyDimensions& body) { return body.thigh + body.shank; }

/// The target position of a foot, and the direction in which the knee of the same leg points.
struct FootGoal {
  glm::dvec3 ankle;
  glm::dvec3 to_toe;        // vector from the ankle to the toe
  glm::dvec3 knee_forward;  // the knee lies on this side of the hip–ankle line
};

double Outward(Side side) { return side == Side::kLeft ? 1 : -1; }

/// Returns the target of a standing foot: on its spot, with the heel raised about the toe tip.
FootGoal StandingGoal(const Controls& controls, const BodyDimensions& body, Side side) {
  const double out = Outward(side);
  const double heel = controls.Of(side, kFootHeel);
  const glm::dmat3 heading = RotationY(out * (CanonicalBody::kHomeToeOut + controls.Of(side, kFootTurn)));
  const glm::dvec3 flat(0, body.toe_height - body.ankle_height, body.foot_reach);
  const glm::dvec3 spot(out * (body.home_half_width + controls.Of(side, kFootSide)),
                        body.ankle_height + controls.Of(side, kFootLift) + std::max(0.0, controls[kJump]),
                        controls.Of(side, kFootAhead));
  const glm::dvec3 toe = spot + heading * flat;
  const glm::dvec3 to_toe = heading * (RotationX(heel) * flat);
  return {toe - to_toe, to_toe, heading * glm::dvec3(0, 0, 1)};
}

/// Returns the position of a free leg's foot, by forward kinematics of the leg's angles.
FootGoal FreeGoal(const Controls& controls, const BodyDimensions& body, Side side, const glm::dmat3& pelvis,
                  const glm::dvec3& hip) {
  const double out = Outward(side);
  const glm::dmat3 thigh = pelvis * RotationX(-controls.Of(side, kLegForward)) *
                           RotationZ(out * controls.Of(side, kLegSide)) * RotationY(out * controls.Of(side, kLegTwist));
  const glm::dmat3 shank = thigh * RotationX(controls.Of(side, kKnee));
  const glm::dmat3 foot = shank * RotationX(controls.Of(side, kFootPoint));
  const glm::dvec3 knee = hip + thigh * glm::dvec3(0, -body.thigh, 0);
  return {knee + shank * glm::dvec3(0, -body.shank, 0),
          foot * glm::dvec3(0, body.toe_height - body.ankle_height, body.foot_reach), thigh[2]};
}

/// Solves two-bone inverse kinematics: moves the ankle within reach, and returns the knee on the side of
/// `knee_forward`.
glm::dvec3 SolveKnee(const BodyDimensions& body, const glm::dvec3& hip, glm::dvec3& ankle,
                     const glm::dvec3& knee_forward) {
  // Clamp the distance from hip to ankle to the leg's reach.
  const double shortest = std::abs(body.thigh - body.shank) + 0.05;
  const glm::dvec3 line = ankle - hip;
  const double length = glm::length(line);
  const glm::dvec3 along = length > 0 ? line / length : glm::dvec3(0, -1, 0);
  const double reach = std::clamp(length, shortest, kReach * LegLength(body));
  ankle = hip + along * reach;

  // Find the knee by the law of cosines, bent towards `knee_forward`.
  const double cosine = (body.thigh * body.thigh + reach * reach - body.shank * body.shank) / (2 * body.thigh * reach);
  const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
  glm::dvec3 across = knee_forward - glm::dot(knee_forward, along) * along;
  const double across_length = glm::length(across);
  constexpr double kDegenerate = 1e-6;
  across = across_length > kDegenerate ? across / across_length : glm::dvec3(0, 0, 1);
  return hip + body.thigh * (cosine * along + sine * across);
}

double Freedom(const Controls& controls, Side side) { return std::clamp(controls.Of(side, kLegFree), 0.0, 1.0); }

/// Places the leg below `hip`. Lengths in `controls` must already be scaled to this body. A standing foot is on its
/// spot wherever the hips are; a free leg follows its angles in the frame of the pelvis; for a partly free leg, the
/// ankle is interpolated. If the spot is out of reach, the leg stretches towards it.
LegJoints PlaceLeg(const Controls& controls, const BodyDimensions& body, Side side, const glm::dmat3& pelvis,
                   const glm::dvec3& hip) {
  const double free = Freedom(controls, side);
  const FootGoal standing = StandingGoal(controls, body, side), swinging = FreeGoal(controls, body, side, pelvis, hip);
  // Let the foot rise before it moves sideways; the foot must not brush along the floor.
  const double travelled = free * free;
  glm::dvec3 ankle = glm::mix(standing.ankle, swinging.ankle, glm::dvec3(travelled, free, travelled));
  glm::dvec3 to_toe = glm::mix(standing.to_toe, swinging.to_toe, travelled);
  to_toe *= glm::length(standing.to_toe) / glm::length(to_toe);
  // Keep the foot clear of the floor while it changes from standing to free.
  constexpr double kClearance = 0.04;
  ankle.y += 4 * kClearance * free * (1 - free);
  ankle.y = std::max({ankle.y, body.ankle_height, body.toe_height - to_toe.y});
  const glm::dvec3 knee = SolveKnee(body, hip, ankle, glm::mix(standing.knee_forward, swinging.knee_forward, free));
  return {hip, knee, ankle, ankle + to_toe};
}

/// Returns the greatest hip height at which the foot of the nearly straight leg still reaches the foot's spot on the
/// floor. Only x and z of `hip` are used.
double HighestHip(const Controls& controls, const BodyDimensions& body, Side side, const glm::dvec3& hip) {
  const glm::dvec3 ankle = StandingGoal(controls, body, side).ankle;
  const double sideways = std::hypot(hip.x - ankle.x, hip.z - ankle.z);
  const double reach = kReach * LegLength(body);
  const double height = std::sqrt(std::max(0.0, reach * reach - sideways * sideways));
  // For a free leg, add up to one metre, more than any leg's length: a free leg must not limit the hips.
  return ankle.y + height + Freedom(controls, side);
}

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

/// Places trunk and neck upward from the hip centre; returns the chest's orientation.
glm::dmat3 PlaceTrunk(const Controls& controls, const BodyDimensions& body, const glm::dmat3& pelvis, BodyPose& pose) {
  // Apply a part of every bend to the lower spine, because a back bends along an arc.
  constexpr double kLowerShare = 0.55;
  const auto bent = [&](double share) {
    return pelvis *
           TurnSideBend(share * controls[kTrunkTurn], share * controls[kTrunkSide], share * controls[kTrunkBend]);
  };
  const glm::dmat3 chest = bent(1);
  pose[kSpine] = pose[kHipCentre] + bent(kLowerShare) * glm::dvec3(0, body.spine, 0);
  pose[kShoulderCentre] = pose[kSpine] + chest * glm::dvec3(0, body.chest, 0);

  // Let the neck turn the head back towards the audience, against most of the body's turn.
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

  // Let the shoulder blade follow a raised arm: above 60 degrees the shoulder rises.
  constexpr double kFullRise = Radians(24);
  const double raise = AngleBetween(upper * down, down);
  const double rise = kFullRise * Smoothstep(Radians(60), Radians(175), raise);
  const glm::dvec3 shoulder =
      RotationZ(out * rise) * glm::dvec3(out * body.shoulder_half_width, -body.shoulder_fall, 0);

  // Chain upper arm, forearm and hand from the shoulder outwards.
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

/// Returns a smooth minimum of two values. The result differs from the exact minimum only if the values are within some
/// millimetres of each other.
double SmoothMin(double a, double b) {
  constexpr double kEase = 0.004;
  return 0.5 * (a + b - std::hypot(a - b, kEase));
}

/// Places the hips where the controls put them, but lowers them until the standing legs reach their spots.
glm::dvec3 PlaceHips(const Controls& controls, const BodyDimensions& body, const glm::dmat3& pelvis) {
  const glm::dvec3 wanted(controls[kHipsSide], body.HipHeight() - controls[kHipsDrop] + controls[kJump],
                          controls[kHipsAhead]);
  const auto limit = [&](Side side) {
    const glm::dvec3 offset = HipOffset(body, side, pelvis);
    return HighestHip(controls, body, side, wanted + offset) - offset.y;
  };
  return {wanted.x, SmoothMin(wanted.y, SmoothMin(limit(Side::kLeft), limit(Side::kRight))), wanted.z};
}

/// Returns the controls with their lengths scaled to this body: by the ratio of this body's hip height to the canonical
/// body's hip height.
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

Controls ReadyStance() {
  Controls ready;
  ready[MiddleControl::kHipsDrop] = 0.006;
  ready[MiddleControl::kHipsAhead] = 0.01;
  for (Side side : {Side::kLeft, Side::kRight}) {
    ready.Of(side, SideControl::kArmForward) = Radians(4);
    ready.Of(side, SideControl::kArmSide) = Radians(9);
    ready.Of(side, SideControl::kElbow) = Radians(16);
    ready.Of(side, SideControl::kWrist) = Radians(8);
  }
  return ready;
}

BodyPose StandingPose() { return PoseOf(Controls{}); }

}  // namespace etude
