// Golden values of whole results, of fits that are cut off early, from far away: whatever changes a step is noticed.
// What is right is said by the tests beside.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "engine/silhouettes/fit_joints.h"
#include "engine/silhouettes/lost_limbs.h"
#include "engine/silhouettes/silhouette_follower.h"
#include "engine/silhouettes/track_silhouettes.h"
#include "tests/engine/silhouettes/swinging_take.h"
#include "tests/support/fingerprint.h"

namespace etude {
namespace {

using testing::Fingerprint;

void AddPoseState(Fingerprint& print, const TreeState& state) {
  print.Add(state.root_position).Add(state.root_frame[0]).Add(state.root_frame[1]).Add(state.root_frame[2]);
  print.Add(state.angles);
}

void AddFit(Fingerprint& print, const std::optional<SilhouetteFit>& fit) {
  print.Add(fit.has_value());
  if (!fit) return;
  AddPoseState(print, fit->state);
  print.Add(1e-3 * fit->picture_cost).Add(1e-3 * fit->cost).Add(fit->iterations);
}

void AddBody(Fingerprint& print, const SilhouetteBody& body) {
  for (const TreeJoint& joint : body.tree.joints) {
    print.Add(joint.name).Add(joint.parent).Add(joint.p_PJ).Add(joint.first_dof).Add(joint.dof_count);
    for (int i = 0; i < 3; ++i) print.Add(joint.R_PJ[i]).Add(body.tree.standing_root[i]);
  }
  for (const AngleRange& range : body.tree.limits) print.Add(range.lower).Add(range.upper);
  for (const TreePoint& role : body.roles) print.Add(role.joint).Add(role.p_LQ);
  for (const FleshCapsule& flesh : body.flesh) {
    print.Add(flesh.a.joint).Add(flesh.a.p_LQ).Add(flesh.b.joint).Add(flesh.b.p_LQ);
    print.Add(flesh.radius_a).Add(flesh.radius_b).Add(flesh.part);
  }
  for (const auto& habit : body.habits) print.Add(habit.angle).Add(habit.spread);
  for (const auto& limb : body.limbs) print.Add(limb.upper).Add(limb.lower).Add(limb.is_arm);
  print.Add(body.part_count);
}

LimbLengths ShortLegged() {
  LimbLengths lengths;
  lengths.thigh *= 0.8, lengths.trunk *= 1.1, lengths.hand *= 1.2, lengths.foot *= 0.9, lengths.neck *= 1.3;
  return lengths;
}

TEST(SilhouettesGolden, Bodies) {
  Fingerprint print;
  AddBody(print, MakeSilhouetteBody({}));
  AddBody(print, MakeSilhouetteBody(ShortLegged()));
  EXPECT_TRUE(print.Is(2352, 120.450522545));
}

/// Balls and lines anywhere, also across the edges.
Mask AnyBlobs(testing::Dice& dice, int width, int height) {
  Mask mask(width, height);
  for (int blob = 0; blob < 3; ++blob) {
    const double x0 = width * (0.5 + 0.5 * dice.Signed()), y0 = height * (0.5 + 0.5 * dice.Signed());
    const double radius = 1 + 0.15 * width * (1 + dice.Signed()), flat = 0.2 + dice.Below(3);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) mask.At(x, y) |= std::hypot(x + 0.5 - x0, flat * (y + 0.5 - y0)) < radius;
    }
  }
  return mask;
}

TEST(SilhouettesGolden, Outlines) {
  testing::Dice dice(1);
  Fingerprint print, distances;
  for (int k = 0; k < 40; ++k) {
    SilhouetteOptions options;
    if (k % 4 == 1) options = {.mask_pixel = 2, .spacing = 2, .thinnest = 0};
    if (k % 4 == 2) options = {.mask_pixel = 0.5, .spacing = 5, .thinnest = 2.3};
    Mask mask = AnyBlobs(dice, 23 + k, 57 - k);
    if (k < 6) mask = Mask(9, 8), mask.At(4, 5) = k > 0, mask.At(k, 3) = k > 2, mask.At(8, 7) = k > 4;
    const Silhouette made = MakeSilhouette(mask, options);
    print.Add(made.left).Add(made.top).Add(made.width).Add(made.height).Add(made.mask_pixel).Add(made.centre);
    print.Add(made.area);
    distances.Add(made.distances.pixels).Add(SignedDistances(mask).pixels);
    for (const OutlinePoint& point : made.outline) print.Add(point.pixel).Add(point.normal);
    for (int i = 0; i < 60 && made.area > 0; ++i) {
      const glm::dvec2 wanted = glm::dvec2(mask.width, mask.height) * (0.5 + glm::dvec2(dice.Vector()));
      const glm::dvec2 pixel = options.mask_pixel * (i % 2 ? wanted : glm::floor(wanted) + 0.5);
      print.Add(DistanceAtPixel(made, pixel).distance).Add(DistanceAtPixel(made, pixel).gradient);
    }
  }
  EXPECT_TRUE(distances.Is(96053, -7811.16152594));
  EXPECT_TRUE(print.Is(10628, -106.690269577));
}

