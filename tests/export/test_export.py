"""Exported parts: each file read by another reader, and its noise simulated as its project does.

The noise of a sample and the steps of a bias, worked out from a file by the project's own formula,
are those of the part.
"""

import math
import re
import shutil
import subprocess
import sys
import xml.etree.ElementTree as ET

import numpy as np
import pytest
import yaml

from pyimu import export as exports
from pyimu.cli import main
from pyimu.errors import UserError
from pyimu.export.densities import densities
from pyimu.model.part import Part
from pyimu.model.part_file import part, save_part
from pyimu.model.sensor import Sensor
from pyimu.model.simulate import simulate

RATE = 200.0
FIGURES = 1e-5
"""Six figures are written."""

N, K = np.array([1e-4, 3e-4, 2e-4]), np.array([1e-6, 2e-6, 5e-6])
MADE = Part(
    "made",
    RATE,
    Sensor(
        "gyro",
        {
            "angle_random_walk": {"N": N},
            "rate_random_walk": {"K": K},
            "turn_on_bias": {"b0": [0.01, -0.02, 0.0]},
            "saturation": {"limit": 8.0},
            "quantization": {"q": 1e-3},
            "scale_factor": {"s": 0.01},
        },
    ),
    Sensor("accel", {"angle_random_walk": {"N": 10 * N}, "rate_random_walk": {"K": 10 * K}}),
    description="made -- up & tried",
)


def text(to, inflate=1.0, of=MADE):
    return exports.export(of, to, inflate).text


def read_yaml(to, **more):
    body = re.sub(r"^%YAML:1.0\n(---\n)?", "", text(to, **more))
    return yaml.safe_load(body)


@pytest.mark.parametrize("to", ["kalibr", "openvins"])
def test_kalibr_s_samples_have_the_noise_of_the_part(to):
    """Wiki, IMU noise model: n_d = sigma / sqrt(dt) w, b_d steps by sigma_b sqrt(dt) w."""
    read = read_yaml(to)
    read = read["imu0"] if to == "openvins" else read
    assert read["update_rate"] == RATE and isinstance(read["rostopic"], str)
    for name, n, k in (("gyroscope", N, K), ("accelerometer", 10 * N, 10 * K)):
        variance = read[f"{name}_noise_density"] ** 2 * RATE
        assert variance == pytest.approx(np.max(n) ** 2 * RATE, rel=FIGURES)
        step = read[f"{name}_random_walk"] ** 2 / RATE
        assert step == pytest.approx(np.max(k) ** 2 / RATE, rel=FIGURES)


def test_openvins_has_its_matrices():
    read = read_yaml("openvins")["imu0"]
    for name, size in (("T_i_b", 4), ("Tw", 3), ("Ta", 3), ("R_IMUtoGYRO", 3), ("R_IMUtoACC", 3)):
        np.testing.assert_array_equal(read[name], np.eye(size))
    assert not np.any(read["Tg"]) and read["model"] == "kalibr"


def test_vins_adds_the_variance_of_the_part_to_the_velocity():
    """midPointIntegration: acc_n^2 dt^2 a sample, which over a second is N^2; so is the bias."""
    read, dt = read_yaml("vins"), 1 / RATE
    for n, k, scale in (("gyr_n", "gyr_w", 1), ("acc_n", "acc_w", 10)):
        assert (read[n] * dt) ** 2 * RATE == pytest.approx((scale * np.max(N)) ** 2, rel=FIGURES)
        assert (read[k] * dt) ** 2 * RATE == pytest.approx((scale * np.max(K)) ** 2, rel=FIGURES)


@pytest.mark.parametrize("to", ["vins", "openvins"])
def test_opencv_reads_it_as_the_estimator_does(to, tmp_path):
    """Both open their files by cv::FileStorage, which takes less of YAML than YAML is."""
    cv2 = pytest.importorskip("cv2", reason="needs pip install opencv-python-headless")
    (tmp_path / "imu.yaml").write_text(text(to))
    file, read = cv2.FileStorage(str(tmp_path / "imu.yaml"), cv2.FILE_STORAGE_READ), read_yaml(to)
    node = file.root() if to == "vins" else file.getNode("imu0")
    numbers = {k: v for k, v in read.get("imu0", read).items() if isinstance(v, float)}
    assert len(numbers) >= 4
    for name, value in numbers.items():
        assert node.getNode(name).real() == value, name


