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
    """A joint of the body whose pose is computed.

    name: The joint's name.
    parent: The parent's name; null for the root.
    offset_m: The joint's position from its parent, in the parent's frame, in metres.
    rest: The rotation from the joint's frame into its parent's frame if all its angles are 0.
    axes: The rotation axes of the joint's angles, in order.
    first_angle: The index of the joint's first angle in the setting's list of angles.
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
    lower_deg: The angle's lower limit, in degrees.
    upper_deg: The angle's upper limit, in degrees.
    """
    name: str
    lower_deg: float
    upper_deg: float


@dataclass
class IkEffector(Message):
    """The free end of a limb.

    name: The effector's name.
    joint: The joint to which the effector is attached.
    offset_m: The effector's position in that joint's frame, in metres.
    """
    name: str
    joint: int
    offset_m: Vector


@dataclass
class IkRoot(Message):
    """The pose of the root joint, which is given and not solved for.

    position_m: The root's position in the world, in metres.
    rotation: The rotation from the root's frame into the world's.
    """
    position_m: Vector
    rotation: Rotation


@dataclass
class IkTarget(Message):
    """The target of an effector.

    effector: The name of the effector that must reach the target.
    position_m: The position that the effector must reach in the world, in metres.
    rotation: The rotation from the effector's frame into the world's.
    """
    effector: str
    position_m: Vector
    rotation: Rotation


@dataclass
class IkFrame(Message):
    """A frame of the motion to follow.

    root: The pose of the root joint in this frame.
    targets: One target per effector, in order.
    """
    HOLDS: ClassVar[dict] = {"root": IkRoot, "targets": [IkTarget]}
    root: IkRoot
    targets: List[IkTarget]


