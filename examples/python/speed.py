#!/usr/bin/env python3
"""Prints time and speed of every motion: live, or from the log that is named.

  lcm-gen -p --ppath . ../../lcmtypes/*.lcm    # once: makes the package plumb beside this file
  ./speed.py [LOG]
"""
import sys
import lcm_messages
from plumb import ego_motion_t

source = lcm_messages.log(sys.argv[1]) if len(sys.argv) > 1 else lcm_messages.live()
for channel, data in source:
    if channel == 'EGO_MOTION':
        motion = ego_motion_t.decode(data)
        if motion.status in (ego_motion_t.STATUS_OK, ego_motion_t.STATUS_STANDSTILL):
            speed, deviation = motion.velocity_ground_m_s[0], motion.speed_std_m_s
            print(f'{motion.utime / 1e6:.3f} s: {speed:.2f} +- {deviation:.2f} m/s', flush=True)
