#include "engine/silhouettes/fit_silhouettes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "engine/base/angles.h"
#include "engine/silhouettes/fit_joints.h"
#include "engine/silhouettes/turns.h"
#include "tests/engine/silhouettes/capsule_picture.h"

namespace etude {
namespace {

// Returns a standing body with one arm raised sideways, the other arm and one knee bent.
TreeState Posed(const SilhouetteBody& body, double phase = 0) {
  TreeState state = Bent(body, {{body.limbs[0].upper, 1, -60 + 10 * std::sin(phase)},
                                {body.limbs[1].upper, 0, 40 + 25 * std::sin(phase)},
                                {body.limbs[1].lower, 0, 70 + 20 * std::cos(phase)},
                                {body.limbs[3].upper, 0, 40 + 20 * std::cos(phase)},
                                {body.limbs[3].lower, 0, -60}});
  state.root_position = {0.05 * std::sin(phase), 0.95, 0};
  return state;
}

double MeanError(const BodyPose& a, const BodyPose& b) {
  double sum = 0;
  for (const Role role : AllRoles()) sum += glm::distance(a[role], b[role]);
  return sum / kRoleCount;
}

struct Shown {
  std::vector<Camera> cameras;
  std::vector<Silhouette> silhouettes;

  Shown(const SilhouetteBody& body, const TreeState& state, const std::vector<double>& angles_deg, double thickness = 1)
      : cameras(CamerasAround(angles_deg)) {
    for (const Camera& camera : cameras) {
      silhouettes.push_back(MakeSilhouette(RayCast(body, state, camera, thickness), {.spacing = 2}));
    }
  }

