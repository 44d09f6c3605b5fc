#include <etude/recognition.h>

#include <cmath>

#include "engine/api/convert.h"
#include "engine/recognition/sight.h"

namespace etude::engine {

const RecogniserKind& KindOfExamples(const std::string& name) {
  const RecogniserKind* kind = FindRecogniser(name);
  if (kind != nullptr && (name == "whole-body" || name == "dtw" || name == "nearest")) return *kind;
  throw BadInput(fmt::format("no recogniser '{}' of examples; allowed: whole-body, dtw, nearest", name));
}

etude::TaughtMove ToEngineMove(const TaughtMove& move) {
  etude::TaughtMove taught{.name = move.name};
  for (const Motion& example : move.examples) {
    if (example.poses.empty()) throw BadInput(fmt::format("move '{}': an example without frames", move.name));
    taught.examples.push_back(StreamOf(ToBodyMotion(example)));
  }
  return taught;
}

SensedFrame ToEngineFrame(const SensedPose& frame) {
  SensedFrame sensed{.joints = {}, .body_seen = frame.body_seen};
  for (std::size_t i = 0; i < kRoleCount; ++i) {
    const glm::dvec3& place = frame.pose.joints[i];
    for (int axis = 0; axis < 3; ++axis) {
      if (!std::isfinite(place[axis])) throw BadInput(fmt::format("joint {}: a position that is not finite", i));
    }
    sensed.joints[i] = {place, static_cast<TrackingState>(frame.seen[i])};
  }
  return sensed;
}

struct Recogniser::Taught {
  std::size_t moves = 0;
  FilterOptions filter;
  std::unique_ptr<etude::Recogniser> recogniser;
};

struct RecogniserStream::Following {
  std::shared_ptr<const Recogniser::Taught> taught;
  LiveSight sight;
  std::unique_ptr<MoveFollower> follower;
};

Recogniser::Recogniser(std::span<const TaughtMove> moves, const RecogniserOptions& options) {
  const RecogniserKind& kind = KindOfExamples(options.kind);
  if (moves.empty()) throw BadInput("no moves");
  std::vector<etude::TaughtMove> taught;
  for (const TaughtMove& move : moves) taught.push_back(ToEngineMove(move));
  auto made = std::make_shared<Taught>();
  made->moves = moves.size();
  made->filter.kind = options.smooths ? FilterKind::kHolt : FilterKind::kNone;
  made->recogniser = OrThrow(MakeRecogniser({.kind = &kind}, taught));
  taught_ = std::move(made);
}

Recogniser::Recogniser(Recogniser&&) noexcept = default;
Recogniser& Recogniser::operator=(Recogniser&&) noexcept = default;
Recogniser::~Recogniser() = default;

RecogniserStream Recogniser::Follow(double rate_hz) const {
  if (!(rate_hz > 0 && rate_hz <= 1000)) throw BadInput(fmt::format("{} Hz; allowed: above 0, up to 1000", rate_hz));
  return RecogniserStream(std::unique_ptr<RecogniserStream::Following>(new RecogniserStream::Following{
      taught_, LiveSight(taught_->filter, rate_hz), taught_->recogniser->Follow(rate_hz)}));
}

RecogniserStream::RecogniserStream(std::unique_ptr<Following> following) : following_(std::move(following)) {}
RecogniserStream::RecogniserStream(RecogniserStream&&) noexcept = default;
RecogniserStream& RecogniserStream::operator=(RecogniserStream&&) noexcept = default;
RecogniserStream::~RecogniserStream() = default;

void RecogniserStream::Ask(std::optional<int> move) {
  const int moves = static_cast<int>(following_->taught->moves);
  if (move && (*move < 0 || *move >= moves)) {
    throw BadInput(fmt::format("move {}; allowed: 0 to {}", *move, moves - 1));
  }
  following_->follower->Ask(move ? std::optional(static_cast<std::size_t>(*move)) : std::nullopt);
}

Evidence RecogniserStream::Update(const SensedPose& frame) {
  const etude::Evidence found = following_->follower->Update(following_->sight.Update(ToEngineFrame(frame)));
  return {found.asked, {found.spotted.begin(), found.spotted.end()}};
}

}  // namespace etude::engine
