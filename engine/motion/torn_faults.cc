#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "engine/base/order_statistics.h"
#include "engine/motion/fault_limits.h"
#include "engine/motion/limb_faults.h"

namespace etude {
namespace {

using enum Role;

constexpr double kUnseen = std::numeric_limits<double>::quiet_NaN();

// All limits are shares of the body's size: the length of a leg plus the trunk. In 269 clips of seven libraries,
// captured bodies without faults stay below 0.8 times each limit. Characters animated by hand stay below each limit,
// unless they grow or come apart.

/// Two joints whose distance hardly changes. Limbs are not listed, because FindStretches judges them.
struct Link {
  Role inner, outer;
  double max_change;
  double usual, max_length;  ///< the expected median and the largest allowed median
};
constexpr double kAny = std::numeric_limits<double>::infinity();
constexpr std::array kLinks = {Link{kHipCentre, kSpine, 0.10, 0.17, 0.35},
                               Link{kSpine, kShoulderCentre, 0.10, 0.17, 0.56},
                               Link{kShoulderCentre, kHead, 0.10, 0.17, 0.32},
                               Link{kShoulderCentre, kLeftShoulder, 0.13, 0.13, 0.33},
                               Link{kShoulderCentre, kRightShoulder, 0.13, 0.13, 0.33},
                               Link{kSpine, kLeftHip, 0.10, 0, kAny},
                               Link{kSpine, kRightHip, 0.10, 0, kAny},
                               Link{kRightHip, kLeftHip, 0.10, 0.16, 0.55},
                               Link{kRightShoulder, kLeftShoulder, 0.14, 0.26, 0.60},
                               Link{kLeftAnkle, kLeftFoot, 0.08, 0.14, 0.23},
                               Link{kRightAnkle, kRightFoot, 0.08, 0.14, 0.23},
                               Link{kLeftWrist, kLeftHand, 0.12, 0.16, 0.30},
                               Link{kRightWrist, kRightHand, 0.12, 0.16, 0.30}};

/// Two joints whose median distance is about the same on the other side of the body.
struct MirroredLink {
  Role inner, outer;
  double max_difference;
};
constexpr std::array kMirrored = {
    MirroredLink{kHipCentre, kLeftHip, 0.10},           MirroredLink{kSpine, kLeftHip, 0.14},
    MirroredLink{kShoulderCentre, kLeftHip, 0.09},      MirroredLink{kLeftHip, kLeftKnee, 0.08},
    MirroredLink{kLeftKnee, kLeftAnkle, 0.10},          MirroredLink{kLeftAnkle, kLeftFoot, 0.10},
    MirroredLink{kShoulderCentre, kLeftShoulder, 0.10}, MirroredLink{kSpine, kLeftShoulder, 0.10},
    MirroredLink{kLeftShoulder, kHead, 0.14},           MirroredLink{kLeftShoulder, kLeftElbow, 0.08},
    MirroredLink{kLeftElbow, kLeftWrist, 0.12},         MirroredLink{kLeftWrist, kLeftHand, 0.26}};

/// Two joints whose distance is wrong, the frames in which it is wrong, and the size of the error.
struct Wrong {
  Role inner, outer;
  std::vector<bool> frames;
  double size;
};

/// The frames in which a joint is torn, and the joint's largest distance from its right position.
struct Tear {
  std::vector<bool> frames;
  double size = 0;
};

class TornFinder {
 public:
  TornFinder(const BodyMotion& motion, std::span<const JointSet> unseen) : motion_(motion), unseen_(unseen) {
    // Joints that are not seen have a guessed position, which is accurate enough for the body's size.
    const auto part = [&](Role a, Role b) {
      std::vector<double> lengths;
      for (const BodyPose& pose : motion.poses) lengths.push_back(glm::distance(pose[a], pose[b]));
      return Median(std::move(lengths));
    };
    size_ = 0.5 * (part(kLeftHip, kLeftKnee) + part(kLeftKnee, kLeftAnkle) + part(kRightHip, kRightKnee) +
                   part(kRightKnee, kRightAnkle)) +
            part(kHipCentre, kSpine) + part(kSpine, kShoulderCentre);
  }

  void Find(std::vector<MotionFault>& faults) {
    FindChanges();
    FindLengths();
    FindDifferences();
    NameTorn();
    FindTurned();
    for (const auto& [joint, tear] : tears_) Append(joint, tear, faults);
    if (exchanged_.size > 0) Append(std::nullopt, exchanged_, faults);
  }

 private:
  int frames() const { return static_cast<int>(motion_.poses.size()); }

  bool Shows(int frame, Role joint) const { return unseen_.empty() || !unseen_[frame][Index(joint)]; }

  /// Returns the distance between two joints in each frame; NaN where one of the two joints is not seen.
  std::vector<double> Distances(Role a, Role b) const {
    std::vector<double> distances;
    for (int f = 0; f < frames(); ++f) {
      const bool is_seen = Shows(f, a) && Shows(f, b);
      distances.push_back(is_seen ? glm::distance(motion_.poses[f][a], motion_.poses[f][b]) : kUnseen);
    }
    return distances;
  }

