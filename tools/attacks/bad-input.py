#!/usr/bin/env python3
"""Bad input, generated: every key of the schema with values that are wrong or extreme, every number
on the command line that is none, and meshes that are no structures. Each has to end by itself: done,
refused in one line a fault that names the key or the file (exit 2), or as a mission that failed for
a stated reason (exit 1). Internal errors, signals, silence and more than the time given are failures.

usage: bad-input.py [--gnbv FILE] [--part keys,options,meshes] [--every N] [--jobs N] [--timeout S]
  --every N    only each N-th try: the short version
exit: 0 nothing found, 1 failures (named on stderr), 2 bad usage
"""
import argparse
import concurrent.futures
import json
import math
import os
import resource
import shutil
import struct
import subprocess
import sys
import tempfile

from run_attack import REPOSITORY, is_sanitized

MEMORY_BYTES = 12 << 30  # the map's budget is 6 GiB
ONE_VIEW = ["--quiet", "--set", "planner.termination.max_iterations=1"]
BAD_WORDS = ("internal error", "the program is wrong", "broken invariant", "terminate called",
             "out of memory", "Sanitizer", "[json.exception", "std::")


def run(command, timeout_s):
    """(exit code, what it said); the code is None when it took too long."""
    is_limited = not is_sanitized(command[0])

    def limit():
        if is_limited:
            resource.setrlimit(resource.RLIMIT_AS, (MEMORY_BYTES, MEMORY_BYTES))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    try:
        done = subprocess.run(command, capture_output=True, timeout=timeout_s, preexec_fn=limit,
                              stdin=subprocess.DEVNULL, env={**os.environ, "GNBV_CACHE": ""})
    except subprocess.TimeoutExpired:
        return None, ""
    said = (done.stdout + done.stderr).decode("utf-8", "replace")
    return done.returncode, said


def fault_of(code, said, names):
    """What is wrong with that end, or nothing. A refusal has to contain one of the names."""
    if code is None:
        return "took too long"
    if code < 0 or code > 2:
        return f"exit {code}"
    for word in BAD_WORDS:
        if word in said:
            return f"said '{word}'"
    if any(ord(c) < 32 and c not in "\n\t" for c in said):
        return "printed control characters"
    if code == 1 and "gnbv: " not in said and "ended by" not in said:
        return "failed without a reason"
    if code == 2 and "gnbv: " not in said and "--" not in said:
        return "refused without a reason"
    if code == 2 and names and not any(name in said for name in names):
        return "refused without naming " + " or ".join(names)
    return None


# ---- keys --------------------------------------------------------------------------------------
def leaves(schema, path=()):
    """(path, schema) of all leaves; of a list, those of its first item and the list itself."""
    if "properties" in schema:
        for key, child in schema["properties"].items():
            yield from leaves(child, path + (key,))
    for form in schema.get("oneOf", []) + schema.get("anyOf", []):
        yield from leaves(form, path)
    if schema.get("type") == "array":
        yield path, schema
        if "properties" in schema.get("items", {}):
            yield from leaves(schema["items"], path + ("0",))
    elif "properties" not in schema and "type" in schema:
        yield path, schema


def text(value):
    return f"{value:g}" if isinstance(value, float) else str(value)


