"""Problems and answers of every task. Written by python/make_problems.py from docs/schemas/protocol.schema.json."""
from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, List, Optional

from etude.messages import Cell, Message

Pose = List[float]
Vector = List[float]
Rotation = List[List[float]]


@dataclass
class IkJoint(Message):
    """A joint of the body that a solver turns.

    name: The joint's name.
    parent: null: it is the root.
    offset_m: The joint's position from its parent, in the parent's frame, in metres.
    rest: The rotation from its frame into its parent's while all its angles are 0.
    axes: The axes that it turns about, in order.
    first_angle: The index of its first angle in the setting's angles.
    """
    name: str
    parent: Optional[int]
    offset_m: Vector
    rest: Rotation
    axes: List[str]
    first_angle: int


@dataclass
class IkAngle(Message):
    """One degree of freedom.

    name: The angle's name.
    lower_deg: Its lower limit, in degrees.
    upper_deg: Its upper limit, in degrees.
    """
    name: str
    lower_deg: float
    upper_deg: float


@dataclass
class IkEffector(Message):
    """The free end of a limb.

    name: The effector's name.
    joint: The joint that it is attached to.
    offset_m: Its position in that joint's frame, in metres.
    """
    name: str
    joint: int
    offset_m: Vector


@dataclass
class IkRoot(Message):
    """Where the root joint is; it does not move.

    position_m: Its position in the world, in metres.
    rotation: The rotation from its frame into the world's.
    """
    position_m: Vector
    rotation: Rotation


@dataclass
class IkTarget(Message):
    """The target of an effector.

    effector: The name of the effector that it is for.
    position_m: Where the effector shall be in the world, in metres.
    rotation: The rotation from the effector's frame into the world's.
    """
    effector: str
    position_m: Vector
    rotation: Rotation


@dataclass
class IkFrame(Message):
    """A frame of the motion to follow.

    root: Where the root joint is in this frame.
    targets: One target per effector, in order.
    """
    HOLDS: ClassVar[dict] = {"root": IkRoot, "targets": [IkTarget]}
    root: IkRoot
    targets: List[IkTarget]


@dataclass
class IkSetting(Message):
    """The body, and what is asked for.

    joints: The joints, parents first.
    angles: One per degree of freedom, in the order of answers.
    effectors: The free ends that have targets.
    max_steps: The step limit of built-in solvers; like the goals, for information.
    position_goal_cm: How near an effector has to come to its target, in centimetres.
    orientation_goal_deg: How far each of an effector's axes may be from its target's, in degrees.
    asked: Which parts of its target each effector must reach: position, orientation, or both.
    """
    HOLDS: ClassVar[dict] = {"joints": [IkJoint], "angles": [IkAngle], "effectors": [IkEffector]}
    joints: List[IkJoint]
    angles: List[IkAngle]
    effectors: List[IkEffector]
    max_steps: int
    position_goal_cm: float
    orientation_goal_deg: float
    asked: List[str]


@dataclass
class IkProblem(Message):
    """One pose to be found.

    root: Where the root joint is.
    start_angles_deg: The angles to start from, within all limits.
    targets: One target per effector, in order.
    """
    HOLDS: ClassVar[dict] = {"root": IkRoot, "targets": [IkTarget]}
    root: IkRoot
    start_angles_deg: List[float]
    targets: List[IkTarget]


@dataclass
class IkAnswer(Message):
    """The pose found.

    angles_deg: As many as the setting's angles; one that breaks its limit by more than 10⁻⁶ degrees is measured,
        and counts as unsolved.
    iterations: The number of the method's own steps.
    fk_evaluations: The number of its forward-kinematics passes over the whole tree.
    """
    angles_deg: List[float]
    iterations: Optional[int] = None
    fk_evaluations: Optional[int] = None


@dataclass
class TrackingSetting(Message):
    """The frame rate, and the limits of built-in solvers in each frame.

    rate_hz: Frames a second.
    max_steps: The step limit of built-in solvers; like the goals, for information.
    position_goal_cm: How near an effector has to come to its target, in centimetres.
    orientation_goal_deg: How far each of an effector's axes may be from its target's, in degrees.
    """
    rate_hz: float
    max_steps: int
    position_goal_cm: float
    orientation_goal_deg: float


