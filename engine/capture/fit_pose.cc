#include "engine/capture/fit_pose.h"

#include <algorithm>
#include <cmath>

#include "engine/base/angles.h"
#include "engine/base/directions.h"
#include "engine/base/euler.h"

namespace etude {
namespace {

const glm::dvec3 kAlong(0, 0, 1);         // every limb points along this direction in its own frame
constexpr double kStraight = Radians(5);  // an elbow or knee bent by less defines no plane
constexpr double kTinyM = 1e-9;

bool IsFinite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

// Returns the angle of the rotation about the unit vector `axis` that minimises the squared distances between `from`
// and `to`, in radians.
double BestTwist(const glm::dvec3& axis, const std::vector<glm::dvec3>& from, const std::vector<glm::dvec3>& to) {
  double cosine = 0, sine = 0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    const glm::dvec3 across = from[i] - glm::dot(from[i], axis) * axis;
    cosine += glm::dot(across, to[i]);
    sine += glm::dot(axis, glm::cross(from[i], to[i]));
  }
  return std::hypot(cosine, sine) > kTinyM ? std::atan2(sine, cosine) : 0;
}

// Returns the angles of a joint that rotate the limb to the axes R_JL, as far as the joint's degrees of freedom allow.
glm::dvec3 AnglesOf(const glm::dmat3& R_JL, int dof_count) {
  if (dof_count == 3) return AnglesXyz(R_JL);
  const glm::dvec3& z_J = R_JL[2];
  if (dof_count == 1) return {std::atan2(-z_J.y, z_J.z), 0, 0};
  return {std::atan2(-z_J.y, z_J.z), std::asin(std::clamp(z_J.x, -1.0, 1.0)), 0};
}

// Returns the body's tree with one effector per role that is not fixed to the root, in the order of `roles`.
KinematicTree WithRoles(const CaptureBody& body, std::vector<Role>& roles) {
  KinematicTree tree = body.tree;
  tree.effectors.clear();
  for (const Role role : AllRoles()) {
    // The hip centre is the midpoint of the hips, so it needs no effector.
    if (role == Role::kHipCentre && body.hips_turn) continue;
    TreePoint point = body.roles[Index(role)];
    // The joint at which a limb begins is a fixed point of the parent limb.
    while (point.joint > 0 && glm::length(point.p_LQ) < kTinyM) {
      const TreeJoint& joint = tree.joints[point.joint];
      point = {joint.parent, joint.p_PJ};
    }
    if (point.joint == 0) continue;
    tree.effectors.push_back({RoleName(role), point.joint, point.p_LQ});
    roles.push_back(role);
  }
  return tree;
}

constexpr double kGoal = 1e-7;                       // distance at which a target counts as met, metres
constexpr double kMet = kRoleCount * kGoal * kGoal;  // residual below which all targets count as met, m²
// If the residual is below this multiple of the last frame's residual, no other start is tried.
constexpr double kLikeTheLast = 1.5 * 1.5;

IkOptions ExactSteps() {
  IkOptions options;
  options.max_iterations = 120;
  options.position_goal = kGoal;
  return options;
}

double SquaresOf(const PoseTargets& wanted, const BodyPose& pose) {
  double squares = 0;
  for (std::size_t i = 0; i < kRoleCount; ++i) {
    if (wanted.weights[i] <= 0) continue;
    const glm::dvec3 off = wanted.places.joints[i] - pose.joints[i];
    squares += wanted.weights[i] * glm::dot(off, off);
  }
  return squares;
}

}  // namespace

PoseTargets TargetsAt(const BodyPose& pose) {
  PoseTargets targets{.places = pose, .weights = {}};
  targets.weights.fill(1);
  return targets;
}

PoseFitter::PoseFitter(const CaptureBody& body)
    : body_(body), tree_(WithRoles(body, effector_roles_)), solver_(tree_), children_(tree_.joints.size()) {
  for (std::size_t i = 1; i < tree_.joints.size(); ++i)
    children_[tree_.joints[i].parent].push_back(static_cast<int>(i));
}

