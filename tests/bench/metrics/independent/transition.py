"""Metrics of transitions."""
import math

from independent import common
from independent.common import BONES, ROLES, angle, cross, distance, dot, frames_of, minus, norm, pose_of

REACH = 5
FOOT_HEIGHT_CM = 2.5
FALSE_SMOOTH_CM = 20
NATURAL_QUANTILE = 0.95
SPARC_CUT_OFF_HZ, SPARC_THRESHOLD, SPARC_PADDING = 10, 0.05, 4


def difference(frames, joint, f, coefficients):
    """Returns ‖Σ c_i p(f + i − 1)‖: the second difference around f, or the third difference from f − 1 on."""
    return norm([math.fsum(c * frames[f + i - 1][joint][k] for i, c in enumerate(coefficients)) for k in range(3)])


def over_frames_near(given, needed_after, value):
    """Returns the worst value(frames, f) over the frames near a transition point that have the neighbours needed."""
    frames = frames_of(given["motion"])
    return common.worst([value(frames, f) for point in given["transition_points"]
                         for f in range(point - REACH, point + REACH + 1)
                         if f >= 1 and f + needed_after < len(frames)])


def jump_at(frames, f):
    return common.worst([common.CM * difference(frames, joint, f, (1, -2, 1)) for joint in ROLES])


def jump(given):
    return over_frames_near(given, 1, jump_at)


def mean_jump(given):
    return over_frames_near(given, 1, lambda frames, f: common.mean(
        [common.CM * difference(frames, joint, f, (1, -2, 1)) for joint in ROLES]))


def jerk(given):
    rate = given["motion"].get("rate_hz", 30)
    return over_frames_near(given, 2, lambda frames, f: common.worst(
        [rate ** 3 * difference(frames, joint, f, (-1, 3, -3, 1)) for joint in ROLES]))


def smallest_rotation(a, b):
    """Returns the smallest rotation from direction a to b (Rodrigues); identity if there is no axis."""
    axis, turn = cross(a, b), angle(a, b)
    size = norm(axis)
    if size == 0:
        return [[float(i == j) for j in range(3)] for i in range(3)]
    x, y, z = (component / size for component in axis)
    c, s = math.cos(turn), math.sin(turn)
    return [[c + x * x * (1 - c), x * y * (1 - c) - z * s, x * z * (1 - c) + y * s],
            [y * x * (1 - c) + z * s, c + y * y * (1 - c), y * z * (1 - c) - x * s],
            [z * x * (1 - c) - y * s, z * y * (1 - c) + x * s, c + z * z * (1 - c)]]


def rotation_step_change(given):
    def change(frames, f):
        changes = []
        for child, parent in BONES.items():
            before, here, after = (minus(frames[g][child], frames[g][parent]) for g in (f - 1, f, f + 1))
            first, second = smallest_rotation(before, here), smallest_rotation(here, after)
            quotient = [[dot(second[i], first[j]) for j in range(3)] for i in range(3)]  # R⁻¹ = Rᵀ
            twist = [quotient[2][1] - quotient[1][2], quotient[0][2] - quotient[2][0], quotient[1][0] - quotient[0][1]]
            trace = quotient[0][0] + quotient[1][1] + quotient[2][2]
            changes.append(common.degrees(math.atan2(norm(twist), trace - 1)))
        return common.worst(changes)
    return over_frames_near(given, 1, change)


def foot_slide(given):
    frames, rate = frames_of(given["motion"]), given["motion"].get("rate_hz", 30)

    def slide(point):
        speeds = []
        for f in range(point, min(point + int(rate), len(frames) - 1)):
            for foot in ("left_foot", "right_foot"):
                here, there = frames[f][foot], frames[f + 1][foot]
                speed = common.CM * rate * math.hypot(there[0] - here[0], there[2] - here[2])
                speeds.append(speed * min(1, max(0, 2 - 2 ** (common.CM * here[1] / FOOT_HEIGHT_CM))))
        return common.mean(speeds)
    return common.worst([slide(point) for point in given["transition_points"]])


