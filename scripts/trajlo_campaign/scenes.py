# SPDX-License-Identifier: MIT
"""The eight short recordings of a campaign: scenes, sensors and motions that differ."""
import dataclasses
import pathlib
import shutil
import subprocess

from trajlo_campaign.message_file import bag_to_mcap


class CampaignError(Exception):
    """The campaign cannot be run as it was asked for."""


@dataclasses.dataclass(frozen=True)
class Scene:
    name: str
    scenario: str
    duration_s: float
    formats: tuple
    lidars: int = 1
    parameters: tuple = ()  # of (key, value), for trajlo_simulate --set


FORMATS = ("pcd", "bag", "lz4", "bz2", "mcap")
FEWER_COLUMNS = (("lidar.columns", 512),)
SCENES = (
    Scene("hall", "hall_os1_16", 6.0, FORMATS),
    Scene("office", "office_os0_64", 6.0, FORMATS),
    Scene("corridor", "corridor_vlp16", 6.0, FORMATS),
    Scene("courtyard", "courtyard_os1_16", 7.0, FORMATS),
    Scene("street", "street_hdl64", 5.0, FORMATS, parameters=FEWER_COLUMNS),
    Scene("square", "square_os1_16x2", 6.0, FORMATS, lidars=2),
    Scene("swing", "swing_avia", 5.0, FORMATS),
    Scene("kitti", "street_kitti", 5.0, ("pcd",), parameters=FEWER_COLUMNS),
)


def simulate(program, scene, kind, folder, faults=()):
    """The recording of a scene in a new folder, as scans (pcd), a bag, or messages in mcap."""
    command = [program, f"--scenario={scene.scenario}", f"--duration_s={scene.duration_s}",
               f"--output={folder}", "--threads=1",
               f"--format={'pcd' if kind == 'pcd' else 'bag'}"]
    if kind in ("lz4", "bz2"):
        command.append(f"--bag_compression={kind}")
    parameters = scene.parameters + tuple(faults)
    if parameters:
        command.append(f"--set={','.join(f'{key}={value}' for key, value in parameters)}")
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise CampaignError(f"{scene.name} could not be simulated: {done.stderr.strip()}")
    if kind == "mcap":
        bag = pathlib.Path(folder) / "recording.bag"
        bag_to_mcap(bag, bag.with_suffix(".mcap"))
        bag.unlink()


def copy(base, folder):
    """A copy that shares the files; whoever changes one must replace it."""
    shutil.copytree(base, folder, copy_function=_link)


def _link(source, target):
    pathlib.Path(target).hardlink_to(source)


def inputs(scene, kind, folder):
    """What --input names."""
    folder = pathlib.Path(folder)
    if kind == "mcap":
        return [folder / "recording.mcap"]
    if kind != "pcd":
        return [folder / "recording.bag"]
    if scene.lidars > 1:
        return [folder / f"lidar{index}" for index in range(scene.lidars)]
    return [folder]
