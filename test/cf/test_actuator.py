"""How late the motors are, out of rows that a loop of a few lines flew: in gusts that it answers to, and with rows lost."""

import re
import unittest

import numpy as np
import rig
from scipy.signal import butter, lfilter, lfilter_zi

from cf import actuator
from cf.errors import Failed

assert rig.ROOT  # it knows where tools are

HOPS, HOP_S, G_MPS2, MASS_KG = 12, 1.6, 9.81, 0.033


def hop(s: float) -> tuple[float, float]:
    """Height and acceleration, down by 2.5 cm within 0.35 s and up again half a hop later."""
    share, way_m = min(s % (HOP_S / 2) / 0.35, 1.0), -0.025 if s % HOP_S < HOP_S / 2 else 0.025
    gone = share**3 * (10 - 15 * share + 6 * share**2)
    return min(0.0, -way_m) + way_m * gone, way_m / 0.35**2 * share * (60 - 180 * share + 120 * share**2)


def flown(lag_s: float, delay_s: float, gust_mps2: float = 0.0, sag: float = 0.0, seed: int = 1) -> list[tuple[float, ...]]:
    """A row every 10 ms: step, thrust, specific force, height set, battery, hop. The loop answers to its accelerometer."""
    n, rng = int(1000 * HOPS * HOP_S), np.random.default_rng(seed)
    b, a = butter(2, 30.0, fs=1000.0)
    state = lfilter_zi(b, a) * G_MPS2
    late_N = np.full(200, MASS_KG * G_MPS2)
    z_m = vel_mps = blows_mps2 = 0.0
    force_N = thrust_N = late_N[0]
    supply_V = battery_V = 3.9
    rows = []
    for ms in range(n):
        set_m, set_mps2 = hop(ms / 1000)
        late_N[ms % 200] = thrust_N
        battery_V = 3.9 - sag * force_N
        supply_V += 0.01 * (battery_V - supply_V)
        wanted_N = late_N[(ms - 1 - round(1000 * delay_s)) % 200] * (battery_V / supply_V) ** 2
        force_N += (wanted_N - force_N) * -np.expm1(-0.001 / lag_s)
        blows_mps2 += -0.001 / 0.3 * blows_mps2 + gust_mps2 * np.sqrt(0.002 / 0.3) * rng.normal()
        acc_mps2 = force_N / MASS_KG + blows_mps2
        vel_mps += 0.001 * (acc_mps2 - G_MPS2)
        z_m += 0.001 * vel_mps
        seen, state = lfilter(b, a, [acc_mps2 + rng.normal(0.0, 0.1)], zi=state)
        if ms % 10 == 0:
            thrust_N = MASS_KG * (G_MPS2 + set_mps2 + 20.0 * (set_m - z_m) - 8.0 * vel_mps - 0.4 * (seen[0] - G_MPS2))
        if ms % 10 == 9:
            rows.append((1000 + ms, thrust_N, seen[0], set_m, battery_V, int(ms / 1000 / HOP_S)))
    return rows


