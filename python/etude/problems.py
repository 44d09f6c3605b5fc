"""Problems and answers of every task: the dataclasses of protocol.schema.json, the file beside this one."""
import dataclasses
import json
import pathlib
import textwrap
from typing import List, Optional

from etude.messages import Cell, Message

_PLAIN = {"number": float, "integer": int, "string": str, "boolean": bool, "object": dict}
_DEFINITIONS = json.loads((pathlib.Path(__file__).parent / "protocol.schema.json").read_text(encoding="utf-8"))["$defs"]


def _class_name(name):
    return "".join(word.capitalize() for word in name.split("_"))


def _definition_of(schema):
    """Returns the name of the definition that a value refers to, or ""."""
    return schema.get("$ref", "").rsplit("/", 1)[-1]


def _hint(schema):
    """Returns the Python type of a value."""
    if "$ref" in schema:
        return globals()[_class_name(_definition_of(schema))]
    if "anyOf" in schema:
        return Optional[_hint(schema["anyOf"][0])]
    if "enum" in schema:
        return str
    kinds = schema["type"] if isinstance(schema["type"], list) else [schema["type"]]
    kind = List[_hint(schema["items"])] if kinds[0] == "array" else _PLAIN[kinds[0]]
    return Optional[kind] if "null" in kinds else kind


def _held(schema):
    """Returns the class of a value, or [class] of a list's values; None if it is plain."""
    name = _definition_of(schema.get("items", schema))
    if "properties" not in _DEFINITIONS.get(name, {}):
        return None
    return [globals()[_class_name(name)]] if "items" in schema else globals()[_class_name(name)]


def _make_class(name, schema):
    known, required = schema["properties"], schema.get("required", [])
    told = [line for key, value in known.items() if "description" in value
            for line in textwrap.wrap(f"{key}: {value['description']}", 112, subsequent_indent="    ")]
    fields = []
    for key, value in sorted(known.items(), key=lambda item: item[0] not in required):
        field = key + "_" if key == "from" else key
        fields.append((field, _hint(value)) if key in required else
                      (field, Optional[_hint(value)], dataclasses.field(default=None)))
    inside = {"__doc__": "\n".join([schema["description"], "", *told] if told else [schema["description"]]),
              "__module__": __name__, "HOLDS": {key: _held(value) for key, value in known.items() if _held(value)}}
    base = Cell if name == "metric_problem" else Message
    return dataclasses.make_dataclass(_class_name(name), fields, bases=(base,), namespace=inside)


# Definitions refer only to earlier ones. The first are the messages that carry problems and answers.
for _name in list(_DEFINITIONS)[list(_DEFINITIONS).index("vector"):]:
    _schema = _DEFINITIONS[_name]
    globals()[_class_name(_name)] = _make_class(_name, _schema) if "properties" in _schema else _hint(_schema)
