"""Bad input, generated: every key and option with wrong values, and meshes that are none.

Every key of the schema with values that are wrong or extreme, every number on the command line that
is none, and meshes that are no structures. Each has to end by itself: done, refused in one line a
fault that names the key or the file (exit 2), or as a mission that failed for a stated reason (exit
1). Internal errors, signals, silence and more than the time given are failures.

--every N takes only each N-th: the short version.
"""
import json
import math
import struct
import subprocess

import pytest

TIMEOUT_S = 120
RUN = ["run", "smoke", "--quiet", "--set", "planner.termination.max_iterations=1", "--set",
       "planner.termination.max_flight_time_s=60", "--out", "out"]
STRUCTURE = ["start", "structure", "workspace"]


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


def numbers(schema):
    """Wrong and extreme numbers for that schema, as text."""
    yield from (".nan", ".inf", "-.inf", "nan", "1e999", "-1", "0", "1e-300", "1e308", "1e18")
    for key in ("minimum", "exclusiveMinimum", "maximum", "exclusiveMaximum"):
        if key in schema:
            limit = schema[key]
            yield f"{limit:g}"
            if key.startswith("exclusive"):
                yield repr(math.nextafter(limit, math.inf if "Min" in key else -math.inf))
    low = schema.get("minimum", schema.get("exclusiveMinimum", 0))
    high = schema.get("maximum", schema.get("exclusiveMaximum", 1))
    if schema.get("type") == "integer":
        yield str((low + high) // 2)
        yield "1.5"
    else:
        yield repr(low + 1e-6 * (high - low))
        yield repr(0.5 * (low + high))


def values(schema):
    """Missing, of a wrong type, and extreme values for a leaf, as YAML."""
    yield from ("", "null", "[]", "{}", "{a: 1}", "[1, 2]", "word", "'0.5'", "true", "*a",
                "!!str 5", "[", "\\x01", "0x", "+", "1,5", "- 5")
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


def key_tries(program):
    """(words of the program, of which a refusal has to hold one)"""
    schema = json.loads(subprocess.run([program, "schema"], capture_output=True, check=True).stdout)
    box = "{min: [2, 2, 0], max: [2.5, 2.5, 1]}"
    before = {"obstacles": f"obstacles=[{{box_m: {box}}}]", "no_fly": f"no_fly=[{box}]",
              "vehicle": "vehicle.estimate.model=gnss"}
    for path, leaf in leaves(schema):
        more = ["--set", before[path[0]]] if path[0] in before and (
            path[0] != "vehicle" or path[1] == "estimate") else []
        for value in values(leaf):
            yield [*RUN, *more, "--set", f"{'.'.join(path)}={value}"], path[-2:]


COMMANDS = ("cache fly run sweep table compare ceiling render export plot paper report asset lint "
            "score check surface").split()


def option_tries(program):
    for command in COMMANDS:
        words = subprocess.run([program, command, "--help"], capture_output=True,
                               check=True).stdout.decode().split()
        for option, kind in zip(words, words[1:]):
            if option.startswith("--") and kind.split(":")[0] in ("FLOAT", "INT", "UINT"):
                option = option.split(",")[0]
                for value in ("nan", "inf", "-inf", "1e999", "-1e999", "", "word", "0x", "1e400"):
                    yield [command, f"{option}={value}"], [option]


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
    for word in ("nan", "inf", "-inf", "1e-400", "1e400", "+", "-", "+-1", "1,5", "0x10", "1e",
                 "--1"):
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
    yield "nan.stl", bytes(80) + struct.pack("<I12f", 1, *[math.nan] * 12) + b"\0\0"
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


def mesh_tries():
    for name, content in meshes():
        yield name, content, ["lint", name], [name]
        yield name, content, [*RUN, "--mesh", name], [name, *STRUCTURE]
        yield name, content, [*RUN, "--bounds", "auto", "--mesh", name], \
            [name, *STRUCTURE, "planner.map.resolution_m"]


def pytest_generate_tests(metafunc):
    program = metafunc.config.option.gnbv
    tries = {"key": key_tries, "option": option_tries}
    for kind, made in tries.items():
        if kind in metafunc.fixturenames:
            found = list(made(program))
            metafunc.parametrize([kind, "names"], found, ids=[words[-1][:60] for words, _ in found])


def refuses_or_flies(gnbv, words, names):
    end = gnbv.limited(*words, timeout_s=TIMEOUT_S).check(names=[])
    said = end.out + end.err
    assert "out of memory" not in said
    if end.code == 1:
        assert "gnbv: " in said or "ended by" in said, said
    if end.code == 2:
        assert "gnbv: " in said or "--" in said, said
        assert any(name in said for name in names), said


def test_a_key_is_named(gnbv, key, names):
    refuses_or_flies(gnbv, key, names)


def test_an_option_is_named(gnbv, option, names):
    refuses_or_flies(gnbv, option, names)


@pytest.mark.parametrize("name, content, words, names", list(mesh_tries()), ids=lambda value: (
    "" if isinstance(value, bytes) else "_".join(value) if isinstance(value, list) else value))
def test_a_mesh_is_named(gnbv, tmp_path, name, content, words, names):
    (tmp_path / name).write_bytes(content)
    refuses_or_flies(gnbv, words, names)
