"""Checks JSON against a JSON Schema: with the jsonschema package if it is installed, else by the part of the
standard that the schemas of docs/schemas use. `complaints` returns one line for every violation."""
import json
import pathlib
import re

try:
    import jsonschema
except ImportError:
    jsonschema = None

SCHEMAS = pathlib.Path(__file__).resolve().parents[2] / "docs" / "schemas"
TYPES = {
    "object": lambda value: isinstance(value, dict),
    "array": lambda value: isinstance(value, list),
    "string": lambda value: isinstance(value, str),
    "boolean": lambda value: isinstance(value, bool),
    "integer": lambda value: isinstance(value, int) and not isinstance(value, bool),
    "number": lambda value: isinstance(value, (int, float)) and not isinstance(value, bool),
    "null": lambda value: value is None,
}
KNOWN = {"$schema", "$defs", "$ref", "title", "description", "type", "const", "enum", "pattern", "minimum", "minItems", "maxItems",
         "required", "properties", "patternProperties", "additionalProperties", "items", "anyOf"}


def load_schema(name):
    return json.loads((SCHEMAS / name).read_text())


def complaints(value, schema):
    if jsonschema is None:
        return own_complaints(value, schema)
    found = jsonschema.validators.validator_for(schema)(schema).iter_errors(value)
    return [f"{'/'.join(map(str, error.absolute_path))}: {error.message}" for error in found]


def own_complaints(value, schema):
    return list(_walk(value, schema, schema, ""))


def _walk(value, schema, root, path):
    unknown = schema.keys() - KNOWN
    if unknown:
        raise NotImplementedError(f"the schema uses {unknown}")
    if "$ref" in schema:
        target = root
        for step in schema["$ref"].removeprefix("#/").split("/"):
            target = target[step]
        yield from _walk(value, target, root, path)
    if "anyOf" in schema and all(any(True for _ in _walk(value, one, root, path)) for one in schema["anyOf"]):
        yield f"{path}: {value!r} is none of {schema['anyOf']}"
    types = [schema["type"]] if isinstance(schema.get("type"), str) else schema.get("type", [])
    if types and not any(TYPES[name](value) for name in types):
        yield f"{path}: {value!r} is not of type {types}"
        return
    if "const" in schema and value != schema["const"]:
        yield f"{path}: {value!r} is not {schema['const']!r}"
    if "enum" in schema and value not in schema["enum"]:
        yield f"{path}: {value!r} is not one of {schema['enum']}"
    if isinstance(value, str) and not re.search(schema.get("pattern", ""), value):
        yield f"{path}: {value!r} does not match {schema['pattern']!r}"
    if TYPES["number"](value) and value < schema.get("minimum", value):
        yield f"{path}: {value!r} is below {schema['minimum']}"
    if isinstance(value, list):
        if len(value) < schema.get("minItems", 0):
            yield f"{path}: has {len(value)} entries, fewer than {schema['minItems']}"
        if len(value) > schema.get("maxItems", len(value)):
            yield f"{path}: has {len(value)} entries, more than {schema['maxItems']}"
        for index, entry in enumerate(value):
            yield from _walk(entry, schema.get("items", {}), root, f"{path}/{index}")
    if isinstance(value, dict):
        yield from _walk_object(value, schema, root, path)


def _walk_object(value, schema, root, path):
    for key in schema.get("required", []):
        if key not in value:
            yield f"{path}: '{key}' is missing"
    for key, entry in value.items():
        fitting = [schema["properties"][key]] if key in schema.get("properties", {}) else []
        fitting += [sub for pattern, sub in schema.get("patternProperties", {}).items() if re.search(pattern, key)]
        if not fitting and "additionalProperties" in schema:
            if schema["additionalProperties"] is False:
                yield f"{path}: '{key}' is not allowed"
            else:
                fitting = [schema["additionalProperties"]]
        for sub in fitting:
            yield from _walk(entry, sub, root, f"{path}/{key}")
