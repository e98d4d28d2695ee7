"""Embree as its Python users call it: keeps the scene of one mesh and answers batches of rays.

    embree.py PEER FOLDER

PEER is open3d, embreex or embreex-robust. FOLDER holds `vertices` (f32 x 3) and `triangles` (u32 x 3), raw. Once they
are built, and after each request, one line of JSON goes to stdout: `seconds` and `version`, or `error`. A request is a
line on stdin, `closest` or `count`: `rays` (f32 x 8: origin, t_min, direction, t_max) are read from the folder and
`answers` written to it: t, u, v and primitive, or a u32 each. Only the peer's own call is timed.
"""

import importlib.metadata
import json
import os
import sys
import time

import numpy as np

MISS = np.uint32(0xFFFFFFFF)
HIT = np.dtype([("t", np.float32), ("u", np.float32), ("v", np.float32), ("primitive", np.uint32)])


class Open3D:
    """Open3D's RaycastingScene, whose Embree scene is robust."""

    def __init__(self, vertices, triangles):
        import open3d

        self.version = open3d.__version__
        self.tensor = open3d.core.Tensor.from_numpy
        start = time.perf_counter()
        self.scene = open3d.t.geometry.RaycastingScene()
        self.scene.add_triangles(self.tensor(vertices), self.tensor(triangles))
        # The first query builds the tree.
        self.scene.cast_rays(self.tensor(np.array([[0, 0, 0, 0, 0, 1]], np.float32)))
        self.seconds = time.perf_counter() - start

    def closest(self, origins, directions):
        rays = self.tensor(np.concatenate([origins, directions], axis=1))
        start = time.perf_counter()
        answer = self.scene.cast_rays(rays)
        seconds = time.perf_counter() - start
        hits = np.empty(len(origins), HIT)
        hits["t"] = answer["t_hit"].numpy()
        hits["u"], hits["v"] = answer["primitive_uvs"].numpy().T
        hits["primitive"] = answer["primitive_ids"].numpy()
        return seconds, hits

    def count(self, origins, directions):
        rays = self.tensor(np.concatenate([origins, directions], axis=1))
        start = time.perf_counter()
        answer = self.scene.count_intersections(rays)
        seconds = time.perf_counter() - start
        return seconds, answer.numpy().astype(np.uint32)


class Embreex:
    """embreex, the package behind trimesh: one ray after another on one thread."""

    def __init__(self, vertices, triangles, robust):
        from embreex.mesh_construction import TriangleMesh
        from embreex.rtcore_scene import EmbreeScene

        self.version = importlib.metadata.version("embreex")
        start = time.perf_counter()
        self.scene = EmbreeScene(robust=robust)
        TriangleMesh(scene=self.scene, vertices=vertices, indices=triangles.astype(np.int32))
        # The first query builds the tree.
        self.scene.run(np.zeros((1, 3), np.float32), np.array([[0, 0, 1]], np.float32))
        self.seconds = time.perf_counter() - start

    def closest(self, origins, directions):
        start = time.perf_counter()
        answer = self.scene.run(origins, directions, output=True)
        seconds = time.perf_counter() - start
        hits = np.empty(len(origins), HIT)
        hits["t"], hits["u"], hits["v"] = answer["tfar"], answer["u"], answer["v"]
        hits["primitive"] = answer["primID"].astype(np.uint32)
        return seconds, hits


PEERS = {
    "open3d": Open3D,
    "embreex": lambda vertices, triangles: Embreex(vertices, triangles, robust=False),
    "embreex-robust": lambda vertices, triangles: Embreex(vertices, triangles, robust=True),
}


def answer(peer, query, folder):
    rays = np.fromfile(os.path.join(folder, "rays"), np.float32).reshape(-1, 8)
    origins, directions = np.ascontiguousarray(rays[:, 0:3]), np.ascontiguousarray(rays[:, 4:7])
    seconds, answers = getattr(peer, query)(origins, directions)
    if query == "closest":
        # What peers write into a miss differs.
        missed = answers["primitive"] == MISS
        answers["t"][missed], answers["u"][missed], answers["v"][missed] = np.inf, 0, 0
    answers.tofile(os.path.join(folder, "answers"))
    return seconds


def main():
    name, folder = sys.argv[1:]
    # Libraries print as they like; only this script's own lines are answers.
    lines = os.fdopen(os.dup(1), "w", encoding="utf-8")
    os.dup2(2, 1)

    def say(**line):
        print(json.dumps(line), file=lines, flush=True)

    try:
        vertices = np.fromfile(os.path.join(folder, "vertices"), np.float32).reshape(-1, 3)
        triangles = np.fromfile(os.path.join(folder, "triangles"), np.uint32).reshape(-1, 3)
        peer = PEERS[name](vertices, triangles)
    except Exception as error:
        say(error=f"{type(error).__name__}: {error}")
        return
    say(seconds=peer.seconds, version=peer.version)
    for query in sys.stdin:
        try:
            say(seconds=answer(peer, query.strip(), folder))
        except Exception as error:
            say(error=f"{type(error).__name__}: {error}")


main()
