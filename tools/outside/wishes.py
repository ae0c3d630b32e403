"""Where a vehicle is told to be: pieces that excite it, in an order of chance, made smooth."""

import math
import random

import numpy as np

from draw import Vehicle, height, stretch

PIECES = ("sway", "circle", "bounce", "turn", "line", "top", "bottom")


class Wishes:
    """A trajectory as rotorpy asks for it: update(t) gives the flat outputs. Third-order smooth, yaw too."""

    def __init__(self, v: Vehicle, r: random.Random, span_s: float):
        self.v, self.r, self.dt = v, r, 1.0 / v.rate_Hz
        self.far = stretch(v.arm_m)
        n = int(span_s * v.rate_Hz) + 2
        order = list(PIECES)
        r.shuffle(order)
        told = np.tile([0.0, 0.0, height(v.arm_m), 0.0], (n, 1))
        edges = np.linspace(0, n, len(order) + 1).astype(int)
        for piece, begin, end in zip(order, edges, edges[1:]):
            t = np.arange(end - begin) * self.dt
            getattr(self, piece)(t, (end - begin) * self.dt, told[begin:end])
            if piece == "turn":
                told[end:, 3] += told[end - 1, 3]
        quick = r.uniform(0.9, 1.15) * np.array([4.5, 4.5, 3.5, 4.0]) / math.sqrt(self.far)  # rad/s
        self.way, self.speed, self.push = self.smooth(told, quick)

    def smooth(self, told: np.ndarray, w: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        x, v, a = told[0].copy(), np.zeros(4), np.zeros(4)
        way, speed, push = np.empty_like(told), np.empty_like(told), np.empty_like(told)
        h = self.dt / 4
        for i, wish in enumerate(told):
            way[i], speed[i], push[i] = x, v, a
            for _ in range(4):
                a = a + h * (w**3 * (wish - x) - 3 * w * w * v - 3 * w * a)
                v = v + h * a
                x = x + h * v
        return way, speed, push

    # --- pieces: rows of x, y, z, yaw are changed in place

    def sway(self, t, span, told):
        angle, size = 2 * math.pi * self.r.random(), self.far * self.r.uniform(0.15, 0.3)
        side = np.where(np.floor(t / self.r.uniform(0.6, 0.9)) % 2 == 0, size, -size)
        told[:, 0], told[:, 1] = side * math.cos(angle), side * math.sin(angle)

    def circle(self, t, span, told):
        radius, speed = self.far * self.r.uniform(0.4, 0.7), math.sqrt(self.far) * self.r.uniform(0.7, 1.3)
        turn = self.r.choice([-1, 1]) * speed / radius * t
        told[:, 0], told[:, 1] = radius * np.sin(turn), radius * (1 - np.cos(turn))

    def bounce(self, t, span, told):
        told[:, 2] += np.where(np.floor(t / self.r.uniform(0.5, 0.9)) % 2 == 0, 0.2, -0.2) * self.far

    def turn(self, t, span, told):
        told[:, 3] += self.r.choice([-1, 1]) * 2 * math.pi * np.minimum(1.0, 1.2 * t / span)

    def line(self, t, span, told):
        angle, size = 2 * math.pi * self.r.random(), self.far * self.r.uniform(0.5, 0.9)
        there = np.where(t < span / 2, size, 0.0)
        told[:, 0], told[:, 1] = there * math.cos(angle), there * math.sin(angle)

    def top(self, t, span, told):
        """A hold under the ceiling where there is one, else on the spot. What lies between is met on the way."""
        if self.v.ceiling_m is not None:
            told[:, 2] = self.v.ceiling_m - self.v.radius_m * (1.2 + self.r.uniform(0, 0.8))

    def bottom(self, t, span, told):
        """A hold over the floor: a wish that went up and down here was smoothed to four rotor radii."""
        told[:, 2] = self.v.radius_m * (1.2 + self.r.uniform(0, 0.8))

    # --- what rotorpy asks

    def update(self, t: float) -> dict:
        i = min(int(round(t / self.dt)), len(self.way) - 1)
        zero = np.zeros(3)
        return {"x": self.way[i, :3].copy(), "x_dot": self.speed[i, :3].copy(), "x_ddot": self.push[i, :3].copy(),
                "x_dddot": zero, "x_ddddot": zero, "yaw": self.way[i, 3], "yaw_dot": self.speed[i, 3], "yaw_ddot": 0.0}
