"""Metrics of any answer against any truth: frames, each a list of positions, null where a joint is not seen."""
import math

from . import common
from .capture import largest_eigen
from .common import cross, distance, dot, minus, norm

LOW_M, GMD_MPS, GMD_REACH = 0.05, 0.5, 2
PCK_MM, AUC_STEP_MM, AUC_STEPS = 150, 5, 31
FEWEST = 3


def seen_pairs(found, truth):
    return [(a, b) for a, b in zip(found, truth, strict=True) if a and b]


def rotation_of(quaternion):
    w, x, y, z = quaternion
    return [[w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z]]


def fit(pairs, scaled):
    """What maps the first points onto the second, by Horn's quaternions; None where it is not determined."""
    if len(pairs) < FEWEST:
        return None
    centre, goal = ([common.mean([pair[side][k] for pair in pairs]) for k in range(3)] for side in (0, 1))
    moved = [(minus(a, centre), minus(b, goal)) for a, b in pairs]
    (xx, xy, xz), (yx, yy, yz), (zx, zy, zz) = (
        [math.fsum(a[i] * b[j] for a, b in moved) for j in range(3)] for i in range(3))
    largest, quaternion = largest_eigen([
        [xx + yy + zz, yz - zy, zx - xz, xy - yx], [yz - zy, xx - yy - zz, xy + yx, zx + xz],
        [zx - xz, xy + yx, yy - xx - zz, yz + zy], [xy - yx, zx + xz, yz + zy, zz - xx - yy]])
    scatter = math.fsum(dot(a, a) for a, _ in moved)
    scale = largest / scatter if scaled and scatter > 0 else 1.0
    rotation = rotation_of(quaternion)
    return lambda p: [goal[i] + scale * dot(rotation[i], minus(p, centre)) for i in range(3)]


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
    """Each joint's weighted sums over as many frames in a row as there are weights; None where one is not seen."""
    sums = []
    for f in range(len(frames) - len(weights) + 1):
        rows = frames[f:f + len(weights)]
        sums.append([[math.fsum(w * row[j][k] for w, row in zip(weights, rows)) for k in range(3)]
                     if all(row[j] for row in rows) else None for j in range(len(rows[0]))])
    return sums


def acceleration_error(found, truth, left_out=0):
    """`left_out`: of the accelerations, so many at either end."""
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
    if largest == 0:
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
    """One joint's quaternions, each with the sign that lies nearer to the one before, the first to `start`."""
    kept = []
    for q in quaternions:
        before = kept[-1] if kept else start
        kept.append([-x for x in q] if dot(q, before) < 0 else list(q))
    return kept


def l2q(given):
    if not given["found_turns"] or not given["true_turns"]:
        return None
    truths = [continuous(joint, joint[0]) for joint in zip(*given["true_turns"])]
    founds = [continuous(joint, truth[0]) for joint, truth in zip(zip(*given["found_turns"]), truths)]
    frames = zip(zip(*founds), zip(*truths))
    return common.mean([math.sqrt(math.fsum(distance(a, b) ** 2 for a, b in zip(p, t))) for p, t in frames])


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
    "pfc@edge": pfc,
    "penetration_mm": lambda given: common.mean([common.MM * max(-y, 0) for y in lowest(given)]),
    "floating_mm": lambda given: common.mean([common.MM * max(y, 0) for y in lowest(given)]),
    "bend_error_deg": bend_error,
    "l2q@lafan1": l2q,
    "seen_share": seen_share,
}
