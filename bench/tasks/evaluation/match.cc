#include "bench/tasks/evaluation/match.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/model/reasons.h"
#include "bench/tasks/evaluation/common_joints.h"
#include "bench/tasks/evaluation/judged_frames.h"
#include "bench/tasks/evaluation/pair_doubts.h"
#include "engine/base/names.h"
#include "engine/base/order_statistics.h"

namespace etude {
namespace {

/// Returns the rotations of these joints in the first `frames` frames; none if the motion has no rotations.
std::vector<glm::dquat> TurnsOf(const RawMotion& motion, const std::vector<int>& joints, std::size_t frames) {
  std::vector<glm::dquat> turns;
  for (std::size_t f = 0; f < frames && !motion.rotations.empty(); ++f) {
    for (const int joint : joints) turns.push_back(motion.rotations[f * motion.joints.size() + joint]);
  }
  return turns;
}

/// Returns the positions of the joints with these roles; none if one of the joints is missing.
PointTracks RoleColumns(const RawMotion& motion, std::initializer_list<Role> roles, std::size_t frames) {
  std::vector<int> joints;
  for (const Role role : roles) joints.push_back(motion.roles[Index(role)]);
  const bool has_all = std::ranges::none_of(joints, [](int joint) { return joint < 0; });
  return has_all ? JointColumns(motion, joints, frames) : PointTracks{};
}

/// Finds the knees and elbows for which all three joints (above, middle, below) are among the judged joints.
std::vector<std::array<std::size_t, 3>> FindBends(const std::vector<CommonJoint>& joints, const RawMotion& truth) {
  using enum Role;
  constexpr std::array<std::array<Role, 3>, 4> kBends = {{{kLeftHip, kLeftKnee, kLeftAnkle},
                                                          {kRightHip, kRightKnee, kRightAnkle},
                                                          {kLeftShoulder, kLeftElbow, kLeftWrist},
                                                          {kRightShoulder, kRightElbow, kRightWrist}}};
  std::vector<std::array<std::size_t, 3>> bends;
  for (const auto& roles : kBends) {
    std::array<std::size_t, 3> bend{};
    bool has_all = true;
    for (std::size_t i = 0; i < roles.size(); ++i) {
      const int wanted = truth.roles[Index(roles[i])];
      const auto found =
          std::ranges::find_if(joints, [&](const CommonJoint& joint) { return wanted >= 0 && joint.truth == wanted; });
      has_all = has_all && found != joints.end();
      bend[i] = static_cast<std::size_t>(found - joints.begin());
    }
    if (has_all) bends.push_back(bend);
  }
  return bends;
}

/// Returns the columns of `angles` whose names are in `kept`.
AngleTracks Chosen(const AngleTracks& angles, const std::vector<std::string>& kept) {
  AngleTracks chosen{kept, {}};
  std::vector<std::size_t> columns;
  for (const std::string& name : kept) {
    columns.push_back(static_cast<std::size_t>(std::ranges::find(angles.names, name) - angles.names.begin()));
  }
  for (std::size_t row = 0; row < angles.degrees.size(); row += angles.names.size()) {
    for (const std::size_t column : columns) chosen.degrees.push_back(angles.degrees[row + column]);
  }
  return chosen;
}

/// Stores in `matched` the angles that both motions have.
void MatchAngles(const RawMotion& truth, const RawMotion& sampled, MatchedMotions& matched) {
  if (truth.rotations.empty() || sampled.rotations.empty()) return;
  const AngleTracks of_truth = AnglesOfRotations(truth), of_found = AnglesOfRotations(sampled);
  std::vector<std::string> common;
  for (const std::string& name : of_truth.names) {
    if (std::ranges::find(of_found.names, name) != of_found.names.end()) common.push_back(name);
  }
  if (common.empty()) return;
  matched.true_angles = Chosen(of_truth, common);
  matched.found_angles = Chosen(of_found, common);
}

/// Returns, for each judged joint, the index of its parent in `joints`; −1 if its parent is not among them. Parents are
/// found by the joints' roles, or by the truth's skeleton if there are no roles.
std::vector<int> FindParents(const std::vector<CommonJoint>& joints, const RawMotion& truth) {
  const auto place_of = [&](int joint) {
    const auto found = std::ranges::find(joints, joint, &CommonJoint::truth);
    return joint < 0 || found == joints.end() ? -1 : static_cast<int>(found - joints.begin());
  };
  std::vector<int> parents;
  for (const CommonJoint& joint : joints) {
    int parent = -1;
    const auto role = std::ranges::find(AllRoles(), joint.truth, [&](Role one) { return truth.roles[Index(one)]; });
    if (role != AllRoles().end()) {
      for (auto above = ParentOf(*role); above && parent < 0; above = ParentOf(*above)) {
        parent = place_of(truth.roles[Index(*above)]);
      }
    }
    for (int above = joint.truth; !truth.parents.empty() && parent < 0;) {
      above = truth.parents[static_cast<std::size_t>(above)];
      if (above < 0) break;
      parent = place_of(above);
    }
    parents.push_back(parent);
  }
  return parents;
}

/// Describes the lag, e.g. "the answer is 40.20 ms late (95 %: 39.80 to 40.60), which was removed".
std::string NoteOn(const TimeShift& lag) {
  constexpr double kToMs = 1000;
  const double ms = kToMs * lag.shift_s;
  std::string range;
  if (lag.half_width_s) {
    const double half = kToMs * *lag.half_width_s, low = std::abs(ms) - half, high = std::abs(ms) + half;
    range = fmt::format(" (95 %: {:.2f} to {:.2f})", low, high);
  }
  return fmt::format("the answer is {:.2f} ms {}{}, which was removed", std::abs(ms), ms < 0 ? "early" : "late", range);
}

/// Returns the name of the truth's root, or "midway between the hips"; "" if one of the motions has no root.
std::string RootOf(const RawMotion& truth, const RawMotion& answer) {
  const int of_truth = truth.roles[Index(Role::kHipCentre)];
  if (of_truth < 0 || answer.roles[Index(Role::kHipCentre)] < 0) return "";
  return HasOwnRoot(truth) ? truth.joints[static_cast<std::size_t>(of_truth)] : "midway between the hips";
}

/// Describes which joints are the roots; "" if one of the motions has no root. `of_truth` is RootOf.
std::string NoteOnRoots(const std::string& of_truth, const RawMotion& truth, const RawMotion& answer) {
  if (of_truth.empty()) return "";
  if (!HasOwnRoot(truth)) return ", root " + of_truth;
  const std::string& of_answer = answer.joints[static_cast<std::size_t>(answer.roles[Index(Role::kHipCentre)])];
  return of_answer == of_truth ? ", root " + of_truth
                               : fmt::format(", root {} of the truth, {} of the answer", of_truth, of_answer);
}

/// Returns a doubt on joints whose distance from the truth hardly varies and is far larger than that of most joints:
/// they may be different points of the body. "" if there are none.
std::string DoubtOnStrangers(const MatchedMotions& matched) {
  constexpr double kMin_m = 0.05, kTimes = 4, kSteady = 0.25;  // tolerances (ours)
  const std::size_t joints = matched.joints.size();
  std::vector<double> means, spreads;
  for (std::size_t j = 0; j < joints; ++j) {
    double count = 0, sum = 0, squares = 0;
    for (std::size_t at = j; at < matched.pair.truth.positions.size(); at += joints) {
      const double error = glm::distance(matched.pair.truth.positions[at], matched.pair.found.positions[at]);
      if (std::isnan(error)) continue;
      count += 1;
      sum += error;
      squares += error * error;
    }
    means.push_back(count > 0 ? sum / count : 0);
    spreads.push_back(count > 0 ? std::sqrt(std::max(squares / count - means.back() * means.back(), 0.0)) : 0);
  }
  const double median = Median(means);
  std::vector<std::string> strangers;
  for (std::size_t j = 0; j < joints; ++j) {
    if (means[j] < std::max(kMin_m, kTimes * median) || spreads[j] > kSteady * means[j]) continue;
    strangers.push_back(fmt::format("{} {:.0f} mm", matched.joints[j], 1000 * means[j]));
  }
  if (strangers.empty()) return "";
  return fmt::format(
      "{} away from the truth in all frames (median joint {:.1f} mm): is it the same point in both files?",
      SomeOf(strangers), 1000 * median);
}

/// Returns a note on the positions that one of the motions lacks, which no mean includes; "" if it lacks none. `who` is
/// "the truth" or "the answer". `is_asked` returns true for the frames and joints that the motion should have.
template <typename IsAsked>
std::string NoteOnUnseen(std::string_view who, const PointTracks& tracks, const std::vector<std::string>& joints,
                         const IsAsked& is_asked) {
  std::size_t asked = 0, unseen = 0, frames = 0, empty_frames = 0;
  std::vector<std::size_t> asked_of(joints.size()), seen_of(joints.size());
  for (std::size_t f = 0; f < tracks.FrameCount(); ++f) {
    std::size_t asked_here = 0, seen_here = 0;
    for (std::size_t j = 0; j < joints.size(); ++j) {
      if (!is_asked(f, j)) continue;
      const bool is_seen = !std::isnan(tracks.Frame(f)[j].x);
      ++asked_here;
      ++asked_of[j];
      seen_here += is_seen ? 1 : 0;
      seen_of[j] += is_seen ? 1 : 0;
    }
    asked += asked_here;
    unseen += asked_here - seen_here;
    frames += asked_here > 0 ? 1 : 0;
    empty_frames += asked_here > 0 && seen_here == 0 ? 1 : 0;
  }
  if (unseen == 0) return "";
  std::vector<std::string> never;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    if (asked_of[j] > 0 && seen_of[j] == 0) never.push_back(joints[j]);
  }
  const double percent = 100 * static_cast<double>(unseen) / static_cast<double>(asked);
  std::string note =
      fmt::format(", {} has no value for {:.3g} % of the joints and frames, which no mean includes", who, percent);
  if (empty_frames > 0) note += fmt::format(", and no joint in {} of {} frames", empty_frames, frames);
  if (!never.empty()) note += fmt::format(", and never shows {}", Join(never));
  return note;
}

/// Returns notes on the positions that the truth lacks, and on those that the truth has and the answer lacks. Frames
/// outside the answer (`is_covered` is false) do not count; they have a note of their own.
std::string NoteOnUnseen(const MatchedMotions& matched, const std::vector<bool>& is_covered) {
  const PointTracks &truth = matched.pair.truth, &found = matched.pair.found;
  return NoteOnUnseen("the truth", truth, matched.joints, [](std::size_t, std::size_t) { return true; }) +
         NoteOnUnseen("the answer", found, matched.joints,
                      [&](std::size_t f, std::size_t j) { return is_covered[f] && !std::isnan(truth.Frame(f)[j].x); });
}

std::string NoteOn(const RawMotion& truth, const RawMotion& answer, const std::string& clock,
                   const MatchedMotions& matched, const std::vector<bool>& is_covered) {
  const auto count = [](auto number, std::string_view thing) {
    return fmt::format("{} {}{}", number, thing, number == 1 ? "" : "s");
  };
  std::string note = count(matched.joints.size(), "joint");
  if (!matched.lacking.empty()) note += fmt::format(" (not found in both files: {})", SomeOf(matched.lacking));
  if (!matched.lacking.empty() && !matched.also_held.empty()) {
    note += fmt::format(", both files also contain {}, which are not judged (--joints same judges them)",
                        SomeOf(matched.also_held));
  }
  note += NoteOnRoots(matched.root, truth, answer);
  note += fmt::format(", {} at {:g} Hz", count(matched.pair.truth.FrameCount(), "frame"), matched.pair.rate_hz);
  if (!HaveSameRate(truth, answer)) {
    note += fmt::format(" (the truth has {:g} Hz, the answer {:g} Hz)", truth.rate_hz, answer.rate_hz);
  }
  if (matched.is_interpolated) note += ", for which the truth was interpolated, so acceleration errors have no value";
  if (matched.lag) note += ", " + NoteOn(*matched.lag);
  if (!clock.empty()) note += ", " + clock;
  // One surplus frame is not mentioned: in motions of equal length, the answer's last frame lies after the truth's last
  // frame if the answer has the higher rate.
  if (matched.surplus > 1) note += fmt::format(", {} frames of the answer outside the truth", matched.surplus);
  if (matched.uncovered > 0)
    note += fmt::format(", {} of the truth outside the answer", count(matched.uncovered, "frame"));
  note += NoteOnUnseen(matched, is_covered);
  for (const RawMotion* motion : {&truth, &answer}) {
    const std::vector<std::string> notes = NotesWithoutDoubts(motion->notes, motion->doubts);  // doubts end the reason
    if (notes.empty()) continue;
    note += fmt::format("; {}: {}", motion == &truth ? "truth" : "answer", Join(notes, "; "));
  }
  return note;
}

/// Returns the motion at these frames (AtFrames). If they are exactly its own, returns the motion itself; `changed`
/// holds any other result.
const RawMotion& At(const RawMotion& motion, const std::vector<double>& frames, double rate_hz, RawMotion& changed) {
  bool is_own = frames.size() == motion.FrameCount();
  for (std::size_t i = 0; i < frames.size() && is_own; ++i) is_own = frames[i] == static_cast<double>(i);
  if (is_own) return motion;
  return changed = AtFrames(motion, frames, rate_hz, Inbetween::kCubic);
}

/// Stores in `pair` everything that is known of the answer at its frames `found`.
void TakeAnswer(const RawMotion& found, const std::vector<int>& joints, EvaluatedPair& pair) {
  const std::size_t frames = found.FrameCount();
  pair.found = JointColumns(found, joints, frames);
  pair.found_turns = TurnsOf(found, joints, frames);
  pair.found_root = RoleColumns(found, {Role::kHipCentre}, frames).positions;
  pair.feet = RoleColumns(found, {Role::kLeftAnkle, Role::kLeftFoot, Role::kRightAnkle, Role::kRightFoot}, frames);
  pair.found_contacts = found.contacts;
}

/// Stores in `matched` how many frames of the truth lie outside the answer, and of the answer outside the truth. The
/// truth's first frame is at `start_s` of the answer.
void CountOutside(const RawMotion& truth, const RawMotion& answer, double start_s, MatchedMotions& matched) {
  constexpr double kRounding = 0.01, kHalf = 0.5;  // tolerances in frames; kRounding as in FramesToJudge
  const double last_of_truth = static_cast<double>(truth.FrameCount()) - 1,
               last_of_answer = static_cast<double>(answer.FrameCount()) - 1;
  for (std::size_t f = 0; f < truth.FrameCount(); ++f) {
    const double at = (start_s + static_cast<double>(f) / truth.rate_hz) * answer.rate_hz;
    if (at < -kRounding || at > last_of_answer + kRounding) ++matched.uncovered;
  }
  for (std::size_t f = 0; f < answer.FrameCount(); ++f) {
    const double at = (static_cast<double>(f) / answer.rate_hz - start_s) * truth.rate_hz;
    if (at < -kHalf || at > last_of_truth + kHalf) ++matched.surplus;
  }
}

}  // namespace