def test_isaac_ros_has_the_densities_of_the_worst_axis():
    read = read_yaml("isaac")["visual_slam_node"]["ros__parameters"]
    assert read["gyro_noise_density"] == pytest.approx(np.max(N), rel=FIGURES)
    assert read["accel_random_walk"] == pytest.approx(10 * np.max(K), rel=FIGURES)
    assert read["calibration_frequency"] == RATE and read["enable_imu_fusion"] is True


def test_ros2_s_covariance_is_that_of_simulated_samples():
    """By the part's own simulation; the variance of n samples is known to sqrt(2 / n)."""
    read = read_yaml("ros2")["/**"]["ros__parameters"]
    plain = Part("plain", RATE, Sensor("gyro", {"angle_random_walk": {"N": N}}))
    n = 20_000
    gyro, _ = simulate(plain, np.zeros((n, 3)), np.zeros((n, 3)), seed=1)
    covariance = np.reshape(read["angular_velocity_covariance"], (3, 3))
    five_sigma = 5 * math.sqrt(2 / n)
    np.testing.assert_allclose(np.var(gyro, axis=0), np.diag(covariance), rtol=five_sigma)
    assert np.count_nonzero(covariance) == 3 and read["orientation_covariance"][0] == -1


def test_px4_predicts_the_variance_of_the_part():
    """Of a step of EKF2: (dt gyr_noise)^2 of the angle, (dt b_noise)^2 of the bias."""
    rows = [line.split("\t") for line in text("px4").splitlines() if not line.startswith("#")]
    read = {name: float(value) for _, _, name, value, kind in rows if kind == "9"}
    dt = 0.01
    angle = (read["EKF2_GYR_NOISE"] * dt) ** 2 / dt
    assert angle == pytest.approx(np.max(N) ** 2, rel=FIGURES)
    assert (read["EKF2_GYR_B_NOISE"] * dt) ** 2 / dt == pytest.approx(np.max(K) ** 2, rel=FIGURES)
    assert (read["EKF2_ACC_NOISE"] * dt) ** 2 / dt == pytest.approx(
        (10 * np.max(N)) ** 2, rel=FIGURES
    )


def test_what_px4_does_not_allow_is_at_its_bound_and_said():
    quiet = text("px4", of="hg4930")
    assert "EKF2_ACC_NOISE\t0.01\t9" in quiet and "EKF2_ACC_NOISE: " in quiet


def test_gazebo_s_samples_have_noise_bias_and_step_of_the_part():
    """GaussianNoiseModel: phi = exp(-dt / tau), steps of variance sigma^2 tau / 2 (1 - phi^2)."""
    root = ET.fromstring(text("gazebo"))
    sensor = root.find("sensor")
    assert sensor.get("type") == "imu" and float(sensor.find("update_rate").text) == RATE
    for tag, scale in (("angular_velocity", 1), ("linear_acceleration", 10)):
        for i, axis in enumerate("xyz"):
            noise = sensor.find(f"imu/{tag}/{axis}/noise")
            get = {e.tag: float(e.text) for e in noise}
            assert get["stddev"] ** 2 / RATE == pytest.approx((scale * N[i]) ** 2, rel=FIGURES)
            tau, dt = get["dynamic_bias_correlation_time"], 1 / RATE
            step = -(get["dynamic_bias_stddev"] ** 2) * tau / 2 * math.expm1(-2 * dt / tau)
            assert step == pytest.approx((scale * K[i]) ** 2 * dt, rel=1e-4)
            bias = MADE.gyro.values["turn_on_bias"]["b0"][i] if scale == 1 else 0.0
            assert get["mean"] == pytest.approx(bias, abs=1e-12) and get["bias_mean"] == 0
            assert noise.get("type") == ("gaussian_quantized" if scale == 1 else "gaussian")


LOADS = """
#include <iostream>
#include <sdf/sdf.hh>
int main(int, char **word) {
    sdf::Root root;
    for (const auto &error : root.Load(word[1])) std::cout << error << "\\n";
    if (!root.Model()) return 0;
    const auto *sensor = root.Model()->LinkByIndex(0)->SensorByIndex(0);
    std::cout.precision(17);
    std::cout << sensor->ImuSensor()->AngularVelocityXNoise().StdDev() << "\\n";
}
"""


