#include "engine/unmarked/recover_unmarked.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "engine/capture/fit_pose.h"
#include "engine/keypoints/recover_person.h"
#include "engine/kinematics/capture_body.h"
#include "engine/motion/rest_body.h"
#include "engine/silhouettes/silhouette_cost.h"
#include "engine/vision/background_estimate.h"
#include "engine/vision/person_finder.h"

namespace etude {
namespace {

/// Returns `adult` with the relative thickness of `body`: each radius is multiplied by the radius in `body` and divided
/// by the radius in `average`. All three bodies must have the same parts.
SilhouetteBody WithThicknessOf(SilhouetteBody adult, const SilhouetteBody& body, const SilhouetteBody& average) {
  assert(adult.flesh.size() == body.flesh.size() && body.flesh.size() == average.flesh.size());
  for (std::size_t i = 0; i < adult.flesh.size(); ++i) {
    adult.flesh[i].radius_a *= body.flesh[i].radius_a / average.flesh[i].radius_a;
    adult.flesh[i].radius_b *= body.flesh[i].radius_b / average.flesh[i].radius_b;
  }
  return adult;
}

// The default options of engine/silhouettes are tuned in pixels of a camera with twice the resolution of these masks.
constexpr double kMaskPixel = 2;
constexpr double kUsualStature = 1.70;  // metres

using Frames = std::vector<std::size_t>;

/// Returns the person's stature, metres, if the caller states it or the limb lengths that imply it; otherwise nullopt.
std::optional<double> KnownStature(const UnmarkedTake& take) {
  if (!take.lengths) return take.stature_m;
  const LimbLengths &own = *take.lengths, adult = AdultLengths(kUsualStature);
  return kUsualStature * (own.shank + own.thigh + own.trunk) / (adult.shank + adult.thigh + adult.trunk);
}

/// Returns the indices of at most `count` frames, evenly spaced.
Frames EvenlySpaced(std::size_t frames, std::size_t count) {
  Frames some;
  count = std::min(count, frames);
  for (std::size_t i = 0; i < count; ++i) some.push_back((2 * i + 1) * frames / (2 * count));
  return some;
}

ProjectionMatrix MatrixOfMasks(Camera camera) {
  Intrinsics& in = camera.intrinsics;
  for (double* length : {&in.fx, &in.fy, &in.cx, &in.cy, &in.skew}) *length *= kMaskPixel;
  return MatrixOf(camera);
}

class Recovery {
 public:
  Recovery(const UnmarkedTake& take, const UnmarkedOptions& options)
      : take_(take), options_(options), stature_(KnownStature(take).value_or(kUsualStature)) {
    for (const Camera& camera : take.cameras) matrices_.push_back(MatrixOfMasks(camera));
  }

  Result<UnmarkedMotion> Run() {
    Frames all(FrameCount());
    // Alternate between estimating rooms and tracking the body in some frames; finally track the body in all frames.
    for (std::size_t k = 0; k < all.size(); ++k) all[k] = k;
    const Frames some = EvenlySpaced(all.size(), options_.samples);
    rooms_.assign(take_.rooms.begin(), take_.rooms.end());
    const bool knows_rooms = !rooms_.empty() || !take_.masks.empty();  // rooms need no estimate
    if (!knows_rooms) EstimateRooms(some, {});
    for (int round = 1; round < options_.rounds; ++round) {
      if (knows_rooms && (KnownStature(take_) || round > 1)) break;
      const SilhouetteTrack track = Track(some);
      if (!KnownStature(take_)) stature_ = StatureOf(track);
      if (!knows_rooms) EstimateRooms(some, track);
    }
    return MotionOf(Track(all));
  }

 private:
  std::size_t FrameCount() const { return take_.masks.empty() ? take_.pictures[0].size() : take_.masks[0].size(); }

  std::vector<ColourImage> PicturesOf(std::size_t camera, const Frames& frames) const {
    std::vector<ColourImage> pictures;
    for (const std::size_t k : frames) pictures.push_back(take_.pictures[camera][k]);
    return pictures;
  }

