"""Computes verdicts again from cells.jsonl, with formulas of this file alone, and compares them."""
import collections
import itertools
import json
import math
import unittest

from etude_case import EtudeCase

CLIPS = ["clap", "boxing", "robot", "sway", "stretch", "side_kick", "bird"]
ONE_WAY = """scenario: one-way
question: Does it count clips?
task: tracking
clips: [%s]
duration_s: 0.4
trials: 21
methods: [{name: a, solver: ccd}, {name: b, solver: damped-least-squares}, {name: c, solver: gauss-newton}]
metrics: [position_error_cm, frames_solved]
""" % ", ".join(f"builtin:{name}" for name in CLIPS)
PAIRS = """scenario: pairs
question: Does it count clips in both parts?
task: transition
clips: [%s]
trials: 28
methods: [{name: now, choice: now, join: cut}, {name: bridge, choice: fuzzy-bridge, join: cut, weights: fixed},
          {name: later, choice: wait-for-end, join: cut}]
metrics: [jump_cm, pose_gap_cm, wait_s]
""" % ", ".join(f"builtin:{name}" for name in CLIPS)


def student_cdf(t, freedom):
    """Returns Student's distribution function, by Simpson's rule over the density."""
    scale = math.gamma((freedom + 1) / 2) / math.sqrt(freedom * math.pi) / math.gamma(freedom / 2)
    steps = 20000
    width = abs(t) / steps
    density = [scale * (1 + (i * width) ** 2 / freedom) ** (-(freedom + 1) / 2) for i in range(steps + 1)]
    area = width / 3 * (density[0] + density[-1] + 4 * sum(density[1:-1:2]) + 2 * sum(density[2:-1:2]))
    return 0.5 + math.copysign(area, t)


def student_quantile(p, freedom):
    low, high = 0.0, 50.0
    for _ in range(40):
        middle = (low + high) / 2
        low, high = (middle, high) if student_cdf(middle, freedom) < p else (low, middle)
    return low


def holm(p_values):
    """Corrects p-values by Holm's method; None counts as a comparison, too."""
    order = sorted((i for i, p in enumerate(p_values) if p is not None), key=lambda i: p_values[i])
    corrected, largest = [None] * len(p_values), 0
    for rank, i in enumerate(order):
        largest = max(largest, min(1, (len(p_values) - rank) * p_values[i]))
        corrected[i] = largest
    return corrected


def signed_ranks(values):
    """Returns the two-sided p of Wilcoxon's signed-rank test: mean ranks for ties; zeros are ranked, then left out
    (Pratt)."""
    sizes = sorted(round(abs(value), 12) for value in values)
    rank = {size: sizes.index(size) + (sizes.count(size) + 1) / 2 for size in sizes}
    ranks = [rank[round(abs(value), 12)] for value in values if value != 0]
    reached = abs(sum(math.copysign(rank[round(abs(value), 12)], value) for value in values if value != 0)) - 1e-9
    sums = [abs(sum(sign * each for sign, each in zip(signs, ranks)))
            for signs in itertools.product((1, -1), repeat=len(ranks))]
    return sum(each >= reached for each in sums) / len(sums)


