"""Etude's engine on arrays. Lengths are metres, angles radians; the world is right-handed with Y up."""
from os import PathLike
from typing import Dict, Final, List, Mapping, Optional, Sequence, Tuple, Union

import numpy
from numpy.typing import ArrayLike

__version__: str
ROLES: Tuple[str, ...]
FEATURES: Tuple[str, ...]
STATUSES: Tuple[str, ...]
TRANSITION_CHOICES: Tuple[str, ...]
TRANSITION_JOINS: Tuple[str, ...]
COACH_ACTS: Tuple[str, ...]
COACH_POLICIES: Tuple[str, ...]
SONGS: Tuple[str, ...]
Array = numpy.ndarray

class BadInput(ValueError): ...

class Motion:
    def __init__(self, positions_m: ArrayLike, rate_hz: float = 30.0) -> None: ...
    rate_hz: Final[float]
    positions_m: Final[Array]
    def __len__(self) -> int: ...

class FileMotion(Motion):
    changes: Final[List[str]]

def read_motion(path: Union[str, PathLike], rate_hz: float = 30.0, keep_floor: bool = False, up: str = "",
                metres_per_unit: float = 0.0, marker_set: str = "") -> FileMotion: ...
def features(motion: Motion) -> Array: ...
def fuzzy_distance(a: ArrayLike, b: ArrayLike) -> float: ...

class Bridges:
    def __init__(self, clips: Sequence[Motion], min_clips: int = 2, threshold: float = 0.4) -> None: ...
    def frames(self, clip: int) -> Array: ...
    def find(self, clip: int, frame: int, to: int, budget_s: float = 1.0) -> Optional[Tuple[int, int, float]]: ...

class Transition:
    motion: Final[Motion]
    points: Final[List[int]]
    wait_s: Final[float]
    branch: Final[str]
    why: Final[str]

def scenario_proportions() -> Tuple[Array, float]: ...

class TransitionLibrary:
    def __init__(self, clips: Sequence[Motion], proportions: Optional[Tuple[ArrayLike, float]] = None) -> None: ...
    def make(self, clip: int, frame: int, to: int, budget_s: float = 1.0, choice: str = "played", join: str = "planted-feet",
             threshold: float = 0.4, choice_settings: Mapping[str, float] = {},
             join_settings: Mapping[str, float] = {}) -> Transition: ...

def transition_choice_settings(choice: str) -> Dict[str, Tuple[float, float, float, str]]: ...
def transition_join_settings(join: str) -> Dict[str, Tuple[float, float, float, str]]: ...

class Limb:
    def __init__(self, name: str, parent: int, offset_m: ArrayLike, dofs: int, rest: Optional[ArrayLike] = None) -> None: ...
    name: Final[str]
    parent: Final[int]
    dofs: Final[int]
    offset_m: Final[Array]
    rest: Final[Array]

class Effector:
    def __init__(self, name: str, limb: int, offset_m: ArrayLike) -> None: ...
    name: Final[str]
    limb: Final[int]
    offset_m: Final[Array]

class Tree:
    def __init__(self, limbs: Sequence[Limb], effectors: Sequence[Effector], limits: ArrayLike) -> None: ...
    limbs: Final[List[Limb]]
    effectors: Final[List[Effector]]
    limits: Final[Array]

def adult_body() -> Tree: ...

class Solved:
    angles: Final[Array]
    statuses: Final[Array]
    iterations: Final[Array]

class Kinematics:
    def __init__(self, tree: Optional[Tree] = None, max_iterations: int = 200, position_goal_m: float = 0.001,
                 axis_goal: float = ..., most_change: Optional[float] = None) -> None: ...
    tree: Final[Tree]
    dofs: Final[int]
    def limbs(self, angles: ArrayLike, root_positions_m: Optional[ArrayLike] = None,
              root_axes: Optional[ArrayLike] = None) -> Tuple[Array, Array]: ...
    def effectors(self, angles: ArrayLike, root_positions_m: Optional[ArrayLike] = None,
                  root_axes: Optional[ArrayLike] = None) -> Tuple[Array, Array]: ...
    def solve(self, start_angles: ArrayLike, target_positions_m: ArrayLike, target_axes: Optional[ArrayLike] = None,
              position_weights: Optional[ArrayLike] = None, axis_weights: Optional[ArrayLike] = None,
              root_positions_m: Optional[ArrayLike] = None, root_axes: Optional[ArrayLike] = None, *,
              single_precision: bool = False) -> Solved: ...

