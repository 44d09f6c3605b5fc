"""Metrics of any answer against any truth. A motion is a list of frames; a frame is a list of positions, null for an
unseen joint."""
import cmath
import math

from . import common
from .capture import FEWEST, fit
from .common import cross, distance, dot, minus, norm

LOW_M, GMD_MPS, GMD_REACH = 0.05, 0.5, 2
PCK_MM, AUC_STEP_MM, AUC_STEPS = 150, 5, 31
BEAT_SIGMA, SMOOTHING, MINT_ORDER = 3, 5, 10  # frames


def seen_pairs(found, truth):
    return [(a, b) for a, b in zip(found, truth, strict=True) if a and b]


def apply(function, frames):
    return [[function(p) if p and function else None for p in frame] for frame in frames]


def unaligned(given):
    return given["found"]


def by_root(given, scaled):
    aligned = []
    for found, truth, root, onto in zip(given["found"], given["truth"], given["found_root"], given["true_root"]):
        if not root or not onto:
            aligned.append([None] * len(found))
            continue
        moved = [(minus(a, root), minus(b, onto)) for a, b in seen_pairs(found, truth)]
        square = math.fsum(dot(a, a) for a, _ in moved)
        scale = math.fsum(dot(a, b) for a, b in moved) / square if scaled and square > 0 else 1.0
        aligned.append([[o + scale * (x - r) for x, r, o in zip(p, root, onto)] if p else None for p in found])
    return aligned


def by_first(given, scaled):
    pairs = [seen_pairs(a, b) for a, b in zip(given["found"], given["truth"], strict=True)]
    first = next((frame for frame in pairs if len(frame) >= FEWEST), [])
    return apply(fit(first, scaled), given["found"])


def by_take(given, scaled):
    pairs = common.flat([seen_pairs(a, b) for a, b in zip(given["found"], given["truth"], strict=True)])
    return apply(fit(pairs, scaled), given["found"])


def by_frame(given, scaled):
    return [apply(fit(seen_pairs(a, b), scaled), [a])[0] for a, b in zip(given["found"], given["truth"], strict=True)]


def by_segment(given, fitted):
    found, truth, length = given["found"], given["truth"], given["segment"]
    aligned = []
    for begin in range(0, len(found), length):
        end = begin + length
        part = slice(begin, min(begin + (fitted or length), end))
        pairs = common.flat([seen_pairs(a, b) for a, b in zip(found[part], truth[part])])
        aligned += apply(fit(pairs, True), found[begin:end])
    return aligned


def errors_mm(aligned, truth):
    return [common.MM * distance(a, b) for p, t in zip(aligned, truth, strict=True) for a, b in seen_pairs(p, t)]


def mpjpe(align, *arguments):
    return lambda given: common.mean(errors_mm(align(given, *arguments), given["truth"]))


def pck(given):
    errors = errors_mm(by_root(given, False), given["truth"])
    return common.share([error < PCK_MM for error in errors]) if errors else None


def auc(given):
    errors = errors_mm(by_root(given, False), given["truth"])
    shares = [sum(error < k * AUC_STEP_MM for error in errors) / len(errors) for k in range(AUC_STEPS) if errors]
    return math.fsum(shares) / len(shares) if shares else None


def seen_share(given):
    both = [bool(a) for p, t in zip(given["found"], given["truth"], strict=True) for a, b in zip(p, t) if b]
    return common.share(both)


def differences(frames, weights):
    """Returns each joint's sums weighted by `weights` over consecutive frames; None if a frame lacks the joint."""
    sums = []
    for f in range(len(frames) - len(weights) + 1):
        rows = frames[f:f + len(weights)]
        sums.append([[math.fsum(w * row[j][k] for w, row in zip(weights, rows)) for k in range(3)]
                     if all(row[j] for row in rows) else None for j in range(len(rows[0]))])
    return sums


def acceleration_error(found, truth, left_out=0):
    """Returns the mean acceleration error without the first and the last `left_out` accelerations."""
    pairs = list(zip(differences(found, [1, -2, 1]), differences(truth, [1, -2, 1]), strict=True))
    kept = pairs[left_out:len(pairs) - left_out]
    return common.mean([distance(x, y) for p, t in kept for x, y in seen_pairs(p, t)])