def numbers(schema):
    """Wrong and extreme numbers for that schema, as text."""
    yield from (".nan", ".inf", "-.inf", "nan", "1e999", "-1", "0", "1e-300", "1e308", "1e18")
    for key in ("minimum", "exclusiveMinimum", "maximum", "exclusiveMaximum"):
        if key in schema:
            limit = schema[key]
            yield text(limit)
            if key.startswith("exclusive"):
                yield repr(math.nextafter(limit, math.inf if "Min" in key else -math.inf))
    low = schema.get("minimum", schema.get("exclusiveMinimum", 0))
    high = schema.get("maximum", schema.get("exclusiveMaximum", 1))
    if schema.get("type") == "integer":
        yield text((low + high) // 2)
        yield "1.5"
    else:
        yield repr(low + 1e-6 * (high - low))
        yield repr(0.5 * (low + high))


def values(schema):
    """Missing, of a wrong type, and extreme values for a leaf, as YAML."""
    yield from ("", "null", "[]", "{}", "{a: 1}", "[1, 2]", "word", "'0.5'", "true", "*a", "!!str 5",
                "[", "\\x01", "0x", "+", "1,5", "- 5")
    kind = schema.get("type")
    if kind in ("number", "integer"):
        yield from numbers(schema)
    elif kind == "array" and "type" in schema.get("items", {}) and \
            schema["items"]["type"] in ("number", "integer"):
        count = schema.get("minItems", 3)
        for number in numbers(schema["items"]):
            yield "[" + ", ".join([number] * count) + "]"
            yield "[" + ", ".join(["0.3"] * (count - 1) + [number]) + "]"
        yield "[" + ", ".join(["1"] * 1000) + "]"
    elif kind == "array":
        yield from ("[{}]", "[5]", "[{}, {}]", "[" + ", ".join(["{}"] * 2000) + "]")
    elif kind == "string":
        yield from schema.get("enum", [])
        yield from ("''", "a/b", "../../etc/passwd", "/", "/dev/null", "'" + "x" * 5000 + "'")


def key_tries(gnbv, folder):
    """(label, command, names)"""
    schema = json.loads(subprocess.run([gnbv, "schema"], capture_output=True, check=True).stdout)
    for path, leaf in leaves(schema):
        key = ".".join(path)
        before = []
        if path[:2] == ("vehicle", "estimate"):
            before = ["--set", "vehicle.estimate.model=gnss"]
        if path[0] in ("obstacles", "no_fly"):
            box = "{min: [2, 2, 0], max: [2.5, 2.5, 1]}"
            before = ["--set", f"{path[0]}=[{{box_m: {box}}}]" if path[0] == "obstacles"
                      else f"no_fly=[{box}]"]
        for value in values(leaf):
            yield (f"{key}={value[:60]}",
                   [gnbv, "run", "smoke", *ONE_VIEW, *before, "--set", f"{key}={value}"],
                   [path[-1], path[-2] if len(path) > 1 else path[-1]])


# ---- options -----------------------------------------------------------------------------------
COMMANDS = ("cache fly run sweep table compare ceiling render export plot paper report asset lint score "
            "check surface").split()


def option_tries(gnbv, folder):
    for command in COMMANDS:
        words = subprocess.run([gnbv, command, "--help"], capture_output=True,
                               check=True).stdout.decode().split()
        for option, kind in zip(words, words[1:]):
            if not option.startswith("--") or kind.split(":")[0] not in ("FLOAT", "INT", "UINT"):
                continue
            for value in ("nan", "inf", "-inf", "1e999", "-1e999", "", "word", "0x", "1e400"):
                option = option.split(",")[0]
                yield (f"{command} {option}={value}", [gnbv, command, f"{option}={value}"], [option])


# ---- meshes ------------------------------------------------------------------------------------
CUBE = [(x, y, z) for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (0.0, 1.0)]
QUADS = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]


def obj(vertices, faces):
    lines = ["v " + " ".join(str(x) for x in v) for v in vertices]
    lines += ["f " + " ".join(str(i + 1) for i in f) for f in faces]
    return ("\n".join(lines) + "\n").encode()


def placed(factor, shift=(0, 0, 0)):
    return obj([tuple(factor * x + s for x, s in zip(v, shift)) for v in CUBE], QUADS)


def ply(vertices, faces, count=None):
    head = (f"ply\nformat ascii 1.0\nelement vertex {count or len(vertices)}\nproperty float x\n"
            f"property float y\nproperty float z\nelement face {len(faces)}\n"
            "property list uchar int vertex_indices\nend_header\n")
    rows = [" ".join(str(x) for x in v) for v in vertices]
    rows += [f"{len(f)} " + " ".join(map(str, f)) for f in faces]
    return (head + "\n".join(rows) + "\n").encode()


