# SPDX-License-Identifier: MIT
"""Faults that trajlo_simulate applies itself: each draws parameters for --set."""


def share(rng, low, high):
    return round(float(rng.uniform(low, high)), 4)


def logarithmic(rng, low, high):
    """Between two bounds, small ones as often as large ones."""
    return float(f"{low * (high / low) ** rng.random():.3g}")


def lost_scans(_, rng):
    return {"faults.dropped_scan_fraction": share(rng, 0.02, 0.4)}


def scans_twice(_, rng):
    return {"faults.repeated_scan_fraction": share(rng, 0.02, 0.4)}


def nan_points(_, rng):
    return {"faults.nan_point_fraction": share(rng, 0.01, 0.7)}


def repeated_stamps(_, rng):
    return {"faults.duplicate_stamp_fraction": share(rng, 0.02, 0.3)}


def backward_stamps(_, rng):
    return {"faults.backward_stamp_fraction": share(rng, 0.02, 0.25),
            "faults.backward_step_s": logarithmic(rng, 0.001, 1.0)}


def stamp_jitter(_, rng):
    return {"faults.stamp_jitter_s": logarithmic(rng, 1e-4, 0.01)}


def silence(scene, rng):
    """A LiDAR says nothing for a while: a pause, if it is the only one. It has the last word, so
    that nothing but a pause is asked for: nobody can know what a recording that ends leaves out."""
    begin = share(rng, 0.5, scene.duration_s - 0.5)
    lidar = int(rng.integers(scene.lidars))
    until = min(begin + logarithmic(rng, 0.2, 3.0), scene.duration_s - 0.25)
    return {"faults.silent_lidar": lidar, "faults.silent_from_s": begin,
            "faults.silent_until_s": round(until, 3)}


def dropouts(_, rng):
    """Few rays come back."""
    return {"lidar.dropout_fraction": share(rng, 0.3, 0.98)}


def noisy_ranges(_, rng):
    return {"lidar.range_sigma_m": logarithmic(rng, 0.03, 0.2)}


def short_sight(_, rng):
    """Fog: nothing is seen from afar."""
    return {"lidar.max_range_m": logarithmic(rng, 3.0, 30.0)}


def clock_offset(scene, rng):
    """The clock of the last LiDAR is off: by little, or wholly."""
    offset = logarithmic(rng, 0.001, 0.05) if rng.random() < 0.7 else \
        float(rng.choice([0.3, 3.0, 3600.0, 86400.0]))
    return {f"lidar{scene.lidars - 1}.clock_offset_s": offset * float(rng.choice([-1.0, 1.0]))}


FAULTS = (lost_scans, scans_twice, nan_points, repeated_stamps, backward_stamps, stamp_jitter,
          silence, dropouts, noisy_ranges, short_sight, clock_offset)


def clocks_ns(parameters):
    """What these parameters add to the time of a recording as a whole."""
    return [round(value * 1e9) for key, value in parameters if key == "lidar0.clock_offset_s"]