def times(factor, value):
    return None if value is None else factor * value


def accel_mm(given):
    return times(common.MM, acceleration_error(given["found"], given["truth"]))


def accel_mps2(given):
    return times(given["rate_hz"] ** 2, acceleration_error(given["found"], given["truth"]))


def accel_root(given):
    return times(given["rate_hz"] ** 2, acceleration_error(by_root(given, False), given["truth"], 1))


def jitter(given):
    lengths = [norm(p) for frame in differences(given["found"], [-1, 3, -3, 1]) for p in frame if p]
    return times(given["rate_hz"] ** 3 / 10, common.mean(lengths))


def rte(given):
    pairs = seen_pairs(given["found_root"], given["true_root"])
    moved = fit(pairs, False)
    length = math.fsum(distance(b, d) for (_, b), (_, d) in zip(pairs, pairs[1:]))
    if not moved or length == 0:
        return None
    return 100 * common.mean([distance(moved(a), b) for a, b in pairs]) / length


def floor_step(a, b):
    return math.hypot(b[0] - a[0], b[2] - a[2]) if a and b else math.nan


def gmd(given):
    feet, rate = given["feet"], given["rate_hz"]
    steps = len(feet) - 1
    if steps < 1:
        return None
    skates = [False] * steps
    for toes in (1, 3):
        speeds = [rate * floor_step(feet[f][toes], feet[f + 1][toes]) for f in range(steps)]
        for f in range(steps):
            around = speeds[max(f - GMD_REACH, 0):f + GMD_REACH + 1]
            low = all(p and p[1] < LOW_M for p in (feet[f][toes], feet[f + 1][toes]))
            skates[f] |= low and speeds[f] > GMD_MPS and sum(around) / (2 * GMD_REACH + 1) > GMD_MPS
    return sum(skates) / steps


def kimodo(given):
    feet, rate = given["feet"], given["rate_hz"]
    if len(feet) < 2:
        return None
    speeds = [rate * distance(a[toes], b[toes]) for a, b in zip(feet, feet[1:]) for toes in (1, 3)
              if a[toes] and b[toes] and a[toes][1] < LOW_M]
    return math.fsum(speeds) / (len(speeds) + 1e-6)


def kimodo_contacts(given):
    feet, rate = given["feet"], given["rate_hz"]
    if len(feet) < 2 or not given["found_contacts"]:
        return None
    speeds = [rate * distance(a[k], b[k]) for a, b, touches in zip(feet, feet[1:], given["found_contacts"])
              for k in range(4) if touches[k] and a[k] and b[k]]
    return math.fsum(speeds) / (len(speeds) + 1e-6)


def contact_f1(given):
    found, truth = common.flat(given["found_contacts"]), common.flat(given["true_contacts"])
    if not found or not truth:
        return None
    right = sum(1 for a, b in zip(found, truth) if a and b)
    return 2 * right / (sum(found) + sum(truth)) if any(found) or any(truth) else None


def pfc(given):
    feet, root, rate = given["feet"], given["found_root"], given["rate_hz"]
    pushes = []
    for a, b, c in zip(root, root[1:], root[2:]):
        if not (a and b and c):
            pushes.append(math.nan)
            continue
        x, y, z = (rate ** 2 * (a[k] - 2 * b[k] + c[k]) for k in range(3))
        pushes.append(math.sqrt(x * x + max(y, 0) ** 2 + z * z))
    largest = max((push for push in pushes if not math.isnan(push)), default=0)
    if largest <= 1e-7 * rate ** 2:  # rounding
        return None
    products = []
    for f, push in enumerate(pushes):
        steps = [floor_step(feet[f + 1][k], feet[f + 2][k]) for k in range(4)]
        products.append(min(steps[0], steps[1]) * min(steps[2], steps[3]) * push / largest
                        if not any(map(math.isnan, steps)) else math.nan)
    return times(1e4, common.mean([product for product in products if not math.isnan(product)]))


def lowest(given):
    return [min(p[1] for p in frame if p) for frame in given["found"] if any(frame)]


