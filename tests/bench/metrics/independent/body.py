"""A second implementation of impossible motion (bench/metrics/transition_body.h), for a `join` that transition.py
reads."""
import math

from independent import common, support
from independent.common import angle, cross, distance, dot, frames_of, minus, norm
from independent.transition import rate_of

GRAVITY = 9.81
FRICTION = 1
CARRIED = 0.5  # share of the body's weight
REACH = 4  # half width of the window in which an acceleration is fitted, frames
REST_MPS = 0.3
KNEE, NECK, TRUNK, INWARD, OUTWARD, FOLD = 25, 75, 75, 60, 110, 20
UPRIGHT = 0.7
ARM_CM, LEGS_CM = 3.5, 3
AROUND = 30  # frames before and after the join in which a clip's support is measured
NEAR = 3  # frames; a join's fault is excused if the clip has the same fault at most this far away
ALLOWANCE = 1.25
SUSTAINED = {"zmp": 5, "slip": 3, "beyond": 3, "overlap": 2, "sunk": 4}
GLIDE_FRAMES = 15
FEET = ["left_ankle", "left_foot", "right_ankle", "right_foot"]


def wrapped(turn):
    return math.remainder(turn, 2 * math.pi)


def heading(a, b):
    x, z = b[0] - a[0], b[2] - a[2]
    return None if math.hypot(x, z) < 0.03 else math.atan2(x, z)


def hip_heading(pose):
    line = heading(pose["right_hip"], pose["left_hip"])
    return None if line is None else line - math.pi / 2


def accelerations(frames, rate):
    """Returns the mass centre's acceleration per frame: the second derivative of a least-squares parabola."""
    centres = [support.mass_centre(pose) for pose in frames]
    times = [i / rate for i in range(-REACH, REACH + 1)]
    n, second, fourth = len(times), math.fsum(t * t for t in times), math.fsum(t ** 4 for t in times)

    def at(f):
        if len(frames) < n:
            return [0, 0, 0]
        middle = min(max(f, REACH), len(frames) - 1 - REACH)
        out = []
        for axis in range(3):
            values = [centres[middle + i][axis] for i in range(-REACH, REACH + 1)]
            square, whole = math.fsum(v * t * t for v, t in zip(values, times)), math.fsum(values)
            out.append(2 * (n * square - second * whole) / (n * fourth - second * second))
        return out
    return centres, [at(f) for f in range(len(frames))]


def overextension(pose, side):
    """Degrees; 0 unless the line of the hips, and toes that are at least 37° off the shank, show a bend backwards."""
    hip, knee, ankle, foot = (pose[f"{side}_{name}"] for name in ("hip", "knee", "ankle", "foot"))
    thigh, shank, toes = minus(knee, hip), minus(ankle, knee), minus(foot, ankle)
    hinge = cross(thigh, shank)
    backwards = dot(hinge, minus(pose["right_hip"], pose["left_hip"])) / norm(minus(pose["right_hip"], pose["left_hip"]))
    if backwards <= 0.2 * norm(hinge):
        return 0.0
    along = dot(toes, shank) / norm(shank)
    across = math.sqrt(max(dot(toes, toes) - along * along, 0))
    if across <= 0.6 * norm(toes):
        return math.degrees(math.atan2(backwards, dot(thigh, shank)))
    thigh_along = dot(thigh, shank) / norm(shank)
    ahead = (dot(thigh, toes) - thigh_along * along) / across
    return max(0.0, -math.degrees(math.atan2(ahead, thigh_along)))


def corner(pose, a, b, c):
    return math.degrees(angle(minus(pose[a], pose[b]), minus(pose[c], pose[b])))


def beyond(pose, bears):
    trunk = minus(pose["shoulder_centre"], pose["hip_centre"])
    axis = [v / norm(trunk) for v in trunk] if norm(trunk) > 1e-9 else [0, 1, 0]

    def across(name):
        line = minus(pose[f"left_{name}"], pose[f"right_{name}"])
        return minus(line, [dot(line, axis) * v for v in axis])
    found = [0, 180 - corner(pose, "spine", "shoulder_centre", "head") - NECK,
             math.degrees(angle(across("hip"), across("shoulder"))) - TRUNK]
    hips = hip_heading(pose)
    for side, sign in (("left", 1), ("right", -1)):
        found += [overextension(pose, side) - KNEE,
                  FOLD - corner(pose, f"{side}_shoulder", f"{side}_elbow", f"{side}_wrist"),
                  FOLD - corner(pose, f"{side}_hip", f"{side}_knee", f"{side}_ankle")]
        toes = heading(pose[f"{side}_ankle"], pose[f"{side}_foot"])
        stands = {f"{side}_ankle", f"{side}_foot"} & bears and trunk[1] >= UPRIGHT * norm(trunk)
        if stands and hips is not None and toes is not None:
            outward = sign * math.degrees(wrapped(toes - hips))
            found += [outward - OUTWARD, -outward - INWARD]
    return max(found)


