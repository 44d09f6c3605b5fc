#include "engine/retargeting/anatomy.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "engine/retargeting/joint_names.h"

namespace etude {
namespace {

using enum Role;

/// Returns 1 if `ratio` lies between `low` and `high`. Outside of that range, returns a Gaussian of the ratio's
/// logarithm; returns 0 if the ratio is not finite or not positive.
double RangeScore(double ratio, double low, double high) {
  if (!std::isfinite(ratio) || ratio <= 0) return 0;
  constexpr double kFallOff = 0.25;
  const double off = std::max({std::log(low / ratio), std::log(ratio / high), 0.0}) / kFallOff;
  return std::exp(-off * off);
}

glm::dvec3 DirectionOf(const glm::dvec3& v) {
  const double length = glm::length(v);
  return length > 0 ? v / length : glm::dvec3(0);
}

/// The path along the bones from a joint to the farthest of its descendants.
struct Chain {
  std::vector<int> joints;
  double length = 0;  ///< the sum of the lengths of the chain's bones
};

/// Two siblings with equally long chains.
struct ChainPair {
  std::array<Chain, 2> chains;
};

/// The upper, middle and end joints of a pair of limbs, as indices along the two chains.
struct Limbs {
  const ChainPair* pair = nullptr;
  std::array<std::size_t, 3> at{};
  double score = 0;

  int Joint(std::size_t side, std::size_t i) const { return pair->chains[side].joints[at[i]]; }
  int Tip(std::size_t side) const { return pair->chains[side].joints.back(); }
};

/// The plausible ranges of a limb's proportions. Of two candidates within a range, the candidate nearer to the range's
/// middle is taken.
struct Proportions {
  double upper_low, upper_high;  ///< length of the upper bone ÷ length of the lower bone
  double end_low, end_high;      ///< length of the chain beyond the lower bone ÷ length of the lower bone
  double skipped_high;           ///< length of the chain before the upper bone ÷ length of the upper bone
};
constexpr Proportions kLegProportions{0.8, 1.25, 0.15, 0.75, 0.35};
constexpr Proportions kArmProportions{0.8, 1.45, 0.2, 1.2, 1.0};

class AnatomyFinder {
 public:
  explicit AnatomyFinder(const SkeletonTree& tree) : tree_(tree), below_(static_cast<std::size_t>(tree.size())) {
    // Compute the longest chain below every joint, from the last joint to the first.
    for (int i = tree.size() - 1; i >= 0; --i) {
      below_[i].joints.insert(below_[i].joints.begin(), i);
      const int parent = tree.ParentOf(i);
      if (parent < 0) continue;
      const double length = below_[i].length + glm::distance(tree.RestOf(i), tree.RestOf(parent));
      // Siblings are visited from last to first, so of two equally long chains the chain of the first sibling is
      // kept. (If both have length 0, the last sibling's is kept.)
      if (length < below_[parent].length || (length == 0 && !below_[parent].joints.empty())) continue;
      below_[parent] = {below_[i].joints, length};
    }
  }

  AnatomyProposal Propose() const {
    AnatomyProposal best{.joints = {}, .confidence = 0};
    best.joints.fill(-1);
    const std::vector<ChainPair> pairs = Pairs();
    double second = 0;
    // Score every two pairs as legs and arms; remember the best and the second best score.
    for (const ChainPair& legs : pairs) {
      for (const ChainPair& arms : pairs) {
        if (&legs == &arms || AreNested(legs, arms)) continue;
        const AnatomyProposal proposal = Judge(legs, arms);
        second = std::max(second, std::min(proposal.confidence, best.confidence));
        if (proposal.confidence > best.confidence) best = proposal;
      }
    }
    // Reduce the confidence by the score of the second best choice; an equally good second choice halves it.
    if (best.confidence > 0) best.confidence *= 1 - 0.5 * second / best.confidence;
    return best;
  }

 private:
  /// Lists up to eight pairs of siblings with the longest chains.
  std::vector<ChainPair> Pairs() const {
    constexpr std::size_t kMaxPairs = 8, kMinJoints = 3;
    constexpr double kMaxLengthDifference = 0.05;
    std::vector<ChainPair> pairs;
    for (int a = 0; a < tree_.size(); ++a) {
      for (int b = a + 1; b < tree_.size(); ++b) {
        if (tree_.ParentOf(a) < 0 || tree_.ParentOf(a) != tree_.ParentOf(b)) continue;
        const Chain &one = below_[a], &other = below_[b];
        const bool is_alike = std::abs(one.length - other.length) <= kMaxLengthDifference * one.length &&
                              one.joints.size() == other.joints.size() && one.joints.size() >= kMinJoints;
        if (is_alike && one.length > 0) pairs.push_back({{one, other}});
      }
    }
    std::ranges::stable_sort(pairs, std::ranges::greater(),
                             [](const ChainPair& pair) { return pair.chains[0].length; });
    if (pairs.size() > kMaxPairs) pairs.resize(kMaxPairs);
    return pairs;
  }