@dataclass
class TrackingProblem(Message):
    """A motion to be followed, by a body of its own.

    joints: The joints, parents first.
    angles: One per degree of freedom, in the order of answers.
    effectors: The free ends that have targets.
    start_angles_deg: The angles to start from in the first frame.
    frames: The frames of the motion, in order.
    """
    HOLDS: ClassVar[dict] = {"joints": [IkJoint], "angles": [IkAngle], "effectors": [IkEffector], "frames": [IkFrame]}
    joints: List[IkJoint]
    angles: List[IkAngle]
    effectors: List[IkEffector]
    start_angles_deg: List[float]
    frames: List[IkFrame]


@dataclass
class TrackingAnswer(Message):
    """The angles of every frame.

    angles_deg: Per frame as many as the problem's angles; a frame with one that breaks its limit by more than 10⁻⁶
        degrees is measured, and counts as unsolved.
    iterations: Per frame, the number of the method's own steps.
    """
    angles_deg: List[List[float]]
    iterations: Optional[List[int]] = None


@dataclass
class TransitionClip(Message):
    """A clip of the library.

    name: The clip's name.
    poses: One pose per frame.
    file: The same motion as a BVH file.
    """
    name: str
    poses: List[Pose]
    file: str


@dataclass
class TransitionSetting(Message):
    """The library of clips.

    rate_hz: Frames a second, of all clips.
    joints: The twenty joints, in the order of poses.
    parents: The name of each joint's parent; null for the first.
    clips: The library; problems name its clips by their index, from 0.
    """
    HOLDS: ClassVar[dict] = {"clips": [TransitionClip]}
    rate_hz: float
    joints: List[str]
    parents: List[Optional[str]]
    clips: List[TransitionClip]


@dataclass
class TransitionProblem(Message):
    """A request for a transition into another clip.

    from: The index of the current clip.
    to: The index of the wanted clip.
    request_frame: The frame of the current clip at which the transition is requested.
    max_wait_s: The longest wait that the caller would like.
    """
    from_: int
    to: int
    request_frame: int
    max_wait_s: float


@dataclass
class TransitionStop(Message):
    """A clip that is played between the two.

    clip: Its index in the library.
    enter_frame: The frame at which it is entered, in place of the previous clip's last frame.
    leave_frame: The last of its frames that is shown.
    """
    clip: int
    enter_frame: int
    leave_frame: int


@dataclass
class TransitionAnswer(Message):
    """At which frames one clip is left and the other entered, or why no transition was found.

    leave_frame: The last frame that is shown of the current clip: request_frame or a later one.
    enter_frame: The frame of the wanted clip that corresponds to leave_frame, any but the clip's last. The frame
        after it is shown next, then the rest of the clip.
    through: Clips that are played between the two, 16 at most.
    join: Any built-in join (etude list methods); cut by default.
    join_s: Blend length of minimum-jerk or planted-feet, 0 to 5 seconds; other joins have lengths of their own.
    fades: Only with join_s. True: the old clip continues and fades out; false: its offset from the new clip decays.
    direct: Only with join_s: each limb moves with minimum jerk to its pose in the new clip at the end of the join.
    between: Up to 300 poses that the method makes itself. They are shown after leave_frame, at its position and
        heading; the last one is shown instead of enter_frame. Limb lengths may differ from the clips' by 2 cm. Not
        allowed together with through.
    between_start: Only with between: the pose that the method computed for leave_frame. It is not shown, but the
        gaps at the first transition point are measured to it. Without it, the first poses of between are taken to
        move at a constant speed.
    matched: Whether the two frames were chosen because they are alike; false_smooth is measured only then.
    unsolved: Why no transition was found.
    """
    HOLDS: ClassVar[dict] = {"through": [TransitionStop]}
    leave_frame: Optional[int] = None
    enter_frame: Optional[int] = None
    through: Optional[List[TransitionStop]] = None
    join: Optional[str] = None
    join_s: Optional[float] = None
    fades: Optional[bool] = None
    direct: Optional[bool] = None
    between: Optional[List[Pose]] = None
    between_start: Optional[Pose] = None
    matched: Optional[bool] = None
    unsolved: Optional[str] = None


