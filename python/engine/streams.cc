#include <etude/coaching.h>
#include <etude/recognition.h>
#include <etude/sim/dances.h>
#include <etude/sim/sensor.h>

#include <cstdint>
#include <optional>
#include <tuple>

#include "python/engine/arrays.h"

namespace etude::engine {
namespace {

/// The moves: for each move, the name and the right performances.
using Moves = std::vector<std::pair<std::string, std::vector<BodyMotion>>>;

std::vector<TaughtMove> ToTaught(const Moves& moves) {
  std::vector<TaughtMove> taught;
  for (const auto& [name, examples] : moves) {
    taught.push_back({.name = name});
    for (const BodyMotion& example : examples) taught.back().examples.push_back(StreamOf(example));
  }
  return taught;
}

Recogniser Teach(const Moves& moves, const std::string& kind, bool smooths) {
  const py::gil_scoped_release free;
  return Recogniser(ToTaught(moves), {.kind = kind, .smooths = smooths});
}

constexpr std::string_view kStates = "tin";  ///< letters in the order of TrackingState

SensedFrame ToSensed(const Array& positions_m, const std::string& states, bool body_seen) {
  const BodyPose pose = FromArray<BodyPose>("positions_m", positions_m);
  if (!states.empty() && states.size() != kRoleCount) {
    throw BadInput("states: " + std::to_string(states.size()) + " letters; allowed: 20, or none");
  }
  SensedFrame frame{.joints = {}, .body_seen = body_seen};
  for (std::size_t i = 0; i < kRoleCount; ++i) {
    const std::size_t place = states.empty() ? 0 : kStates.find(states[i]);
    if (place == std::string_view::npos) throw BadInput("states: letters are t, i, n");
    frame.joints[i] = {pose.joints[i], static_cast<TrackingState>(place)};
  }
  return frame;
}

py::tuple UpdateStream(RecogniserStream& stream, const Array& positions_m, const std::string& states, bool body_seen) {
  const SensedFrame frame = ToSensed(positions_m, states, body_seen);
  const Evidence evidence = Unlocked([&] { return stream.Update(frame); });
  return py::make_tuple(evidence.asked,
                        Array(static_cast<py::ssize_t>(evidence.spotted.size()), evidence.spotted.data()));
}

Dance MakeDance(std::string title, BodyMotion motion,
                const std::vector<std::tuple<std::string, std::string, Array, BodyMotion>>& moves,
                const std::vector<std::tuple<int, std::size_t, std::size_t>>& repetitions,
                const std::vector<std::pair<std::size_t, double>>& tags,
                const std::vector<std::tuple<std::string, BodyMotion, bool>>& acts) {
  Dance dance{.title = std::move(title), .motion = std::move(motion)};
  for (const auto& [name, hint, key_pose, slow] : moves) {
    dance.moves.push_back({name, hint, FromArray<BodyPose>("key_pose", key_pose), slow});
  }
  for (const auto& [move, first, end] : repetitions) dance.repetitions.push_back({move, first, end});
  for (const auto& [frame, music_s] : tags) dance.tags.push_back({frame, music_s});
  for (const auto& [name, shown, loops] : acts) dance.acts.push_back({name, shown, loops});
  return dance;
}

Coach MakeCoach(const Dance& dance, const Moves& moves, const std::string& policy, const std::string& recogniser,
                bool dances_at_once, bool mirrors, bool smooths, std::optional<double> right_from,
                const std::string& choice, const std::string& join) {
  const CoachOptions options{.policy = policy,
                             .choice = choice,
                             .join = join,
                             .recogniser = recogniser,
                             .smooths = smooths,
                             .mirrors = mirrors,
                             .dances_at_once = dances_at_once,
                             .right_from = right_from};
  const py::gil_scoped_release free;
  return Coach(dance, ToTaught(moves), options);
}

CoachOutput StepCoach(Coach& coach, const Array& positions_m, const std::string& states, bool body_seen,
                      std::optional<double> music_s) {
  const SensedFrame frame = ToSensed(positions_m, states, body_seen);
  const py::gil_scoped_release free;
  return coach.Step(frame, music_s);
}

py::tuple SenseAll(const BodyMotion& motion, const std::string& sensor, double strength, double distance_m,
                   double turn_rad, double height_m, std::uint64_t seed) {
  const SkeletonStream sensed = Unlocked([&] {
    return sim::SenseSkeleton(motion, {.sensor = sensor,
                                       .strength = strength,
                                       .distance_m = distance_m,
                                       .turn = turn_rad,
                                       .height_m = height_m,
                                       .seed = seed});
  });
  py::array_t<bool> body_seen(static_cast<py::ssize_t>(sensed.frames.size()));
  std::vector<std::string> states;
  for (const SensedFrame& frame : sensed.frames) {
    body_seen.mutable_data()[states.size()] = frame.body_seen;
    std::string& letters = states.emplace_back();
    for (const SensedJoint& joint : frame.joints) letters += kStates[static_cast<std::size_t>(joint.state)];
  }
  return py::make_tuple(ToArrays(MotionOf(sensed).poses), states, body_seen);
}

py::tuple BuiltinDance(const std::string& song) {
  const sim::BuiltinDance found = Unlocked([&] { return sim::DanceOfSong(song); });
  Moves moves;
  for (const TaughtMove& move : found.moves) moves.push_back({move.name, {MotionOf(move.examples.front())}});
  return py::make_tuple(found.dance, moves);
}

py::tuple ToTuple(const DanceMove& move) {
  return py::make_tuple(move.name, move.hint, ToArray(move.key_pose), move.slow);
}
py::tuple ToTuple(const Repetition& one) { return py::make_tuple(one.move, one.first, one.end); }
py::tuple ToTuple(const MusicTag& tag) { return py::make_tuple(tag.frame, tag.music_s); }
py::tuple ToTuple(const CoachAct& act) { return py::make_tuple(act.name, act.motion, act.loops); }

/// Makes a getter for Python: a function that returns the parts of a dance as tuples.
template <typename Part>
auto TuplesOf(std::vector<Part> Dance::*parts) {
  return [parts](const Dance& dance) {
    py::list list;
    for (const Part& part : dance.*parts) list.append(ToTuple(part));
    return list;
  };
}

void AddRecogniser(py::module_& module) {
  py::class_<Recogniser>(module, "Recogniser", "A recogniser that was taught moves.")
      .def(py::init(&Teach), "moves"_a, "kind"_a = RecogniserOptions{}.kind, "smooths"_a = true,
           "moves: (name, [Motion, ...]) of each, its right performances. kind: 'whole-body', 'dtw', 'nearest'. "
           "smooths: streams go through Kinect's own filter first. Raises BadInput for no moves, two of one name and "
           "moves without examples.")
      .def("follow", &Recogniser::Follow, "rate_hz"_a = 30.0, "Starts a stream to follow, frame by frame.");
  py::class_<RecogniserStream>(module, "RecogniserStream", "One stream that a recogniser follows.")
      .def("ask", &RecogniserStream::Ask, "move"_a,
           "Asks for a move, by its number, from the next frame on; None: asks for no move.")
      .def("update", &UpdateStream, "positions_m"_a, "states"_a = "", "body_seen"_a = true,
           "Takes the next frame (20 x 3 metres, in the order of ROLES; states: a letter a joint, t tracked, i "
           "inferred, n not tracked; '': all tracked) and gives (asked, spotted): how right the move asked for is so "
           "far, and for every move how much this looks like its end, all 0 to 1.");
}

void AddCoach(py::module_& module) {
  module.attr("COACH_ACTS") = py::tuple(py::cast(RequiredActs()));
  module.attr("COACH_POLICIES") = py::tuple(py::cast(CoachPolicies()));
  module.attr("SONGS") = py::tuple(py::cast(sim::SongNames()));
  py::class_<Dance>(module, "Dance", "All that a coach shows, danced by one body that faces +Z, at 30 Hz.")
      .def(py::init(&MakeDance), "title"_a, "motion"_a, "moves"_a, "repetitions"_a, "tags"_a, "acts"_a,
           "motion: of the whole song. moves: (name, hint in words, key pose of 20 x 3 metres, Motion of the slow "
           "demonstration) of each. repetitions: (move, first frame, end) of each, in order. tags: (frame, seconds of "
           "the music), ascending. acts: (name, Motion, whether it loops) of COACH_ACTS. A Coach checks it.")
      .def_readonly("title", &Dance::title)
      .def_readonly("motion", &Dance::motion)
      .def_property_readonly("moves", TuplesOf(&Dance::moves))
      .def_property_readonly("repetitions", TuplesOf(&Dance::repetitions))
      .def_property_readonly("tags", TuplesOf(&Dance::tags))
      .def_property_readonly("acts", TuplesOf(&Dance::acts));
  module.def("builtin_dance", &BuiltinDance, "song"_a,
             "(Dance, moves) of a song that comes with Etude, one of SONGS; moves: as a Recogniser or Coach is taught "
             "them. Raises BadInput for another name.");
  py::class_<CoachRecord>(module, "CoachDecision", "A decision of the coach, explained.")
      .def_property_readonly(
          "event", [](const CoachRecord& record) { return EventName(record.event); },
          "'woken', 'song begins', 'right', 'wrong', 'corrects', 'shows', …")
      .def_readonly("frame", &CoachRecord::frame, "The frame, counted from the session's beginning.")
      .def_property_readonly(
          "move", [](const CoachRecord& record) { return record.move < 0 ? std::nullopt : std::optional(record.move); },
          "The move's number in the dance; None if the decision is about no move.")
      .def_property_readonly(
          "mistake",
          [](const CoachRecord& record) { return record.mistake == Mistake::kNone ? "" : MistakeName(record.mistake); },
          "The mistake; '' if the decision is about none.")
      .def_readonly("evidence", &CoachRecord::evidence, "The evidence, 0 to 1, for 'right' and 'wrong'.")
      .def_readonly("why", &CoachRecord::why, "One sentence with numbers.");
  py::class_<CoachOutput>(module, "CoachFrame", "What the coach shows in one frame.")
      .def_property_readonly(
          "mode", [](const CoachOutput& output) { return ModeName(output.mode); },
          "'standby', 'attract', 'doze', 'wake', 'dance', 'correct', 'demonstrate', 'praise'")
      .def_property_readonly("positions_m", ArrayOf(&CoachOutput::body), "The coach: 20 x 3, metres.")
      .def_readonly("clip", &CoachOutput::clip, "The clip that it plays; in a transition, the next clip.")
      .def_readonly("clip_frame", &CoachOutput::clip_frame)
      .def_readonly("in_transition", &CoachOutput::in_transition)
      .def_property_readonly(
          "asked",
          [](const CoachOutput& output) { return output.open ? std::optional(output.open->move) : std::nullopt; },
          "The move that the player is asked for from the next frame on, or None.")
      .def_readonly("say", &CoachOutput::say, "A line for the player, or ''.")
      .def_readonly("hint", &CoachOutput::hint, "The key pose in words, or ''.")
      .def_property_readonly(
          "stand", [](const CoachOutput& output) { return HintText(output.stand); },
          "'come into view', 'come nearer', 'step back' or ''.")
      .def_property_readonly(
          "play_from_s",
          [](const CoachOutput& output) {
            const bool begins = output.music.kind == MusicCommand::Kind::kPlayFrom;
            return begins ? std::optional(output.music.music_s) : std::nullopt;
          },
          "Music that begins now, seconds into the song, or None.")
      .def_property_readonly("pause_music",
                             [](const CoachOutput& output) { return output.music.kind == MusicCommand::Kind::kPause; })
      .def_readonly("decisions", &CoachOutput::records, "CoachDecisions of this frame, in order.");
  py::class_<Coach>(module, "Coach", "Paper A's coach: watches a player, shows a dance, corrects, and says why.")
      .def(py::init(&MakeCoach), "dance"_a, "moves"_a, "policy"_a = CoachOptions{}.policy,
           "recogniser"_a = CoachOptions{}.recogniser, "dances_at_once"_a = false, "mirrors"_a = false,
           "smooths"_a = false, "right_from"_a = py::none(), "choice"_a = CoachOptions{}.choice,
           "join"_a = CoachOptions{}.join,
           "moves: (name, [Motion, ...]) of each move of the dance, in its order. policy: of COACH_POLICIES. "
           "recogniser: 'whole-body', 'dtw', 'nearest'. dances_at_once: without a clap. mirrors: players dance as in a "
           "mirror. smooths: the stream goes through Kinect's own filter first. right_from: from which evidence on a "
           "performance is right, in (0, 1]; None: the recogniser's. choice, join: of TRANSITION_CHOICES and "
           "TRANSITION_JOINS. Raises BadInput for a dance that is invalid, and for unknown names.")
      .def("step", &StepCoach, "positions_m"_a, "states"_a = "", "body_seen"_a = true, "music_s"_a = py::none(),
           py::keep_alive<0, 1>(),  // the returned texts refer to the dance
           "Takes the sensor's next frame, at 30 Hz (as RecogniserStream.update does), and gives the CoachFrame to "
           "show. music_s: what is heard now, seconds into the song. Raises BadInput for another shape, invalid "
           "letters, and "
           "what is not finite.");
}

}  // namespace

void AddStreams(py::module_& module) {
  AddRecogniser(module);
  AddCoach(module);
  module.def(
      "sense", &SenseAll, "motion"_a, "sensor"_a = sim::SensorOptions{}.sensor, "strength"_a = 1.0,
      "distance_m"_a = sim::SensorOptions{}.distance_m, "turn_rad"_a = 0.0, "height_m"_a = 1.0, "seed"_a = 1,
      "What a skeleton sensor would report of a motion: (frames x 20 x 3 metres in the world, per frame a letter "
      "a joint as RecogniserStream.update takes them, per frame whether it saw a body). sensor: 'v1', 'v2' or "
      "the text of a sensor file (docs/sensor.md). strength: a factor on all errors, 0 to 10. distance_m: along the "
      "floor from the middle of where the body moves, 0.5 to 10; turn_rad: about that middle, 0 on its +Z side; "
      "height_m: 0.1 to 3. The same seed errs the same. Raises BadInput for values out of range.");
}

}  // namespace etude::engine
