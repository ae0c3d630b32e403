#!/usr/bin/env python3
"""cf.py - a Crazyflie that runs the app, from the laptop: parameters, logs, the learning flight, the test flight.

Exit status: 0 done, 1 it could not be done or was stopped by hand (it has landed, unless the link is lost or the motors
were stopped), 2 bad input, 130 Ctrl-C.
"""

import argparse
import difflib
import math
import os
import re
import signal
import subprocess
import sys
from pathlib import Path

sys.dont_write_bytecode = True  # the source tree stays clean
sys.path.insert(0, str(Path(__file__).resolve().parent))
from cf import blocks, identify, ladder, log, params
from cf.dry import DryVehicle
from cf.errors import Failed, Refused
from cf.flight import ENDS, FAR_M, Plan
from cf.preflight import CEILING_M
from cf.terminal import say, wipe
from cf.vehicle import Vehicle

URI = "radio://0/80/2M/E7E7E7E7E7"


class Parser(argparse.ArgumentParser):
    def words(self) -> set[str]:
        """Options and commands, those of its commands included."""
        found = {option for action in self._actions for option in action.option_strings}
        for action in self._actions:
            for name, of_command in action.choices.items() if isinstance(action.choices, dict) else ():
                found |= {name} | of_command.words()
        return found

    def error(self, message: str):
        known = self.words()
        typed = [word for word in re.findall(r"--[\w-]+|(?<=invalid choice: ')[^']*", message) if word not in known]
        like = [near for word in typed for near in difflib.get_close_matches(word, sorted(known), 1, 0.7)]
        meant = f" (did you mean {like[0]}?)" if like else ""
        raise Refused(f"{message}{meant}; {self.prog} --help says what is allowed")


def version() -> str:
    """As the programs that are compiled say it."""
    root = Path(__file__).resolve().parents[1]
    said = subprocess.run(["tools/version.sh"], cwd=root, capture_output=True, text=True, check=False).stdout
    return f"cf.py {said.strip() or 'of a version that is not known'}"


class Version(argparse.Action):
    def __call__(self, parser, *_: object) -> None:
        print(version())
        parser.exit()


def between(least: float, most: float, unit: str):
    """A number from least to most, for argparse."""

    def parse(text: str) -> float:
        try:
            value = float(text)
        except ValueError:
            value = math.nan
        if not least <= value <= most:
            raise argparse.ArgumentTypeError(f"{text}: allowed are {least:g} to {most:g} {unit}")
        return value

    return parse


def gaps(text: str) -> tuple[float, ...]:
    """Centimetres, comma-separated, as metres."""
    parse = between(1.0, 100 * FAR_M, "cm, separated by commas")
    return tuple(round(parse(each) / 100, 6) for each in text.split(","))


def flight_options(command: argparse.ArgumentParser) -> None:
    command.add_argument(
        "--battery", type=between(3.5, 4.2, "V"), default=3.8, metavar="V", help="least before take-off, default 3.8"
    )
    command.add_argument("--log", type=Path, metavar="FILE.csv", help="log the flight (the variables of tools/cfclient)")
    command.add_argument(
        "--ceiling", type=between(*CEILING_M, "m"), default=1.5, metavar="M", help="that --dry-run assumes, default 1.5"
    )


def parser() -> argparse.ArgumentParser:
    top = Parser(prog="cf.py", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    top.add_argument("--uri", default=os.environ.get("CFLIB_URI", URI), help=f"default CFLIB_URI, else {URI}")
    top.add_argument("--version", action=Version, nargs=0, help="version and commit")
    dry = argparse.ArgumentParser(add_help=False)
    dry.add_argument("--dry-run", action="store_true", help="print what would be sent; no radio, no cflib")
    commands = top.add_subparsers(dest="command", required=True, parser_class=Parser)

    of_params = commands.add_parser("params", help="list, get, set, store parameters")
    actions = of_params.add_subparsers(dest="action", required=True, parser_class=Parser)
    for name, what, count in (
        ("list", "PATTERN", "*"),
        ("get", "NAME", "+"),
        ("set", "NAME=VALUE", "+"),
        ("store", "NAME", "+"),
    ):
        actions.add_parser(name, parents=[dry]).add_argument("what", metavar=what, nargs=count)

    of_log = commands.add_parser("log", parents=[dry], help="log variables to a CSV file")
    of_log.add_argument("names", metavar="NAME", nargs="*", help="log variables")
    of_log.add_argument("--out", type=Path, required=True, metavar="FILE.csv")
    of_log.add_argument("--config", type=Path, action="append", default=[], help="cfclient's file, or a folder of them")
    of_log.add_argument("--period", type=int, default=20, metavar="MS", help="of the named variables, default 20")
    of_log.add_argument("--for", dest="for_s", type=between(0.1, 86400, "s"), metavar="S", help="default: until Ctrl-C")

    learn = commands.add_parser("learn", parents=[dry], help="fly the learning flight, store the weights")
    test = commands.add_parser("test-flight", parents=[dry], help="far hover, then 9, 5 and 3 cm below the ceiling")
    for each in learn, test:
        each.add_argument("--hold", type=between(1, 60, "s"), default=10.0, metavar="S", help="at each gap, default 10")
        flight_options(each)
    flight_options(commands.add_parser("identify", parents=[dry], help="hop for 20 s: the motors' lag and delay"))
    test.add_argument("--gaps", type=gaps, default=(0.09, 0.05, 0.03), metavar="CM,CM", help="default 9,5,3")
    return top


def fly(vehicle: Vehicle | DryVehicle, asked: argparse.Namespace) -> None:
    plan = Plan(getattr(asked, "gaps", ()), getattr(asked, "hold", identify.HOVER_S), asked.battery)
    file = None if asked.dry_run else asked.log
    if asked.command == "identify":
        if not asked.dry_run:
            identify.libraries()
        rows = identify.hop_rows(vehicle, plan, file)
        if not asked.dry_run:
            identify.tell(vehicle, rows)
    else:
        (ladder.learn if asked.command == "learn" else ladder.test_flight)(vehicle, plan, file)


def run(asked: argparse.Namespace) -> None:
    if asked.command == "log":
        blocks.check_period(asked.period, "--period")
    vehicle = DryVehicle(getattr(asked, "ceiling", 1.5)) if asked.dry_run else Vehicle(asked.uri)
    try:
        if asked.dry_run and getattr(asked, "action", "") in ("list", "get"):
            say(f"would read {' '.join(asked.what) or 'all parameters'}")
        elif asked.command == "params":
            action = {"list": params.list_all, "get": params.get, "set": params.set_all, "store": params.store}
            action[asked.action](vehicle, asked.what)
        elif asked.command == "log":
            wanted = log.chosen(vehicle, asked.names, asked.config, asked.period)
            log.run(vehicle, wanted, None if asked.dry_run else asked.out, asked.for_s or math.inf)
        else:
            fly(vehicle, asked)
    finally:
        vehicle.close()


def main(words: list[str]) -> int:
    for kind in ENDS:
        signal.signal(kind, signal.default_int_handler)
    try:
        run(parser().parse_args(words))
        return 0
    except (Refused, Failed) as why:
        wipe()
        print(f"cf.py: {why}", file=sys.stderr)
        return 2 if isinstance(why, Refused) else 1
    except KeyboardInterrupt:
        wipe()
        return 130


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
