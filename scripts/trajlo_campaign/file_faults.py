# SPDX-License-Identifier: MIT
"""Damage to files. Each fault changes a recording, or a file in place, and says what it did."""
from trajlo_campaign.point_faults import stretch


def some(recording, rng, most=6):
    count = int(rng.integers(1, most))
    return sorted({int(index) for index in rng.integers(0, len(recording), count)})


def listed(what, indices):
    return f"{what}: scans {', '.join(map(str, indices))}"


def flip(data, rng, most):
    data = bytearray(data)
    for _ in range(int(rng.integers(1, most)) if data else 0):
        data[int(rng.integers(len(data)))] ^= int(rng.integers(1, 256))
    return bytes(data)


# Folders of scans.

def missing_files(folder, rng):
    """The stamps stay: there are more of them than scans."""
    indices = some(folder, rng)
    for index in indices:
        folder.files[index].unlink(missing_ok=True)
    folder.gone.update(indices)
    return listed("missing", indices)


def missing_scans(folder, rng):
    """A stretch without scans and without their stamps: a pause."""
    scans = stretch(folder, rng, 25)
    for index in scans:
        folder.files[index].unlink(missing_ok=True)
        folder.lines[index] = None
    folder.gone.update(scans)
    return f"scans {scans[0]} to {scans[-1]} not recorded"


def spoilt(folder, rng, what, change):
    """Some files are what `change` makes of their bytes."""
    indices = some(folder, rng)
    for index in indices:
        folder.write(index, change(folder.read(index)))
    folder.gone.update(indices)
    return listed(what, indices)


def empty_files(folder, rng):
    return spoilt(folder, rng, "zero length", lambda data: b"")


def cut_files(folder, rng):
    return spoilt(folder, rng, "cut", lambda data: data[:int(rng.integers(len(data) + 1))])


def flipped_bytes(folder, rng):
    return spoilt(folder, rng, "bytes flipped", lambda data: flip(data, rng, 200))


def flipped_headers(folder, rng):
    return spoilt(folder, rng, "header bytes flipped",
                  lambda data: flip(data[:200], rng, 6) + data[200:])


def empty_scans(folder, rng):
    indices = some(folder, rng)
    for index in indices:
        folder.edit(index, lambda points: points[:0])
    folder.gone.update(indices)
    return listed("no points", indices)


def frozen(folder, rng):
    """The driver sends the same scan again and again, with new stamps."""
    scans = stretch(folder, rng, 20)
    data = folder.read(scans[0])
    for index in scans[1:]:
        folder.write(index, data)
    return f"the points of scan {scans[0]} until {scans[-1]}"


def swapped_files(folder, rng):
    """Neighbours have each other's points."""
    indices = [index for index in some(folder, rng) if index + 1 < len(folder)]
    for index in indices:
        here, there = folder.read(index), folder.read(index + 1)
        folder.write(index, there)
        folder.write(index + 1, here)
    return listed("swapped with the next", indices)


def renamed_files(folder, rng):
    """Names that sort elsewhere."""
    indices = some(folder, rng, 4)
    for index in indices:
        path = folder.files[index]
        name = str(rng.choice([f"copy of {path.name}", f"{path.stem} (1){path.suffix}",
                               f"{index}{path.suffix}", f"999{path.name}"]))
        if path.is_file():
            folder.files[index] = path.rename(path.with_name(name))
    folder.gone.update(indices)
    return listed("renamed", indices)


def stray_files(folder, rng):
    """Files that are no scans."""
    name = str(rng.choice(["notes.txt", ".000001.pcd", "Thumbs.db", "000000.pcd.part", "a.pcd"]))
    (folder.scans_folder / name).write_bytes(rng.bytes(int(rng.integers(0, 3000))))
    return f"a file {name} among the scans"


def lines_lost(folder, rng):
    """Fewer stamps than scans."""
    indices = some(folder, rng, 3)
    for index in indices:
        folder.lines[index] = None
    return listed("stamps missing", indices)


def lines_garbled(folder, rng):
    index = int(rng.integers(len(folder)))
    folder.lines[index] = str(rng.choice(["", "nan", "-", "1e400", "0x12", "17:03:22", "\0\0\0"]))
    return f"stamp {index} reads {folder.lines[index]!r}"


def no_stamps(folder, rng):
    """The file of stamps is empty or cut."""
    kept = int(rng.choice([0, 1, len(folder) // 2]))
    folder.lines[kept:] = [None] * (len(folder.lines) - kept)
    return f"only {kept} stamps"


def unknown_time_field(folder, _):
    folder.rename_time_field()
    return "the field of times has another name"


FOLDER_FAULTS = (missing_files, missing_scans, missing_scans, empty_files, cut_files,
                 flipped_bytes, flipped_headers, empty_scans, frozen, swapped_files, renamed_files,
                 stray_files, lines_lost, lines_garbled, no_stamps, unknown_time_field)


# Bags and mcap: bytes of the whole file. `path` is no other copy's file when these come.

def cut(path, rng):
    size = path.stat().st_size
    kept = int(size * rng.random()) if rng.random() < 0.7 else size - int(rng.integers(1, 5000))
    path.write_bytes(path.read_bytes()[:kept])
    return f"cut at {100 * kept / size:.2f} %"


def flips(path, rng):
    path.write_bytes(flip(path.read_bytes(), rng, 100))
    return "bytes flipped"


def overwritten(path, rng):
    """A block of zeros or of noise."""
    data, size = bytearray(path.read_bytes()), int(rng.integers(100, 300_000))
    begin = int(rng.integers(len(data)))
    end = min(begin + size, len(data))
    zeros = rng.random() < 0.5
    data[begin:end] = bytes(end - begin) if zeros else rng.bytes(end - begin)
    path.write_bytes(data)
    return f"{end - begin} bytes of {'zeros' if zeros else 'noise'} at {begin}"


def block_lost(path, rng):
    data, size = path.read_bytes(), int(rng.integers(1, 300_000))
    begin = int(rng.integers(len(data)))
    path.write_bytes(data[:begin] + data[begin + size:])
    return f"{size} bytes lost at {begin}"


def spoilt_start(path, rng):
    data = path.read_bytes()
    path.write_bytes(flip(data[:6000], rng, 8) + data[6000:])
    return "bytes flipped at the start"


def spoilt_end(path, rng):
    data = path.read_bytes()
    path.write_bytes(data[:-6000] + flip(data[-6000:], rng, 20))
    return "bytes flipped at the end"


def bytes_appended(path, rng):
    with path.open("ab") as file:
        file.write(rng.bytes(int(rng.integers(1, 5000))))
    return "noise appended"


BYTE_FAULTS = (cut, cut, flips, overwritten, block_lost, spoilt_start, spoilt_end, bytes_appended)
