"""Methods in Python: `@etude.method`, and the protocol by which Etude asks them (docs/outside-methods.md)."""
import inspect
import json
import sys

PROTOCOL = 1
TASKS = {  # task → its seats; "" means that a method answers whole problems
    "ik": [""], "tracking": [""], "transition": [""], "pose-distance": [""], "detection": [""],
    "inbetween": [""],
    "capture": ["", "segmenter"], "coach": ["recogniser", "policy", "learner"],
}


class NoAnswer(Exception):
    """Raised by a method that has no answer to this problem; the message says why."""


class Spec:
    """The arguments of @method."""

    def __init__(self, task, seat, name, version, options, time_s, files, batch):
        self.task, self.seat, self.name, self.version = task, seat, name, version
        self.options, self.time_s, self.files, self.batch = options, time_s, files, batch


def method(task, seat="", *, name=None, version="1", options=None, time_s=None, files=(), batch=False):
    """Makes a method of a function or a class, which stays unchanged and can still be called.

    A function takes a problem and returns its answer. If it has arguments named `setting`, `options` (of the scenario,
    a dict) or `files` (the folder of attachments), it gets these too. With `batch`, the function takes a list of
    problems and returns a list of answers: a run passes one problem at a time, etude.score all problems of a setting.

    A class is constructed for every setting by `__init__(self, …)` with any of `setting`, `options`, `files`, and has
    `answer(self, problem)`. In a `seat` of a loop it has `step(self, seen)` and optionally `begin(self, session)`: what
    the class remembers of one session must not affect another session.

    Settings, problems and steps are dataclasses of etude.problems. An answer is such a dataclass, a dict, or, if it has
    one field only, that field's value: a list of angles, an array. Raise NoAnswer(why) if there is no answer.

    task, seat: as in a scenario. name, version: of the method, as results state them. options, time_s, files: keys of
    the method's entry in a scenario, for etude.run. Raises ValueError for an unknown task or seat.
    """
    if task not in TASKS:
        raise ValueError(f"there is no task {task!r}; allowed: {', '.join(TASKS)}")
    if seat not in TASKS[task]:
        raise ValueError(f"task {task!r} has no seat {seat!r}; allowed: {', '.join(repr(s) for s in TASKS[task])}")
    if batch and seat:
        raise ValueError("batch= is not allowed with seat=, because a seat answers step by step")

    def mark(what):
        if not seat and inspect.isclass(what) and not hasattr(what, "answer"):
            raise ValueError(f"class {what.__name__} needs a method answer(self, problem)")
        if seat and not hasattr(what, "step"):
            raise ValueError(f"{what.__name__} needs a method step(self, seen), because a seat is a class")
        what.__etude__ = Spec(task, seat, name or what.__name__.replace("_", "-").lower(), version,
                              dict(options or {}), time_s, [str(file) for file in files], batch)
        return what

    return mark


class MetricSpec(Spec):
    """The arguments of @metric. facts: the keys of the metric's entry in a scenario, without the keys that describe its
    program."""

    def __init__(self, name, version, options, time_s, files, facts):
        super().__init__("metric", "", name, version, options, time_s, files, False)
        self.facts = facts


def metric(id, unit="", direction="lower", version=1, vectors=(), *, practical=None, aggregate=None, reads=None,
           label=None, definition=None, options=None, time_s=None, files=()):
    """Makes a metric of a function, which stays unchanged and can still be called.

    The function takes a finished cell, an etude.MetricProblem: `cell.motion("truth")` and the like are positions in
    metres, `cell.extras` is what the task records besides motions (docs/reference/recordings.md). If it has arguments
    named `setting` (an etude.MetricSetting: joints, task) or `options`, it gets these too. It returns a number, or
    raises NoAnswer(why) if the cell has no value. The result must depend on the cell alone.

    id: the metric's name in rows and tables, of lower-case letters, digits and '_'. direction: whether "lower",
    "higher" or "neither" is better. version: a number to raise whenever the metric measures something else. vectors:
    cells with known values, checked before a run's first cell: (cell, value), or dicts with the keys cell, expected,
    tolerance, title; the value None means that the cell has no value. A track of such a cell has `poses`, or `frames`
    and `joints_m` by joint name; other joints are at the origin. practical: the smallest difference that matters.
    aggregate, reads, label, definition, options, time_s, files: keys of the metric's entry in a scenario. Raises
    ValueError for an unknown direction.
    """
    if direction not in ("lower", "higher", "neither"):
        raise ValueError(f"there is no direction {direction!r}; allowed: lower, higher, neither")
    told = [each if isinstance(each, dict) else {"cell": each[0], "expected": each[1]} for each in vectors]
    facts = {"unit": unit, "direction": direction, "version": version, "practical": practical, "aggregate": aggregate,
             "reads": reads, "label": label, "definition": definition, "vectors": told or None}

    def mark(what):
        if inspect.isclass(what):
            raise ValueError(f"{what.__name__} is a class; allowed: a function of one cell")
        what.__etude__ = MetricSpec(id, str(version), dict(options or {}), time_s, [str(file) for file in files],
                                    {key: value for key, value in facts.items() if value not in (None, "")})
        return what

    return mark


def spec_of(what):
    """Returns the arguments that @method or @metric stored. Raises TypeError if neither was applied."""
    spec = getattr(what, "__etude__", None)
    if spec is None:
        raise TypeError(f"{getattr(what, '__name__', what)!r} is neither a method nor a metric; write "
                        "@etude.method(task=…) or @etude.metric(…) above the definition")
    return spec


