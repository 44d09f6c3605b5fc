"""Replaces pymomentum.solver2 in tests: it has only the documented calls that the example uses."""
import numpy as np
from pymomentum import geometry


def __getattr__(name):
    raise AttributeError(f"pymomentum.solver2: {name} is not expected")


class PositionErrorFunction:
    def __init__(self, character):
        self.character, self.targets = character, None

    def clear_constraints(self):
        self.targets = None

    def add_constraints(self, parent, target, offset=None, weight=None):
        assert offset is None and weight is None and target.dtype == np.float32 and target.shape == (len(parent), 3)
        assert self.targets is None and list(parent) == list(range(self.character.skeleton.size))
        self.targets = target.astype(float)


class SkeletonSolverFunction:
    def __init__(self, character, error_functions):
        assert all(function.character is character for function in error_functions)
        (self.positions,), self.character = error_functions, character


class GaussNewtonSolverOptions:
    __slots__ = ("max_iterations", "regularization")

    def __init__(self):
        self.max_iterations, self.regularization = 2, 0.05


class GaussNewtonSolver:
    def __init__(self, solver_function, options):
        self.function, self.options = solver_function, options

    def solve(self, model_parameters):
        character, targets = self.function.character, self.function.positions.targets
        assert targets is not None and model_parameters.dtype == np.float32
        state = model_parameters.astype(float)

        def residual(at):
            return (geometry.model_parameters_to_skeleton_state(character, at.astype(np.float32))[:, :3] - targets).ravel()

        for _ in range(min(10, self.options.max_iterations)):
            now = residual(state)
            step = 1e-2
            jacobian = np.stack([(residual(state + step * unit) - now) / step for unit in np.eye(len(state))], 1)
            state -= np.linalg.solve(jacobian.T @ jacobian + np.eye(len(state)), jacobian.T @ now)
        return state.astype(np.float32)