def meshes():
    """name -> bytes"""
    yield "empty.obj", b""
    yield "empty.ply", b""
    yield "blanks.obj", b" \n\t\n" * 1000
    yield "no_faces.obj", obj(CUBE, [])
    yield "no_vertices.obj", b"f 1 2 3\n"
    yield "point.obj", obj([(0, 0, 0)] * 3, [(0, 1, 2)])
    yield "line.obj", obj([(0, 0, 0), (1, 0, 0), (2, 0, 0)], [(0, 1, 2)])
    yield "one_triangle.obj", obj([(0, 0, 0), (1, 0, 0), (0, 0, 1)], [(0, 1, 2)])
    yield "two_corners.obj", obj(CUBE, [(0, 1)])
    yield "same_corner.obj", obj(CUBE, [(0, 0, 0), (1, 1, 2)])
    yield "three_at_an_edge.obj", obj(CUBE, QUADS + [(0, 1, 7), (0, 1, 6)])
    yield "inside_out.obj", obj(CUBE, [f[::-1] for f in QUADS])
    yield "through_itself.obj", obj(CUBE + [(x + 0.3, y + 0.3, z) for x, y, z in CUBE],
                                    QUADS + [tuple(i + 8 for i in f) for f in QUADS])
    yield "twice.obj", obj(CUBE, QUADS + QUADS)
    yield "index_0.obj", obj(CUBE, []) + b"f 0 1 2\n"
    yield "index_huge.obj", obj(CUBE, []) + b"f 1 2 99999999999999999999\n"
    yield "index_beyond.obj", obj(CUBE, []) + b"f 1 2 9\n"
    yield "negative_beyond.obj", obj(CUBE, []) + b"f -1 -2 -9\n"
    yield "bowtie.obj", obj([(0, 0, 0), (1, 0, 1), (1, 0, 0), (0, 0, 1)], [(0, 1, 2, 3)])
    yield "polygon_of_5000.obj", obj([(math.cos(i / 796), math.sin(i / 796), 0.5)
                                      for i in range(5000)], [tuple(range(5000))])
    for name, factor in (("millimetres", 1e3), ("million_metres", 1e6), ("tiny", 1e-9),
                         ("huge", 1e30), ("beyond_float", 1e39), ("denormal", 1e-320)):
        yield f"{name}.obj", placed(factor)
    yield "far_away.obj", placed(1.0, (1e6, 1e6, 0))
    yield "below_ground.obj", placed(1.0, (0, 0, -50))
    yield "beside_start.obj", placed(1.0, (0, -2.8, 0.7))
    yield "around_start.obj", placed(20.0)
    for word in ("nan", "inf", "-inf", "1e-400", "1e400", "+", "-", "+-1", "1,5", "0x10", "1e", "--1"):
        yield f"word_{word.replace('+', 'plus').replace(',', '_')}.obj", \
            b"v " + word.encode() + b" 0 0\n" + obj(CUBE, [(0, 1, 2), (3, 4, 5)])
        yield f"word_{word.replace('+', 'plus').replace(',', '_')}.ply", \
            ply([(word, 0, 0)] + CUBE, [(0, 1, 2), (3, 4, 5)])
    yield "promises.ply", ply(CUBE, QUADS, 4_000_000_000)
    yield "negative_count.ply", ply(CUBE, QUADS).replace(b"vertex 8", b"vertex -8")
    yield "long_list.ply", ply(CUBE, []).replace(b"face 0", b"face 1") + b"255 0 1 2\n"
    yield "no_end_header.ply", ply(CUBE, QUADS).replace(b"end_header\n", b"")
    yield "binary_short.ply", ply(CUBE, QUADS).replace(b"ascii", b"binary_little_endian")[:300]
    yield "long_word.obj", b"v " + b"1" * 1_000_000 + b" 0 0\n" + obj(CUBE, QUADS)
    yield "long_line.obj", b"# " + b"x" * 5_000_000 + b"\n" + obj(CUBE, QUADS)
    yield "zeros.obj", bytes(100_000)
    yield "zeros.stl", bytes(84)
    yield "count.stl", bytes(80) + struct.pack("<I", 0xffffffff) + bytes(50)
    yield "nan.stl", bytes(80) + struct.pack("<I", 1) + struct.pack("<12f", *[math.nan] * 12) + b"\0\0"
    collada = ('<?xml version="1.0"?><COLLADA version="1.4.1"><asset>{}</asset>'
               "</COLLADA>")
    for name, asset in (("unit_blanks", "<unit " + " " * 200_000 + ">"),
                        ("unit_words", "<unit " + 'a="b" ' * 50_000 + "/>"),
                        ("unit_letters", "<unit " + "m" * 200_000),
                        ("unit_inf", '<unit meter="1e999"/>'), ("unit_nan", '<unit meter="nan"/>'),
                        ("unit_zero", '<unit meter="0"/>'), ("unit_minus", '<unit meter="-1"/>'),
                        ("axis", "<up_axis>Q_UP</up_axis>")):
        yield f"{name}.dae", collada.format(asset).encode()
    yield "deep.dae", b"<a>" * 100_000
    yield "entities.dae", (b'<?xml version="1.0"?><!DOCTYPE l [<!ENTITY a "aaaaaaaaaa">'
                           + b"".join(b'<!ENTITY %c "%s">' % (98 + i, b"&%c;" % (97 + i) * 10)
                                      for i in range(9)) + b"]><COLLADA>&j;</COLLADA>")
    yield "empty.gltf", b"{}"
    yield "deep.gltf", b'{"a":' * 50_000
    yield "short.glb", b"glTF\2\0\0\0\xff\xff\xff\xff"
    yield "picture.obj", bytes(range(256)) * 400


