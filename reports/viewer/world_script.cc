#include "reports/viewer/world_script.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "bench/recordings/evaluation_extras.h"
#include "bench/recordings/task_extras.h"
#include "engine/base/base64.h"
#include "engine/motion/support.h"
#include "io/drawing/escape.h"
#include "io/files/json.h"
#include "reports/transitions/recorded_requests.h"
#include "reports/words/judged.h"

namespace etude {
namespace {

/// A track of a recording as the viewer shows it, and the tracks from which its error is measured.
struct TrackLook {
  std::string_view task, track;
  std::string_view label;  ///< label of the track; "" = the method's name
  std::string_view kind;   ///< "shown", "ghost" (the reference of errors) or "partner" (the coach beside the dancer)
  std::vector<std::string_view> against = {};
  bool has_contacts = false;
};

const std::vector<TrackLook>& Looks() {
  static const std::vector<TrackLook> looks = {
      {"ik", "truth", "truth", "ghost"},
      {"ik", "start", "start", "ghost"},
      {"ik", "solution", "", "shown", {"truth"}},
      {"transition", "coach", "", "shown", {"left", "wanted"}, true},
      {"transition", "left", "old clip", "ghost"},
      {"transition", "wanted", "wanted clip", "ghost"},
      {"capture", "truth", "truth", "ghost", {}, true},
      {"capture", "recovered", "", "shown", {"truth"}},
      {"detection", "truth", "performer", "ghost", {}, true},
      {"detection", "sensed", "as sensed", "shown", {"truth"}},
      {"coach", "coach", "coach", "partner"},
      {"coach", "truth", "learner", "ghost", {}, true},
      {"coach", "sensed", "learner as sensed", "shown", {"truth"}},
      {"evaluation", "truth", "truth", "ghost"},
      {"evaluation", "answer", "", "shown", {"truth"}},
      {"plausibility", "answer", "", "shown", {}, true},
  };
  return looks;
}

TrackLook LookOf(const std::string& task, const std::string& track) {
  const auto found =
      std::ranges::find_if(Looks(), [&](const TrackLook& look) { return look.task == task && look.track == track; });
  return found == Looks().end() ? TrackLook{task, track, track, "shown"} : *found;
}

/// Returns, for a task, the meaning of a joint's distance from its reference, and the unit of this distance, which is
/// the unit of the headline metric.
std::pair<std::string_view, std::string_view> ErrorOf(const std::string& task) {
  if (task == "capture" || task == "evaluation") return {"distance from the true joint", "mm"};
  if (task == "ik") return {"distance from the true joint", "cm"};
  if (task == "transition") return {"distance from the clip that plays", "cm"};
  return {"error of the sensor", "cm"};
}

/// A named motion of arbitrary joints; `points` has the positions of all joints in the first frame, then the positions
/// in the next frame.
struct TrackPoints {
  std::string track;
  std::size_t joints = kRoleCount;
  std::vector<glm::dvec3> points;

  std::size_t FrameCount() const { return points.size() / joints; }
  /// While the last frame equals the frame before it, drops the last frame, because the viewer holds the last frame
  /// anyway.
  void CutWhereItRests() {
    const auto frame = static_cast<std::ptrdiff_t>(joints);
    while (points.size() > joints && std::equal(points.end() - frame, points.end(), points.end() - 2 * frame)) {
      points.resize(points.size() - joints);
    }
  }
};

TrackPoints PointsOf(const Track& track) {
  TrackPoints motion{.track = track.name, .points = {}};
  for (const BodyPose& pose : track.motion.poses) {
    motion.points.insert(motion.points.end(), pose.joints.begin(), pose.joints.end());
  }
  return motion;
}

Json ContactsOf(const BodyMotion& motion) {
  Json runs = Json::array();
  const FootContacts contacts = FindFootContacts(motion.poses, motion.rate_hz);
  for (std::size_t side = 0; side < contacts.size(); ++side) {
    const std::vector<bool>& stands = contacts[side];
    for (std::size_t begin = 0; begin < stands.size();) {
      std::size_t end = begin;
      while (end < stands.size() && stands[end]) ++end;
      if (end > begin) runs.push_back({side, begin, end});
      begin = end + 1;
    }
  }
  return runs;
}

/// Collects the JSON data of one world.
class Writer {
 public:
  explicit Writer(const RecordedWorld& world, const std::string& task) : world_(world), task_(task) {}

