"""A method as a program of its own: a folder from which Etude can start it, now and when the run is repeated.

A method of a module is imported from its file. A method of a notebook, of `__main__` or within a function is sent as
source code, with the present values of all that it uses: functions, classes, modules, numbers, texts, lists and dicts
of numbers and texts, and numpy arrays. Anything else is refused by name.
"""
import ast
import builtins
import hashlib
import inspect
import json
import linecache
import os
import pathlib
import pprint
import symtable
import sys
import textwrap
import types

from etude.conversation import spec_of
from etude.messages import plain
from etude.program import cache_folder

PLAIN = (type(None), bool, int, float, complex, str, bytes)
SYSTEM = ("/usr/", "/bin/", "/lib", "/opt/", "/nix/")  # folders that every program can read
MAX_LITERAL_LENGTH = 1_000_000  # characters of a value that is written as source


def ship(method):
    """Returns the entry (a dict) in a scenario's `methods` or `metrics` for a method or metric made by @method or
    @metric. The entry's folder, below etude.program.cache_folder(), is named by its contents, so the same method gives
    the same entry.

    Raises ValueError that names what cannot be sent and why.
    """
    spec = spec_of(method)
    module = sys.modules.get(method.__module__)
    granted = list(spec.files)
    # Write the source of the program: it imports the method, or contains the method and all that it uses.
    if _is_importable(method, module):
        top = _folder_of(module)
        granted.append(top)
        source = (f"import sys\nsys.path.insert(0, {top!r})\n"
                  f"from {module.__name__} import {method.__qualname__} as asked\n")
        called, arrays = "asked", {}
    else:
        pieces = _Pieces()
        pieces.add(method, f"{'metric' if spec.task == 'metric' else 'method'} '{spec.name}'")
        source, called, arrays = pieces.text(), method.__name__, pieces.arrays
        granted += pieces.folders
    # Write the program's folder, and make the entry of the scenario.
    source = f'"""Written by etude.run."""\n{source}\nimport etude\netude.serve({called})\n'
    folder = _write(source, arrays, "metrics" if spec.task == "metric" else "methods")
    entry = {"name": spec.name, "exec": [_interpreter(granted), str(folder / "program.py")],
             "files": [str(folder), *granted]}
    entry.update(json.loads(json.dumps(getattr(spec, "facts", {}), default=plain)))
    if spec.seat:
        entry["seat"] = spec.seat
    if spec.options:
        entry["options"] = spec.options
    if spec.time_s is not None:
        entry["time_s"] = spec.time_s
    return entry


def _is_importable(method, module):
    return (module is not None and method.__module__ != "__main__" and getattr(module, "__file__", None)
            and "<locals>" not in method.__qualname__)


def _folder_of(module):
    """Returns the folder that a module is imported from."""
    path = pathlib.Path(module.__file__).resolve()
    return str(path.parents[module.__name__.count(".") + (path.name == "__init__.py")])


def _interpreter(granted):
    """Returns the path of the running Python interpreter. Adds the folder of its installation (`sys.prefix`) to
    `granted`, unless the sandbox shows this folder to all programs."""
    for prefix in dict.fromkeys([sys.prefix, sys.base_prefix]):
        if not f"{prefix}/".startswith(SYSTEM):
            granted.append(prefix)
    return sys.executable


def _write(source, arrays, room):
    """Writes a program's folder (its source, arrays and the modules that it imports) into the part `room` of the cache,
    and returns the folder."""
    here = pathlib.Path(__file__).resolve().parent
    files = {"program.py": source.encode(), **{f"{name}.npy": data for name, data in arrays.items()}}
    for name in ("__init__.py", "conversation.py", "engine.py", "messages.py", "problems.py"):
        files[f"etude/{name}"] = (here / name).read_bytes()
    digest = hashlib.sha256()
    for name, data in sorted(files.items()):
        digest.update(f"{name} {len(data)}\n".encode() + data)
    folder = cache_folder() / room / digest.hexdigest()[:16]
    for name, data in files.items():
        write_once(folder / name, data)
    return folder


