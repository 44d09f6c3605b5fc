#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/fuzzy/distance.h"
#include "engine/motion/body.h"

namespace etude {

// This header declares, for each task, the contents of a cell's recording apart from its tracks
// (`Recording::extras_json`); for task `capture` see CaptureExtras. The keys and their meanings are in task_extras.cc,
// where one declaration serves for writing, reading and documenting. Frames count from the recording's first frame,
// unless stated otherwise.

/// The extras of task `ik`. The tracks are "truth", "start" and "solution". Each list has one entry per frame of
/// "solution", but `targets_m` has one entry per end effector.
struct IkExtras {
  std::vector<int> iterations;
  std::vector<double> position_error_max_cm, orientation_error_max_deg;
  std::vector<double> axis_error_max_deg;  ///< the error of the worst single axis, by which "solved" is judged
  std::vector<std::optional<glm::dvec3>> targets_m;
};

/// The extras of task `transition`: one transition, with some seconds before and after it. The tracks are "coach",
/// "left" and "wanted" (docs/reference/recordings.md). The metrics of the transition can be computed from these data.
struct TransitionExtras {
  /// A transition point: a pair of frames at which the motion changed clips. Frame numbers are those of the clips.
  struct Point {
    std::string from, to;  ///< names of the clips; "in-between" for the method's own frames
    std::optional<int> from_frame = {}, to_frame = {};
    std::optional<double> distance = {};
    /// The term S_k Δ_k² of each feature k; the sum of the terms is the squared distance.
    std::optional<PerFeature> partials = {};
  };
  /// A pair of frames that was considered as a transition point. Frame numbers are those of the clips.
  struct Candidate {
    std::optional<int> point;  ///< index of the transition point for which the pair was considered
    int from_frame = 0, to_frame = 0;
    double distance = 0;
    std::optional<PerFeature> partials;
    /// The cost by which the candidates are ranked; nullopt if they are ranked by distance.
    std::optional<double> cost;
    std::string outcome;  ///< the pair's outcome: "taken", "too far", "later", "worse"

    bool operator==(const Candidate&) const = default;
  };

  std::optional<int> transition_frame;  ///< the first entry of `transition_frames`
  std::vector<int> transition_frames;   ///< the last frame of each clip before the next clip begins
  std::string from, to;                 ///< the playing clip and the wanted clip
  std::string branch;                   ///< the kind of transition, e.g. "front half", "in-between"
  std::string why;                      ///< a sentence that says why this transition was chosen
  std::optional<int> request_frame;     ///< frame of the request; negative = before the start of the recording
  std::optional<double> wait_s, threshold, natural_limit_cm;
  /// The largest distance of any transition point; `partials` has the terms of this distance's square.
  std::optional<double> distance;
  std::optional<PerFeature> weights, partials;
  std::optional<std::int64_t> pairs_seen, pairs_matched;
  std::vector<Point> points;
  std::string cost_unit;
  std::vector<Candidate> candidates;
};

/// The extras of task `detection`: a session in front of the sensor. The tracks are "truth" and "sensed"; "sensed" is
/// the motion that the recogniser received.
struct DetectionExtras {
  /// The angle that a key pose prescribes for one feature, and its tolerance.
  struct Target {
    std::string feature;
    double degrees = 0, tolerance_deg = 0;
  };
  struct Move {
    std::string name;
    std::vector<std::vector<Target>> key_poses;
  };
  /// A performance that the learner was asked to give.
  struct Event {
    std::string move, truth, fault;  ///< truth: right, grey or wrong; fault: "none", or the names of faults
    std::string danced;              ///< the move that was performed; "" if none was
    int begin_frame = 0, end_frame = 0;
    bool called_right = false;
    double score = 0;
    std::optional<int> called_frame = {};
  };
  struct Alarm {
    std::string move;
    int frame = 0;
  };

  std::optional<double> threshold;  ///< threshold on the score for the verdict "right"; nullopt for an outside method
  std::vector<Move> moves;
  std::vector<Event> events;
  std::vector<Alarm> alarms;
  /// Tracking state of the joints: one text per frame, one letter per joint (StateLetters).
  std::vector<std::string> joint_states;
};

/// The extras of task `coach`: a session with a learner. The tracks are "coach", "truth" (the learner's real motion)
/// and "sensed".
struct CoachExtras {
  /// A mode of the session, which lasts until the frame of the next mode.
  struct Mode {
    std::string mode;
    int begin_frame = 0;
  };
  /// A performance that the learner was asked to give.
  struct Performance {
    std::string move, truth, called;  ///< truth: right, grey, wrong; called: right, wrong, unjudged
    int begin_frame = 0, end_frame = 0;
    std::string faults;
  };
  /// A text on the screen. It is shown from its frame until the next text.
  struct Words {
    int begin_frame = 0;
    std::string say = {}, hint = {};
    std::optional<BodyPose> picture = {};  ///< the key pose that the text explains; nullopt if there is none
  };
  /// A decision of the coach.
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
  std::vector<double> beats_s;  ///< times of the music's beats, ascending
  std::vector<std::string> joint_states;
};

/// The extras of task `plausibility`: the faults of the motion in the track "answer". The track keeps the frame rate of
/// the judged file and the joints' heights in this file (Y, metres).
struct PlausibilityExtras {
  struct Fault {
    std::string kind, text;              ///< name of the fault (FaultName), and its description (MotionFault::text)
    int begin_frame = 0, end_frame = 0;  ///< first and last frame, both inclusive
  };
  double floor_m = 0;
  std::vector<Fault> faults;
};

/// Returns the extras of a task as JSON text. `Extras` is one of the types above.
template <typename Extras>
std::string WriteExtras(const Extras& extras);
/// Reads the text that WriteExtras returns. Fails if the text is not a JSON object, or if a key is missing or has a
/// value of another type; the error names the key. In IkExtras and TransitionExtras, such a member stays empty instead,
/// because recordings of older runs and of outside methods have fewer keys.
template <typename Extras>
Result<Extras> ReadExtras(const std::string& json);

/// Returns the page docs/reference/recordings.md, which lists the keys of all formats, in Markdown.
std::string RecordingsAsMarkdown();

}  // namespace etude