def mesh_tries(gnbv, folder):
    for name, content in meshes():
        path = os.path.join(folder, name)
        with open(path, "wb") as file:
            file.write(content)
        yield f"lint {name}", [gnbv, "lint", path], [name]
        yield f"run {name}", [gnbv, "run", "smoke", *ONE_VIEW, "--mesh", path], \
            [name, "start", "structure", "workspace"]
        yield f"run --bounds auto {name}", \
            [gnbv, "run", "smoke", *ONE_VIEW, "--bounds", "auto", "--mesh", path], \
            [name, "start", "structure", "workspace", "planner.map.resolution_m"]


PARTS = {"keys": key_tries, "options": option_tries, "meshes": mesh_tries}


def attack(part, options, folder):
    """Rows of failures and the number of tries."""
    tries = [t for i, t in enumerate(PARTS[part](options.gnbv, folder)) if i % options.every == 0]

    def one(numbered):
        number, (label, command, names) = numbered
        out = os.path.join(folder, f"{part}{number}")
        if command[1] == "run" and part != "options":
            command = command + ["--out", out]
        fault = fault_of(*run(command, options.timeout), names)
        shutil.rmtree(out, ignore_errors=True)
        return f"{part}: {label}: {fault}" if fault else None

    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        failures = [fault for fault in pool.map(one, enumerate(tries)) if fault]
    return failures, len(tries)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--gnbv", default=REPOSITORY / "build/release/gnbv")
    parser.add_argument("--part", default=",".join(PARTS))
    parser.add_argument("--every", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--timeout", type=float, default=120.0)
    options = parser.parse_args()
    parts = options.part.split(",")
    if any(part not in PARTS for part in parts) or options.every < 1:
        parser.error(f"parts are {', '.join(PARTS)}; --every is at least 1")
    options.gnbv = os.path.abspath(options.gnbv)
    found = False
    print(f"{'attack':<24}{'tries':>8}{'failures':>10}")
    for part in parts:
        with tempfile.TemporaryDirectory() as folder:
            failures, tries = attack(part, options, folder)
        print(f"{'bad input: ' + part:<24}{tries:>8}{len(failures):>10}", flush=True)
        for failure in failures:
            print(failure, file=sys.stderr)
        found = found or bool(failures)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