@dataclass
class IkSetting(Message):
    """The body, and what an answer must reach.

    joints: The joints, parents first.
    angles: The angles, one per degree of freedom, in the order in which answers list them.
    effectors: The free ends that have targets.
    max_steps: The step limit of the built-in solvers. It is for information, as are the goals.
    position_goal_cm: The largest distance from an effector to its target that counts as solved, in centimetres.
    orientation_goal_deg: The largest angle between an axis of the effector and that of its target that counts as
        solved, in degrees.
    asked: The parts of its target that each effector must reach: position, orientation, or both.
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
    """A pose to be computed.

    root: The pose of the root joint.
    start_angles_deg: The angles to start from, within all limits.
    targets: One target per effector, in order.
    """
    HOLDS: ClassVar[dict] = {"root": IkRoot, "targets": [IkTarget]}
    root: IkRoot
    start_angles_deg: List[float]
    targets: List[IkTarget]


@dataclass
class IkAnswer(Message):
    """The computed pose.

    angles_deg: As many angles as in the setting. An answer with an angle more than 10⁻⁶ degrees beyond its limit is
        measured, and counts as unsolved.
    iterations: The number of the method's own steps.
    fk_evaluations: The number of its forward-kinematics passes over the whole tree.
    """
    angles_deg: List[float]
    iterations: Optional[int] = None
    fk_evaluations: Optional[int] = None


@dataclass
class TrackingSetting(Message):
    """The frame rate, and the limits of built-in solvers in each frame.

    rate_hz: Frames per second.
    max_steps: The step limit of the built-in solvers. It is for information, as are the goals.
    position_goal_cm: The largest distance from an effector to its target that counts as solved, in centimetres.
    orientation_goal_deg: The largest angle between an axis of the effector and that of its target that counts as
        solved, in degrees.
    """
    rate_hz: float
    max_steps: int
    position_goal_cm: float
    orientation_goal_deg: float


@dataclass
class TrackingProblem(Message):
    """A motion, and the body that must follow it.

    joints: The joints, parents first.
    angles: The angles, one per degree of freedom, in the order in which answers list them.
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

    angles_deg: Per frame as many angles as in the problem. A frame with an angle more than 10⁻⁶ degrees beyond its
        limit is measured, and counts as unsolved.
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

    rate_hz: Frames per second of all clips.
    joints: The twenty joints, in the order of poses.
    parents: The name of each joint's parent; null for the first.
    clips: The clips of the library. Problems refer to a clip by its index, from 0.
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
    max_wait_s: The longest wait that is wanted, in seconds.
    """
    from_: int
    to: int
    request_frame: int
    max_wait_s: float


@dataclass
class TransitionStop(Message):
    """A clip that is played between the current and the wanted clip.

    clip: The clip's index in the library.
    enter_frame: The frame of this clip that replaces the last shown frame of the previous clip.
    leave_frame: The last frame of this clip that is shown.
    """
    clip: int
    enter_frame: int
    leave_frame: int


@dataclass
class TransitionAnswer(Message):
    """The frames at which the transition leaves one clip and enters the other, or the reason why no transition was found.

    leave_frame: The last frame of the current clip that is shown: request_frame or a later one.
    enter_frame: The frame of the wanted clip that corresponds to leave_frame; it must not be the clip's last. The
        clip is shown from the frame after it on.
    through: The clips that are played between the current and the wanted clip, 16 at most.
    join: Any built-in join (etude list methods); cut by default.
    join_s: The blend length of minimum-jerk or planted-feet, 0 to 5 seconds. Other joins choose their own lengths.
    fades: Only with join_s. True: the old clip continues and fades out; false: its offset from the new clip decays.
    direct: Only with join_s: each limb moves with minimum jerk to its pose in the new clip at the end of the join.
    between: Up to 300 poses that the method makes itself. They are shown after leave_frame, at its position and
        heading; the last one is shown instead of enter_frame. Limb lengths may differ from the clips' by 2 cm. Not
        allowed together with through.
    between_start: Only with between: the pose that the method computed for leave_frame. It is not shown, but the
        gaps at the first transition point are measured to it. Without it, the first poses of between are taken to
        move at a constant speed.
    matched: True if the two frames were chosen because their poses are similar. Only then is false_smooth measured.
    unsolved: The reason why no transition was found.
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

    distances: One distance per pair, 0 or more, on any scale. A larger distance means less similar poses.
    alike: Per pair, whether the poses are so similar that nobody would notice a transition between them.
    """
    distances: List[float]
    alike: List[bool]


@dataclass
class InbetweenSetting(Message):
    """The numbers of frames in each problem.

    past: The number of given frames before the gap (past).
    gap: The number of frames in the gap, which are hidden.
    given: The number of given frames after the gap (future).
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
    gap: The number of missing frames.
    past: The frames before the gap: of each, 3 + 4 numbers per joint. First the position of the first joint,
        metres, Y up; then each joint's rotation in its parent's frame, a unit quaternion w, x, y, z.
    future: The frames after the gap, likewise.
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

    frames: The missing frames, gap in number, in the form of past. A quaternion's length may differ from 1 by 0.01.
    """
    frames: List[List[float]]


@dataclass
class KeyTarget(Message):
    """An angle of a key pose.

    feature: One of paper A's ten pose features.
    degrees: The target value of the feature, in degrees.
    tolerance_deg: The largest allowed deviation from that value, in degrees.
    """
    feature: str
    degrees: float
    tolerance_deg: float


@dataclass
class KeyPose(Message):
    """The pose that a move must have at a beat.

    beat: The time of the pose in beats from the beginning of the move; absent for recorded moves.
    targets: The pose features that are compared.
    """
    HOLDS: ClassVar[dict] = {"targets": [KeyTarget]}
    targets: List[KeyTarget]
    beat: Optional[float] = None


@dataclass
class DetectionFrame(Message):
    """The sensor's output for one frame.

    pose: The sensed positions of the joints.
    states: One letter per joint: tracked, inferred or not tracked.
    body_seen: False if the sensor saw nobody. The pose is then the last pose that it saw.
    """
    pose: Pose
    states: str
    body_seen: bool


@dataclass
class TaughtExample(Message):
    """A recorded performance from which a move is learnt, by a person who is not judged.

    person: The name of the performer; empty if it is unknown.
    is_right: True if the performance was right.
    fault: The fault that the performance has by its label; empty if it was right.
    rate_hz: Frames per second.
    frames: The sensor's output, one entry per frame.
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
    tempo_bpm: The tempo of the example in beats per minute; absent for recorded moves.
    beats: The duration of the move in beats; absent for recorded moves.
    span_s: The longest duration of a performance; only for recorded moves.
    rate_hz: Frames per second of the example.
    poses: The poses of one perfect performance. For a recorded move, they are those of the first right example, or
        none if there is no such example.
    file: The same motion as a BVH file; absent without poses.
    key_poses: The poses that paper A's recogniser looks for, in order.
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
    """The moves. For recorded people, each person has a separate setting, whose examples are by all other people.

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
    """A requested performance of a move.

    move: The name of the requested move.
    begin_frame: The first frame of its window.
    end_frame: The first frame after its window.
    """
    move: str
    begin_frame: int
    end_frame: int


@dataclass
class DetectionProblem(Message):
    """A session as recorded by a sensor.

    rate_hz: Frames per second.
    frames: The sensor's output, one entry per frame.
    events: The requested performances, in order of time.
    file: The joint positions as a TRC file.
    person: The name of the recorded person who is judged.
    starts: The index of the first frame of each recording of this person, except the first recording.
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

    right_at_frame: The frame in the event's window at which the performance is called right; null if it is called
        wrong.
    score: The confidence that the performance is right, on any scale.
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
    """Which performances are called right, and at which frame.

    events: One judgement per event, in order.
    alarms: All detections of moves, at any time. A detection within a window in which its move was requested or
        performed is not a false alarm.
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
    """The rate of the pictures, and the limbs and joints that the annotator marks in them.

    rate_hz: Pictures per second.
    joints: The twenty joints, in the order of poses.
    parents: The name of each joint's parent; null for the first.
    strokes: The limbs that the annotator marks.
    discs: The joints that the annotator marks with a disc.
    """
    HOLDS: ClassVar[dict] = {"strokes": [CaptureStroke]}
    rate_hz: float
    joints: List[str]
    parents: List[Optional[str]]
    strokes: List[CaptureStroke]
    discs: List[str]


@dataclass
class CapturePoint(Message):
    """A point of known position.

    world_m: The point's position in the world, in metres.
    pixel: The point's position in the picture, in pixels: u to the right, v down; (0.5, 0.5) is the centre of the
        first pixel.
    """
    world_m: Vector
    pixel: List[float]


@dataclass
class CaptureCamera(Message):
    """A camera and its film.

    image_width: The width of a picture, in pixels.
    image_height: The height of a picture, in pixels.
    calibration: Points that a person clicked in the picture, from which the camera is calibrated.
    background: A picture of the empty room.
    pictures: The names of the PNG files, one per frame.
    """
    HOLDS: ClassVar[dict] = {"calibration": [CapturePoint]}
    image_width: int
    image_height: int
    calibration: List[CapturePoint]
    background: str
    pictures: List[str]


@dataclass
class CaptureProblem(Message):
    """A film by several cameras.

    frames: The number of frames.
    limb_lengths_m: The limb lengths of the person filmed, by name.
    cameras: The cameras and their films, which are synchronised.
    marks: The annotator's marks. Each key is the name of a segmenter, each value is marks[camera][frame]: strokes
        and discs in pixels, or null for a frame without marks.
    """
    HOLDS: ClassVar[dict] = {"cameras": [CaptureCamera]}
    frames: int
    limb_lengths_m: dict
    cameras: List[CaptureCamera]
    marks: dict


@dataclass
class CaptureAnswer(Message):
    """The motion.

    poses: One pose per frame, or null for a frame without a pose.
    """
    poses: List[Optional[Pose]]


@dataclass
class CaptureSegmenterBegin(Message):
    """The start of a camera's film.

    seat: The program's part in the loop, always segmenter.
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
    """A mask as uncompressed run lengths in COCO's format, column by column.

    size: The height, then the width, in pixels.
    counts: The run lengths of background and person in turn, background first.
    """
    size: List[int]
    counts: List[int]


