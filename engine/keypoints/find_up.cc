#include "engine/keypoints/find_up.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "engine/base/angles.h"
#include "engine/base/directions.h"
#include "engine/base/names.h"
#include "engine/base/order_statistics.h"
#include "engine/keypoints/resting_feet.h"

namespace etude {
namespace {

using enum Landmark;

// The degrees of freedom of Student's t, which defines the cost of a residual and its weight in the next step.
constexpr double kFreedom = 4;
double Cost(double r) { return 0.5 * (kFreedom + 1) * std::log1p(r * r / kFreedom); }
double Weight(double r) { return 1 / (1 + r * r / kFreedom); }

/// The cues for the direction, in the order in which texts name them.
enum Cue { kCameras, kFeetAtRest, kStraight, kFlight, kCueCount };
constexpr std::array<const char*, kCueCount> kCueNames = {"the cameras' horizons", "resting feet",
                                                          "a person who stands straight", "gravity in jumps"};

/// Three directions in the world that belong to a picture, after the picture was rotated by quarter turns: along the
/// rows, towards the upper edge, and ahead.
struct Picture {
  glm::dvec3 right, above, ahead;
};

Picture TurnedPicture(const Camera& camera, int quarters) {
  const glm::dmat3 R_WC = glm::transpose(camera.R_CW);
  Picture picture{R_WC[0], -R_WC[1], R_WC[2]};
  for (int i = 0; i < quarters; ++i) {
    const glm::dvec3 right = picture.right;
    picture.right = picture.above;
    picture.above = -right;
  }
  return picture;
}

/// The sum of weighted squared residuals near a direction, as a quadratic function in the plane normal to the
/// direction.
class Sum {
 public:
  explicit Sum(const glm::dvec3& up) {
    const glm::dvec3 other = std::abs(up.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 side = glm::normalize(glm::cross(up, other));
    tangent_ = glm::dmat2x3(side, glm::cross(up, side));
  }

  /// Adds a residual, its derivative with respect to the direction, and its weight `share`.
  void Add(Cue cue, double residual, const glm::dvec3& derivative, double share = 1) {
    const glm::dvec2 j = glm::transpose(tangent_) * derivative;
    const double weight = share * Weight(residual);
    information += weight * glm::outerProduct(j, j);
    by[cue] += weight * glm::dot(j, j);
    right_ -= weight * residual * j;
    squares += weight * residual * residual;
    count += share;
  }

  glm::dvec3 Step(const glm::dvec3& up) const {
    constexpr double kMaxStep = 0.3;
    glm::dvec2 step = glm::inverse(information + glm::dmat2(1e-6)) * right_;
    if (const double length = glm::length(step); length > kMaxStep) step *= kMaxStep / length;
    return glm::normalize(up + tangent_ * step);
  }

  /// Returns the standard deviation of the direction, radians, along the axis in which it is least certain.
  double Deviation() const {
    const double half = 0.5 * (information[0][0] + information[1][1]);
    const double least = half - std::sqrt(std::max(0.0, half * half - glm::determinant(information)));
    return 1 / std::sqrt(std::max(least, 1e-6));
  }

  glm::dmat2 information{0};
  std::array<double, kCueCount> by{};
  double squares = 0, count = 0, cost = 0;

 private:
  glm::dmat2x3 tangent_{};
  glm::dvec2 right_{0};
};

/// Returns the mean direction from ankles to shoulders over the frames in which the person is straight; nullopt if the
/// person is never straight.
std::optional<glm::dvec3> StraightPerson(std::span<const LandmarkPositions> points) {
  constexpr double kStraight = 0.97;
  glm::dvec3 sum(0);
  for (const LandmarkPositions& at : points) {
    const auto shoulders = MiddleOf(at, kLeftShoulder, kRightShoulder), hips = MiddleOf(at, kLeftHip, kRightHip),
               knees = MiddleOf(at, kLeftKnee, kRightKnee), ankles = MiddleOf(at, kLeftAnkle, kRightAnkle);
    if (!shoulders || !hips || !knees || !ankles) continue;
    // Use the lengths of the limbs themselves; distances between midpoints are too short if the legs stride.
    double legs = 0;
    for (const auto& [hip, knee, ankle] :
         {std::array{kLeftHip, kLeftKnee, kLeftAnkle}, {kRightHip, kRightKnee, kRightAnkle}}) {
      const auto &h = at[Index(hip)], &k = at[Index(knee)], &a = at[Index(ankle)];
      legs += 0.5 * (glm::distance(*h, *k) + glm::distance(*k, *a));
    }
    const glm::dvec3 axis = *shoulders - *ankles;
    if (glm::length(axis) > kStraight * (glm::distance(*shoulders, *hips) + legs)) sum += glm::normalize(axis);
  }
  // If the directions cancel, as for a person who bows to all sides, they determine nothing.
  const double frames = glm::length(sum);
  return frames > 0 ? std::optional(sum / frames) : std::nullopt;
}

/// Returns the body's centre of mass from the shares of its parts (Winter 2009, table 4.1); nullopt if a landmark is
/// missing.
std::optional<glm::dvec3> CentreOfMass(const LandmarkPositions& at) {
  struct Part {
    std::array<Landmark, 2> from, to;
    double share, along;
  };
  static constexpr Part kParts[] = {{{kLeftHip, kRightHip}, {kLeftShoulder, kRightShoulder}, 0.578, 0.66},
                                    {{kLeftHip, kRightHip}, {kLeftKnee, kRightKnee}, 0.2, 0.433},
                                    {{kLeftKnee, kRightKnee}, {kLeftAnkle, kRightAnkle}, 0.122, 0.606},
                                    {{kLeftShoulder, kRightShoulder}, {kLeftElbow, kRightElbow}, 0.056, 0.436},
                                    {{kLeftElbow, kRightElbow}, {kLeftWrist, kRightWrist}, 0.044, 0.682}};
  glm::dvec3 sum(0);
  for (const Part& part : kParts) {
    const auto from = MiddleOf(at, part.from[0], part.from[1]), to = MiddleOf(at, part.to[0], part.to[1]);
    if (!from || !to) return std::nullopt;
    sum += part.share * glm::mix(*from, *to, part.along);
  }
  return sum;
}

/// Returns the mean direction opposite to the acceleration of the centre of mass in flights; nullopt if there is no
/// flight.
std::optional<glm::dvec3> Flight(std::span<const LandmarkPositions> points, double rate_hz, double metre) {
  constexpr double kShortest_s = 0.2, kGravity = 9.81, kTolerance = 0.15, kFit_m = 0.01;
  const auto window = static_cast<std::size_t>(std::ceil(kShortest_s * rate_hz)) + 1;
  constexpr std::size_t kMinFrames = 5;
  if (window < kMinFrames || points.size() < window) return std::nullopt;
  std::vector<std::optional<glm::dvec3>> centres;
  for (const LandmarkPositions& at : points) centres.push_back(CentreOfMass(at));
  glm::dvec3 sum(0);
  for (std::size_t first = 0; first + window <= points.size(); ++first) {
    // Fit a parabola by orthogonal polynomials in time.
    const double middle = 0.5 * static_cast<double>(window - 1);
    double t2 = 0, t4 = 0;
    bool is_whole = true;
    glm::dvec3 mean(0), slope(0), curve(0);
    for (std::size_t i = 0; i < window; ++i) {
      const double t = static_cast<double>(i) - middle;
      is_whole = is_whole && centres[first + i];
      t2 += t * t / static_cast<double>(window);
    }
    if (!is_whole) continue;
    double norm = 0;
    for (std::size_t i = 0; i < window; ++i) {
      const double t = static_cast<double>(i) - middle, q = t * t - t2;
      const glm::dvec3& p = *centres[first + i];
      mean += p / static_cast<double>(window);
      slope += t * p;
      curve += q * p;
      t4 += t * t;
      norm += q * q;
    }
    slope /= t4;
    curve /= norm;
    // The frames show a flight if the parabola fits and the centre of mass accelerates about as gravity would
    // accelerate it.
    double worst = 0;
    for (std::size_t i = 0; i < window; ++i) {
      const double t = static_cast<double>(i) - middle;
      worst = std::max(worst, glm::distance(*centres[first + i], mean + t * slope + (t * t - t2) * curve));
    }
    const glm::dvec3 up = -2.0 * rate_hz * rate_hz / metre * curve;
    if (worst < kFit_m * metre && std::abs(glm::length(up) - kGravity) < kTolerance * kGravity)
      sum += glm::normalize(up);
  }
  const double length = glm::length(sum);
  constexpr double kMinWindows = 2;
  return length >= kMinWindows ? std::optional(sum / length) : std::nullopt;
}

/// All cues for the up direction.
class Cues {
 public:
  Cues(std::span<const NamedCamera> cameras, std::span<const LandmarkPositions> points, double rate_hz, double stature,
       double metre)
      : cameras_(cameras),
        stature_(stature),
        stays_(FeetAtRest(points, rate_hz, stature)),
        straight_(StraightPerson(points)),
        flight_(Flight(points, rate_hz, metre)) {
    for (const LandmarkPositions& at : points) {
      if (const auto hip = MiddleOf(at, kLeftHip, kRightHip)) hips_.push_back(*hip);
    }
  }

