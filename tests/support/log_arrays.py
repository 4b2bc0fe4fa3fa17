"""A log in files of numpy's and in JSON: times (n,) s, gyro rad/s, accelerometer m/s^2 (n, 3)."""

import json

import numpy as np

NAMES = ["time [s]"] + [
    f"{n}_{a} [{u}]" for n, u in (("gyro", "rad/s"), ("accel", "m/s^2")) for a in "xyz"
]
"""A recording's own, in the order of the numbers below."""

BARE = ["t", *(f"{n}{a}" for n in ("gyr", "acc") for a in "XYZ")]


def numbers(log):
    return np.column_stack(log)


def table(folder, log):
    np.save(folder / "table.npy", numbers(log))
    return folder / "table.npy"


def samples_along_rows(folder, log):
    np.save(folder / "rows.npy", np.asfortranarray(numbers(log).T))
    return folder / "rows.npy"


def records(folder, log):
    found = np.zeros(len(log[0]), [("stamp", "M8[ns]"), ("gyro", "f8", 3), ("acc", ">f8", 3)])
    start = np.datetime64("2024-03-01T10:00:00", "ns")
    found["stamp"] = start + np.rint(log[0] * 1e9).astype("m8[ns]")
    found["gyro"], found["acc"] = log[1:]
    np.save(folder / "records.npy", found)
    return folder / "records.npy"


def arrays(folder, log):
    np.savez_compressed(folder / "arrays.npz", gyro=log[1], accel=log[2], fs=100.0, who="me")
    return folder / "arrays.npz"


def arrays_with_dates(folder, log):
    start = np.datetime64("2024-03-01T10:00:00", "us")
    stamps = start + np.rint(log[0] * 1e6).astype("m8[us]")
    np.savez(folder / "dates.npz", t=stamps, gyr=log[1], acc=log[2])
    return folder / "dates.npz"


def named_columns(folder, log):
    np.savez(folder / "named.npz", data=numbers(log), columns=NAMES)
    return folder / "named.npz"


def as_json(path, data):
    path.write_text(json.dumps(data))
    return path


def edge_impulse(folder, log):
    kinds = [("acc", "m/s2"), ("gyr", "rad/s")]
    sensors = [{"name": n + a, "units": u} for n, u in kinds for a in "XYZ"]
    values = np.hstack([log[2], log[1]]).tolist()
    payload = {"device_type": "X", "interval_ms": 10, "sensors": sensors, "values": values}
    return as_json(folder / "edge.json", {"protected": {"ver": "v1"}, "payload": payload})


def frame_split(folder, log):
    data = {"columns": BARE, "index": list(range(len(log[0]))), "data": numbers(log).tolist()}
    return as_json(folder / "split.json", data)


def frame_of_columns(folder, log):
    columns = {n: {str(k): v for k, v in enumerate(c)} for n, c in zip(BARE, numbers(log).T)}
    return as_json(folder / "columns.json", columns)


def names_first(folder, log):
    return as_json(folder / "lists.json", [BARE, *numbers(log).tolist()])


def within_an_object(folder, log):
    lists = dict(zip(BARE, numbers(log).T.tolist(), strict=True))
    return as_json(folder / "within.json", {"device": "x", "imu": lists})


def texts(folder, log):
    rows = [[f"10:00:{row[0]:09.6f}", *map(repr, row[1:])] for row in numbers(log).tolist()]
    return as_json(folder / "texts.json", [dict(zip(BARE, r, strict=True), who="me") for r in rows])


def of_kinds(folder, log):
    """Sensor Logger's JSON, in which each sample says whose it is."""
    rows = []
    for t, w, f in zip(*(part.tolist() for part in log), strict=True):
        for name, vector in (("TotalAcceleration", f), ("Gyroscope", w)):
            stamp = {"time": str(17 * 10**17 + round(1e9 * t))}
            rows.append({"sensor": name} | stamp | dict(zip("xyz", map(str, vector), strict=True)))
    return as_json(folder / "kinds.json", rows)


ARRAYS = (table, samples_along_rows, records, arrays, arrays_with_dates, named_columns)
JSONS = (edge_impulse, frame_split, frame_of_columns, names_first, within_an_object, texts)
JSONS += (of_kinds,)
ALONE = (named_columns, edge_impulse)
"""Those that are read as they are; the others need a map of their own."""
