"""Metrics of camera capture and of person masks."""
import math

from independent import common
from independent.common import BONES, ROLES, angle, distance, dot, flat, frames_of, minus

PCK_MM, AUC_MM = 50, 200
FEWEST = 3  # points that an alignment needs


def joint_errors_mm(found, truth):
    return [[common.MM * distance(p[role], t[role]) for role in ROLES] for p, t in zip(found, truth)]


def mpjpe(given, key="found"):
    return common.mean(flat(joint_errors_mm(frames_of(given[key]), frames_of(given["truth"]))))


def largest_eigen(matrix):
    """Returns the largest eigenvalue of a symmetric matrix and its eigenvector, by Jacobi rotations."""
    n = len(matrix)
    a = [list(row) for row in matrix]
    v = [[float(i == j) for j in range(n)] for i in range(n)]
    for _ in range(60):
        for p in range(n):
            for q in range(p + 1, n):
                if a[p][q] == 0:
                    continue
                turn = 0.5 * math.atan2(2 * a[p][q], a[q][q] - a[p][p])
                c, s = math.cos(turn), math.sin(turn)
                for k in range(n):
                    a[k][p], a[k][q] = c * a[k][p] - s * a[k][q], s * a[k][p] + c * a[k][q]
                for k in range(n):
                    a[p][k], a[q][k] = c * a[p][k] - s * a[q][k], s * a[p][k] + c * a[q][k]
                    v[k][p], v[k][q] = c * v[k][p] - s * v[k][q], s * v[k][p] + c * v[k][q]
    best = max(range(n), key=lambda i: a[i][i])
    return a[best][best], [v[k][best] for k in range(n)]


def rotation_of(quaternion):
    w, x, y, z = quaternion
    return [[w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z]]


def fit(pairs, scaled):
    """What maps the first points onto the second, by Horn's quaternions (1987); None where it is not determined."""
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


def aligned(pose, truth):
    """`pose` after the best similarity."""
    move = fit([(pose[role], truth[role]) for role in ROLES], True)
    return {role: move(pose[role]) for role in ROLES}


def pa_mpjpe(given):
    truth = frames_of(given["truth"])
    return common.mean(flat(joint_errors_mm([aligned(p, t) for p, t in zip(frames_of(given["found"]), truth)], truth)))


def joint_share(given, credit):
    errors = flat(joint_errors_mm(frames_of(given["found"]), frames_of(given["truth"])))
    return math.fsum(credit(error) for error in errors) / len(errors)


def bone_length_error(given):
    def lengths(pose):
        return [distance(pose[child], pose[parent]) for child, parent in BONES.items()]
    return common.mean([common.CM * abs(a - b) for p, t in zip(frames_of(given["found"]), frames_of(given["truth"]))
                        for a, b in zip(lengths(p), lengths(t))])


def joint_angle_error(given):
    def bend(upper, lower):
        return common.degrees(angle(upper, lower)) if any(upper) and any(lower) else 0

    def bends(pose):
        return [bend(minus(pose[j], pose[BONES[j]]), minus(pose[k], pose[j])) for k, j in BONES.items() if j in BONES]
    return common.mean([abs(a - b) for p, t in zip(frames_of(given["found"]), frames_of(given["truth"]))
                        for a, b in zip(bends(p), bends(t))])


def mpjpe_where(given, seen):
    errors = joint_errors_mm(frames_of(given["found"]), frames_of(given["truth"]))
    return common.mean(flat([frame for frame, flag in zip(errors, given["seen"], strict=True) if flag == seen]))


def jerk_error(given):
    rate = given["found"].get("rate_hz", 30)
    found, truth = frames_of(given["found"]), frames_of(given["truth"])
    jerks = []
    for f in range(len(found) - 3):
        if 0 in given["in_view"][f:f + 4]:
            continue
        for role in ROLES:
            off = [minus(found[f + k][role], truth[f + k][role]) for k in range(4)]
            jerks.append(common.norm([d - 3 * c + 3 * b - a for a, b, c, d in zip(*off)]) * rate ** 3)
    return common.mean(jerks)