  Json Write(const ScenarioSummary& scenario, const std::string& title) {
    // Write the world's header, with empty lists.
    const auto [error, unit] = ErrorOf(task_);
    json_ = {{"file", world_.file},     {"title", title},
             {"rate_hz", RateHz()},     {"floor_m", 0},
             {"error", error},          {"unit", unit},
             {"notes", Json::array()},  {"cells", Json::array()},
             {"bodies", Json::array()}, {"targets_m", Json::array()},
             {"steps", Json::array()},  {"marks", Json::array()}};
    // Add each cell with the extras and tracks of its recording.
    for (cell_ = 0; cell_ < world_.cells.size(); ++cell_) {
      const RecordedCell& cell = world_.cells[cell_];
      json_["cells"].push_back({{"id", cell.row->Id()},
                                {"method", cell.row->method},
                                {"colour", IndexOf(scenario, cell.row->method)},
                                {"status", StatusName(cell.row->result.status)},
                                {"reason", cell.row->result.reason}});
      const int begin = AddExtras(cell.row->method, *cell.recording);
      for (const Track& track : cell.recording->tracks) {
        if (track.motion.poses.empty()) continue;
        Json members = Json::object();
        if (LookOf(task_, track.name).has_contacts) members["contacts"] = ContactsOf(track.motion);
        AddBody(cell, PointsOf(track), track.name == "wanted" ? begin + wanted_ : begin, members);
      }
    }
    // Find the bodies from which errors are measured, and shift all frames so that the world starts at frame 0.
    FindReferences();
    StartAtZero();
    if (task_ == "ik") json_["floor_m"] = lowest_;
    return std::move(json_);
  }

 private:
  struct Body {
    TrackPoints motion;
    int begin;
    std::size_t cell;
  };

  double RateHz() const {
    for (const Track& track : world_.cells.front().recording->tracks) {
      if (!track.motion.poses.empty()) return track.motion.rate_hz;
    }
    return kJudgedRateHz;
  }

  /// Adds a body that appears at frame `begin`, with the further JSON `members`.
  void AddBody(const RecordedCell& cell, TrackPoints motion, int begin, const Json& members) {
    const TrackLook look = LookOf(task_, motion.track);
    const std::size_t frames = motion.FrameCount();
    motion.CutWhereItRests();
    // If another method recorded exactly the same body, store the body only once for both methods.
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const Body& body = bodies_[i];
      if (body.motion.track != motion.track || body.begin != begin || look.label.empty()) continue;
      if (body.motion.joints != motion.joints || body.motion.points != motion.points) continue;
      json_["bodies"][i]["cell"] = -1;
      return;
    }
    // Quantise the joints and encode the steps in Base64.
    const QuantisedMotion quantised = Quantise(motion.points);
    std::string bytes;
    for (const std::uint16_t step : quantised.steps)
      bytes += {static_cast<char>(step & 255), static_cast<char>(step >> 8)};
    // Find the height of the lowest joint. In the ik task, the floor has this height.
    for (const glm::dvec3& point : motion.points) lowest_ = std::min(lowest_, point.y);
    Json body = {{"label", look.label.empty() ? cell.row->method : std::string(look.label)},
                 {"cell", cell_},
                 {"kind", look.kind},
                 {"begin", begin},
                 {"frames", frames},
                 {"against", Json::array()},
                 {"low_m", {quantised.low.x, quantised.low.y, quantised.low.z}},
                 {"step_m", quantised.step},
                 {"data", Base64(bytes)},
                 {"contacts", Json::array()}};
    body.update(members);
    json_["bodies"].push_back(std::move(body));
    bodies_.push_back({std::move(motion), begin, cell_});
  }

  // For each body, lists the bodies from which this body's error is measured: bodies of the same cell, and bodies that
  // several methods share.
  void FindReferences() {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      for (const std::string_view track : LookOf(task_, bodies_[i].motion.track).against) {
        for (std::size_t j = 0; j < bodies_.size(); ++j) {
          const bool shared = json_["bodies"][j]["cell"] == -1;
          if (bodies_[j].motion.track == track && (shared || bodies_[j].cell == bodies_[i].cell)) {
            json_["bodies"][i]["against"].push_back(j);
          }
        }
      }
    }
  }

  void StartAtZero() {
    int first = 0;
    for (const Json& body : json_["bodies"]) first = std::min(first, body["begin"].get<int>());
    for (Json& body : json_["bodies"]) body["begin"] = body["begin"].get<int>() - first;
    for (Json& mark : json_["marks"]) {
      for (const char* key : {"frame", "end"}) mark[key] = mark[key].get<int>() - first;
    }
  }

