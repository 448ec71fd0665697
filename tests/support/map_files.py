"""What an attack reads of maps and meshes."""
import math
import struct


def read_surface(path):
    """Centres of the voxels that a profile.map holds for occupied, metres (world). A point of the
    profile is no surface where other rays have cleared its voxel."""
    with open(path, "rb") as file:
        data = file.read()
    at = data.index(b"\n") + 1
    settings = struct.unpack_from("<16d", data, at)
    resolution_m, first, size = settings[0], settings[1:4], settings[4:7]
    occupied_min = settings[11]
    at += 16 * 8 + 1
    (points,) = struct.unpack_from("<Q", data, at)
    at += 8 + 12 * points
    threshold = math.log(occupied_min / (1 - occupied_min))
    nx, ny, nz = (int(n) for n in size)
    surface, voxel = [], 0
    while voxel < nx * ny * nz:
        kind, at, length, shift = data[at], at + 1, 0, 0
        while True:
            length |= (data[at] & 0x7F) << shift
            shift, at = shift + 7, at + 1
            if data[at - 1] < 0x80:
                break
        if kind == 2:
            (log_odds,) = struct.unpack_from("<f", data, at)
            at += 4
            if log_odds >= threshold:
                for v in range(voxel, voxel + length):
                    key = (v % nx, v // nx % ny, v // (nx * ny))
                    surface.append([(first[i] + key[i] + 0.5) * resolution_m for i in range(3)])
        voxel += length
    return surface


def read_points(path):
    """Vertices of a PLY file of three floats each."""
    return struct.iter_unpack("<3f", path.read_bytes().partition(b"end_header\n")[2])


def read_mesh(path):
    """Triangles of an OBJ file."""
    vertices, triangles = [], []
    with open(path) as file:
        for words in map(str.split, file):
            if words[0] == "v":
                vertices.append(tuple(map(float, words[1:])))
            else:
                face = [vertices[int(word) - 1] for word in words[1:]]
                triangles += [(face[0], face[i], face[i + 1]) for i in range(1, len(face) - 1)]
    return triangles


def nearest_surface(triangles, p, steps=60):
    """The point of the mesh that is nearest to p, to a sixtieth of an edge."""
    grid = [(i / steps, j / steps) for i in range(steps + 1) for j in range(steps + 1 - i)]
    return min((tuple(a[k] + u * (b[k] - a[k]) + v * (c[k] - a[k]) for k in range(3))
                for a, b, c in triangles for u, v in grid), key=lambda q: math.dist(p, q))