  std::vector<SilhouetteView> Views() const {
    std::vector<SilhouetteView> views;
    for (std::size_t i = 0; i < cameras.size(); ++i) views.push_back({MatrixOf(cameras[i]), &silhouettes[i]});
    return views;
  }
};

// Returns options for small pictures of the fitted body itself: a pixel is 17 mm at the body, and outlines err by
// about a pixel.
SilhouetteCostOptions SmallPictures() { return {.sigma_px = 1, .outline_reach_px = 8, .inside_reach_px = 22}; }

std::vector<double> Scatter(int size, double by) {
  std::vector<double> steps(size);
  for (int i = 0; i < size; ++i) steps[i] = by * std::sin(12.9898 * (i + 1));
  for (int i = 0; i < 3; ++i) steps[i] *= 0.3;  // metres, smaller than radians
  return steps;
}

TEST(FitSilhouettes, GradientIsThatOfTheCost) {
  const SilhouetteBody body = MakeSilhouetteBody({});
  const TreeState truth = Posed(body);
  const Shown shown(body, truth, {-40, 40});
  const int size = kRootDofs + body.tree.dof_count();
  const TreeState at = Moved(body.tree, truth, Scatter(size, 0.1));
  const PosePrior prior{truth, 0.1, 0.2, 0.2};
  // An almost quadratic loss, whose slope is weight times residual.
  SilhouetteCostOptions options = SmallPictures();
  options.outline_reach_px = options.inside_reach_px = options.joint_reach = 1e5;
  FitWorkspace workspace;
  auto views = shown.Views();
  const std::vector<SeenJoint> joints = {{Role::kLeftWrist, {90, 60}, 0.5}, {Role::kRightAnkle, {130, 150}, 2}};
  views[0].joints = joints;
  const NormalEquations found = NormalEquationsAt(body, views, at, &prior, options, workspace);
  constexpr double kStep = 1e-6;
  for (int i = 0; i < size; ++i) {
    std::vector<double> step(size, 0.0);
    const auto cost = [&](double by) {
      step[i] = by;
      return CostOf(body, views, Moved(body.tree, at, step), &prior, options, workspace).cost;
    };
    // `gradient` is that of half the cost. The cost has kinks where outlines cross, because the nearest piece
    // changes.
    EXPECT_NEAR(found.gradient[i], (cost(kStep) - cost(-kStep)) / (4 * kStep),
                2e-3 * std::abs(found.gradient[i]) + 0.05)
        << "coordinate " << i;
  }
}

TEST(FitSilhouettes, SlopesOfAProjectedCapsuleAreThoseOfItsDistance) {
  const ProjectedCapsule capsule{true, {10, 20}, {40, 35}, 6, 3};
  constexpr double kStep = 1e-6;
  for (const glm::dvec2 pixel : {glm::dvec2(30, 10), glm::dvec2(2, 15), glm::dvec2(47, 41), glm::dvec2(24, 28)}) {
    const SilhouetteResidual at = DistanceTo(capsule, pixel);
    for (int i = 0; i < 6; ++i) {
      const auto moved = [&](double by) {
        ProjectedCapsule other = capsule;
        double* const values[] = {&other.a.x, &other.a.y, &other.radius_a, &other.b.x, &other.b.y, &other.radius_b};
        *values[i] += by;
        return DistanceTo(other, pixel).value;
      };
      EXPECT_NEAR(at.slopes[i], (moved(kStep) - moved(-kStep)) / (2 * kStep), 1e-6) << i;
    }
  }
}

TEST(FitSilhouettes, DistanceToAConeIsTheLeastToTheCirclesAlongIt) {
  const ProjectedCapsule capsule{true, {10, 20}, {40, 35}, 9, 3};
  for (const glm::dvec2 pixel : {glm::dvec2(30, 10), glm::dvec2(2, 15), glm::dvec2(47, 41), glm::dvec2(24, 28)}) {
    double least = 1e9;
    for (int i = 0; i <= 20000; ++i) {
      const double t = i / 20000.0;
      least = std::min(least, glm::distance(pixel, glm::mix(capsule.a, capsule.b, t)) - std::lerp(9.0, 3.0, t));
    }
    EXPECT_NEAR(DistanceTo(capsule, pixel).value, least, 1e-6);
  }
}

TEST(FitSilhouettes, NearestCapsulesAreThoseThatAComparisonOfAllFinds) {
  const SilhouetteBody body = MakeSilhouetteBody({});
  const Shown shown(body, Posed(body), {-40, 40, 160});
  const SilhouetteCostOptions options = SmallPictures();
  std::size_t compared = 0;
  for (std::size_t camera = 0; camera < shown.cameras.size(); ++camera) {
    for (const double scatter : {0.0, 0.1, 0.4}) {
      const int size = kRootDofs + body.tree.dof_count();
      const TreeState state = Moved(body.tree, Posed(body), Scatter(size, scatter));
      SeenFlesh seen;
      std::vector<ProjectedCapsule>& flesh = seen.capsules;
      ProjectFlesh(body, ComputeFrames(body.tree, state), MatrixOf(shown.cameras[camera]), flesh);
      flesh[3].is_valid = false;
      flesh[5].radius_a = glm::distance(flesh[5].a, flesh[5].b) + 2 * flesh[5].radius_b;  // one end contains the other
      const Silhouette& silhouette = shown.silhouettes[camera];
      std::vector<SilhouetteResidual> found;
      MeasureFlesh(silhouette, seen);
      AppendResiduals(seen, silhouette, options, found);
      // Each outline point has the distance to its nearest capsule, bit for bit; of equally near capsules, the first
      // counts.
      ASSERT_GE(found.size(), silhouette.outline.size());
      for (std::size_t i = 0; i < silhouette.outline.size(); ++i, ++compared) {
        SilhouetteResidual least{.value = 1e9};
        for (std::size_t j = 0; j < flesh.size(); ++j) {
          if (!flesh[j].is_valid) continue;
          SilhouetteResidual one = DistanceTo(flesh[j], silhouette.outline[i].pixel);
          one.capsule = static_cast<int>(j);
          if (one.value < least.value) least = one;
        }
        EXPECT_EQ(found[i].value, least.value);
        EXPECT_EQ(found[i].capsule, least.capsule);
      }
      // The total equals the sum of the losses.
      double sum = 0, told = 0;
      for (const SilhouetteResidual& residual : found) sum += LossOf(residual, options).loss;
      AddLosses(seen, silhouette, options, told);
      EXPECT_EQ(told, sum);
      // The normal equations of a capsule equal the sums over its residuals, bit for bit.
      std::vector<ConeSums> wanted(flesh.size());
      for (const SilhouetteResidual& residual : found) {
        ConeSums& sums = wanted[static_cast<std::size_t>(residual.capsule)];
        const double weight = LossOf(residual, options).weight;
        for (int i = 0; i < 6; ++i) {
          sums.gradient[i] += weight * residual.value * residual.slopes[i];
          for (int j = 0; j < 6; ++j) sums.hessian[j][i] += weight * residual.slopes[i] * residual.slopes[j];
        }
      }
      ResidualSums sums;
      SumResiduals(seen, silhouette, options, sums);
      for (std::size_t j = 0; j < flesh.size(); ++j) {
        for (int i = 0; i < 6; ++i) {
          EXPECT_EQ(sums.capsules[j].gradient[i], wanted[j].gradient[i]);
          for (int k = 0; k < 6; ++k) EXPECT_EQ(sums.capsules[j].hessian[k][i], wanted[j].hessian[k][i]);
        }
      }
      // Capsules lower distances that are given by column.
      std::vector<double> distances(silhouette.columns.u.size(), 1.5);
      OutlineDistances(flesh, silhouette, distances);
      for (std::size_t i = 0; i < silhouette.outline.size(); ++i) {
        EXPECT_EQ(distances[static_cast<std::size_t>(silhouette.columns.places[i])], std::min(1.5, found[i].value));
      }
    }
  }
  EXPECT_GT(compared, 500u);
}

TEST(FitSilhouettes, FindsABodyThatAnotherRasteriserDrew) {
  const SilhouetteBody body = MakeSilhouetteBody({});
  const TreeState truth = Posed(body);
  const Shown shown(body, truth, {-40, 40, 160});
  const TreeState start = Moved(body.tree, truth, Scatter(kRootDofs + body.tree.dof_count(), 0.08));
  FitWorkspace workspace;
  SilhouetteCostOptions wide = SmallPictures();
  wide.outline_reach_px *= 5;
  wide.inside_reach_px *= 5;
  const auto views = shown.Views();
  const SilhouetteFit near =
      FitSilhouettes(body, views, start, nullptr, {.cost = wide, .max_iterations = 30}, workspace);
  const SilhouetteFit fit =
      FitSilhouettes(body, views, near.state, nullptr, {.cost = SmallPictures(), .max_iterations = 30}, workspace);
  const BodyPose wanted = ToBodyPose(body, truth);
  EXPECT_GT(MeanError(ToBodyPose(body, start), wanted), 0.04);
  EXPECT_LT(MeanError(ToBodyPose(body, fit.state), wanted), 0.02);
}

TEST(FitSilhouettes, IsNotFooledByOtherMasks) {
  // The control: silhouettes of another shape. The pose is wrong, and its cost is many times higher.
  const SilhouetteBody body = MakeSilhouetteBody({});
  const TreeState truth = Posed(body);
  const Shown right(body, truth, {-40, 40, 160});
  TreeState elsewhere = truth;
  elsewhere.root_frame = RotationBy({0, 0, Radians(90)}) * truth.root_frame;
  const Shown wrong(body, elsewhere, {-40, 40, 160});
  FitWorkspace workspace;
  const FitOptions options{.cost = SmallPictures(), .max_iterations = 30};
  const SilhouetteFit good = FitSilhouettes(body, right.Views(), truth, nullptr, options, workspace);
  const SilhouetteFit bad = FitSilhouettes(body, wrong.Views(), truth, nullptr, options, workspace);
  EXPECT_GT(bad.picture_cost, 5 * good.picture_cost);
  EXPECT_GT(MeanError(ToBodyPose(body, bad.state), ToBodyPose(body, truth)), 0.1);
}

// Joints seen in the same pictures determine what outlines leave open; a very wrong joint does no harm.
TEST(FitSilhouettes, TakesSeenJointsIntoAccountAndMistrustsWhatIsFarOff) {
  const SilhouetteBody body = MakeSilhouetteBody({});
  const TreeState truth = Posed(body);
  const BodyPose wanted = ToBodyPose(body, truth);
  const Shown shown(body, truth, {-40, 40});
  auto views = shown.Views();
  const TreeState start = Moved(body.tree, truth, Scatter(kRootDofs + body.tree.dof_count(), 0.12));
  FitWorkspace workspace;
  std::array<std::vector<SeenJoint>, 2> joints;
  const auto error_with = [&](bool has_joints) {
    for (std::size_t c = 0; c < 2; ++c)
      views[c].joints = has_joints ? std::span<const SeenJoint>(joints[c]) : std::span<const SeenJoint>();
    FitOptions options{.cost = SmallPictures(), .max_iterations = 40};
    options.cost.joint_reach = 60;
    const TreeState near = FitSilhouettes(body, views, start, nullptr, options, workspace).state;
    options.cost.joint_reach = 3;
    return MeanError(ToBodyPose(body, FitSilhouettes(body, views, near, nullptr, options, workspace).state), wanted);
  };
  for (std::size_t c = 0; c < 2; ++c) {
    for (const Role role : {Role::kLeftElbow, Role::kLeftWrist, Role::kRightElbow, Role::kRightWrist, Role::kLeftKnee,
                            Role::kRightKnee, Role::kLeftAnkle, Role::kRightAnkle, Role::kLeftHip, Role::kRightHip}) {
      joints[c].push_back({role, *Project(views[c].matrix, wanted[role]), 0.5});
    }
  }
  const double with = error_with(true);
  EXPECT_LT(with, 0.7 * error_with(false));
  joints[0].push_back({Role::kHead, *Project(views[0].matrix, wanted[Role::kLeftFoot]), 0.5});
  EXPECT_LT(error_with(true), with + 0.01);
}

TEST(FitSilhouettes, DoesNotDependOnTheOrderOfCameras) {
  const SilhouetteBody body = MakeSilhouetteBody({});
  const TreeState truth = Posed(body);
  const Shown shown(body, truth, {-40, 40, 160});
  auto views = shown.Views();
  const TreeState start = Moved(body.tree, truth, Scatter(kRootDofs + body.tree.dof_count(), 0.08));
  FitWorkspace workspace;
  const FitOptions options{.cost = SmallPictures()};
  const BodyPose one = ToBodyPose(body, FitSilhouettes(body, views, start, nullptr, options, workspace).state);
  std::ranges::reverse(views);
  const BodyPose other = ToBodyPose(body, FitSilhouettes(body, views, start, nullptr, options, workspace).state);
  EXPECT_LT(MeanError(one, other), 1e-6);
}

TEST(FitSilhouettes, KeepsAnglesWithinTheirLimits) {
  const SilhouetteBody body = MakeSilhouetteBody({});
  const Shown shown(body, Posed(body), {-40, 40});
  TreeState start = StandingState(body.tree);
  start.root_position = {0, 0.95, 0};
  FitWorkspace workspace;
  const SilhouetteFit fit = FitSilhouettes(body, shown.Views(), start, nullptr, {.cost = SmallPictures()}, workspace);
  for (std::size_t i = 0; i < fit.state.angles.size(); ++i) {
    EXPECT_GE(fit.state.angles[i], body.tree.limits[i].lower);
    EXPECT_LE(fit.state.angles[i], body.tree.limits[i].upper);
  }
}

TEST(FitJoints, GivesAPoseOfTheBodyBack) {
  const SilhouetteBody body = MakeSilhouetteBody({});
  for (const double phase : {0.0, 1.5, 3.0}) {
    TreeState truth = Posed(body, phase);
    truth.root_frame = RotationBy({0, 2 + phase, 0}) * truth.root_frame;
    const BodyPose wanted = ToBodyPose(body, truth);
    const BodyPose found = ToBodyPose(body, FitJoints(body, TargetsOf(wanted, 1e-4)));
    EXPECT_LT(MeanError(found, wanted), 1e-3);
  }
}

TEST(FitJoints, FillsInWhatNobodyKnows) {
  const SilhouetteBody body = MakeSilhouetteBody({});
  const BodyPose wanted = ToBodyPose(body, Posed(body));
  JointTargets targets = TargetsOf(wanted, 1e-3);
  for (const Role role : {Role::kLeftElbow, Role::kSpine, Role::kRightHand}) targets[Index(role)].reset();
  const BodyPose found = ToBodyPose(body, FitJoints(body, targets));
  EXPECT_LT(glm::distance(found[Role::kLeftWrist], wanted[Role::kLeftWrist]), 5e-3);
  EXPECT_LT(glm::distance(found[Role::kLeftElbow], wanted[Role::kLeftElbow]), 5e-2);
}

}  // namespace
}  // namespace etude
