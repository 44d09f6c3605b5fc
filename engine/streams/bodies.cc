#include "engine/streams/bodies.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "engine/base/order_statistics.h"

namespace etude {
namespace {

/// Two bodies that may be one person, and their distance in trunk lengths.
struct Pair {
  double gap;
  std::size_t before, after;
};

std::string NameOf(const std::string& id) { return id.empty() ? "without an id" : id; }

}  // namespace

void Bodies::Add(std::string_view id, std::size_t frame, const RolePositions& places,
                 const std::array<TrackingState, kRoleCount>& states) {
  if (!pending_.empty() && pending_.front().frames.front().frame != frame) Assign();
  const auto earlier = ids_.find(id);
  pending_.push_back({earlier == ids_.end() ? std::string(id) : earlier->second, {{frame, places, states}}});
}

void Bodies::FollowExchange() {
  constexpr double kMinGap = 0.25, kMuchNearer = 0.3;  // in trunk lengths; a share of the distance
  const auto before = [&](const Body& body) -> const Seen* {
    const auto known = std::ranges::find(bodies_, body.id, &Body::id);
    const bool is_last = known != bodies_.end() && known->frames.back().frame + 1 == body.frames.front().frame;
    return is_last && !body.id.empty() ? &known->frames.back() : nullptr;
  };
  for (std::size_t a = 0; a < pending_.size(); ++a) {
    for (std::size_t b = a + 1; b < pending_.size(); ++b) {
      const Seen *was_a = before(pending_[a]), *was_b = before(pending_[b]);
      if (pending_[a].id == pending_[b].id || was_a == nullptr || was_b == nullptr) continue;
      const Seen &is_a = pending_[a].frames.front(), &is_b = pending_[b].frames.front();
      const auto kept_a = GapInTrunks(*was_a, is_a), kept_b = GapInTrunks(*was_b, is_b);
      const auto other_a = GapInTrunks(*was_b, is_a), other_b = GapInTrunks(*was_a, is_b);
      if (!kept_a || !kept_b || !other_a || !other_b || std::min(*kept_a, *kept_b) < kMinGap) continue;
      if (*other_a > kMuchNearer * *kept_a || *other_b > kMuchNearer * *kept_b) continue;
      // Exchange the names back, in this frame and in all later ones.
      exchanged_.push_back({pending_[a].id, is_a.frame});
      for (const std::size_t i : {a, b}) ids_.try_emplace(pending_[i].id, pending_[i].id);
      for (auto& [given, earlier] : ids_) {
        if (earlier == pending_[a].id) {
          earlier = pending_[b].id;
        } else if (earlier == pending_[b].id) {
          earlier = pending_[a].id;
        }
      }
      std::swap(pending_[a].id, pending_[b].id);
    }
  }
}

void Bodies::Assign() {
  FollowExchange();
  while (!pending_.empty()) {
    // Take the bodies that have the first one's identifier.
    const std::string id = pending_.front().id;
    const auto others = std::ranges::stable_partition(pending_, [&](const Body& body) { return body.id == id; });
    std::vector<Body> same(pending_.begin(), others.begin());
    pending_.erase(pending_.begin(), others.begin());
    if (same.size() > 1 && !ambiguous_) ambiguous_ = Ambiguous{id, same.front().frames.front().frame};
    AssignByNearness(same);
  }
}

void Bodies::AssignByNearness(const std::vector<Body>& same) {
  // Measure the distances from the earlier bodies of this identifier. Without a trunk, a distance is unknown.
  std::vector<Pair> pairs;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    if (bodies_[b].id != same.front().id) continue;
    for (std::size_t i = 0; i < same.size(); ++i) {
      const auto gap = GapInTrunks(bodies_[b].frames.back(), same[i].frames.front());
      pairs.push_back({gap.value_or(std::numeric_limits<double>::infinity()), b, i});
    }
  }
  // Continue the nearest bodies first; the others are new.
  std::ranges::stable_sort(pairs, {}, &Pair::gap);
  std::vector<bool> continued(bodies_.size(), false), placed(same.size(), false);
  for (const Pair& pair : pairs) {
    if (continued[pair.before] || placed[pair.after]) continue;
    continued[pair.before] = placed[pair.after] = true;
    bodies_[pair.before].frames.push_back(same[pair.after].frames.front());
  }
  for (std::size_t i = 0; i < same.size(); ++i) {
    if (!placed[i]) bodies_.push_back(same[i]);
  }
}

