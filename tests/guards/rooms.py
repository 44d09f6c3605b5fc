"""Which room may include which: the house, as data. A room is a folder; guard.py holds every include to this.

The table tells what is, not what might be: a pair that no file needs is complained about as well, so whoever adds,
renames or joins rooms edits this file, and only this. The rooms form no circle.
"""

# room: the other rooms that its files may include.
MAY_INCLUDE = {
    # engine/
    "engine/base": "",
    "engine/boards": "engine/base",
    "engine/bundle_adjustment": "engine/base engine/cameras engine/kinematics",
    "engine/cameras": "engine/base engine/document",
    "engine/capture":
        "engine/base engine/boards engine/bundle_adjustment engine/cameras engine/kinematics engine/kinematics/solvers "
        "engine/motion engine/smoothing engine/vision",
    "engine/coaching":
        "engine/base engine/fuzzy engine/motion engine/recognition engine/transitions engine/transitions/base "
        "engine/transitions/joins engine/transitions/library",
    "engine/document": "engine/base",
    "engine/formats": "engine/base engine/motion",
    "engine/formats/deepmimic": "engine/base engine/formats/json engine/motion",
    "engine/formats/gltf": "engine/base engine/formats engine/motion",
    "engine/formats/json": "engine/base",
    "engine/fuzzy": "engine/base engine/document engine/motion",
    "engine/keypoints":
        "engine/base engine/cameras engine/capture engine/formats engine/kinematics engine/motion engine/vision",
    "engine/kinematics": "engine/base engine/motion",
    "engine/kinematics/solvers": "engine/base engine/kinematics",
    "engine/motion": "engine/base",
    "engine/recognition": "engine/base engine/document engine/fuzzy engine/motion",
    "engine/retargeting": "engine/base engine/document engine/motion",
    "engine/silhouettes": "engine/base engine/cameras engine/kinematics engine/motion",
    "engine/smoothing": "",
    "engine/streams": "engine/base engine/formats engine/formats/json engine/recognition",
    "engine/teaching": "engine/base engine/document engine/recognition",
    "engine/transitions": "engine/transitions/choices engine/transitions/joins",
    "engine/transitions/base": "engine/fuzzy engine/motion",
    "engine/transitions/bridge_frames":
        "engine/base engine/fuzzy engine/motion engine/transitions/base engine/transitions/search",
    "engine/transitions/choices":
        "engine/base engine/fuzzy engine/motion engine/transitions/base engine/transitions/bridge_frames "
        "engine/transitions/in_betweens engine/transitions/joins engine/transitions/library "
        "engine/transitions/search",
    "engine/transitions/in_betweens":
        "engine/base engine/motion engine/transitions/base engine/transitions/bridge_frames",
    "engine/transitions/joins": "engine/base engine/motion engine/transitions/base",
    "engine/transitions/library":
        "engine/fuzzy engine/motion engine/transitions/bridge_frames engine/transitions/in_betweens",
    "engine/transitions/search": "engine/base engine/fuzzy engine/transitions/base",
    "engine/transitions/tags_file":
        "engine/base engine/fuzzy engine/transitions/bridge_frames engine/transitions/library",
    "engine/unmarked":
        "engine/base engine/cameras engine/capture engine/kinematics engine/motion engine/silhouettes engine/vision",
    "engine/vision": "engine/base engine/cameras engine/motion",
    # sim/
    "sim/annotator": "engine/base engine/motion engine/vision sim/body sim/random",
    "sim/body": "engine/motion",
    "sim/camera": "engine/base engine/cameras sim/random sim/render",
    "sim/character": "engine/base engine/motion engine/retargeting sim/body sim/choreography sim/render",
    "sim/choreography":
        "engine/base engine/coaching engine/document engine/fuzzy engine/motion sim/random",
    "sim/depth_camera": "engine/base engine/cameras sim/random sim/sensors sim/skeleton_sensor",
    "sim/music": "engine/base engine/motion sim/random",
    "sim/performer": "engine/base engine/motion sim/choreography sim/random",
    "sim/random": "engine/base",
    "sim/render": "engine/base engine/cameras sim/body sim/random",
    "sim/rig": "engine/base engine/boards engine/cameras engine/motion sim/random sim/render",
    "sim/sensors": "engine/base engine/cameras sim/render",
    "sim/skeleton_sensor":
        "engine/base engine/cameras engine/document engine/motion engine/recognition sim/body sim/random",
    "sim/stage":
        "engine/base engine/cameras engine/motion sim/body sim/character sim/choreography sim/random sim/render",
    # bench/
    "bench/calibration": "sim/random bench/statistics",
    "bench/clips":
        "engine/base engine/formats engine/formats/deepmimic engine/formats/gltf engine/motion engine/retargeting "
        "sim/camera sim/character sim/choreography sim/sensors bench/files",
    "bench/dataset": "engine/base bench/files bench/films bench/process bench/run bench/scenario",
    "bench/files": "engine/base",
    "bench/films": "engine/base sim/render sim/sensors bench/files bench/model",
    "bench/finished_runs": "engine/base bench/files bench/gate bench/metrics bench/results bench/run bench/scenario",
    "bench/gate": "engine/base sim/random bench/files bench/metrics bench/model bench/statistics",
    "bench/keys": "engine/base engine/document bench/files",
    "bench/keypoints": "engine/base engine/keypoints engine/vision sim/sensors bench/files",
    "bench/metrics": "engine/base engine/cameras engine/kinematics engine/motion bench/files",
    "bench/micro":
        "engine/base engine/cameras engine/formats engine/fuzzy engine/kinematics engine/kinematics/solvers engine/motion "
        "engine/recognition engine/transitions/choices engine/transitions/search engine/vision sim/annotator "
        "sim/camera sim/character sim/choreography sim/random sim/render sim/stage bench/clips "
        "bench/tasks/coach bench/tasks/ik bench/tasks/tracking",
    "bench/model": "engine/base engine/motion bench/files",
    "bench/outside": "engine/base engine/document bench/files bench/model bench/process bench/tasks bench/tasks/base",
    "bench/process": "engine/base",
    "bench/recordings": "engine/base engine/cameras engine/fuzzy engine/motion bench/files",
    "bench/replay": "engine/base sim/random bench/clips bench/files bench/model bench/results bench/run",
    "bench/results": "engine/base bench/files bench/metrics bench/model",
    "bench/run":
        "engine/base sim/render bench/files bench/model bench/metrics bench/outside bench/process bench/results bench/scenario "
        "bench/statistics bench/streams bench/tasks bench/tasks/base",
    "bench/scenario":
        "engine/base engine/document engine/streams bench/files bench/keys bench/metrics bench/model bench/tasks "
        "bench/tasks/base",
    "bench/real_takes": "engine/base engine/document",
    "bench/sensor_fit":
        "engine/base engine/document engine/formats engine/recognition sim/random sim/skeleton_sensor",
    "bench/statistics": "engine/base sim/random bench/metrics bench/model",
    "bench/streams":
        "engine/base engine/recognition engine/streams engine/teaching bench/clips bench/files bench/metrics",
    "bench/tasks":
        "engine/base bench/tasks/base bench/tasks/capture bench/tasks/coach bench/tasks/detection bench/tasks/ik "
        "bench/tasks/pose_distance bench/tasks/search bench/tasks/tracking bench/tasks/transition",
    "bench/tasks/base":
        "engine/base engine/document engine/fuzzy engine/kinematics engine/kinematics/solvers engine/motion "
        "sim/random bench/clips bench/files bench/keys bench/model",
    "bench/tasks/capture":
        "engine/base engine/boards engine/cameras engine/capture engine/formats engine/keypoints engine/kinematics engine/motion "
        "engine/silhouettes engine/vision sim/annotator sim/body sim/camera sim/character sim/depth_camera sim/random sim/render sim/rig "
        "sim/sensors sim/stage bench/clips bench/files bench/keys bench/metrics bench/model bench/recordings bench/tasks/base",
    "bench/tasks/coach":
        "engine/base engine/coaching engine/motion engine/recognition "
        "sim/choreography sim/music sim/performer sim/random sim/skeleton_sensor bench/keys bench/metrics bench/model "
        "bench/recordings bench/tasks/base bench/tasks/detection bench/tasks/sensing bench/tasks/transition",
    "bench/tasks/detection":
        "engine/base engine/formats engine/motion engine/recognition engine/teaching sim/choreography sim/performer "
        "sim/skeleton_sensor bench/clips bench/keys bench/metrics bench/recordings bench/streams bench/tasks/base bench/tasks/capture "
        "bench/tasks/sensing",
    "bench/tasks/ik":
        "engine/base engine/kinematics engine/kinematics/solvers sim/random bench/metrics "
        "bench/recordings bench/tasks/base",
    "bench/tasks/pose_distance":
        "engine/base engine/fuzzy engine/transitions/base engine/transitions/choices engine/transitions/library "
        "sim/choreography sim/random bench/clips bench/keys bench/metrics bench/tasks/base bench/training",
    "bench/tasks/search":
        "engine/base engine/fuzzy engine/transitions/search sim/choreography sim/random bench/clips bench/keys "
        "bench/metrics bench/tasks/base",
    "bench/tasks/sensing":
        "engine/base engine/capture engine/motion engine/recognition sim/random sim/skeleton_sensor bench/keys "
        "bench/tasks/base bench/tasks/capture",
    "bench/tasks/tracking":
        "engine/base engine/formats engine/kinematics engine/kinematics/solvers engine/motion sim/choreography "
        "sim/random bench/clips bench/files bench/metrics bench/model bench/tasks/base",
    "bench/tasks/transition":
        "engine/base engine/formats engine/fuzzy engine/motion engine/transitions engine/transitions/base "
        "engine/transitions/bridge_frames engine/transitions/joins engine/transitions/library sim/choreography "
        "sim/random bench/clips bench/keys bench/metrics bench/recordings bench/tasks/base bench/training",
    "bench/training":
        "engine/base engine/fuzzy engine/transitions/base engine/transitions/library sim/choreography sim/random "
        "bench/metrics",
    # reports/
    "reports":
        "engine/base bench/files bench/gate bench/model bench/real_takes bench/recordings reports/assets reports/films reports/growth "
        "reports/paper reports/plots reports/transitions reports/words",
    "reports/assets": "",
    "reports/bridges":
        "engine/base engine/fuzzy engine/transitions/bridge_frames engine/transitions/library bench/files",
    "reports/captures": "engine/base engine/cameras engine/keypoints engine/motion bench/films reports/films",
    "reports/clips":
        "engine/base engine/cameras engine/motion engine/retargeting engine/transitions/joins sim/body sim/character "
        "sim/choreography sim/render bench/clips bench/files bench/films reports/films reports/words",
    "reports/coach": "engine/base engine/coaching bench/files",
    "reports/films":
        "engine/base engine/cameras engine/formats engine/kinematics engine/motion engine/recognition sim/body "
        "sim/camera sim/character sim/music "
        "sim/render sim/sensors sim/stage bench/files bench/films bench/metrics bench/model bench/recordings reports/plots reports/transitions reports/words",
    "reports/growth": "bench/model reports/paper reports/words",
    "reports/paper": "engine/fuzzy engine/kinematics bench/model reports/plots reports/words",
    "reports/plots": "bench/model bench/statistics reports/words",
    "reports/sensors": "engine/base bench/model reports/films",
    "reports/transitions": "engine/base bench/model bench/recordings reports/words",
    "reports/words": "bench/metrics bench/model",
    # cli/
    "cli": "any",
}

# What makes worlds, asks methods in them, or reads what people wrote: all that knows a task.
TASKS = "bench/tasks bench/scenario bench/outside bench/run bench/finished_runs bench/dataset bench/replay bench/training"
# What worlds of some task are made of.
MATERIAL = "bench/clips engine/document engine/formats engine/recognition engine/retargeting sim/choreography sim/performer"

# (rooms with all below them, what none of their files may include even through others). Folders hold for all below.
NEVER_INCLUDES = [
    ("engine/base", "engine/motion engine/document engine/cameras"),
    ("bench/model", "bench/metrics bench/results bench/statistics bench/gate bench/recordings reports"),
    ("bench/model bench/recordings bench/results bench/statistics bench/metrics bench/gate reports", TASKS),
    ("bench/model bench/recordings bench/results bench/statistics bench/metrics bench/gate", MATERIAL),
    ("reports/words reports/growth reports/transitions reports/paper", "bench/clips engine/retargeting sim"),
    ("reports/films", "bench/clips"),
]
