#include "engine/coaching/session.h"

#include <utility>

#include "engine/recognition/sight.h"

namespace etude {

struct CoachSession::Perception {
  Perception(const Parts& parts)
      : sight(parts.filter, kJudgedRateHz),
        follower(parts.recogniser->Follow(kJudgedRateHz)),
        mirror_sight(parts.filter, kJudgedRateHz),
        mirror_follower(parts.tells_wrong_side ? parts.recogniser->Follow(kJudgedRateHz) : nullptr) {}

  LiveSight sight;
  std::unique_ptr<MoveFollower> follower;
  LiveSight mirror_sight;
  std::unique_ptr<MoveFollower> mirror_follower;  // null if the mirror image is not followed

  void Ask(std::optional<std::size_t> move) {
    follower->Ask(move);
    if (mirror_follower) mirror_follower->Ask(move);
  }
};

CoachSession::CoachSession(const Parts& parts, CoachState begin)
    : coach_(parts.coach), state_(std::move(begin)), perception_(std::make_unique<Perception>(parts)) {}
CoachSession::~CoachSession() = default;
CoachSession::CoachSession(CoachSession&&) noexcept = default;
CoachSession& CoachSession::operator=(CoachSession&&) noexcept = default;

CoachOutput CoachSession::Next(const SensedFrame& frame, const SessionInput& input) {
  const bool mirrors = coach_->options().player_mirrors;
  const SensedFrame image = MirrorImage(frame);
  CoachInput news{.seen = perception_->sight.Update(mirrors ? image : frame),
                  .music_s = input.music_s,
                  .told_right = input.told_right,
                  .moment = input.moment};
  news.evidence = perception_->follower->Update(news.seen);
  if (perception_->mirror_follower) {
    const SeenFrame other = perception_->mirror_sight.Update(mirrors ? frame : image);
    news.other_side = perception_->mirror_follower->Update(other).asked;
  }
  CoachStep step = coach_->Step(std::move(state_), news);
  state_ = std::move(step.state);
  if (step.output.asks) {
    const auto& open = step.output.open;
    perception_->Ask(open ? std::optional<std::size_t>(open->move) : std::nullopt);
  }
  return std::move(step.output);
}

SensedFrame MirrorImage(const SensedFrame& frame) {
  SensedFrame image = frame;
  for (Role role : AllRoles()) {
    SensedJoint joint = frame[Mirrored(role)];
    joint.position.x = -joint.position.x;
    image[role] = joint;
  }
  return image;
}

}  // namespace etude