TEST(SilhouettesGolden, DistancesToCones) {
  testing::Dice dice(2);
  Fingerprint print;
  for (int k = 0; k < 200; ++k) {
    const glm::dvec2 a = 10.0 * glm::dvec2(dice.Vector()), b = k % 5 ? 10.0 * glm::dvec2(dice.Vector()) : a;
    const double radius_b = k % 3 ? 3 + 2 * dice.Signed() : 3 + 12 * std::abs(dice.Signed());
    const ProjectedCapsule capsule{true, a, b, 3 + 2 * dice.Signed(), radius_b};
    const SilhouetteResidual found = DistanceTo(capsule, k % 7 ? 20.0 * glm::dvec2(dice.Vector()) : a);
    print.Add(found.value).Add(found.slopes).Add(found.capsule).Add(found.is_inside);
  }
  EXPECT_TRUE(print.Is(2000, 102.357166239));
}

/// One after the other: somebody turning round and swinging arms and legs, in small pictures of which one cuts off the
/// feet, by cameras of which one is near.
struct TurningTake {
  SilhouetteBody body = MakeSilhouetteBody({});
  std::vector<ProjectionMatrix> matrices;
  std::vector<std::vector<Silhouette>> silhouettes;
  std::vector<TreeState> truth;
  std::vector<std::vector<std::vector<SeenJoint>>> joints;

  explicit TurningTake(int frames, double pace = 1) {
    const SilhouetteBody filmed = MakeSilhouetteBody(ShortLegged());
    for (int k = 0; k < frames; ++k) {
      TreeState state = Swinging(body, 0.5 * pace * k);
      state.root_frame = RotationBy({0, 0.15 * pace * k, 0.02 * k}) * state.root_frame;
      state.root_position += 0.03 * pace * k * glm::dvec3(1, 0, 0.3);
      state.angles[body.tree.joints[body.limbs[3].upper].first_dof] = 0.5 + 0.5 * std::cos(0.4 * k);
      truth.push_back(state);
    }
    const std::vector<double> angles = {-50, 30, 160};
    for (std::size_t c = 0; c < angles.size(); ++c) {
      const double away = c == 1 ? 2.6 : 3.6;
      const glm::dvec3 p_WC(away * std::sin(Radians(angles[c])), 1.1 + 0.4 * c, away * std::cos(Radians(angles[c])));
      const Camera camera =
          LookAt({.width = 91, .height = 70, .fx = 84, .fy = 88, .cx = 45, .cy = 33}, p_WC, glm::dvec3(0, 0.95, 0));
      matrices.push_back(MatrixOf(camera));
      silhouettes.emplace_back();
      joints.emplace_back();
      for (int k = 0; k < frames; ++k) {
        silhouettes[c].push_back(MakeSilhouette(RayCast(filmed, truth[k], camera, 1.1), {.spacing = 2}));
        const BodyPose pose = ToBodyPose(filmed, truth[k]);
        auto& seen = joints[c].emplace_back();
        for (const Role role : {Role::kHead, Role::kLeftElbow, Role::kRightWrist, Role::kLeftAnkle, Role::kRightKnee}) {
          const double off = (k + static_cast<int>(role)) % 4 == 0 ? 9 : 0.4;
          seen.push_back({role, *Project(matrices[c], pose[role]) + off, 1 + 0.2 * k});
        }
      }
    }
  }
  std::vector<SilhouetteView> Views(std::size_t frame, bool with_joints) const {
    std::vector<SilhouetteView> views;
    for (std::size_t c = 0; c < matrices.size(); ++c) {
      views.push_back({matrices[c], &silhouettes[c][frame], {}});
      if (with_joints) views.back().joints = joints[c][frame];
    }
    return views;
  }
};