  void Mark(std::string_view lane, int frame, int end, std::string_view kind, const std::string& text) {
    Json mark = {{"lane", lane}, {"frame", frame}, {"end", std::max(frame, end)}, {"kind", kind}, {"text", text}};
    Json& marks = json_["marks"];
    if (std::ranges::find(marks, mark) == marks.end()) marks.push_back(std::move(mark));
  }

  /// Adds the extras of a cell. Returns the frame on the viewer's time axis at which the cell's recording begins. It is
  /// chosen so that the requests of all transitions are at the same frame of this axis.
  int AddExtras(const std::string& method, const Recording& recording) {
    wanted_ = 0;
    const auto add = [&](const auto& extras) {
      if (extras) return Add(method, *extras);
      json_["notes"].push_back(
          fmt::format("The timeline marks of {} cannot be read: {}", method, extras.error().message));
      return 0;
    };
    if (task_ == "evaluation" || task_ == "inbetween") return add(ReadEvaluationExtras(recording.extras_json));
    if (task_ == "ik") return add(ReadExtras<IkExtras>(recording.extras_json));
    if (task_ == "transition") return add(ReadTransitionFacts(recording, method));
    if (task_ == "detection") return add(ReadExtras<DetectionExtras>(recording.extras_json));
    if (task_ == "coach") return add(ReadExtras<CoachExtras>(recording.extras_json));
    if (task_ == "plausibility") return add(ReadExtras<PlausibilityExtras>(recording.extras_json));
    return 0;
  }

  int Add(const std::string&, const EvaluationExtras& extras) {
    json_["rate_hz"] = extras.truth.rate_hz;
    for (const auto& [track, motion] : {std::pair("truth", &extras.truth), {"answer", &extras.answer}}) {
      AddBody(world_.cells[cell_], {track, motion->joints.size(), motion->positions}, 0,
              {{"joints", motion->joints}, {"parents", motion->parents}});
    }
    return 0;
  }

  int Add(const std::string&, const IkExtras& extras) {
    json_["steps"].push_back({{"cell", cell_},
                              {"iterations", extras.iterations},
                              {"off_cm", extras.position_error_max_cm},
                              {"off_deg", extras.axis_error_max_deg}});
    Json targets = Json::array();
    for (const std::optional<glm::dvec3>& target : extras.targets_m) {
      if (target) targets.push_back({target->x, target->y, target->z});
    }
    json_["targets_m"] = targets;
    return 0;
  }

  int Add(const std::string& method, const TransitionFacts& extras) {
    const std::vector<int>& frames = extras.transition_frames;
    const int begin = -extras.request_frame.value_or(frames.empty() ? 0 : frames.front());
    if (extras.request_frame) Mark("request", 0, 0, "request", "the next clip is requested");
    for (std::size_t i = 0; i < frames.size(); ++i) {
      std::string text = fmt::format("{} → {}", extras.from, extras.to);
      if (i < extras.points.size()) {
        const PointFacts& point = extras.points[i];
        const auto frame = [](const std::optional<int>& of) { return of ? fmt::format(" frame {}", *of) : ""; };
        text = fmt::format("{}{} → {}{}", point.from, frame(point.from_frame), point.to, frame(point.to_frame));
        if (point.distance) text += fmt::format(", fuzzy distance {:.3g}", *point.distance);
      }
      Mark(method, begin + frames[i], begin + frames[i], "transition", text);
    }
    if (!frames.empty()) wanted_ = frames.back();
    return begin;
  }

  /// Marks a verdict: "hit" if the verdict agrees with the truth, "miss" if it disagrees, "grey" if the truth itself is
  /// undecided.
  void MarkJudgement(std::string_view lane, int frame, const std::string& truth, bool called_right,
                     const std::string& text) {
    const bool agrees = (truth == "right") == called_right;
    Mark(lane, frame, frame, truth == "grey" ? "grey" : agrees ? "hit" : "miss", text);
  }

  static std::string Performed(const std::string& move, const std::string& truth, const std::string& faults) {
    return fmt::format("{}: {}{}", move, truth, faults.empty() || faults == "none" ? "" : " (" + faults + ")");
  }

  int Add(const std::string& method, const DetectionExtras& extras) {
    for (const DetectionExtras::Event& event : extras.events) {
      Mark("danced", event.begin_frame, event.end_frame, event.truth, Performed(event.move, event.truth, event.fault));
      MarkJudgement(method, event.called_frame.value_or(event.end_frame), event.truth, event.called_right,
                    fmt::format("{}: {}, score {:.2f}", event.move,
                                event.called_right ? "judged right" : "judged wrong", event.score));
    }
    for (const DetectionExtras::Alarm& alarm : extras.alarms) {
      Mark(method, alarm.frame, alarm.frame, "miss", "false alarm: " + alarm.move);
    }
    return 0;
  }