def pseudo_median(values):
    """Returns the median of the Walsh averages and the signed-rank test's 95 % interval, by counting subsets of
    ranks."""
    n = len(values)
    averages = sorted((values[i] + values[j]) / 2 for i in range(n) for j in range(i, n))
    sums = collections.Counter(sum(rank for rank, is_in in zip(range(1, n + 1), subset) if is_in)
                               for subset in itertools.product((0, 1), repeat=n))
    below, end = 0, 0
    while (below + sums[end]) / 2 ** n <= 0.025:
        below, end = below + sums[end], end + 1
    count = len(averages)
    return (averages[(count - 1) // 2] + averages[count // 2]) / 2, averages[end - 1], averages[count - end]


def share_interval(values):
    """Returns Bonett and Price's interval of the mean of values −1, 0 or 1."""
    n, gained, lost = len(values), values.count(1), values.count(-1)
    p, q = (gained + 1) / (n + 2), (lost + 1) / (n + 2)
    half = 1.959963985 * math.sqrt((p + q - (p - q) ** 2) / (n + 2))
    return p - q - half, p - q + half


def beyond(differences, units, comparisons):
    """Returns the pseudo-median of units, its interval and p, from each world's difference and units."""
    names = sorted({name for of_world in units for name in of_world})
    sums, counts = collections.Counter(), collections.Counter()
    for difference, of_world in zip(differences, units):
        for name in of_world:
            sums[name] += difference
            counts[name] += 1
    one_way = all(len(of_world) == 1 for of_world in units)
    means = [sums[name] / counts[name] for name in names]
    total, n = sum(differences), len(names)
    if one_way:
        estimate = sum(means) / n
        left_out = [(sum(means) - mean) / (n - 1) for mean in means]
    else:
        estimate = total / len(differences)
        left_out = [(total - sums[name]) / (len(differences) - counts[name]) for name in names]
    middle = sum(left_out) / n
    error = math.sqrt((n - 1) / n * sum((value - middle) ** 2 for value in left_out))
    half = student_quantile(0.975, n - 1) * error
    # A unit's value is the mean over its worlds. If worlds belong to several units, it is the unit's jackknife
    # pseudo-value.
    values = means if one_way else [n * estimate - (n - 1) * without for without in left_out]
    if 2 ** (1 - n) * comparisons <= 0.05:
        p = signed_ranks(values)
    else:
        p = 1.0 if estimate == 0 else 2 * (1 - student_cdf(abs(estimate / error), n - 1))
    centre, low, high = pseudo_median(values)
    if all(value in (-1, 0, 1) for value in values):
        centre, (low, high) = estimate, share_interval(values)
    return {"difference": centre, "ci95_low": low, "ci95_high": high, "mean": estimate, "mean_ci95_low": estimate - half,
            "mean_ci95_high": estimate + half, "p": p, "left_out": left_out,
            "differing": sum(mean != 0 for mean in means), "units": n}


def verdict(found, p_holm, matters, lower_is_better):
    low, high = found["ci95_low"], found["ci95_high"]
    if -matters <= low and high <= matters:
        inside = -matters <= found["mean_ci95_low"] and found["mean_ci95_high"] <= matters
        return "no difference" if inside and found["differing"] >= 6 else "undecided"
    middle = found["difference"]
    one_side = (low >= 0 and middle > 0) or (high <= 0 and middle < 0)
    if not one_side or middle * found["mean"] <= 0 or p_holm > 0.05 or abs(middle) < matters:
        return "undecided"
    return "better" if (middle < 0) == lower_is_better else "worse"


class Verdicts(EtudeCase):
    def check(self, scenario):
        rows = self.run_suite(self.write("s.yaml", scenario))
        metrics = {entry["id"]: entry for entry in json.loads(self.etude("list", "metrics", "--json").stdout)["metrics"]}
        summary = json.loads((self.out / "summary.json").read_text())["scenarios"][0]
        comparisons = summary["conditions"][0]["comparisons"]
        self.assertIn(len(comparisons), (4, 6))
        values = {(row["method"], row["trial"]): row for row in rows}
        found = []
        for comparison in comparisons:
            metric = comparison["metric"]
            differences, units = [], []
            for trial in sorted({row["trial"] for row in rows}):
                of_method, of_baseline = (values[comparison[who], trial] for who in ("method", "baseline"))
                if of_method[metric] is None or of_baseline[metric] is None:
                    continue
                difference = of_method[metric] - of_baseline[metric]
                differences.append(0 if abs(difference) < 1e-9 * metrics[metric]["practical_threshold"] else difference)
                units.append(of_method["units"])
            found.append(beyond(differences, units, len(comparisons)))
        corrected = holm([one["p"] for one in found])
        for comparison, one, p_holm in zip(comparisons, found, corrected):
            said = comparison["beyond"]
            self.assertEqual(said["units"], one["units"])
            scale = max(abs(one["ci95_low"]), abs(one["ci95_high"]), 1e-9)
            for key in ("difference", "ci95_low", "ci95_high", "mean", "mean_ci95_low", "mean_ci95_high"):
                self.assertAlmostEqual(said[key] / scale, one[key] / scale, 6, (comparison["metric"], key))
            for left, expected in zip(said["left_out"], one["left_out"]):
                self.assertAlmostEqual(left["mean"] / scale, expected / scale, 6)
            self.assertAlmostEqual(said["test"]["p"], one["p"], 5)
            self.assertAlmostEqual(said["p_holm"], p_holm, 4)
            metric = metrics[comparison["metric"]]
            if any(row["status"] != "ok" for row in rows):
                continue  # this file does not count failures as losses
            lower = metric["direction"] == "lower"
            self.assertEqual(said["verdict"], verdict(one, p_holm, metric["practical_threshold"], lower), comparison["metric"])

    def test_one_clip_a_world(self):
        self.check(ONE_WAY)

    def test_two_clips_a_world(self):
        self.check(PAIRS)


if __name__ == "__main__":
    unittest.main()