TrackOptions OptionsOfSmallPictures() {
  TrackOptions options;
  options.cost = {.sigma_px = 1.5, .outline_reach_px = 5, .inside_reach_px = 12};
  return options;
}

TEST(SilhouettesGolden, FitsFromFarAwayThatAreCutOff) {
  const TurningTake take(4);
  testing::Dice dice(3);
  Fingerprint costs, slopes, fits, flesh;
  FitWorkspace workspace;
  for (int k = 0; k < 24; ++k) {
    const std::size_t frame = k % 4;
    const auto views = take.Views(frame, k % 3 != 0);
    std::vector<double> by(kRootDofs + take.body.tree.dof_count());
    for (double& step : by) step = (k % 5 ? 0.2 : 2) * dice.Signed();
    const TreeState start = Moved(take.body.tree, take.truth[frame], by);
    const PosePrior prior{take.truth[frame], 0.1, 0.3, 0.4};
    const PosePrior* const own = k % 2 ? &prior : nullptr;
    const SilhouetteCostOptions options = k % 4 < 2 ? SilhouetteCostOptions() : OptionsOfSmallPictures().cost;
    AddFit(costs, CostOf(take.body, views, start, own, options, workspace));
    const NormalEquations equations = NormalEquationsAt(take.body, views, start, own, options, workspace);
    slopes.Add(equations.gradient).Add(equations.hessian);
    for (const ProjectedCapsule& c : workspace.flesh)
      flesh.Add(c.is_valid).Add(c.a).Add(c.b).Add(c.radius_a).Add(c.radius_b);
    std::vector<SilhouetteResidual> inside;
    AppendContainment(workspace.flesh, *views[2].silhouette, options, inside);
    std::vector<double> distances(views[2].silhouette->outline.size(), k % 2 ? 3 : 1e4);
    OutlineDistances(workspace.flesh, *views[2].silhouette, distances);
    flesh.Add(distances);
    for (const SilhouetteResidual& one : inside) flesh.Add(one.value).Add(one.capsule).Add(one.slopes);
    for (const int iterations : {1, 2, 6, 20}) {
      AddFit(fits, FitSilhouettes(take.body, views, start, own, {options, iterations, k % 2 ? 1e-3 : 0.05}, workspace));
    }
  }
  EXPECT_TRUE(costs.Is(1296, 31.5926972399));
  EXPECT_TRUE(slopes.Is(45456, -250477.372576));
  EXPECT_TRUE(flesh.Is(27315, -2148.71077384));
  EXPECT_TRUE(fits.Is(5184, -298.682046201));
}

TEST(SilhouettesGolden, JointsOfAnotherBody) {
  const TurningTake take(5);
  testing::Dice dice(4);
  Fingerprint print;
  for (int k = 0; k < 5; ++k) {
    BodyPose pose = ToBodyPose(MakeSilhouetteBody(ShortLegged()), take.truth[k]);
    for (glm::dvec3& joint : pose.joints) joint += 0.15 * k * dice.Vector();
    JointTargets targets = TargetsOf(pose);
    for (auto& target : targets) {
      if (dice.Below(5) == 0) target.reset();
      if (target && dice.Below(3) == 0) target->sigma_m = 0.05;
    }
    AddPoseState(print, FitJoints(take.body, targets, take.truth[0]));
    if (k % 2) AddPoseState(print, FitJoints(take.body, targets));
    AddPoseState(print, TurnedRound(take.body, take.truth[k]));
  }
  AddPoseState(print, FitJoints(take.body, {}));
  EXPECT_TRUE(print.Is(650, -63.4365201365));
}

