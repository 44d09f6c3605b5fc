#!/usr/bin/env python3
"""Writes etude/problems.py: the dataclasses of docs/schemas/protocol.schema.json. tests/python compares the two."""
import json
import pathlib
import textwrap

ROOT = pathlib.Path(__file__).resolve().parent.parent
PLAIN = {"number": "float", "integer": "int", "string": "str", "boolean": "bool", "object": "dict", "null": "None"}
WIDTH = 120
BASES = {"metric_problem": "Cell"}
HEAD = '''"""Problems and answers of every task. Written by python/make_problems.py from docs/schemas/protocol.schema.json."""
from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, List, Optional

from etude.messages import Cell, Message

Pose = List[float]
Vector = List[float]
Rotation = List[List[float]]
'''


def class_name(name):
    return "".join(word.capitalize() for word in name.split("_"))


def is_class(name, definitions):
    return "properties" in definitions[name]


def hint(schema):
    """Returns the Python type of the values that a schema allows."""
    if "$ref" in schema:
        return class_name(schema["$ref"].rsplit("/", 1)[1])
    if "anyOf" in schema:
        return f"Optional[{hint(schema['anyOf'][0])}]"
    if "enum" in schema:
        return "str"
    kinds = schema["type"] if isinstance(schema["type"], list) else [schema["type"]]
    kind = f"List[{hint(schema['items'])}]" if kinds[0] == "array" else PLAIN[kinds[0]]
    return f"Optional[{kind}]" if "null" in kinds else kind


def held(schema, definitions):
    """Returns the class of the values that a schema allows, or [class] if they are lists of a class; None for plain
    values."""
    of = schema.get("items", schema)
    name = of.get("$ref", "").rsplit("/", 1)[-1]
    if name not in definitions or not is_class(name, definitions):
        return None
    return f"[{class_name(name)}]" if "items" in schema else class_name(name)


def write_class(name, schema, definitions):
    known = schema["properties"]
    required = schema.get("required", [])
    lines = ["", "", "@dataclass", f"class {class_name(name)}({BASES.get(name, 'Message')}):"]
    told = [f"{key}: {value['description']}" for key, value in known.items() if "description" in value]
    doc = schema["description"]
    if told:
        lines.append(f'    """{doc}')
        lines.append("")
        for each in told:
            lines += textwrap.wrap(each, WIDTH - 4, initial_indent="    ", subsequent_indent="        ")
        lines.append('    """')
    else:
        lines.append(f'    """{doc}"""')
    inside = {key: held(value, definitions) for key, value in known.items() if held(value, definitions)}
    if inside:
        lines.append("    HOLDS: ClassVar[dict] = {" + ", ".join(f'"{k}": {v}' for k, v in inside.items()) + "}")
    for key, value in sorted(known.items(), key=lambda item: item[0] not in required):
        field = key + "_" if key == "from" else key
        kind = hint(value)
        if key not in required:
            kind = kind if kind.startswith("Optional") else f"Optional[{kind}]"
        lines.append(f"    {field}: {kind}" + ("" if key in required else " = None"))
    return lines


def write_all():
    definitions = json.loads((ROOT / "docs/schemas/protocol.schema.json").read_text())["$defs"]
    first = list(definitions).index("vector")
    lines = []
    for name in list(definitions)[first:]:
        if is_class(name, definitions):
            lines += write_class(name, definitions[name], definitions)
    return HEAD + "\n".join(lines) + "\n"


if __name__ == "__main__":
    (ROOT / "python/etude/problems.py").write_text(write_all())