def between(a, b, t):
    return [x + t * (y - x) for x, y in zip(a, b)]


def to_segment(p, c, d):
    line = minus(d, c)
    squared = dot(line, line)
    t = min(max(dot(minus(p, c), line) / squared, 0), 1) if squared > 0 else 0
    return distance(p, between(c, d, t))


def segment_distance(a, b, c, d):
    """Returns the distance of two segments: from an end to the other segment, or between inner points whose line is
    perpendicular to both."""
    found = [to_segment(a, c, d), to_segment(b, c, d), to_segment(c, a, b), to_segment(d, a, b)]
    u, v, w = minus(b, a), minus(d, c), minus(c, a)
    normal = cross(u, v)
    if dot(normal, normal) > 1e-12:
        s, t = dot(cross(w, v), normal) / dot(normal, normal), dot(cross(w, u), normal) / dot(normal, normal)
        if 0 <= s <= 1 and 0 <= t <= 1:
            found.append(distance(between(a, b, s), between(c, d, t)))
    return min(found)


def overlap(pose):
    low, middle = between(pose["hip_centre"], pose["spine"], 0.3), pose["spine"]
    high = between(middle, pose["shoulder_centre"], 0.95)
    deepest = LEGS_CM - common.CM * segment_distance(*(pose[f"{s}_{j}"] for s in ("left", "right") for j in ("knee", "ankle")))
    for side in ("left", "right"):
        elbow, wrist, hand = (pose[f"{side}_{name}"] for name in ("elbow", "wrist", "hand"))
        nearest = min(segment_distance(elbow, wrist, pose["shoulder_centre"], pose["head"]),
                      *(segment_distance(*part, *trunk) for part in ((elbow, wrist), (wrist, hand))
                        for trunk in ((low, middle), (middle, high))))
        deepest = max(deepest, ARM_CM - common.CM * nearest)
    return max(deepest, 0.0)


def frames_measured(frames, rate, joints, holds, first):
    """Measures the frames from `first` on by what needs no clip. `joints` and `holds` are their support."""
    centres, accelerated = accelerations(frames, rate)
    moving = support.velocities(frames, rate)
    measured = []
    for f, (bears, holds_here) in enumerate(zip(joints, holds), first):
        pose, a, c = frames[f], accelerated[f], centres[f]
        here = {"flies": holds_here and not bears, "zmp": None, "slip": None, "beyond": beyond(pose, bears),
                "overlap": overlap(pose), "bears": bears, "twist": {}}
        if bears:
            up, along = a[1] + GRAVITY, math.hypot(a[0], a[2])
            here["slip"] = max(along - FRICTION * max(up, 0), 0) + max(-up, 0)
            if up >= CARRIED * GRAVITY:
                lever = (c[1] - min(pose[role][1] for role in bears)) / up
                here["zmp"] = common.CM * support.distance_to_hull(
                    (c[0] - lever * a[0], c[2] - lever * a[2]), [(pose[role][0], pose[role][2]) for role in bears])
        hips = hip_heading(pose)
        for side in ("left", "right"):
            foot = {f"{side}_ankle", f"{side}_foot"}
            toes = heading(pose[f"{side}_ankle"], pose[f"{side}_foot"])
            if foot & bears and hips is not None and toes is not None and all(norm(moving[f][j]) <= REST_MPS for j in foot):
                here["twist"][side] = wrapped(hips - toes)
        measured.append(here)
    return measured