double Bodies::SpreadOf(const Body& body) {
  constexpr std::size_t kMaxBlock = 10, kMinBlocks = 6;
  constexpr double kTail = 0.05;
  const std::size_t block = std::clamp<std::size_t>(body.frames.size() / kMinBlocks, 1, kMaxBlock);
  // Measure the trunk, which limits a step.
  std::vector<double> trunks;
  for (const Seen& seen : body.frames) {
    const auto &hips = seen.places[Index(Role::kHipCentre)], &neck = seen.places[Index(Role::kShoulderCentre)];
    if (hips && neck) trunks.push_back(glm::distance(*hips, *neck));
  }
  const double max_step = trunks.empty() ? std::numeric_limits<double>::infinity() : UpperMedian(std::move(trunks));
  double spread = 0;
  for (std::size_t i = 0; i < kRoleCount; ++i) {
    // Collect the joint's places, each relative to where it would be without jumps, block by block.
    std::array<std::vector<double>, 3> of_block, medians;
    glm::dvec3 shift(0);
    const Seen* before = nullptr;
    for (std::size_t t = 0; t < body.frames.size(); ++t) {
      const Seen& now = body.frames[t];
      if (now.places[i]) {
        const glm::dvec3 step = before == nullptr ? glm::dvec3(0) : *now.places[i] - *before->places[i];
        const double frames = before == nullptr ? 1 : static_cast<double>(now.frame - before->frame);
        if (glm::length(step) > max_step * frames) shift -= step;
        before = &now;
        for (int axis = 0; axis < 3; ++axis) of_block[axis].push_back((*now.places[i] + shift)[axis]);
      }
      const bool is_end = (t + 1) % block == 0 || t + 1 == body.frames.size();
      for (int axis = 0; is_end && axis < 3; ++axis) {
        if (!of_block[axis].empty()) medians[axis].push_back(Median(std::exchange(of_block[axis], {})));
      }
    }
    if (before == nullptr) continue;
    glm::dvec3 size(0);
    for (int axis = 0; axis < 3; ++axis)
      size[axis] = Quantile(medians[axis], 1 - kTail) - Quantile(medians[axis], kTail);
    spread += glm::dot(size, size);
  }
  return spread;
}

/// Returns the mean distance, in trunk lengths, between the joints that are in both frames; nullopt if a frame lacks
/// the trunk.
std::optional<double> Bodies::GapInTrunks(const Seen& before, const Seen& after) {
  const auto &hips = before.places[Index(Role::kHipCentre)], &neck = before.places[Index(Role::kShoulderCentre)];
  double sum = 0;
  int joints = 0;
  for (std::size_t i = 0; i < kRoleCount; ++i) {
    if (!before.places[i] || !after.places[i]) continue;
    sum += glm::distance(*before.places[i], *after.places[i]);
    ++joints;
  }
  if (joints == 0 || !hips || !neck || *hips == *neck) return std::nullopt;
  return sum / joints / glm::distance(*hips, *neck);
}