  int Add(const std::string& method, const CoachExtras& extras) {
    const std::string lane = world_.cells.size() > 1 ? " of " + method : "";
    // Add marks for performances and the verdicts on them.
    for (const CoachExtras::Performance& danced : extras.performances) {
      Mark("danced" + lane, danced.begin_frame, danced.end_frame, danced.truth,
           Performed(danced.move, danced.truth, danced.faults));
      if (danced.called == "unjudged") continue;
      MarkJudgement("judged" + lane, danced.end_frame, danced.truth, danced.called == "right",
                    fmt::format("{}: judged {}", danced.move, danced.called));
    }
    // Add marks for corrections with their reasons, for transitions, and for spoken words.
    for (const int frame : extras.corrections) {
      std::string why;
      for (const CoachExtras::Decision& decision : extras.decisions) {
        if (decision.frame == frame && !decision.why.empty()) why = ": " + decision.why;
      }
      Mark("coach" + lane, frame, frame, "correction", "corrects" + why);
    }
    for (const int frame : extras.transitions) Mark("coach" + lane, frame, frame, "transition", "changes clips");
    for (std::size_t i = 0; i < extras.words.size(); ++i) {
      const CoachExtras::Words& words = extras.words[i];
      const int end = i + 1 < extras.words.size() ? extras.words[i + 1].begin_frame : words.begin_frame + 60;
      const std::string both = words.say + (words.say.empty() || words.hint.empty() ? "" : ": ") + words.hint;
      if (!both.empty()) Mark("says" + lane, words.begin_frame, end, "words", both);
    }
    return 0;
  }

  int Add(const std::string& method, const PlausibilityExtras& extras) {
    json_["floor_m"] = extras.floor_m;
    for (const auto& fault : extras.faults) Mark(method, fault.begin_frame, fault.end_frame, "miss", fault.text);
    return 0;
  }

  const RecordedWorld& world_;
  const std::string& task_;
  std::size_t cell_ = 0;
  int wanted_ = 0;  ///< the frame at which the wanted clip starts in the cell's recording
  double lowest_ = 0;
  std::vector<Body> bodies_;  ///< bodies in the order of json_["bodies"]
  Json json_;
};

}  // namespace

glm::dvec3 QuantisedMotion::At(std::size_t point) const {
  const std::uint16_t* at = &steps[3 * point];
  return *at == kNoStep ? NotSeen() : low + step * glm::dvec3(at[0], at[1], at[2]);
}

QuantisedMotion Quantise(std::span<const glm::dvec3> points) {
  // Find the bounding box of all points that are not missing.
  glm::dvec3 low(std::numeric_limits<double>::infinity()), high = -low;
  for (const glm::dvec3& point : points) {
    if (!IsSeen(point)) continue;
    low = glm::min(low, point);
    high = glm::max(high, point);
  }
  const bool is_seen = low.x <= high.x;
  if (!is_seen) low = high = glm::dvec3(0);
  const glm::dvec3 range = high - low;
  constexpr double kMaxStep = QuantisedMotion::kNoStep - 1;
  QuantisedMotion quantised{.low = low, .step = std::max({range.x, range.y, range.z}) / kMaxStep, .steps = {}};
  quantised.steps.reserve(3 * points.size());
  for (const glm::dvec3& point : points) {
    for (int axis = 0; axis < 3; ++axis) {
      const double steps = quantised.step > 0 ? (point[axis] - low[axis]) / quantised.step : 0;
      quantised.steps.push_back(IsSeen(point) ? static_cast<std::uint16_t>(std::clamp(std::round(steps), 0.0, kMaxStep))
                                              : QuantisedMotion::kNoStep);
    }
  }
  return quantised;
}

std::string WorldScript(const RunData& run, const RecordedWorld& world) {
  const Row& row = *world.cells.front().row;
  std::string title = fmt::format("{}, {}", run.scenarios[world.scenario].name, world.Name());
  if (!row.clip.empty() && !JudgesFiles(row.task)) title += fmt::format(", {}", row.clip);
  const Json json = Writer(world, row.task).Write(run.scenarios[world.scenario], title);
  return fmt::format("etudeMotion({});\n", EscapeScriptJson(json.dump(-1, ' ', true, Json::error_handler_t::replace)));
}

}  // namespace etude
