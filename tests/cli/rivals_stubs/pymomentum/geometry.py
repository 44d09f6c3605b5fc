"""Replaces pymomentum.geometry in tests: it has only the documented calls that the example uses."""
import numpy as np


def __getattr__(name):
    raise AttributeError(f"pymomentum.geometry: {name} is not expected")


class Joint:
    def __init__(self, name, parent, pre_rotation, translation_offset):
        assert isinstance(name, str) and isinstance(parent, int)
        assert np.array_equal(pre_rotation, [0, 0, 0, 1]) and np.shape(translation_offset) == (3,)
        self.name, self.parent, self.translation_offset = name, parent, np.array(translation_offset, float)


class Skeleton:
    def __init__(self, joint_list):
        assert joint_list[0].parent == -1 and all(joint.parent < i for i, joint in enumerate(joint_list)), "parents come first"
        self.joints, self.size = joint_list, len(joint_list)


class ParameterTransform:
    def __init__(self, names, skeleton, transform):
        assert transform.shape == (7 * skeleton.size, len(names)) and transform.dtype == np.float32
        self.names, self.size, self.transform = names, len(names), transform


class Character:
    def __init__(self, name, skeleton, parameter_transform):
        self.name, self.skeleton, self.parameter_transform = name, skeleton, parameter_transform


def turn(x, y, z):
    """Returns the rotation of Euler angles about the fixed axes X, then Y, then Z."""
    cx, sx, cy, sy, cz, sz = np.cos(x), np.sin(x), np.cos(y), np.sin(y), np.cos(z), np.sin(z)
    return (np.array([[cz, -sz, 0], [sz, cz, 0], [0, 0, 1]]) @ np.array([[cy, 0, sy], [0, 1, 0], [-sy, 0, cy]])
            @ np.array([[1, 0, 0], [0, cx, -sx], [0, sx, cx]]))


def model_parameters_to_skeleton_state(character, model_parameters):
    assert model_parameters.dtype == np.float32 and model_parameters.shape == (character.parameter_transform.size,)
    numbers = (character.parameter_transform.transform @ model_parameters).reshape(-1, 7).astype(float)
    places, turns = [], []
    for joint, (x, y, z, rx, ry, rz, _) in zip(character.skeleton.joints, numbers):
        above = (np.zeros(3), np.eye(3)) if joint.parent < 0 else (places[joint.parent], turns[joint.parent])
        places.append(above[0] + above[1] @ (joint.translation_offset + [x, y, z]))
        turns.append(above[1] @ turn(rx, ry, rz))
    return np.array([[*place, 0, 0, 0, 1, 1] for place in places], np.float32)
