"""How often the intervals of cf.py identify hold what they are to: hops of a loop of a few lines, lag and delay drawn."""

import numpy as np
from test_actuator import flown

from cf import actuator
from cf.errors import Failed

FLIGHTS, GUSTS_MPS2 = 200, {0.0: 34001, 0.1: 33001}  # seeds from there on; nothing was tuned on them


def row(gust_mps2: float, first: int) -> str:
    rng, told = np.random.default_rng(first), []
    for seed in range(first, first + FLIGHTS):
        truth = rng.uniform(0.04, 0.12), rng.uniform(0.0, 0.015)
        try:
            of = actuator.identify(actuator.rows_of(flown(*truth, gust_mps2, seed=seed)))
        except Failed:
            continue
        told.append([(each.value - true, each.error) for each, true in zip((of.lag_s, of.delay_s), truth)])
    off_s, error_s = np.moveaxis(np.array(told), 2, 0)
    text = f"{gust_mps2:9.1f}  {FLIGHTS - len(told):7d}"
    for k in (0, 1):
        held = int(np.sum(np.abs(off_s[:, k]) <= error_s[:, k]))
        text += f"  {held:4d} of {len(told)}  {1000 * np.mean(off_s[:, k]):7.1f}  {1000 * np.mean(error_s[:, k]):9.1f}"
    return text


if __name__ == "__main__":
    print(f"{FLIGHTS} flights each, lags of 40 to 120 ms, delays to 15 ms\n")
    print("                     lag held  too long  interval    delay held  too long  interval")
    print("gust m/s2  refused                   ms     +- ms                      ms     +- ms")
    for gust_mps2, first in GUSTS_MPS2.items():
        print(row(gust_mps2, first))