  /// Linearises all cues at the direction `up` and sums their residuals.
  Sum At(const glm::dvec3& up) const {
    Sum sum(up);
    AddCameras(up, sum);
    AddFeet(up, sum);
    constexpr double kStands = 0.1, kFlies = 0.05, kLies = 3.5, kNoFlight = 2;
    if (straight_) AddDirection(kStraight, *straight_, kStands, kLies, up, sum);
    if (flight_) AddDirection(kFlight, *flight_, kFlies, kNoFlight, up, sum);
    return sum;
  }

  /// Lists start directions for the descent: the upper edges of the pictures in every quarter turn, the directions from
  /// the straight person and from flights, and the coordinate axes.
  std::vector<glm::dvec3> Beginnings() const {
    std::vector<glm::dvec3> beginnings;
    constexpr std::size_t kMaxCameras = 4;
    for (const NamedCamera& camera : cameras_.first(std::min(kMaxCameras, cameras_.size()))) {
      for (int quarters = 0; quarters < 4; ++quarters) {
        beginnings.push_back(TurnedPicture(camera.camera, quarters).above);
      }
    }
    for (const auto& one : {straight_, flight_}) {
      if (one) beginnings.push_back(*one);
    }
    for (int axis = 0; axis < 3; ++axis) {
      glm::dvec3 along(0);
      along[axis] = 1;
      beginnings.insert(beginnings.end(), {along, -along});
    }
    return beginnings;
  }

