#include "bench/recordings/task_extras.h"

#include "bench/recordings/record_fields.h"

namespace etude {

// RecordFields finds these functions by argument-dependent lookup, so they are not in an unnamed namespace. The
// function that describes a nested part is declared before the function that describes its record.

static void Describe(RecordFields& fields, IkExtras& extras) {
  fields.Tolerated("iterations", extras.iterations, "the iteration that each frame shows, from 0, never decreasing");
  fields.Tolerated("position_error_max_cm", extras.position_error_max_cm, "per frame, of the worst end effector");
  fields.Tolerated("orientation_error_max_deg", extras.orientation_error_max_deg,
                   "per frame, of the worst end effector: the mean error of its axes");
  fields.Tolerated("axis_error_max_deg", extras.axis_error_max_deg, "per frame, of the worst single axis");
  fields.Tolerated("targets_m", extras.targets_m,
                   "[x, y, z] of each end effector's target, in the tree's order; null without a target position");
}

static void Describe(RecordFields& fields, TransitionExtras::Point& point) {
  fields.Tolerated("from", point.from, "the clip that is left; `in-between`: frames that the method made");
  fields.Tolerated("from_frame", point.from_frame, "the last frame of that clip that is shown");
  fields.Tolerated("to", point.to, "the clip that is entered");
  fields.Tolerated("to_frame", point.to_frame, "the frame of that clip that is aligned with `from_frame`");
  fields.Tolerated("distance", point.distance, "fuzzy distance between the two frames");
  fields.Tolerated("partials", point.partials, "for each feature, S_k Δ_k²; their sum is the square of the distance");
}

static void Describe(RecordFields& fields, TransitionExtras::Candidate& candidate) {
  fields.Tolerated("point", candidate.point, "index of its transition point, from 0");
  fields.Required("from_frame", candidate.from_frame, "the frame at which the clip is left at that point");
  fields.Required("to_frame", candidate.to_frame, "frame of the clip that is entered there");
  fields.Required("distance", candidate.distance, "fuzzy distance between the two frames");
  fields.Tolerated("partials", candidate.partials, "by feature, as the `partials` of a transition point");
  fields.Tolerated("cost", candidate.cost,
                   "the cost by which the method ranks candidates; null if it ranks them by distance");
  fields.Tolerated("outcome", candidate.outcome, "`taken`, `too far`, `later` or `worse`");
}

static void Describe(RecordFields& fields, TransitionExtras& extras) {
  fields.Tolerated("transition_frame", extras.transition_frame, "the first of `transition_frames`");
  fields.ToleratedList("transition_frames", extras.transition_frames,
                       "the last frames of the recording before each change of clip");
  fields.Tolerated("from", extras.from, "the clip that is left");
  fields.Tolerated("to", extras.to, "the wanted clip");
  fields.Tolerated("branch", extras.branch, "how the transition was made: `front half`, `in-between`, …");
  fields.Tolerated("why", extras.why, "why it was made in this way, one sentence");
  fields.Tolerated("request_frame", extras.request_frame,
                   "frame of the request; negative if it is before the recording");
  fields.Tolerated("wait_s", extras.wait_s, "from the request until the wanted clip plays");
  fields.Tolerated("threshold", extras.threshold, "the threshold: frames match if their distance is below it");
  fields.Tolerated("natural_limit_cm", extras.natural_limit_cm, "the largest jump that counts as natural");
  fields.Tolerated("distance", extras.distance, "distance of the worst transition point");
  fields.Tolerated("weights", extras.weights, "for each feature, its weight S_k");
  fields.Tolerated("partials", extras.partials, "partial distances of the worst transition point, by feature");
  fields.Tolerated("pairs_seen", extras.pairs_seen, "pairs of frames that the budget allowed");
  fields.Tolerated("pairs_matched", extras.pairs_matched, "pairs of frames that match");
  fields.ToleratedList("transition_points", extras.points, "where the motion changed clips, in order");
  fields.Tolerated("cost_unit", extras.cost_unit, "unit of the candidates' `cost`; empty without costs");
  fields.ToleratedList("candidates", extras.candidates, "pairs of frames: the pair taken, and the best others");
}

static void Describe(RecordFields& fields, DetectionExtras::Target& target) {
  fields.Required("feature", target.feature, "one of paper A's ten");
  fields.Required("degrees", target.degrees, "the wanted angle");
  fields.Required("tolerance_deg", target.tolerance_deg, "largest deviation that is accepted");
}

static void Describe(RecordFields& fields, DetectionExtras::Move& move) {
  fields.Required("name", move.name, "name of a taught move");
  fields.List("key_poses", move.key_poses, "its key poses in order, each a list of angles");
}

static void Describe(RecordFields& fields, DetectionExtras::Event& event) {
  fields.Required("move", event.move, "the move asked for");
  fields.Required("truth", event.truth, "`right`, `grey` or `wrong`");
  fields.Required("fault", event.fault, "names of the faults, or `none`");
  fields.Required("danced", event.danced, "the move danced; empty if none");
  fields.Required("begin_frame", event.begin_frame, "the first frame of its window");
  fields.Required("end_frame", event.end_frame, "the first frame after its window");
  fields.Required("called_right", event.called_right, "whether the method judged it right");
  fields.Required("score", event.score, "the method's confidence that it was right");
  fields.Optional("called_frame", event.called_frame,
                  "the frame in which the method judged it right; absent if it did not");
}

static void Describe(RecordFields& fields, DetectionExtras::Alarm& alarm) {
  fields.Required("move", alarm.move, "the move that was detected");
  fields.Required("frame", alarm.frame, "the frame of the detection");
}

static void Describe(RecordFields& fields, DetectionExtras& extras) {
  fields.Format("etude-detection", 1);
  fields.Optional("threshold", extras.threshold,
                  "evidence from which the method judges a performance right; absent for an outside method");
  fields.List("moves", extras.moves, "the moves that may be asked for");
  fields.List("events", extras.events, "the performances asked for, in order of time");
  fields.List("alarms", extras.alarms, "detections of moves that nobody danced");
  fields.List("joint_states", extras.joint_states,
              "one text a frame, one letter a joint: `t` tracked, `i` inferred, `n` not tracked");
}

static void Describe(RecordFields& fields, CoachExtras::Mode& mode) {
  fields.Required("mode", mode.mode, "`dance`, `correct`, …");
  fields.Required("begin_frame", mode.begin_frame, "first frame of the mode, which lasts until the next mode begins");
}

static void Describe(RecordFields& fields, CoachExtras::Performance& performance) {
  fields.Required("move", performance.move, "the move asked for");
  fields.Required("begin_frame", performance.begin_frame, "the first frame of its window");
  fields.Required("end_frame", performance.end_frame, "the first frame after its window");
  fields.Required("truth", performance.truth, "`right`, `grey` or `wrong`");
  fields.Required("faults", performance.faults, "names of the faults, or `none`");
  fields.Required("called", performance.called, "the coach's judgement: `right`, `wrong` or `unjudged`");
}

static void Describe(RecordFields& fields, CoachExtras::Words& words) {
  fields.Required("begin_frame", words.begin_frame, "first frame of these words; they stay until the next words");
  fields.Required("say", words.say, "a short word to the learner");
  fields.Required("hint", words.hint, "what to do better");
  fields.Optional("picture", words.picture,
                  "the key pose that the hint is about, sixty numbers; absent if the hint is about none");
}

static void Describe(RecordFields& fields, CoachExtras::Decision& decision) {
  fields.Required("frame", decision.frame, "the frame of the decision");
  fields.Required("event", decision.event, "`right`, `wrong`, `corrects`, …");
  fields.Required("why", decision.why, "in words");
}

static void Describe(RecordFields& fields, CoachExtras& extras) {
  fields.Format("etude-coach", 1);
  fields.Required("song", extras.song, "the dance's title");
  fields.List("modes", extras.modes, "what the coach did, from the first frame on");
  fields.List("performances", extras.performances, "the performances that were asked for");
  fields.List("words", extras.words, "the words on the screen, each time that they change");
  fields.List("decisions", extras.decisions, "decisions of the coach's policy");
  fields.List("corrections", extras.corrections, "frames in which the policy decided on a correction");
  fields.List("transitions", extras.transitions, "the last frames before the coach changes clips");
  fields.List("beats_s", extras.beats_s, "when the music's beats sounded, seconds since the first frame");
  fields.List("joint_states", extras.joint_states, "as in `detection`");
}

static void Describe(RecordFields& fields, PlausibilityExtras::Fault& fault) {
  fields.Required("kind", fault.kind, "`floats`, `sinks`, …");
  fields.Required("begin_frame", fault.begin_frame, "its first frame");
  fields.Required("end_frame", fault.end_frame, "its last frame");
  fields.Required("text", fault.text, "a sentence");
}

static void Describe(RecordFields& fields, PlausibilityExtras& extras) {
  fields.Required("floor_m", extras.floor_m, "height of the floor that the motion was judged by");
  fields.List("faults", extras.faults, "the faults found, in order of kind, then of time");
}

std::string RecordingsAsMarkdown() {
  return "# What recordings contain besides their motions\n\n"
         "Written by `etude list recordings`; a test compares the two. A file of `recordings/` names its version\n"
         "(`recording`: 2; version 1 named no joints and is refused), the `joints` in the order of a pose's numbers\n"
         "(x, y, z of each), their `unit` and the axis that points `up`. Its `tracks` contain the cell's motions by\n"
         "name, its `extras` an object of the task. Frames count from the first of the recording unless said\n"
         "otherwise. `bench/recordings` has the extras of `capture` and of `evaluation`, whose motions are no tracks\n"
         "but have joints of their own (`capture_extras.h`, `evaluation_extras.h`).\n\n"
         "## ik\n\nTracks `truth`, `start` and, step by step, `solution`.\n\n" +
         RecordFields::Page<IkExtras>() +
         "\n## transition\n\n"
         "Tracks: `coach`, from some seconds before the transition to some seconds after the judged frames; `left`,\n"
         "the clip that is left, in the same frames and up to 0.4 s longer; `wanted`, the wanted clip without the\n"
         "join, from the last of `transition_frames` on; `through`, a clip that is played in between, without\n"
         "joins, from the first of them on. Recordings of older runs contain only `coach`.\n\n" +
         RecordFields::Page<TransitionExtras>() +
         "\n## detection\n\nTracks `truth` and `sensed`, as the recogniser saw it.\n\n" +
         RecordFields::Page<DetectionExtras>() +
         "\n## coach\n\nTracks `coach`, `truth` (the learner as danced) and `sensed`.\n\n" +
         RecordFields::Page<CoachExtras>() +
         "\n## plausibility\n\nTrack `answer`, at its file's rate and heights.\n\n" +
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
