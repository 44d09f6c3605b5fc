#!/usr/bin/env python3
"""Inverse kinematics by the Levenberg–Marquardt method on dense numpy arrays.

All effectors' errors are stacked (metres, radians); each step solves (JᵀJ + λ diag JᵀJ) dq = Jᵀ e (Marquardt 1963). If
a step drives angles beyond their limits, these angles stay at the limits, and the step is computed again for the other
angles.
"""
import etude
import numpy as np

AXES = {"x": 0, "y": 1, "z": 2}


def turn(axis, angle):
    j, k = (axis + 1) % 3, (axis + 2) % 3
    matrix = np.eye(3)
    matrix[j, j] = matrix[k, k] = np.cos(angle)
    matrix[k, j] = np.sin(angle)
    matrix[j, k] = -matrix[k, j]
    return matrix


@etude.method(task="ik", name="ik-lm-numpy", version="1.0")
class LevenbergMarquardt:
    def __init__(self, setting, options):
        self.setting = setting
        self.max_steps = min(setting.max_steps, options.get("max_steps", 100))
        self.low, self.high = np.radians([(angle.lower_deg, angle.upper_deg) for angle in setting.angles]).T
        self.offsets = [np.array(joint.offset_m) for joint in setting.joints]
        self.rests = [np.array(joint.rest) for joint in setting.joints]
        self.ends = [np.array(effector.offset_m) for effector in setting.effectors]
        self.moves = np.zeros((len(setting.effectors), len(setting.angles)), bool)  # which angles move which effector
        for row, effector in zip(self.moves, setting.effectors):
            joint = effector.joint
            while joint is not None:
                first = setting.joints[joint].first_angle
                row[first:first + len(setting.joints[joint].axes)] = True
                joint = setting.joints[joint].parent
        self.asked = np.repeat(["position" in setting.asked, "orientation" in setting.asked], 3)
        self.goals = setting.position_goal_cm / 100, np.radians(setting.orientation_goal_deg)

    def look(self, root, targets, angles):
        """Returns the effectors' errors (effectors × 6) and their Jacobian (effectors × 6 × angles)."""
        places, turns, pivots, axes = [], [], np.empty((len(angles), 3)), np.empty((len(angles), 3))
        for joint, offset, rest in zip(self.setting.joints, self.offsets, self.rests):
            if joint.parent is None:
                place, turned = np.array(root.position_m), np.array(root.rotation)
            else:
                place, turned = places[joint.parent] + turns[joint.parent] @ offset, turns[joint.parent] @ rest
            for number, axis in enumerate(joint.axes, joint.first_angle):
                pivots[number], axes[number] = place, turned[:, AXES[axis]]
                turned = turned @ turn(AXES[axis], angles[number])
            places.append(place)
            turns.append(turned)
        lacks, changes = np.zeros((len(targets), 6)), np.zeros((len(targets), 6, len(angles)))
        for i, (effector, target) in enumerate(zip(self.setting.effectors, targets)):
            turned = turns[effector.joint]
            place = places[effector.joint] + turned @ self.ends[i]
            lacks[i, :3] = target.position_m - place
            lacks[i, 3:] = np.cross(turned, np.array(target.rotation), axis=0).sum(axis=1) / 2
            changes[i, :3] = (np.cross(axes, place - pivots) * self.moves[i][:, None]).T
            changes[i, 3:] = (axes * self.moves[i][:, None]).T
        return lacks * self.asked, changes * self.asked[:, None]

    def is_solved(self, lacks):
        return (np.linalg.norm(lacks[:, :3], axis=1) < self.goals[0]).all() and \
               (np.linalg.norm(lacks[:, 3:], axis=1) < self.goals[1]).all()

    def answer(self, problem):
        angles = np.clip(np.radians(problem.start_angles_deg), self.low, self.high)
        lacks, changes = self.look(problem.root, problem.targets, angles)
        damping, steps = 1e-3, 0
        while steps < self.max_steps and not self.is_solved(lacks) and damping < 1e6:
            steps += 1
            J, e = changes.reshape(-1, len(angles)), lacks.ravel()
            H, g = J.T @ J, J.T @ e
            free = ~(((angles <= self.low) & (g < 0)) | ((angles >= self.high) & (g > 0)))
            if not free.any():
                break
            A = H[np.ix_(free, free)]
            step = np.zeros(len(angles))
            step[free] = np.linalg.solve(A + damping * np.diag(np.diag(A) + 1e-9), g[free])
            tried = np.clip(angles + step, self.low, self.high)
            then, changes_then = self.look(problem.root, problem.targets, tried)
            if (then ** 2).sum() < (lacks ** 2).sum():
                angles, lacks, changes, damping = tried, then, changes_then, max(damping / 5, 1e-9)
            else:
                damping *= 5
        degrees = np.degrees(angles)
        limits = np.array([(angle.lower_deg, angle.upper_deg) for angle in self.setting.angles]).T
        return {"angles_deg": np.clip(degrees, *limits).tolist(), "iterations": steps, "fk_evaluations": steps + 1}


if __name__ == "__main__":
    etude.serve(LevenbergMarquardt)