def bend_error(given):
    def bend(frame, triple):
        if not all(frame[j] for j in triple):
            return None
        upper, lower = minus(frame[triple[1]], frame[triple[0]]), minus(frame[triple[2]], frame[triple[1]])
        if not any(upper) or not any(lower):
            return None
        return common.degrees(math.atan2(norm(cross(upper, lower)), dot(upper, lower)))
    angles = [(bend(p, triple), bend(t, triple)) for p, t in zip(given["found"], given["truth"], strict=True)
              for triple in given["bends"]]
    return common.mean([abs(a - b) for a, b in angles if a is not None and b is not None])


def continuous(quaternions, start):
    """Returns one joint's quaternions, each with the sign nearer to the previous one, the first with the sign nearer
    to `start`."""
    kept = []
    for q in quaternions:
        before = kept[-1] if kept else start
        kept.append([-x for x in q] if dot(q, before) < 0 else list(q))
    return kept


def curves(given):
    """Returns per angle the pairs (answer, truth) that both know: truths near their circular mean, answers near the
    truth."""
    def near(angle, other):
        while abs(angle - other) > 180:
            angle += 360 if angle < other else -360
        return angle
    for found, truth in zip(zip(*given["found_angles"]), zip(*given["true_angles"])):
        pairs = [(a, t) for a, t in zip(found, truth) if a is not None and t is not None]
        middle = math.degrees(cmath.phase(sum(cmath.exp(1j * math.radians(t)) for _, t in pairs)))
        yield [(near(a, near(t, middle)), near(t, middle)) for a, t in pairs]


def over_angles(measure):
    def of(given):
        values = [measure(pairs) for pairs in curves(given) if pairs]
        return common.mean([value for value in values if value is not None])
    return of


def rmse(pairs):
    return math.sqrt(common.mean([(a - t) ** 2 for a, t in pairs]))


def bias(pairs):
    return abs(common.mean([a - t for a, t in pairs]))


def icc_a1(pairs):
    """Returns ICC(A,1) from the table of the analysis of variance: frames are rows, answer and truth are columns."""
    n = len(pairs)
    if n < 2:
        return None
    grand = common.mean(common.flat(pairs))
    rows, columns = [common.mean(pair) for pair in pairs], [common.mean(column) for column in zip(*pairs)]
    of_rows = 2 * math.fsum((r - grand) ** 2 for r in rows) / (n - 1)
    of_columns = n * math.fsum((c - grand) ** 2 for c in columns)
    error = math.fsum((x - r - c + grand) ** 2 for pair, r in zip(pairs, rows) for x, c in zip(pair, columns)) / (n - 1)
    below = of_rows + error + 2 / n * (of_columns - error)
    return (of_rows - error) / below if below > 1e-12 else None


def rotations(given):
    """Returns found and true quaternions with consistent signs; each frame is one list of numbers."""
    if not given["found_turns"] or not given["true_turns"]:
        return None
    truths = [continuous(joint, joint[0]) for joint in zip(*given["true_turns"])]
    founds = [continuous(joint, truth[0]) for joint, truth in zip(zip(*given["found_turns"]), truths)]
    return [[common.flat(frame) for frame in zip(*joints)] for joints in (founds, truths)]


def frame_distance(both):
    return common.mean([distance(a, b) for a, b in zip(*both)]) if both else None


def standardised(frames, statistics):
    """Returns the frames standardised; a frame with an unseen joint becomes null."""
    return [[(x - m) / s for p, (mean, spread) in zip(frame, statistics) for x, m, s in zip(p, mean, spread)]
            if all(frame) else None for frame in frames]


def l2p(given):
    pairs = zip(*(standardised(given[which], given["statistics"]) for which in ("found", "truth")))
    return common.mean([distance(a, b) for a, b in pairs if a and b])


def spectrum(signal, part):
    """Returns the powers of all Fourier coefficients by their definition; `part` turns a coefficient into a number."""
    n = len(signal)
    coefficients = [sum(x * cmath.exp(-2j * cmath.pi * k * i / n) for i, x in enumerate(signal)) for k in range(n)]
    powers = [part(c) ** 2 for c in coefficients]
    return powers if sum(powers) > 1e-24 * n * dot(signal, signal) else [0.0] * n


