#!/usr/bin/env python3
"""Momentum (Meta, MIT) as a method of the task capture. Its Python package `pymomentum` (`geometry`, `solver2`) fits a
body of twenty joints to triangulated joints, frame by frame, with Momentum's Gauss–Newton solver.

Joints are triangulated as in `capture_triangulation_numpy.py`, but not filtered. Bones have their median lengths.
Momentum's unit is the centimetre. Options: `segmenter`, the segmenter whose marks are used (the first); `iterations` of
each frame (30); `regularization` (1e-5).
"""
import pathlib
import sys

import etude
import numpy as np

sys.path.insert(1, str(pathlib.Path(__file__).parents[1] / "outside-methods"))
from capture_triangulation_numpy import Triangulation  # noqa: E402

CM = 100
PER_JOINT = 7  # parameters of a joint in Momentum: three translations, three rotations, a scale


def character_of(geometry, joints, parents, points):
    """Returns the body of a person whose joints are at `points`, frames × joints × 3 in cm. The first pose is its
    rest pose."""
    bones = []
    for number, name in enumerate(joints):
        parent = joints.index(parents[number]) if parents[number] else -1
        bone = points[:, number] - points[:, parent] if parent >= 0 else np.zeros_like(points[:, 0])
        length = np.median(np.linalg.norm(bone, axis=1))
        offset = bone[0] * length / max(np.linalg.norm(bone[0]), 1e-9)
        bones.append(geometry.Joint(name=name, parent=parent, pre_rotation=np.array([0, 0, 0, 1], np.float32),
                                    translation_offset=offset.astype(np.float32)))
    skeleton = geometry.Skeleton(joint_list=bones)
    # The parameters are the root's position, and three rotations of every joint that has a child.
    numbers = [(f"{joints[0]}_t{axis}", k) for k, axis in enumerate("xyz")]
    numbers += [(f"{name}_r{axis}", PER_JOINT * number + 3 + k) for number, name in enumerate(joints) if name in parents
                for k, axis in enumerate("xyz")]
    transform = np.zeros((PER_JOINT * len(joints), len(numbers)), np.float32)
    for column, (_, row) in enumerate(numbers):
        transform[row, column] = 1
    parameters = geometry.ParameterTransform(names=[name for name, _ in numbers], skeleton=skeleton, transform=transform)
    return geometry.Character(name="person", skeleton=skeleton, parameter_transform=parameters)


@etude.method(task="capture", name="momentum", version="1.0")
class Momentum(Triangulation):
    def answer(self, problem):
        try:
            import pymomentum.geometry as geometry
            import pymomentum.solver2 as solver2
        except ImportError as error:
            raise etude.NoAnswer(f"pymomentum is not installed ({error}): pip install pymomentum-cpu") from error
        joints = self.setting.joints
        points = CM * self.points(problem)
        character = character_of(geometry, joints, self.setting.parents, points)
        targets = solver2.PositionErrorFunction(character)
        options = solver2.GaussNewtonSolverOptions()
        options.max_iterations = self.options.get("iterations", 30)
        options.regularization = self.options.get("regularization", 1e-5)
        solver = solver2.GaussNewtonSolver(solver2.SkeletonSolverFunction(character, [targets]), options)
        state = np.zeros(character.parameter_transform.size, np.float32)
        state[:3] = points[0, 0]
        poses = []
        for frame in points:
            targets.clear_constraints()
            targets.add_constraints(parent=np.arange(len(joints)), target=frame.astype(np.float32))
            state = np.asarray(solver.solve(state), np.float32)
            placed = np.asarray(geometry.model_parameters_to_skeleton_state(character, state))
            poses.append((placed[:, :3].astype(float) / CM).ravel().tolist())
        return {"poses": poses}


if __name__ == "__main__":
    etude.serve(Momentum)
