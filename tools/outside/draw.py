"""What a set is drawn to be: a vehicle, its room, who flies it, and what is hidden in it."""

import math
import random
from dataclasses import dataclass, field

G = 9.81


@dataclass
class Vehicle:
    """Numbers of a vehicle and of the simulation around it; all of them but the noise are known to its user."""

    params: dict  # as rotorpy has them, without the rotors' positions
    x_m: list[float]
    y_m: list[float]
    radius_m: float
    ceiling_m: float | None
    rate_Hz: int  # of simulation and controller; the log has 100
    kp_pos: list[float]
    kd_pos: list[float]
    by_mocap: bool  # the controller sees the measured state, not the true one
    noise: float  # of the motion capture, over rotorpy's own

    @property
    def hover_radps(self) -> float:
        return math.sqrt(self.params["mass"] * G / (4 * self.params["k_eta"]))

    @property
    def rest_m(self) -> float:
        """Of the centre of mass, over feet that rotorpy has not."""
        return 0.5 * self.radius_m

    @property
    def arm_m(self) -> float:
        return math.hypot(self.x_m[0], self.y_m[0])


@dataclass
class Hidden:
    """What the truth has and the user does not know."""

    name: str  # as in the library; of the marker alone
    size: float
    angle: float = 0.0  # a random direction or rotor
    extra: list[float] = field(default_factory=list)


def log_uniform(r: random.Random, low: float, high: float) -> float:
    return math.exp(r.uniform(math.log(low), math.log(high)))


def rotors(r: random.Random, arm_m: float) -> tuple[list[float], list[float]]:
    """In the order of rotorpy's vehicles: front left, front right, back right, back left."""
    angle = math.radians(r.uniform(38, 52))
    x, y = arm_m * math.cos(angle), arm_m * math.sin(angle)
    return [x, x, -x, -x], [y, -y, -y, y]


def aero(r: random.Random, mass: float, hover_radps: float) -> dict:
    """Two vehicles of five have drags that their user knows."""
    known = r.random() < 0.4
    per_rate = mass / (4 * hover_radps) if known else 0.0
    k_d, k_z = per_rate * r.uniform(0.15, 0.5), per_rate * r.uniform(0.15, 0.4)
    return {"k_d": k_d, "k_z": k_z, "c_Dx": 0.0, "c_Dy": 0.0, "c_Dz": 0.0, "k_h": 0.0, "k_flap": 0.0}


def vehicle(r: random.Random) -> Vehicle:
    """Scaled between a Crazyflie, a Hummingbird and a quadrotor of 1.5 kg, each number with a spread of its own."""
    mass = log_uniform(r, 0.03, 1.5)
    arm = 0.046 * (mass / 0.0329) ** 0.47 * r.uniform(0.85, 1.2)
    radius = arm * r.uniform(0.45, 0.6)
    hover = 47 * r.uniform(0.8, 1.2) / radius  # tip speed
    k_eta = mass * G / (4 * hover * hover)
    ixx = r.uniform(0.2, 0.28) * mass * arm * arm
    tau = r.uniform(0.015, 0.07)
    kd_att = min(45.0, r.uniform(1.1, 1.6) / tau)  # slow motors allow little gain
    params = {"mass": mass, "Ixx": ixx, "Iyy": ixx * r.uniform(1.0, 1.25), "Izz": ixx * r.uniform(1.6, 1.95),
              "Ixy": 0.0, "Ixz": 0.0, "Iyz": 0.0, "num_rotors": 4, "rotor_directions": [1, -1, 1, -1],
              "rotor_speed_min": 0.0, "rotor_speed_max": hover * math.sqrt(r.uniform(2.0, 3.2)), "k_eta": k_eta,
              "k_m": k_eta * radius * r.uniform(0.2, 0.3), "tau_m": tau, "motor_noise_std": 0.0,
              "kp_att": (kd_att / (2 * r.uniform(0.8, 1.0))) ** 2, "kd_att": kd_att}
    params.update(aero(r, mass, hover))
    x_m, y_m = rotors(r, arm)
    kp_xy, kp_z = min(6.5, params["kp_att"] * r.uniform(0.04, 0.08)), r.uniform(30, 50)
    ceiling = height(arm) + 0.35 * stretch(arm) + 6 * radius if r.random() < 0.4 else None
    return Vehicle(params, x_m, y_m, radius, ceiling, r.choices([100, 200], [4, 1])[0],
                   [kp_xy, kp_xy, kp_z], [1.6 * math.sqrt(kp_xy)] * 2 + [1.8 * math.sqrt(kp_z)],
                   r.random() < 0.5, r.uniform(0.5, 2.0))


def stretch(arm_m: float) -> float:
    """How far flights go, over those of a Crazyflie."""
    return math.sqrt(arm_m / 0.046)


def height(arm_m: float) -> float:
    return 0.5 * stretch(arm_m)


# Name, smallest and largest size. Units: shares of weight, thrust, arm, inertia and 1; 1/s and 1/m per mass; s; m/s2;
# degrees. Sizes are about one to four times what the exam calls typical of a Crazyflie, scaled with the vehicle.
EFFECTS = {
    "mass": (0.05, 0.15), "thrust_scale": (0.05, 0.15), "motor_damage": (0.06, 0.2), "cg_offset": (0.03, 0.1),
    "inertia": (0.4, 1.0), "rotor_drag": (0.25, 0.9), "climb_inflow": (0.38, 1.2), "body_drag": (0.06, 0.24),
    "translational_lift": (0.09, 0.35), "flapping": (6.0, 18.0), "wind": (0.12, 0.4), "motor_lag": (0.02, 0.045),
    "delay": (0.015, 0.025), "battery_sag": (0.5, 1.2), "accel_bias": (0.12, 0.4), "imu_misalignment": (1.2, 4.0),
    "ceiling": (0.2, 0.4), "ground": (0.8, 2.0), "tof_bias": (0.02, 0.06),
}
NOTHING, NOISE = "nothing", "noise"  # of the motion capture; there is nothing to name


def hidden(r: random.Random) -> list[Hidden]:
    """A fifth of the sets hide nothing, half of those with much noise; a sixth hide two effects, the others one."""
    chance = r.random()
    if chance < 0.2:
        return [Hidden(NOISE, r.uniform(4, 8))] if chance < 0.1 else []
    names = r.sample(sorted(EFFECTS), 2 if chance > 0.84 else 1)
    return [Hidden(name, log_uniform(r, *EFFECTS[name]), r.random(), [r.random() for _ in range(4)]) for name in names]


def fit_to(base: Vehicle, what: list[Hidden], r: random.Random) -> None:
    """The vehicle can show what is hidden, and its user does not know it already."""
    p = base.params
    names = {h.name for h in what}
    if "wind" in names and p["k_d"] == 0.0:  # because wind is felt through the drag alone
        p["k_d"] = p["mass"] / (4 * base.hover_radps) * r.uniform(0.3, 0.5)
    if "rotor_drag" in names and "wind" not in names:
        p["k_d"] = 0.0
    if "climb_inflow" in names:
        p["k_z"] = 0.0
    if names & {"ceiling", "tof_bias"} and base.ceiling_m is None:
        base.ceiling_m = height(base.arm_m) + 0.35 * stretch(base.arm_m) + 6 * base.radius_m