// Collects, along every chain of limbs outwards from a limb, the first role that has a target.
void PoseFitter::AddAims(int limb, const glm::dvec3& p_LJ, const glm::dmat3& R_LJ, int beyond,
                         const PoseTargets& wanted, std::vector<Aim>& aims) const {
  bool is_met = false;
  for (std::size_t e = 0; e < effector_roles_.size(); ++e) {
    if (tree_.effectors[e].joint != beyond || wanted.weights[Index(effector_roles_[e])] <= 0) continue;
    aims.push_back({effector_roles_[e], p_LJ + R_LJ * tree_.effectors[e].p_LE, beyond == limb});
    is_met = beyond != limb;
  }
  if (is_met) return;
  for (const int child : children_[beyond]) {
    const TreeJoint& joint = tree_.joints[child];
    const bool is_seen = std::ranges::any_of(aims, [&](const Aim& aim) {
      return aim.is_on_limb && glm::distance(aim.p_LQ, p_LJ + R_LJ * joint.p_PJ) < 1e-6;
    });
    // If the joint at the child's beginning has a target, the limbs beyond it do not constrain this limb.
    if (!is_seen) AddAims(limb, p_LJ + R_LJ * joint.p_PJ, R_LJ * joint.R_PJ, child, wanted, aims);
  }
}

// Returns the axes of a limb whose chain to the next known joint contains joints without targets. The limb and the
// remaining chain are two sides of a triangle; the third side is the distance to the known joint. The chain bends to
// the same side as at rest; if it is straight at rest, like a back, it bends backwards.
glm::dmat3 PoseFitter::BendTowards(int limb, const Aim& aim, const glm::dvec3& to_W, const glm::dmat3& R_WL,
                                   const glm::dvec3& back_W, int mirrored) const {
  glm::dvec3 p_LT(0);  // the end of the limb, where the rest of the chain begins
  for (int beyond = body_.roles[Index(aim.role)].joint; beyond > 0 && beyond != limb;) {
    p_LT = tree_.joints[beyond].p_PJ;
    beyond = tree_.joints[beyond].parent;
  }
  const double own = glm::length(p_LT), rest = glm::distance(p_LT, aim.p_LQ), whole = glm::length(to_W);
  if (own < kTinyM || rest < kTinyM || whole < kTinyM) return R_WL;
  // The law of cosines gives the angle between the limb and the line to the known joint.
  const double cosine = (own * own + whole * whole - rest * rest) / (2 * own * whole);
  const glm::dvec3 along = to_W / whole;
  glm::dvec3 side = R_WL * p_LT;
  side -= glm::dot(side, along) * along;
  if (glm::length(side) < 0.02 * own) side = back_W - glm::dot(back_W, along) * along;
  const double angle = (limb == mirrored ? -1 : 1) * std::acos(std::clamp(cosine, -1.0, 1.0));
  const glm::dvec3 wanted = std::cos(angle) * along + std::sin(angle) * UnitOr(side, glm::dvec3(0));
  return SmallestRotation(glm::normalize(R_WL * p_LT), UnitOr(wanted, along)) * R_WL;
}

// Returns the orientation R_WL that points a limb, whose joint is at p_WL, at the limb's targets.
glm::dmat3 PoseFitter::TurnTowards(int limb, const glm::dvec3& p_WL, const glm::dmat3& R_WJ, const PoseTargets& wanted,
                                   int mirrored, std::vector<int>& bent) const {
  std::vector<Aim> aims;
  AddAims(limb, glm::dvec3(0), glm::dmat3(1), limb, wanted, aims);
  if (aims.empty()) return R_WJ;
  // Point the limb at its farthest known role; if the limb has none, at the farthest known role on the chains beyond
  // it.
  const auto main = std::ranges::max_element(
      aims, {}, [](const Aim& aim) { return std::pair(aim.is_on_limb, glm::length(aim.p_LQ)); });
  const glm::dvec3 from = UnitOr(R_WJ * main->p_LQ, R_WJ * kAlong);
  const glm::dvec3 to = UnitOr(wanted.places[main->role] - p_WL, from);
  glm::dmat3 R_WL = SmallestRotation(from, to) * R_WJ;
  // Take the twist of a limb from the plane in which its elbow or knee bends.
  const auto twist = std::ranges::find(body_.twists, limb, &CaptureBody::Twist::joint);
  if (twist != body_.twists.end()) {
    const glm::dvec3 upper = wanted.places[twist->middle] - wanted.places[twist->upper];
    const glm::dvec3 lower = wanted.places[twist->lower] - wanted.places[twist->middle];
    const glm::dvec3 normal = twist->bends * glm::cross(upper, lower);
    const bool is_known = wanted.weights[Index(twist->upper)] > 0 && wanted.weights[Index(twist->lower)] > 0;
    if (is_known && glm::length(normal) > std::sin(kStraight) * glm::length(upper) * glm::length(lower)) {
      const glm::dvec3 x = UnitNormalPart(normal, R_WL[2]);
      return {x, glm::cross(R_WL[2], x), R_WL[2]};
    }
    return R_WL;
  }
  // If joints without targets lie between the limb and its target, bend the chain.
  if (!main->is_on_limb) {
    bent.push_back(limb);
    return BendTowards(limb, *main, wanted.places[main->role] - p_WL, R_WL, -Facing(wanted.places), mirrored);
  }
  // Otherwise rotate the limb about its direction so that the squared distances of all known roles from their targets
  // are smallest.
  std::vector<glm::dvec3> now, then;
  for (const Aim& aim : aims) {
    now.push_back(R_WL * aim.p_LQ);
    then.push_back(wanted.places[aim.role] - p_WL);
  }
  return AxisRotation(to, BestTwist(to, now, then)) * R_WL;
}