@dataclass
class CaptureSegmenterAnswer(Message):
    """The person in the picture.

    mask: The mask of the person.
    """
    HOLDS: ClassVar[dict] = {"mask": CaptureMask}
    mask: CaptureMask


@dataclass
class CoachRepetition(Message):
    """A performance of the dance.

    move: The name of the danced move.
    """
    move: str


@dataclass
class CoachDance(Message):
    """The dance: the moves in order, and their tempo.

    title: The song's title.
    tempo_bpm: Beats per minute.
    rate_hz: Steps per second.
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
    moves: The moves of the dance, with examples at the song's tempo.
    dance: The dance: the moves in order, and their tempo.
    """
    HOLDS: ClassVar[dict] = {"moves": [Move], "dance": CoachDance}
    joints: List[str]
    parents: List[Optional[str]]
    moves: List[Move]
    dance: CoachDance


@dataclass
class CoachBegin(Message):
    """The start of a session.

    seat: The part that the program takes: a part of the coach, or the learner.
    """
    seat: str


@dataclass
class CoachAsk(Message):
    """The move that is requested from this frame on.

    move: The move's name; null if no move is requested.
    """
    move: Optional[str]


@dataclass
class CoachRecogniserStep(Message):
    """The sensor's output for one frame.

    pose: The learner's joint positions as measured by the sensor.
    states: One letter per joint: tracked, inferred or not tracked.
    body_seen: False if the sensor saw nobody. The pose is then the last pose that it saw.
    ask: The move that is requested from this frame on; absent if it does not change.
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
    spotted: The evidence for every move, requested or not.
    """
    asked: float
    spotted: Optional[List[float]] = None


