"""actuator.py - the motors' lag and delay out of a hover with hops: thrust commanded, specific force measured.

    m a = T'   T': the thrust T that is commanded, times (V / V')^2.05, a delay later, through a lag of first order;
               what the firmware makes of a command is right at V', the battery's voltage V through its low-pass
               of 100 ms, and a hop draws the voltage down at once
    a          through the firmware's filter of the accelerometer

The controller answers to what it measures, so that noise of the accelerometer is in the command, too, and least squares
take some of it for motors that are quick. Heights that were set know no noise: they are the instruments (two-stage least
squares; Soderstrom and Stoica, Instrumental Variable Methods for System Identification, 1983). Errors: the jackknife over
hops, each left out in turn; the delay's is 1.5 ms wider.
"""

from dataclasses import dataclass

import numpy as np
from scipy.optimize import least_squares
from scipy.signal import butter, lfilter
from scipy.stats import t

from .errors import Failed

TICK_MS = 10  # of the outer loop: at steps that ten divides
MOTORS_MS = 1  # delay until the inner loop gives the motors what the outer loop wants
ACC_HZ = 30.0  # the firmware's filter of the accelerometer, two poles at 1 kHz
SUPPLY_GAIN = 0.01  # per millisecond, of the firmware's low-pass of the battery voltage
SUPPLY_POWER = 2.05  # V T'/T at hover, 32.9 g, by the firmware's map T(V) of a Crazyflie 2.1; of a 2.1+ 1.96
GAP_MS = 50  # rows further apart are a gap; the SETTLE_MS after it are left out
SETTLE_MS = 400
LEAST_ROWS = 500
SET_LAGS_MS = range(-20, 300, 20)  # set heights before and after: a command follows its set point within these
LAG_S, DELAY_S = (0.01, 0.3), (-0.02, 0.06)  # bounds of the search; a delay below 0 is noise
EDGE = 0.02  # of those widths: a value so near to a bound lies beyond it
LEAST_HOPS, HOP_ROWS = 6, 40  # at least so many hops, each with a quarter of its rows: fewer do not tell the scatter
ERROR_MAX_S = 0.02  # a larger error is no measurement
WHEN_S = 0.0015  # computing, sending and sampling each fall somewhere within a millisecond: no row tells where


@dataclass(frozen=True)
class Rows:
    step: np.ndarray  # number of the millisecond, from any start
    thrust_N: np.ndarray
    acc_mps2: np.ndarray  # specific force along the thrust
    set_m: np.ndarray
    battery_V: np.ndarray
    hop: np.ndarray  # number of the hop that a row belongs to


def rows_of(packets: list[tuple[float, ...]]) -> Rows:
    """Of packets in the order of Rows; what is no number, or came twice, is left out."""
    of = np.array(packets, dtype=float).reshape(-1, 6)
    of = of[np.isfinite(of).all(axis=1) & (of[:, 4] > 0.0)]
    of = of[np.diff(of[:, 0], prepend=-1.0) > 0]
    return Rows(of[:, 0].astype(int), *of[:, 1:5].T, of[:, 5].astype(int))


@dataclass(frozen=True)
class Told:
    value: float
    error: float  # 95 % interval: value +- error


@dataclass(frozen=True)
class Actuator:
    lag_s: Told
    delay_s: Told
    mass_kg: Told  # the mass that this thrust would move


def _low_pass(gain: float, v: np.ndarray) -> np.ndarray:
    return lfilter([gain], [1.0, gain - 1.0], v - v[0]) + v[0]


