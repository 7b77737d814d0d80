#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""trajlo beside KISS-ICP and MAD-ICP, on simulated recordings with exact truth.

  python3 -m venv peers && peers/bin/pip install scipy pyyaml kiss-icp
  peers/bin/python scripts/compare_peers.py --output runs/peers
simulates the scenes, runs trajlo and each peer that this Python can import, one thread each, and
prints a table (Markdown): position RMSE in metres after SE(3) alignment, and seconds of CPU of the
whole process. What is already in the folder is not made again.
  peers/bin/python scripts/compare_peers.py --output runs/peers --scenarios office_os0_64 --seeds 1 2
one scene with two seeds: the median of the errors, and the mean of the times.

All run with the options they come with; KISS-ICP's voxels are a hundredth of its range, 1 m, which
is wide for rooms: --kiss_icp_voxel_m gives others. The peers have one pose a scan and do not say
for when: the best of its begin, middle and end counts. MAD-ICP is built from source:
  peers/bin/pip install "scikit-build-core<0.10" pybind11 "cmake<4" ninja
  peers/bin/pip install --no-build-isolation mad-icp
"""
import importlib.util
import json
import pathlib
import resource
import subprocess
import sys

import numpy as np
import yaml
from scipy.spatial.transform import Rotation

from trajlo_batch import command_line
from trajlo_batch.places import identify, programs_in
from trajlo_batch.yaml_lines import SuiteError
from trajlo_campaign import point_arrays
from trajlo_report.files import make_folder

SCENARIOS = ("office_os0_64", "hall_os1_16", "courtyard_os1_16", "corridor_vlp16", "forest_mid360",
             "bursts_xt32", "car_park_os1_128", "manhattan_hdl32", "motorway_start_hdl64")
PEERS = {"kiss_icp": "KISS-ICP", "mad_icp": "MAD-ICP"}
# At which share of its scan a pose is taken to be.
TIMES_IN_SCAN = {"begin": 0.0, "middle": 0.5, "end": 1.0}
MIN_RANGE_M = 0.1


def read_scan(path):
    """Points in the LiDAR frame (n x 3, m), and their times since the first of them (s)."""
    _, scan = point_arrays.read_pcd(path.read_bytes())
    points = np.stack([scan[axis] for axis in "xyz"], axis=1).astype(float)
    times_s = scan[point_arrays.time_field(scan)].astype(float)
    usable = np.isfinite(points).all(axis=1) & (np.linalg.norm(points, axis=1) > MIN_RANGE_M)
    points, times_s = points[usable], times_s[usable]
    return points, times_s - times_s.min(initial=np.inf)


def kiss_icp_poses(scans, _, voxel_m):
    from kiss_icp.config.parser import load_config
    from kiss_icp.kiss_icp import KissICP
    config = load_config(None)
    # The default is what its command does where no voxel size is given.
    config.mapping.voxel_size = voxel_m or config.data.max_range / 100.0
    config.registration.max_num_threads = 1
    odometry = KissICP(config)
    for points, times_s in scans:
        if len(points):
            odometry.register_frame(points, times_s / max(times_s.max(), 1e-9))
        yield odometry.last_pose.copy()


def mad_icp_poses(scans, period_s, _):
    from mad_icp.src.pybind.pypeline import Pipeline, VectorEigen3d
    # The parameters of its file params.cfg, and one thread.
    pipeline = Pipeline(1.0 / period_s, True, 0.2, 0.1, 0.8, 0.1, 0.02, 4, 1, False)
    for number, (points, _) in enumerate(scans):
        if len(points):
            pipeline.compute(number * period_s, VectorEigen3d(points))
        yield np.array(pipeline.currentPose())


def write_poses(path, stamps_s, T_world_lidar, T_body_lidar):
    """Poses of the body in TUM's format."""
    T_lidar_body = np.linalg.inv(T_body_lidar)
    with path.open("w") as output:
        for stamp_s, pose in zip(stamps_s, T_world_lidar):
            T = T_body_lidar @ pose @ T_lidar_body
            numbers = [*T[:3, 3], *Rotation.from_matrix(T[:3, :3]).as_quat()]
            output.write(f"{stamp_s:.9f} " + " ".join(f"{x:.9f}" for x in numbers) + "\n")


def read_extrinsic(rig):
    """T_body_lidar of the first LiDAR, from the rig.yaml that the simulator writes."""
    pose = yaml.safe_load(rig.read_text())["sensor"]["T_body_lidar"][0]
    T = np.eye(4)
    T[:3, :3] = Rotation.from_quat(pose["rotation"]).as_matrix()
    T[:3, 3] = pose["translation_m"]
    return T


def follow(peer, recording, output, voxel_m):
    """Runs a peer over a recording, and writes its poses once for each time that they may have."""
    stamps_s = np.array([float(t) for t in (recording / "timestamps.txt").read_text().split()])
    files = sorted((recording / "scans").glob("*.pcd"))
    period_s = float(np.median(np.diff(stamps_s)))
    poses_of = {"kiss_icp": kiss_icp_poses, "mad_icp": mad_icp_poses}[peer]
    poses = list(poses_of((read_scan(file) for file in files), period_s, voxel_m))
    for name, share in TIMES_IN_SCAN.items():
        write_poses(output / f"{name}.tum", stamps_s + share * period_s, poses,
                    read_extrinsic(recording / "rig.yaml"))