@dataclass
class PoseDistancePair(Message):
    """Two poses.

    a: The first pose.
    b: The second pose; its heading and its position on the floor do not matter.
    """
    a: Pose
    b: Pose


@dataclass
class PoseDistanceSetting(Message):
    """The body.

    joints: The twenty joints, in the order of poses.
    parents: The name of each joint's parent; null for the first.
    """
    joints: List[str]
    parents: List[Optional[str]]


@dataclass
class PoseDistanceProblem(Message):
    """Pairs of poses.

    pairs: Two poses each.
    """
    HOLDS: ClassVar[dict] = {"pairs": [PoseDistancePair]}
    pairs: List[PoseDistancePair]


@dataclass
class PoseDistanceAnswer(Message):
    """The distance of each pair.

    distances: One per pair, 0 or more, on any scale; larger means less similar.
    alike: Per pair, whether a transition would go unnoticed.
    """
    distances: List[float]
    alike: List[bool]


@dataclass
class InbetweenSetting(Message):
    """The numbers of frames in each problem.

    past: How many frames before the gap are given (past).
    gap: How many frames are hidden.
    given: How many frames after the gap are given (future).
    """
    past: int
    gap: int
    given: int


@dataclass
class InbetweenProblem(Message):
    """The frames around a gap.

    rate_hz: Frames per second.
    joints: The names of the joints, parents first.
    parents: The index of each joint's parent; -1 for the first.
    offsets_m: Each joint's position in its parent's frame, in metres.
    gap: How many frames are missing.
    past: The frames before the gap: of each, 3 + 4 numbers per joint. First the position of the first joint,
        metres, Y up; then each joint's rotation in its parent's frame, a unit quaternion w, x, y, z.
    future: The frames behind the gap, likewise.
    """
    rate_hz: float
    joints: List[str]
    parents: List[int]
    offsets_m: List[Vector]
    gap: int
    past: List[List[float]]
    future: List[List[float]]


@dataclass
class InbetweenAnswer(Message):
    """The missing frames.

    frames: As many as are missing, in the form of past; a quaternion's length may be off by a hundredth.
    """
    frames: List[List[float]]


@dataclass
class KeyTarget(Message):
    """An angle of a key pose.

    feature: One of paper A's ten.
    degrees: What the feature should be, in degrees.
    tolerance_deg: Its largest deviation, in degrees.
    """
    feature: str
    degrees: float
    tolerance_deg: float


@dataclass
class KeyPose(Message):
    """What a move looks like at a beat.

    beat: When the pose is reached, in beats from the move's beginning; absent for recorded moves.
    targets: The features that count in it.
    """
    HOLDS: ClassVar[dict] = {"targets": [KeyTarget]}
    targets: List[KeyTarget]
    beat: Optional[float] = None


@dataclass
class DetectionFrame(Message):
    """What the sensor saw in a frame.

    pose: The sensed positions of the joints.
    states: Per joint a letter: tracked, inferred, not tracked.
    body_seen: False if nobody was seen; the pose is then the last one that was seen.
    """
    pose: Pose
    states: str
    body_seen: bool


@dataclass
class TaughtExample(Message):
    """A recorded performance that taught a move, by somebody who is not judged.

    person: The name of the performer; empty if it is unknown.
    is_right: True if the performance was right.
    fault: The fault that the label names; empty if the performance was right.
    rate_hz: Frames a second.
    frames: What the sensor saw, frame after frame.
    """
    HOLDS: ClassVar[dict] = {"frames": [DetectionFrame]}
    person: str
    is_right: bool
    fault: str
    rate_hz: float
    frames: List[DetectionFrame]


