"""desk.py - what a drone at the desk costs: one that hovers, with a client that logs four variables at 100 Hz."""

import contextlib
import os
import re
import select
import socket
import struct
import subprocess
import time
from typing import NamedTuple

from run import OUT, Failed

BEGINS, RESETS_LOGS, ECHOES = b"\xfd\x00", b"\x5d\x05", b"\xfc\x00"
BLOCK = b"\x5d\x06\x01" + b"".join(struct.pack("<BH", 7, log) for log in range(4))  # the first four, as floats
STARTS = b"\x5d\x03\x01\x01"  # every 10 ms
TAKES_OFF = b"\x8c\x07\x00" + struct.pack("<ffBf", 0.5, 0.0, 1, 2.0)
LOGGED = 0x5E  # the header of a block's values
ALIVE_S = 0.1  # as the stock library asks for an echo
LOOK_S = 0.01
BOOT_S = 1.0


class Flown(NamedTuple):
    wall_s: float
    cpu_s: float
    flown_s: float
    logs: int


def free_port(drones: int) -> int:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as taken:
        taken.bind(("127.0.0.1", 0))
        return min(taken.getsockname()[1], 65535 - drones)


def dial(port: int) -> socket.socket:
    client = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    client.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 1 << 20)
    client.connect(("127.0.0.1", port))
    for packet in (BEGINS, RESETS_LOGS, BLOCK, STARTS, TAKES_OFF):
        client.send(packet)
    return client


def listen(clients: list[socket.socket], until_s: float) -> int:
    """Takes what comes; how many packets of logs."""
    logs = 0
    while (left_s := until_s - time.monotonic()) > 0:
        for client in select.select(clients, [], [], left_s)[0]:
            try:
                logs += client.recv(64)[0] == LOGGED
            except ConnectionRefusedError:
                return logs  # the desk has ended
    return logs


def fly(drones: int, speed: int, flown_s: float) -> Flown:
    """Of simulated seconds; the desk ends by itself."""
    port = free_port(drones)
    words = [OUT / "desk", "--port", port, "--page", 0, "--drones", drones, "--speed", speed, "--for", BOOT_S + flown_s]
    desk = subprocess.Popen(list(map(str, words)), stdout=subprocess.PIPE, text=True)
    said = desk.stdout.readline()
    began_s, began_cpu_s = time.monotonic(), cpu_s(desk.pid)
    if not re.match("A simulated Crazyflie", said):
        raise Failed("desk does not start")
    clients = [dial(port + i) for i in range(drones)]
    logs, said_s = 0, began_s
    while not os.waitid(os.P_PID, desk.pid, os.WEXITED | os.WNOHANG | os.WNOWAIT):
        logs += listen(clients, time.monotonic() + LOOK_S)
        used_s = cpu_s(desk.pid) - began_cpu_s
        if time.monotonic() - said_s > ALIVE_S:
            said_s = time.monotonic()
            for client in clients:
                with contextlib.suppress(ConnectionRefusedError):  # the desk has ended
                    client.send(ECHOES)
    wall_s = time.monotonic() - began_s
    desk.communicate()
    for client in clients:
        client.close()
    return Flown(wall_s, used_s, flown_s, logs)


def cpu_s(pid: int) -> float:
    """User's and system's, so far."""
    with open(f"/proc/{pid}/stat") as stat:
        user, system = stat.read().rsplit(")", 1)[1].split()[11:13]
    return (int(user) + int(system)) / os.sysconf("SC_CLK_TCK")


def load() -> None:
    fast = fly(1, 1000, 1200.0)
    print(f"one drone, --speed 1000: {fast.flown_s / fast.wall_s:.0f} times real time")
    for drones in (1, 4):
        real = fly(drones, 1, 20.0)
        share = real.logs / (drones * 100 * real.flown_s)
        came = f"{100 * share:.0f} % of the logs came"
        print(f"{drones} in real time: {real.cpu_s / real.flown_s:.3f} CPU seconds a flown second, {came}")
