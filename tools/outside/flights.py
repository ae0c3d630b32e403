"""Flies a vehicle of rotorpy along its wishes, and keeps what its user would log."""

import math
import random

import numpy as np
from rotorpy.controllers.quadrotor_control import SE3Control
from rotorpy.sensors.external_mocap import MotionCapture
from rotorpy.sensors.imu import Imu

from draw import Hidden, Vehicle
from nature import Nature, rotorpy_params
from wishes import Wishes

LOG_HZ = 100
LOST_M = 1.0  # distance from its track
LEAST_GAP = 0.2  # rotor radii
# As in rotorpy's own table of a simulation; its user added vbat and the ranges.
HEAD = ["time", *(f"mocap_{n}" for n in ("x", "y", "z", "xdot", "ydot", "zdot", "qx", "qy", "qz", "qw")),
        "ax", "ay", "az", "gx", "gy", "gz", "r1des", "r2des", "r3des", "r4des",
        "xdes", "ydes", "zdes", "yawdes", "vbat", "range_up", "range_down"]


class Crashed(Exception):
    """The vehicle cannot fly with what is hidden."""


class Steady(SE3Control):
    """rotorpy's controller with gains of the vehicle and an integral of the position's error."""

    def __init__(self, v: Vehicle):
        super().__init__(rotorpy_params(v))
        self.kp_pos, self.kd_pos = np.array(v.kp_pos), np.array(v.kd_pos)
        self.gain, self.sum, self.dt = np.array([0.15, 0.15, 0.5]) * self.kp_pos, np.zeros(3), 1.0 / v.rate_Hz

    def update(self, t, state, flat_output):
        self.sum = np.clip(self.sum + self.dt * self.gain * (flat_output["x"] - state["x"]), -3, 3)
        flat_output["x_ddot"] = flat_output["x_ddot"] + self.sum
        return super().update(t, state, flat_output)


class Battery:
    """One cell's voltage, as a user reads it: falls through the flight, and with the load."""

    def __init__(self, r: random.Random, span_s: float):
        self.full, self.fall = r.uniform(3.75, 4.15), r.uniform(0.1, 0.3) / span_s

    def volt(self, t_s: float, load: float) -> float:
        return self.full - self.fall * t_s - 0.15 * (load - 1)


def mocap(v: Vehicle, what: list[Hidden]) -> MotionCapture:
    much = max([h.size for h in what if h.name == "noise"], default=1.0)
    n = v.noise * np.ones(3)
    return MotionCapture(v.rate_Hz, {
        "pos_noise_density": 0.0005 * much * n, "vel_noise_density": 0.005 * n, "att_noise_density": 0.0005 * n,
        "rate_noise_density": 0.0005 * n, "vel_artifact_max": 0, "vel_artifact_prob": 0,
        "rate_artifact_max": 0, "rate_artifact_prob": 0})


def imu(nature: Nature, v: Vehicle) -> Imu:
    zero = np.zeros(3)
    return Imu({"initial_bias": nature.acc_bias, "noise_density": v.noise * 0.005 * np.ones(3), "random_walk": zero},
               {"initial_bias": zero.copy(), "noise_density": v.noise * 0.0005 * np.ones(3), "random_walk": zero},
               R_BS=nature.imu_turned, sampling_rate=v.rate_Hz)


def ranges(nature: Nature, state: dict, r: random.Random) -> tuple[float, float]:
    """Along the body's axis, from the rotors' plane up and from the feet down, to 4 m; 5 mm of noise."""
    q = state["q"]
    up = max(1 - 2 * (q[0] ** 2 + q[1] ** 2), 0.1)
    above = math.nan if nature.vehicle.ceiling_m is None else (nature.vehicle.ceiling_m - state["x"][2]) / up
    both = [d + nature.range_bias + r.gauss(0, 0.005) for d in (above, (state["x"][2] - nature.vehicle.rest_m) / up)]
    return tuple(d if 0.0 < d < 4.0 else math.nan for d in both)


def check(v: Vehicle, state: dict, flat: dict) -> None:
    z, least = state["x"][2], LEAST_GAP * v.radius_m
    touches = z < least or (v.ceiling_m is not None and v.ceiling_m - z < least)
    if touches or not np.linalg.norm(state["x"] - flat["x"]) < LOST_M:
        raise Crashed


def start_of(v: Vehicle, wishes: Wishes) -> dict:
    """Not quite where it is to be: without noise a vehicle in trim would give the same row for ever."""
    zero = np.zeros(3)
    at = wishes.way[0, :3] + np.array([0.03, -0.02, 0.01])
    return {"x": at, "v": zero.copy(), "q": np.array([0.0, 0.0, 0.0, 1.0]), "w": zero.copy(),
            "wind": zero.copy(), "rotor_speeds": np.full(4, v.hover_radps)}


def fly(v: Vehicle, what: list[Hidden], r: random.Random) -> list[list[float]]:
    """Rows at 100 Hz. A row holds what is at its time, and the command that is held from then on."""
    np.random.seed(r.randrange(2**32))  # rotorpy's sensors draw from it
    span_s, dt = r.uniform(15, 19), 1.0 / v.rate_Hz
    wishes, battery = Wishes(v, r, span_s), Battery(r, span_s)
    state = start_of(v, wishes)
    nature, pilot, cameras = Nature(v, what, state), Steady(v), mocap(v, what)
    sensor, late = imu(nature, v), round(nature.delay_s * v.rate_Hz)
    orders = [{"cmd_motor_speeds": np.full(4, v.hover_radps)}] * late
    rows, load = [], 1.0
    for tick in range(int(span_s * v.rate_Hz)):
        t, flat = tick * dt, wishes.update(tick * dt)
        check(v, state, flat)
        told = flat["x"].copy()
        state["wind"] = nature.wind
        logged = tick % (v.rate_Hz // LOG_HZ) == 0
        seen = cameras.measurement(state, with_noise=True) if logged or v.by_mocap else state
        orders.append(pilot.update(t, seen if v.by_mocap else state, flat))
        volt = battery.volt(t, load)
        nature.at_voltage(volt)
        speeds = orders[-1]["cmd_motor_speeds"]
        load = float(np.mean(np.clip(speeds, 0, nature.rotor_speed_max) ** 2)) / v.hover_radps**2
        if logged:
            felt = sensor.measurement(state, nature.statedot(state, orders[tick], dt))
            rows.append([t, *seen["x"], *seen["v"], *seen["q"], *felt["accel"], *felt["gyro"], *speeds, *told,
                         flat["yaw"], volt + r.gauss(0, 0.005), *ranges(nature, state, r)])
        state = nature.step(state, orders[tick], dt)
    return rows
