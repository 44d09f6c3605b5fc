#include "bench/tasks/capture/run.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "bench/tasks/capture/film.h"
#include "bench/tasks/capture/silhouettes.h"
#include "engine/capture/adjust_take.h"
#include "engine/capture/fit_pose.h"
#include "engine/keypoints/adjust_person.h"
#include "engine/keypoints/people.h"
#include "engine/keypoints/recover_person.h"
#include "engine/kinematics/start_angles.h"
#include "engine/motion/rest_body.h"
#include "engine/unmarked/join_outlines.h"

namespace etude {
namespace {

MeasureInputs PicturesOf(const CaptureRun& run) {
  return {.cameras = run.cameras.matrices, .marks = run.measured.marks};
}

/// Returns the joints of every frame, smoothed if the method smooths, else with gaps filled. Joints may be missing
/// before the first observation.
std::vector<OptionalJoints> JointsOf(const CaptureRun& run) {
  if (run.method.smoothing == Smoothing::kRts) return SmoothJoints(run.measured.joints, kJudgedRateHz);
  return InterpolateJoints(run.measured.joints);
}

/// Turns poses into recovered frames by adding the state of the body's tree that is nearest to each pose.
class PosedFrames {
 public:
  explicit PosedFrames(const CaptureBody& body) : body_(body), fitter_(body) {}

  RecoveredFrame At(const BodyPose& pose, const TreeState& last) {
    if (body_.is_paper) {
      return {pose, FindStartState(body_.tree, pose, body_.tree.limits).value_or(last), pose, {}};
    }
    auto found = fitter_.Fit(TargetsAt(pose), last_fit_);
    if (!found) return {pose, last, pose, {}};
    last_fit_ = std::move(found);
    return {pose, last_fit_->state, pose, {}};
  }

