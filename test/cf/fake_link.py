"""fake_link.py - a link driver for the stock library: speaks CRTP for a FakeVehicle in this process.

URI fake://name. Answers at once, in the library's receiving thread. Time passes only in pass_time(), which the
tests put in the place of the commands' sleep().
"""

import errno
import struct
import time
import zlib
from queue import Empty, Queue

import declared
from cflib.crtp.crtpdriver import CRTPDriver
from cflib.crtp.crtpstack import CRTPPacket
from cflib.crtp.exceptions import WrongUriType
from fake_vehicle import STEP_S, FakeVehicle

PARAM = {"int8_t": (0, "b"), "int16_t": (1, "h"), "int32_t": (2, "i"), "float": (6, "f")}
PARAM |= {"uint8_t": (8, "B"), "uint16_t": (9, "H"), "uint32_t": (10, "I")}
LOG = {"uint8_t": (1, "B"), "uint16_t": (2, "H"), "uint32_t": (3, "I"), "int8_t": (4, "b")}
LOG |= {"int16_t": (5, "h"), "int32_t": (6, "i"), "float": (7, "f"), "FP16": (8, "e")}
LOG_FORMAT = {number: letter for number, letter in LOG.values()}
READ_ONLY, EXTENDED = 0x40, 0x10
PROTOCOL = 12
BLOCK_BYTES = 26


