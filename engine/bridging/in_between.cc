#include "engine/bridging/in_between.h"

#include <vector>

namespace etude {
namespace {

/// Remembers the way out of each frame of one clip, since many ways in share them.
class Exits {
 public:
  Exits(const TaggedClip& through, const TaggedClip& next, const SwitchRules& rules)
      : through_(through), next_(next), rules_(rules), known_(through.grades.size()) {}

  const std::optional<Link>& From(int frame, int& pairs_seen) {
    std::optional<LinkSearch>& known = known_[frame];
    if (!known) {
      known = FindLink(through_, {frame, frame}, next_, rules_);
      pairs_seen += known->pairs_seen;
    }
    return known->link;
  }

 private:
  const TaggedClip& through_;
  const TaggedClip& next_;
  const SwitchRules& rules_;
  std::vector<std::optional<LinkSearch>> known_;
};

/// The first way out of `through` after having entered it at frame `entered`.
std::optional<Link> FindExit(const TaggedClip& through, int entered, Exits& exits, const InBetweenRules& rules,
                             int& pairs_seen) {
  const FrameWindow stay{entered + rules.min_frames, entered + rules.max_frames};
  for (int frame : through.bridge_frames) {
    if (!stay.Contains(frame)) continue;
    if (const std::optional<Link>& leave = exits.From(frame, pairs_seen)) return leave;
  }
  return std::nullopt;
}

}  // namespace

InBetweenSearch FindInBetween(std::span<const TaggedClip> library, int playing, FrameWindow window, int next,
                              const SwitchRules& rules, const InBetweenRules& in_between) {
  InBetweenSearch search;
  std::vector<Exits> exits;
  exits.reserve(library.size());
  for (const TaggedClip& through : library) exits.emplace_back(through, library[next], rules);

  const TaggedClip& from = library[playing];
  for (int frame : from.bridge_frames) {
    if (!window.Contains(frame)) continue;
    for (int clip = 0; clip < static_cast<int>(library.size()); ++clip) {
      if (clip == playing || clip == next) continue;
      const TaggedClip& through = library[clip];
      for (int entered : through.bridge_frames) {
        ++search.pairs_seen;
        if (!Matches(from, frame, through, entered, rules)) continue;
        const auto leave = FindExit(through, entered, exits[clip], in_between, search.pairs_seen);
        if (!leave) continue;
        const FuzzyDistance distance = ComputeDistance(from.grades[frame], through.grades[entered], rules.weights);
        search.found = InBetween{clip, {frame, entered, distance}, *leave};
        return search;
      }
    }
  }
  return search;
}

}  // namespace etude
