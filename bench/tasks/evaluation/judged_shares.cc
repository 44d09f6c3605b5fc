#include "bench/tasks/evaluation/judged_shares.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <span>

#include "bench/metrics/alignment.h"

namespace etude {
namespace {

/// Flags, frames × columns: true for values that are seen.
struct Mask {
  std::size_t columns = 1;
  std::vector<char> seen;
};

bool AreSeen(const glm::dvec3& a) { return IsSeen(a); }
bool AreSeen(const glm::dvec3& a, const glm::dvec3& b) { return IsSeen(a) && IsSeen(b); }

/// Returns a mask with a value for each of `count` places.
template <typename IsSeenAt>
Mask MaskOf(std::size_t columns, std::size_t count, const IsSeenAt& is_seen_at) {
  Mask mask{std::max<std::size_t>(columns, 1), std::vector<char>(count)};
  for (std::size_t i = 0; i < count; ++i) mask.seen[i] = is_seen_at(i) ? 1 : 0;
  return mask;
}

/// Returns a mask of one column: the frames in which all columns are seen.
Mask WholeFrames(const Mask& mask) {
  Mask whole;
  for (auto at = mask.seen.begin(); at != mask.seen.end(); at += static_cast<std::ptrdiff_t>(mask.columns)) {
    whole.seen.push_back(std::ranges::count(at, at + static_cast<std::ptrdiff_t>(mask.columns), 0) == 0 ? 1 : 0);
  }
  return whole;
}

/// Returns the number of runs of `length` frames in which a column is seen throughout.
double CountRuns(const Mask& mask, std::size_t length) {
  std::vector<std::size_t> in_a_row(mask.columns);
  double count = 0;
  for (std::size_t i = 0; i < mask.seen.size(); ++i) {
    std::size_t& run = in_a_row[i % mask.columns];
    run = mask.seen[i] == 0 ? 0 : run + 1;
    count += run >= length ? 1 : 0;
  }
  return count;
}

/// Returns the number of windows of `length` frames that a mask of one column shows wholly. Windows follow each other
/// from the first frame on.
double CountWindows(const Mask& mask, std::size_t length) {
  double count = 0;
  for (std::size_t first = 0; first + length <= mask.seen.size(); first += length) {
    count += std::ranges::count(&mask.seen[first], &mask.seen[first] + length, 0) == 0 ? 1 : 0;
  }
  return count;
}

/// Returns a mask without the segments of `length` frames to which no alignment can be fitted, because their first
/// `fitted` frames show fewer than kMinFitted positions.
Mask WithFit(Mask mask, std::size_t length, std::size_t fitted) {
  const std::size_t step = length * mask.columns;
  for (std::size_t first = 0; first < mask.seen.size(); first += step) {
    const std::span segment = std::span(mask.seen).subspan(first, std::min(step, mask.seen.size() - first));
    const auto points = std::ranges::count(segment.first(std::min(fitted * mask.columns, segment.size())), 1);
    if (static_cast<double>(points) < kMinFitted) std::ranges::fill(segment, 0);
  }
  return mask;
}

/// Collects the shares of metrics.
class Shares {
 public:
  explicit Shares(JudgedOn& judged) : judged_(judged) {}

  /// Adds the share of the runs of `length` frames in `shown` that are also in `both`.
  void Add(std::initializer_list<const char*> metrics, const Mask& both, const Mask& shown, std::size_t length = 1) {
    AddCounts(metrics, CountRuns(both, length), CountRuns(shown, length));
  }
  void AddCounts(std::initializer_list<const char*> metrics, double both, double shown) {
    const double share = shown > 0 ? both / shown : 1;
    for (const char* metric : metrics) {
      if (share < 1) judged_.shares.emplace_back(metric, share);
    }
  }

