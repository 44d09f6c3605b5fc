"""Writes the page docs/reference/protocol.md from docs/schemas/protocol.schema.json.

    protocol_page.py > docs/reference/protocol.md
"""
import json
import pathlib
import sys

ROOT = pathlib.Path(__file__).parents[2]
HEAD = """# The protocol, field by field

Written by `scripts/docs` from [protocol.schema.json](../schemas/protocol.schema.json); a test compares the two.
[Methods outside](../outside-methods.md) describes the conversation, and how answers are judged. The objects in
`setting`, `problem` and `answer` are named after the task. Fields in *italics* may be absent.
"""
PLAIN = {"string": "text", "number": "number", "integer": "whole number", "boolean": "true or false", "object": "object", "null": "null"}


def kind(schema):
    """Returns a value's kind in words."""
    if "$ref" in schema:
        name = schema["$ref"].rsplit("/", 1)[1]
        return f"[{name}](#{name})"
    if "const" in schema:
        return f"`{json.dumps(schema['const'])}`"
    if "enum" in schema:
        return " or ".join(f"`{json.dumps(value)}`" for value in schema["enum"])
    if "anyOf" in schema:
        return " or ".join(kind(one) for one in schema["anyOf"])
    kinds = schema["type"] if isinstance(schema["type"], list) else [schema["type"]]
    return " or ".join(list_of(schema) if one == "array" else bounded(PLAIN[one], schema) if one != "null" else "null" for one in kinds)


def bounded(word, schema):
    return f"{word} ≥ {schema['minimum']}" if "minimum" in schema else word


def list_of(schema):
    count = f"{schema['minItems']} × " if "minItems" in schema else "list of "
    return count + kind(schema["items"])


def section(name, schema):
    text = f"\n## {name}\n{schema['description']}\n"
    if "properties" not in schema:
        return text + f"\nIt is: {kind(schema)}.\n"
    text += "\n| field | is | what |\n|---|---|---|\n"
    for key, value in schema["properties"].items():
        field = f"`{key}`" if key in schema["required"] else f"*`{key}`*"
        text += f"| {field} | {kind(value)} | {value['description']} |\n"
    return text


def page(schema):
    return HEAD + "".join(section(name, one) for name, one in schema["$defs"].items() if "description" in one)


def read_schema():
    return json.loads((ROOT / "docs/schemas/protocol.schema.json").read_text())


if __name__ == "__main__":
    sys.stdout.write(page(read_schema()))