@dataclass
class CoachVerdict(Message):
    """The verdict on a window that has just closed.

    move: The name of the move that was asked for.
    repetition: The index of the performance in the dance, from 0.
    verdict: The coach's verdict; unjudged if the coach saw too little.
    mistake: The mistake: none, not reached, stood still or wrong side.
    evidence: The evidence that the performance was right, 0 to 1.
    """
    move: Optional[str]
    repetition: int
    verdict: str
    mistake: str
    evidence: float


@dataclass
class CoachPolicyStep(Message):
    """What the coach shows, and its verdicts.

    mode: The coach's activity, such as dance, correct, demonstrate or praise.
    move: The name of the move that the coach shows; null if there is none.
    repetition: The index of the performance in the dance, from 0; -1 if there is none.
    verdicts: The verdicts on the windows that have just closed; the list is usually empty.
    """
    HOLDS: ClassVar[dict] = {"verdicts": [CoachVerdict]}
    mode: str
    move: Optional[str]
    repetition: int
    verdicts: List[CoachVerdict]


@dataclass
class CoachPolicyAnswer(Message):
    """The coach's next decision.

    correct: True if the coach must interrupt the dance, at once or as soon as it dances again.
    """
    correct: bool


@dataclass
class CoachTest(Message):
    """A test after the session: the learner dances a move without the coach.

    move: The name of the move that the learner must dance.
    after: The time from the end of the session to the test, as the number of performances that would fill it.
    """
    move: str
    after: int


@dataclass
class CoachLearnerStep(Message):
    """The coach's output for one frame. After the session, a step contains only a test.

    pose: The coach's pose as the learner sees it.
    mode: The coach's activity, such as dance, correct, demonstrate or praise.
    clip: The clip that the coach plays: dance, the name of an act, or slow_ followed by the name of a move.
    clip_frame: The frame of that clip.
    move: The name of the move that the coach shows; null if there is none.
    repetition: The index of the performance in the dance, from 0; -1 if there is none.
    say: A short spoken message to the learner.
    hint: Advice on how to improve.
    events: The decisions that the coach has just made.
    test: A test, only after the session. All other fields are then absent.
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
    """The learner's reaction.

    pose: The learner's pose, a quarter of a second later.
    right: True if the learner's current performance is right; null if it is neither right nor wrong.
    given_up: True if the learner gives up, which ends the session.
    """
    pose: Optional[Pose] = None
    right: Optional[bool] = None
    given_up: Optional[bool] = None


@dataclass
class MetricSetting(Message):
    """The scenario whose cells are measured.

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

    name: The motion's name, such as truth, solution or sensed.
    rate_hz: Frames per second.
    poses: One pose per frame.
    """
    name: str
    rate_hz: float
    poses: List[Pose]


@dataclass
class MetricProblem(Cell):
    """A finished cell, with the content of its recording (docs/reference/recordings.md).

    tracks: The cell's motions, truth among them.
    extras: The task's data other than motions.
    """
    HOLDS: ClassVar[dict] = {"tracks": [MetricTrack]}
    tracks: List[MetricTrack]
    extras: dict


@dataclass
class MetricAnswer(Message):
    """The metric's value.

    value: The metric's value; null if it has none.
    reason: The reason why the metric has no value.
    """
    value: Optional[float]
    reason: Optional[str] = None