def natural(given):
    if given["jump_cm"] is None:
        return 0
    jumps = []
    for clip in given["clips"]:
        frames = frames_of(clip)
        window = 2 * REACH + 1
        for first in range(1, len(frames) - window):
            jumps.append(common.worst([jump_at(frames, f) for f in range(first, first + window)]))
    jumps.sort()
    rank = NATURAL_QUANTILE * (len(jumps) - 1)
    low = math.floor(rank)
    high = min(low + 1, len(jumps) - 1)
    limit = jumps[low] + (rank - low) * (jumps[high] - jumps[low])
    return int(given["jump_cm"] <= limit * (1 + 1e-9))


def pose_gap(given):
    return common.worst([common.CM * distance(pose_of(m["leaving"])[role], pose_of(m["arriving"])[role])
                         for m in given["meetings"] for role in ROLES])


def velocity_gap(given):
    gaps = []
    for point in given["meetings"]:
        a, b, c, d = (pose_of(point[key]) for key in ("leaving_before", "leaving", "arriving", "arriving_after"))
        gaps += [common.CM * given["rate_hz"] * distance(minus(b[role], a[role]), minus(d[role], c[role]))
                 for role in ROLES]
    return common.worst(gaps)


def false_smooth(given):
    return int(given["pose_gap_cm"] > FALSE_SMOOTH_CM) if given["matched"] else None


def wait(given):
    return math.fsum((stay["until_frame"] - stay["from_frame"]) / given["rate_hz"] for stay in given["stays"])


ARM = [[(20, 1), (90, 0)], [(20, 0), (90, 1), (180, 0)], [(90, 0), (180, 1)]]
ELBOW = [[(0, 1), (90, 0)], [(20, 0), (90, 1)]]
POSTURE = [[(0, 1), (40, 0)], [(0, 0), (40, 1), (80, 0)], [(40, 0), (80, 1), (120, 0)], [(80, 0), (120, 1)]]
TRUNK = [[(125, 0), (180, 1)], [(110, 1), (180, 0)]]
LEG = [[(0, 1), (40, 0)], [(0, 0), (40, 1)]]
KNEE = [[(100, 0), (180, 1)], [(90, 1), (180, 0)]]
FEATURES = [ARM, ARM, ELBOW, ELBOW, POSTURE, TRUNK, LEG, LEG, KNEE, KNEE]


def grade(corners, value):
    if value <= corners[0][0]:
        return corners[0][1]
    for (x0, y0), (x1, y1) in zip(corners, corners[1:]):
        if value <= x1:
            return y0 + (y1 - y0) * (value - x0) / (x1 - x0)
    return corners[-1][1]


def fuzzy_distance(given):
    return common.worst([math.sqrt(math.fsum(
        weight * (grade(term, a) - grade(term, b)) ** 2
        for weight, terms, a, b in zip(given["weights"], FEATURES, change["from_features"], change["to_features"],
                                       strict=True) for term in terms)) for change in given["switches"]])


def speed_profile(given):
    frames, rate = frames_of(given["motion"]), given["motion"].get("rate_hz", 30)
    first = max(0, given["transition_points"][0] - int(rate))
    last = min(len(frames) - 1, given["transition_points"][-1] + int(rate))
    return [common.mean([rate * distance(frames[f + 1][role], frames[f][role]) for role in ROLES])
            for f in range(first, last)], rate


def sparc(given):
    speed, rate = (given["speed_mps"], given["rate_hz"]) if "speed_mps" in given else speed_profile(given)
    if len(speed) < 2:
        return None
    size = 2 ** (math.ceil(math.log2(len(speed))) + SPARC_PADDING)
    spectrum = []
    for i in range(size):
        if i * rate / size > SPARC_CUT_OFF_HZ:
            break
        real = math.fsum(v * math.cos(2 * math.pi * i * n / size) for n, v in enumerate(speed))
        imaginary = math.fsum(v * math.sin(2 * math.pi * i * n / size) for n, v in enumerate(speed))
        spectrum.append(math.hypot(real, imaginary))
    if max(spectrum) == 0:
        return None
    spectrum = [v / max(spectrum) for v in spectrum]
    loud = [i for i, v in enumerate(spectrum) if v >= SPARC_THRESHOLD]
    steps = loud[-1] - loud[0]
    if steps == 0:
        return None
    return -math.fsum(math.hypot(1 / steps, spectrum[i + 1] - spectrum[i]) for i in range(loud[0], loud[-1]))