  static std::optional<double> MedianOf(std::vector<double> values) {
    std::erase_if(values, [](double value) { return std::isnan(value); });
    if (values.empty()) return std::nullopt;
    return Median(std::move(values));
  }

  /// Returns the frames of stretches in which `is_off` holds for at least a tenth of a second.
  template <typename IsOff>
  std::vector<bool> Lasting(IsOff is_off) const {
    std::vector<bool> off(motion_.poses.size());
    for (int f = 0; f < frames(); ++f) off[f] = is_off(f);
    constexpr int kMinFrames = 3;
    for (const FrameRange& range : RangesOf(off)) {
      const int count = range.last - range.first + 1;
      const bool lasts = count >= kMinFrames && count >= fault_limits::kTorn_s * motion_.rate_hz;
      if (!lasts) std::fill(off.begin() + range.first, off.begin() + range.last + 1, false);
    }
    return off;
  }

  static void Add(Tear& tear, const std::vector<bool>& frames, double size) {
    if (std::ranges::none_of(frames, [](bool is_off) { return is_off; })) return;
    tear.frames.resize(frames.size());
    for (std::size_t f = 0; f < frames.size(); ++f) tear.frames[f] = tear.frames[f] || frames[f];
    tear.size = std::max(tear.size, size);
  }

  void AddAlways(Role inner, Role outer, double size) {
    wrong_.push_back({inner, outer, std::vector<bool>(motion_.poses.size(), true), size});
  }

  /// Returns the largest change of a joint's distance from the spine in these frames.
  double ChangeIn(const std::vector<bool>& wrong, Role joint) const {
    const std::vector<double> distances = Distances(kSpine, joint);
    const double median = MedianOf(distances).value_or(0);
    double largest = 0;
    for (int f = 0; f < frames(); ++f) {
      if (wrong[f])
        largest = std::max(largest, std::abs(distances[f] - median));  // NaN (a joint not seen) is never larger
    }
    return largest;
  }

  /// Finds links whose length, in some frames, differs from its median over all frames.
  void FindChanges() {
    for (const Link& link : kLinks) {
      const std::vector<double> distances = Distances(link.inner, link.outer);
      const auto median = MedianOf(distances);
      if (!median) continue;
      Wrong wrong{link.inner, link.outer,
                  Lasting([&](int f) { return std::abs(distances[f] - *median) > link.max_change * size_; }), 0};
      for (int f = 0; f < frames(); ++f) {
        if (wrong.frames[f]) wrong.size = std::max(wrong.size, std::abs(distances[f] - *median));
      }
      // Of two hips or shoulders, the joint whose distance from the spine changes more is torn.
      if (link.inner == Mirrored(link.outer) &&
          ChangeIn(wrong.frames, link.inner) > ChangeIn(wrong.frames, link.outer)) {
        std::swap(wrong.inner, wrong.outer);
      }
      if (wrong.size > 0) wrong_.push_back(std::move(wrong));
    }
  }

  /// Attributes the wrong distances to joints: first to the joint with the most wrong distances, then to the joint with
  /// most of the remaining wrong distances, and so on.
  void NameTorn() {
    while (!wrong_.empty()) {
      std::array<int, kRoleCount> count{};
      for (const Wrong& wrong : wrong_) {
        // A wrong distance adds more to the count of its outer joint than to the count of its inner joint. If both
        // joints have equally many wrong distances, Etude reports the outer joint (FaultKind::kTorn).
        count[Index(wrong.inner)] += 4;
        count[Index(wrong.outer)] += 5;
      }
      const Role worst = AllRoles()[std::ranges::max_element(count) - count.begin()];
      std::erase_if(wrong_, [&](const Wrong& wrong) {
        if (wrong.inner != worst && wrong.outer != worst) return false;
        Add(tears_[worst], wrong.frames, wrong.size);
        return true;
      });
    }
  }

  /// Finds links whose median length is too long, and a head joint that coincides with the base of the neck.
  void FindLengths() {
    for (const Link& link : kLinks) {
      const auto median = MedianOf(Distances(link.inner, link.outer));
      if (median && *median > link.max_length * size_) AddAlways(link.inner, link.outer, *median - link.usual * size_);
    }
    constexpr double kMinHead = 0.04, kUsualHead = 0.17;
    const auto head = MedianOf(Distances(kShoulderCentre, kHead));
    if (head && *head < kMinHead * size_) AddAlways(kShoulderCentre, kHead, kUsualHead * size_ - *head);
  }

  /// Finds links whose median lengths on the left and on the right differ.
  void FindDifferences() {
    for (const MirroredLink& link : kMirrored) {
      const auto left = MedianOf(Distances(link.inner, link.outer));
      const auto right = MedianOf(Distances(Mirrored(link.inner), Mirrored(link.outer)));
      if (!left || !right || std::abs(*left - *right) <= link.max_difference * size_) continue;
      const bool is_left = *left > *right;
      AddAlways(is_left ? link.inner : Mirrored(link.inner), is_left ? link.outer : Mirrored(link.outer),
                std::abs(*left - *right));
    }
  }