Result<MatchedMotions> Match(const RawMotion& given_truth, const RawMotion& given_answer, std::string_view set,
                             Lag lag) {
  RawMotion changed_truth, changed_answer;
  const auto both = WithCommonRoles(given_truth, given_answer, changed_truth, changed_answer);
  const RawMotion &truth = both.first, &answer = both.second;
  // Find the joints that both motions have.
  MatchedMotions matched;
  std::vector<CommonJoint> lacking;
  const std::vector<CommonJoint> common = FindCommon(truth, answer, set, lacking);
  RETURN_IF_ERROR(CheckCommon(truth, answer, common.size(), set));
  matched.also_held = FindAlsoHeld(truth, answer, common);
  std::vector<int> of_truth, of_answer;
  for (const CommonJoint& joint : common) {
    matched.joints.push_back(joint.name);
    of_truth.push_back(joint.truth);
    of_answer.push_back(joint.answer);
  }
  // Find the time at which they are paired.
  const std::size_t frames = truth.FrameCount();
  const double truth_rate_hz = HaveSameRate(truth, answer) ? answer.rate_hz : truth.rate_hz;
  const StatedOffset clock = OffsetOf(truth, answer);
  if (lag == Lag::kFind) {
    matched.lag = FindLag({truth, of_truth}, {answer, of_answer}, -clock.seconds);
    if (!matched.lag) {
      return Fail({answer.name},
                  "no lag within ±{:g} s is found: the motion is too short, the body stands still or moves evenly, the "
                  "answer's clock drifts, or the answer moves differently at every lag in that range",
                  kMaxTimeShift_s);
    }
  }
  // Take the answer's own frames, and the truth at their times.
  const double start_s = (matched.lag ? matched.lag->shift_s : 0) - clock.seconds;
  const JudgedFrames judged = FramesToJudge(truth, answer, start_s);
  RawMotion changed_frames, found_frames;
  const RawMotion& true_at = At(truth, judged.of_truth, judged.rate_hz, changed_frames);
  const RawMotion& found_at = At(answer, judged.of_answer, judged.rate_hz, found_frames);
  const std::size_t count = judged.of_truth.size();
  matched.is_interpolated = judged.is_interpolated;
  matched.is_even = judged.is_even;
  matched.pair.rate_hz = judged.rate_hz;
  matched.pair.truth = JointColumns(true_at, of_truth, count);
  matched.pair.true_turns = TurnsOf(true_at, of_truth, count);
  matched.pair.true_root = RoleColumns(true_at, {Role::kHipCentre}, count).positions;
  matched.pair.true_contacts = true_at.contacts;
  TakeAnswer(found_at, of_answer, matched.pair);
  if (matched.pair.true_root.empty() || matched.pair.found_root.empty()) {
    matched.pair.true_root.clear();
    matched.pair.found_root.clear();
  }
  // Keep the motions to show, and all of the answer's own frames.
  if (judged.rate_hz != truth_rate_hz || judged.is_interpolated || !judged.own.empty()) {
    matched.shown = {JointColumns(truth, of_truth, frames),
                     JointColumns(Sampled(answer, truth_rate_hz, start_s, frames), of_answer, frames), truth_rate_hz};
  }
  if (count > 0) matched.own_start_s = judged.of_truth.front() / truth_rate_hz;
  if (!judged.own.empty()) {
    matched.own_start_s = judged.own.front() / answer.rate_hz - start_s;
    RawMotion own_frames;
    matched.own.emplace().rate_hz = answer.rate_hz;
    TakeAnswer(At(answer, judged.own, answer.rate_hz, own_frames), of_answer, *matched.own);
    if (matched.pair.found_root.empty()) matched.own->found_root.clear();
  }
  // Describe what was judged, and what was not.
  for (const CommonJoint& joint : lacking) {
    matched.lacking.push_back(joint.name);
    for (std::size_t f = 0; f < count && joint.truth >= 0; ++f) {
      matched.pair.without_joint += IsSeen(true_at.At(f, static_cast<std::size_t>(joint.truth))) ? 1 : 0;
    }
  }
  matched.root = RootOf(truth, answer);
  matched.bends = FindBends(common, truth);
  matched.parents = FindParents(common, truth);
  MatchAngles(true_at, found_at, matched);
  CountOutside(truth, answer, start_s, matched);
  if (SeenShare(matched.pair).value_or(0) == 0) {
    return Fail({answer.name}, "no joint of '{}' is ever seen in both motions", truth.name);
  }
  std::vector<bool> is_covered;
  for (const double frame : judged.of_answer) {
    is_covered.push_back(frame >= 0 && frame <= static_cast<double>(answer.FrameCount()) - 1);
  }
  matched.truth_begin_s = truth.start_s.value_or(0);
  const bool may_find_lag = !clock.note.empty() && lag == Lag::kNone;
  const std::string of_clocks = clock.note + (may_find_lag ? " (--lag find searches the lag)" : "");
  matched.note = NoteOn(truth, answer, of_clocks, matched, is_covered);
  matched.doubts = DoubtsOnPair({truth, of_truth}, {answer, of_answer}, matched, start_s);
  if (std::string doubt = DoubtOnStrangers(matched); !doubt.empty()) matched.doubts.push_back(std::move(doubt));
  return matched;
}

}  // namespace etude