JERK_ORDER = 2  # derivative of the speed


def ldlj(given):
    speed, rate = (given["speed_mps"], given["rate_hz"]) if "speed_mps" in given else speed_profile(given)
    derivative = list(speed)
    for _ in range(JERK_ORDER):
        derivative = [(b - a) * rate for a, b in zip(derivative, derivative[1:])]
    jerk = math.fsum(j * j for j in derivative) / rate
    if jerk == 0:
        return None
    duration = len(speed) / rate
    return -math.log(duration ** 3 / max(abs(v) for v in speed) ** 2 * jerk)


def in_between(given):
    return None if given["legs"] is None else int(given["legs"] > 2)


def matching(given):
    return [pair for pair in given["pairs"] if pair["distance"] < given["threshold"]]


def direct_match(given):
    return None if given["threshold"] is None else int(len(matching(given)) > 0)


def matching_share(given):
    if given["threshold"] is None or not given["pairs"]:
        return None
    return len(matching(given)) / len(given["pairs"])


def false_smooth_share(given):
    if given["threshold"] is None or not matching(given):
        return None
    return sum(pair["pose_gap_cm"] > FALSE_SMOOTH_CM for pair in matching(given)) / len(matching(given))


ARRIVED_CM = 5
LIVE_FRAMES = 10
LEAST_SPEED_MPS = 0.05
VELOCITY_S = 0.1


def worst_distance(a, b):
    return common.worst([common.CM * distance(a[role], b[role]) for role in ROLES])


def settled_frame(join):
    shown, wanted = frames_of(join["shown"]), frames_of(join["wanted"])
    off = [f for f in range(join["last"], len(shown))
           if worst_distance(shown[f], wanted[f - join["last"]]) > ARRIVED_CM + 1e-12]
    settled = max(off) + 1 if off else join["last"]
    return settled if settled < len(shown) else None


def join_end(join):
    settled, last = settled_frame(join), len(frames_of(join["shown"])) - 1
    return min(max(last if settled is None else settled, join["last"] + REACH), last)


def rate_of(join):
    return join["shown"].get("rate_hz", 30)


def settle(given):
    settled = settled_frame(given["join"])
    return None if settled is None else (settled - given["join"]["request"]) / rate_of(given["join"])


def seen_from_itself(frames, f, rate):
    """Returns positions, and displacements within VELOCITY_S, of a body turned to face +Z above the origin."""
    here, before = frames[f], frames[f - 1]
    left = [sum(pair) for pair in zip(minus(here["left_hip"], here["right_hip"]),
                                      minus(here["left_shoulder"], here["right_shoulder"]))]
    facing = (-left[2], left[0])  # left × up on the floor, as (x, z)
    size = math.hypot(*facing)
    sine, cosine = (facing[0] / size, facing[1] / size) if size > 0 else (0, 1)

    def turned(v):
        return [cosine * v[0] - sine * v[2], v[1], sine * v[0] + cosine * v[2]]
    hips = [here["hip_centre"][0], 0, here["hip_centre"][2]]
    return {role: (turned(minus(here[role], hips)),
                   turned([VELOCITY_S * rate * d for d in minus(here[role], before[role])])) for role in ROLES}


def strange(given):
    join = given["join"]
    shown, rate = frames_of(join["shown"]), rate_of(join)
    real = [seen_from_itself(clip, f, rate) for clip in map(frames_of, given["clips"]) for f in range(1, len(clip))]

    def off(f):
        own = seen_from_itself(shown, f, rate)
        return min(common.CM * math.sqrt(common.mean(
            [distance(own[r][0], other[r][0]) ** 2 + distance(own[r][1], other[r][1]) ** 2 for r in ROLES]))
            for other in real)
    return math.fsum(off(f) for f in range(join["first"] + 1, join_end(join) + 1)) / rate


def join_slide(given):
    join = given["join"]
    frames, rate = frames_of(join["shown"]), rate_of(join)
    end = min(max(join_end(join), join["last"] + int(rate)), len(frames) - 1)
    speeds = []
    for f in range(join["first"], end):
        for foot in ("left_foot", "right_foot"):
            here, there = frames[f][foot], frames[f + 1][foot]
            speed = common.CM * rate * math.hypot(there[0] - here[0], there[2] - here[2])
            speeds.append(speed * min(1, max(0, 2 - 2 ** (common.CM * here[1] / FOOT_HEIGHT_CM))))
    return common.mean(speeds)


