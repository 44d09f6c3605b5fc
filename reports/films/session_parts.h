#pragma once

#include <string>
#include <string_view>

#include "engine/fuzzy/features.h"
#include "engine/motion/body.h"
#include "io/drawing/canvas.h"

namespace etude {

/// Draws the body from the front as lines. The box shows a height of `tall` metres; the feet are near the box's lower
/// edge.
void DrawStickFigure(Canvas& canvas, const BodyPose& pose, const Box& box, double tall, const Paint& paint);

/// Returns the pixel of the canvas at which DrawStickFigure draws a joint.
glm::dvec2 StickJoint(const BodyPose& pose, Role role, const Box& box, double tall);

/// Frames [begin, end) of a session.
struct FrameSpan {
  int begin = 0, end = 0;
};

inline constexpr Paint kRightPaint{0.36, 0.74, 0.46, 1}, kWrongPaint{0.88, 0.36, 0.32, 1};
inline constexpr Paint kUndecidedPaint{0.55, 0.58, 0.60, 1};

/// Returns the everyday name of one of paper A's angles: the limb that is bent or raised, such as "right arm".
std::string_view PlainNameOf(Feature feature);

/// Returns the colour of the verdict "right" or "wrong"; for any other word, the colour of undecided verdicts.
Paint PaintOfWord(const std::string& word);

/// The timeline below a film of a session: rows of bars over the visible frames, and a vertical line at the current
/// frame.
class SessionTimeline {
 public:
  static constexpr Box kBox{12, 584, 1256, 124};

  /// Draws the timeline's background.
  SessionTimeline(Canvas& canvas, const FrameSpan& shown);

  void Label(int row, const std::string& text);
  /// Draws a bar over frames [begin, end) of the session, clipped to the visible frames.
  void Bar(int row, int begin, int end, const Paint& paint);
  /// Writes a text over frames [begin, end) of a row, if the text fits between these frames.
  void Text(int row, int begin, int end, const std::string& text);
  /// Draws a vertical line at a frame through rows `first_row` … `last_row`.
  void Tick(int frame, int first_row, int last_row, const Paint& paint);
  bool Shows(int frame) const { return frame >= shown_.begin && frame < shown_.end; }

 private:
  double XOf(int frame) const;

  Canvas& canvas_;
  FrameSpan shown_;
};

}  // namespace etude
