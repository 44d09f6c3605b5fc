#include "bench/recordings/task_extras.h"

#include "bench/recordings/record_fields.h"

namespace etude {

// RecordFields finds these functions by argument-dependent lookup, so they are not in an unnamed namespace. The
// function that describes a nested part is declared before the function that describes its record.

static void Describe(RecordFields& fields, IkExtras& extras) {
  fields.Tolerated("iterations", extras.iterations,
                   "for each frame, the iteration that it shows, counted from 0; the numbers never decrease");
  fields.Tolerated("position_error_max_cm", extras.position_error_max_cm,
                   "for each frame, the position error of the worst end effector");
  fields.Tolerated("orientation_error_max_deg", extras.orientation_error_max_deg,
                   "for each frame, the orientation error of the worst end effector, as a mean over its axes");
  fields.Tolerated("axis_error_max_deg", extras.axis_error_max_deg,
                   "for each frame, the error of the worst single axis");
  fields.Tolerated("targets_m", extras.targets_m,
                   "target position [x, y, z] of each end effector, in the order of the joint tree; null if an end "
                   "effector has no target position");
}

static void Describe(RecordFields& fields, TransitionExtras::Point& point) {
  fields.Tolerated("from", point.from, "the clip that the motion leaves; `in-between` for frames that the method made");
  fields.Tolerated("from_frame", point.from_frame, "the last frame of the clip `from` that is shown");
  fields.Tolerated("to", point.to, "the clip that is entered");
  fields.Tolerated("to_frame", point.to_frame, "the frame of the clip `to` that is aligned with `from_frame`");
  fields.Tolerated("distance", point.distance, "fuzzy distance between the two frames");
  fields.Tolerated("partials", point.partials, "for each feature, S_k Δ_k²; their sum is the square of the distance");
}

static void Describe(RecordFields& fields, TransitionExtras::Candidate& candidate) {
  fields.Tolerated("point", candidate.point, "index of the candidate's transition point, counted from 0");
  fields.Required("from_frame", candidate.from_frame,
                  "the frame at which the motion leaves a clip at that transition point");
  fields.Required("to_frame", candidate.to_frame,
                  "the frame at which the motion enters the next clip at that transition point");
  fields.Required("distance", candidate.distance, "fuzzy distance between the two frames");
  fields.Tolerated("partials", candidate.partials,
                   "for each feature, the same values as in `partials` of a transition point");
  fields.Tolerated("cost", candidate.cost,
                   "the cost by which the method ranks candidates; null if it ranks them by distance");
  fields.Tolerated("outcome", candidate.outcome, "`taken`, `too far`, `later` or `worse`");
}

static void Describe(RecordFields& fields, TransitionExtras& extras) {
  fields.Tolerated("transition_frame", extras.transition_frame, "the first of `transition_frames`");
  fields.ToleratedList("transition_frames", extras.transition_frames,
                       "for each change of clip, the last frame of the recording before the change");
  fields.Tolerated("from", extras.from, "the clip that the motion leaves");
  fields.Tolerated("to", extras.to, "the wanted clip");
  fields.Tolerated("branch", extras.branch, "the kind of the transition: `front half`, `in-between`, …");
  fields.Tolerated("why", extras.why, "one sentence that states why the transition was made in this way");
  fields.Tolerated("request_frame", extras.request_frame,
                   "frame of the request; negative if the request is before the recording");
  fields.Tolerated("wait_s", extras.wait_s, "time from the request until the wanted clip plays");
  fields.Tolerated("threshold", extras.threshold, "the threshold: frames match if their distance is below it");
  fields.Tolerated("natural_limit_cm", extras.natural_limit_cm, "the largest jump that counts as natural");
  fields.Tolerated("distance", extras.distance, "fuzzy distance at the worst transition point");
  fields.Tolerated("weights", extras.weights, "the weight S_k of each feature");
  fields.Tolerated("partials", extras.partials, "partial distance of each feature at the worst transition point");
  fields.Tolerated("pairs_seen", extras.pairs_seen,
                   "number of pairs of frames that the time budget allowed to compare");
  fields.Tolerated("pairs_matched", extras.pairs_matched, "number of pairs of frames that match");
  fields.ToleratedList("transition_points", extras.points, "the points at which the motion changed clips, in order");
  fields.Tolerated("cost_unit", extras.cost_unit, "unit of the candidates' `cost`; empty if the method has no costs");
  fields.ToleratedList("candidates", extras.candidates, "the pair of frames that was taken, and the best other pairs");
}

static void Describe(RecordFields& fields, DetectionExtras::Target& target) {
  fields.Required("feature", target.feature, "the name of one of paper A's ten features");
  fields.Required("degrees", target.degrees, "the wanted angle");
  fields.Required("tolerance_deg", target.tolerance_deg, "largest deviation that is accepted");
}

static void Describe(RecordFields& fields, DetectionExtras::Move& move) {
  fields.Required("name", move.name, "name of a taught move");
  fields.List("key_poses", move.key_poses, "the move's key poses in order; each key pose is a list of angles");
}

static void Describe(RecordFields& fields, DetectionExtras::Event& event) {
  fields.Required("move", event.move, "the requested move");
  fields.Required("truth", event.truth, "`right`, `grey` or `wrong`");
  fields.Required("fault", event.fault, "names of the faults, or `none`");
  fields.Required("danced", event.danced, "the move that was danced; empty if no move was danced");
  fields.Required("begin_frame", event.begin_frame, "the first frame of the performance's window");
  fields.Required("end_frame", event.end_frame, "the first frame after the performance's window");
  fields.Required("called_right", event.called_right, "whether the method judged the performance right");
  fields.Required("score", event.score, "the method's confidence that the performance was right");
  fields.Optional(
      "called_frame", event.called_frame,
      "the frame in which the method judged the performance right; absent if the method did not judge it right");
}

static void Describe(RecordFields& fields, DetectionExtras::Alarm& alarm) {
  fields.Required("move", alarm.move, "the move that was detected");
  fields.Required("frame", alarm.frame, "the frame of the detection");
}

static void Describe(RecordFields& fields, DetectionExtras& extras) {
  fields.Format("etude-detection", 1);
  fields.Optional("threshold", extras.threshold,
                  "lowest evidence at which the method judges a performance right; absent for an outside method");
  fields.List("moves", extras.moves, "the moves that may be requested");
  fields.List("events", extras.events, "the requested performances, in order of time");
  fields.List("alarms", extras.alarms, "detections of moves that nobody danced");
  fields.List("joint_states", extras.joint_states,
              "one text for each frame, with one letter for each joint: `t` tracked, `i` inferred, `n` not tracked");
}

static void Describe(RecordFields& fields, CoachExtras::Mode& mode) {
  fields.Required("mode", mode.mode, "`dance`, `correct`, …");
  fields.Required("begin_frame", mode.begin_frame,
                  "first frame of the mode; the mode lasts until the next mode begins");
}

static void Describe(RecordFields& fields, CoachExtras::Performance& performance) {
  fields.Required("move", performance.move, "the requested move");
  fields.Required("begin_frame", performance.begin_frame, "the first frame of the performance's window");
  fields.Required("end_frame", performance.end_frame, "the first frame after the performance's window");
  fields.Required("truth", performance.truth, "`right`, `grey` or `wrong`");
  fields.Required("faults", performance.faults, "names of the faults, or `none`");
  fields.Required("called", performance.called, "the coach's judgement: `right`, `wrong` or `unjudged`");
}

static void Describe(RecordFields& fields, CoachExtras::Words& words) {
  fields.Required("begin_frame", words.begin_frame,
                  "first frame in which the words are shown; they stay until the next words");
  fields.Required("say", words.say, "a short message to the learner");
  fields.Required("hint", words.hint, "what the learner should do better");
  fields.Optional("picture", words.picture,
                  "the key pose that the hint is about, as sixty numbers; absent if the hint is not about a key pose");
}

static void Describe(RecordFields& fields, CoachExtras::Decision& decision) {
  fields.Required("frame", decision.frame, "the frame of the decision");
  fields.Required("event", decision.event, "`right`, `wrong`, `corrects`, …");
  fields.Required("why", decision.why, "the reason, in words");
}

static void Describe(RecordFields& fields, CoachExtras& extras) {
  fields.Format("etude-coach", 1);
  fields.Required("song", extras.song, "the dance's title");
  fields.List("modes", extras.modes, "what the coach did from the first frame on");
  fields.List("performances", extras.performances, "the requested performances");
  fields.List("words", extras.words, "the words on the screen, with one entry for each change");
  fields.List("decisions", extras.decisions, "decisions of the coach's policy");
  fields.List("corrections", extras.corrections, "frames in which the policy decided on a correction");
  fields.List("transitions", extras.transitions,
              "for each change of clip by the coach, the last frame before the change");
  fields.List("beats_s", extras.beats_s, "times of the music's beats, in seconds from the first frame");
  fields.List("joint_states", extras.joint_states, "the same as `joint_states` of `detection`");
}

static void Describe(RecordFields& fields, PlausibilityExtras::Fault& fault) {
  fields.Required("kind", fault.kind, "`floats`, `sinks`, …");
  fields.Required("begin_frame", fault.begin_frame, "the first frame of the fault");
  fields.Required("end_frame", fault.end_frame, "the last frame of the fault");
  fields.Required("text", fault.text, "a sentence that describes the fault");
}

static void Describe(RecordFields& fields, PlausibilityExtras& extras) {
  fields.Required("floor_m", extras.floor_m, "height of the floor that was used to judge the motion");
  fields.List("faults", extras.faults, "the faults that were found, sorted by kind, then by time");
}

std::string RecordingsAsMarkdown() {
  return "# What recordings contain besides their motions\n"
         "\nWritten by `etude list recordings`; a test compares the two. A file of `recordings/` states its version\n"
         "(`recording`: 2; etude refuses version 1, which did not list the joints). It lists the `joints` in the "
         "order\n"
         "of a pose's numbers (x, y, z of each joint). It states the `unit` of these numbers and the axis that points\n"
         "`up`. Its `tracks` contain the motions of the cell by name, and its `extras` is an object that depends on "
         "the\n"
         "task. Frames are counted from the first frame of the recording, unless a key states otherwise. For "
         "`capture`\n"
         "and `evaluation`, motions have joints of their own and are not tracks; `bench/recordings` describes these "
         "two\n"
         "in `capture_extras.h` and `evaluation_extras.h`.\n"
         "\n## ik\n\nTracks: `truth`, `start` and `solution`. `solution` shows the solver's steps.\n\n" +
         RecordFields::Page<IkExtras>() +
         "\n## transition\n\nThe track `coach` is the motion from some seconds before the transition to some seconds "
         "after the judged\n"
         "frames. The track `left` is the clip that the motion leaves, in the same frames and up to 0.4 s longer. The\n"
         "track `wanted` is the wanted clip without the join; it begins at the last of `transition_frames`. The track\n"
         "`through` is a clip that is played in between, without joins; it begins at the first of "
         "`transition_frames`.\nRecordings of older runs contain only `coach`.\n\n" +
         RecordFields::Page<TransitionExtras>() +
         "\n## detection\n\nTracks: `truth`, and `sensed`, the skeletons that the recogniser received.\n\n" +
         RecordFields::Page<DetectionExtras>() +
         "\n## coach\n\nTracks: `coach`, `truth` (the learner's true motion) and `sensed`.\n\n" +
         RecordFields::Page<CoachExtras>() +
         "\n## plausibility\n\nTrack: `answer`, with the frame rate and the heights of its file.\n\n" +
         RecordFields::Page<PlausibilityExtras>();
}

template <typename Extras>
std::string WriteExtras(const Extras& extras) {
  return RecordFields::Write(extras);
}

template <typename Extras>
Result<Extras> ReadExtras(const std::string& json) {
  return RecordFields::Read<Extras>(json);
}

template std::string WriteExtras(const IkExtras&);
template Result<IkExtras> ReadExtras(const std::string&);
template std::string WriteExtras(const TransitionExtras&);
template Result<TransitionExtras> ReadExtras(const std::string&);
template std::string WriteExtras(const DetectionExtras&);
template Result<DetectionExtras> ReadExtras(const std::string&);
template std::string WriteExtras(const CoachExtras&);
template Result<CoachExtras> ReadExtras(const std::string&);
template std::string WriteExtras(const PlausibilityExtras&);
template Result<PlausibilityExtras> ReadExtras(const std::string&);

}  // namespace etude
