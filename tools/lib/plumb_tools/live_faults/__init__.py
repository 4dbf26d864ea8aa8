"""Puts faults into the live processes and judges what they send on CAN: tools/evaluate/live_faults."""