@dataclass
class Move(Message):
    """A move that may be performed.

    name: The move's name.
    tempo_bpm: Beats a minute of the example; absent for recorded moves.
    beats: How many beats it lasts; absent for recorded moves.
    span_s: The longest duration of a performance; only for recorded moves.
    rate_hz: Frames a second of the example.
    poses: The poses of one perfect performance; of a recorded move those of the first right example, none if there
        is no such example.
    file: The same motion as a BVH file; absent without poses.
    key_poses: What paper A's recogniser looks for, in order.
    examples: All performances by people who are not judged; only for recorded moves.
    """
    HOLDS: ClassVar[dict] = {"key_poses": [KeyPose], "examples": [TaughtExample]}
    name: str
    rate_hz: float
    poses: List[Pose]
    key_poses: List[KeyPose]
    tempo_bpm: Optional[float] = None
    beats: Optional[float] = None
    span_s: Optional[float] = None
    file: Optional[str] = None
    examples: Optional[List[TaughtExample]] = None


@dataclass
class DetectionSetting(Message):
    """The moves. Each recorded person has a setting of its own, with what all other people taught.

    joints: The twenty joints, in the order of poses.
    parents: The name of each joint's parent; null for the first.
    moves: The moves that may be performed.
    """
    HOLDS: ClassVar[dict] = {"moves": [Move]}
    joints: List[str]
    parents: List[Optional[str]]
    moves: List[Move]


@dataclass
class DetectionEvent(Message):
    """A performance that was asked for.

    move: The name of the move asked for.
    begin_frame: The first frame of its window.
    end_frame: The first frame after its window.
    """
    move: str
    begin_frame: int
    end_frame: int


@dataclass
class DetectionProblem(Message):
    """A session, as a sensor saw it.

    rate_hz: Frames a second.
    frames: What the sensor saw, frame after frame.
    events: What was asked for, in order of time.
    file: The positions as TRC.
    person: The name of the recorded person who is judged.
    starts: The first frames of all recordings of this person but the first.
    """
    HOLDS: ClassVar[dict] = {"frames": [DetectionFrame], "events": [DetectionEvent]}
    rate_hz: float
    frames: List[DetectionFrame]
    events: List[DetectionEvent]
    file: str
    person: Optional[str] = None
    starts: Optional[List[int]] = None


@dataclass
class DetectionCall(Message):
    """The judgement of an event.

    right_at_frame: The frame in its window at which it is called right; null if it is called wrong.
    score: How right it is, on any scale; higher: more right.
    """
    right_at_frame: Optional[int]
    score: float


@dataclass
class DetectionAlarm(Message):
    """A detection of a move.

    move: The name of the move.
    frame: The frame of the detection.
    """
    move: str
    frame: int


@dataclass
class DetectionAnswer(Message):
    """Which performances were right, and when.

    events: One per event, in order.
    alarms: Every detection of a move, at any time; those in a window in which that move was asked for or performed
        do no harm.
    """
    HOLDS: ClassVar[dict] = {"events": [DetectionCall], "alarms": [DetectionAlarm]}
    events: List[DetectionCall]
    alarms: List[DetectionAlarm]


@dataclass
class CaptureStroke(Message):
    """A limb that the annotator marks with a line.

    from: The name of a joint.
    to: The name of a joint.
    """
    from_: str
    to: str


@dataclass
class CaptureSetting(Message):
    """The pictures, and what the annotator marks in them.

    rate_hz: Pictures a second.
    image_width: Pixels.
    image_height: Pixels.
    joints: The twenty joints, in the order of poses.
    parents: The name of each joint's parent; null for the first.
    strokes: The limbs that the annotator marks.
    discs: The joints that the annotator marks with a disc.
    """
    HOLDS: ClassVar[dict] = {"strokes": [CaptureStroke]}
    rate_hz: float
    image_width: int
    image_height: int
    joints: List[str]
    parents: List[Optional[str]]
    strokes: List[CaptureStroke]
    discs: List[str]


@dataclass
class CapturePoint(Message):
    """A point of known position.

    world_m: Where it is in the world, in metres.
    pixel: u right, v down; (0.5, 0.5) is the centre of the first pixel.
    """
    world_m: Vector
    pixel: List[float]