  /// Finds heads below the neck, feet that point backwards, and shoulders or hips that are exchanged or coincide.
  void FindTurned() {
    constexpr double kAgainst = 0.2, kFootAgainst = 0.5, kMinShoulders = 0.08, kMinHips = 0.04;
    const auto between = [&](int f, Role a, Role b) { return motion_.poses[f][b] - motion_.poses[f][a]; };
    const auto is_against = [&](const glm::dvec3& a, const glm::dvec3& b, double share) {
      return glm::dot(a, b) < -share * glm::length(a) * glm::length(b);
    };
    const auto shows = [&](int f, std::initializer_list<Role> joints) {
      return std::ranges::all_of(joints, [&](Role joint) { return Shows(f, joint); });
    };
    const auto largest = [&](const std::vector<bool>& off, auto size_of) {
      double size = 0;
      for (int f = 0; f < frames(); ++f) size = off[f] ? std::max(size, size_of(f)) : size;
      return size;
    };
    // The head is wrong if it lies below the base of the neck, along the trunk. The right position is its mirror image
    // above the base of the neck.
    const auto trunk = [&](int f) { return between(f, kHipCentre, kShoulderCentre); };
    const auto head = [&](int f) { return between(f, kShoulderCentre, kHead); };
    const std::vector<bool> down =
        Lasting([&](int f) { return shows(f, {kHead}) && is_against(head(f), trunk(f), kAgainst); });
    Add(tears_[kHead], down,
        largest(down, [&](int f) { return -2 * glm::dot(head(f), trunk(f)) / glm::length(trunk(f)); }));
    // A foot is wrong if it points backwards. If both feet point backwards at once, the sides are exchanged.
    const auto points_back = [&](int f, Side side) {
      const auto on = [side](Role left) { return side == Side::kLeft ? left : Mirrored(left); };
      const glm::dvec3 front = glm::cross(between(f, kRightHip, kLeftHip), between(f, on(kLeftAnkle), on(kLeftKnee)));
      const auto by_toes = FrontByToes(motion_.poses[f], side);
      return shows(f, {on(kLeftKnee), on(kLeftAnkle), on(kLeftFoot)}) && by_toes &&
             is_against(*by_toes, front, kFootAgainst);
    };
    const std::vector<bool> left = Lasting([&](int f) { return points_back(f, Side::kLeft); });
    const std::vector<bool> right = Lasting([&](int f) { return points_back(f, Side::kRight); });
    const auto both = Lasting([&](int f) { return left[f] && right[f]; });
    for (const Side side : {Side::kLeft, Side::kRight}) {
      const Role ankle = side == Side::kLeft ? kLeftAnkle : kRightAnkle;
      const Role foot = side == Side::kLeft ? kLeftFoot : kRightFoot;
      const std::vector<bool>& back = side == Side::kLeft ? left : right;
      const std::vector<bool> alone = Lasting([&](int f) { return back[f] && !both[f]; });
      Add(tears_[foot], alone, largest(alone, [&](int f) {
            return 2 * glm::dot(between(f, ankle, foot), *FrontByToes(motion_.poses[f], side));
          }));
    }
    // Sides are exchanged if the line of the hips points opposite to the line of the shoulders. Two hips or two
    // shoulders that coincide count as well.
    const auto is_exchanged = [&](int f) {
      const glm::dvec3 hips = between(f, kRightHip, kLeftHip), shoulders = between(f, kRightShoulder, kLeftShoulder);
      return is_against(hips, shoulders, kAgainst) || glm::length(shoulders) < kMinShoulders * size_ ||
             glm::length(hips) < kMinHips * size_;
    };
    Add(exchanged_, Lasting([&](int f) { return both[f] || is_exchanged(f); }),
        MedianOf(Distances(kLeftHip, kRightHip)).value_or(0));
  }

  /// Appends one fault that spans all frames of the tear.
  void Append(std::optional<Role> joint, const Tear& tear, std::vector<MotionFault>& faults) const {
    if (tear.frames.empty()) return;
    const std::vector<FrameRange> ranges = RangesOf(tear.frames);
    const auto count = static_cast<double>(std::ranges::count(tear.frames, true));
    faults.push_back({FaultKind::kTorn, ranges.front().first / motion_.rate_hz, ranges.back().last / motion_.rate_hz,
                      joint, tear.size, ranges.size() > 1 ? count / motion_.rate_hz : 0});
  }

  const BodyMotion& motion_;
  std::span<const JointSet> unseen_;
  double size_ = 0;
  std::vector<Wrong> wrong_;
  std::map<Role, Tear> tears_;
  Tear exchanged_;
};

}  // namespace

void FindTorn(const BodyMotion& motion, std::span<const JointSet> unseen, std::vector<MotionFault>& faults) {
  TornFinder(motion, unseen).Find(faults);
}

}  // namespace etude