  bool AreNested(const ChainPair& a, const ChainPair& b) const {
    const auto within = [&](const Chain& inner, const Chain& outer) {
      const int joint = inner.joints.front(), top = outer.joints.front();
      return joint == top || tree_.DescendsFrom(joint, top);
    };
    return std::ranges::any_of(a.chains, [&](const Chain& one) {
      return std::ranges::any_of(b.chains,
                                 [&](const Chain& other) { return within(one, other) || within(other, one); });
    });
  }

  double Bone(int from, int to) const { return glm::distance(tree_.RestOf(from), tree_.RestOf(to)); }

  /// Finds the three joints along a pair of chains that fit the proportions best.
  Limbs FindLimbs(const ChainPair& pair, const Proportions& wanted) const {
    Limbs best{.pair = &pair};
    double best_rank = 0;
    const std::vector<int>& chain = pair.chains[0].joints;
    constexpr std::size_t kMaxChain = 20;  // joints farther along the chain are fingers, or not part of a limb
    const std::size_t count = std::min(chain.size(), kMaxChain);
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t j = i + 1; j < count; ++j) {
        for (std::size_t k = j + 1; k < count; ++k) {
          // The score is the product of the proportions' scores and of the symmetry score.
          const double upper = Bone(chain[i], chain[j]), lower = Bone(chain[j], chain[k]);
          const double end = Bone(chain[k], chain.back()), skipped = Bone(chain[0], chain[i]);
          constexpr double kNoEnd = 0.8;
          const double score = RangeScore(upper / lower, wanted.upper_low, wanted.upper_high) *
                               (end > 0 ? RangeScore(end / lower, wanted.end_low, wanted.end_high) : kNoEnd) *
                               (skipped > 0 ? RangeScore(skipped / upper, 1e-9, wanted.skipped_high) : 1) *
                               SymmetryScore(pair, i, j, k);
          // Among equal scores, prefer limbs whose proportions are near the middle of the ranges.
          const double ratio = std::log(upper / lower / std::sqrt(wanted.upper_low * wanted.upper_high));
          const double ending = end > 0 ? std::log(end / lower / std::sqrt(wanted.end_low * wanted.end_high)) : 0;
          const double rank = score * std::exp(-0.1 * (ratio * ratio + 0.3 * ending * ending));
          if (!(rank > best_rank)) continue;  // NaN from bones without length is never accepted
          best_rank = rank;
          best.at = {i, j, k};
          best.score = score;
        }
      }
    }
    return best;
  }

  /// Returns a score for the symmetry of a pair of limbs: how well the lengths of left and right bones agree.
  double SymmetryScore(const ChainPair& pair, std::size_t i, std::size_t j, std::size_t k) const {
    constexpr double kLow = 0.95;
    const auto& [one, other] = pair.chains;
    return RangeScore(Bone(one.joints[i], one.joints[j]) / Bone(other.joints[i], other.joints[j]), kLow, 1 / kLow) *
           RangeScore(Bone(one.joints[j], one.joints[k]) / Bone(other.joints[j], other.joints[k]), kLow, 1 / kLow);
  }

  glm::dvec3 Middle(const Limbs& limbs, std::size_t i) const {
    return 0.5 * (tree_.RestOf(limbs.Joint(0, i)) + tree_.RestOf(limbs.Joint(1, i)));
  }

  /// Returns true if there is a joint beyond the neck, in the direction of the trunk, that belongs to no limb.
  bool HasHead(const Limbs& legs, const Limbs& arms, const glm::dvec3& neck, const glm::dvec3& up, double trunk) const {
    for (int joint = 0; joint < tree_.size(); ++joint) {
      const glm::dvec3 from_neck = tree_.RestOf(joint) - neck;
      const bool is_on = glm::dot(from_neck, up) > 0.15 * trunk && glm::dot(DirectionOf(from_neck), up) > 0.8;
      const auto is_of = [&](const Limbs& limbs) {
        return std::ranges::any_of(limbs.pair->chains, [&](const Chain& chain) {
          return joint == chain.joints.front() || tree_.DescendsFrom(joint, chain.joints.front());
        });
      };
      if (is_on && !is_of(legs) && !is_of(arms)) return true;
    }
    return false;
  }