@dataclass
class CaptureCamera(Message):
    """A camera and its film.

    calibration: Points that somebody clicked in the picture, from which the camera is calibrated.
    background: A picture of the empty room.
    pictures: PNG files, one per frame.
    """
    HOLDS: ClassVar[dict] = {"calibration": [CapturePoint]}
    calibration: List[CapturePoint]
    background: str
    pictures: List[str]


@dataclass
class CaptureProblem(Message):
    """A film by several cameras.

    frames: The number of frames.
    limb_lengths_m: The limb lengths of the person filmed, by name.
    cameras: The cameras and their films, which are synchronous.
    marks: By segmenter, then [camera][frame]: null, or strokes and discs in pixels.
    """
    HOLDS: ClassVar[dict] = {"cameras": [CaptureCamera]}
    frames: int
    limb_lengths_m: dict
    cameras: List[CaptureCamera]
    marks: dict


@dataclass
class CaptureAnswer(Message):
    """The motion.

    poses: Per frame, a pose, or null if there is none.
    """
    poses: List[Optional[Pose]]


@dataclass
class CaptureSegmenterBegin(Message):
    """A camera's film begins.

    seat: Always segmenter.
    camera: The camera's number, from 1.
    background: A picture of the empty room, binary PPM.
    """
    camera: int
    background: str
    seat: Optional[str] = None


@dataclass
class CaptureSegmenterStep(Message):
    """The next picture.

    picture: The picture, as binary PPM.
    """
    picture: str


@dataclass
class CaptureMask(Message):
    """COCO's uncompressed run lengths, down the columns.

    size: Height, width.
    counts: Background and person in turn, background first.
    """
    size: List[int]
    counts: List[int]


@dataclass
class CaptureSegmenterAnswer(Message):
    """What has changed against the empty room.

    mask: Which pixels are the person.
    """
    HOLDS: ClassVar[dict] = {"mask": CaptureMask}
    mask: CaptureMask


@dataclass
class CoachRepetition(Message):
    """A performance of the dance.

    move: The name of the move that is danced.
    """
    move: str


@dataclass
class CoachDance(Message):
    """What is danced, in order.

    title: The song's title.
    tempo_bpm: Beats a minute.
    rate_hz: Steps a second.
    repetitions: The moves of the song, in the order in which they are danced.
    """
    HOLDS: ClassVar[dict] = {"repetitions": [CoachRepetition]}
    title: str
    tempo_bpm: float
    rate_hz: float
    repetitions: List[CoachRepetition]


@dataclass
class CoachSetting(Message):
    """The moves of the dance, at the song's tempo.

    joints: The twenty joints, in the order of poses.
    parents: The name of each joint's parent; null for the first.
    moves: Those of the dance, their examples at the song's tempo.
    dance: What is danced, in order.
    """
    HOLDS: ClassVar[dict] = {"moves": [Move], "dance": CoachDance}
    joints: List[str]
    parents: List[Optional[str]]
    moves: List[Move]
    dance: CoachDance


@dataclass
class CoachBegin(Message):
    """A session begins.

    seat: Which part of the coach, or the learner, the program is.
    """
    seat: str


@dataclass
class CoachAsk(Message):
    """What is asked for from this frame on.

    move: The move's name; null: nothing is asked for.
    """
    move: Optional[str]


@dataclass
class CoachRecogniserStep(Message):
    """What the sensor reports.

    pose: The learner's joints as the sensor sees them.
    states: Per joint a letter: tracked, inferred, not tracked.
    body_seen: False if nobody was seen; the pose is then the last one that was seen.
    ask: What is asked for from this frame on; left out if it does not change.
    """
    HOLDS: ClassVar[dict] = {"ask": CoachAsk}
    pose: Pose
    states: str
    body_seen: bool
    ask: Optional[CoachAsk] = None


@dataclass
class CoachRecogniserAnswer(Message):
    """The evidence that performances are right.

    asked: The evidence so far that the requested performance is right, 0 to 1.
    spotted: The same for every move, asked for or not.
    """
    asked: float
    spotted: Optional[List[float]] = None


