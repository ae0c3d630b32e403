"""hop.py - up to half a metre, 30 cm forward and down again, flown by the app: the least script that flies."""

import sys

import cflib.crtp
from cflib.crazyflie.syncCrazyflie import SyncCrazyflie
from cflib.positioning.motion_commander import MotionCommander

cflib.crtp.init_drivers()
with SyncCrazyflie(*sys.argv[1:] or ["udp://127.0.0.1:19850"]) as connected:
    connected.wait_for_params()
    connected.cf.param.set_value("ceil.shadow", 0)
    with MotionCommander(connected, default_height=0.5) as commander:
        commander.forward(0.3)