class Camera:
    name: str
    width: int
    height: int
    fx: float
    fy: float
    cx: float
    cy: float
    skew: float
    k1: float
    k2: float
    p1: float
    p2: float
    k3: float
    k4: float
    k5: float
    k6: float
    s1: float
    s2: float
    s3: float
    s4: float
    tau_x: float
    tau_y: float
    is_fisheye: bool
    @property
    def R_CW(self) -> Array: ...
    @R_CW.setter
    def R_CW(self, value: ArrayLike) -> None: ...
    @property
    def p_WC(self) -> Array: ...
    @p_WC.setter
    def p_WC(self, value: ArrayLike) -> None: ...
    def __init__(self) -> None: ...

def read_rig(text: str, file: str = "rig") -> List[Camera]: ...
def project(camera: Camera, points_m: ArrayLike) -> Array: ...
def calibrate(points_m: ArrayLike, pixels: ArrayLike, width: int, height: int) -> Tuple[Camera, float]: ...
def triangulate(cameras: Sequence[Camera], pixels: ArrayLike) -> Tuple[Array, Array]: ...

class CapturedMotion:
    motion: Final[Motion]
    bvh: Final[str]
    is_held: Final[List[bool]]
    residual_px: Final[float]

def capture(cameras: Sequence[Camera], keypoints: Sequence[Sequence[ArrayLike]], layout: str = "coco", rate_hz: float = 30.0,
            person: int = 0, smooth_hz: float = 0.0) -> CapturedMotion: ...

class PersonFinder:
    def __init__(self, background: ArrayLike, segmenter: str = "hue-gated", all_pieces: bool = False) -> None: ...
    def find(self, picture: ArrayLike) -> Array: ...

def outline(mask: ArrayLike, spacing: int = 3, thinnest: float = 1.0) -> Tuple[Array, Array]: ...
def signed_distances(mask: ArrayLike) -> Array: ...
def track_silhouettes(cameras: Sequence[Camera], masks: Sequence[ArrayLike], stature_m: float = 1.74,
                      measured: Optional[Motion] = None, rate_hz: float = 30.0) -> Array: ...

Moves = Sequence[Tuple[str, Sequence[Motion]]]

class Recogniser:
    def __init__(self, moves: Moves, kind: str = "whole-body", smooths: bool = True) -> None: ...
    def follow(self, rate_hz: float = 30.0) -> RecogniserStream: ...

class RecogniserStream:
    def ask(self, move: Optional[int]) -> None: ...
    def update(self, positions_m: ArrayLike, states: str = "", body_seen: bool = True) -> Tuple[float, Array]: ...

class Dance:
    def __init__(self, title: str, motion: Motion, moves: Sequence[Tuple[str, str, ArrayLike, Motion]],
                 repetitions: Sequence[Tuple[int, int, int]], tags: Sequence[Tuple[int, float]],
                 acts: Sequence[Tuple[str, Motion, bool]]) -> None: ...
    title: Final[str]
    motion: Final[Motion]
    moves: Final[List[Tuple[str, str, Array, Motion]]]
    repetitions: Final[List[Tuple[int, int, int]]]
    tags: Final[List[Tuple[int, float]]]
    acts: Final[List[Tuple[str, Motion, bool]]]

def builtin_dance(song: str) -> Tuple[Dance, List[Tuple[str, List[Motion]]]]: ...

class CoachDecision:
    event: Final[str]
    frame: Final[int]
    move: Final[Optional[int]]
    mistake: Final[str]
    evidence: Final[float]
    why: Final[str]

class CoachFrame:
    mode: Final[str]
    positions_m: Final[Array]
    clip: Final[str]
    clip_frame: Final[float]
    in_transition: Final[bool]
    asked: Final[Optional[int]]
    say: Final[str]
    hint: Final[str]
    stand: Final[str]
    play_from_s: Final[Optional[float]]
    pause_music: Final[bool]
    decisions: Final[List[CoachDecision]]

class Coach:
    def __init__(self, dance: Dance, moves: Moves, policy: str = "at-first-mistake", recogniser: str = "whole-body",
                 dances_at_once: bool = False, mirrors: bool = False, smooths: bool = False,
                 right_from: Optional[float] = None, choice: str = "played", join: str = "planted-feet") -> None: ...
    def step(self, positions_m: ArrayLike, states: str = "", body_seen: bool = True,
             music_s: Optional[float] = None) -> CoachFrame: ...

def sense(motion: Motion, sensor: str = "v2", strength: float = 1.0, distance_m: float = 2.75, turn_rad: float = 0.0,
          height_m: float = 1.0, seed: int = 1) -> Tuple[Array, List[str], Array]: ...