@dataclass
class CoachVerdict(Message):
    """The verdict on a window that has just closed.

    move: The name of the move that was asked for.
    repetition: Which performance of the dance it was, from 0.
    verdict: The coach's verdict; unjudged: it saw too little.
    mistake: What was wrong: none, not reached, stood still or wrong side.
    evidence: The evidence that it was right, 0 to 1.
    """
    move: Optional[str]
    repetition: int
    verdict: str
    mistake: str
    evidence: float


@dataclass
class CoachPolicyStep(Message):
    """What the coach shows, and how it went.

    mode: What the coach does, such as dance, correct, demonstrate, praise.
    move: The name of the move that it shows; null: none.
    repetition: Which performance of the dance it is, from 0; -1: none.
    verdicts: The verdicts on the windows that have just closed; mostly none.
    """
    HOLDS: ClassVar[dict] = {"verdicts": [CoachVerdict]}
    mode: str
    move: Optional[str]
    repetition: int
    verdicts: List[CoachVerdict]


@dataclass
class CoachPolicyAnswer(Message):
    """What the coach does next.

    correct: Whether to interrupt the dance, now or as soon as there is one.
    """
    correct: bool


@dataclass
class CoachTest(Message):
    """After the session: whether a move is danced right.

    move: The name of the move to be danced.
    after: How many performances later.
    """
    move: str
    after: int


@dataclass
class CoachLearnerStep(Message):
    """What the coach shows. After the session, a step holds only a test.

    pose: The coach's pose, as the learner sees it.
    mode: What the coach does, such as dance, correct, demonstrate, praise.
    clip: The clip that the coach plays: dance, an act, or slow_ and a move.
    clip_frame: The frame of that clip.
    move: The name of the move that the coach shows; null: none.
    repetition: Which performance of the dance it is, from 0; -1: none.
    say: A short word to the learner.
    hint: What to do better.
    events: What the coach has just decided.
    test: Only after the session, when all other fields are left out: a move that the learner dances without a
        coach.
    """
    HOLDS: ClassVar[dict] = {"test": CoachTest}
    pose: Optional[Pose] = None
    mode: Optional[str] = None
    clip: Optional[str] = None
    clip_frame: Optional[float] = None
    move: Optional[str] = None
    repetition: Optional[int] = None
    say: Optional[str] = None
    hint: Optional[str] = None
    events: Optional[List[str]] = None
    test: Optional[CoachTest] = None


@dataclass
class CoachLearnerAnswer(Message):
    """What the learner does.

    pose: The learner's pose, a quarter of a second later.
    right: Whether the performance that it dances is right; null: neither right nor wrong.
    given_up: Whether the learner gives up, which ends the session.
    """
    pose: Optional[Pose] = None
    right: Optional[bool] = None
    given_up: Optional[bool] = None


@dataclass
class MetricSetting(Message):
    """What a metric is measured on: cells of one scenario.

    metric: The metric's name in the scenario.
    version: The metric's version in the scenario.
    task: The scenario's task.
    unit: The unit of positions: m.
    joints: The joints, in the order of poses.
    parents: The name of each joint's parent; null for the first.
    """
    metric: str
    version: int
    task: str
    unit: str
    joints: List[str]
    parents: List[Optional[str]]


@dataclass
class MetricTrack(Message):
    """A motion of a cell.

    name: Which motion it is, such as truth, solution or sensed.
    rate_hz: Frames a second.
    poses: One pose per frame.
    """
    name: str
    rate_hz: float
    poses: List[Pose]


@dataclass
class MetricProblem(Cell):
    """A finished cell, as a recording keeps it (docs/reference/recordings.md).

    tracks: The cell's motions, truth among them.
    extras: What the task keeps beside motions.
    """
    HOLDS: ClassVar[dict] = {"tracks": [MetricTrack]}
    tracks: List[MetricTrack]
    extras: dict


@dataclass
class MetricAnswer(Message):
    """The metric's value.

    value: The value; null if there is none.
    reason: Why there is none.
    """
    value: Optional[float]
    reason: Optional[str] = None