void Bodies::JoinContinued(StreamRecording& recording) {
  constexpr double kMaxBreak_s = 1, kMaxEmptyBreak_s = 3, kMaxGap = 0.5;
  std::vector<bool> shows(recording.frames.size(), false);
  for (const Body& body : bodies_) {
    for (const Seen& seen : body.frames) shows[seen.frame] = true;
  }
  // Collect the pairs in which the second body can continue the first.
  std::vector<Pair> pairs;
  const auto begin_of = [](const Body& body) { return body.frames.front().frame; };
  for (std::size_t a = 0; a < bodies_.size(); ++a) {
    const Seen& end = bodies_[a].frames.back();
    const auto first = std::ranges::upper_bound(bodies_, end.frame, {}, begin_of);  // sorted by first appearance
    for (auto b = static_cast<std::size_t>(first - bodies_.begin()); b < bodies_.size(); ++b) {
      const Seen& begin = bodies_[b].frames.front();
      const auto after = shows.begin() + static_cast<std::ptrdiff_t>(end.frame) + 1;
      const bool is_empty = std::find(after, shows.begin() + static_cast<std::ptrdiff_t>(begin.frame), true) ==
                            shows.begin() + static_cast<std::ptrdiff_t>(begin.frame);
      const double max_break_s = is_empty ? kMaxEmptyBreak_s : kMaxBreak_s;
      if (recording.frames[begin.frame].time_s - recording.frames[end.frame].time_s > max_break_s) break;
      const auto gap = GapInTrunks(end, begin);
      if (gap && *gap <= kMaxGap) pairs.push_back({*gap, a, b});
    }
  }
  // Accept the nearest pairs first.
  std::ranges::stable_sort(pairs, {}, &Pair::gap);
  std::vector<std::optional<std::size_t>> next(bodies_.size());
  std::vector<bool> continues(bodies_.size(), false);
  for (const Pair& pair : pairs) {
    if (next[pair.before] || continues[pair.after]) continue;
    next[pair.before] = pair.after;
    continues[pair.after] = true;
  }
  // Join the bodies of each chain of accepted pairs.
  std::vector<Body> joined;
  for (std::size_t a = 0; a < bodies_.size(); ++a) {
    if (continues[a]) continue;
    Body body = std::move(bodies_[a]);
    for (auto b = next[a]; b; b = next[*b]) {
      const Body& later = bodies_[*b];
      recording.remarks.push_back(
          fmt::format("body {} continues as body {} from frame {} on; Etude reads both as one person", NameOf(body.id),
                      NameOf(later.id), begin_of(later)));
      body.frames.insert(body.frames.end(), later.frames.begin(), later.frames.end());
      body.id = later.id;
    }
    joined.push_back(std::move(body));
  }
  bodies_ = std::move(joined);
}

Result<void> Bodies::Choose(const StreamReading& reading, const std::string& file, StreamRecording& recording) {
  Assign();
  if (bodies_.empty()) return {};
  if (ambiguous_) {
    recording.remarks.push_back(
        fmt::format("several bodies of one frame have {} (first in frame {}); Etude reads each of these bodies as the "
                    "nearest body of the frames before",
                    ambiguous_->id.empty() ? "no id" : "the id " + ambiguous_->id, ambiguous_->frame));
  }
  if (!exchanged_.empty()) {
    const std::size_t more = exchanged_.size() - 1;
    recording.remarks.push_back(fmt::format(
        "two bodies exchange ids in frame {} (one id is {}){}; Etude still reads each body as the same person",
        exchanged_.front().frame, exchanged_.front().id, more > 0 ? fmt::format(", and {} times more", more) : ""));
  }
  JoinContinued(recording);
  // Choose the requested body, or the most frequent one.
  std::size_t chosen = 0;
  if (reading.body) {
    chosen = static_cast<std::size_t>(*reading.body);
    if (chosen >= bodies_.size())
      return Fail({file}, "there is no body {}; the file has {} bodies, counted from 0", chosen, bodies_.size());
  } else {
    for (std::size_t b = 1; b < bodies_.size(); ++b) {
      const std::size_t most = bodies_[chosen].frames.size(), here = bodies_[b].frames.size();
      if (here > most || (here == most && SpreadOf(bodies_[b]) > SpreadOf(bodies_[chosen]))) chosen = b;
    }
  }
  if (bodies_.size() > 1) {
    const std::size_t most = bodies_[chosen].frames.size();
    const auto ties = std::ranges::count_if(bodies_, [&](const Body& body) { return body.frames.size() == most; });
    const std::string why = ties > 1
                                ? fmt::format(", because it moves most ({} bodies are in equally many frames)", ties)
                                : ", because it is in the most frames";
    // Count the frames that show only other bodies.
    std::vector<bool> others(recording.frames.size(), false);
    for (const Body& body : bodies_) {
      for (const Seen& seen : body.frames) others[seen.frame] = true;
    }
    for (const Seen& seen : bodies_[chosen].frames) others[seen.frame] = false;
    const auto only_others = std::ranges::count(others, true);
    recording.remarks.push_back(fmt::format(
        "the file has {} bodies; Etude reads body {}{}{}", bodies_.size(), chosen, reading.body ? "" : why,
        only_others > 0 ? fmt::format("; {} of {} frames show only other bodies", only_others, others.size()) : ""));
  }
  // Copy the joints of the chosen body to the recording.
  for (const Seen& seen : bodies_[chosen].frames) {
    recording.frames[seen.frame].places = seen.places;
    recording.frames[seen.frame].states = seen.states;
  }
  return {};
}

}  // namespace etude