def live(given):
    join = given["join"]
    frames, rate = frames_of(join["shown"]), int(rate_of(join))
    speed = [common.mean([rate * distance(b[role], a[role]) for role in ROLES]) for a, b in zip(frames, frames[1:])]

    def slowest(first, last):
        own = speed[max(first, 0):max(last, 0)]
        means = [common.mean(own[i:i + LIVE_FRAMES]) for i in range(len(own) - LIVE_FRAMES + 1)]
        return min(means) if means else None
    first = join["first"]
    end = max(join_end(join), first + LIVE_FRAMES)
    clips = [v for v in (slowest(first - rate, first), slowest(end, end + rate)) if v is not None]
    own = slowest(first, end)
    return 1 if own is None or not clips or min(clips) < LEAST_SPEED_MPS else min(1, own / min(clips))


def skipped_frames(given):
    return given["entered_frame"] or 0  # `unbroken` enters no clip


def skipped(given):
    return skipped_frames(given) / given["rate_hz"]


def skipped_share(given):
    return skipped_frames(given) / given["clip_frames"]


def limit_of(frames):
    window = 2 * REACH + 1
    jumps = sorted(common.worst([jump_at(frames, f) for f in range(first, first + window)])
                   for first in range(1, len(frames) - window))
    rank = NATURAL_QUANTILE * (len(jumps) - 1)
    low = math.floor(rank)
    high = min(low + 1, len(jumps) - 1)
    return jumps[low] + (rank - low) * (jumps[high] - jumps[low])


def calm_natural(given):
    join = given["join"]
    shown, left, wanted = (frames_of(join[key]) for key in ("shown", "left", "wanted"))
    limit = min(limit_of(frames_of(clip)) for clip in given["clips"])

    def own_jump(frames, f):
        return jump_at(frames, f) if 1 <= f < len(frames) - 1 else 0

    def excused(f):
        return 1.25 * max(own_jump(wanted, f - join["last"]), own_jump(left, f))
    return int(all(jump_at(shown, f) <= max(limit, 1, excused(f))
                   for f in range(join["first"], join_end(join) + 1) if 1 <= f < len(shown) - 1))


MOST_SKIPPED = 1 / 3


def clean_v3(given):
    settled = given["settle_s"]
    return int(given["natural"] and given["calmly_natural"] and given["slide_cmps"] <= max(6, given["own_slide_cmps"])
               and settled is not None and settled <= 1.5 and given["strange_cm_s"] <= 10 and given["live"] >= 0.5
               and given["supported"] and given["skipped_share"] <= MOST_SKIPPED)


MOST_OF_BODY = {"zmp_off_cm": 25, "slip_mps2": 2, "glide_cm": 2, "foot_turn_deg": 60, "beyond_joint_deg": 0,
                "overlap_cm": 0, "sunk_cm": 3}


def clean(given):
    return int(clean_v3(given) and all((given["body"][name] or 0) <= most for name, most in MOST_OF_BODY.items()))


METRICS = {
    "settle_s": settle,
    "strange_cm_s": strange,
    "join_slide_cmps": join_slide,
    "live": live,
    "skipped_s": skipped,
    "skipped_share": skipped_share,
    "calm_natural_share": calm_natural,
    "clean_share": clean,
    "clean_share_v3": clean_v3,
    "jump_cm": jump,
    "mean_joint_jump_cm": mean_jump,
    "rotation_step_change_deg": rotation_step_change,
    "jerk_peak_mps3": jerk,
    "foot_slide_cmps": foot_slide,
    "pose_gap_cm": pose_gap,
    "velocity_gap_cmps": velocity_gap,
    "false_smooth": false_smooth,
    "natural_share": natural,
    "wait_s": wait,
    "fuzzy_distance": fuzzy_distance,
    "sparc": sparc,
    "ldlj": ldlj,
    "direct_match": direct_match,
    "matching_share": matching_share,
    "false_smooth_share": false_smooth_share,
    "in_between": in_between,
}