def npss(part, weight_alone=False):
    def of(given):
        both, length = rotations(given), given["window"]
        if not both:
            return None
        found, truth = both
        terms = []  # for each window and channel: (distance, weight)
        for begin in range(0, len(truth) - length + 1, length):
            for f, t in zip(zip(*found[begin:begin + length]), zip(*truth[begin:begin + length])):
                a, b = spectrum(f, part), spectrum(t, part)
                if sum(b) == 0:
                    continue
                shares = [[sum(power[:k + 1]) / sum(power) if sum(power) else 0.0 for k in range(length)] for power in (a, b)]
                terms.append((math.fsum(abs(x - y) for x, y in zip(*shares)), sum(b)))
        total = math.fsum(weight for _, weight in terms)
        if not terms:
            return None
        return total if weight_alone else math.fsum(value * weight for value, weight in terms) / total
    return of


def cubic(frames, at):
    """Returns the positions at time `at` (in frames), by the Catmull–Rom polynomial; None outside the motion."""
    if abs(at - round(at)) < 1e-9:
        return frames[round(at)] if 0 <= round(at) < len(frames) else None
    first = math.floor(at)
    if first < 1 or first + 2 >= len(frames):
        return None
    u = at - first
    weights = [(-u + 2 * u * u - u ** 3) / 2, (2 - 5 * u * u + 3 * u ** 3) / 2,
               (u + 4 * u * u - 3 * u ** 3) / 2, (u ** 3 - u * u) / 2]
    return [[math.fsum(w * frames[first - 1 + k][j][axis] for k, w in enumerate(weights)) for axis in range(3)]
            for j in range(len(frames[first]))]


def paired_distances(given, shift_s):
    """Returns for each pair of joints a row per frame: the answer's distance, the true distance, and the true
    distance's rate."""
    rate, truth = given["rate_hz"], given["truth"]
    joints = range(len(truth[0]))
    pairs = {(i, j): [] for j in joints for i in range(j)}
    for f in range(1, len(truth) - 1):
        found = cubic(given["found"], (f / rate + shift_s) * given["found_rate_hz"])
        for i, j in pairs if found else ():
            before, now, after = (distance(frame[i], frame[j]) for frame in truth[f - 1:f + 2])
            pairs[i, j].append((distance(found[i], found[j]), now, rate * (after - before) / 2))
    return [rows for rows in pairs.values() if rows]


def line(ys, xs):
    """Returns slope and intercept of the least-squares line."""
    mean_x, mean_y = common.mean(xs), common.mean(ys)
    square = math.fsum((x - mean_x) ** 2 for x in xs)
    slope = math.fsum((x - mean_x) * (y - mean_y) for x, y in zip(xs, ys)) / square if square > 0 else 0.0
    return slope, mean_y - slope * mean_x


def explained(given, shift_s):
    """Returns the number of distances, and the share of the answer's variance that lines of non-negative slope
    explain."""
    left = total = count = 0
    for rows in paired_distances(given, shift_s):
        found, truth, _ = zip(*rows)
        slope, start = line(found, truth)
        mean = common.mean(found)
        all_squares = math.fsum((f - mean) ** 2 for f in found)
        left += math.fsum((f - start - slope * t) ** 2 for f, t in zip(found, truth)) if slope > 0 else all_squares
        total += all_squares
        count += len(rows)
    return count, 1 - left / total if total > 0 else 0.0


def ahead(given, shift_s):
    """Returns Σ w β v · e, which is positive if the answer is read too late."""
    total = 0
    for rows in paired_distances(given, shift_s):
        found, truth, rates = zip(*rows)
        (slope, start), (along, level) = line(found, truth), line(rates, truth)
        mean, slope = common.mean(found), max(slope, 0)
        start = start if slope else mean
        rests = [f - start - slope * t for f, t in zip(found, truth)]
        weight = 1 / (common.mean([r * r for r in rests]) + 1e-6)
        total += weight * slope * math.fsum((v - level - along * t) * r for r, t, v in zip(rests, truth, rates))
    return total


def lag(given):
    rate = given["rate_hz"]
    if len(given["truth"]) < 5 or given["truth"][0] == given["truth"][-1]:
        return None
    least = explained(given, 0)[0] // 2
    shares = {}
    for k in sorted(range(-int(2 * rate), int(2 * rate) + 1), key=abs):
        count, share = explained(given, k / rate)
        if count >= max(least, 5):
            shares[k] = share
    best = max(shares, key=shares.get) / rate
    low, high = best - 0.6 / rate, best + 0.6 / rate
    for _ in range(50):
        middle = (low + high) / 2
        low, high = (low, middle) if ahead(given, middle) > 0 else (middle, high)
    return common.MM * (low + high) / 2