 private:
  const CaptureBody& body_;
  const PoseFitter fitter_;
  std::optional<PoseFit> last_fit_;
};

/// Recovers each frame from the marks up to that frame. Frames without marks repeat the last skeleton.
void RecoverLive(const CaptureStages& stages, const NearestPoses* nearest, CaptureRun& run) {
  LiveRecovery live(run.body, RecoverOptionsOf(run.method), LiveGapOptions(stages.options()));
  for (std::size_t k = 0; k < run.measured.frames.size(); ++k) {
    if (stages.marked()[k]) {
      KnownAngles known;
      if (run.method.oracle.start) known.start = (*nearest)[k];
      if (run.method.oracle.ik) known.pose = (*nearest)[k];
      run.frames.push_back(live.Next(run.measured.frames[k], known));
    } else {
      run.frames.push_back(k == 0 ? std::nullopt : run.frames.back());
    }
  }
}

Result<void> RecoverByIk(CaptureStages& stages, CaptureRun& run) {
  const NearestPoses* nearest = nullptr;
  if (run.method.oracle.start || run.method.oracle.ik) {
    ASSIGN_OR_RETURN(nearest, stages.GetNearestPoses(run.method));
  }
  if (run.method.causal) {
    RecoverLive(stages, nearest, run);
    return {};
  }
  RecoverInputs inputs{.body = run.body, .seen = run.measured.seen, .marked = stages.marked()};
  if (run.method.oracle.start) inputs.known_starts = *nearest;
  if (run.method.oracle.ik) inputs.known_poses = *nearest;
  run.frames = RecoverFrames(inputs, RecoverOptionsOf(run.method));
  return {};
}

void RecoverEnds(CaptureRun& run) {
  TreeState last = StandingState(run.body.tree);
  const BodyPose standing = ToBodyPose(run.body, last);
  PosedFrames frames(run.body);
  for (const OptionalJoints& joints : JointsOf(run)) {
    const auto pose = CompleteJoints(joints, standing);
    run.frames.push_back(pose ? std::optional(frames.At(*pose, last)) : std::nullopt);
    if (pose) last = run.frames.back()->state;
  }
}

void RecoverBundle(CaptureRun& run) {
  const std::vector<OptionalJoints> start = InterpolateJoints(run.measured.joints);
  AdjustTakeOptions options;
  options.bundle.smoothness = SmoothnessOf(MakeTakeBody(run.body.lengths), kJudgedRateHz);
  options.bundle.adjusts_lengths = run.method.lengths == LengthSource::kMeasured;
  const AdjustedTake take =
      AdjustTake({.pictures = PicturesOf(run), .lengths = run.body.lengths, .start = start}, options);
  run.frames.resize(start.size());
  if (!take.is_solved) return;
  run.body = take.body;
  for (std::size_t k = 0; k < take.states.size(); ++k) {
    const BodyPose pose = ToBodyPose(run.body, take.states[k]);
    run.frames[k] = RecoveredFrame{pose, take.states[k], pose, {}};
  }
}

/// Recovers the person from the marks, which are used as keypoints of every frame (engine/keypoints).
Result<RecoveredPerson> PersonByKeypoints(const CaptureStages& stages, const CaptureRun& run) {
  std::vector<SeenPeople> people;
  double longer_side = 0;
  for (const std::vector<Marks>& of_camera : run.measured.marks) {
    const Intrinsics& in = stages.world().cameras[people.size()].intrinsics;
    longer_side = std::max<double>(longer_side, std::max(in.width, in.height));
    SeenPeople& seen = people.emplace_back();
    for (const Marks& marks : of_camera) {
      const SeenPerson person = PersonOf(marks);
      seen.emplace_back();
      if (HeightPx(person) > 0) seen.back().push_back(person);
    }
  }
  return RecoverPerson(run.cameras.matrices, people, DefaultRecovery(kJudgedRateHz, longer_side));
}

/// Copies a person's body and motion into the run. Frames for which `is_lost` is true stay without a skeleton.
void TakePerson(const RecoveredPerson& person, const std::vector<bool>& is_lost, CaptureRun& run) {
  run.body = person.body;
  TreeState last = StandingState(run.body.tree);
  PosedFrames frames(run.body);
  for (std::size_t k = 0; k < run.frames.size(); ++k) {
    if (is_lost[k]) continue;
    run.frames[k] = frames.At(person.motion.poses[k], last);
    last = run.frames[k]->state;
  }
}

/// Recovers the motion from the marks as keypoints. Frames in which the person was not seen stay without a skeleton.
void RecoverByKeypoints(const CaptureStages& stages, CaptureRun& run) {
  run.frames.resize(stages.world().truth.size());
  const auto person = PersonByKeypoints(stages, run);
  if (person) TakePerson(*person, person->is_held, run);
}

/// Combines the motion from silhouettes with the marks as keypoints. Frames without a skeleton from silhouettes use the
/// marks alone.
void JoinKeypoints(const CaptureStages& stages, CaptureRun& run) {
  auto person = PersonByKeypoints(stages, run);
  if (!person) return;
  const MatchedPerson matched = person->people[IndexOfPerson(*person, 0).value_or(0)];
  const AdjustPersonOptions adjust{.rate_hz = kJudgedRateHz};
  AdjustPerson(run.cameras.matrices, matched, adjust, *person);
  BodyMotion outlines = person->motion;
  for (std::size_t k = 0; k < run.frames.size(); ++k) {
    if (run.frames[k]) outlines.poses[k] = run.frames[k]->pose;
  }
  if (!JoinOutlines(run.cameras.matrices, matched, outlines, adjust, *person)) return;
  TakePerson(*person, std::vector<bool>(run.frames.size()), run);
}

Result<void> RecoverFromSilhouettes(CaptureStages& stages, CaptureRun& run) {
  const StudioOptions& options = stages.options();
  const std::vector<BodyPose>& truth = stages.world().truth;
  const std::vector<std::vector<Mask>>& masks = run.observation.masks;
  const std::size_t cameras = run.cameras.matrices.size(), pictures = options.PicturesOf(truth.size());
  if (cameras * pictures > kMaxSilhouettePictures) {
    return Fail({}, "the take has {} pictures; allowed with silhouettes: at most {} pictures, that is {:g} s",
                cameras * pictures, kMaxSilhouettePictures,
                static_cast<double>(kMaxSilhouettePictures / cameras) * options.picture_every / kJudgedRateHz);
  }
  // Track the silhouettes picture by picture, either causally or over the whole take.
  const SilhouetteInputs inputs{.first = truth.front(),
                                .key = stages.key(),
                                .body = run.body,
                                .cameras = run.cameras.matrices,
                                .start = run.method.start,
                                .picture_every = options.picture_every,
                                .marks = run.measured.marks};
  std::vector<std::optional<RecoveredFrame>> found;
  if (run.method.causal) {
    LiveSilhouettes live(inputs);
    for (std::size_t picture = 0; picture < pictures; ++picture) {
      std::vector<Mask> of_moment;
      for (const std::vector<Mask>& of_camera : masks) of_moment.push_back(of_camera[picture]);
      found.push_back(live.Next(of_moment));
    }
  } else {
    found = FollowSilhouettes(inputs, masks);
  }
  // Repeat each skeleton until the next picture.
  for (std::size_t k = 0; k < truth.size(); ++k) {
    run.frames.push_back(found[k / static_cast<std::size_t>(options.picture_every)]);
  }
  if (run.method.start == SilhouetteStart::kKeypoints && options.picture_every == 1) JoinKeypoints(stages, run);
  return {};
}

/// Smooths the track of each joint over the recovered frames. Frames without a skeleton are filled.
void SmoothFrames(CaptureRun& run) {
  std::vector<std::optional<BodyPose>> poses;
  for (const auto& frame : run.frames) poses.push_back(frame ? std::optional(frame->pose) : std::nullopt);
  const auto first = std::ranges::find_if(run.frames, [](const auto& frame) { return frame.has_value(); });
  if (first == run.frames.end()) return;
  RecoveredFrame last = **first;
  PosedFrames posed(run.body);
  const std::vector<BodyPose> smooth = SmoothPoses(poses, run.measured.joints, kJudgedRateHz);
  for (std::size_t k = 0; k < run.frames.size(); ++k) {
    if (run.frames[k]) last = *run.frames[k];
    RecoveredFrame frame = posed.At(smooth[k], last.state);
    frame.fixed = last.fixed;
    if (run.frames[k]) frame.errors = last.errors;
    run.frames[k] = std::move(frame);
  }
}

const Observation& ObservationBy(const Take& take, const PersonSource& source) {
  return *std::find_if(take.observations.begin(), take.observations.end(),
                       [&](const Observation& observation) { return observation.source == source; });
}

}  // namespace

RecoverOptions RecoverOptionsOf(const CaptureMethod& method) { return {.solver = method.solver, .ik = method.ik}; }

GapOptions LiveGapOptions(const StudioOptions& options) {
  const int frames = std::lcm(options.mark_every, options.picture_every);
  GapOptions gaps;
  gaps.max_gap = std::max(1, gaps.max_gap / frames);
  gaps.turn_per_frame *= frames;
  return gaps;
}

Result<CaptureBody> BodyFor(CaptureStages& stages, const CaptureRun& run) {
  // RecoverByKeypoints replaces this body by one from the triangulated points.
  if (run.method.recovery == Recovery::kKeypoints) return PaperBody({});
  if (run.method.lengths == LengthSource::kKnown) {
    ASSIGN_OR_RETURN(const CaptureBody* body, stages.GetKnownBody(run.method));
    return *body;
  }
  const bool is_paper = run.method.recovery != Recovery::kIk || run.method.body == BodyKind::kPaper;
  const auto lengths = MeasureLengths(PicturesOf(run), run.measured.joints);
  if (!lengths) return Fail({}, "no limb lengths: no frame shows enough of a body in two pictures to measure them");
  const CaptureBody paper = PaperBody(*lengths);
  if (is_paper) return paper;
  const BodyPose standing = ToBodyPose(paper, StandingState(paper.tree));
  return FittedBody(RestBodyOf({&standing, 1}));
}

Result<void> Recover(CaptureStages& stages, CaptureRun& run) {
  switch (run.method.recovery) {
    case Recovery::kIk:
      RETURN_IF_ERROR(RecoverByIk(stages, run));
      break;
    case Recovery::kEnds:
      RecoverEnds(run);
      return {};  // RecoverEnds has already smoothed each position with its own uncertainty
    case Recovery::kBundle:
      RecoverBundle(run);
      break;
    case Recovery::kKeypoints:
      RecoverByKeypoints(stages, run);
      return {};
    case Recovery::kSilhouettes:
      return RecoverFromSilhouettes(stages, run);
  }
  if (run.method.smoothing == Smoothing::kRts) SmoothFrames(run);
  return {};
}

Result<CaptureRun> RunCapture(CaptureStages& stages, const CaptureMethod& method) {
  ASSIGN_OR_RETURN(const CalibratedCameras* cameras, stages.GetCameras(method));
  ASSIGN_OR_RETURN(const Take* take, stages.GetTake());
  const Observation& observation = ObservationBy(*take, PersonSourceOf(method));
  const MeasuredTake& measured = stages.GetMeasured(method, *cameras, observation);
  CaptureRun run{.method = method,
                 .cameras = *cameras,
                 .take = *take,
                 .observation = observation,
                 .measured = measured,
                 .body = {},
                 .frames = {}};
  ASSIGN_OR_RETURN(run.body, BodyFor(stages, run));
  RETURN_IF_ERROR(Recover(stages, run));
  return run;
}

}  // namespace etude
