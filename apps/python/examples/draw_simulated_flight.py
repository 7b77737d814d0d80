# SPDX-License-Identifier: MIT
"""Simulates a flight through a hall, estimates it, and draws path, error and map.

  python apps/python/examples/draw_simulated_flight.py flight.png
Needs matplotlib: pip install '.[examples]'.
"""
import argparse

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import trajlo


def estimate(simulation):
    odometry = trajlo.Odometry({**simulation.options, "window.segments": 4})
    for scan in simulation:
        odometry.add(scan)
    odometry.finish()
    return odometry


def draw(odometry, result, path):
    figure, (plan, errors) = plt.subplots(1, 2, figsize=(10, 4), layout="constrained")
    map_points, positions = odometry.map, odometry.trajectory.positions
    # A slice at the height of the sensor shows walls and not the floor.
    near = np.abs(map_points[:, 2] - np.median(positions[:, 2])) < 1.0
    plan.scatter(*map_points[near, :2].T, s=0.2, color="0.6", label="map")
    # The truth in the frame of the estimate: both begin at the first pair.
    aligned, truth = result["errors"]["T_world_body"], result["errors"]["T_world_truth"]
    odometry_from_world = odometry.trajectory.poses[0] @ np.linalg.inv(aligned[0])
    truth_there = odometry_from_world @ truth
    plan.plot(*truth_there[:, :2, 3].T, color="black", linewidth=5, alpha=0.3, label="truth")
    plan.plot(*positions[:, :2].T, color="tab:blue", label="estimate")
    plan.set(xlabel="x [m]", ylabel="y [m]", aspect="equal")
    plan.legend(loc="lower right", markerscale=10)
    t_ns = result["errors"]["t_ns"]
    errors.plot(1e-9 * (t_ns - t_ns[0]), 1000 * result["errors"]["translation_m"])
    errors.set(xlabel="time [s]", ylabel="position error [mm]")
    figure.savefig(path, dpi=150)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("figure", help="PNG, SVG or PDF to write")
    parser.add_argument("--scenario", default="hall_os1_16", help="see trajlo.scenarios()")
    parser.add_argument("--seconds", type=float, default=10.0)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()

    simulation = trajlo.simulate(arguments.scenario, seed=arguments.seed,
                                 duration_s=arguments.seconds)
    odometry = estimate(simulation)
    result = trajlo.evaluate(odometry.trajectory, simulation.truth)
    windows = odometry.windows
    busy_ms = sum(windows[name].sum() for name in windows if name.endswith("_ms"))
    print(f"{len(windows['index'])} windows, {np.mean(windows['inlier_share']):.0%} inliers, "
          f"{busy_ms / 1000:.1f} s of computing")
    print(f"position RMSE {1000 * result['ate']['translation_m']['rmse']:.1f} mm")
    draw(odometry, result, arguments.figure)


if __name__ == "__main__":
    main()
