#include "engine/teaching/equal_streams.h"

#include <algorithm>
#include <limits>
#include <map>
#include <span>

#include "engine/base/names.h"
#include "engine/motion/equal_motions.h"
#include "engine/teaching/teach_moves.h"

namespace etude {
namespace {

Places PlacesOf(const SkeletonStream& stream) {
  constexpr double kUnseen = std::numeric_limits<double>::quiet_NaN();
  return {stream.frames.size(), kRoleCount, [&stream](std::size_t frame, std::size_t joint) {
            const SensedFrame& sensed = stream.frames[frame];
            return sensed.body_seen ? sensed.joints[joint].position : glm::dvec3(kUnseen);
          }};
}

const std::string& NameOf(const NamedStream& stream) { return stream.source.empty() ? stream.name : stream.source; }

std::vector<LabelledPart> PartsOf(const std::vector<LabelledPart>& parts, std::size_t stream) {
  std::vector<LabelledPart> own;
  std::ranges::copy_if(parts, std::back_inserter(own), [&](const LabelledPart& part) { return part.stream == stream; });
  return own;
}

/// Returns true if each performance of `some` is also one of `others`.
bool AreAmong(std::span<const LabelledPart> some, std::span<const LabelledPart> others) {
  return std::ranges::all_of(some, [&](const LabelledPart& part) {
    return std::ranges::any_of(
        others, [&](const LabelledPart& other) { return part.fault == other.fault && IsSamePerformance(part, other); });
  });
}

/// Returns the person that a recording's labels or its name state; "" if none.
std::string PersonOf(const NamedStream& stream, std::span<const LabelledPart> parts) {
  const auto named = std::ranges::find_if(parts, [](const LabelledPart& part) { return !part.person.empty(); });
  return named == parts.end() ? stream.person : named->person;
}

/// Returns which of two equal recordings, `first` or `second`, to leave out.
Result<std::size_t> CopyOf(std::size_t first, std::size_t second, const std::vector<NamedStream>& streams,
                           const std::vector<LabelledPart>& parts) {
  const auto of_first = PartsOf(parts, first), of_second = PartsOf(parts, second);
  const std::string one = PersonOf(streams[first], of_first), other = PersonOf(streams[second], of_second);
  if (!one.empty() && !other.empty() && ComparedName(one) != ComparedName(other)) {
    return Fail({NameOf(streams[second])},
                "shows the same motion as {}, but names the person {} instead of {}; allowed: each motion once",
                NameOf(streams[first]), other, one);
  }
  if (AreAmong(of_second, of_first)) return second;
  if (AreAmong(of_first, of_second)) return first;
  return Fail(
      {NameOf(streams[second])},
      "shows the same motion as {}, but the labels (without labels, the files' names) state other performances; "
      "allowed: each motion once",
      NameOf(streams[first]));
}

}  // namespace

bool ShowSameMotion(const SkeletonStream& a, const SkeletonStream& b) { return AreEqual(PlacesOf(a), PlacesOf(b)); }

Result<std::vector<Error>> LeaveOutCopies(std::vector<NamedStream>& streams, std::vector<LabelledPart>& parts) {
  // Find the copies. If the first of equal recordings is left out, another one takes its place.
  std::vector<Places> places;
  for (const NamedStream& stream : streams) places.push_back(PlacesOf(stream.stream));
  const auto equals = FindEqual(places);
  std::vector<std::size_t> kept(streams.size());
  std::vector<bool> is_copy(streams.size(), false);
  std::vector<Error> copies;
  for (std::size_t s = 0; s < streams.size(); ++s) {
    kept[s] = s;
    if (!equals[s]) continue;
    std::size_t& first = kept[*equals[s]];
    ASSIGN_OR_RETURN(const std::size_t copy, CopyOf(first, s, streams, parts));
    const std::size_t other = copy == s ? first : s;
    is_copy[copy] = true;
    copies.push_back({{NameOf(streams[copy])}, "shows the same motion as " + NameOf(streams[other])});
    first = other;
  }
  if (copies.empty()) return copies;
  // Remove the copies.
  std::erase_if(parts, [&](const LabelledPart& part) { return is_copy[part.stream]; });
  for (LabelledPart& part : parts) {
    part.stream -= static_cast<std::size_t>(
        std::count(is_copy.begin(), is_copy.begin() + static_cast<std::ptrdiff_t>(part.stream), true));
  }
  std::size_t at = 0;
  std::erase_if(streams, [&](const NamedStream&) { return is_copy[at++]; });
  return copies;
}

std::size_t CountTaught(const std::vector<NamedStream>& streams, const std::vector<LabelledPart>& parts,
                        std::span<const TaughtMove> moves) {
  std::map<std::size_t, std::vector<Places>> examples;  // by number of frames
  for (const TaughtMove& move : moves) {
    for (const auto* some : {&move.examples, &move.counter_examples}) {
      for (const SkeletonStream& example : *some) examples[example.frames.size()].push_back(PlacesOf(example));
    }
  }
  const auto performances = PerformancesOf(parts, streams);
  return static_cast<std::size_t>(std::ranges::count_if(performances, [&](const LabelledPart& part) {
    const SkeletonStream performed = PartOf(streams[part.stream].stream, part.begin, part.end);
    return std::ranges::any_of(examples[performed.frames.size()],
                               [own = PlacesOf(performed)](const Places& example) { return AreEqual(own, example); });
  }));
}

}  // namespace etude
