#include "bench/tasks/detection/recorded_faults.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "engine/base/angles.h"
#include "engine/base/directions.h"
#include "engine/motion/edit.h"
#include "engine/recognition/pose_vector.h"

namespace etude {
namespace {

constexpr std::array kMadeFaults = {Fault::kAmplitude, Fault::kWrongSide, Fault::kWrongMove};

BodyPose HalfWay(const BodyPose& from, const BodyPose& to) {
  BodyPose half = to;
  half[Role::kHipCentre] = 0.5 * (from[Role::kHipCentre] + to[Role::kHipCentre]);
  for (const auto& [parent, child] : AllBones()) {
    const auto way = [end = child, start = parent](const BodyPose& pose) {
      const glm::dvec3 limb = pose[end] - pose[start];
      const double length = glm::length(limb);
      return length > 0 ? limb / length : limb;
    };
    glm::dvec3 middle = way(from) + way(to);
    if (glm::length(middle) < 1e-6) middle = way(to);  // the middle of opposite directions is undefined
    const double length = glm::length(to[child] - to[parent]);
    half[child] = half[parent] + (length > 0 ? length * glm::normalize(middle) : glm::dvec3(0));
  }
  return half;
}

/// Returns a copy of the frame with the joints at the positions of `pose`.
SensedFrame Moved(const SensedFrame& frame, const BodyPose& pose) {
  SensedFrame moved = frame;
  for (const Role role : AllRoles()) moved[role].position = pose[role];
  return moved;
}

SkeletonStream ImageOf(const SkeletonStream& stream) {
  const BodyMotion image = Mirror(MotionOf(stream));
  SkeletonStream mirrored = stream;
  for (std::size_t f = 0; f < mirrored.frames.size(); ++f) {
    const SensedFrame& own = stream.frames[f];
    mirrored.frames[f] = Moved(own, image.poses[f]);
    for (const Role role : AllRoles()) mirrored.frames[f][role].state = own[Mirrored(role)].state;
  }
  return mirrored;
}

SkeletonStream Halved(const SkeletonStream& stream) {
  SkeletonStream halved = stream;
  const auto first = std::ranges::find_if(stream.frames, &SensedFrame::body_seen);
  if (first == stream.frames.end()) return halved;
  for (SensedFrame& frame : halved.frames) frame = Moved(frame, HalfWay(PoseOf(*first), PoseOf(frame)));
  return halved;
}

/// Returns the deviation of the limb that deviates most, degrees: the root mean square angle along the best warping
/// path through both performances. Returns 0 if one of the performances shows no body.
double WarpedStrayDeg(const SkeletonStream& meant, const SkeletonStream& danced) {
  struct Way {
    double cost = std::numeric_limits<double>::infinity();
    int steps = 0;
    std::array<double, kPosePartCount - 1> squares{};  // one sum for each limb; the lift of the hips is left out
  };
  const auto from = DescribeStream(meant, PoseParts::kLimbs), to = DescribeStream(danced, PoseParts::kLimbs);
  if (from.empty() || to.empty()) return 0;
  std::vector<Way> before(to.size() + 1), now(to.size() + 1);
  before[0].cost = 0;
  // Apply dynamic time warping, summing the squared angles of each limb along the path.
  for (const PoseVector& pose : from) {
    now[0] = {};
    for (std::size_t j = 0; j < to.size(); ++j) {
      Way& way = now[j + 1];
      way = std::min({before[j], before[j + 1], now[j]}, [](const Way& a, const Way& b) { return a.cost < b.cost; });
      ++way.steps;
      for (std::size_t i = 0; i < way.squares.size(); ++i) {
        const double degrees = Degrees(AngleBetween(pose.parts[i], to[j].parts[i]));
        way.squares[i] += degrees * degrees;
        way.cost += degrees * degrees;
      }
    }
    std::swap(before, now);
  }
  const Way& best = before.back();
  return std::sqrt(*std::ranges::max_element(best.squares) / best.steps);
}

}  // namespace

std::span<const Fault> MadeFaults() { return kMadeFaults; }

NamedStream WithFault(const NamedStream& right, Fault fault) {
  assert(std::ranges::find(kMadeFaults, fault) != kMadeFaults.end());
  NamedStream faulty = right;
  if (fault == Fault::kWrongMove) return faulty;
  const auto changed = [&](const SkeletonStream& stream) {
    return fault == Fault::kWrongSide ? ImageOf(stream) : Halved(stream);
  };
  faulty.stream = changed(right.stream);
  if (right.motion) faulty.motion = MotionOf(changed(StreamOf(*right.motion)));
  return faulty;
}

Truth TruthOfFault(const NamedStream& right, const NamedStream& faulty, const LabelledPart& part, Fault fault) {
  if (fault == Fault::kWrongMove) return Truth::kWrong;
  const SkeletonStream meant = PartOf(right.stream, part.begin, part.end),
                       danced = PartOf(faulty.stream, part.begin, part.end);
  if (fault == Fault::kWrongSide) return TruthOf({.limb_deg = WarpedStrayDeg(meant, danced)});
  const auto pose_of = [](const SkeletonStream& stream) {
    return [&stream](double share) {
      const auto last = static_cast<double>(stream.frames.size() - 1);
      return PoseOf(stream.frames[static_cast<std::size_t>(std::lround(share * last))]);
    };
  };
  return TruthOf({.limb_deg = LimbDeviationDeg(pose_of(meant), pose_of(danced))});
}

}  // namespace etude