def cpu_of(command, log):
    """Seconds of CPU that a command takes, and its exit code."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    with log.open("w") as output:
        code = subprocess.run([str(x) for x in command], stdout=output,
                              stderr=subprocess.STDOUT).returncode
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, code


def error_of(programs, poses, truth, folder):
    # Its warnings are about attitudes and clocks, which the table does not compare.
    done = subprocess.run([programs / "trajlo_evaluate", poses, truth, "-o", folder, "--overwrite",
                           "--noreport"], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                          text=True)
    if done.returncode != 0:
        raise SuiteError(f"{poses} is not evaluated: {done.stderr.strip()}")
    estimate = json.loads((folder / "evaluation.json").read_text())["estimates"][0]
    return estimate["ate"]["translation_m"]["rmse"]


def run_one(method, programs, recording, folder, voxel_m):
    """{"rmse_m", "cpu_s"} of a method on a recording, or {"failed": exit code}; kept in a file."""
    kept = folder / "numbers.json"
    if kept.exists():
        return json.loads(kept.read_text())
    make_folder(folder)
    if method == "trajlo":
        command = [programs / "trajlo_run", recording, "-c", recording / "rig.yaml", "-o",
                   folder / "result", "--threads=1", "--noview", "--overwrite"]
        trajectories = [folder / "result" / "trajectory.tum"]
    else:
        command = [sys.executable, __file__, "--follow", method, recording, folder, voxel_m]
        trajectories = [folder / f"{name}.tum" for name in TIMES_IN_SCAN]
    cpu_s, code = cpu_of(command, folder / "log.txt")
    if code:
        return {"failed": code}
    truth = recording / "truth.tum"
    numbers = {"cpu_s": cpu_s,
               "rmse_m": min(error_of(programs, t, truth, folder / "evaluation")
                             for t in trajectories)}
    kept.write_text(json.dumps(numbers))
    return numbers


def cell(runs):
    """The median error and the mean time of the runs of one method on one scenario."""
    failed = [run["failed"] for run in runs if "failed" in run]
    if failed:
        return f"exit {failed[0]} |"
    return (f"{np.median([run['rmse_m'] for run in runs]):.4f} | "
            f"{np.mean([run['cpu_s'] for run in runs]):.1f}")


def main():
    if sys.argv[1:2] == ["--follow"]:
        peer, recording, output, voxel_m = sys.argv[2:]
        follow(peer, pathlib.Path(recording), pathlib.Path(output), float(voxel_m))
        return 0
    parser = command_line.Parser(description=__doc__)
    command_line.add_build_argument(parser)
    parser.add_argument("--output", type=pathlib.Path, required=True,
                        help="recordings and results: a folder for each scenario and seed")
    parser.add_argument("--seeds", type=int, nargs="+", default=[1],
                        help="of the simulated recordings; default: 1")
    parser.add_argument("--scenarios", nargs="+", default=SCENARIOS,
                        help=f"of one LiDAR (trajlo_simulate --list); default: "
                             f"{', '.join(SCENARIOS)}")
    parser.add_argument("--kiss_icp_voxel_m", type=float, default=0.0,
                        help="in place of KISS-ICP's default")
    return command_line.guarded(parser, compare)


def simulate(programs, scenario, seed, recording):
    if (recording / "truth.tum").exists():
        return
    done = subprocess.run([programs / "trajlo_simulate", scenario, f"--seed={seed}", "-o", recording,
                           "--overwrite"], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                          text=True, check=False)
    if done.returncode:
        raise SuiteError(f"{scenario} with seed {seed} is not simulated: {done.stderr.strip()}")


def compare(arguments):
    programs = programs_in(arguments.build.resolve())
    for name in ("trajlo_simulate", "trajlo_run", "trajlo_evaluate"):
        identify(programs / name)  # refuses one that is missing
    peers = [name for name in PEERS if importlib.util.find_spec(name)]
    if not peers:
        raise SuiteError(f"{sys.executable} can import none of {', '.join(PEERS)}; --help says how "
                         "to install them")
    print("| scenario | trajlo RMSE [m] | CPU [s] |" +
          "".join(f" {PEERS[name]} RMSE [m] | CPU [s] |" for name in peers))
    print("|---|" + "---|---|" * (1 + len(peers)))
    for scenario in arguments.scenarios:
        runs = {method: [] for method in ["trajlo", *peers]}
        for seed in arguments.seeds:
            folder = arguments.output / f"{scenario}-s{seed}"
            recording = folder / "recording"
            simulate(programs, scenario, seed, recording)
            for method, of_method in runs.items():
                voxel_m = arguments.kiss_icp_voxel_m if method == "kiss_icp" else 0.0
                name = f"{method}_{voxel_m:g}m" if voxel_m else method
                of_method.append(run_one(method, programs, recording, folder / name, voxel_m))
        print(f"| `{scenario}` | " + " | ".join(cell(of_method) for of_method in runs.values()) +
              " |", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
