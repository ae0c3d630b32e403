"""The files that a user of rotorpy writes for `gap`: what they know of the vehicle, and nothing of what is hidden."""

from pathlib import Path

from draw import Vehicle
from flights import HEAD

COLUMNS = """# Of a table that rotorpy makes of a simulation, with the battery and two range sensors beside it.
# A row is of one instant.
rest_height_m = {rest:.6g}
acceleration = "body"

[columns]
time = {{column = "time", unit = "s"}}
x = {{column = "mocap_x", unit = "m", late_ms = 0}}
y = {{column = "mocap_y", unit = "m", late_ms = 0}}
z = {{column = "mocap_z", unit = "m", late_ms = 0}}
vx = {{column = "mocap_xdot", unit = "m/s", late_ms = 0}}
vy = {{column = "mocap_ydot", unit = "m/s", late_ms = 0}}
vz = {{column = "mocap_zdot", unit = "m/s", late_ms = 0}}
qw = {{column = "mocap_qw", unit = "1", late_ms = 0}}
qx = {{column = "mocap_qx", unit = "1", late_ms = 0}}
qy = {{column = "mocap_qy", unit = "1", late_ms = 0}}
qz = {{column = "mocap_qz", unit = "1", late_ms = 0}}
ax = {{column = "ax", unit = "m/s2"}}
ay = {{column = "ay", unit = "m/s2"}}
az = {{column = "az", unit = "m/s2"}}
gx = {{column = "gx", unit = "rad/s"}}
gy = {{column = "gy", unit = "rad/s"}}
gz = {{column = "gz", unit = "rad/s"}}
m1 = {{column = "r1des", unit = "rad/s"}}
m2 = {{column = "r2des", unit = "rad/s"}}
m3 = {{column = "r3des", unit = "rad/s"}}
m4 = {{column = "r4des", unit = "rad/s"}}
set_x = {{column = "xdes", unit = "m"}}
set_y = {{column = "ydes", unit = "m"}}
set_z = {{column = "zdes", unit = "m"}}
set_yaw = {{column = "yawdes", unit = "rad"}}
vbat = {{column = "vbat", unit = "V"}}
range = {{column = "range_up", unit = "m", optional = true}}
range_down = {{column = "range_down", unit = "m"}}
"""

VEHICLE = """name = "rotorpy multirotor"
mass_kg = {mass:.6g}
rotor_radius_m = {radius:.6g}
motor_tau_s = {tau_m:.6g} # rotorpy's tau_m, of the rotor's speed
thrust_min_N = 0.0
thrust_max_N = {most:.6g}
{ceiling}
[thrust_map]
kind = "speed"
c = [0.0, 0.0, {k_eta:.6g}]

[body]
inertia_kgm2 = [{Ixx:.6g}, {Iyy:.6g}, {Izz:.6g}]
cg_above_feet_m = {rest:.6g} # rotorpy has no feet: the rotors lie in the plane of the centre of mass
rotor_above_feet_m = {rest:.6g}
top_above_rotor_m = 0.0

[rotors]
x_m = [{x}]
y_m = [{y}]
spin = [-1, 1, -1, 1] # against the torque on the body, rotorpy's rotor_directions
torque_ratio_m = {ratio:.6g}
kf_Ns2 = {k_eta:.6g}
inertia_kgm2 = 0.0 # rotorpy's rotors have none
"""

CONTROLLER = """
[controller]
kind = "other"
rate_Hz = {rate} # rotorpy commands once in a step of the simulation
"""

EFFECT = """
[[effect]]
name = "{name}"
k = {k:.6g}
"""


def vehicle_text(v: Vehicle) -> str:
    p = v.params
    text = VEHICLE.format(
        **p, radius=v.radius_m, most=4 * p["k_eta"] * p["rotor_speed_max"] ** 2, rest=v.rest_m, ratio=p["k_m"] / p["k_eta"],
        ceiling="" if v.ceiling_m is None else f"ceiling_m = {v.ceiling_m:.6g}\n",
        x=", ".join(f"{x:.6g}" for x in v.x_m), y=", ".join(f"{y:.6g}" for y in v.y_m))
    for name, key in (("rotor_drag", "k_d"), ("climb_inflow", "k_z")):
        if p[key] > 0.0:
            text += EFFECT.format(name=name, k=p[key])
    return text + CONTROLLER.format(rate=v.rate_Hz)


def log_text(v: Vehicle, rows: list[list[float]]) -> str:
    keep = [i for i, name in enumerate(HEAD) if name != "range_up" or v.ceiling_m is not None]
    return "".join(",".join(line) + "\n" for line in
                   [[HEAD[i] for i in keep], *([f"{row[i]:.9g}" for i in keep] for row in rows)])


def write(folder: Path, v: Vehicle, flights: list[list[list[float]]]) -> list[Path]:
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "vehicle.toml").write_text(vehicle_text(v))
    (folder / "columns.toml").write_text(COLUMNS.format(rest=v.rest_m))
    logs = [folder / f"flight{i + 1}.csv" for i in range(len(flights))]
    for path, rows in zip(logs, flights):
        path.write_text(log_text(v, rows))
    return logs
