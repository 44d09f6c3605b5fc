#include "bench/tasks/coach/session.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "bench/tasks/sensing/camera_stream.h"
#include "engine/coaching/session.h"
#include "sim/music/music.h"

namespace etude {
namespace {

bool IsBridged(const TransitionRecord& record) {
  return record.branch == Branch::kFrontHalf || record.branch == Branch::kRearHalf ||
         record.branch == Branch::kInBetween;
}

constexpr int kAhead = static_cast<int>(LiveSensor::kAhead);

/// Runs one session.
class Loop {
 public:
  Loop(const SessionParts& parts, const CoachWorld& world, Player& player, MomentSource* moments)
      : parts_(parts), world_(world), player_(player), moments_(moments), music_(world.music, world.key) {
    coach_ = std::make_unique<CoachSession>(
        CoachSession::Parts{.coach = &parts.coach, .recogniser = &parts.recogniser, .filter = parts.filter},
        parts.coach.BeginDancing());
  }

  Result<SessionLog> Run() {
    for (int i = 0; i < kAhead; ++i) MoveLearner();  // requests poses in advance
    ASSIGN_OR_RETURN(sensor_, MakeSensor());
    for (const BodyPose& pose : log_.learner.poses) sensor_->Update(pose);
    while (frame_ < world_.frames) {
      // The learner moves, the sensor observes the learner, and the coach reacts.
      const SensedFrame sensed = *SeeLearner();
      const SensedFrame seen = parts_.sees_truth ? AsDanced(frame_) : sensed;
      shown_ = coach_->Next(seen, Told());
      log_.sensed.frames.push_back(seen);
      // Log the frame, and advance the music.
      Note();
      PlayMusic();
      if (shown_.mode == CoachMode::kStandby) DanceAgain();
      ++frame_;
      if (log_.given_up_at) break;  // the learner has left
    }
    log_.learner.poses.resize(static_cast<std::size_t>(frame_));
    log_.test = player_.TakeTest(world_.test_after);
    return std::move(log_);
  }

 private:
  /// Begins the song again after its end. The coach keeps its memory of the player and of the frames it has received.
  void DanceAgain() {
    CoachState state = parts_.coach.BeginDancing();
    state.moves = coach_->state().moves;
    first_frame_ = frame_ + 1;
    coach_->ReplaceState(std::move(state));
  }

  void MoveLearner() { log_.learner.poses.push_back(player_.Next(shown_)); }

  std::optional<SensedFrame> SeeLearner() {
    MoveLearner();
    return sensor_->Update(log_.learner.poses.back());
  }

  /// Makes the sensor. If it consists of cameras, they are set up for the learner's pose at the start of the session.
  Result<std::unique_ptr<LiveSensor>> MakeSensor() const {
    if (!world_.cameras || parts_.sees_truth) {
      return std::make_unique<SkeletonSensor>(world_.sensor, world_.occluders, world_.errors, kJudgedRateHz,
                                              world_.key);
    }
    return CameraSensor::Make(*world_.cameras, parts_.capture, log_.learner.poses.front(),
                              static_cast<std::size_t>(world_.frames), world_.key);
  }

  SensedFrame AsDanced(int frame) const {
    return StreamOf({.poses = {log_.learner.poses[static_cast<std::size_t>(frame)]}}).frames.front();
  }

  SessionInput Told() {
    SessionInput input;
    if (music_.IsPlaying()) input.music_s = music_.Now();
    if (open_) {
      const auto played = player_.PerformanceOf(open_->repetition);
      const auto truth = played ? played->truth : PerformanceTruth::kWrong;
      if (truth != PerformanceTruth::kGrey) input.told_right = truth == PerformanceTruth::kRight;
    }
    input.moment = moments_ != nullptr && moments_->Now(frame_, shown_);
    return input;
  }

  void PlayMusic() {
    if (shown_.music.kind == MusicCommand::Kind::kPlayFrom) music_.PlayFrom(shown_.music.music_s);
    if (shown_.music.kind == MusicCommand::Kind::kPause) music_.Pause();
    const double before = music_.Now();
    music_.Tick();
    if (music_.IsPlaying()) NoteBeats(before, music_.Now());
  }

  /// Logs the beats between two times of the music, which both lie within this frame.
  void NoteBeats(double from_s, double to_s) {
    const std::vector<double>& beats = parts_.coach.dance().beats_s;
    for (auto beat = std::ranges::lower_bound(beats, from_s); beat != beats.end() && *beat < to_s; ++beat) {
      log_.beats_s.push_back((frame_ + (*beat - from_s) / (to_s - from_s)) / kJudgedRateHz);
    }
  }

