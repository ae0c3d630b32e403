"""channel.py - between a floor and a ceiling: what each curve says beside what its surface gives."""

import math

import flights
import passing
import run

FIRST, FLIGHTS = 111001, 100  # seeds on which nothing was tuned
SHOWN = {"floor": "over the floor alone", "unknown": "the floor unknown", "known": "the floor known"}


def mean_sd(values: list[float]) -> tuple[float, float]:
    mean = sum(values) / len(values)
    return mean, math.sqrt(sum((each - mean) ** 2 for each in values) / len(values))


def learned(level: str, flown: list[dict]) -> None:
    for row in flown[0]["learned"]:
        same = [
            next(
                other
                for other in flight["learned"]
                if (other["flight"], other["distance_mm"]) == (row["flight"], row["distance_mm"])
            )
            for flight in flown
        ]
        mean, sd = mean_sd([flights.number(each, "excess") for each in same])
        surface = f"{row['surface']}, {row['distance_mm']:g} mm"
        print(f"{level:6} {SHOWN[row['flight']]:20}  {surface:16}  {mean:7.4f}  {sd:6.4f}  {row['there']:7.4f}")


def held(level: str, flown: list[dict]) -> str:
    parts = []
    for name, words in SHOWN.items():
        segments = [s for flight in flown for s in flight["segments"] if s["label"] == name]
        rms = math.sqrt(sum(flights.number(s, "rms_mm") ** 2 for s in segments) / len(segments))
        touched = sum(s["contacts"] > 0 for s in segments)
        parts.append(f"{words} {rms:.2f} mm ({touched} of {len(segments)} touch)")
    return f"{level}, rms over all five heights: {'; '.join(parts)}"


def channel() -> None:
    """The excess of the thrust ratio at four distances of each flight, and how well the height was held."""
    passing.head("channel", FIRST, FLIGHTS)
    print("                                                  excess of the thrust ratio\nlevel  flight                "
          "surface           learned      sd    there")
    said = []
    for level in passing.LEVELS:
        flown = passing.fly("channel", "channel", level, first=FIRST, count=FLIGHTS)
        learned(level, flown)
        said.append(held(level, flown))
    print("", *said, sep="\n")
    run.progress()
