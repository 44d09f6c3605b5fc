#!/usr/bin/env python3
"""Inverse kinematics by damped least squares (Wampler 1986), in plain Python.

Every step moves all angles by dq = (JᵀJ + λ²)⁻¹ Jᵀ e. Here e stacks the position errors (metres) and rotation errors
(radians) of all effectors, and J is their Jacobian. Angles are kept within their limits. A step that increases the
error is undone and tried again with more damping (Levenberg 1944).
"""
import math

import etude

IDENTITY = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]


def times(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(3)) for j in range(3)] for i in range(3)]


def apply(rotation, v):
    return [sum(rotation[i][k] * v[k] for k in range(3)) for i in range(3)]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def add(a, b):
    return [x + y for x, y in zip(a, b)]


def subtract(a, b):
    return [x - y for x, y in zip(a, b)]


def axis_rotation(axis, angle):
    c, s = math.cos(angle), math.sin(angle)
    return {"x": [[1, 0, 0], [0, c, -s], [0, s, c]],
            "y": [[c, 0, s], [0, 1, 0], [-s, 0, c]],
            "z": [[c, -s, 0], [s, c, 0], [0, 0, 1]]}[axis]


def forward(tree, root, angles):
    """Returns the positions and rotations of all joints, and for every angle the position and the axis of its
    rotation."""
    places, rotations, pivots = [], [], []
    for joint in tree["joints"]:
        if joint["parent"] is None:
            places.append(root["position_m"])
            rotations.append(root["rotation"])
            continue
        parent = joint["parent"]
        place = add(places[parent], apply(rotations[parent], joint["offset_m"]))
        rotation = times(rotations[parent], joint["rest"])
        for k, axis in enumerate(joint["axes"]):
            pivots.append((place, apply(rotation, IDENTITY["xyz".index(axis)])))
            rotation = times(rotation, axis_rotation(axis, angles[joint["first_angle"] + k]))
        places.append(place)
        rotations.append(rotation)
    return places, rotations, pivots


def lacking(tree, targets, places, rotations):
    """Returns six errors per effector: the vector to its target, and the rotation vector between their axes,
    accurate for small angles."""
    lacks = []
    for effector, target in zip(tree["effectors"], targets):
        rotation = rotations[effector["joint"]]
        place = add(places[effector["joint"]], apply(rotation, effector["offset_m"]))
        turn = [0, 0, 0]
        for column in range(3):
            turn = add(turn, cross([row[column] for row in rotation], [row[column] for row in target["rotation"]]))
        lacks += subtract(target["position_m"], place) + [x / 2 for x in turn]
    return only_asked(tree, lacks)


def only_asked(tree, numbers):
    """Sets errors to zero that the world does not ask for: it may ask for positions only, or for rotations only."""
    names = tree.get("asked", ["position", "orientation"])
    asked = 3 * ["position" in names] + 3 * ["orientation" in names]
    return [number if asked[i % 6] else 0 for i, number in enumerate(numbers)]


def moved_by(tree, affects, places, rotations, pivots):
    """Returns the Jacobian, one row per angle: the change of the six numbers of every effector."""
    rows = []
    for angle, (pivot, axis) in enumerate(pivots):
        row = []
        for e, effector in enumerate(tree["effectors"]):
            place = add(places[effector["joint"]], apply(rotations[effector["joint"]], effector["offset_m"]))
            row += cross(axis, subtract(place, pivot)) + axis if affects[e][angle] else [0] * 6
        rows.append(only_asked(tree, row))
    return rows


def solve(matrix, right):
    """Solves a symmetric, positive definite system by Gaussian elimination."""
    n = len(right)
    rows = [row + [value] for row, value in zip(matrix, right)]
    for i in range(n):
        for j in range(i + 1, n):
            factor = rows[j][i] / rows[i][i]
            if factor:
                rows[j] = [x - factor * y for x, y in zip(rows[j], rows[i])]
    solution = [0.0] * n
    for i in reversed(range(n)):
        rest = sum(rows[i][k] * solution[k] for k in range(i + 1, n))
        solution[i] = (rows[i][n] - rest) / rows[i][i]
    return solution


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def is_solved(tree, lacks):
    return all(math.hypot(*lacks[i:i + 3]) < tree["position_goal_cm"] / 100
               and math.degrees(math.hypot(*lacks[i + 3:i + 6])) < tree["orientation_goal_deg"]
               for i in range(0, len(lacks), 6))


def prepare(setting, options):
    """Stores the setting, and finds the angles that move each effector: those of its joint and of all joints above."""
    tree = {**setting, "max_steps": min(setting["max_steps"], options.get("max_steps", 100)), "affects": []}
    for effector in tree["effectors"]:
        moves, joint = [False] * len(tree["angles"]), effector["joint"]
        while joint is not None:
            first = tree["joints"][joint]["first_angle"]
            for k in range(len(tree["joints"][joint]["axes"])):
                moves[first + k] = True
            joint = tree["joints"][joint]["parent"]
        tree["affects"].append(moves)
    return tree


def answer(tree, problem):
    root, targets = problem["root"], problem["targets"]
    limits = [(math.radians(a["lower_deg"]), math.radians(a["upper_deg"])) for a in tree["angles"]]
    angles = [math.radians(a) for a in problem["start_angles_deg"]]
    state = forward(tree, root, angles)
    lacks = lacking(tree, targets, *state[:2])
    damping, steps = 1e-3, 0
    while steps < tree["max_steps"] and not is_solved(tree, lacks) and damping < 1e3:
        steps += 1
        rows = moved_by(tree, tree["affects"], *state)
        matrix = [[dot(a, b) + (damping if i == j else 0) for j, b in enumerate(rows)] for i, a in enumerate(rows)]
        step = solve(matrix, [dot(row, lacks) for row in rows])
        tried = [min(max(a + d, low), high) for a, d, (low, high) in zip(angles, step, limits)]
        tried_state = forward(tree, root, tried)
        tried_lacks = lacking(tree, targets, *tried_state[:2])
        if dot(tried_lacks, tried_lacks) < dot(lacks, lacks):
            angles, state, lacks, damping = tried, tried_state, tried_lacks, max(damping / 4, 1e-9)
        else:
            damping *= 4
    degrees = [math.degrees(a) for a in angles]
    # Converting to degrees and back may exceed a limit by rounding.
    degrees = [min(max(d, a["lower_deg"]), a["upper_deg"]) for d, a in zip(degrees, tree["angles"])]
    return {"angles_deg": degrees, "iterations": steps, "fk_evaluations": steps + 1}


@etude.method(task="ik", name="ik-dls-python", version="1.0")
class DampedLeastSquares:
    def __init__(self, setting, options):
        self.tree = prepare(setting.to_json(), options)

    def answer(self, problem):
        return answer(self.tree, problem)


if __name__ == "__main__":
    etude.serve(DampedLeastSquares)