def limb_length_error(given):
    lengths = given["lengths_m"]
    return common.mean([common.MM * abs(a - b) for a, b in zip(lengths["found"], lengths["truth"], strict=True)])


def measured_error(things, error):
    return common.mean([error(thing["found"], thing["truth"]) for thing in things if thing["found"] and thing["truth"]])


def limb_direction_error(given):
    return measured_error(given["limbs"], lambda a, b: common.degrees(angle(a, b)))


def triangulation_error(given):
    return measured_error(given["ends_m"], lambda a, b: common.MM * distance(a, b))


def coverage(things):
    return common.share([thing["found"] is not None for thing in things if thing["truth"]])


def reprojection(given):
    def camera_rms(camera):
        squares = []
        for point, pixel in zip(camera["points_m"], camera["pixels"], strict=True):
            u, v, w = (dot(row, [*point, 1]) for row in camera["matrix"])
            squares.append((u / w - pixel[0]) ** 2 + (v / w - pixel[1]) ** 2)
        return math.sqrt(common.mean(squares))
    return common.mean([camera_rms(camera) for camera in given["cameras"]])


def over_images(given, part, whole):
    """Returns the mean over images of part / whole. Both are functions of the pixels (found, truth, shadow)."""
    shares = []
    for image in given["images"]:
        pixels = list(zip(flat(image["found"]), flat(image["truth"]), flat(image["shadow"]), strict=True))
        total = sum(whole(*pixel) for pixel in pixels)
        if total > 0:
            shares.append(sum(part(*pixel) for pixel in pixels) / total)
    return common.mean(shares)


def annotator_distance(given):
    pairs = [(m["first"], m["second"]) for m in given["joints_px"] if m["first"] and m["second"]]
    return common.mean([math.hypot(a[0] - b[0], a[1] - b[1]) for a, b in pairs]) if pairs else None


def annotator_overlap(given):
    marked = [(m["first"] is not None) + (m["second"] is not None) for m in given["limbs_px"]]
    either = sum(count > 0 for count in marked)
    return sum(count == 2 for count in marked) / either if either else None


METRICS = {
    "mpjpe_mm": mpjpe,
    "mpjpe_before_ik_mm": lambda g: mpjpe(g, "before_ik"),
    "pa_mpjpe_mm": pa_mpjpe,
    "pck_50mm": lambda g: joint_share(g, lambda error: error < PCK_MM),
    "auc_200mm": lambda g: joint_share(g, lambda error: max(0, 1 - error / AUC_MM)),
    "bone_length_error_cm": bone_length_error,
    "joint_angle_error_deg": joint_angle_error,
    "mpjpe_seen_mm": lambda g: mpjpe_where(g, 1),
    "mpjpe_held_mm": lambda g: mpjpe_where(g, 0),
    "jerk_error_mps3": jerk_error,
    "limb_length_error_mm": limb_length_error,
    "limb_direction_error_deg": limb_direction_error,
    "limb_direction_coverage": lambda g: coverage(g["limbs"]),
    "triangulation_error_mm": triangulation_error,
    "triangulation_coverage": lambda g: coverage(g["ends_m"]),
    "annotator_distance_px": annotator_distance,
    "annotator_overlap": annotator_overlap,
    "reprojection_rms_px": reprojection,
    "frames_in_view": lambda g: common.share(g["in_view"]),
    "frames_recovered": lambda g: common.share(g["recovered"]),
    "iou": lambda g: over_images(g, lambda f, t, s: f and t, lambda f, t, s: f or t),
    "mask_precision": lambda g: over_images(g, lambda f, t, s: f and t, lambda f, t, s: f),
    "mask_recall": lambda g: over_images(g, lambda f, t, s: f and t, lambda f, t, s: t),
    "mask_f1": lambda g: over_images(g, lambda f, t, s: 2 * (f and t), lambda f, t, s: f + t),
    "shadow_error": lambda g: over_images(g, lambda f, t, s: f and s, lambda f, t, s: s),
    "pwc": lambda g: over_images(g, lambda f, t, s: 100 * (f != t), lambda f, t, s: 1),
}