class Lag(unittest.TestCase):
    def close(self, told: actuator.Told, truth: float, within: float, wider: float = 0.0) -> None:
        self.assertLess(told.error, within + wider)
        self.assertAlmostEqual(told.value, truth, delta=within)

    def test_it_is_found_with_the_delay_and_the_mass(self) -> None:
        for lag_s, delay_s in ((0.08, 0.004), (0.04, 0.02), (0.12, 0.0)):
            with self.subTest(lag_s=lag_s, delay_s=delay_s):
                of = actuator.identify(actuator.rows_of(flown(lag_s, delay_s)))
                self.close(of.lag_s, lag_s, 0.003)
                self.close(of.delay_s, delay_s, 0.002, actuator.WHEN_S)
                self.close(of.mass_kg, MASS_KG, 0.0005)

    def test_the_intervals_hold_what_they_are_to_in_19_of_20(self) -> None:
        rng, flights, held = np.random.default_rng(11), 16, [0, 0]
        for seed in range(flights):
            lag_s, delay_s = rng.uniform(0.04, 0.12), rng.uniform(0.0, 0.015)
            of = actuator.identify(actuator.rows_of(flown(lag_s, delay_s, seed=seed)))
            held[0] += abs(of.lag_s.value - lag_s) <= of.lag_s.error
            held[1] += abs(of.delay_s.value - delay_s) <= of.delay_s.error
        self.assertGreaterEqual(min(held), 13)  # fewer in one of 70 such tests, at 0.95 each

    def test_the_power_of_the_voltage_is_that_of_the_firmwares_map_at_hover(self) -> None:
        stock = (rig.ROOT / "sim" / "crazyflie" / "stock_units.c").read_text()
        cubic = [float(each) for each in re.search(r"volt_cubic = \{(.*?)\}", stock)[1].split(",")]
        volts = np.linspace(1.0, 4.2, 3201)
        thrust_N = np.polyval(cubic[::-1], volts)
        power = volts * np.gradient(thrust_N, volts) / thrust_N
        at_hover = np.interp(0.0329 * G_MPS2 / 4, thrust_N, power)
        self.assertAlmostEqual(actuator.SUPPLY_POWER, at_hover, delta=0.02)

    def test_gusts_that_the_controller_answers_to_do_not_make_it_quicker(self) -> None:
        found_s = [actuator.identify(actuator.rows_of(flown(0.08, 0.004, 0.1, seed=seed))).lag_s for seed in range(6)]
        mean_s = np.mean([each.value for each in found_s])
        self.assertLess(abs(mean_s - 0.08), 3 * np.sqrt(np.mean([(each.error / 2.2)**2 for each in found_s]) / 6))

    def test_a_battery_that_sags_makes_it_no_longer_and_no_heavier(self) -> None:
        of = actuator.identify(actuator.rows_of(flown(0.08, 0.004, sag=0.6)))
        self.close(of.lag_s, 0.08, 0.003)
        self.close(of.mass_kg, MASS_KG, 0.0005)

    def test_rows_that_are_lost_come_twice_or_are_no_numbers_cost_little(self) -> None:
        rows = flown(0.08, 0.004)
        for what, left in (
            ("one in twenty", [row for i, row in enumerate(rows) if i % 20]),
            ("half a second", rows[:600] + rows[650:]),
            ("twice", [row for row in rows for _ in range(2)]),
            ("no number", [(*row[:2], np.nan, *row[3:]) if i % 50 == 7 else row for i, row in enumerate(rows)]),
        ):
            with self.subTest(what=what):
                of = actuator.identify(actuator.rows_of(left))
                self.close(of.lag_s, 0.08, 0.003)
                self.close(of.delay_s, 0.004, 0.003, actuator.WHEN_S)

    def test_what_tells_nothing_is_refused(self) -> None:
        rows = flown(0.08, 0.004)
        still = [(*row[:3], 0.0, *row[4:]) for row in rows]
        steady = [(row[0], 0.3, *row[2:]) for row in rows]
        turned = [(row[0], -row[1], *row[2:]) for row in rows]
        for what, left, says in (
            ("none", [], "0 rows came"),
            ("few", rows[:400], "400 rows came"),
            ("in bursts", [row for i, row in enumerate(rows) if i % 8 < 3], "0 hops came without gaps"),
            ("no battery", [(*row[:4], 0.0, row[5]) for row in rows], "0 rows came"),
            ("no hop", still, "not to be told"),
            ("one thrust", steady, "not to be told"),
            ("thrust downwards", turned, "not to be told"),
        ):
            with self.subTest(what=what), self.assertRaisesRegex(Failed, says):
                actuator.identify(actuator.rows_of(left))

    def test_what_lies_beyond_where_it_is_looked_for_is_refused(self) -> None:
        for lag_s, delay_s in ((0.08, 0.08), (0.08, 0.1), (0.35, 0.004), (0.005, 0.004)):
            with self.subTest(lag_s=lag_s, delay_s=delay_s), self.assertRaisesRegex(Failed, "not to be told"):
                actuator.identify(actuator.rows_of(flown(lag_s, delay_s)))


if __name__ == "__main__":
    unittest.main()
