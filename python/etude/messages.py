"""The base of problems, steps and answers: dataclasses that are read from JSON and written to it."""
import dataclasses
import json
import math


class Message:
    """A dataclass whose fields are the keys of a JSON object of the protocol (`from_` stands for `from`).

    Its values can also be read as from a dict: `problem["root"]`, `problem.get("ask")`, `"ask" in step`.
    """

    HOLDS = {}  # by key: the class of its value, or [class] if the value is a list

    @classmethod
    def of(cls, told):
        """Makes a message from a dict. Unknown keys (of later versions) are left out; missing keys become None."""
        found = {}
        for name in (field.name for field in dataclasses.fields(cls)):
            key = _key(name)
            kind, value = cls.HOLDS.get(key), told.get(key)
            if value is not None and kind is not None:
                value = [kind[0].of(each) for each in value] if isinstance(kind, list) else kind.of(value)
            found[name] = value
        return cls(**found)

    def to_json(self):
        """Returns the object as dicts and lists. Optional fields that are None are left out."""
        told = {}
        for field in dataclasses.fields(self):
            value = getattr(self, field.name)
            if value is not None or field.default is dataclasses.MISSING:
                told[_key(field.name)] = _unfolded(value)
        return told

    def get(self, key, otherwise=None):
        value = getattr(self, _name(key), None)
        return otherwise if value is None else value

    def __getitem__(self, key):
        name = _name(key)
        if name not in self.__dataclass_fields__:
            raise KeyError(key)
        return getattr(self, name)

    def __contains__(self, key):
        return self.get(key) is not None


class Cell(Message):
    """The motions of a finished cell, as a metric gets them."""

    def track(self, name):
        """Returns the motion of that name: rate_hz and poses of sixty numbers. Raises KeyError with the known names."""
        for track in self.tracks:
            if track.name == name:
                return track
        raise KeyError(f"there is no track '{name}'; allowed: {', '.join(track.name for track in self.tracks)}")

    def motion(self, name):
        """Returns a motion's positions, frames × joints × 3 in metres: an array if numpy is installed, else lists."""
        frames = [[pose[at:at + 3] for at in range(0, len(pose), 3)] for pose in self.track(name).poses]
        try:
            import numpy
        except ImportError:
            return frames
        return numpy.array(frames, dtype=float)


def _unfolded(value):
    if isinstance(value, Message):
        return value.to_json()
    if isinstance(value, list) and value and isinstance(value[0], Message):
        return [_unfolded(each) for each in value]
    return value


def _key(name):
    return name.rstrip("_")


def _name(key):
    return key + "_" if key == "from" else key


def plain(value):
    """Converts messages, and values with a `tolist` such as numpy's, for json.dumps(default=plain)."""
    if isinstance(value, Message):
        return value.to_json()
    if hasattr(value, "tolist"):
        return value.tolist()
    raise TypeError(f"{type(value).__name__} cannot be written as JSON")


def to_json_text(value):
    """Writes a value as JSON. A number that is not finite becomes a text, such as "nan", so that the program refuses this
    answer, names the number, and asks the next problem."""
    try:
        return json.dumps(value, allow_nan=False, default=plain)
    except ValueError:
        return json.dumps(_with_words(value), allow_nan=False)


def _with_words(value):
    if isinstance(value, dict):
        return {key: _with_words(each) for key, each in value.items()}
    if isinstance(value, (list, tuple)):
        return [_with_words(each) for each in value]
    if isinstance(value, float) and not math.isfinite(value):
        return str(float(value))
    return value if value is None or isinstance(value, (str, bool, int, float)) else _with_words(plain(value))