def write_once(path, data):
    """Writes a file, whole or not at all, unless the file has these contents already."""
    if path.exists() and path.read_bytes() == data:
        return
    path.parent.mkdir(parents=True, exist_ok=True)
    partial = path.with_name(f".{path.name}.{os.getpid()}")
    partial.write_bytes(data)
    partial.replace(path)


class _Pieces:
    """The parts of a method in the order in which they must be written."""

    def __init__(self):
        self.arrays, self.folders, self._seen, self._lines, self._imports = {}, [], {}, [], []

    def add(self, thing, whose):
        """Adds a function or class of a notebook, after adding all that it uses."""
        name = thing.__name__
        if name == "<lambda>":
            raise ValueError(f"{whose} is a lambda, whose source cannot be found; write a function with def")
        try:
            source = _source_of(thing)
        except (OSError, TypeError, SyntaxError):
            raise ValueError(f"{whose} cannot be sent to etude, because the source of '{name}' is unknown; write "
                             f"'{name}' into a file") from None
        self._seen[name] = thing
        for used in _names_used(source, whose):
            if used != name:
                self._add_used(used, *_find(thing, used, whose), whose)
        self._lines.append(source)

    def _add_used(self, name, is_there, value, whose):
        if not is_there:
            if hasattr(builtins, name):
                return
            raise ValueError(f"{whose} uses '{name}', which is not defined")
        if name in self._seen:
            if self._seen[name] is not value:
                raise ValueError(f"{whose} uses '{name}', which has two different meanings there; rename one of them")
            return
        # Modules are imported; functions and classes of a notebook are sent as source, values as arrays or literals.
        if isinstance(value, types.ModuleType):
            self._seen[name] = value
            if value.__name__.partition(".")[0] == "etude" and "etude_engine" in sys.modules:
                self._show(sys.modules["etude_engine"])
            if value.__name__ == name == "etude":
                return
            self._import(value, f"import {value.__name__} as {name}")
        elif isinstance(value, (types.FunctionType, type)) and _is_ours(value):
            self.add(value, whose)
            if value.__name__ != name:
                self._lines.append(f"{name} = {value.__name__}\n")
                self._seen[name] = value
        elif called := _name_in_module(value):
            self._seen[name] = value
            self._import(sys.modules[value.__module__], f"from {value.__module__} import {called} as {name}")
        elif type(value).__module__ == "numpy" and type(value).__name__ == "ndarray" and value.dtype != object:
            self._add_array(name, value)
        elif _is_plain(value):
            text = pprint.pformat(value, width=120, compact=True, sort_dicts=False)
            if len(text) > MAX_LITERAL_LENGTH:
                raise ValueError(f"{whose} uses '{name}', a {type(value).__name__} which is too large to be sent to "
                                 "etude; read it from a file, and list the file in `files`")
            self._seen[name] = value
            self._lines.append(f"{name} = {text}\n")
        else:
            raise ValueError(f"{whose} uses '{name}', of type {type(value).__name__}, which cannot be sent to "
                             "etude; create it in the method or in __init__ of a class, or read it from a file that is "
                             "listed in `files`")

    def _import(self, module, line):
        """Adds an import line, and the module's folder if the module does not come with Python."""
        if getattr(module, "__file__", None) and module.__name__.partition(".")[0] != "etude":
            self._show(module)
        self._imports.append(line)

    def _show(self, module):
        folder = _folder_of(module)
        if not f"{folder}/".startswith((*SYSTEM, sys.prefix, sys.base_prefix)) and folder not in self.folders:
            self.folders.append(folder)

    def _add_array(self, name, value):
        import io
        import numpy
        data = io.BytesIO()
        numpy.save(data, value)
        self.arrays[name] = data.getvalue()
        self._seen[name] = value
        self._lines.append(f"import numpy as _numpy, os as _os\n"
                           f"{name} = _numpy.load(_os.path.join(_os.path.dirname(__file__), {name + '.npy'!r}))\n")

    def text(self):
        paths = [f"import sys\nsys.path[:0] = {self.folders!r}"] if self.folders else []
        return "\n".join([*paths, "import etude", *self._imports, *self._lines])


