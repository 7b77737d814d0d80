# SPDX-License-Identifier: MIT
"""Data sets that look like the public ones when they are unpacked: names, topics, messages, stamps,
frames of the truth. Their contents are simulated, so that errors must be small."""
import subprocess

import numpy as np
import yaml
from bag_writer import livox_message, ouster_cloud, pose_stamped, write_bag

# KITTI's vertical angles are too low by this.
VERTICAL_ERROR_RAD = np.radians(0.205)
# From coordinates of the Velodyne to those of camera 0, as in a calib.txt (sequence 04 and later).
KITTI_TR = np.array([
    [-1.857739385241e-03, -9.999659513510e-01, -8.039975204516e-03, -4.784029760483e-03],
    [-6.481465826011e-03, 8.051860151134e-03, -9.999466081774e-01, -7.337429464231e-02],
    [9.999773098287e-01, -1.805528627661e-03, -6.496203536139e-03, -3.339968064433e-01],
    [0, 0, 0, 1]])
NTU_PRISM = np.array([-0.293656, -0.012288, -0.273095])
# Of Hilti's evaluation script.
HILTI_POINTS = {"prism": np.array([-0.00594496, -0.00721288, 0.272943]),
                "pole": np.array([-0.00938425, -0.0148401, 1.66722]), "imu": np.zeros(3)}


def simulate(program, folder, scenario, duration_s, seed=1, **parameters):
    pairs = ",".join(f"{key.replace('__', '.')}={value}" for key, value in parameters.items())
    command = [program, f"--scenario={scenario}", f"--output={folder}", f"--seed={seed}",
               f"--duration_s={duration_s}", *([f"--set={pairs}"] if pairs else [])]
    subprocess.run(command, check=True, capture_output=True)
    return folder


def read_scan(path):
    """Positions (m) and times (ns since the stamp) of a simulated .pcd."""
    header, _, data = path.read_bytes().partition(b"DATA binary\n")
    names = header.decode().split("FIELDS ")[1].split("\n")[0].split()
    values = np.frombuffer(data, "<f4").reshape(-1, len(names))
    times = np.rint(values[:, names.index("time")].astype(float) * 1e9).astype("<u4")
    return values[:, :3], times


def scans(folder):
    """(stamp of the sweep's start in ns, positions, times) of one LiDAR."""
    stamps = [int(line.replace(".", "")) for line in
              (folder / "timestamps.txt").read_text().split()]
    for stamp, path in zip(stamps, sorted((folder / "scans").iterdir())):
        yield (stamp, *read_scan(path))


def rotations(quaternions):
    """Matrices of rows qx qy qz qw."""
    x, y, z, w = quaternions.T
    rows = [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]
    return np.moveaxis(np.array(rows), 2, 0)


def poses(folder):
    """Times (ns) and poses (4x4) of the body, at 1 kHz."""
    lines = (folder / "truth.tum").read_text().splitlines()
    times = np.array([int(line.split()[0].replace(".", "")) for line in lines])
    values = np.array([line.split()[1:] for line in lines], dtype=float)
    found = np.tile(np.eye(4), (len(values), 1, 1))
    found[:, :3, :3], found[:, :3, 3] = rotations(values[:, 3:]), values[:, :3]
    return times, found


def make_kitti(program, work, downloads, name="04", duration_s=12.5, **parameters):
    """dataset/sequences/NN and dataset/poses/NN.txt as the benchmark's archives unpack."""
    folder = simulate(program, work / name, "street_kitti", duration_s, start_time_ns=0,
                      **parameters)
    sequence = downloads / "dataset" / "sequences" / name
    (sequence / "velodyne").mkdir(parents=True)
    for path in (folder / "velodyne").iterdir():
        points = np.fromfile(path, "<f4").reshape(-1, 4)
        x, y, z = points[:, :3].T
        level = np.hypot(x, y)
        c, s = np.cos(VERTICAL_ERROR_RAD), np.sin(VERTICAL_ERROR_RAD)
        scale = c + s * z / level
        low = np.stack([x * scale, y * scale, c * z - s * level, points[:, 3]], axis=1)
        low.astype("<f4").tofile(sequence / "velodyne" / path.name)
    stamps = np.array((folder / "times.txt").read_text().split(), dtype=float)
    (sequence / "times.txt").write_text("".join(f"{t - stamps[0]:e}\n" for t in stamps))
    rows = {"P0": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0], "Tr": KITTI_TR[:3].flat}
    (sequence / "calib.txt").write_text("".join(
        f"{key}: {' '.join(f'{value:.12e}' for value in row)}\n" for key, row in rows.items()))
    times, T_world_lidar = poses(folder)
    at = T_world_lidar[[np.argmin(np.abs(times - round(t * 1e9))) for t in stamps]]
    T_camera0_camera = KITTI_TR @ np.linalg.inv(at[0]) @ at @ np.linalg.inv(KITTI_TR)
    (downloads / "dataset" / "poses").mkdir(exist_ok=True)
    (downloads / "dataset" / "poses" / f"{name}.txt").write_text("".join(
        " ".join(f"{value:.6e}" for value in T[:3].flat) + "\n" for T in T_camera0_camera))


def turned(positions):
    """In the frame of an instrument that stands somewhere and looks elsewhere."""
    c, s = np.cos(2.0), np.sin(2.0)
    return (positions - positions[0]) @ np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]).T


