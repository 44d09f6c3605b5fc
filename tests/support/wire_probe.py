"""Stands between Etude and the method that COMMAND starts: passes every line on, and ends with a complaint at the first
line that the protocol's schema refuses.

    wire_probe.py TASK SEAT COMMAND…      SEAT is - for a method that answers whole problems

Undeclared keys are refused, too, except the one that `etude check-method` sends to test unknown keys.
"""
import json
import subprocess
import sys

from json_schema import load_schema, own_complaints  # jsonschema takes minutes for so many lines

UNKNOWN = "of_a_later_version"


def strict(schema):
    """Returns the schema with undeclared keys forbidden."""
    if isinstance(schema, list):
        return [strict(each) for each in schema]
    if not isinstance(schema, dict):
        return schema
    changed = {key: strict(value) for key, value in schema.items()}
    if isinstance(schema.get("properties"), dict):
        changed["additionalProperties"] = False
    return changed


SCHEMA = strict(load_schema("protocol.schema.json"))


def schema_named(*names):
    """Returns the schema of the first of these definitions that exists."""
    found = next((name for name in names if name in SCHEMA["$defs"]), None)
    if found is None:
        raise KeyError(f"the schema defines none of {', '.join(names)}")
    return {"$ref": f"#/$defs/{found}", "$defs": SCHEMA["$defs"]}


def payload_schema(task, seat, kind):
    stem = task.replace("-", "_")
    return schema_named(*[f"{stem}_{seat}_{kind}"] * bool(seat), f"{stem}_{kind}")


def wrong(message, task, seat, side):
    """Returns the faults of a line on the wire; `side` is from_etude or from_method."""
    kind = message["type"]
    found = own_complaints(message, schema_named(f"{kind}_{side}", kind))
    if kind in message and kind != "type":
        payload = {key: value for key, value in message[kind].items() if key != UNKNOWN}
        found += own_complaints(payload, payload_schema(task, seat, kind))
    return [f"{kind} {side}: {each}"[:500] for each in found]


def main(task, seat, *command):
    seat = seat.strip("-")
    method = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
    for line in sys.stdin:
        method.stdin.write(line)
        method.stdin.flush()
        reply = method.stdout.readline()
        found = wrong(json.loads(line), task, seat, "from_etude") + wrong(json.loads(reply), task, seat, "from_method")
        if found:
            sys.exit(found[0])
        print(reply, end="", flush=True)
    method.stdin.close()
    sys.exit(method.wait())


if __name__ == "__main__":
    main(*sys.argv[1:])
