# SPDX-License-Identifier: MIT
"""The factor graph of one window as figures."""
import numpy as np

from trajlo_report import theme
from trajlo_report.window_graph import COMPONENTS, OPEN

AXES = "xyz"
KINDS = {"registration": theme.METHODS[0], "motion": theme.METHODS[1], "prior": theme.METHODS[2]}


def draw_points(graph, width_in):
    """Where the points are, from above and from two sides, and how far off their planes."""
    figure, grid = theme.plt.subplots(1, 3, figsize=(width_in, 0.36 * width_in),
                                      constrained_layout=True)
    points = graph.points
    # What is nearly on its plane is drawn first.
    order = np.argsort(np.abs(points["distance_m"]))
    reach_cm = 100 * max(np.percentile(np.abs(points["distance_m"]), 98), 1e-3) if len(order) else 1
    drawn = None
    for axes, (across, upwards) in zip(grid, ((0, 1), (0, 2), (1, 2))):
        drawn = axes.scatter(points[AXES[across]][order], points[AXES[upwards]][order], s=1.2,
                             c=100 * points["distance_m"][order], cmap="coolwarm", vmin=-reach_cm,
                             vmax=reach_cm, linewidths=0, rasterized=True)
        axes.set_aspect("equal")
        axes.set(xlabel=f"{AXES[across]} [m]", ylabel=f"{AXES[upwards]} [m]")
    figure.colorbar(drawn, ax=grid, label="distance to the plane [cm]", shrink=0.85, extend="both")
    return figure


def draw_residuals(graph, width_in):
    """How the distances are spread in units of sigma, and what the kernel leaves of each."""
    figure, (left, right) = theme.plt.subplots(1, 2, figsize=(width_in, 0.36 * width_in),
                                               constrained_layout=True)
    points = graph.points
    sigma_m = np.array([segment["sigma_m"] for segment in graph.document["segments"]])
    residuals = (np.sqrt(points["weight"]) * points["distance_m"]
                 / sigma_m[points["segment"].astype(int)])
    reach = max(np.percentile(np.abs(residuals), 99), 0.1) if len(residuals) else 1.0
    bins = np.linspace(-reach, reach, 61)
    left.hist(residuals, bins, color=theme.METHODS[0], label="points")
    inside = np.abs(residuals) <= reach
    spread = 1.4826 * np.median(np.abs(residuals)) if len(residuals) else 0.0
    if spread > 0.0:  # Points that do not hold their segment have no weight.
        middle = 0.5 * (bins[1:] + bins[:-1])
        left.plot(middle, inside.sum() * (bins[1] - bins[0]) / (spread * np.sqrt(2 * np.pi))
                  * np.exp(-0.5 * (middle / spread)**2), color=theme.END,
                  label=f"normal, {spread:.2f} sigma wide")
    left.set(xlabel="residual [sigma]", ylabel="points")
    left.legend(loc="upper left")
    left.margins(y=0.25)
    for axis in range(3):
        mine = points["axis"] == axis
        right.scatter(100 * np.abs(points["distance_m"][mine]), points["kernel_weight"][mine], s=2,
                      color=theme.METHODS[axis], linewidths=0, rasterized=True,
                      label=f"axis {axis}, {mine.sum()} points")
    right.set(xlabel="distance to the plane [cm]", ylabel="weight by the kernel", ylim=(0, 1.05))
    right.set_xscale("symlog", linthresh=1.0)
    right.set_xlim(0, None)
    right.legend(markerscale=3)
    return figure


def draw_matrix(graph, width_in):
    """What ties which components: |H| scaled to a unit diagonal, and what holds the newest pose."""
    figure, (left, right) = theme.plt.subplots(1, 2, figsize=(width_in, 0.42 * width_in),
                                               constrained_layout=True)
    whole = graph.total()
    scale = 1.0 / np.sqrt(np.maximum(np.diag(whole), 1e-300))
    with np.errstate(divide="ignore"):
        image = np.log10(np.abs(whole * scale[:, None] * scale[None, :]))
    drawn = left.imshow(np.maximum(image, -4), cmap="viridis", vmin=-4, vmax=0)
    at = np.arange(graph.poses) * 6 + 2.5
    left.set_xticks(at, [f"T{k}" for k in range(graph.poses)])
    left.set_yticks(at, [f"T{k}" for k in range(graph.poses)])
    left.grid(False)
    for line in np.arange(1, graph.poses) * 6 - 0.5:
        left.axhline(line, color="white", lw=0.4)
        left.axvline(line, color="white", lw=0.4)
    figure.colorbar(drawn, ax=left, label="log10 |H|, unit diagonal")
    ways = {"all factors": ((), theme.TEXT), "without the prior": (("prior",), KINDS["prior"]),
            "without motion terms": (("motion",), KINDS["motion"]),
            "points of the window alone": (("prior", "motion"), KINDS["registration"])}
    height = 0.8 / len(ways)
    for i, (name, (without, color)) in enumerate(ways.items()):
        sigmas = graph.newest_sigmas(without)
        right.barh(np.arange(6) + (i - 1.5) * height, 1e3 * np.minimum(sigmas, OPEN), height,
                   left=1e-2, color=color, label=name)
    right.set_yticks(range(6), COMPONENTS)
    right.invert_yaxis()
    right.set_xscale("log")
    right.set(xlabel="standard deviation of the newest pose [mm, mrad]")
    right.legend(loc="upper center", bbox_to_anchor=(0.5, -0.18), ncol=2)
    return figure
