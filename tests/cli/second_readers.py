"""Readers of motion files that share no code with the program.

Each returns {joint: positions (frames × 3)} in the file's own unit and axes; if several joints have the same name, the
first one counts.
"""
import json
import math
import pathlib
import re
import struct

import numpy


def about(axis, angles):
    """Returns rotations about a unit axis by angles in radians, n × 3 × 3."""
    x, y, z = axis
    k = numpy.array([[0, -z, y], [z, 0, -x], [-y, x, 0]], float)
    s, c = numpy.sin(angles)[:, None, None], numpy.cos(angles)[:, None, None]
    return numpy.eye(3) + s * k + (1 - c) * (k @ k)


def of_quaternions(q):
    """Returns rotations of quaternions x, y, z, w (n × 4)."""
    x, y, z, w = (q / numpy.linalg.norm(q, axis=1, keepdims=True)).T
    return numpy.stack([numpy.stack(row, -1) for row in (
        (1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)),
        (2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)),
        (2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)))], 1)


def read_bvh(path, adds=False):
    """Reads a BVH. Position channels are added to OFFSET if `adds` (three.js, PyMO), else they replace it (Blender)."""
    tokens = path.read_text(errors="replace").split()
    joints, stack, i = [], [], 1  # a joint: name, parent, offset, channels
    while tokens[i] != "MOTION":
        word = tokens[i]
        if word in ("ROOT", "JOINT", "End"):
            end = i + 1
            while tokens[end] != "{":
                end += 1
            name = joints[stack[-1]][0] + "_End" if word == "End" else " ".join(tokens[i + 1:end])
            joints.append([name, stack[-1] if stack else None, None, []])
            stack.append(len(joints) - 1)
            i = end
        elif word == "}":
            stack.pop()
        elif word == "OFFSET":
            joints[stack[-1]][2] = numpy.array(tokens[i + 1:i + 4], float)
            i += 3
        elif word == "CHANNELS":
            count = int(tokens[i + 1])
            joints[stack[-1]][3] = tokens[i + 2:i + 2 + count]
            i += 1 + count
        i += 1
    at = tokens.index("Time:", i)  # part of "Frame Time:"
    width = sum(len(joint[3]) for joint in joints)
    values = numpy.array(tokens[at + 2:], float)
    values = values[:len(values) // width * width].reshape(-1, width)
    places, turns, column = [], [], 0
    for name, parent, offset, channels in joints:
        own, place = numpy.broadcast_to(numpy.eye(3), (len(values), 3, 3)), numpy.tile(offset, (len(values), 1))
        moved = False
        for channel in channels:
            axis, numbers = "XYZ".index(channel[0].upper()), values[:, column]
            if channel[1:].lower() == "position":
                place = place if moved or adds else numpy.zeros_like(place)
                moved = True
                place[:, axis] += numbers
            else:
                own = own @ about(numpy.eye(3)[axis], numpy.radians(numbers))
            column += 1
        if parent is not None:
            place = places[parent] + (turns[parent] @ place[:, :, None])[:, :, 0]
            own = turns[parent] @ own
        places.append(place)
        turns.append(own)
    return {joint[0]: place for joint, place in reversed(list(zip(joints, places)))}


def accessor(document, binary, index):
    told = document["accessors"][index]
    view = document["bufferViews"][told["bufferView"]]
    width = {"SCALAR": 1, "VEC3": 3, "VEC4": 4, "MAT4": 16}[told["type"]]
    kind = {5126: "<f4", 5120: "i1", 5121: "u1", 5122: "<i2", 5123: "<u2", 5125: "<u4"}[told["componentType"]]
    start = view.get("byteOffset", 0) + told.get("byteOffset", 0)
    numbers = numpy.frombuffer(binary, kind, told["count"] * width, start).astype(float).reshape(-1, width)
    return numbers / {"i1": 127, "u1": 255, "<i2": 32767, "<u2": 65535}[kind] if told.get("normalized") else numbers


def slerp(a, b, part):
    cosine = (a * b).sum(1, keepdims=True)
    b, cosine = numpy.where(cosine < 0, -b, b), numpy.abs(cosine).clip(0, 1)
    angle, part = numpy.arccos(cosine), part[:, None]
    sine = numpy.sin(angle)
    near = sine < 1e-9
    safe = numpy.where(near, 1, sine)
    return numpy.where(near, a + part * (b - a), (numpy.sin((1 - part) * angle) * a + numpy.sin(part * angle) * b) / safe)


def sample(times, keys, at, is_turn, way):
    after = numpy.searchsorted(times, at, side="right").clip(1, max(len(times) - 1, 1))
    before, after = after - 1, numpy.minimum(after, len(times) - 1)
    span = times[after] - times[before]
    part = ((at - times[before]) / numpy.where(span > 0, span, 1)).clip(0, 1)
    if way == "STEP":
        return keys[numpy.where(part >= 1, after, before)]
    if way == "CUBICSPLINE":
        keys = keys.reshape(len(times), 3, -1)
        t, d = part[:, None], span[:, None]
        mixed = ((2 * t**3 - 3 * t**2 + 1) * keys[before, 1] + d * (t**3 - 2 * t**2 + t) * keys[before, 2]
                 + (3 * t**2 - 2 * t**3) * keys[after, 1] + d * (t**3 - t**2) * keys[after, 0])
        return mixed
    return slerp(keys[before], keys[after], part) if is_turn else keys[before] + part[:, None] * (keys[after] - keys[before])


def read_gltf(path, animation, rate, frames):
    data = path.read_bytes()
    length = struct.unpack("<I", data[12:16])[0]
    document, binary = json.loads(data[20:20 + length]), data[28 + length:]
    nodes = document["nodes"]
    moves = next((each for each in document["animations"] if each.get("name") == animation), document["animations"][0])
    samplers = moves["samplers"]
    first = min(accessor(document, binary, s["input"]).min() for s in samplers)
    at = first + numpy.arange(frames) / rate
    own = {}
    for channel in moves["channels"]:
        path_ = channel["target"]["path"]
        if path_ == "weights" or "node" not in channel["target"]:
            continue
        told = samplers[channel["sampler"]]
        times, keys = accessor(document, binary, told["input"])[:, 0], accessor(document, binary, told["output"])
        own[channel["target"]["node"], path_] = sample(times, keys, at, path_ == "rotation", told.get("interpolation", "LINEAR"))
    places, linear = {}, {}

    def visit(index, place, axes):
        node = nodes[index]
        still = lambda key, rest: numpy.tile(numpy.array(node.get(key, rest), float), (frames, 1))
        value = lambda key, rest: own.get((index, key), still(key, rest))
        if "matrix" in node:
            matrix = numpy.array(node["matrix"]).reshape(4, 4).T
            local, here = numpy.tile(matrix[:3, :3], (frames, 1, 1)), numpy.tile(matrix[:3, 3], (frames, 1))
        else:
            local = of_quaternions(value("rotation", (0, 0, 0, 1))) * value("scale", (1, 1, 1))[:, None, :]
            here = value("translation", (0, 0, 0))
        place, axes = place + (axes @ here[:, :, None])[:, :, 0], axes @ local
        places.setdefault(node.get("name", f"node{index}"), place)
        for child in node.get("children", ()):
            visit(child, place, axes)

    children = {child for node in nodes for child in node.get("children", ())}
    for index in range(len(nodes)):
        if index not in children:
            visit(index, numpy.zeros((frames, 3)), numpy.tile(numpy.eye(3), (frames, 1, 1)))
    return places


def read_acclaim(path):
    """Reads an AMC with the ASF beside it. A bone's joint is at the bone's start; limb ends are called "…_end"."""
    skeleton = next(path.parent.glob("*.asf")).read_text()
    bones = {}
    for text in re.findall(r"begin(.*?)end", skeleton.split(":bonedata")[1].split(":hierarchy")[0], re.S):
        field = lambda key: re.search(rf"\b{key}\s+([^\n]*)", text)
        axis = [float(v) for v in field("axis")[1].split()[:3]]
        dof = field("dof")
        bones[field("name")[1].strip()] = (numpy.array(field("direction")[1].split(), float), float(field("length")[1]), axis,
                                           dof[1].split() if dof else [])
    links = [line.split() for line in skeleton.split(":hierarchy")[1].split("begin")[1].split("end")[0].strip().splitlines()]
    frames, now = [], None
    for line in path.read_text().splitlines():
        words = line.split()
        if len(words) == 1 and words[0].isdigit():
            now = {}
            frames.append(now)
        elif now is not None and len(words) > 1:
            now[words[0]] = numpy.array(words[1:], float)
    xyz = lambda angles: (about((0, 0, 1), numpy.array([math.radians(angles[2])])) @ about((0, 1, 0), numpy.array([math.radians(
        angles[1])])) @ about((1, 0, 0), numpy.array([math.radians(angles[0])])))[0]
    places = {}
    axes = {name: xyz(bone[2]) for name, bone in bones.items()}
    for t, frame in enumerate(frames):
        turns, ends = {"root": xyz(frame["root"][3:])}, {"root": frame["root"][:3]}
        for parent, *below in links:
            for name in below:
                direction, length, _, dof = bones[name]
                angles = dict(zip(dof, frame.get(name, ())))
                local = axes[name] @ xyz([angles.get(k, 0) for k in ("rx", "ry", "rz")]) @ axes[name].T
                turns[name] = turns[parent] @ local
                ends[name] = ends[parent] + turns[name] @ direction * length
        for name, end in ends.items():
            places.setdefault(name, numpy.zeros((len(frames), 3)))[t] = end
    begins = {}
    for parent, *below in links:
        for name in below:
            begins[name] = places[parent]
            begins[name + "_end"] = places[name]
    return {"root": places["root"], **begins}


def read_deepmimic(path):
    """Reads a motion of DeepMimic with the character file beside it."""
    character = json.loads((path.parent / "humanoid3d_character.txt").read_text())["Skeleton"]["Joints"]
    document = json.loads(path.read_text())
    rows = numpy.array([row[1:] for row in document["Frames"]], float)
    wxyz = lambda q: of_quaternions(numpy.roll(q, -1, axis=1))
    places, turns, column = [], [], 7
    for joint in character:
        attach = numpy.array([joint[f"Attach{axis}"] for axis in "XYZ"], float)
        if joint["Parent"] < 0:
            places.append(rows[:, :3])
            turns.append(wxyz(rows[:, 3:7]))
            continue
        kind, parent = joint["Type"], joint["Parent"]
        width = {"spherical": 4, "revolute": 1}.get(kind, 0)
        numbers = rows[:, column:column + width]
        column += width
        local = wxyz(numbers) if width == 4 else about((0, 0, 1), numbers[:, 0]) if width else numpy.tile(numpy.eye(3), (len(rows), 1, 1))
        places.append(places[parent] + turns[parent] @ attach)
        turns.append(turns[parent] @ local)
    return {joint["Name"]: place for joint, place in zip(character, places)}


def read_trc(path):
    """Reads markers, metres; gaps are NaN."""
    lines = path.read_text().splitlines()
    told = dict(zip(lines[1].split("\t"), lines[2].split("\t")))
    names = [name for name in lines[3].split("\t")[2:] if name]
    rows = [line.split("\t")[2:] for line in lines[5:] if line.strip()]
    assert (len(rows), len(names)) == (int(told["NumFrames"]), int(told["NumMarkers"])), path
    numbers = numpy.array([[float(v) if v.strip() else math.nan for v in row[:3 * len(names)]] for row in rows])
    metres = {"mm": 0.001, "cm": 0.01, "m": 1}[told["Units"]]
    return {name: metres * numbers[:, 3 * i:3 * i + 3] for i, name in reversed(list(enumerate(names)))}


def read_c3d(path):
    """Reads the markers of a little-endian file, metres; invalid ones are NaN."""
    data = path.read_bytes()
    at, group_names, told = 512 * (data[0] - 1) + 4, {}, {}
    while data[at]:
        length, number = abs(struct.unpack("b", data[at:at + 1])[0]), struct.unpack("b", data[at + 1:at + 2])[0]
        name, body = data[at + 2:at + 2 + length].decode(), at + 2 + length
        step = struct.unpack("<H", data[body:body + 2])[0]
        if number < 0:
            group_names[-number] = name
        else:
            kind, sizes = struct.unpack("b", data[body + 2:body + 3])[0], list(data[body + 4:body + 4 + data[body + 3]])
            count = math.prod(sizes)
            start = body + 4 + len(sizes)
            values = data[start:start + count * abs(kind)]
            if kind == -1:
                width = sizes[0] if sizes else 1
                values = [values[i:i + width].decode().strip() for i in range(0, len(values), width)]
            else:
                values = numpy.frombuffer(values, {1: "u1", 2: "<i2", 4: "<f4"}[kind])
            told[number, name] = values
        if not step:
            break
        at = body + step
    told = {(group_names[number], name): values for (number, name), values in told.items()}
    of = lambda name: told["POINT", name]
    points, frames, scale = int(of("USED")[0]), int(struct.unpack("<H", data[8:10])[0]), float(of("SCALE")[0])
    analog = struct.unpack("<H", data[4:6])[0]
    width = 4 * points + analog
    numbers = numpy.frombuffer(data, "<f4" if scale < 0 else "<i2", frames * width, 512 * (int(of("DATA_START")[0]) - 1))
    rows = numbers.reshape(frames, width)[:, :4 * points].reshape(frames, points, 4).astype(float)
    places = rows[:, :, :3] * (1 if scale < 0 else scale) * {"mm": 0.001, "cm": 0.01, "m": 1}[of("UNITS")[0]]
    places[rows[:, :, 3] < 0] = math.nan
    return {name: places[:, i] for i, name in reversed(list(enumerate(of("LABELS"))))}
