#pragma once

#include <string>

#include "reports/films/film.h"
#include "reports/films/judged_session.h"
#include "reports/films/session_parts.h"

namespace etude {

/// The film of a session before the sensor: the skeleton as the sensor saw it over the body as it moved; the angles of
/// the key poses asked for, each pose ticked off when it is reached; the evidence; and a timeline of truth, of the
/// verdicts of every method, and of false alarms.
class JudgedScene : public Scene {
 public:
  /// Shows at most `longest` frames, from just before the performance that precedes the first misjudged one.
  JudgedScene(JudgedSessionFacts facts, std::string heading, int longest);

  int Frames() const override { return last_ - first_; }
  int PosterFrame() const override;
  std::string Words() const override;
  Canvas Draw(int frame) override;

 private:
  using Performance = JudgedSessionFacts::Performance;

  /// Gives the performance asked for, or the last that was; before the first, the first.
  std::size_t CurrentAt(int frame) const;
  /// Gives "right" or "wrong" once it is known, else "".
  std::string CalledAt(std::size_t judge, std::size_t performance, int frame) const;
  bool IsMisjudged(std::size_t performance) const;
  void DrawSkeleton(Canvas& canvas, int now) const;
  void DrawAngles(Canvas& canvas, int now) const;
  void DrawTimeline(Canvas& canvas, int now) const;

  JudgedSessionFacts facts_;
  std::string heading_;
  int first_ = 0, last_ = 0;  ///< [first_, last_) of the session
};

}  // namespace etude
