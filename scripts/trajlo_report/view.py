# SPDX-License-Identifier: MIT
"""The 3-D view of a run for its page: map, scans, path and truth in one text, drawn by view/*.js
with three.js."""
import dataclasses
import json
import pathlib

import matplotlib
import numpy as np
from markupsafe import Markup

from trajlo_report import view_cloud, view_path
from trajlo_report.evaluated import with_gaps
from trajlo_report.view_arrays import Arrays, morton

THREE = pathlib.Path("/usr/share/javascript/three")  # Debian's libjs-three
LIBRARY = ("three.min.js", "examples/js/controls/OrbitControls.js",
           "examples/js/lines/LineSegmentsGeometry.js", "examples/js/lines/LineMaterial.js",
           "examples/js/lines/LineSegments2.js")
OWN = ("arrays.js", "colors.js", "cloud.js", "shading.js", "lines.js", "path.js", "camera.js",
       "timeline.js", "panel.js", "controls.js", "main.js")
# Of each the part that is seen well on white; walls full of turbo want softer colours.
COLOR_MAPS = {"turbo": (0.07, 0.93), "gray": (0.08, 0.85), "viridis": (0, 1), "viridis_r": (0, 1),
              "plasma": (0, 1)}
SOFTENED = {"turbo": 0.25}


def missing_library():
    """What to say if three.js is not installed; nothing if it is."""
    if all((THREE / name).is_file() for name in LIBRARY):
        return ""
    return f"There is no 3-D view: three.js is not in {THREE} (Debian's package libjs-three)."


def source(path):
    """Code that can stand in a page: a script ends at the first of these, wherever it stands."""
    return Markup(path.read_text().replace("</script", "<\\/script"))


def embedded(run):
    """What templates/view.html needs."""
    description, arrays = make(run)
    folder = pathlib.Path(__file__).parent / "view"
    return {"style": source(folder / "view.css"),
            "library": [source(THREE / name) for name in LIBRARY],
            "code": Markup("\n").join(source(folder / name) for name in OWN),
            "description": Markup(description), "arrays": arrays}


def quantised(points):
    """16-bit coordinates with the corner and the step (m) that they count in."""
    corner = points.min(axis=0)
    step = float(max((points.max(axis=0) - corner).max(), 1e-3)) / 65535
    return np.round((points - corner) / step).astype(np.uint16), corner, step


def as_bytes(values):
    """Most values from 0 to 255, and what these two stand for."""
    low, high = np.percentile(values, [2, 98])
    share = np.clip((values - low) / max(high - low, 1e-12), 0, 1)
    return np.round(255 * share), float(low), float(high)


def compact_order(grid, cloud):
    """Points near each other side by side, within each moment and within what is not of a scan."""
    group = np.searchsorted(cloud.first, np.arange(len(grid)), side="right")
    return np.lexsort((morton(grid), group))


def add_cloud(arrays, cloud, positions):
    grid, corner, step = quantised(cloud.points)
    order = compact_order(grid, cloud)
    for axis, name in enumerate("xyz"):
        arrays.add_positions(f"cloud_{name}", grid[order, axis])
    heights = np.percentile(cloud.points[:, 2], [1, 99]) if len(cloud.points) else (0.0, 1.0)
    entry = {"count": len(grid), "scan_count": cloud.scan_count, "corner": corner.tolist(),
             "step_m": step, "height": {"low": heights[0], "high": heights[1]},
             "ceiling_m": view_cloud.ceiling_cut(cloud.points, positions),
             "moments_s": cloud.moments.tolist(), "first": cloud.first.tolist()}
    if len(cloud.times):
        # The time of a scan's points is that of its moment.
        index = np.searchsorted(cloud.moments, cloud.times[order][cloud.scan_count:])
        arrays.add_positions("cloud_moment", index)
    if len(cloud.intensity) and np.ptp(cloud.intensity) > 0:
        values, low, high = as_bytes(cloud.intensity[order])
        arrays.add_bytes("cloud_intensity", values)
        entry["intensity"] = {"low": low, "high": high}
    return entry


def add_path(arrays, run, positions):
    keep = view_cloud.evenly(len(run.times), view_path.MOST_POSES)
    arrays.add_floats("path_t", run.times[keep] - run.begin)
    arrays.add_floats("path_xyz", positions[keep])
    arrays.add_floats("path_rotation", run.rotations[keep])
    entries = []
    for item in view_path.quantities(run.times, positions, run.windows, run.estimate):
        low, high = item.bounds()
        arrays.add_floats(f"path_{item.key}", item.values[keep])
        entries.append({**{field.name: getattr(item, field.name)
                           for field in dataclasses.fields(item) if field.name != "values"},
                        "low": low, "high": high})
    return {"count": len(keep), "quantities": entries}


def add_truth(arrays, estimate, origin):
    """The true path where it was compared, with holes where it was not."""
    _, truth = with_gaps(estimate.times, estimate.truth)
    truth = truth[view_cloud.evenly(len(truth), view_path.MOST_POSES)]
    arrays.add_floats("truth_xyz", truth - origin)


def color_table(name):
    white = SOFTENED.get(name, 0.0)
    colors = matplotlib.colormaps[name](np.linspace(*COLOR_MAPS[name], 64))[:, :3]
    colors = white + (1 - white) * colors
    return [matplotlib.colors.to_hex(color) for color in colors]


def make(run):
    """What view/main.js draws: (description as JSON, arrays as text)."""
    # Map coordinates have more digits than a graphics card.
    far = np.abs(run.positions).max() > 1e4
    origin = np.round(run.positions[0]) if far else np.zeros(3)
    arrays, positions = Arrays(), run.positions - origin
    document = {"frame": run.frame.text, "origin": origin.tolist(), "flags": run.flags,
                "colors": {name: color_table(name) for name in COLOR_MAPS}, "cloud": None}
    if run.cloud:
        cloud = dataclasses.replace(run.cloud, points=run.cloud.points - origin)
        document["cloud"] = add_cloud(arrays, cloud, positions)
    document["path"] = add_path(arrays, run, positions)
    if run.is_evaluated:
        add_truth(arrays, run.estimate, origin)
    document["arrays"] = arrays.index
    return json.dumps(document, allow_nan=False).replace("<", "\\u003c"), arrays.text()