class _Model:
    def __init__(self, rows: Rows) -> None:
        start = (rows.step[0] - 1) // TICK_MS * TICK_MS
        ticks = (rows.step - 1) // TICK_MS * TICK_MS - start  # the tick in which each thrust was commanded
        self._ms = np.arange(rows.step[-1] - start + 1)
        self._at = rows.step - start
        commanded_N = np.interp(np.arange(0, self._ms[-1] + 1, TICK_MS), ticks, rows.thrust_N)
        battery_V = np.interp(self._ms, self._at, rows.battery_V)
        supplied = (battery_V / _low_pass(SUPPLY_GAIN, battery_V)) ** SUPPLY_POWER
        self._thrust_N = np.repeat(commanded_N, TICK_MS)[: len(self._ms)] * supplied
        self._acc = butter(2, ACC_HZ, fs=1000.0)

        late = np.diff(rows.step, prepend=rows.step[0] - GAP_MS - 1) > GAP_MS
        settled = rows.step[np.maximum.accumulate(np.where(late, np.arange(len(late)), 0))] + SETTLE_MS
        self.good = rows.step > settled
        self._rows = rows
        self.fixed = np.column_stack([np.ones(len(rows.step)), self._at / 1000.0])
        heights_m = [np.interp(rows.step - lag, rows.step, rows.set_m) for lag in SET_LAGS_MS]
        self.instruments = np.column_stack([self.fixed, *heights_m])

    def columns(self, lag_s: float, delay_s: float) -> np.ndarray:
        late_N = np.interp(self._ms - MOTORS_MS - 1000.0 * delay_s, self._ms, self._thrust_N)
        acts_N = _low_pass(-np.expm1(-0.001 / lag_s), late_N) - late_N[0]
        return np.column_stack([lfilter(*self._acc, acts_N)[self._at], self.fixed])

    def fit(self, use: np.ndarray, start: np.ndarray) -> np.ndarray:
        """Lag, delay, and the mass that the thrust would move."""
        onto = np.linalg.qr(self.instruments[use])[0].T
        acc = onto @ self._rows.acc_mps2[use]

        def solved(at: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
            columns = onto @ self.columns(*at)[use]
            gain = np.linalg.lstsq(columns, acc, rcond=None)[0]
            return gain, columns @ gain - acc

        low, high = zip(LAG_S, DELAY_S)
        found = least_squares(lambda at: solved(at)[1], start, bounds=(low, high), x_scale=(0.02, 0.005)).x
        return np.array([*found, 1.0 / solved(found)[0][0]])


def _within(value: float, least: float, most: float) -> bool:
    edge = EDGE * (most - least)
    return least + edge < value < most - edge


def _is_told(lag_s: Told, delay_s: Told, mass_kg: Told) -> bool:
    inside = _within(lag_s.value, *LAG_S) and _within(delay_s.value, *DELAY_S)
    sure = 0.0 < lag_s.error < ERROR_MAX_S and WHEN_S < delay_s.error < ERROR_MAX_S
    return inside and sure and 0.0 <= mass_kg.error < 0.5 * mass_kg.value


def identify(rows: Rows) -> Actuator:
    """Failed: too few rows, or they tell nothing."""
    if len(rows.step) < LEAST_ROWS:
        raise Failed(f"{len(rows.step)} rows came; {LEAST_ROWS} and more tell the motors' lag")
    model = _Model(rows)
    hops, of_each = np.unique(rows.hop[model.good], return_counts=True)
    hops = hops[of_each >= HOP_ROWS]
    if len(hops) < LEAST_HOPS:
        raise Failed(f"{len(hops)} hops came without gaps; {LEAST_HOPS} and more tell the motors' lag")
    good = model.good & np.isin(rows.hop, hops)
    try:
        with np.errstate(all="ignore"):  # a thrust that does not move gives a mass that is not a number
            whole = model.fit(good, np.array([0.08, 0.005]))
            without = np.array([model.fit(good & (rows.hop != hop), whole[:2]) for hop in hops])
            spread = np.std(without, axis=0) * np.sqrt(len(hops) - 1) * t.ppf(0.975, len(hops) - 1)
    except (np.linalg.LinAlgError, ValueError) as why:
        raise Failed(f"the motors' lag is not to be told: {why}") from None
    spread[1] += WHEN_S
    lag_s, delay_s, mass_kg = (Told(float(value), float(error)) for value, error in zip(whole, spread))
    if not _is_told(lag_s, delay_s, mass_kg):
        raise Failed(
            f"the motors' lag is not to be told: {1000 * lag_s.value:.0f} +- {1000 * lag_s.error:.0f} ms, "
            f"delay {1000 * delay_s.value:.0f} +- {1000 * delay_s.error:.0f} ms, {1000 * mass_kg.value:.0f} g; "
            f"up to +- {1000 * ERROR_MAX_S:g} ms, from {1000 * LAG_S[0]:g} to {1000 * LAG_S[1]:g} ms is good"
        )
    return Actuator(lag_s, delay_s, mass_kg)