  /// Logs the results of this frame.
  void Note() {
    log_.modes.push_back(shown_.mode);
    log_.coach.poses.push_back(shown_.body);
    if (shown_.beat_error_s) log_.beat_errors_s.push_back(*shown_.beat_error_s);
    if (player_.HasGivenUp() && !log_.given_up_at) log_.given_up_at = frame_;
    for (CoachRecord record : shown_.records) {
      record.frame += first_frame_;
      NoteRecord(record);
      log_.records.push_back(std::move(record));
    }
    NoteAct();
    NoteWords();
    if (shown_.asks) {
      open_ = shown_.open;
      opened_at_ = frame_ + 1;
    }
  }

  void NoteRecord(const CoachRecord& record) {
    switch (record.event) {
      case CoachEvent::kRight:
      case CoachEvent::kWrong:
      case CoachEvent::kUnjudged:
        NoteVerdict(record.event);
        break;
      case CoachEvent::kCorrects:
        log_.corrections.push_back({.decided_frame = frame_, .act_frame = {}});
        break;
      case CoachEvent::kTransition:
        if (record.transition) log_.transitions.push_back({TransitionPointsOf(*record.transition), IsBridged(*record.transition)});
        break;
      default:
        break;
    }
  }

  /// Logs the performance whose window has closed. A window that the coach interrupted is not logged, because the
  /// coach did not ask for a whole performance.
  void NoteVerdict(CoachEvent event) {
    if (!open_) return;
    const bool was_cut = event == CoachEvent::kUnjudged && shown_.mode != CoachMode::kDance;
    if (!was_cut) {
      const auto played = player_.PerformanceOf(open_->repetition);
      LoggedPerformance performance{.repetition = open_->repetition, .move = open_->move, .judged = {}, .faults = ""};
      performance.judged = {.begin_frame = opened_at_,
                            .end_frame = frame_,
                            .truth = played ? played->truth : PerformanceTruth::kWrong,
                            .called_wrong = {},
                            .called_right = event == CoachEvent::kRight};
      if (event == CoachEvent::kWrong) performance.judged.called_wrong = frame_;
      performance.faults = played ? played->faults : "skipped";
      log_.performances.push_back(std::move(performance));
    }
    open_.reset();
  }

  /// Logs the frame in which the coach begins to act out a correction: the first frame after the transition to it.
  void NoteAct() {
    const bool acts = shown_.mode == CoachMode::kCorrect && !shown_.in_transition;
    if (acts && !log_.corrections.empty() && !log_.corrections.back().act_frame) {
      log_.corrections.back().act_frame = frame_;
    }
  }

  void NoteWords() {
    const bool same =
        !log_.words.empty() && log_.words.back().say == shown_.say && log_.words.back().hint == shown_.hint;
    if (same) return;
    LoggedWords words{frame_, std::string(shown_.say), std::string(shown_.hint), {}};
    if (shown_.picture != nullptr) words.picture = *shown_.picture;
    log_.words.push_back(std::move(words));
  }

  /// Returns, for each transition point of `record`, the last frame of the session before this point. The transition
  /// was requested in frame `frame_`.
  std::vector<int> TransitionPointsOf(const TransitionRecord& record) const {
    std::vector<int> points;
    double frame = frame_;
    const double rate = coach_->state().rate;
    for (std::size_t i = 0; i + 1 < record.segments.size(); ++i) {
      frame += (record.segments[i].last - record.segments[i].first) / rate;
      points.push_back(static_cast<int>(std::lround(frame)));
    }
    return points;
  }

  const SessionParts& parts_;
  const CoachWorld& world_;
  Player& player_;
  MomentSource* moments_;
  std::unique_ptr<LiveSensor> sensor_;
  MusicClock music_;
  std::unique_ptr<CoachSession> coach_;
  CoachOutput shown_;
  SessionLog log_;
  int frame_ = 0;
  int first_frame_ = 0;  ///< first frame of the present performance of the song
  std::optional<OpenWindow> open_;
  int opened_at_ = 0;
};

}  // namespace

Result<SessionLog> RunSession(const SessionParts& parts, const CoachWorld& world, Player& player,
                              MomentSource* moments) {
  return Loop(parts, world, player, moments).Run();
}

}  // namespace etude
