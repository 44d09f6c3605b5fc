"""Speaks Etude's protocol for methods outside (docs/outside-methods.md), so that a method is two functions:

    run("my-solver", "1.0", prepare, answer)

A program that takes a seat in a loop is spoken to step by step:

    run_seat("my-policy", "1.0", prepare, begin, step)

begin(kept, session, files) is called when a session begins, and gives what the method wants to remember during it;
step(memory, step, files) gives the answer to one step, or raises NoAnswer.

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
    converse(name, version, prepare, {"problem": lambda kept, message: answer(kept, message["problem"],
                                                                             message.get("files"))})


def run_seat(name, version, prepare, begin, step):
    memory = {}

    def begin_session(kept, message):
        memory["session"] = begin(kept, message["begin"], message.get("files"))

    converse(name, version, prepare, {"begin": begin_session,
                                      "step": lambda kept, message: step(memory["session"], message["step"],
                                                                         message.get("files"))})


def converse(name, version, prepare, replies):
    """`replies`: by the type of a message, what it is answered with; None: `ready`."""
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
        elif message["type"] in replies:
            number = {"number": message["number"]} if "number" in message else {}
            try:
                found = replies[message["type"]](kept, message)
                if found is None:
                    say(type="ready")
                else:
                    say(type="answer", id=message["id"], answer=found, **number)
            except NoAnswer as reason:
                say(type="no_answer", id=message["id"], reason=str(reason))
