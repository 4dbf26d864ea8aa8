#!/usr/bin/python3
"""Checks that an LCM log holds VEHICLE_SPEED messages with one speed and times that increase.

    check_speeds.py LOG SPEED_M_S
"""
import pathlib
import struct
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3] / 'tools/lib'))
from plumb_tools.live_faults.wire import read_log  # noqa: E402

speeds, times = set(), []
for _, channel, data in read_log(sys.argv[1]):
    if channel == 'VEHICLE_SPEED':
        _, utime, _, speed_m_s, _ = struct.unpack('>qqqdd', data)
        speeds.add(round(speed_m_s, 9))
        times.append(utime)
print(f'{len(times)} messages of the vehicle, {sorted(speeds)} m/s')
sys.exit(0 if len(times) >= 5 and speeds == {float(sys.argv[2])} and times == sorted(set(times)) else 1)
