"""A fracture method in a hundred lines: cuts a body in two by a plane through the point that was hit.

Called by fracbench as   python3 plane_cutter.py IN OUT   (docs/add-a-method.md). The plane turns about
the impulse by a random angle. The cut is closed by a fan, so the body has to be convex.
"""

import json
import math
import pathlib
import random
import sys


def read_obj(file):
    vertices, faces = [], []
    for line in file.read_text().splitlines():
        words = line.split()
        if words and words[0] == "v":
            vertices.append(tuple(float(w) for w in words[1:4]))
        elif words and words[0] == "f":
            faces.append([int(w.split("/")[0]) - 1 for w in words[1:]])
    return vertices, faces


def write_obj(file, vertices, faces):
    lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in vertices]
    lines += [f"f {a + 1} {b + 1} {c + 1}" for a, b, c in faces]
    file.write_text("\n".join(lines) + "\n")


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def scaled(a, factor):
    return tuple(factor * x for x in a)


def unit(a):
    return scaled(a, 1 / math.sqrt(dot(a, a)))


def half(vertices, faces, heights):
    """The part of the closed mesh where heights are positive."""
    points = list(vertices)
    crossing = {}

    def point_between(a, b):
        key = (min(a, b), max(a, b))
        if key not in crossing:
            low, high = key
            t = heights[low] / (heights[low] - heights[high])
            crossing[key] = len(points)
            points.append(tuple(p + t * (q - p) for p, q in zip(vertices[low], vertices[high])))
        return crossing[key]

    kept, rim = [], []
    for face in faces:
        polygon, ends = [], {}
        for a, b in zip(face, face[1:] + face[:1]):
            if heights[a] > 0:
                polygon.append(a)
            if (heights[a] > 0) != (heights[b] > 0):
                polygon.append(point_between(a, b))
                ends["out" if heights[a] > 0 else "in"] = polygon[-1]
        kept += [(polygon[0], b, c) for b, c in zip(polygon[1:], polygon[2:])]
        if ends:
            rim.append((ends["out"], ends["in"]))
    if rim:
        middle = len(points)
        count = len(rim)
        points.append(tuple(sum(points[a][k] for a, _ in rim) / count for k in range(3)))
        kept += [(b, a, middle) for a, b in rim]
    used = sorted({v for face in kept for v in face})
    number = {v: n for n, v in enumerate(used)}
    return [points[v] for v in used], [tuple(number[v] for v in face) for face in kept]


def main():
    folder_in, folder_out = (pathlib.Path(argument) for argument in sys.argv[1:3])
    request = json.loads((folder_in / "request.json").read_text())
    vertices, faces = read_obj(folder_in / "body.obj")
    impulse = request["impulses"][0]

    chance = random.Random(request["seed"])
    direction = impulse["direction"]
    side = unit(cross(direction, (1, 0, 0) if abs(direction[0]) < 0.9 else (0, 1, 0)))
    other = cross(direction, side)
    angle = chance.uniform(0, math.pi)
    normal = [math.cos(angle) * s + math.sin(angle) * o for s, o in zip(side, other)]

    heights = [dot(normal, v) - dot(normal, impulse["point"]) for v in vertices]
    heights = [h if abs(h) > 1e-9 else 1e-9 for h in heights]  # no vertex lies in the plane
    for name, sign in (("a", 1), ("b", -1)):
        part, part_faces = half(vertices, faces, [sign * h for h in heights])
        if part_faces:
            write_obj(folder_out / f"{name}.obj", part, part_faces)


if __name__ == "__main__":
    main()
