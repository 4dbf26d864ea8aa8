#!/usr/bin/python3
"""Prints how many seconds a kernel needs to boot, play the LCM log and stop, with a margin.

    log_seconds.py LOG SPEED
"""
import struct
import sys

first = last = None
with open(sys.argv[1], 'rb') as log:
    while len(header := log.read(28)) == 28:
        sync, _, stamp_us, channel_bytes, data_bytes = struct.unpack('>IqqII', header)
        if sync != 0xEDA1DA01:
            sys.exit('no LCM log')
        log.seek(channel_bytes + data_bytes, 1)
        first = stamp_us if first is None else first
        last = stamp_us
if first is None:
    sys.exit('an empty LCM log')
print(int(60 + 2 * (last - first) * 1e-6 / float(sys.argv[2])))