def _names_used(source, whose):
    """Returns the names that a piece of source uses but does not define, also in decorators and defaults."""
    found = {}

    def look(table):
        for symbol in table.get_symbols():
            if table.get_type() == "module":
                if symbol.is_referenced() and not symbol.is_assigned():
                    found[symbol.get_name()] = None
            elif symbol.is_global() and symbol.is_referenced():
                found[symbol.get_name()] = None
            elif symbol.is_declared_global() and symbol.is_assigned():
                raise ValueError(f"{whose} sets the global variable '{symbol.get_name()}', whose value would be lost; "
                                 "keep the value in an attribute of a class")
        for child in table.get_children():
            look(child)

    try:
        look(symtable.symtable(source, "method", "exec"))
    except SyntaxError as error:  # `nonlocal` names a variable outside the source
        raise ValueError(f"{whose} cannot be sent to etude as source: {error}. A variable of the enclosing function is "
                         "changed; keep the variable in an attribute of a class") from None
    found.pop("__class__", None)
    return list(found)


def _functions_of(thing):
    if isinstance(thing, types.FunctionType):
        return [thing]
    found = [getattr(each, "__func__", each) for each in vars(thing).values()]
    return [each for each in found if isinstance(each, types.FunctionType) and each.__module__ == thing.__module__]


def _source_of(thing):
    """Returns the source of a function or class. A notebook's class has no file, so its functions are used to find the
    source."""
    if isinstance(thing, types.FunctionType) or not _functions_of(thing):
        return textwrap.dedent(inspect.getsource(thing))
    code = _functions_of(thing)[0].__code__
    lines = linecache.getlines(code.co_filename, _functions_of(thing)[0].__globals__)
    for node in ast.walk(ast.parse("".join(lines))):
        if isinstance(node, ast.ClassDef) and node.name == thing.__name__ and \
                node.lineno <= code.co_firstlineno <= node.end_lineno:
            first = min([node.lineno, *(each.lineno for each in node.decorator_list)])
            return textwrap.dedent("".join(lines[first - 1:node.end_lineno]))
    raise OSError("not found")


def _find(thing, name, whose):
    """Returns (True, value) for a name that a function or class uses; (False, None) if the name is not defined."""
    for function in _functions_of(thing):
        if name not in function.__code__.co_freevars:
            continue
        try:
            value = function.__closure__[function.__code__.co_freevars.index(name)].cell_contents
        except ValueError:
            return False, None
        if isinstance(value, (list, dict, set, bytearray)):
            raise ValueError(f"{whose} uses '{name}', a {type(value).__name__} of the enclosing function, which cannot "
                             "be sent to etude, because changes would be lost. Use a tuple, or an attribute of a class")
        return True, value
    around = vars(sys.modules[thing.__module__]) if thing.__module__ in sys.modules else {}
    for function in _functions_of(thing):
        around = function.__globals__
    return (True, around[name]) if name in around else (False, None)


def _name_in_module(value):
    """Returns the name under which a value is found in its module, else None. Compiled functions have only a
    `__name__`."""
    for told in ("__qualname__", "__name__"):
        name = getattr(value, told, None)
        if isinstance(name, str) and name.isidentifier() and \
                getattr(sys.modules.get(getattr(value, "__module__", None)), name, None) is value:
            return name
    return None


def _is_ours(value):
    """Returns True if a function or class is defined in a notebook or within a function."""
    return value.__module__ == "__main__" or "<locals>" in value.__qualname__


def _is_plain(value):
    if isinstance(value, (list, tuple, set, frozenset)) and type(value) in (list, tuple, set, frozenset):
        return all(_is_plain(each) for each in value)
    if type(value) is dict:
        return all(_is_plain(key) and _is_plain(each) for key, each in value.items())
    return type(value) in PLAIN and (not isinstance(value, float) or value == value and abs(value) != float("inf"))