 private:
  void AddCameras(const glm::dvec3& up, Sum& sum) const {
    constexpr double kRoll = Radians(3), kPitch = Radians(20), kLooksDown = Radians(10), kTurned = 4;
    for (const NamedCamera& named : cameras_) {
      // Of the four quarter turns of the picture, take the one that fits the direction best.
      double least = 1e9, roll = 0, pitch = 0;
      Picture best{};
      for (int quarters = 0; quarters < 4; ++quarters) {
        const Picture picture = TurnedPicture(named.camera, quarters);
        const double x = std::clamp(glm::dot(picture.right, up), -1.0, 1.0);
        const double r = std::asin(x) / kRoll;
        const double p = (std::atan2(glm::dot(picture.ahead, up), glm::dot(picture.above, up)) + kLooksDown) / kPitch;
        const double cost = Cost(r) + Cost(p) + (quarters == 0 ? 0 : kTurned);
        if (cost >= least) continue;
        least = cost;
        roll = r;
        pitch = p;
        best = picture;
      }
      sum.cost += least;
      sum.Add(kCameras, roll, best.right / kRoll);
      const double a = glm::dot(best.ahead, up), b = glm::dot(best.above, up), square = std::max(a * a + b * b, 0.01);
      sum.Add(kCameras, pitch, (best.ahead * b - best.above * a) / square / kPitch);
    }
  }

