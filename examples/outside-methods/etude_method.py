"""Speaks Etude's protocol for methods outside (docs/outside-methods.md), so that a method is two functions:

    run("my-solver", "1.0", prepare, answer)

prepare(setting, options, files) is called when a setting is told, and gives what the method wants to keep of it.
`options` are those of the scenario. answer(kept, problem, files) gives the answer, or raises NoAnswer. `files` is a
folder of attachments, or None.

Standard output belongs to the protocol: what methods print goes to standard error, which Etude keeps.
"""
import json
import sys

PROTOCOL = 1


class NoAnswer(Exception):
    """The method has no answer to this problem; the message tells why."""


def run(name, version, prepare, answer):
    output, sys.stdout = sys.stdout, sys.stderr

    def say(**message):
        output.write(json.dumps(message, allow_nan=False) + "\n")
        output.flush()

    kept, options = None, {}
    for line in sys.stdin:
        message = json.loads(line)
        if message["type"] == "hello":
            if message["protocol"] != PROTOCOL:
                sys.exit(f"speaks protocol {PROTOCOL}, was asked for {message['protocol']}")
            options = message["options"]
            say(type="hello", protocol=PROTOCOL, name=name, version=version)
        elif message["type"] == "setting":
            kept = prepare(message["setting"], options, message.get("files"))
            say(type="ready")
        elif message["type"] == "problem":
            try:
                found = answer(kept, message["problem"], message.get("files"))
                say(type="answer", id=message["id"], answer=found)
            except NoAnswer as reason:
                say(type="no_answer", id=message["id"], reason=str(reason))