  AnatomyProposal Judge(const ChainPair& leg_pair, const ChainPair& arm_pair) const {
    AnatomyProposal proposal{.joints = {}, .confidence = 0};
    proposal.joints.fill(-1);
    // Find the joints of legs and arms, and compare the lengths of trunk, legs and arms.
    const Limbs legs = FindLimbs(leg_pair, kLegProportions), arms = FindLimbs(arm_pair, kArmProportions);
    if (legs.score == 0 || arms.score == 0) return proposal;
    const glm::dvec3 hips = Middle(legs, 0), shoulders = Middle(arms, 0);
    const glm::dvec3 up = DirectionOf(shoulders - hips);
    const double trunk = glm::distance(shoulders, hips);
    const double leg = Bone(legs.Joint(0, 0), legs.Joint(0, 1)) + Bone(legs.Joint(0, 1), legs.Joint(0, 2));
    const double arm = Bone(arms.Joint(0, 0), arms.Joint(0, 1)) + Bone(arms.Joint(0, 1), arms.Joint(0, 2));
    proposal.confidence =
        legs.score * arms.score * RangeScore(trunk / leg, 0.35, 0.85) * RangeScore(leg / arm, 1.1, 2.0);
    constexpr double kHeadless = 0.85;
    if (!HasHead(legs, arms, shoulders, up, trunk)) proposal.confidence *= kHeadless;

    // Legs must point away from the trunk. Hips and shoulders must be parallel to each other and perpendicular to the
    // trunk.
    glm::dvec3 toes(0);
    for (std::size_t side = 0; side < 2; ++side) {
      const glm::dvec3 ankle = tree_.RestOf(legs.Joint(side, 2));
      const double down = glm::dot(DirectionOf(ankle - tree_.RestOf(legs.Joint(side, 0))), -up);
      proposal.confidence *= RangeScore(down, 0.9, 1.1);
      toes += DirectionOf(tree_.RestOf(legs.Tip(side)) - ankle);
    }
    const glm::dvec3 across = DirectionOf(tree_.RestOf(legs.Joint(0, 0)) - tree_.RestOf(legs.Joint(1, 0)));
    const glm::dvec3 arms_across = DirectionOf(tree_.RestOf(arms.Joint(0, 0)) - tree_.RestOf(arms.Joint(1, 0)));
    constexpr double kAligned = 0.9;
    proposal.confidence *= RangeScore(std::abs(glm::dot(across, arms_across)), kAligned, 1.1);
    proposal.confidence *= RangeScore(1.1 - std::abs(glm::dot(across, up)), kAligned, 1.2);

    // Determine left and right from the direction of the toes.
    const glm::dvec3 forward = toes - up * glm::dot(toes, up) - across * glm::dot(toes, across);
    constexpr double kForward = 0.7, kNoToes = 0.6;
    const bool has_toes = glm::length(forward) > kForward;
    if (!has_toes) proposal.confidence *= kNoToes;
    const glm::dvec3 left = has_toes ? glm::cross(up, forward) : glm::dvec3(1, 0, 0);
    // Assign the joints to the roles by side.
    for (const Limb& limb : kLimbs) {
      const Limbs& found = limb.is_arm ? arms : legs;
      const bool is_first_left = glm::dot(limb.is_arm ? arms_across : across, left) >= 0;
      const std::size_t side = (limb.side == Side::kLeft) == is_first_left ? 0 : 1;
      for (std::size_t i = 0; i < 3; ++i) proposal.joints[Index(limb.roles[i])] = found.Joint(side, i);
    }
    return proposal;
  }

  const SkeletonTree& tree_;
  std::vector<Chain> below_;  ///< for each joint: its longest chain
};

}  // namespace

AnatomyProposal ProposeByAnatomy(const SkeletonTree& tree) { return AnatomyFinder(tree).Propose(); }

bool JointMapDraft::IsComposed(Role role) const {
  return std::ranges::find(map_.composed, role) != map_.composed.end();
}

void JointMapDraft::Set(Role role, int joint) {
  map_.points[Index(role)] = {.joint = joint};
  rest_[Index(role)] = tree_.RestOf(joint);
}

void JointMapDraft::Compose(Role role, int joint, const glm::dvec3& rest) {
  ComposeAt(role, joint, tree_.InFrameOf(joint, rest), rest);
}

void JointMapDraft::ComposeAt(Role role, int joint, const glm::dvec3& offset, const glm::dvec3& rest) {
  map_.points[Index(role)] = {.joint = joint, .offset = offset};
  rest_[Index(role)] = rest;
  map_.composed.push_back(role);
}

bool IsFree(const JointMapDraft& draft, Role end) {
  const int joint = draft.JointOf(end);
  return std::ranges::none_of(kLimbs, [&](const Limb& limb) {
    const int top = draft.JointOf(limb.roles[0]);
    return joint == top || draft.tree().DescendsFrom(joint, top);
  });
}

}  // namespace etude