  void AddFeet(const glm::dvec3& up, Sum& sum) const {
    if (stays_.empty()) return;
    constexpr double kSameHeight = 0.008, kFlatFoot = 0.015, kShare = 0.5, kMaxCost = 2, kUnder = 3;
    // For each kind of foot landmark: the mean position of its stays (periods of rest), and its height above the sole.
    std::vector<std::pair<glm::dvec3, double>> kinds;
    for (std::size_t kind = 0; kind < kFootKinds; ++kind) {
      std::vector<double> heights;
      for (const FootStay& stay : stays_) {
        if (stay.kind == kind) heights.push_back(glm::dot(up, stay.place));
      }
      if (heights.empty()) continue;
      const double sigma = kSameHeight * stature_;
      double height = Median(heights);
      glm::dvec3 middle(0);
      constexpr int kRounds = 4;
      for (int round = 0; round < kRounds; ++round) {
        double all = 0;
        middle = glm::dvec3(0);
        for (const FootStay& stay : stays_) {
          if (stay.kind != kind) continue;
          const double weight = Weight((glm::dot(up, stay.place) - height) / sigma);
          middle += weight * stay.place;
          all += weight;
        }
        middle /= all;
        height = glm::dot(up, middle);
      }
      for (const FootStay& stay : stays_) {
        if (stay.kind != kind) continue;
        const double residual = (glm::dot(up, stay.place) - height) / sigma;
        sum.Add(kFeetAtRest, residual, (stay.place - middle) / sigma, kShare);
        sum.cost += kShare * std::min(kMaxCost, Cost(residual));
      }
      kinds.emplace_back(middle, AboveSole(kind, stature_));
    }
    // Compare the kinds of landmarks with each other: their heights should differ as on a flat foot.
    glm::dvec3 middle(0);
    double middle_above = 0;
    for (const auto& [place, above] : kinds) {
      middle += place / static_cast<double>(kinds.size());
      middle_above += above / static_cast<double>(kinds.size());
    }
    for (const auto& [place, above] : kinds) {
      const double sigma = kFlatFoot * stature_;
      const double residual = (glm::dot(up, place - middle) - (above - middle_above)) / sigma;
      sum.Add(kFeetAtRest, residual, (place - middle) / sigma, kShare);
      sum.cost += kShare * std::min(kMaxCost, Cost(residual));
    }
    // If the hips are below the feet, the direction is upside down.
    std::vector<double> hips;
    for (const glm::dvec3& hip : hips_) hips.push_back(glm::dot(up, hip - middle));
    if (!hips.empty() && UpperMedian(std::move(hips)) < -0.2 * stature_) sum.cost += kUnder;
  }

  /// Adds the cue that the up direction is `known`, with the standard deviation `sigma`. Its cost is limited to
  /// `most_cost`; a cue that would cost more is an outlier and gets no residual.
  static void AddDirection(Cue cue, const glm::dvec3& known, double sigma, double most_cost, const glm::dvec3& up,
                           Sum& sum) {
    const double angle = AngleBetween(known, up) / sigma;
    sum.cost += std::min(most_cost, Cost(angle));
    if (Cost(angle) > most_cost) return;
    const glm::dvec3 away = UnitOr(up - glm::dot(up, known) * known, {0, 0, 0});
    sum.Add(cue, angle, away / sigma);
    const glm::dvec3 across = glm::cross(known, away);
    sum.Add(cue, 0, across / sigma, Weight(angle));
  }

  std::span<const NamedCamera> cameras_;
  double stature_;
  std::vector<FootStay> stays_;
  std::vector<glm::dvec3> hips_;
  std::optional<glm::dvec3> straight_, flight_;
};

std::string NameCues(const Sum& sum) {
  constexpr double kMinShare = 0.1;
  double all = 0;
  for (const double one : sum.by) all += one;
  std::vector<std::string> names;
  for (int cue = 0; cue < kCueCount; ++cue) {
    if (sum.by[cue] > kMinShare * all) names.emplace_back(kCueNames[cue]);
  }
  return Join(names);
}

}  // namespace

FoundUp FindUp(std::span<const NamedCamera> cameras, std::span<const LandmarkPositions> points, double rate_hz,
               double stature, double metre) {
  const Cues cues(cameras, points, rate_hz, stature, metre);
  // Minimise the cost by Gauss–Newton steps from every start direction.
  std::vector<std::pair<double, glm::dvec3>> found;  // the cost and direction of each minimum
  for (const glm::dvec3& beginning : cues.Beginnings()) {
    glm::dvec3 up = beginning;
    constexpr int kSteps = 20;
    for (int step = 0; step < kSteps; ++step) up = cues.At(up).Step(up);
    found.emplace_back(cues.At(up).cost, up);
  }
  const auto [cost, up] = *std::ranges::min_element(found, {}, [](const auto& one) { return one.first; });
  // The accuracy follows from the curvature, the disagreement of the cues, and the nearest other minimum.
  const Sum sum = cues.At(up);
  constexpr double kSolvedFor = 2;
  const double spread = std::max(1.0, sum.squares / std::max(1.0, sum.count - kSolvedFor));
  FoundUp best{up, std::sqrt(spread) * sum.Deviation(), 0, NameCues(sum)};
  // In two dimensions, a radius of 2.45 σ contains 95 %.
  constexpr double kNinetyFive = 2.45, kNearly = 3, kOther = Radians(10);
  best.within = std::min(kPi, kNinetyFive * best.deviation);
  for (const auto& [rival_cost, rival] : found) {
    const double apart = AngleBetween(up, rival);
    if (apart > kOther && rival_cost < cost + kNearly) best.within = std::max(best.within, apart);
  }
  return best;
}

}  // namespace etude
