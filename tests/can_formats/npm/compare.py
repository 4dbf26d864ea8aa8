#!/usr/bin/python3
"""Compares what candied read from the DBC with what canmatrix reads.

  compare.py DBC READ_JSON
"""
import json
import logging
import sys

logging.disable(logging.WARNING)  # canmatrix tells of formats that it cannot load
import canmatrix.formats  # noqa: E402

dbc = canmatrix.formats.loadp_flat(sys.argv[1])
with open(sys.argv[2]) as file:
    read = json.load(file)
assert sorted(message['id'] for message in read['messages']) == sorted(f.arbitration_id.id for f in dbc.frames)
num_signals = 0
for message in read['messages']:
    frame = next(frame for frame in dbc.frames if frame.arbitration_id.id == message['id'])
    assert (message['name'], message['dlc'], len(message['signals'])) == (frame.name, frame.size, len(frame.signals))
    for got in message['signals']:
        signal = frame.signal_by_name(got['name'])
        expected = {
            'startBit': signal.start_bit, 'length': signal.size, 'factor': float(signal.factor),
            'offset': float(signal.offset), 'min': float(signal.min), 'max': float(signal.max), 'unit': signal.unit,
            'signed': signal.is_signed, 'endian': 'Intel', 'multiplexer': signal.multiplex == 'Multiplexor',
            'multiplex': {'Multiplexor': 'M', None: ''}.get(signal.multiplex, f'm{signal.multiplex}'),
            'values': {str(raw): word for raw, word in signal.values.items()} or None}
        for field, value in expected.items():
            assert got[field] == value, f'{got["name"]}: {field} is {got[field]!r} and not {value!r}'
        # candied moves semicolons that stand inside of a comment.
        assert got['description'].replace(';', '') == (signal.comment or '').replace(';', ''), got['name']
        num_signals += 1
assert num_signals > 200
print(f'{num_signals} signals of {len(read["messages"])} messages are the same')