  /// Estimates the rooms from pixels with little motion. If a body has been tracked in these frames, only pixels away
  /// from the body are used.
  void EstimateRooms(const Frames& frames, const SilhouetteTrack& track) {
    constexpr double kMotionLag = 0.1;  // time between compared pictures, seconds
    // Convert this time to a number of sampled frames.
    const double between = static_cast<double>(take_.pictures[0].size()) / (take_.rate_hz * frames.size());
    const MotionOptions motion{.lag = std::max<std::size_t>(1, std::lround(kMotionLag / between))};
    rooms_.clear();
    for (std::size_t c = 0; c < take_.cameras.size(); ++c) {
      const std::vector<ColourImage> pictures = PicturesOf(c, frames);
      if (motion_.size() == c) motion_.push_back(MotionActivity(pictures, motion));
      std::vector<Activity> activity = motion_[c];
      for (std::size_t i = 0; i < track.frames.size(); ++i) {
        AddNearness(track, i, c, activity[i]);
      }
      rooms_.push_back(EstimateBackground(pictures, activity, options_.kept));
    }
  }

  /// Calls `visit(x, y, distance)` for all pixels of a mask that may be within `reach` of the body; a pixel near
  /// several capsules of the body is visited once for each capsule. Lengths are in pixels of `matrices_`. Does nothing
  /// if the body is unknown in that frame.
  template <typename Visit>
  void VisitFlesh(const SilhouetteTrack& track, std::size_t frame, std::size_t camera, const glm::dvec2& size,
                  double reach, const Visit& visit) {
    const std::optional<SilhouetteFit>& fit = track.frames[frame];
    if (!fit) return;
    flesh_.clear();
    ProjectFlesh(track.body, ComputeFrames(track.body.tree, fit->state), matrices_[camera], flesh_);
    // Visit the bounding box of each body part.
    for (const ProjectedCapsule& capsule : flesh_) {
      if (!capsule.is_valid) continue;
      const double margin = std::max(capsule.radius_a, capsule.radius_b) + reach;
      const auto low = glm::clamp((glm::min(capsule.a, capsule.b) - margin) / kMaskPixel, glm::dvec2(0), size);
      const auto high = glm::clamp((glm::max(capsule.a, capsule.b) + margin) / kMaskPixel, glm::dvec2(0), size);
      for (int y = static_cast<int>(low.y); y < static_cast<int>(high.y); ++y) {
        for (int x = static_cast<int>(low.x); x < static_cast<int>(high.x); ++x) {
          visit(x, y, SignedDistanceTo(capsule, kMaskPixel * glm::dvec2(x + 0.5, y + 0.5)));
        }
      }
    }
  }

  std::optional<double> DisagreementIn(const SilhouetteTrack& track, std::size_t frame, std::size_t camera) {
    const Mask& mask = masks_[camera][frame];
    Mask body(mask.width, mask.height);
    VisitFlesh(track, frame, camera, {mask.width, mask.height}, 0, [&](int x, int y, double distance) {
      if (distance <= 0) body.At(x, y) = 1;
    });
    std::size_t both = 0, any = 0, seen = 0, covered = 0;
    for (std::size_t i = 0; i < mask.pixels.size(); ++i) {
      const bool is_seen = mask.pixels[i] != 0, is_covered = body.pixels[i] != 0;
      seen += is_seen, covered += is_covered, both += is_seen && is_covered, any += is_seen || is_covered;
    }
    if (seen == 0 || covered == 0) return std::nullopt;
    return 1 - static_cast<double>(both) / static_cast<double>(any);
  }

  /// Adds to each pixel's activity the pixel's nearness to the body: `reach` minus the distance, in pixels. For pixels
  /// on the body, this sum exceeds the activity that motion can give. If the body is unknown, every pixel counts as
  /// near.
  void AddNearness(const SilhouetteTrack& track, std::size_t frame, std::size_t camera, Activity& activity) {
    const double reach = kMaskPixel * options_.body_reach_px;
    const bool is_known = track.frames[frame].has_value();
    Activity nearness(activity.width, activity.height, is_known ? 0.0f : static_cast<float>(reach));
    VisitFlesh(track, frame, camera, {activity.width, activity.height}, reach, [&](int x, int y, double distance) {
      nearness.At(x, y) = std::max(nearness.At(x, y), static_cast<float>(reach - distance));
    });
    for (std::size_t i = 0; i < activity.pixels.size(); ++i) activity.pixels[i] += nearness.pixels[i];
  }

