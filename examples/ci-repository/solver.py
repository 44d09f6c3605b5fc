#!/usr/bin/env python3
"""A solver for inverse kinematics: damped least squares (Wampler 1986) in plain Python, one JSON message a line."""
import json
import math
import sys

DAMPING = 1e-3  # a larger value gives shorter steps


def total(numbers):
    """Returns the sum, to the same bits in every version of Python: sum() rounds differently since 3.12."""
    result = 0.0
    for number in numbers:
        result += number
    return result


def turn(axis, angle):
    c, s, i = math.cos(angle), math.sin(angle), "xyz".index(axis)
    matrix = [[float(row == column) for column in range(3)] for row in range(3)]
    j, k = (i + 1) % 3, (i + 2) % 3
    matrix[j][j], matrix[j][k], matrix[k][j], matrix[k][k] = c, -s, s, c
    return matrix


def times(a, b):
    return [[total(a[i][k] * b[k][j] for k in range(3)) for j in range(3)] for i in range(3)]


def apply(rotation, v):
    return [total(x * y for x, y in zip(row, v)) for row in rotation]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def forward(tree, root, angles):
    """Returns each joint's position and rotation, and the angles that move it: (index, position of the axis, axis)."""
    joints = []
    for joint in tree["joints"]:
        if joint["parent"] is None:
            joints.append((root["position_m"], root["rotation"], []))
            continue
        place, rotation, above = joints[joint["parent"]]
        place = [x + y for x, y in zip(place, apply(rotation, joint["offset_m"]))]
        rotation, above = times(rotation, joint["rest"]), list(above)
        for number, axis in enumerate(joint["axes"], joint["first_angle"]):
            above.append((number, place, [row["xyz".index(axis)] for row in rotation]))
            rotation = times(rotation, turn(axis, angles[number]))
        joints.append((place, rotation, above))
    return joints


def errors(tree, targets, joints):
    """Returns each effector's error (three numbers of position, three of rotation) and the Jacobian of the errors."""
    lacks, moves = [], []
    for effector, target in zip(tree["effectors"], targets):
        place, rotation, above = joints[effector["joint"]]
        place = [x + y for x, y in zip(place, apply(rotation, effector["offset_m"]))]
        columns = [cross([row[i] for row in rotation], [row[i] for row in target["rotation"]]) for i in range(3)]
        lacks += [x - y for x, y in zip(target["position_m"], place)] + [total(x) / 2 for x in zip(*columns)]
        block = [[0.0] * len(tree["angles"]) for _ in range(6)]
        for number, pivot, axis in above:
            for row, value in zip(block, cross(axis, [x - y for x, y in zip(place, pivot)]) + axis):
                row[number] = value
        moves += block
    return lacks, moves


def solve(matrix, right):
    """Solves a symmetric, positive definite system by Gaussian elimination."""
    rows = [row + [value] for row, value in zip(matrix, right)]
    for i, pivot in enumerate(rows):
        for j in range(len(rows)):
            if j != i:
                factor = rows[j][i] / pivot[i]
                rows[j] = [x - factor * y for x, y in zip(rows[j], pivot)]
    return [row[-1] / row[i] for i, row in enumerate(rows)]


def answer(tree, problem):
    angles, steps = [math.radians(a) for a in problem["start_angles_deg"]], 0
    while steps < min(tree["max_steps"], 30):
        lacks, moves = errors(tree, problem["targets"], forward(tree, problem["root"], angles))
        if max(map(abs, lacks)) < 1e-4:
            break
        # Take the step J'(JJ' + damping)^-1 e, and keep each angle within its limits.
        matrix = [[total(x * y for x, y in zip(a, b)) + DAMPING * (i == j) for j, b in enumerate(moves)]
                  for i, a in enumerate(moves)]
        weights = solve(matrix, lacks)
        for number, limit in enumerate(tree["angles"]):
            step = total(weight * row[number] for weight, row in zip(weights, moves))
            low, high = math.radians(limit["lower_deg"]), math.radians(limit["upper_deg"])
            angles[number] = min(max(angles[number] + step, low), high)
        steps += 1
    found = [min(max(math.degrees(a), limit["lower_deg"]), limit["upper_deg"])
             for a, limit in zip(angles, tree["angles"])]
    return {"angles_deg": found, "iterations": steps}


for line in sys.stdin:
    message = json.loads(line)
    if message["type"] == "hello":
        reply = {"type": "hello", "protocol": 1, "name": "our-solver", "version": "1.0"}
    elif message["type"] == "setting":
        setting, reply = message["setting"], {"type": "ready"}
    else:
        reply = {"type": "answer", "id": message["id"], "answer": answer(setting, message["problem"])}
    print(json.dumps(reply), flush=True)
