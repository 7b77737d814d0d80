# SPDX-License-Identifier: MIT
"""Makes the damaged recording of a run."""
import dataclasses

from trajlo_campaign import scenes, simulator_faults
from trajlo_campaign.message_file import open_messages
from trajlo_campaign.scan_folder import ScanFolder

START_NS = 1_700_000_000_000_000_000  # of all simulated recordings


@dataclasses.dataclass
class Prepared:
    """clocks_ns: what clocks of the recording add to the true time. last_scan_s: from the start to
    the beginning of the last scan that is not gone."""
    inputs: list
    said: list
    clocks_ns: list
    first_scan_s: float
    last_scan_s: float


def base_clock_ns(scene):
    """Motion-corrected scans are written as KITTI does it, with times from zero on."""
    return -START_NS if scene.name == "kitti" else 0


def open_recordings(scene, kind, folder, clock_ns):
    """One for each LiDAR; `clock_ns` is what the clock of the first one adds to the true time."""
    inputs = scenes.inputs(scene, kind, folder)
    if kind == "pcd":
        return [ScanFolder(path, clock_ns) for path in inputs]
    return open_messages(inputs[0], clock_ns)


def simulated_parameters(drawn):
    parameters = {}
    for fault in drawn.of("simulator"):
        parameters.update(fault.function(drawn.scene, fault.rng()))
    return tuple(parameters.items())


def damage(drawn, folder, prepared):
    """Stamps, points and files of a recording that can be edited."""
    edits = drawn.of("stamps") + drawn.of("points") + drawn.of("folder")
    if not edits:
        return
    recordings = open_recordings(drawn.scene, drawn.kind, folder, prepared.clocks_ns[-1])
    for fault in edits:
        said = fault.function(recordings[fault.lidar], fault.rng())
        prepared.said.append(f"{said}{f' of LiDAR {fault.lidar}' if fault.lidar else ''}")
    for recording in recordings if drawn.kind == "pcd" else recordings[:1]:
        recording.save()
    prepared.clocks_ns += [clock for recording in recordings for clock in recording.clocks_ns]
    left = [index for recording in recordings
            for index in range(len(recording)) if index not in recording.gone]
    prepared.first_scan_s = 0.1 * min(left, default=0)
    prepared.last_scan_s = 0.1 * max(left, default=0)


def prepare(drawn, simulator, base, folder):
    """The recording of a run in a new folder: a copy of the one in `base`, or a new one if the
    simulator has to make its faults."""
    parameters = simulated_parameters(drawn)
    if parameters:
        scenes.simulate(simulator, drawn.scene, drawn.kind, folder, parameters)
    else:
        scenes.copy(base, folder)
    prepared = Prepared(
        scenes.inputs(drawn.scene, drawn.kind, folder),
        [f"{key.removeprefix('faults.')}={value}" for key, value in parameters],
        [base_clock_ns(drawn.scene)], 0.0, drawn.scene.duration_s - 0.1)
    prepared.clocks_ns += [base_clock_ns(drawn.scene) + clock
                           for clock in simulator_faults.clocks_ns(parameters)]
    damage(drawn, folder, prepared)
    if drawn.of("bytes"):
        own_file(prepared.inputs[0])
    for fault in drawn.of("bytes"):
        prepared.said.append(fault.function(prepared.inputs[0], fault.rng()))
    return prepared


def own_file(path):
    """No longer shared with other copies."""
    data = path.read_bytes()
    path.unlink()
    path.write_bytes(data)