 private:
  JudgedOn& judged_;
};

/// Adds the metrics that compare the two motions' positions.
void AddErrors(const EvaluatedPair& pair, Shares& shares) {
  const std::size_t n = pair.truth.points, count = pair.truth.positions.size();
  const auto &found = pair.found.positions, &truth = pair.truth.positions;
  if (std::ranges::all_of(found, IsSeen) && std::ranges::all_of(pair.found_root, IsSeen)) return;  // all shares are 1
  const Mask shown = MaskOf(n, count, [&](std::size_t i) { return AreSeen(truth[i]); });
  const Mask both = MaskOf(n, count, [&](std::size_t i) { return AreSeen(found[i], truth[i]); });
  const auto with = [&](const Mask& mask, const auto& has_frame) {
    return MaskOf(n, count, [&](std::size_t i) { return mask.seen[i] != 0 && has_frame(i / n); });
  };
  shares.Add({"mpjpe_unaligned_mm", "mpjpe_first_frame_mm", "mpjpe_first_frame_scaled_mm", "mpjpe_take_mm",
              "mpjpe_take_scaled_mm"},
             both, shown);
  const auto add_fitted = [&](std::initializer_list<const char*> metrics, std::size_t length, std::size_t fitted) {
    shares.Add(metrics, WithFit(both, length, fitted), WithFit(shown, length, fitted));
  };
  add_fitted({"mpjpe_each_frame_mm", "mpjpe_each_frame_scaled_mm"}, 1, 1);
  add_fitted({"w_mpjpe_mm@wham"}, kSegmentFrames, 2);
  add_fitted({"wa_mpjpe_mm@wham"}, kSegmentFrames, kSegmentFrames);
  shares.Add({"accel_error_mm@human_dynamics", "accel_error_mps2"}, both, shown, 3);
  const Mask whole = WholeFrames(both), whole_truth = WholeFrames(shown);
  shares.Add({"l2q@lafan1", "l2p@lafan1"}, whole, whole_truth);
  shares.AddCounts({"npss@lafan1", "npss"}, CountWindows(whole, kWindowFrames),
                   CountWindows(whole_truth, kWindowFrames));
  if (pair.true_root.empty()) return;
  const auto &found_root = pair.found_root, &true_root = pair.true_root;
  const Mask rooted = with(both, [&](std::size_t f) { return AreSeen(found_root[f], true_root[f]); });
  const Mask rooted_truth = with(shown, [&](std::size_t f) { return AreSeen(true_root[f]); });
  shares.Add({"mpjpe_root_mm", "mpjpe_root_scaled_mm", "pck_150mm@mpi_inf_3dhp", "auc_150mm@mpi_inf_3dhp"}, rooted,
             rooted_truth);
  shares.Add({"accel_error_mps2@wham"}, rooted, rooted_truth, 3);
  shares.Add({"rte@wham"},
             MaskOf(1, true_root.size(), [&](std::size_t f) { return AreSeen(found_root[f], true_root[f]); }),
             MaskOf(1, true_root.size(), [&](std::size_t f) { return AreSeen(true_root[f]); }));
}

/// Adds the metrics of bend angles and of joint angles.
void AddAngles(const MatchedMotions& matched, Shares& shares) {
  const std::size_t bends = matched.bends.size(), frames = matched.pair.truth.FrameCount();
  const auto bent = [&](bool needs_found) {
    return MaskOf(bends, bends * frames, [&](std::size_t i) {
      return std::ranges::all_of(matched.bends[i % bends], [&](std::size_t joint) {
        const EvaluatedPair& pair = matched.pair;
        return IsSeen(pair.truth.Frame(i / bends)[joint]) &&
               (!needs_found || IsSeen(pair.found.Frame(i / bends)[joint]));
      });
    });
  };
  if (bends > 0) shares.Add({"bend_error_deg"}, bent(true), bent(false));
  const auto &truth = matched.true_angles.degrees, &found = matched.found_angles.degrees;
  shares.Add({"angle_rmse_deg", "angle_bias_deg", "angle_icc_a1"},
             MaskOf(1, truth.size(), [&](std::size_t i) { return !std::isnan(truth[i] + found[i]); }),
             MaskOf(1, truth.size(), [&](std::size_t i) { return !std::isnan(truth[i]); }));
}

/// Adds the metrics of the answer alone.
void AddOfAnswer(const EvaluatedPair& own, Shares& shares) {
  if (std::ranges::all_of(own.found.positions, IsSeen) && std::ranges::all_of(own.found_root, IsSeen) &&
      std::ranges::all_of(own.feet.positions, IsSeen))
    return;  // all shares are 1
  const auto seen_in = [](const PointTracks& tracks) {
    return MaskOf(tracks.points, tracks.positions.size(), [&](std::size_t i) { return IsSeen(tracks.positions[i]); });
  };
  const auto all_like = [](const Mask& mask) { return Mask{mask.columns, std::vector<char>(mask.seen.size(), 1)}; };
  const Mask joints = seen_in(own.found), feet = WholeFrames(seen_in(own.feet));
  shares.Add({"jitter@wham"}, joints, all_like(joints), 4);
  shares.Add({"penetration_mm", "floating_mm"}, joints, all_like(joints));
  const auto any_seen = MaskOf(1, own.found.FrameCount(), [&](std::size_t f) {
    return std::ranges::any_of(own.found.Frame(f), [](const glm::dvec3& p) { return IsSeen(p); });
  });
  shares.Add({"contact_f1"}, any_seen, all_like(any_seen));
  shares.Add({"skating_ratio@gmd", "skate_from_height_mps@kimodo", "skate_from_contacts_mps@kimodo"}, feet,
             all_like(feet), 2);
  if (own.found_root.size() != feet.seen.size()) return;
  const Mask with_root =
      MaskOf(1, feet.seen.size(), [&](std::size_t f) { return feet.seen[f] != 0 && IsSeen(own.found_root[f]); });
  shares.Add({"pfc@edge"}, with_root, all_like(feet), 3);
}

}  // namespace

JudgedOn JudgedOf(const MatchedMotions& matched) {
  JudgedOn judged{matched.joints, matched.OwnFrames().rate_hz, {}, matched.own ? matched.pair.rate_hz : 0};
  if (!matched.root.empty()) judged.parts.push_back(std::string(kRootPart) + matched.root);
  Shares shares(judged);
  AddErrors(matched.pair, shares);
  AddAngles(matched, shares);
  AddOfAnswer(matched.OwnFrames(), shares);
  return judged;
}

}  // namespace etude