  /// Tracks the body in these frames, with the current rooms as backgrounds.
  SilhouetteTrack Track(const Frames& frames) {
    // Find the silhouette of the person in every picture.
    masks_.clear();
    silhouettes_.clear();
    for (std::size_t c = 0; c < take_.cameras.size(); ++c) {
      std::optional<PersonFinder> finder;
      if (take_.masks.empty()) finder.emplace(rooms_[c], options_.person);
      std::vector<Mask>& masks = masks_.emplace_back();
      std::vector<Silhouette>& silhouettes = silhouettes_.emplace_back();
      for (const std::size_t k : frames) {
        masks.push_back(finder ? finder->Find(take_.pictures[c][k]) : take_.masks[c][k]);
        silhouettes.push_back(MakeSilhouette(masks.back(), {.mask_pixel = kMaskPixel}));
      }
    }
    // Convert the expected deviations per frame from 30 Hz to the rate of the sampled frames.
    const double rate = take_.rate_hz * static_cast<double>(frames.size()) / static_cast<double>(FrameCount());
    TrackOptions track = options_.track;
    track.angle_change *= kJudgedRateHz / rate;
    track.position_change_m *= kJudgedRateHz / rate;
    // Convert keypoints to pixels of `matrices_`.
    std::vector<std::vector<std::vector<SeenJoint>>> joints;
    for (const auto& of_camera : take_.people) {
      auto& seen = joints.emplace_back();
      for (const std::size_t k : frames) {
        seen.emplace_back();
        if (of_camera[k]) seen.back() = SeenJointsOf(*of_camera[k], options_.keypoint_px);
        for (SeenJoint& joint : seen.back()) {
          joint.pixel *= kMaskPixel;
          joint.sigma_px *= kMaskPixel;
        }
      }
    }
    const SilhouetteBody body = MakeSilhouetteBody(take_.lengths.value_or(AdultLengths(stature_)));
    return TrackSilhouettes(
        body, {.cameras = matrices_, .silhouettes = silhouettes_, .start = std::nullopt, .joints = joints}, track);
  }

  std::vector<SilhouetteView> ViewsOf(std::size_t frame) const {
    std::vector<SilhouetteView> views;
    for (std::size_t c = 0; c < matrices_.size(); ++c) {
      const Silhouette& silhouette = silhouettes_[c][frame];
      if (silhouette.area > 0) views.push_back({matrices_[c], &silhouette});
    }
    return views;
  }

  double StatureOf(const SilhouetteTrack& track) const {
    std::vector<std::vector<SilhouetteView>> views;
    std::vector<PosedViews> moments;  // spans of `views`, which therefore must not reallocate
    views.reserve(track.frames.size());
    for (std::size_t i = 0; i < track.frames.size(); ++i) {
      if (track.frames[i]) moments.push_back({views.emplace_back(ViewsOf(i)), track.frames[i]->state});
    }
    if (moments.empty()) return stature_;
    return FitStature(track.body, stature_, moments, {.cost = options_.track.cost});
  }

  Result<UnmarkedMotion> MotionOf(const SilhouetteTrack& track) {
    UnmarkedMotion result;
    result.motion.rate_hz = take_.rate_hz;
    result.stature_m = stature_;
    const auto first = std::ranges::find_if(track.frames, [](const auto& fit) { return fit.has_value(); });
    if (first == track.frames.end()) {
      return Fail({}, "no frame shows a moving person in two films{}",
                  take_.rooms.empty() && take_.masks.empty()
                      ? "; Etude cannot distinguish a person who never moves from the room"
                      : "");
    }
    // Copy poses and cost; untracked frames repeat the last pose.
    BodyPose last = ToBodyPose(track.body, (*first)->state);
    for (const auto& fit : track.frames) {
      if (fit) {
        last = ToBodyPose(track.body, fit->state);
        result.cost += fit->picture_cost;
      } else {
        ++result.held;
      }
      result.motion.poses.push_back(last);
    }
    result.cost /= static_cast<double>((track.frames.size() - result.held) * matrices_.size());
    // Fit a skeleton to the poses, for the clip.
    ASSIGN_OR_RETURN(CaptureBody body, FittedBody(RestBodyOf(result.motion.poses)));
    NameHead(body);
    std::vector<TreeState> states;
    const PoseFitter fitter(body);
    std::optional<PoseFit> last_fit;
    for (const BodyPose& pose : result.motion.poses) {
      if (auto found = fitter.Fit(TargetsAt(pose), last_fit)) last_fit = std::move(found);
      states.push_back(last_fit ? last_fit->state : StandingState(body.tree));
    }
    result.clip = ToClip(body, states, take_.rate_hz, "capture");
    for (std::size_t c = 0; c < matrices_.size(); ++c) {
      result.apart.emplace_back();
      for (std::size_t k = 0; k < track.frames.size(); ++k) result.apart.back().push_back(DisagreementIn(track, k, c));
    }
    result.rooms = std::move(rooms_);
    result.silhouettes = std::move(masks_);
    return result;
  }

