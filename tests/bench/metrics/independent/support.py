"""A second implementation of the search for the joints that bear the body (engine/motion/support.h), for a `join`
that transition.py reads."""
import math

from independent import common
from independent.common import ROLES, frames_of, minus, norm
from independent.transition import join_end, rate_of

LOWEST = 0.12  # a joint at most this high above the lowest joint may bear weight (m)
REST_MPS = 0.5
HEIGHT = 0.025
HEEL = 0.03  # a heel is raised if it is this much higher than in a flat foot (m)
TOES = 0.05  # toes this high above the lowest joint are in the air (m)
LEVEL = 0.12  # resting heights further apart than this belong to two surfaces (m)
WINDOW_S = 1 / 3
FALL_MPS2 = (6.5, 13)
STRAY = 0.008
MAX_PUSH = 3  # largest push of the ground at a take-off, in body weights
GRAVITY = 9.81
FEWEST_OF_A_FLIGHT = 5
FLOATING_FRAMES = 4
JUDGED_S = 1.2
GLIDING = 3
FALLING_S = 0.1  # step of the second difference that decides whether a clip's centre of mass falls freely (s)

# Dempster's table (Winter 2009, table 4.1): mass, and the centre's position on the way from the first joint to the
# second, as shares.
SEGMENTS = [("shoulder_centre", "head", 0.081, 1.0), ("shoulder_centre", "hip_centre", 0.497, 0.5)] + [
    (f"{side}_{a}", f"{side}_{b}", mass, centre) for side in ("left", "right") for a, b, mass, centre in [
        ("shoulder", "elbow", 0.028, 0.436), ("elbow", "wrist", 0.016, 0.430), ("wrist", "hand", 0.006, 0.506),
        ("hip", "knee", 0.100, 0.433), ("knee", "ankle", 0.0465, 0.433), ("ankle", "foot", 0.0145, 0.500)]]


def mass_centre(pose):
    return [math.fsum(m * ((1 - c) * pose[a][axis] + c * pose[b][axis]) for a, b, m, c in SEGMENTS)
            for axis in range(3)]


def velocities(frames, rate):
    last = len(frames) - 1

    def at(f):
        before, after = max(f - 1, 0), min(f + 1, last)
        return {role: [d * rate / (after - before) if after > before else 0.0
                       for d in minus(frames[after][role], frames[before][role])] for role in ROLES}
    return [at(f) for f in range(len(frames))]


def falling(frames, rate):
    """Returns for each frame of a clip whether its mass centre falls freely; its slow joints then rest on nothing."""
    reach, last = max(round(FALLING_S * rate), 1), len(frames) - 1
    heights = [mass_centre(pose)[1] for pose in frames]

    def at(f):
        f = min(max(f, reach), last - reach)
        return heights[f - reach] + heights[f + reach] - 2 * heights[f] <= -FALL_MPS2[0] * (reach / rate) ** 2
    return [last >= 2 * reach and at(f) for f in range(len(frames))]


def over_floor(v):
    return math.hypot(v[0], v[2])


class Clip:
    """A clip that shows what a body may rest on. Frame `begin` of the motion shown is the clip's first frame."""

    def __init__(self, frames, rate, begin, left_at):
        self.frames, self.begin, self.left_at = frames, begin, left_at
        self.window = round(WINDOW_S * rate)
        self.velocities = velocities(frames, rate)
        self.rests, self.bears = [], []
        for pose, v, falls in zip(frames, self.velocities, falling(frames, rate)):
            lowest = min(p[1] for p in pose.values())
            low = [role for role in ROLES if pose[role][1] <= lowest + LOWEST]
            rests = {role for role in low if norm(v[role]) <= REST_MPS and not falls}
            carried = {role for role in low if over_floor(v[role]) <= max(
                REST_MPS, GLIDING * over_floor(minus(v[role], v["hip_centre"])))}
            self.rests.append(rests)
            self.bears.append(rests or carried)
        for side in ("left", "right"):
            self.remove_raised(f"{side}_ankle", f"{side}_foot")

    def remove_raised(self, ankle, foot):
        """Removes raised heels whose toes bear, and toes in the air, from the support, unless nothing else bears the
        body."""
        rises = [pose[ankle][1] - pose[foot][1] for pose in self.frames]
        flat = min((rise for rise, rests in zip(rises, self.rests) if {ankle, foot} <= rests), default=math.inf)
        for f, pose in enumerate(self.frames):
            raised = {ankle} if foot in self.bears[f] and rises[f] > flat + HEEL else set()
            if pose[foot][1] > min(p[1] for p in pose.values()) + TOES:
                raised.add(foot)
            if self.bears[f] - raised:
                self.rests[f], self.bears[f] = self.rests[f] - raised, self.bears[f] - raised

    def follows(self, shown, role, place, velocity):
        now = shown - self.begin
        return any(role in self.bears[f] and abs(place[1] - self.frames[f][role][1]) <= HEIGHT
                   and norm(minus(velocity, self.velocities[f][role])) <= REST_MPS
                   for f in (now - 1, now, now + 1) if 0 <= f < len(self.frames))

    def rests_here(self, shown, role, place, velocity):
        if norm(velocity) > REST_MPS:
            return False
        last = len(self.frames) - 1
        first, end = min(shown, self.left_at) - self.window - self.begin, shown + self.window - self.begin
        asked = range(min(max(first, 0), last), min(max(end, 0), last) + 1)
        heights = sorted(self.frames[f][role][1] for f in asked if role in self.rests[f])
        if not any(role in rests for rests in self.rests):
            heights = sorted(self.frames[f][role][1] for f in range(last + 1) if role in self.bears[f])[:1]
        if not heights:
            return False
        surfaces = [h for below, h in zip(heights, heights[1:]) if h - below > LEVEL]
        return (-LEVEL <= place[1] - heights[0] <= HEIGHT
                or any(abs(place[1] - h) <= HEIGHT for h in surfaces))


