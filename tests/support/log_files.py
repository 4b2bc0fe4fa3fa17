"""Writers of the same log in every format that is read, by the libraries of the formats
themselves.
"""

import gzip
from itertools import zip_longest

import numpy as np
import pandas as pd
from scipy.io import savemat

AXES = "xyz"
FIRST = 1_700_000_000_123_456_789
"""ns; a Unix time that float64 cannot hold."""

MAP = """[columns]
"imu/t" = "time [ns]"
"imu/gyro[0]" = "gyro_x [rad/s]"
"imu/gyro[1]" = "gyro_y [rad/s]"
"imu/gyro[2]" = "gyro_z [rad/s]"
"imu/acc[0]" = "accel_x [m/s^2]"
"imu/acc[1]" = "accel_y [m/s^2]"
"imu/acc[2]" = "accel_z [m/s^2]"
"imu/temp" = "temperature [degC]"
"""


def arrays(n=300, seed=1):
    """Times (n,) ns, gyro and accel (n, 3), temperature (n,): numbers with all their bits, steps of
    1 ms and some ns.
    """
    rng = np.random.default_rng(seed)
    time = FIRST + np.arange(n) * 1_000_000 + rng.integers(-200, 200, n)
    return (
        time,
        rng.standard_normal((n, 3)),
        rng.standard_normal((n, 3)) + [0, 0, 9.8],
        20 + rng.random(n),
    )


def table(log):
    time, gyro, accel, temperature = log
    columns = {"time [ns]": time} | {f"gyro_{a} [rad/s]": gyro[:, k] for k, a in enumerate(AXES)}
    return (
        columns
        | {f"accel_{a} [m/s^2]": accel[:, k] for k, a in enumerate(AXES)}
        | {"temperature [degC]": temperature}
    )


def csv(path, log):
    columns = table(log)
    rows = [
        ",".join(columns),
        *(",".join(map(str, row)) for row in zip(*(c.tolist() for c in columns.values()))),
    ]
    text = ("\n".join(rows) + "\n").encode()
    path.write_bytes(gzip.compress(text) if path.suffix == ".gz" else text)


def parquet(path, log):
    pd.DataFrame(table(log)).to_parquet(path, row_group_size=101)


def _tree(log):
    time, gyro, accel, temperature = log
    return {"t": time, "gyro": gyro, "acc": accel, "temp": temperature}


def mat(path, log):
    """A structure, as MATLAB saves it before version 7.3."""
    savemat(
        path,
        {"imu": _tree(log), "note": "text", "cells": np.array([1, "a"], dtype=object)},
        do_compression=True,
        oned_as="column",
    )


def mat73(path, log):
    """As MATLAB saves with -v7.3: HDF5 behind a user block, arrays transposed, their class in an
    attribute.
    """
    import h5py

    with h5py.File(path, "w", userblock_size=512) as file:
        for name, values in {
            **_tree(log),
            "note": np.frombuffer(b"t\0e\0x\0t\0", np.uint16),
        }.items():
            item = file.create_dataset(f"imu/{name}", data=np.atleast_2d(values.T))
            item.attrs["MATLAB_class"] = np.bytes_(
                "char" if name == "note" else "int64" if name == "t" else "double"
            )
    with path.open("r+b") as file:
        file.write(b"MATLAB 7.3 MAT-file".ljust(512, b" "))


def hdf5(path, log):
    import h5py

    with h5py.File(path, "w") as file:
        for name, values in _tree(log).items():
            file.create_dataset(
                f"imu/{name}", data=values, chunks=True, compression="gzip", shuffle=True
            )
        file["imu/label"] = "left"


class Messages:
    """Imu and Temperature messages of a store of types of rosbags, and how they are written."""

    def __init__(self, ros2):
        from rosbags.typesys import Stores, get_typestore

        self.store = get_typestore(Stores.ROS2_HUMBLE if ros2 else Stores.ROS1_NOETIC)
        self.pack = self.store.serialize_cdr if ros2 else self.store.serialize_ros1
        self.sequence = [] if ros2 else [0]

    def header(self, stamp):
        time = self.store.types["builtin_interfaces/msg/Time"](
            int(stamp // 10**9), int(stamp % 10**9)
        )
        return self.store.types["std_msgs/msg/Header"](*self.sequence, time, "imu_link")

    def imu(self, stamp, gyro, accel, unknown=()):
        vector, quaternion = (
            self.store.types[f"geometry_msgs/msg/{kind}"] for kind in ("Vector3", "Quaternion")
        )
        none = np.array([-1.0] + [0.0] * 8)
        gyro_covariance, accel_covariance = (
            none if name in unknown else np.zeros(9) for name in ("gyro", "accel")
        )
        return self.store.types["sensor_msgs/msg/Imu"](
            self.header(stamp),
            quaternion(0.0, 0.0, 0.0, 1.0),
            none,
            vector(*map(float, gyro)),
            gyro_covariance,
            vector(*map(float, accel)),
            accel_covariance,
        )

    def temperature(self, stamp, value):
        return self.store.types["sensor_msgs/msg/Temperature"](
            self.header(stamp), float(value), 0.0
        )

    def write(self, writer, topics):
        """``topics`` maps a topic to its messages, each with the time of logging; written in
        turns.
        """
        made = {
            topic: writer.add_connection(topic, messages[0][1].__msgtype__, typestore=self.store)
            for topic, messages in topics.items()
        }
        for turn in zip_longest(
            *([(topic, *m) for m in messages] for topic, messages in topics.items())
        ):
            for topic, stamp, message in filter(None, turn):
                writer.write(made[topic], int(stamp), self.pack(message, message.__msgtype__))


def topics_of(messages, log):
    return {
        "/imu/data": [(t, messages.imu(t, g, a)) for t, g, a, _ in zip(*log)],
        "/imu/temp": [(t, messages.temperature(t, value)) for t, _, _, value in zip(*log)],
    }


def bag1(path, log=None, topics=topics_of):
    from rosbags.rosbag1 import Writer

    messages = Messages(ros2=False)
    with Writer(path) as writer:
        messages.write(writer, topics(messages, log))


def bag2(path, log=None, topics=topics_of, plugin="SQLITE3"):
    """The folder of a bag of ROS 2."""
    from rosbags.rosbag2 import StoragePlugin, Writer

    messages = Messages(ros2=True)
    with Writer(path, version=9, storage_plugin=StoragePlugin[plugin]) as writer:
        messages.write(writer, topics(messages, log))


def written(folder, kind, log):
    """The path of ``log`` in the format ``kind`` and of the column map that it needs, None where it
    needs none.
    """
    column_map = folder / "map.toml"
    column_map.write_text(MAP)
    if kind in ("folder", "db3", "mcap"):
        bag2(folder / "log", log, plugin="MCAP" if kind == "mcap" else "SQLITE3")
        return folder / "log" if kind == "folder" else next(
            (folder / "log").glob(f"*.{kind}")
        ), None
    writer, name = {
        "csv": (csv, "log.csv"),
        "csv.gz": (csv, "log.csv.gz"),
        "parquet": (parquet, "log.parquet"),
        "mat": (mat, "log.mat"),
        "mat73": (mat73, "log.mat"),
        "hdf5": (hdf5, "log.h5"),
        "bag": (bag1, "log.bag"),
    }[kind]
    writer(folder / name, log)
    return folder / name, column_map if writer in (mat, mat73, hdf5) else None