def _class_names(spec):
    """Returns the classes of a method's setting, problem or step, answer, and begin message (or None)."""
    from etude import problems
    task = "".join(word.capitalize() for word in spec.task.split("-"))
    seated = task + spec.seat.capitalize()
    asked = seated + ("Step" if spec.seat else "Problem")
    return (getattr(problems, task + "Setting"), getattr(problems, asked), getattr(problems, seated + "Answer"),
            getattr(problems, seated + "Begin", getattr(problems, task + "Begin", None)))


def _call(function, first, **offered):
    """Calls a function with the arguments `first`, and with those values of `offered` for which the function has
    arguments."""
    parameters = inspect.signature(function).parameters.values()
    takes_all = any(parameter.kind is parameter.VAR_KEYWORD for parameter in parameters)
    names = [parameter.name for parameter in parameters]
    return function(*first, **{name: value for name, value in offered.items() if takes_all or name in names})


class Player:
    """Runs a method on messages: takes settings, problems and steps as dicts, returns answers as dicts."""

    def __init__(self, what):
        self.what, self.spec = what, spec_of(what)
        self._setting_class, self._asked_class, self._answer_class, self._begin_class = _class_names(self.spec)
        self._offered, self._instance = {}, None

    def set(self, setting, options, files=None):
        """Sets the setting for all problems that follow. `files` is the folder of the setting's attachments, or
        None."""
        self._offered = {"setting": self._setting_class.of(setting), "options": dict(options), "files": files}
        if inspect.isclass(self.what):
            self._instance = _call(self.what, (), **self._offered)

    def begin(self, session, files=None):
        if hasattr(self._instance, "begin"):
            _call(self._instance.begin, (self._begin_class.of(session),), files=files)

    def step(self, seen, files=None):
        return self._told(_call(self._instance.step, (self._asked_class.of(seen),), files=files))

    def answer(self, problem, files=None):
        return self.answers([problem], [files])[0]

    def answers(self, problems, files):
        """Returns the answers to several problems; a NoAnswer stands for a problem without an answer. files: the folder
        of each problem's attachments. A method that takes batches may also raise NoAnswer."""
        asked = [self._asked_class.of(problem) for problem in problems]
        if self.spec.batch:
            answers = list(_call(self._function(), (asked,), **{**self._offered, "files": files}))
            if len(answers) != len(asked):
                raise ValueError(f"{self.spec.name} returned {len(answers)} answers to {len(asked)} problems")
            return [self._told(answer) for answer in answers]
        found = []
        for problem, folder in zip(asked, files):
            try:
                found.append(self._told(_call(self._function(), (problem,), **{**self._offered, "files": folder or
                                                                              self._offered.get("files")})))
            except NoAnswer as reason:
                found.append(reason)
        return found

    def _function(self):
        return self.what if self._instance is None else self._instance.answer

    def _told(self, answer):
        """Returns an answer as a JSON object; NoAnswer is returned unchanged."""
        from etude.messages import Message, plain
        if isinstance(answer, NoAnswer):
            return answer
        if isinstance(answer, Message):
            return answer.to_json()
        if isinstance(answer, dict):
            return answer
        needed = [name for name, field in self._answer_class.__dataclass_fields__.items() if _is_needed(field)]
        if answer is None or len(needed) != 1:
            raise TypeError(f"{self.spec.name} returned {type(answer).__name__}; allowed: a dict or an "
                            f"etude.{self._answer_class.__name__}")
        return {needed[0]: plain(answer) if hasattr(answer, "tolist") else answer}


def _is_needed(field):
    import dataclasses
    return field.default is dataclasses.MISSING


def serve(what, lines=None, output=None):
    """Answers for a method until the input ends. A program that Etude starts calls this function in its last line.

    Standard output belongs to the protocol: what methods print goes to standard error, which Etude keeps.
    """
    from etude.messages import to_json_text
    spec, player, options = spec_of(what), Player(what), {}
    lines = sys.stdin if lines is None else lines
    if output is None:
        output, sys.stdout = sys.stdout, sys.stderr

    def say(**message):
        output.write(to_json_text(message) + "\n")
        output.flush()

    for line in lines:
        message = json.loads(line)
        kind, files = message["type"], message.get("files")
        reply = {"id": message["id"], **({"number": message["number"]} if "number" in message else {})} \
            if kind in ("problem", "step") else {}
        # The first line is the handshake; then come settings, sessions, problems and steps.
        if kind == "hello":
            if message["protocol"] != PROTOCOL:
                sys.exit(f"speaks protocol {PROTOCOL}, was asked for {message['protocol']}")
            if message.get("task", spec.task) != spec.task:
                sys.exit(f"is a method of task '{spec.task}', was asked for '{message['task']}'")
            options = message["options"]
            say(type="hello", protocol=PROTOCOL, name=spec.name, version=str(spec.version))
        elif kind == "setting":
            player.set(message["setting"], options, files)
            say(type="ready")
        elif kind == "begin":
            player.begin(message["begin"], files)
            say(type="ready")
        elif kind in ("problem", "step"):
            try:
                answer = player.step(message["step"], files) if kind == "step" else player.answer(message["problem"],
                                                                                                  files)
            except NoAnswer as reason:
                answer = reason
            if isinstance(answer, NoAnswer):
                say(type="no_answer", reason=str(answer), **reply)
            else:
                say(type="answer", answer=answer, **reply)