class Beside:
    """The part of a clip that is compared with the join. Frame `begin` of the motion shown is the clip's first
    frame."""

    def __init__(self, frames, begin, first, last, rate):
        start = min(max(first - begin - AROUND, 0), len(frames) - 1)
        stop = min(max(last - begin + AROUND, start), len(frames) - 1)
        self.frames, self.begin = frames[start:stop + 1], begin + start
        own = support.Clip(self.frames, rate, 0, math.inf)
        self.measured = frames_measured(self.frames, rate, *support.held(self.frames, [own], rate, 0, stop - start), 0)

    def near(self, shown, reach):
        """Returns the indices of the clip's frames within `reach` of a frame shown, clamped to the clip."""
        last, now = len(self.frames) - 1, shown - self.begin
        return range(min(max(now - reach, 0), last), min(max(now + reach, 0), last) + 1)

    def floor(self, shown):
        return min(p[1] for f in self.near(shown, 10) for p in self.frames[f].values())


def travel(frames, f, role, clip=None, at=0):
    """Returns a joint's shorter horizontal way (cm), from the frame before or to the frame after, minus the clip's."""
    ways = []
    for step in (-1, 1):
        if not 0 <= f + step < len(frames) or clip and not 0 <= at + step < len(clip):
            continue
        way = minus(frames[f + step][role], frames[f][role])
        if clip:
            way = minus(way, minus(clip[at + step][role], clip[at][role]))
        ways.append(common.CM * math.hypot(way[0], way[2]))
    return min(ways, default=None)


def gliding(shown, f, here, clips):
    if here["flies"]:
        return 0
    found = []
    for role in here["bears"] or FEET:
        ways = [travel(shown, f, role)]
        for clip in clips:
            now = f - clip.begin
            if 0 <= now < len(clip.frames) and role in (clip.measured[now]["bears"] or support.ROLES):
                ways.append(travel(shown, f, role, clip.frames, now))
        found.append(min((way for way in ways if way is not None), default=0))
    return min(found)


def sustained(measured, key):
    """Returns the largest value that SUSTAINED[key] successive frames reach; skips frames without one; flights
    interrupt."""
    count, worst, row = SUSTAINED[key], None, []
    for here in measured:
        if here["flies"]:
            row = []
        if here[key] is None:
            continue
        row.append(here[key])
        worst = max(worst or 0, min(row[-count:]) if len(row) >= count else 0)
    return worst


def largest_turn(measured):
    largest = 0
    for side in ("left", "right"):
        row = []
        for before, here in zip([{"twist": {}}, *measured], measured):
            if side not in before["twist"] or side not in here["twist"]:
                row = [0]
            else:
                row.append(row[-1] + wrapped(here["twist"][side] - before["twist"][side]))
            largest = max(largest, max(row) - min(row))
    return math.degrees(largest)


def measure(join):
    shown, rate = frames_of(join["shown"]), rate_of(join)
    joints, holds = support.support(join)
    first, last = join["first"], join["first"] + len(joints) - 1
    clips = [Beside(frames_of(join["left"]), 0, first, last, rate),
             Beside(frames_of(join["wanted"]), join["last"], first, last, rate),
             *(Beside(frames_of(clip), clip["begin"], first, last, rate) for clip in join.get("between", []))]
    measured = frames_measured(shown, rate, joints, holds, first)
    for f, here in enumerate(measured, first):
        for key in ("zmp", "slip", "beyond", "overlap"):
            own = max((clip.measured[k][key] or 0 for clip in clips for k in clip.near(f, NEAR)))
            if here[key] is not None and here[key] <= ALLOWANCE * own:
                here[key] = 0
        here["glide"] = gliding(shown, f, here, clips)
        here["sunk"] = common.CM * max(min(clip.floor(f) for clip in clips) - min(p[1] for p in shown[f].values()), 0)
    found = {key: sustained(measured, key) for key in SUSTAINED}
    found["glide"] = max(math.fsum(here["glide"] for here in measured[max(i - GLIDE_FRAMES + 1, 0):i + 1])
                         for i in range(len(measured)))
    found["turn"] = largest_turn(measured)
    for clip in clips:
        middle = (first + last) // 2
        if found["turn"] <= ALLOWANCE * largest_turn([clip.measured[k] for k in clip.near(middle, (last - first + 1) // 2)]):
            found["turn"] = 0
    return found


def of(key):
    return lambda given: measure(given["join"])[key]


METRICS = {"zmp_off_cm": of("zmp"), "slip_mps2": of("slip"), "glide_cm": of("glide"), "foot_turn_deg": of("turn"),
           "beyond_joint_deg": of("beyond"), "overlap_cm": of("overlap"), "sunk_cm": of("sunk")}
