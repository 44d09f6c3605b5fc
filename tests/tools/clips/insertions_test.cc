// Inserts faults into real clips. FindMotionFaults must find, name and date at least 95 % of them, and report nothing
// in unchanged clips. `ETUDE_FAULT_CLIPS` names further clips, one pattern per line; `scripts/soak faults` sets it.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <glm/gtc/quaternion.hpp>
#include <sstream>

#include "engine/base/angles.h"
#include "engine/base/directions.h"
#include "engine/base/order_statistics.h"
#include "engine/motion/motion_faults.h"
#include "engine/motion/support.h"
#include "io/clips/body_in_place.h"
#include "io/clips/references.h"
#include "sim/random/stream.h"

namespace etude {
namespace {

using enum Role;
using enum FaultKind;

struct TriedClip {
  std::string name;
  BodyMotion motion;
  FaultOptions options;
  MotionFaults own = {};  ///< faults before the insertion

  bool IsFaultless() const { return own.faults.empty(); }
  /// Drawn clips do not follow laws of physics.
  bool IsDrawn() const { return name.find(".glb") != std::string::npos; }
};

struct Inserted {
  double from_s = 0, to_s = 0;
  std::optional<Role> joint = {};
  std::optional<double> size = {};  ///< must be found to within a tenth
};

using Insert = std::function<std::optional<Inserted>(BodyMotion& motion, RandomStream& dice)>;

double EndOf(const BodyMotion& motion) { return static_cast<double>(motion.poses.size() - 1) / motion.rate_hz; }

/// Returns the first and last frame of a random interval of `seconds`, at least half a second from both ends of the
/// motion; nothing if the motion is too short.
std::optional<std::pair<int, int>> Window(const BodyMotion& motion, double seconds, RandomStream& dice) {
  constexpr double kMargin_s = 0.5;
  const double room = EndOf(motion) - seconds - 2 * kMargin_s;
  if (room <= 0) return std::nullopt;
  const int first = static_cast<int>(std::lround((kMargin_s + dice.Uniform(0, room)) * motion.rate_hz));
  return std::pair(first, first + static_cast<int>(std::lround(seconds * motion.rate_hz)));
}

Inserted Between(const BodyMotion& motion, int first, int last, std::optional<Role> joint = {},
                 std::optional<double> size = {}) {
  return {.from_s = first / motion.rate_hz, .to_s = last / motion.rate_hz, .joint = joint, .size = size};
}

void MoveAll(BodyPose& pose, const glm::dvec3& by) {
  for (glm::dvec3& joint : pose.joints) joint += by;
}

glm::dvec3 AlongFloor(RandomStream& dice) {
  const double angle = dice.Uniform(0, 2 * kPi);
  return {std::cos(angle), 0, std::sin(angle)};
}

/// Lifts the whole body by `height` for some seconds; 0: half of the clip; negative: always.
Insert Lifted(double height, double seconds) {
  return [=](BodyMotion& motion, RandomStream& dice) -> std::optional<Inserted> {
    const int frames = static_cast<int>(motion.poses.size());
    std::pair window(0, frames);
    if (seconds == 0) window = {frames / 2, frames};
    if (seconds > 0) {
      const auto found = Window(motion, seconds, dice);
      if (!found) return std::nullopt;
      window = *found;
    }
    for (int f = window.first; f < window.second; ++f) MoveAll(motion.poses[f], {0, height, 0});
    return Between(motion, window.first, window.second - 1);
  };
}

/// The whole body drifts along the floor for two seconds, and stays there.
Insert Skating(double speed) {
  return [=](BodyMotion& motion, RandomStream& dice) -> std::optional<Inserted> {
    const auto window = Window(motion, 2, dice);
    if (!window) return std::nullopt;
    const glm::dvec3 way = AlongFloor(dice);
    for (int f = window->first; f < static_cast<int>(motion.poses.size()); ++f) {
      MoveAll(motion.poses[f], speed * (std::min(f, window->second) - window->first) / motion.rate_hz * way);
    }
    return Between(motion, window->first, window->second, {}, speed);
  };
}

std::optional<Inserted> Jump(BodyMotion& motion, RandomStream& dice) {
  const auto window = Window(motion, 0.1, dice);
  if (!window) return std::nullopt;
  const glm::dvec3 way = AlongFloor(dice);
  const bool is_once = dice.Chance(0.5);
  const int end = is_once ? window->first + 1 : static_cast<int>(motion.poses.size());
  for (int f = window->first; f < end; ++f) MoveAll(motion.poses[f], 0.5 * way);
  return Between(motion, window->first, window->first, {}, 0.5);
}

std::optional<Inserted> Pop(BodyMotion& motion, RandomStream& dice) {
  const auto window = Window(motion, 0.1, dice);
  if (!window) return std::nullopt;
  const bool is_left = dice.Chance(0.5);
  const glm::dvec3 way = UnitOr(dice.Normal3(), {0, 1, 0});
  for (const Role joint : {kLeftWrist, kLeftHand}) {
    motion.poses[window->first][is_left ? joint : Mirrored(joint)] += 0.5 * way;
  }
  return Between(motion, window->first, window->first, is_left ? kLeftWrist : kRightWrist, 0.5);
}

/// Returns true if the body flies: for 0.2 s both ankles are 10 cm above their rest, and the centre of mass falls at
/// about the acceleration of gravity.
bool Flies(const BodyMotion& motion) {
  std::vector<double> ankles;
  for (const BodyPose& pose : motion.poses) ankles.push_back(std::min(pose[kLeftAnkle].y, pose[kRightAnkle].y));
  const double rest = Quantile(ankles, 0.2);
  const int half = static_cast<int>(std::lround(0.1 * motion.rate_hz));
  for (int f = half; f + half < static_cast<int>(ankles.size()); ++f) {
    const double lowest = *std::min_element(ankles.begin() + f - half, ankles.begin() + f + half + 1);
    const auto height = [&](int at) { return MassCentre(motion.poses[at]).y; };
    const double fall =
        (2 * height(f) - height(f - half) - height(f + half)) * motion.rate_hz * motion.rate_hz / (half * half);
    if (lowest > rest + 0.1 && fall > 8 && fall < 12) return true;
  }
  return false;
}

/// The file states a wrong rate. Only clips with running or jumping show it.
Insert OtherRate(double factor) {
  return [=](BodyMotion& motion, RandomStream&) -> std::optional<Inserted> {
    if (!Flies(motion)) return std::nullopt;
    motion.rate_hz *= factor;
    Inserted inserted;
    inserted.to_s = EndOf(motion);
    return inserted;
  };
}

std::optional<Inserted> Frozen(BodyMotion& motion, RandomStream& dice) {
  const auto window = Window(motion, 1, dice);
  if (!window) return std::nullopt;
  for (int f = window->first + 1; f <= window->second; ++f) motion.poses[f] = motion.poses[window->first];
  return Between(motion, window->first, window->second);
}

/// A limb is 5 % longer for a second, and moves everything beyond it.
std::optional<Inserted> Stretched(BodyMotion& motion, RandomStream& dice) {
  const auto window = Window(motion, 1, dice);
  if (!window) return std::nullopt;
  constexpr std::array kEnds = {kLeftElbow, kRightElbow, kLeftWrist, kRightWrist,
                                kLeftKnee,  kRightKnee,  kLeftAnkle, kRightAnkle};
  const Role end = kEnds[dice.IndexBelow(kEnds.size())];
  for (int f = window->first; f <= window->second; ++f) {
    BodyPose& pose = motion.poses[f];
    const glm::dvec3 by = 0.05 * (pose[end] - pose[*ParentOf(end)]);
    for (const Role role : AllRoles()) {
      for (auto above = std::optional(role); above; above = ParentOf(*above)) {
        if (*above != end) continue;
        pose[role] += by;
        break;
      }
    }
  }
  return Between(motion, window->first, window->second, end);
}

/// Returns a weight that rises from 0 to 1 in the window's first quarter of a second, and falls to 0 in its last one.
double Eased(const BodyMotion& motion, int f, const std::pair<int, int>& window) {
  constexpr double kEase_s = 0.25;
  return std::clamp(std::min(f - window.first, window.second - f) / (kEase_s * motion.rate_hz), 0.0, 1.0);
}

std::optional<Inserted> BentKnee(BodyMotion& motion, RandomStream& dice) {
  const auto window = Window(motion, 1.5, dice);
  if (!window) return std::nullopt;
  const bool is_left = dice.Chance(0.5);
  const auto of = [&](Role left) { return is_left ? left : Mirrored(left); };
  for (int f = window->first; f <= window->second; ++f) {
    BodyPose& pose = motion.poses[f];
    const glm::dvec3 thigh = UnitOr(pose[of(kLeftKnee)] - pose[of(kLeftHip)], {0, -1, 0});
    const glm::dvec3 shank = pose[of(kLeftAnkle)] - pose[of(kLeftKnee)],
                     toes = pose[of(kLeftFoot)] - pose[of(kLeftAnkle)];
    const glm::dvec3 axis = UnitOr(glm::cross(thigh, glm::cross(toes, thigh)), {0, 0, 1});
    const glm::dvec3 hinge = UnitOr(glm::cross(thigh, axis), {1, 0, 0});
    // Straighten the knee, then bend it towards the toes.
    const glm::dquat straight = glm::dquat(glm::normalize(shank), thigh);
    const glm::dquat back = glm::angleAxis(Radians(30), hinge) * straight;
    const glm::dquat turn = glm::slerp(glm::dquat(1, 0, 0, 0), back, Eased(motion, f, *window));
    pose[of(kLeftAnkle)] = pose[of(kLeftKnee)] + turn * shank;
    pose[of(kLeftFoot)] = pose[of(kLeftAnkle)] + turn * toes;
  }
  return Between(motion, window->first, window->second, of(kLeftKnee));
}

/// A hand passes through the chest for half a second; the arm keeps its lengths.
std::optional<Inserted> HandThroughChest(BodyMotion& motion, RandomStream& dice) {
  const auto window = Window(motion, 1, dice);
  if (!window) return std::nullopt;
  const bool is_left = dice.Chance(0.5);
  const auto of = [&](Role left) { return is_left ? left : Mirrored(left); };
  for (int f = window->first; f <= window->second; ++f) {
    BodyPose& pose = motion.poses[f];
    const double part = Eased(motion, f, *window);
    const glm::dvec3 shoulder = pose[of(kLeftShoulder)], chest = glm::mix(pose[kSpine], pose[kShoulderCentre], 0.4);
    const double upper = glm::distance(shoulder, pose[of(kLeftElbow)]);
    const double lower = glm::distance(pose[of(kLeftElbow)], pose[of(kLeftWrist)]);
    const glm::dvec3 hand = pose[of(kLeftHand)] - pose[of(kLeftWrist)];
    const glm::dvec3 wrist = glm::mix(pose[of(kLeftWrist)], chest, part);
    // The elbow moves to the nearest point on the circle that both lengths allow.
    const glm::dvec3 line = wrist - shoulder;
    const double reach = std::clamp(glm::length(line), std::abs(upper - lower) + 1e-3, upper + lower - 1e-3);
    const glm::dvec3 along = UnitOr(line, {0, -1, 0});
    const double share = (upper * upper - lower * lower + reach * reach) / (2 * reach);
    const double off = std::sqrt(std::max(upper * upper - share * share, 0.0));
    const glm::dvec3 old = pose[of(kLeftElbow)] - shoulder;
    const glm::dvec3 aside = UnitOr(old - glm::dot(old, along) * along, {0, 0, -1});
    pose[of(kLeftElbow)] = shoulder + share * along + off * aside;
    pose[of(kLeftWrist)] = shoulder + reach * along;
    pose[of(kLeftHand)] = pose[of(kLeftWrist)] + hand;
  }
  return Between(motion, window->first, window->second, of(kLeftWrist));
}

/// A part of the body is displaced by 40 cm for 1.5 s, in any direction.
Insert Torn(std::vector<Role> parts) {
  return [=](BodyMotion& motion, RandomStream& dice) -> std::optional<Inserted> {
    const auto window = Window(motion, 1.5, dice);
    if (!window) return std::nullopt;
    const bool is_left = dice.Chance(0.5);
    const glm::dvec3 by = 0.4 * UnitOr(dice.Normal3(), {0, 1, 0});
    for (int f = window->first; f <= window->second; ++f) {
      for (const Role part : parts) motion.poses[f][is_left ? part : Mirrored(part)] += by;
    }
    return Between(motion, window->first, window->second, is_left ? parts.front() : Mirrored(parts.front()));
  };
}

/// One foot drifts along the floor for two seconds. Only clips in which it then stands for a second show it.
Insert FootSkating(double speed) {
  return [=](BodyMotion& motion, RandomStream& dice) -> std::optional<Inserted> {
    const auto window = Window(motion, 2, dice);
    if (!window) return std::nullopt;
    const bool is_left = dice.Chance(0.5);
    const Role ankle = is_left ? kLeftAnkle : kRightAnkle, toes = is_left ? kLeftFoot : kRightFoot;
    int standing = 0;
    for (int f = window->first; f < window->second; ++f) {
      const double moved = glm::distance(motion.poses[f][ankle], motion.poses[f + 1][ankle]);
      standing += moved * motion.rate_hz < 0.05 && motion.poses[f][ankle].y < 0.2 ? 1 : 0;
    }
    if (standing < motion.rate_hz) return std::nullopt;
    const glm::dvec3 way = AlongFloor(dice);
    for (int f = window->first; f < static_cast<int>(motion.poses.size()); ++f) {
      const glm::dvec3 by = speed * (std::min(f, window->second) - window->first) / motion.rate_hz * way;
      for (const Role joint : {ankle, toes}) motion.poses[f][joint] += by;
    }
    return Between(motion, window->first, window->second, toes);
  };
}

struct Kind {
  const char* name;
  FaultKind fault;
  Insert insert;
};
const std::vector<Kind>& Kinds() {
  static const std::vector<Kind> kinds = {
      {"sinks 12 cm, 0.67 s", kSinks, Lifted(-0.12, 0.67)},
      {"sinks 12 cm, 0.4 s", kSinks, Lifted(-0.12, 0.4)},
      {"sinks 8 cm, half", kSinks, Lifted(-0.08, 0)},
      {"floats 6 cm, 2 s", kFloats, Lifted(0.06, 2)},
      {"floats 15 cm, always", kFloats, Lifted(0.15, -1)},
      {"skates 20 cm/s", kSkates, Skating(0.2)},
      {"skates 40 cm/s", kSkates, Skating(0.4)},
      {"skates 100 cm/s", kSkates, Skating(1)},
      {"jumps 50 cm", kJumps, Jump},
      {"hand pops 50 cm", kPops, Pop},
      {"rate x 2", kRate, OtherRate(2)},
      {"rate x 4", kRate, OtherRate(4)},
      {"rate x 1/2", kRate, OtherRate(0.5)},
      {"frozen 1 s", kFreezes, Frozen},
      {"limb stretches 5 %", kStretches, Stretched},
      {"torn hip", kTorn, Torn({kLeftHip, kLeftKnee, kLeftAnkle, kLeftFoot})},
      {"torn shoulder", kTorn, Torn({kLeftShoulder, kLeftElbow, kLeftWrist, kLeftHand})},
      {"torn neck", kTorn, Torn({kShoulderCentre, kHead})},
      {"torn toes", kTorn, Torn({kLeftFoot})},
      {"one foot skates", kSkates, FootSkating(0.3)},
      {"knee backwards 30°", kBends, BentKnee},
      {"hand through chest", kPasses, HandThroughChest}};
  return kinds;
}

bool Tells(const MotionFault& fault, FaultKind kind, const Inserted& inserted) {
  // A torn part also pops when it leaves its place and when it returns.
  const bool is_kind = fault.kind == kind || (kind == kTorn && fault.kind == kPops);
  if (!is_kind || (inserted.joint && fault.joint != inserted.joint)) return false;
  if (fault.kind == kPops && kind == kTorn) return std::abs(fault.from_s - inserted.from_s) < 0.5;
  if (kind == kRate) return true;  // the fault has the time of the flight that shows the wrong rate
  if (kind == kSkates && inserted.joint)
    return fault.to_s > inserted.from_s && fault.from_s < inserted.to_s;  // found while the foot skates
  // The fault covers at least half of the time, and its ends are at most half a second off.
  constexpr double kOff_s = 0.5;
  return std::abs(fault.from_s - inserted.from_s) < kOff_s && std::abs(fault.to_s - inserted.to_s) < kOff_s;
}

std::vector<TriedClip> LoadTried() {
  std::vector<std::string> references = {"builtin:*", "builtin:acts", "builtin:songs", "assimp:*"};
  if (const char* more = std::getenv("ETUDE_FAULT_CLIPS")) {
    std::istringstream lines(more);
    for (std::string line; std::getline(lines, line);) references.push_back(line);
  }
  std::vector<TriedClip> clips;
  for (const std::string& pattern : references) {
    const auto files = ExpandReference(pattern, {}, 100'000);
    if (!files) continue;
    for (const std::string& file : *files) {
      auto sources = ReadClips(file);
      if (!sources) continue;
      for (SourceClip& source : *sources) {
        std::string name = source.source;
        auto body = BodyInPlaceOf(std::move(source), {});
        if (!body || body->motion.poses.size() < kMinFramesForFaults) continue;
        FaultOptions options{.is_floor_known = body->is_floor_known,
                             .begin_s = body->begin_s,
                             .unseen = std::move(body->unseen),
                             .lost_before_s = body->lost_before_s,
                             .lost_after_s = body->lost_after_s,
                             .is_of_markers = body->is_of_markers};
        clips.push_back({std::move(name), std::move(body->motion), std::move(options)});
        clips.back().own = FindMotionFaults(clips.back().motion, clips.back().options);
      }
    }
  }
  return clips;
}

const std::vector<TriedClip>& Tried() {
  static const std::vector<TriedClip> clips = LoadTried();
  return clips;
}

TEST(InsertedFaults, HEAVY_AreFoundNamedAndDated) {
  constexpr int kOfEach = 12, kTries = 400;
  const bool is_chatty = std::getenv("ETUDE_FAULT_CLIPS") != nullptr;
  int all = 0, all_found = 0, others = 0;
  fmt::print("{:<22} {:>6} {:>6} {:>6} {:>7}\n", "inserted", "of", "found", "size", "beside");
  for (const Kind& kind : Kinds()) {
    RandomStream dice({.suite_seed = 61, .scenario = "insertions", .trial = 0}, kind.name);
    int count = 0, found = 0, sized = 0, beside = 0;
    for (int attempt = 0; attempt < kTries && count < (is_chatty ? 4 * kOfEach : kOfEach); ++attempt) {
      const TriedClip& clip = Tried()[dice.IndexBelow(Tried().size())];
      if (!clip.IsFaultless() || clip.IsDrawn()) continue;
      const bool is_always = std::string_view(kind.name).ends_with("always");
      if (is_always && clip.own.is_floor_found) continue;  // a floor found at the feet rises with the body
      BodyMotion motion = clip.motion;
      const auto inserted = kind.insert(motion, dice);
      if (!inserted) continue;
      ++count;
      const auto faults = FindMotionFaults(motion, clip.options).faults;
      const auto told =
          std::ranges::find_if(faults, [&](const MotionFault& fault) { return Tells(fault, kind.fault, *inserted); });
      const bool is_found = told != faults.end();
      const bool is_sized = is_found && (!inserted->size || std::abs(told->size / *inserted->size - 1) <= 0.1);
      found += is_found;
      sized += is_sized;
      const bool has_others = faults.size() > (is_found ? 1u : 0u);
      beside += has_others;
      if ((!is_sized || has_others) && is_chatty) {
        fmt::print("    {} [{:.2f} {:.2f}]: {}\n", clip.name, inserted->from_s, inserted->to_s,
                   fmt::join(FaultSentences(faults), "; "));
      }
    }
    fmt::print("{:<22} {:>6} {:>6} {:>6} {:>7}\n", kind.name, count, found, sized, beside);
    all += count;
    all_found += sized;
    others += beside;
  }
  fmt::print("{:<22} {:>6} {:>6} {:>6} {:>7}\n", "all", all, "", all_found, others);
  EXPECT_GT(all, 150);
  EXPECT_GE(all_found, 0.95 * all);
}

TEST(InsertedFaults, HEAVY_AreNotSeenWhereNothingWasInserted) {
  int with_lines = 0;
  for (const TriedClip& clip : Tried()) {
    if (clip.IsFaultless()) continue;
    ++with_lines;
    fmt::print("{}: {}\n", clip.name, fmt::join(FaultSentences(clip.own.faults), "; "));
  }
  fmt::print("{} of {} clips that nobody spoilt show a fault\n", with_lines, Tried().size());
  // Faults of users' clips are for people to inspect.
  if (std::getenv("ETUDE_FAULT_CLIPS") != nullptr) return;
  EXPECT_EQ(with_lines, 0);
}

}  // namespace
}  // namespace etude
