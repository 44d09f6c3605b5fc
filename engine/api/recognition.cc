#include <etude/recognition.h>

#include <cmath>

#include "engine/api/checks.h"
#include "engine/recognition/sight.h"

namespace etude::engine {

const RecogniserKind& KindOfExamples(const std::string& name) {
  const RecogniserKind* kind = FindRecogniser(name);
  if (kind != nullptr && (name == "whole-body" || name == "dtw" || name == "nearest")) return *kind;
  throw BadInput(
      fmt::format("'{}' is not a recogniser that learns from examples; allowed: whole-body, dtw, nearest", name));
}

void CheckMoves(std::span<const TaughtMove> moves) {
  for (const TaughtMove& move : moves) {
    for (const SkeletonStream& example : move.examples) {
      if (example.frames.empty()) throw BadInput(fmt::format("move '{}' has an example without frames", move.name));
      Checked(MotionOf(example));
    }
  }
}

void CheckFrame(const SensedFrame& frame) {
  for (std::size_t i = 0; i < kRoleCount; ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      if (std::isfinite(frame.joints[i].position[axis])) continue;
      throw BadInput(fmt::format("the position of joint {} is not finite", i));
    }
  }
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
  CheckMoves(moves);
  auto made = std::make_shared<Taught>();
  made->moves = moves.size();
  made->filter.kind = options.smooths ? FilterKind::kHolt : FilterKind::kNone;
  made->recogniser = OrThrow(MakeRecogniser({.kind = &kind}, moves));
  taught_ = std::move(made);
}

Recogniser::Recogniser(Recogniser&&) noexcept = default;
Recogniser& Recogniser::operator=(Recogniser&&) noexcept = default;
Recogniser::~Recogniser() = default;

RecogniserStream Recogniser::Follow(double rate_hz) const {
  if (!(rate_hz > 0 && rate_hz <= 1000))
    throw BadInput(fmt::format("the rate is {} Hz; allowed: above 0, up to 1000 Hz", rate_hz));
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

Evidence RecogniserStream::Update(const SensedFrame& frame) {
  CheckFrame(frame);
  const etude::Evidence found = following_->follower->Update(following_->sight.Update(frame));
  return {found.asked, {found.spotted.begin(), found.spotted.end()}};
}

}  // namespace etude::engine