def speeds(frames):
    """Returns the distance moved per step, summed over joints; None if a joint is unseen."""
    if not all(all(frame) for frame in frames):
        return None
    return [math.fsum(distance(a, b) for a, b in zip(p, q)) for p, q in zip(frames, frames[1:])]


def beats(given, frames):
    return [round(beat * given["rate_hz"]) for beat in given["beats_s"] if 0 <= round(beat * given["rate_hz"]) < frames]


def nearness(ours, others):
    if not ours or not others:
        return None
    return common.mean([math.exp(-min((a - b) ** 2 for b in others) / (2 * BEAT_SIGMA ** 2)) for a in ours])


def bailando(given):
    steps = speeds(given["found"])
    if not steps:
        return None
    n = len(steps)
    mirrored = (steps + steps[::-1]) * 3  # the signal and its mirror image make one period
    weights = {k: math.exp(-k * k / (2 * SMOOTHING ** 2)) for k in range(-4 * SMOOTHING, 4 * SMOOTHING + 1)}
    smooth = [math.fsum(w * mirrored[2 * n + i + k] for k, w in weights.items()) for i in range(n)]
    lows = [i for i in range(1, n - 1) if smooth[i] < smooth[i - 1] and smooth[i] < smooth[i + 1]]
    return nearness(beats(given, n), lows)


def mint(given):
    steps = speeds(given["found"])
    if not steps:
        return None
    curve = [0.0, *steps]
    lows = [i for i in range(1, len(curve) - 1) if all(
        curve[i] < value for value in curve[max(i - MINT_ORDER, 0):i] + curve[i + 1:i + MINT_ORDER + 1])]
    return nearness(lows, beats(given, len(curve)))


METRICS = {
    "mpjpe_unaligned_mm": mpjpe(unaligned),
    "mpjpe_root_mm": mpjpe(by_root, False),
    "mpjpe_root_scaled_mm": mpjpe(by_root, True),
    "mpjpe_first_frame_mm": mpjpe(by_first, False),
    "mpjpe_first_frame_scaled_mm": mpjpe(by_first, True),
    "mpjpe_take_mm": mpjpe(by_take, False),
    "mpjpe_take_scaled_mm": mpjpe(by_take, True),
    "mpjpe_each_frame_mm": mpjpe(by_frame, False),
    "mpjpe_each_frame_scaled_mm": mpjpe(by_frame, True),
    "pck_150mm@mpi_inf_3dhp": pck,
    "auc_150mm@mpi_inf_3dhp": auc,
    "accel_error_mm@human_dynamics": accel_mm,
    "accel_error_mps2": accel_mps2,
    "accel_error_mps2@wham": accel_root,
    "w_mpjpe_mm@wham": mpjpe(by_segment, 2),
    "wa_mpjpe_mm@wham": mpjpe(by_segment, 0),
    "rte@wham": rte,
    "jitter@wham": jitter,
    "skating_ratio@gmd": gmd,
    "skate_from_height_mps@kimodo": kimodo,
    "skate_from_contacts_mps@kimodo": kimodo_contacts,
    "contact_f1": contact_f1,
    "pfc@edge": pfc,
    "penetration_mm": lambda given: common.mean([common.MM * max(-y, 0) for y in lowest(given)]),
    "floating_mm": lambda given: common.mean([common.MM * max(y, 0) for y in lowest(given)]),
    "bend_error_deg": bend_error,
    "angle_rmse_deg": over_angles(rmse),
    "angle_bias_deg": over_angles(bias),
    "angle_icc_a1": over_angles(icc_a1),
    "l2q@lafan1": lambda given: frame_distance(rotations(given)),
    "l2p@lafan1": l2p,
    "npss@lafan1": npss(lambda c: c.real),
    "npss_power@lafan1": npss(lambda c: c.real, weight_alone=True),
    "npss": npss(abs),
    "npss_power": npss(abs, weight_alone=True),
    "beat_alignment@bailando": bailando,
    "beat_alignment@mint": mint,
    "lag_ms": lag,
    "seen_share": seen_share,
}
