"""The engine on arrays: the module `etude_engine`, a wheel of its own (docs/python.md#the-engine-on-arrays)."""
try:
    from etude_engine import *  # noqa: F401, F403
except ImportError as error:
    if error.name != "etude_engine":
        raise  # it is installed, but one of its own imports is missing
    raise ImportError("the module etude_engine is not installed; build a wheel for pip by `python3 -m build --wheel "
                      "--no-isolation python/engine`") from error
