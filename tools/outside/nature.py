"""rotorpy's multirotor with what is hidden in it: numbers that are others, and forces that rotorpy has not."""

import copy
import math

import numpy as np
from rotorpy.vehicles.multirotor import Multirotor

from draw import Hidden, Vehicle, G


def rotorpy_params(v: Vehicle) -> dict:
    p = copy.deepcopy(v.params)
    p["rotor_directions"] = np.array(p["rotor_directions"])
    p["rotor_pos"] = {f"r{i + 1}": np.array([v.x_m[i], v.y_m[i], 0.0]) for i in range(4)}
    return p


def unit(angle: float) -> np.ndarray:
    return np.array([math.cos(2 * math.pi * angle), math.sin(2 * math.pi * angle), 0.0])


class Nature(Multirotor):
    """Thrusts that depend on place, rotor and voltage; the rest of what is hidden changes rotorpy's own numbers."""

    def __init__(self, v: Vehicle, what: list[Hidden], start: dict):
        self.vehicle, self.truth = v, {h.name: h for h in what}
        self.wind = np.zeros(3)
        self.delay_s = 0.0
        self.acc_bias, self.imu_turned = np.zeros(3), np.eye(3)
        self.rotor_gain, self.volt_gain, self.gain = np.ones(4), 1.0, np.ones(4)
        self.range_bias = 0.0
        p = rotorpy_params(v)
        for h in what:
            getattr(self, "hide_" + h.name)(p, h)
        super().__init__(p, start, aero=True, integrator_kwargs={"method": "RK23", "first_step": 1.0 / v.rate_Hz})

    # --- what is hidden: each changes rotorpy's parameters, or a number above

    def hide_noise(self, p: dict, h: Hidden) -> None:
        pass  # acts in the sensors (flights.py)

    def hide_mass(self, p: dict, h: Hidden) -> None:
        p["mass"] *= 1 + (h.size if h.angle < 0.5 else -h.size)

    def hide_thrust_scale(self, p: dict, h: Hidden) -> None:
        p["k_eta"] *= 1 - h.size

    def hide_motor_damage(self, p: dict, h: Hidden) -> None:
        self.rotor_gain[int(4 * h.angle)] = 1 - h.size

    def hide_cg_offset(self, p: dict, h: Hidden) -> None:
        for at in p["rotor_pos"].values():
            at -= h.size * self.vehicle.arm_m * unit(h.angle)

    def hide_inertia(self, p: dict, h: Hidden) -> None:
        for axis, share in zip(("Ixx", "Iyy", "Izz"), h.extra):
            p[axis] *= 1 + h.size * (0.7 + 0.3 * share)

    def hide_rotor_drag(self, p: dict, h: Hidden) -> None:
        p["k_d"] += h.size * p["mass"] / (4 * self.vehicle.hover_radps)

    def hide_climb_inflow(self, p: dict, h: Hidden) -> None:
        p["k_z"] += h.size * p["mass"] / (4 * self.vehicle.hover_radps)

    def hide_body_drag(self, p: dict, h: Hidden) -> None:
        for axis, share in zip(("c_Dx", "c_Dy", "c_Dz"), h.extra):
            p[axis] = h.size * p["mass"] * (0.8 + 0.4 * share)

    def hide_translational_lift(self, p: dict, h: Hidden) -> None:
        p["k_h"] = h.size * p["mass"] / 4

    def hide_flapping(self, p: dict, h: Hidden) -> None:
        size = h.size * p["Ixx"] / (4 * self.vehicle.hover_radps)
        p["k_flap"] = size if h.angle < 0.5 else -size

    def hide_wind(self, p: dict, h: Hidden) -> None:
        self.wind = h.size * p["mass"] / (4 * self.vehicle.hover_radps * p["k_d"]) * unit(h.angle)

    def hide_motor_lag(self, p: dict, h: Hidden) -> None:
        p["tau_m"] += h.size

    def hide_delay(self, p: dict, h: Hidden) -> None:
        self.delay_s = h.size

    def hide_battery_sag(self, p: dict, h: Hidden) -> None:
        pass  # acts by voltage (at_voltage)

    def hide_accel_bias(self, p: dict, h: Hidden) -> None:
        self.acc_bias = h.size * unit(h.angle)

    def hide_imu_misalignment(self, p: dict, h: Hidden) -> None:
        axis, angle = unit(h.angle), math.radians(h.size)
        cross = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
        self.imu_turned = np.eye(3) + math.sin(angle) * cross + (1 - math.cos(angle)) * cross @ cross

    def hide_ceiling(self, p: dict, h: Hidden) -> None:
        pass  # acts by place (gain_at)

    def hide_ground(self, p: dict, h: Hidden) -> None:
        pass  # acts by place (gain_at)

    def hide_tof_bias(self, p: dict, h: Hidden) -> None:
        self.range_bias = h.size if h.angle < 0.5 else -h.size

    # --- thrusts

    def at_voltage(self, volt: float) -> None:
        """The curve from speed to thrust was measured at some voltage."""
        h = self.truth.get("battery_sag")
        self.volt_gain = 1 - h.size * (1 - volt / (3.7 + 0.5 * h.angle)) if h else 1.0

    def gain_at(self, height_m: float) -> float:
        """Ceiling: falls to half over two or three rotor radii; ground: the first order of Cheeseman and Bennett."""
        gain, radius, v = 1.0, self.vehicle.radius_m, self.vehicle
        if (h := self.truth.get("ceiling")) is not None:
            gain += h.size / (1 + (max(v.ceiling_m - height_m, 0.0) / ((2 + 2 * h.angle) * radius)) ** 2) ** 2
        if (h := self.truth.get("ground")) is not None:
            gain += h.size * (radius / (4 * max(height_m, 0.5 * radius))) ** 2
        return gain

    def _s_dot_fn(self, t, s, cmd_rotor_speeds):
        self.gain = self.rotor_gain * self.volt_gain * self.gain_at(s[2])
        return super()._s_dot_fn(t, s, cmd_rotor_speeds)

    def compute_body_wrench(self, body_rates, rotor_speeds, body_airspeed_vector):
        force, moment = super().compute_body_wrench(body_rates, rotor_speeds, body_airspeed_vector)
        more = (self.gain - 1) * self.k_eta * rotor_speeds**2
        force = force + np.array([0.0, 0.0, more.sum()])
        return force, moment + np.array([more @ self.rotor_geometry[:, 1], -more @ self.rotor_geometry[:, 0], 0.0])