def test_gazebo_s_own_library_reads_the_sensor(tmp_path):
    """Within a model, as sensors are in links; without a warning."""
    found = shutil.which("pkg-config") and subprocess.run(
        ["pkg-config", "--cflags", "--libs", "sdformat12"], capture_output=True, text=True
    )
    if not found or found.returncode or not shutil.which("g++"):
        pytest.skip("needs g++ and Debian's libsdformat-dev")
    (tmp_path / "load.cc").write_text(LOADS)
    subprocess.run(
        ["g++", "-std=c++17", "load.cc", "-o", "load", *found.stdout.split()],
        cwd=tmp_path,
        check=True,
    )
    sensor = ET.fromstring(text("gazebo")).find("sensor")
    model = ET.SubElement(whole := ET.Element("sdf", version="1.9"), "model", name="m")
    ET.SubElement(model, "link", name="l").append(sensor)
    ET.ElementTree(whole).write(tmp_path / "model.sdf")
    done = subprocess.run(
        ["./load", tmp_path / "model.sdf"], cwd=tmp_path, capture_output=True, text=True, check=True
    )
    want = float(sensor.find("imu/angular_velocity/x/noise/stddev").text)
    assert done.stderr == "" and done.stdout.count("\n") == 1, done.stdout + done.stderr
    assert float(done.stdout) == pytest.approx(want, rel=1e-15)


def test_gazebo_draws_the_bias_of_specimens():
    """A bias within +-20 deg/s has the standard deviation 20 deg/s / sqrt(3)."""
    noise = ET.fromstring(text("gazebo", of="mpu6050")).find("sensor/imu/angular_velocity/x/noise")
    want = math.radians(20) / math.sqrt(3)
    assert float(noise.find("bias_stddev").text) == pytest.approx(want, rel=1e-7)


def test_matlab_s_samples_have_the_noise_of_the_part():
    """imuSensor: a sample's noise is NoiseDensity sqrt(SampleRate / 2)."""
    script = text("matlab")
    gyro = re.search(r"gyroparams\((.*?)\);", script, re.DOTALL)[1]
    density = re.search(r"'NoiseDensity', \[(.*?)\]", gyro)[1]
    variance = np.array(density.split(), dtype=float) ** 2 * RATE / 2
    np.testing.assert_allclose(variance, N**2 * RATE, rtol=1e-7)
    for name, value in (("MeasurementRange", 8.0), ("Resolution", 1e-3)):
        assert float(re.search(rf"'{name}', ([\d.e-]+)", gyro)[1]) == pytest.approx(value)
    code = [line for line in script.splitlines() if not line.startswith("%")]
    assert script.count("(") == script.count(")") and sum(";" in line for line in code) == 3


def test_a_walk_from_the_bias_instability_shares_its_floor():
    """The Allan deviation of N and K alone, at all times, is lowest at 0.664 B."""
    p = part("stim300")
    t = np.geomspace(1e-2, 1e6, 20001)
    for kind in ("gyro", "accel"):
        d = densities(p, kind)
        deviation = np.sqrt(d.N[0] ** 2 / t + d.K[0] ** 2 * t / 3)
        B = p.sensor(kind).values["bias_instability"]["B"][0]
        floor = math.sqrt(2 * math.log(2) / math.pi) * B
        assert deviation.min() == pytest.approx(floor, rel=1e-6)


def test_a_part_without_both_says_from_where_its_walk_is():
    assert "not in the part: from a consumer part's bias instability" in text("kalibr", of="bmi270")
    assert "so that N and K share its floor" in text("kalibr", of="vn100")
    assert "gyro random walk: the part's random walk" in text("kalibr")


@pytest.mark.parametrize("to", exports.TARGETS)
def test_the_noise_is_inflated_as_the_project_recommends_and_that_is_said(to):
    target = exports.TARGETS[to]
    recommended, plain = exports.export(MADE, to), exports.export(MADE, to, 1.0)
    assert recommended.inflate == target.inflate
    assert (recommended.text == plain.text.replace("as asked for", target.reason)) == (
        target.inflate == 1.0
    )
    said = f"noise {target.inflate:g} times" if target.inflate != 1.0 else "noise as in the part"
    assert said in recommended.text and target.reason in recommended.text
    assert "scale_factor" in recommended.text  # has no place there, and is said to have none


