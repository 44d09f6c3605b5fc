#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/recordings/task_extras.h"
#include "engine/base/result.h"
#include "engine/motion/body.h"
#include "engine/motion/character.h"
#include "io/drawing/film.h"
#include "reports/films/cast.h"
#include "reports/films/session_parts.h"
#include "sim/render/renderer.h"

namespace etude {

/// A recorded session of a coach, as a film needs it: what the recording tells, every frame of it within the session,
/// and its tracks.
struct CoachedSessionFacts : CoachExtras {
  BodyMotion coach, learner, sensed;  ///< of one length

  int Frames() const { return static_cast<int>(coach.poses.size()); }
};

/// Reads what the coach task keeps of a cell. Fails, naming the recording and the key, when it is not that.
Result<CoachedSessionFacts> ReadCoachedSession(const CastCell& cell);

/// Chooses the worst of a scenario's recorded sessions: the one with the most needless and missed corrections a minute.
/// Gives nothing where nothing was recorded.
std::optional<CastCell> ChooseWorstSession(const RunData& run, const ScenarioSummary& scenario);

/// Makes paper A's scene: a meadow before a forest's edge and the sky. It stands behind z = −1, and hides the room's
/// wall and floor from a camera that looks at the origin from +Z.
Figure ForestFigure();

/// Makes a soft dark spot on the meadow below a body: the forest is drawn without shadows.
Surface SpotBelow(const BodyPose& pose);

/// A coached session: the bear in its forest and the learner beside it, the learner's skeleton as the sensor saw it,
/// the hint with the picture of its key pose, and a timeline of truth, judgements and transitions. A beat is a click.
class CoachedScene : public Scene {
 public:
  /// Shows at most `longest` frames, cut around the session's first correction. The renderer must outlive the scene.
  CoachedScene(CoachedSessionFacts facts, std::string heading, int longest, Renderer& renderer);

  int Frames() const override { return last_ - first_; }
  int PosterFrame() const override;
  std::string Words() const override;
  Canvas Draw(int frame) override;
  std::vector<double> Beats() const override;

 private:
  /// Gives the stage without anybody, which is drawn once.
  const ColourImage& Backdrop(const Camera& camera);
  void DrawStage(Canvas& canvas, int frame);
  void DrawSkeletonInset(Canvas& canvas, int frame) const;
  void DrawHint(Canvas& canvas, int frame) const;
  void DrawTimeline(Canvas& canvas, int now) const;
  /// Gives the frames of the session that the timeline shows at one of them.
  FrameSpan TimelineAt(int now) const;

  CoachedSessionFacts facts_;
  std::string heading_;
  Renderer& renderer_;
  int first_ = 0, last_ = 0;  ///< [first_, last_) of the session
  Character bear_, learner_;
  ColourImage backdrop_;  ///< empty until it is needed
};

}  // namespace etude
