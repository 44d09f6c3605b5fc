#include "sim/choreography/leg.h"

#include <algorithm>
#include <cmath>

#include "sim/choreography/canonical_body.h"
#include "sim/choreography/rotations.h"

namespace etude {
namespace {

using enum MiddleControl;
using enum SideControl;

/// A straight leg is reached only up to this share: knees never lock, and never snap.
constexpr double kReach = 0.998;

double LegLength(const BodyDimensions& body) { return body.thigh + body.shank; }

/// Where a foot is, and which way its knee looks.
struct FootGoal {
  glm::dvec3 ankle;
  glm::dvec3 to_toe;        // from the ankle
  glm::dvec3 knee_forward;  // the side of the hip–ankle line on which the knee lies
};

double Outward(Side side) { return side == Side::kLeft ? 1 : -1; }

/// The foot on its spot, rolled up on its toes by the heel's rise.
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

/// The foot at the end of a leg that follows its angles.
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

/// Two-bone inverse kinematics: moves the ankle into reach and gives the knee on the wanted side.
glm::dvec3 SolveKnee(const BodyDimensions& body, const glm::dvec3& hip, glm::dvec3& ankle,
                     const glm::dvec3& knee_forward) {
  const double shortest = std::abs(body.thigh - body.shank) + 0.05;
  const glm::dvec3 line = ankle - hip;
  const double length = glm::length(line);
  const glm::dvec3 along = length > 0 ? line / length : glm::dvec3(0, -1, 0);
  const double reach = std::clamp(length, shortest, kReach * LegLength(body));
  ankle = hip + along * reach;

  const double cosine = (body.thigh * body.thigh + reach * reach - body.shank * body.shank) / (2 * body.thigh * reach);
  const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
  glm::dvec3 across = knee_forward - glm::dot(knee_forward, along) * along;
  const double across_length = glm::length(across);
  constexpr double kDegenerate = 1e-6;
  across = across_length > kDegenerate ? across / across_length : glm::dvec3(0, 0, 1);
  return hip + body.thigh * (cosine * along + sine * across);
}

double Freedom(const Controls& controls, Side side) { return std::clamp(controls.Of(side, kLegFree), 0.0, 1.0); }

}  // namespace

LegJoints PlaceLeg(const Controls& controls, const BodyDimensions& body, Side side, const glm::dmat3& pelvis,
                   const glm::dvec3& hip) {
  const double free = Freedom(controls, side);
  const FootGoal standing = StandingGoal(controls, body, side), swinging = FreeGoal(controls, body, side, pelvis, hip);
  // A foot rises before it travels, so that it does not brush along the floor.
  const double travelled = free * free;
  glm::dvec3 ankle = glm::mix(standing.ankle, swinging.ankle, glm::dvec3(travelled, free, travelled));
  glm::dvec3 to_toe = glm::mix(standing.to_toe, swinging.to_toe, travelled);
  to_toe *= glm::length(standing.to_toe) / glm::length(to_toe);
  // On its way from the one to the other it swings clear of the floor.
  constexpr double kClearance = 0.04;
  ankle.y += 4 * kClearance * free * (1 - free);
  ankle.y = std::max({ankle.y, body.ankle_height, body.toe_height - to_toe.y});
  const glm::dvec3 knee = SolveKnee(body, hip, ankle, glm::mix(standing.knee_forward, swinging.knee_forward, free));
  return {hip, knee, ankle, ankle + to_toe};
}

double HighestHip(const Controls& controls, const BodyDimensions& body, Side side, const glm::dvec3& hip) {
  const glm::dvec3 ankle = StandingGoal(controls, body, side).ankle;
  const double sideways = std::hypot(hip.x - ankle.x, hip.z - ankle.z);
  const double reach = kReach * LegLength(body);
  const double height = std::sqrt(std::max(0.0, reach * reach - sideways * sideways));
  // One metre is more than any leg: a free leg holds nobody down.
  return ankle.y + height + Freedom(controls, side);
}

}  // namespace etude