ONE = {
    "gyro": Part("gyro", RATE, gyro=MADE.gyro),
    "accel": Part("accel", RATE, accel=MADE.accel),
}


@pytest.mark.parametrize("kind", ONE)
@pytest.mark.parametrize("to", [t for t in exports.TARGETS if t != "vins"])
def test_a_part_with_one_sensor_s_noise_is_exported_with_that_alone(to, kind):
    """Nothing but what it lacks differs from the whole part's file; that is said in its words."""
    other = {"gyro": "accel", "accel": "gyro"}[kind]
    made, whole = exports.export(ONE[kind], to, 1.0), exports.export(MADE, to, 1.0)
    words = exports.TARGETS[to].words
    assert words[other] in made.said() and words[kind] not in made.said()
    for lines in (made.text, made.said()):
        assert f"no white noise of the {'accelerometer' if kind == 'gyro' else 'gyro'}" in lines
    assert "no white noise" not in whole.text
    own = words[kind].split(" and ")[0].strip("<>")
    value = next(line for line in whole.text.splitlines() if own in line)
    assert value in made.text.splitlines()


def test_what_is_missing_is_left_out_of_the_file():
    read = {to: read_yaml(to, of=ONE["gyro"]) for to in ("kalibr", "openvins", "isaac", "ros2")}
    assert not any("accel" in name for name in read["kalibr"])
    assert not any("accel" in name for name in read["openvins"]["imu0"])
    node = read["isaac"]["visual_slam_node"]["ros__parameters"]
    assert "gyro_noise_density" in node and "accel_noise_density" not in node
    unknown = read["ros2"]["/**"]["ros__parameters"]["linear_acceleration_covariance"]
    assert unknown == [0.0] * 9
    assert ET.fromstring(text("gazebo", of=ONE["gyro"])).find(".//linear_acceleration") is None
    assert "1\t1\tEKF2_ACC" not in text("px4", of=ONE["gyro"])
    assert "imu.Accelerometer =" not in text("matlab", of=ONE["gyro"])


@pytest.mark.parametrize(
    ("call", "says"),
    [
        (lambda: exports.export(MADE, "kalib"), "kalib: no project.*did you mean kalibr"),
        (lambda: exports.export(MADE, "px4", 0.0), "must be above 0"),
        (lambda: exports.export("imt30", "vins"), "no white noise of the accelerometer"),
        (lambda: exports.export(Part("none", RATE), "px4"), "no white noise of the gyro"),
    ],
)
def test_what_cannot_be_exported_is_refused(call, says):
    with pytest.raises(UserError, match=says):
        call()


def test_of_several_projects_the_one_that_needs_more_is_named(pyimu, tmp_path):
    code, out, err = pyimu("export", "adxrs300", "--to", "kalibr,vins", "--out", "out")
    assert (code, out) == (2, "") and not (tmp_path / "out").exists()
    for words in ("of the accelerometer (accel.", "the file of vins needs", "--to kalibr can be"):
        assert words in err
    assert pyimu("export", "adxrs300", "--to", "kalibr", "--out", "out")[0] == 0
    said = pyimu("export", "adxrs300", "--to", "vins", "--out", "out")[2]
    assert "the file of vins" in said and "can be written" not in said


def test_the_command_writes_all_or_nothing(tmp_path, monkeypatch, capsys):
    save_part(MADE, tmp_path / "made.toml")
    monkeypatch.chdir(tmp_path)
    for to, code in (("kalibr,nonsense", 2), (",".join(exports.TARGETS), 0)):
        monkeypatch.setattr(sys, "argv", ["pyimu", "export", "made.toml", "--to", to])
        with pytest.raises(SystemExit) as end:
            main()
        assert end.value.code == code
        written = sorted(p.name for p in tmp_path.glob("out/export/*"))
        assert written == ([] if code else sorted(t.file for t in exports.TARGETS.values()))
    assert "imu.yaml: noise 10 times the part's" in capsys.readouterr().out
