#include "engine/retargeting/limb_finder.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace etude {

SkeletonTree::SkeletonTree(const Skeleton& skeleton, const LocalPose& rest)
    : skeleton_(skeleton), ends_(EndSites(skeleton)) {
  ComputeGlobals(skeleton, rest, rest_);
}

bool SkeletonTree::DescendsFrom(int joint, int ancestor) const {
  if (joint == ancestor) return false;
  while (joint > ancestor) joint = ParentOf(joint);  // a parent has a smaller index than its children
  return joint == ancestor;
}

int SkeletonTree::CommonAncestor(int a, int b) const {
  while (a != b) (a > b ? a : b) = ParentOf(std::max(a, b));
  return a;
}

glm::dvec3 SkeletonTree::InFrameOf(int joint, const glm::dvec3& point) const {
  const auto& [position, axes] = rest_[joint];
  if (!std::isnormal(glm::determinant(axes))) return glm::dvec3(0);
  const glm::dvec3 inside = glm::inverse(axes) * (point - position);
  const bool is_finite = std::isfinite(inside.x) && std::isfinite(inside.y) && std::isfinite(inside.z);
  return is_finite ? inside : glm::dvec3(0);
}

namespace {

// Ratings of limbs whose three joints are all found by name. The rating of any other limb is the number of joints found
// in it.
constexpr int kAllNamed = 3;
constexpr int kLooseChain = 4;
constexpr int kChain = 5;

int RateChain(const SkeletonTree& tree, const std::array<int, 3>& joints) {
  const auto [upper, middle, end] = joints;
  if (!tree.DescendsFrom(middle, upper)) return kAllNamed;
  if (tree.DescendsFrom(end, middle)) return kChain;
  return end != upper && end != middle && !tree.DescendsFrom(end, upper) ? kLooseChain : kAllNamed;
}

using Candidates = std::array<std::vector<NamedJoint>, 3>;

Candidates CandidatesOf(const JointNames& names, const LimbNames& scheme, Side side, const std::array<int, 3>& taught) {
  Candidates candidates;
  for (std::size_t i = 0; i < 3; ++i) {
    candidates[i] = names.Find(scheme.joints[i], side, scheme.language);
    if (taught[i] >= 0) candidates[i] = {{.joint = taught[i], .prefix = "", .suffixes = 0}};
  }
  if (taught == std::array{-1, -1, -1}) return candidates;
  // A joint given by the user may have any name, so ignore the prefixes of all joints.
  for (auto& of_joint : candidates) {
    for (NamedJoint& candidate : of_joint) candidate.prefix.clear();
  }
  return candidates;
}

/// Tries every triple of candidates that share a prefix, and keeps the best triple.
class Search {
 public:
  Search(const SkeletonTree& tree, FoundLimb& best) : tree_(tree), best_(best) {}

  int rating() const { return rating_; }

  void Try(const LimbNames& scheme, const Candidates& candidates) {
    TryNames(scheme, candidates);
    for (const NamedJoint& upper : candidates[0]) {
      for (const NamedJoint& middle : candidates[1]) {
        for (const NamedJoint& end : candidates[2]) {
          if (upper.prefix != middle.prefix || upper.prefix != end.prefix) continue;
          const std::array<int, 3> joints = {upper.joint, middle.joint, end.joint};
          Keep(RateChain(tree_, joints), {joints, upper.prefix, &scheme});
          if (rating_ == kChain) return;
        }
      }
    }
  }

 private:
  /// Finds the joints of a scheme by name, even if they form no chain, for error messages.
  void TryNames(const LimbNames& scheme, const Candidates& candidates) {
    for (const auto& of_joint : candidates) {
      for (const NamedJoint& candidate : of_joint) TryPrefix(scheme, candidates, candidate.prefix);
    }
  }

  void TryPrefix(const LimbNames& scheme, const Candidates& candidates, const std::string& prefix) {
    FoundLimb named{.joints = {-1, -1, -1}, .prefix = prefix, .scheme = &scheme};
    int count = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto first = std::ranges::find(candidates[i], prefix, &NamedJoint::prefix);
      if (first == candidates[i].end()) continue;
      named.joints[i] = first->joint;
      ++count;
    }
    Keep(count, named);
  }

  void Keep(int rating, const FoundLimb& found) {
    if (rating <= rating_) return;
    rating_ = rating;
    best_ = found;
  }

  const SkeletonTree& tree_;
  FoundLimb& best_;
  int rating_ = 0;
};

}  // namespace

FoundLimb FindLimb(const JointNames& names, const SkeletonTree& tree, std::span<const LimbNames> schemes, Side side,
                   const std::array<int, 3>& taught) {
  FoundLimb best;
  Search search(tree, best);
  for (const LimbNames& scheme : schemes) {
    search.Try(scheme, CandidatesOf(names, scheme, side, taught));
    if (search.rating() == kChain) break;
  }
  return best;
}

}  // namespace etude