PoseFitter::Pointed PoseFitter::Point(const PoseTargets& wanted, int mirrored) const {
  Pointed pointed;
  TreeState& state = pointed.state;
  state = {wanted.places[Role::kLeftFoot], AxisRotation({0, 1, 0}, Heading(wanted.places)),
           std::vector<double>(tree_.limits.size(), 0.0)};
  std::vector<LimbFrame> limbs(tree_.joints.size());
  limbs[0] = {state.root_position, state.root_frame};
  // From the root outwards, compute the axes of each limb, then its angles within the limits.
  for (std::size_t i = 1; i < limbs.size(); ++i) {
    const TreeJoint& joint = tree_.joints[i];
    const LimbFrame& X_WP = limbs[joint.parent];
    const glm::dvec3 p_WL = X_WP.position + X_WP.axes * joint.p_PJ;
    const glm::dmat3 R_WJ = X_WP.axes * joint.R_PJ;
    const glm::dmat3 R_WL = TurnTowards(static_cast<int>(i), p_WL, R_WJ, wanted, mirrored, pointed.bent);
    glm::dvec3 angles = AnglesOf(glm::transpose(R_WJ) * R_WL, joint.dof_count);
    for (int axis = 0; axis < joint.dof_count; ++axis) {
      angles[axis] = ClampAngle(angles[axis], tree_.limits[joint.first_dof + axis]);
      state.angles[joint.first_dof + axis] = angles[axis];
    }
    limbs[i] = {p_WL, R_WJ * RotationXyz(angles)};
  }
  return pointed;
}

TreeState PoseFitter::Improve(const PoseTargets& wanted, const TreeState& state) const {
  IkProblem problem{state, {}, tree_.limits};
  for (const Role role : effector_roles_) {
    EffectorTarget target;
    target.position = wanted.places[role];
    target.position_weight = wanted.weights[Index(role)];
    target.axis_weights = glm::dvec3(0);
    problem.targets.push_back(target);
  }
  IkSolution solution = solver_.Solve(problem, ExactSteps(), {.restarts = 0});
  TreeState found = state;
  if (solution.status != IkStatus::kBadInput) found.angles = std::move(solution.angles);
  return found;
}

PoseFit PoseFitter::Settle(const PoseTargets& wanted, const TreeState& start) const {
  PoseFit found{.state = Improve(wanted, start)};
  found.squares = SquaresOf(wanted, ToBodyPose(body_, found.state));
  return found;
}

std::optional<PoseFit> PoseFitter::Fit(const PoseTargets& wanted, const std::optional<PoseFit>& last) const {
  if (wanted.weights[Index(Role::kLeftFoot)] <= 0) return std::nullopt;
  for (const Role role : AllRoles()) {
    if (wanted.weights[Index(role)] > 0 && !IsFinite(wanted.places[role])) return std::nullopt;
  }
  // Start from the pose of the first step (Point); try other starts while the residual is too large.
  const double enough = last ? std::max(kMet, kLikeTheLast * last->squares) : kMet;
  const Pointed pointed = Point(wanted);
  PoseFit best = Settle(wanted, pointed.state);
  const auto try_from = [&](const TreeState& start) {
    PoseFit found = Settle(wanted, start);
    if (found.squares < best.squares) best = std::move(found);
  };
  if (last && best.squares > enough) {
    TreeState start = last->state;
    start.root_position = wanted.places[Role::kLeftFoot];
    try_from(start);
  }
  for (const int limb : pointed.bent) {
    if (best.squares > enough) try_from(Point(wanted, limb).state);
  }
  return best;
}

}  // namespace etude
