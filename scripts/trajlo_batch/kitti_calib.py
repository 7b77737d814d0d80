# SPDX-License-Identifier: MIT
"""The calibration of KITTI's odometry benchmark."""
import pathlib

import numpy as np

from trajlo_batch.yaml_lines import SuiteError


def camera_in_lidar(path):
    """The pose of camera 0 in the LiDAR's frame, 3x4: the inverse of the row `Tr` of calib.txt,
    which maps LiDAR coordinates into those of the camera. The full inverse, as `Tr` is not
    orthonormal to the last digit."""
    for line in pathlib.Path(path).read_text().splitlines():
        words = line.replace(":", " ").split()
        if words and words[0] == "Tr" and len(words) == 13:
            Tr = np.vstack([np.array(words[1:], dtype=float).reshape(3, 4), [0, 0, 0, 1]])
            return np.linalg.inv(Tr)[:3]
    raise SuiteError(f"{path} has no row Tr with 12 numbers")