class FakeLink(CRTPDriver):
    vehicle: FakeVehicle  # of the next connection
    open: "FakeLink | None" = None  # the connection that stands

    def connect(self, uri, radio_link_statistics_callback, link_error_callback) -> None:
        if not uri.startswith("fake://"):
            raise WrongUriType("not a fake URI")
        self.needs_resending = False
        self.uri, self._error = uri, link_error_callback
        self._v = FakeLink.vehicle
        self._out: Queue[CRTPPacket] = Queue()
        self._blocks: dict[int, list[tuple[int, str]]] = {}
        self._period: dict[int, int] = {}
        self._next_ms: dict[int, int] = {}
        self.dead = self.mute = self._given = False  # mute: what is sent arrives, nothing comes back
        FakeLink.open = self

    def close(self) -> None:
        FakeLink.open = None

    def get_name(self) -> str:
        return "fake"

    def receive_packet(self, wait=0):
        if self._given:  # who asks for the next one is done with the last one
            self._out.task_done()
            self._given = False
        try:
            packet = self._out.get(wait != 0, min(abs(wait), 0.05))  # so that closing does not wait
        except Empty:
            return None
        self._given = True
        return packet

    def send_packet(self, pk) -> None:
        if self.dead:
            return
        answer = {2: self._param, 4: self._mem, 5: self._log, 8: self._high_level, 9: self._supervisor}
        answer |= {13: self._platform, 15: self._link}
        if pk.port in answer:
            answer[pk.port](pk.channel, bytes(pk.data))

    def _say(self, port: int, channel: int, data: bytes) -> None:
        packet = CRTPPacket()
        packet.set_header(port, channel)
        packet.data = data
        assert packet.is_data_size_valid(), "more than a packet holds"
        if not self.mute:
            self._out.put(packet)

    def lose(self, told: bool = True) -> None:
        """The link is gone; told: the driver notices, as the radio's does."""
        self.dead = True
        if told:
            self._error("Too many packets lost")

    def tell(self, text: str) -> None:
        """On the console."""
        self._say(0, 0, text.encode())

    # --- ports -----------------------------------------------------------------------------------------------

    def _link(self, channel: int, data: bytes) -> None:
        self._say(15, channel, b"Bitcraze Crazyflie".ljust(30, b"\0") if channel == 1 else data)

    def _platform(self, channel: int, data: bytes) -> None:
        if channel == 1 and data == b"\0":
            self._say(13, 1, bytes((0, PROTOCOL)))

    def _mem(self, channel: int, data: bytes) -> None:
        self._say(4, 0, b"\1\0")

    def _toc(self, port: int, rows: tuple[declared.Row, ...], data: bytes, of_row) -> None:
        if data[0] == 3:
            crc = zlib.crc32(repr(rows).encode())
            self._say(port, 0, struct.pack("<BHI", 3, len(rows), crc) + bytes((16, 128)))
        else:
            row = rows[struct.unpack("<H", data[1:3])[0]]
            group, name = row.name.split(".")
            self._say(port, 0, data[:3] + bytes((of_row(row),)) + f"{group}\0{name}\0".encode())

    def _param(self, channel: int, data: bytes) -> None:
        rows = self._v.param_rows
        if channel == 0:
            flags = lambda r: (0 if r.writable else READ_ONLY) | (EXTENDED if r.persistent else 0)
            return self._toc(2, rows, data, lambda row: PARAM[row.kind][0] | flags(row))
        row = rows[struct.unpack_from("<H", data, 1 if channel == 3 else 0)[0]]
        form = "<" + PARAM[row.kind][1]
        value = self._v.param[row.name]
        if channel == 1:
            self._say(2, 1, data + b"\0" + struct.pack(form, value if form == "<f" else int(value)))
        elif channel == 2:
            self._say(2, 2, data)
            self._v.write(row.name, struct.unpack(form, data[2:])[0])
            self._v.judge()
        elif data[0] == 7:
            self._say(2, 3, data + bytes((0, row.persistent)))
        elif data[0] == 3:
            good = row.name not in self._v.store_fails
            if good:
                self._v.stored[row.name] = value
            self._say(2, 3, data + bytes((0 if good else errno.ENOENT,)))

    def _log(self, channel: int, data: bytes) -> None:
        rows = self._v.log_rows
        if channel == 0:
            return self._toc(5, rows, data, lambda row: LOG[row.kind][0])
        command, number = data[0], data[1] if len(data) > 1 else 0
        error = 0
        if command == 5:
            self._period.clear()
            self._blocks.clear()
        elif command in (6, 7):
            if command == 6:
                self._blocks[number] = []
            for kind, index in struct.iter_unpack("<BH", data[2:]):
                self._blocks[number].append((kind & 15, rows[index].name))
            size = sum(struct.calcsize("<" + LOG_FORMAT[kind]) for kind, _ in self._blocks[number])
            error = errno.E2BIG if size > BLOCK_BYTES else 0
        elif command == 3:
            self._period[number] = 10 * data[2]
            self._next_ms[number] = round(1000 * self._v.time_s)
        else:
            self._period.pop(number, None)
        self._say(5, 1, bytes((command, number, error)))

    def _high_level(self, channel: int, data: bytes) -> None:
        if data[0] in (7, 8):
            z_m, _, _, duration_s = struct.unpack("<ff?f", data[2:])
            self._v.way("take off" if data[0] == 7 else "land", z_m, duration_s)
        elif data[0] == 12:
            _, _, x_m, y_m, z_m, yaw_rad, duration_s = struct.unpack("<BBfffff", data[2:])
            self._v.way("go to", z_m, duration_s, round(x_m, 3), round(y_m, 3), round(yaw_rad, 4))
        elif data[0] == 3:
            self._v.stop()
        self._say(8, 0, bytes((data[0], 0, 0, 0)))

    def _supervisor(self, channel: int, data: bytes) -> None:
        if channel == 1 and data[0] == 4:
            self._v.feed()
        elif channel == 1 and data[0] == 3:
            self._v.emergency_stop()
        elif channel == 1 and data[0] == 1:
            self._say(9, 1, bytes((0x81, 1, 1)))

    # --- time ------------------------------------------------------------------------------------------------

    def send_due(self) -> None:
        now_ms = round(1000 * self._v.time_s)
        for number, period_ms in list(self._period.items()):
            if now_ms < self._next_ms[number] or self.dead:
                continue
            self._next_ms[number] = now_ms + period_ms
            stamp = struct.pack("<I", now_ms & 0xFFFFFF)[:3]
            values = b""
            for kind, name in self._blocks[number]:
                value, form = self._v.logged[name], LOG_FORMAT[kind]
                values += struct.pack("<" + form, value if form in "fe" else int(value))
            self._say(5, 2, bytes((number,)) + stamp + values)

    def drained(self) -> bool:
        return self._out.unfinished_tasks == 0


def now_s() -> float:
    return FakeLink.vehicle.time_s


def pass_time(duration_s: float) -> None:
    """In the place of sleep(): the vehicle lives on, and its packets arrive before this returns."""
    for _ in range(max(1, round(duration_s / STEP_S))):
        FakeLink.vehicle.advance()
        link = FakeLink.open
        if not link:
            continue
        link.send_due()
        end_s = time.monotonic() + 5.0
        while not link.drained() and time.monotonic() < end_s and not link.dead:
            time.sleep(0.0001)