TEST(SilhouettesGolden, LimbsThatAreElsewhere) {
  const TurningTake take(2);
  const TrackOptions options = OptionsOfSmallPictures();
  MomentFitter fitter(take.body, options);
  Fingerprint places, fits;
  for (const std::size_t frame : {0, 1}) {
    const auto views = take.Views(frame, frame == 1);
    for (const auto& limb : take.body.limbs) {
      for (const TreeState& state : LimbPlaces(take.body, views, take.truth[frame], limb, options.cost))
        AddPoseState(places, state);
    }
    const TreeState start = Postures(take.body)[1 + frame];
    TreeState there = start;
    there.root_position = take.truth[frame].root_position;
    const SilhouetteFit fit = fitter.Fit(views, there, nullptr, true);
    const PosePrior prior = fitter.PriorNear(take.truth[frame]);
    AddFit(fits, fit);
    AddFit(fits, fitter.WithLimbsFound(views, fit, frame == 1 ? &prior : nullptr));
    AddFit(fits, fitter.FitKnown(views, there));
    AddFit(fits, fitter.Follow(views, there, take.truth[frame]));
    AddFit(fits, fitter.Follow(views, take.truth[frame], take.truth[frame]));
    fits.Add(prior.place_m).Add(prior.turn_rad).Add(prior.angle_rad);
  }
  for (const SilhouetteFit& fit : fitter.Find(take.Views(1, false))) AddFit(fits, fit);
  EXPECT_TRUE(places.Is(800, -67.7534426834));
  EXPECT_TRUE(fits.Is(654, -201.299575604));
}

TEST(SilhouettesGolden, Thickness) {
  const TurningTake take(3);
  FitWorkspace workspace;
  Fingerprint print;
  ThicknessEstimate estimate(take.body);
  for (const std::size_t frame : {0, 1, 2}) {
    estimate.Add(take.Views(frame, false), take.truth[frame], OptionsOfSmallPictures().cost, workspace);
    AddBody(print, estimate.Apply());
  }
  EXPECT_TRUE(print.Is(3528, -599.803584104));
}

TEST(SilhouettesGolden, FollowedMomentByMoment) {
  const TurningTake take(24);
  Fingerprint print;
  for (const bool is_known : {true, false}) {
    TrackOptions options = OptionsOfSmallPictures();
    if (!is_known) options.trial_frames = 3, options.thickness_passes = 1, options.lost = 1.1;
    SilhouetteFollower follower(take.body, take.matrices, is_known ? std::optional(take.truth[1]) : std::nullopt,
                                options);
    const Silhouette nobody = MakeSilhouette(Mask(91, 70));
    for (std::size_t k = 0; k < take.truth.size(); ++k) {
      // Two pictures that show somebody are enough, and after the twelfth frame a moment of another pose is shown.
      std::vector<Silhouette> moment;
      for (std::size_t c = 0; c < 3; ++c)
        moment.push_back(k == 6 + c || (k == 9 && c > 0) ? nobody : take.silhouettes[c][k == 13 ? 2 : k]);
      AddFit(print, follower.Next(moment));
    }
    AddBody(print, follower.body());
  }
  // Where lines of sight are one, nobody can be found.
  const std::vector<ProjectionMatrix> same(2, take.matrices[0]);
  SilhouetteFollower nowhere(take.body, same, std::nullopt, OptionsOfSmallPictures());
  EXPECT_FALSE(nowhere.Next(std::vector<Silhouette>(2, take.silhouettes[0][0])));
  EXPECT_TRUE(print.Is(4838, -624.290112394));
}

TEST(SilhouettesGolden, TracksOfWholeTakes) {
  Fingerprint print;
  for (const bool is_known : {true, false}) {
    TurningTake take(is_known ? 8 : 5, 1.5);
    TrackOptions options = OptionsOfSmallPictures();
    options.anchors = is_known ? 0 : 1;
    options.trial_frames = 2;
    options.lost = 1.2;
    if (is_known) options.repairs = 1, options.thickness_passes = 1;
    take.silhouettes[0][2] = take.silhouettes[1][2] = MakeSilhouette(Mask(91, 70));
    take.silhouettes[2][4] = take.silhouettes[2][1];
    if (is_known) take.silhouettes[2][5] = take.silhouettes[2][6] = take.silhouettes[1][6] = take.silhouettes[2][1];
    const SilhouetteTrack track =
        TrackSilhouettes(take.body,
                         {take.matrices, take.silhouettes,
                          is_known ? std::optional(TurnedRound(take.body, take.truth[0])) : std::nullopt,
                          is_known ? std::span(take.joints) : std::span<std::vector<std::vector<SeenJoint>>>()},
                         options);
    AddBody(print, track.body);
    for (const auto& fit : track.frames) AddFit(print, fit);
  }
  EXPECT_TRUE(print.Is(2948, -497.784725514));
}

}  // namespace
}  // namespace etude
