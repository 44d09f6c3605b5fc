#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/fuzzy/distance.h"
#include "engine/motion/body.h"

namespace etude {

// What the recording of a cell holds beside its tracks (`Recording::extras_json`), task by task; that of `capture` is
// CaptureExtras. The keys and what they mean stand in task_extras.cc, once for whoever writes, reads or documents them.
// Frames count from the first of the recording unless said otherwise.

/// The extras of task `ik`. Tracks "truth", "start" and, step by step, "solution"; the lists have
/// one entry a frame of these.
struct IkExtras {
  std::vector<int> iterations;
  std::vector<double> position_error_max_cm, orientation_error_max_deg;
  std::vector<double> axis_error_max_deg;  ///< of the worst single axis, which "solved" is judged by
  std::vector<std::optional<glm::dvec3>> targets_m;
};
std::string WriteIkExtras(const IkExtras& extras);
/// Leaves empty whatever is missing or of another kind. Fails when the text is no JSON object.
Result<IkExtras> ReadIkExtras(const std::string& json);

/// The extras of task `transition`: a transition that has a way, some seconds before and after it. Tracks "coach",
/// "left" and "wanted" (docs/reference/recordings.md): what measures of the join look at.
struct TransitionExtras {
  /// A transition point: two frames, at which the motion changed clips. Frames count in their clips.
  struct Point {
    std::string from, to;  ///< clips; "in-between" for frames of the method's own
    std::optional<int> from_frame = {}, to_frame = {};
    std::optional<double> distance = {};
    std::optional<PerFeature> partials = {};  ///< S_k Δ_k², which sum to distance²
  };
  /// A pair of frames that was looked at on the way. Frames count in their clips.
  struct Candidate {
    std::optional<int> point;  ///< for which of the transition points it was looked at
    int from_frame = 0, to_frame = 0;
    double distance = 0;
    std::optional<PerFeature> partials;
    std::optional<double> cost;  ///< what the choice ranks by, where that is not the distance
    std::string outcome;         ///< "taken", "too far", "later", "worse"

    bool operator==(const Candidate&) const = default;
  };

  std::optional<int> transition_frame;  ///< the first of `transition_frames`
  std::vector<int> transition_frames;   ///< the last ones before a change
  std::string from, to;                 ///< clips
  std::string branch;                   ///< which way was taken: "front half", "in-between", …
  std::string why;                      ///< one sentence
  std::optional<int> request_frame;     ///< negative: before the recording begins
  std::optional<double> wait_s, threshold, natural_limit_cm;
  std::optional<double> distance;  ///< with `partials`: of the worst transition point
  std::optional<PerFeature> weights, partials;
  std::optional<std::int64_t> pairs_seen, pairs_matched;
  std::vector<Point> points;
  std::string cost_unit;
  std::vector<Candidate> candidates;
};
std::string WriteTransitionExtras(const TransitionExtras& extras);
/// Leaves empty whatever is missing or of another kind: recordings of older runs, and of methods outside, tell less.
/// Fails when the text is no JSON object.
Result<TransitionExtras> ReadTransitionExtras(const std::string& json);

/// The extras of task `detection`: a session before the sensor. Tracks "truth" and "sensed", as the recogniser saw it.
struct DetectionExtras {
  /// An angle of a key pose.
  struct Target {
    std::string feature;
    double degrees = 0, tolerance_deg = 0;
  };
  struct Move {
    std::string name;
    std::vector<std::vector<Target>> key_poses;
  };
  /// A performance that was asked for.
  struct Event {
    std::string move, truth, fault;  ///< truth: right, grey, wrong; fault: "none", or names
    std::string danced;              ///< empty: no move
    int begin_frame = 0, end_frame = 0;
    bool called_right = false;
    double score = 0;
    std::optional<int> called_frame = {};
  };
  struct Alarm {
    std::string move;
    int frame = 0;
  };

  std::optional<double> threshold;  ///< of judging; absent for an answer from outside
  std::vector<Move> moves;
  std::vector<Event> events;
  std::vector<Alarm> alarms;
  std::vector<std::string> joint_states;  ///< a letter a joint, one text a frame (StateLetters)
};
std::string WriteDetectionExtras(const DetectionExtras& extras);
/// Fails, naming the key, when a key is missing or of another kind.
Result<DetectionExtras> ReadDetectionExtras(const std::string& json);

/// The extras of task `coach`: a session with a learner. Tracks "coach", "truth" (the learner as danced) and "sensed".
struct CoachExtras {
  /// A stretch of frames in one mode, up to the next.
  struct Mode {
    std::string mode;
    int begin_frame = 0;
  };
  /// A performance that was asked for.
  struct Performance {
    std::string move, truth, called;  ///< truth: right, grey, wrong; called: right, wrong, unjudged
    int begin_frame = 0, end_frame = 0;
    std::string faults;
  };
  /// The text on the screen, up to the next.
  struct Words {
    int begin_frame = 0;
    std::string say = {}, hint = {};
    std::optional<BodyPose> picture = {};  ///< the key pose that the hint is about
  };
  /// Something that the coach decided.
  struct Decision {
    int frame = 0;
    std::string event, why;
  };

  std::string song;
  std::vector<Mode> modes;
  std::vector<Performance> performances;
  std::vector<Words> words;
  std::vector<Decision> decisions;
  std::vector<int> corrections, transitions;
  std::vector<double> beats_s;  ///< when the music's beats sounded, ascending
  std::vector<std::string> joint_states;
};
std::string WriteCoachExtras(const CoachExtras& extras);
/// Fails, naming the key, when a key is missing or of another kind.
Result<CoachExtras> ReadCoachExtras(const std::string& json);

/// The page docs/reference/recordings.md: the keys of all of them, in Markdown.
std::string RecordingsAsMarkdown();

}  // namespace etude