def flies(frames, rate):
    """Returns true if the mass centre follows a ballistic parabola. It is fitted by the normal equations, with times
    from the middle."""
    n = len(frames)
    if n < FEWEST_OF_A_FLIGHT:
        return False
    times = [(i - (n - 1) / 2) / rate for i in range(n)]
    heights = [mass_centre(pose)[1] for pose in frames]
    second, fourth = (math.fsum(t ** k for t in times) for k in (2, 4))
    whole, slope, square = (math.fsum(h * t ** k for t, h in zip(times, heights)) for k in (0, 1, 2))
    a = (n * square - second * whole) / (n * fourth - second * second)
    c = (whole - a * second) / n
    off = [h - (a * t * t + slope / second * t + c) for t, h in zip(times, heights)]
    return FALL_MPS2[0] <= -2 * a <= FALL_MPS2[1] and math.sqrt(math.fsum(o * o for o in off) / n) <= STRAY


def thrown(shown, start, rate):
    """Returns true if the ground, in the last frame on it, can push hard enough for this flight."""
    if start < 2 or start + 1 >= len(shown):
        return True
    heights = {f: mass_centre(shown[f])[1] for f in range(start - 2, start + 2)}
    return all(1 + (heights[f - 1] - 2 * heights[f] + heights[f + 1]) * rate ** 2 / GRAVITY <= MAX_PUSH
               for f in (start - 1, start))


def support(join):
    """Returns for each frame judged the joints that bear the body, and whether the body is supported or in flight."""
    shown, rate = frames_of(join["shown"]), rate_of(join)
    first, last, end = join["first"], join["last"], len(shown) - 1
    judged = min(max(join_end(join), first + round(JUDGED_S * rate)), end)
    clips = [Clip(frames_of(join["left"]), rate, 0, first), Clip(frames_of(join["wanted"]), rate, last, math.inf),
             *(Clip(frames_of(clip), rate, clip["begin"], clip["left_at"]) for clip in join.get("between", []))]
    return held(shown, clips, rate, first, judged)


def held(shown, clips, rate, first, judged):
    """Does the same as support() for the frames `first` to `judged`."""
    end, moving = len(shown) - 1, velocities(shown, rate)

    def held_by(f):
        return {role for role in ROLES for clip in clips
                if clip.follows(f, role, shown[f][role], moving[f][role])
                or clip.rests_here(f, role, shown[f][role], moving[f][role])}
    joints = []
    while len(joints) <= judged - first or (not joints[-1] and first + len(joints) <= end):
        joints.append(held_by(first + len(joints)))
    holds = [bool(own) for own in joints]
    start = 0
    while start < len(joints):
        stop = start
        while stop < len(joints) and not joints[stop]:
            stop += 1
        if 0 < start < stop < len(joints) and thrown(shown, first + start, rate) and any(
                flies(shown[first + start - more:first + stop + more], rate) for more in (0, 1)):
            holds[start:stop] = [True] * (stop - start)
        start = max(stop, start + 1)
    count = judged - first + 1
    return joints[:count], holds[:count]


def longest_unsupported(given):
    longest = run = 0
    for holds in support(given["join"])[1]:
        run = 0 if holds else run + 1
        longest = max(longest, run)
    return longest


def supported(given):
    return int(longest_unsupported(given) < FLOATING_FRAMES)


def hull(points):
    """Returns the convex hull, anticlockwise (Andrew's monotone chain)."""
    points = sorted(set(points))
    if len(points) < 3:
        return points

    def half(ordered):
        chain = []
        for p in ordered:
            while len(chain) > 1 and ((chain[-1][0] - chain[-2][0]) * (p[1] - chain[-2][1])
                                      - (chain[-1][1] - chain[-2][1]) * (p[0] - chain[-2][0])) <= 0:
                chain.pop()
            chain.append(p)
        return chain[:-1]
    return half(points) + half(points[::-1])


def distance_to_hull(point, points):
    corners = hull(points)
    edges = list(zip(corners, corners[1:] + corners[:1]))
    if len(corners) > 2 and all((b[0] - a[0]) * (point[1] - a[1]) - (b[1] - a[1]) * (point[0] - a[0]) >= 0
                                for a, b in edges):
        return 0.0

    def to_edge(a, b):
        squared = (b[0] - a[0]) ** 2 + (b[1] - a[1]) ** 2
        along = 0 if squared == 0 else ((point[0] - a[0]) * (b[0] - a[0]) + (point[1] - a[1]) * (b[1] - a[1])) / squared
        along = min(max(along, 0), 1)
        return math.hypot(a[0] + along * (b[0] - a[0]) - point[0], a[1] + along * (b[1] - a[1]) - point[1])
    return min(to_edge(a, b) for a, b in edges)


def balance(given):
    join = given["join"]
    shown = frames_of(join["shown"])
    offsets = []
    for f, joints in enumerate(support(join)[0], join["first"]):
        if joints:
            centre = mass_centre(shown[f])
            offsets.append(common.CM * distance_to_hull(
                (centre[0], centre[2]), [(shown[f][role][0], shown[f][role][2]) for role in joints]))
    return common.mean(offsets)


METRICS = {"unsupported_frames": longest_unsupported, "supported_share": supported, "balance_cm": balance}