def make_ntu_viral(program, work, downloads, name="eee_01", duration_s=4, seed=1,
                   rotation=(0.0, 0.0, 0.0, 1.0)):
    """NAME/NAME.bag: sweeps with the stamps of their ends, the prism at 20 Hz."""
    folder = simulate(program, work / name, "hall_os1_16x2", duration_s, seed)
    messages = []
    for number in (0, 1):
        for stamp, xyz, t_ns in scans(folder / f"lidar{number}"):
            end = stamp + 100_000_000
            messages.append((f"/os1_cloud_node{number + 1}/points", "sensor_msgs/PointCloud2",
                             end + 2_000_000,
                             ouster_cloud(end, "sensor", xyz, t_ns)))
    times, T_world_body = poses(folder)
    prism = turned(T_world_body[:, :3, :3] @ NTU_PRISM + T_world_body[:, :3, 3])
    for index in range(7, len(times), 50):
        messages.append(("/leica/pose/relative", "geometry_msgs/PoseStamped",
                         times[index] + 3_000_000,
                         pose_stamped(int(times[index]), "map", prism[index], rotation)))
    write_bag(downloads / name / f"{name}.bag", messages)


def transform(quaternion, translation):
    T = np.eye(4)
    T[:3, :3], T[:3, 3] = rotations(np.array([quaternion]))[0], translation
    return T


# How the sensors of the Hilti look-alike sit in the frame of its IMU: half turns. Its points are
# those of os_sensor, which calibration_02.yaml places on os_lidar.
IMU_OS_LIDAR = ([0.6, 0.8, 0.0, 0.0], [-0.01, 0.02, -0.09])
OS_LIDAR_OS_SENSOR = ([0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.036])
T_IMU_OUSTER = transform(*IMU_OS_LIDAR) @ transform(*OS_LIDAR_OS_SENSOR)
IMU_LIVOX = ([0.8, -0.6, 0.0, 0.0], (T_IMU_OUSTER @ [0.06, 0.0, -0.09, 1.0])[:3].tolist())


def hilti_calibration():
    placed = {"os_lidar": IMU_OS_LIDAR, "os_sensor": OS_LIDAR_OS_SENSOR, "livox_frame": IMU_LIVOX}
    return yaml.safe_dump({"sensors": {
        name: {"extrinsics": {"quaternion": quaternion, "translation": translation}}
        for name, (quaternion, translation) in placed.items()}})


def make_hilti2021(program, work, downloads, name, kind, duration_s=5, seed=1):
    """NAME.bag and NAME_KIND.txt: the IMU at 120 Hz with stamps of two decimals, or a prism or the
    tip of a pole here and there, without rotations."""
    folder = simulate(program, work / name, "construction_site_hilti", duration_s, seed)
    messages = []
    for stamp, xyz, t_ns in scans(folder / "lidar0"):
        messages.append(("/os_cloud_node/points", "sensor_msgs/PointCloud2", stamp + 104_000_000,
                         ouster_cloud(stamp, "os_sensor", xyz, t_ns)))
    for stamp, xyz, t_ns in scans(folder / "lidar1"):
        messages.append(("/livox/lidar", "livox_ros_driver/CustomMsg", stamp + 104_000_000,
                         livox_message(stamp, "livox_frame", xyz, t_ns)))
    write_bag(downloads / f"{name}.bag", messages)
    times, T_world_ouster = poses(folder)
    T_world_imu = T_world_ouster @ np.linalg.inv(T_IMU_OUSTER)
    every = 8 if kind == "imu" else 610
    lines = []
    for index in range(200, len(times), every):
        stamp = round(times[index] * 1e-9, 2)
        T = T_world_imu[np.argmin(np.abs(times - round(stamp * 1e9)))]
        at = T[:3, :3] @ HILTI_POINTS[kind] + T[:3, 3]
        q = quaternion_of(T[:3, :3]) if kind == "imu" else (0, 0, 0, 1)
        at = at + [1000, 1000, 100] if kind != "imu" else at
        lines.append(" ".join(f"{value:.12g}" for value in (stamp, *at, *q)) + "\n")
    (downloads / f"{name}_{kind}.txt").write_text("".join(lines))
    (downloads / "calibration_02.yaml").write_text(hilti_calibration())


def quaternion_of(R):
    """qx qy qz qw, by the eigenvector that belongs to the largest eigenvalue."""
    K = np.array([
        [R[0, 0] - R[1, 1] - R[2, 2], R[1, 0] + R[0, 1], R[2, 0] + R[0, 2], R[2, 1] - R[1, 2]],
        [0, R[1, 1] - R[0, 0] - R[2, 2], R[2, 1] + R[1, 2], R[0, 2] - R[2, 0]],
        [0, 0, R[2, 2] - R[0, 0] - R[1, 1], R[1, 0] - R[0, 1]], [0, 0, 0, np.trace(R)]])
    return np.linalg.eigh(K, UPLO="U")[1][:, -1]


def make_pointlio(program, work, downloads, duration_s=4):
    """A swung and a spun Livox Avia, bags without truth."""
    for name, scenario in (("pendulum", "swing_avia"), ("outdoor_spinning", "spin_avia")):
        folder = simulate(program, work / name, scenario, duration_s)
        write_bag(downloads / f"{name}.bag",
                  [("/livox/lidar", "livox_ros_driver/CustomMsg", stamp + 104_000_000,
                    livox_message(stamp, "livox_frame", xyz, t_ns))
                   for stamp, xyz, t_ns in scans(folder)])