  const UnmarkedTake& take_;
  const UnmarkedOptions& options_;
  double stature_;
  std::vector<ProjectionMatrix> matrices_;
  std::vector<ColourImage> rooms_;
  std::vector<std::vector<Activity>> motion_;  ///< [camera][frame]: the activity in the frames of EstimateRooms
  std::vector<std::vector<Mask>> masks_;
  std::vector<std::vector<Silhouette>> silhouettes_;  ///< silhouettes of the frames tracked last
  std::vector<ProjectedCapsule> flesh_;
};

}  // namespace

LimbLengths AdultLengths(double stature_m) {
  constexpr double kStature = 1.74;
  LimbLengths lengths;
  for (const auto& [name, length] : kLimbLengths) lengths.*length *= stature_m / kStature;
  return lengths;
}

double FitStature(const SilhouetteBody& body, double stature_m, std::span<const PosedViews> moments,
                  const FitOptions& options) {
  constexpr std::array kScales = {0.94, 0.96, 0.98, 1.0, 1.02, 1.04, 1.06};
  // For every scale of the stature, sum the cost over the moments (pictures of one time).
  const SilhouetteBody average = MakeSilhouetteBody(AdultLengths(stature_m));
  std::array<double, kScales.size()> costs{};
  FitWorkspace workspace;
  for (std::size_t i = 0; i < kScales.size(); ++i) {
    const SilhouetteBody adult =
        WithThicknessOf(MakeSilhouetteBody(AdultLengths(kScales[i] * stature_m)), body, average);
    for (const PosedViews& moment : moments) {
      costs[i] += FitSilhouettes(adult, moment.views, moment.state, nullptr, options, workspace).picture_cost;
    }
  }
  const auto best = static_cast<std::size_t>(std::ranges::min_element(costs) - costs.begin());
  if (best == 0 || best + 1 == kScales.size()) return kScales[best] * stature_m;
  // Take the minimum of the parabola through the best scale and its neighbours.
  const double below = costs[best - 1] - costs[best], above = costs[best + 1] - costs[best];
  const double step = kScales[1] - kScales[0];
  const double shift = below + above > 0 ? 0.5 * step * (below - above) / (below + above) : 0;
  return (kScales[best] + shift) * stature_m;
}

std::vector<SeenJoint> SeenJointsOf(const SeenPerson& person, double sigma_px) {
  std::vector<SeenJoint> joints;
  for (const auto& [landmark, role] : kJointLandmarks) {
    const Keypoint& keypoint = person[landmark];
    if (!(keypoint.confidence > 0)) continue;
    joints.push_back({role, keypoint.pixel, sigma_px / std::sqrt(std::min(1.0, keypoint.confidence))});
  }
  std::ranges::stable_partition(joints, [](const SeenJoint& joint) {  // the hands come last
    return joint.role != Role::kLeftHand && joint.role != Role::kRightHand;
  });
  return joints;
}

Result<UnmarkedMotion> RecoverUnmarked(const UnmarkedTake& take, const UnmarkedOptions& options) {
  assert(take.cameras.size() >= 2);
  assert(take.masks.empty() ? take.pictures.size() == take.cameras.size() && !take.pictures[0].empty()
                            : take.masks.size() == take.cameras.size() && !take.masks[0].empty());
  assert(take.rooms.empty() || take.rooms.size() == take.cameras.size());
  return Recovery(take, options).Run();
}

}  // namespace etude
