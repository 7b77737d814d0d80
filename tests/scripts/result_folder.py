# SPDX-License-Identifier: MIT
"""Writes a folder as trajlo_run does, for tests of what reads one: a walk through a closed room."""
import json
import pathlib

import numpy as np

BEGIN_S = 1.7e9
ROOM = np.array([[-10.0, -6.0, 0.0], [10.0, 6.0, 3.0]])
HEIGHT_M = 1.2


def positions(times):
    """An ellipse in the room, once around in 40 s."""
    phase = 2 * np.pi * np.asarray(times) / 40
    return np.stack([6 * np.cos(phase), 3 * np.sin(phase), np.full(len(phase), HEIGHT_M)], axis=1)


def on_walls(random, count, walls=ROOM):
    """Points on the six sides of a box."""
    points = random.uniform(*walls, (count, 3))
    axis, side = random.integers(0, 3, count), random.integers(0, 2, count)
    points[np.arange(count), axis] = walls[side, axis]
    return points


def write_ply(path, columns, comment=""):
    head = ["ply", "format binary_little_endian 1.0", *([comment] if comment else []),
            f"element vertex {len(next(iter(columns.values())))}",
            *(f"property float {name}" for name in columns), "end_header", ""]
    rows = np.stack(list(columns.values()), axis=1).astype("<f4")
    path.write_bytes("\n".join(head).encode() + rows.tobytes())


def write_windows(path, times, flags):
    """`flags` maps indices of windows to names."""
    lines = ["index,begin_s,end_s,points,inlier_share,agreement,smallest_eigenvalue,segment_ms,"
             "associate_ms,solve_ms,marginalize_ms,map_ms,flags,flag_names"]
    for i in range(1, len(times)):
        if flags.get(i) == "gap":  # a gap has no window
            continue
        lines.append(f"{i},{BEGIN_S + times[max(i - 4, 0)]:.9f},{BEGIN_S + times[i]:.9f},900,0.9,"
                     f"0.97,0.05,1,2,3,0,1,{int(i in flags)},{flags.get(i, '')}")
    path.write_text("\n".join(lines) + "\n")


def write_flags(path, times, flags):
    lines = [f"{BEGIN_S + t:.9f},{int(i in flags)},{flags.get(i, '')}" for i, t in enumerate(times)]
    path.write_text("\n".join(["t_s,flags,flag_names", *lines]) + "\n")


def run_json(seconds):
    return {"exit": {"code": 0, "reason": "ok", "message": ""},
            "input": {"paths": ["/somewhere/office_os0_64"], "understood_as": ["a folder"],
                      "scans": {"listed": 20, "read": 19, "damaged": 1, "skipped": 1}},
            "result": {"duration_s": seconds, "path_length_m": 12.34, "distance_to_start_m": 0.5,
                       "poses_flagged": 3,
                       "flagged": {"gap": {"poses": 1, "seconds": 0.1},
                                   "lost": {"poses": 0, "seconds": 0.0},
                                   "not_converged": {"poses": 2, "seconds": 0.06}}},
            "windows": {"count": 99, "inlier_share": 0.9,
                        "flagged": {"gap": 0, "not_converged": 2, "lost": 0}},
            "warnings": ["a scan is missing"],
            "resources": {"cpu_s": 3.0, "peak_memory_mb": 80.0}}


def write_result(folder, seconds=10.0, flags=None, scans=True, map_points=4000,
                 points_per_moment=300, walls=ROOM):
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    random = np.random.default_rng(1)
    times = np.arange(0, seconds + 1e-9, 0.1)
    lines = [f"{BEGIN_S + t:.9f} {x:.6f} {y:.6f} {z:.6f} 0 0 0 1"
             for t, (x, y, z) in zip(times, positions(times))]
    (folder / "trajectory.tum").write_text("\n".join(lines) + "\n")
    write_ply(folder / "map.ply", dict(zip("xyz", on_walls(random, map_points, walls).T)))
    if scans:
        moments = np.arange(0, seconds - 1e-9, 0.5)
        points = on_walls(random, points_per_moment * len(moments), walls)
        write_ply(folder / "view.ply", {
            **dict(zip("xyz", points.T)), "intensity": random.uniform(5, 200, len(points)),
            "t_s": np.repeat(moments, points_per_moment)}, f"comment begin_s {BEGIN_S:.9f}")
    write_windows(folder / "windows.csv", times, flags or {})
    write_flags(folder / "flags.csv", times, flags or {})
    (folder / "run.json").write_text(json.dumps(run_json(seconds)))
    (folder / "config.yaml").write_text("window:\n  segments: 5\n")
    return folder
