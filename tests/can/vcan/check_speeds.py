#!/usr/bin/python3
"""Checks that an LCM log holds VEHICLE_SPEED messages with one speed and times that increase.

    check_speeds.py LOG SPEED_M_S
"""
import struct
import sys

speeds, times = set(), []
with open(sys.argv[1], 'rb') as log:
    while len(header := log.read(28)) == 28:
        _, _, _, channel_bytes, data_bytes = struct.unpack('>IqqII', header)
        channel, data = log.read(channel_bytes), log.read(data_bytes)
        if channel != b'VEHICLE_SPEED':
            continue
        _, utime, _, speed_m_s, _ = struct.unpack('>qqqdd', data)
        speeds.add(round(speed_m_s, 9))
        times.append(utime)
print(f'{len(times)} messages of the vehicle, {sorted(speeds)} m/s')
sys.exit(0 if len(times) >= 5 and speeds == {float(sys.argv[2])} and times == sorted(set(times)) else 1)
