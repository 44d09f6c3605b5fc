#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/recordings/task_extras.h"
#include "engine/base/result.h"
#include "engine/motion/body.h"
#include "engine/motion/character.h"
#include "io/drawing/film.h"
#include "reports/films/session_parts.h"
#include "reports/films/shown_cell.h"
#include "sim/render/renderer.h"

namespace etude {

/// A recorded session of a coach, prepared for a film. It contains the motions and the extras of the recording, with
/// every frame number clamped to the session.
struct CoachedSessionFacts : CoachExtras {
  /// Motions of coach and learner, and the learner's motion as the sensor saw it; the three motions have equal lengths.
  BodyMotion coach, learner, sensed;

  int Frames() const { return static_cast<int>(coach.poses.size()); }
};

/// Reads the recording that the coach task keeps of a cell. If the recording has another form, fails and names the
/// recording and the faulty key.
Result<CoachedSessionFacts> ReadCoachedSession(const ShownCell& cell);

/// Chooses the worst of a scenario's recorded sessions: the session with the most unneeded and missed corrections per
/// minute. Returns nullopt if no session was recorded.
std::optional<ShownCell> ChooseWorstSession(const RunData& run, const ScenarioSummary& scenario);

/// Returns the scenery of paper A: a meadow in front of a forest and the sky. The scenery is behind z = −1 and hides
/// the room's wall and floor from a camera at +Z that looks at the origin.
Figure ForestFigure();

/// Returns a soft dark spot on the meadow below a body. The spot replaces the body's shadow, because the forest is
/// rendered without shadows.
Surface SpotBelow(const BodyPose& pose);

/// The film of a coached session. It shows the bear, which is the coach, beside the learner in the forest; the
/// learner's skeleton as the sensor saw it; the hint with the picture of its key pose; and a timeline of truth,
/// verdicts and transitions. A click sounds on every beat.
class CoachedScene : public Scene {
 public:
  /// Cuts the film to at most `longest` frames around the session's first correction. The renderer must outlive the
  /// scene.
  CoachedScene(CoachedSessionFacts facts, std::string heading, int longest, Renderer& renderer);

  int Frames() const override { return last_ - first_; }
  int PosterFrame() const override;
  std::string Words() const override;
  Canvas Draw(int frame) override;
  std::vector<double> Beats() const override;

 private:
  /// Returns the picture of the forest without people, which is rendered only once.
  const ColourImage& Backdrop(const Camera& camera);
  void DrawStage(Canvas& canvas, int frame);
  void DrawSkeletonInset(Canvas& canvas, int frame) const;
  void DrawHint(Canvas& canvas, int frame) const;
  void DrawTimeline(Canvas& canvas, int now) const;
  /// Returns the frames of the session that the timeline shows at frame `now`.
  FrameSpan TimelineAt(int now) const;

  CoachedSessionFacts facts_;
  std::string heading_;
  Renderer& renderer_;
  int first_ = 0, last_ = 0;  ///< the film shows the session's frames [first_, last_)
  Character bear_, learner_;
  ColourImage backdrop_;  ///< picture of the forest without people; empty until it is first needed
};

}  // namespace etude
