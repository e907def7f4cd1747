"""Makes triangles and ambient-occlusion rays of models, and times Embree's any-hit on them.

    python3 -m venv VENV && VENV/bin/pip install numpy trimesh embreex
    VENV/bin/python embree.py make FOLDER NAME=MODEL.glb ...
    VENV/bin/python embree.py time FOLDER/NAME ...

One thread: Embree's own, from one call with all rays. Rays: 64 from each of 15,625 points spread by
area, cosine-distributed about the triangle's normal, unbounded.
"""
import os
import sys
import time

import numpy as np


def make(folder, models):
    import trimesh

    os.makedirs(folder, exist_ok=True)
    rng = np.random.default_rng(2010)
    for name, path in (model.split("=", 1) for model in models):
        mesh = trimesh.load(path, force="mesh", process=False)
        corners = np.asarray(mesh.triangles, dtype=np.float32)
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]).astype(float)
        areas = np.linalg.norm(normals, axis=1)
        chosen = rng.choice(len(corners), 15_625, p=areas / areas.sum())
        u, v = np.sqrt(rng.random(len(chosen))), rng.random(len(chosen))
        weights = np.stack([1 - u, u * (1 - v), u * v], axis=1)
        points = (corners[chosen] * weights[:, :, None]).sum(axis=1)
        normal = normals[chosen] / areas[chosen, None]
        points += normal * 1e-5 * np.abs(mesh.bounds).max()
        points, normal = np.repeat(points, 64, axis=0), np.repeat(normal, 64, axis=0)
        directions = rng.normal(size=points.shape)
        directions /= np.linalg.norm(directions, axis=1)[:, None]
        directions += normal
        directions /= np.linalg.norm(directions, axis=1)[:, None]
        corners.astype("<f4").tofile(f"{folder}/{name}.triangles")
        np.hstack([points, directions]).astype("<f4").tofile(f"{folder}/{name}.rays")


def measure(name):
    from embreex.mesh_construction import TriangleMesh
    from embreex.rtcore_scene import EmbreeScene

    corners = np.fromfile(f"{name}.triangles", "<f4").reshape(-1, 3, 3)
    rays = np.fromfile(f"{name}.rays", "<f4").reshape(-1, 2, 3)
    scene = EmbreeScene()
    TriangleMesh(scene, corners)
    origins, directions = (np.ascontiguousarray(rays[:, k]) for k in range(2))
    scene.run(origins[:1], directions[:1], query="OCCLUDED")
    least = np.inf
    for _ in range(5):
        started = time.perf_counter()
        hits = scene.run(origins, directions, query="OCCLUDED")
        least = min(least, time.perf_counter() - started)
    blocked = int((hits >= 0).sum())
    print(f"{name}: embree {len(rays) / least / 1e6:.2f} Mrays/s on 1 thread, {blocked} blocked of {len(rays)}")


if __name__ == "__main__":
    if len(sys.argv) < 3 or sys.argv[1] not in ("make", "time"):
        sys.exit(__doc__)
    if sys.argv[1] == "make":
        make(sys.argv[2], sys.argv[3:])
    else:
        for each in sys.argv[2:]:
            measure(each)
