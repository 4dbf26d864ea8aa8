"""Reads MCAP files by the specification alone (mcap.dev/spec), for the tests of plumb-export."""
import struct
import zlib

MAGIC = b'\x89MCAP0\r\n'


class Fields:
    """A cursor over the fields of a record."""

    def __init__(self, data):
        self.data, self.at = data, 0

    def number(self, kind):
        value, = struct.unpack_from('<' + kind, self.data, self.at)
        self.at += struct.calcsize('<' + kind)
        return value

    def blob(self, kind='I'):
        size = self.number(kind)
        self.at += size
        return self.data[self.at - size:self.at]

    def text(self):
        return self.blob().decode()

    def map(self, key, value):
        inner, found = Fields(self.blob()), {}
        while inner.at < len(inner.data):
            word = inner.text() if key == 's' else inner.number(key)
            found[word] = inner.text() if value == 's' else inner.number(value)
        return found


def records(data, at, end):
    """Yields (opcode, offset of the record, content) from `at` to `end`."""
    while at < end:
        opcode, size = struct.unpack_from('<BQ', data, at)
        yield opcode, at, data[at + 9:at + 9 + size]
        at += 9 + size
    assert at == end, 'a record ends behind its section'


class McapFile:
    """Everything in a file. Raises AssertionError where it breaks the specification."""

    def __init__(self, path):
        self.data = data = path.read_bytes()
        assert data[:8] == MAGIC and data[-8:] == MAGIC, 'no magic'
        self.schemas, self.channels, self.messages = {}, {}, []  # messages: (topic, ns, bytes)
        self.num_chunks = 0
        footer_at = len(data) - 8 - 9 - 20
        opcode, size, summary, offsets, crc = struct.unpack_from('<BQQQI', data, footer_at)
        assert (opcode, size) == (2, 20), 'no footer'
        assert crc == zlib.crc32(data[summary:footer_at + 25]), 'the checksum of the summary is wrong'
        self._read_data(summary)
        self._read_summary(summary, offsets, footer_at)

    def _read_data(self, end):
        self.message_places = {}  # (chunk offset, channel) -> [(ns, offset in the chunk)]
        chunk_at = None
        for opcode, at, content in records(self.data, 8, end):
            fields = Fields(content)
            if opcode == 1:
                self.profile, self.library = fields.text(), fields.text()
            elif opcode in (3, 4):
                self._read_definition(opcode, fields)
            elif opcode == 6:
                chunk_at = at
                self._read_chunk(at, fields)
            elif opcode == 7:
                channel, entries = fields.number('H'), Fields(fields.blob())
                listed = [(entries.number('Q'), entries.number('Q')) for _ in range(len(entries.data) // 16)]
                assert listed == sorted(self.message_places[chunk_at, channel]), 'a wrong index of messages'
            else:
                assert opcode == 0x0F, f'unexpected record {opcode}'

    def _read_definition(self, opcode, fields):
        number = fields.number('H')
        if opcode == 3:
            entry = {'name': fields.text(), 'encoding': fields.text(), 'text': fields.text()}
            assert self.schemas.setdefault(number, entry) == entry
        else:
            entry = {'schema': fields.number('H'), 'topic': fields.text(), 'encoding': fields.text(),
                     'metadata': fields.map('s', 's')}
            assert self.channels.setdefault(number, entry) == entry

    def _read_chunk(self, at, fields):
        self.num_chunks += 1
        start, end, size, crc, compression = (fields.number('Q'), fields.number('Q'), fields.number('Q'),
                                              fields.number('I'), fields.text())
        content = fields.blob('Q')
        assert compression == '' and size == len(content) and crc == zlib.crc32(content), 'a wrong chunk'
        times = []
        for opcode, offset, message in records(content, 0, len(content)):
            assert opcode == 5, 'a chunk with something else than messages'
            channel, sequence, log_ns, publish_ns = struct.unpack_from('<HIQQ', message)
            assert log_ns == publish_ns
            topic = self.channels[channel]['topic']
            assert sequence == sum(1 for known in self.messages if known[0] == topic), 'a gap in the sequence'
            self.messages.append((topic, log_ns, message[22:]))
            self.message_places.setdefault((at, channel), []).append((log_ns, offset))
            times.append(log_ns)
        assert (start, end) == (min(times), max(times)), 'a chunk with wrong times'

    def _read_summary(self, at, offsets, end):
        groups, num_indexed = {}, 0
        for opcode, place, content in records(self.data, at, offsets):
            groups.setdefault(opcode, [place, place])[1] = place + 9 + len(content)
            fields = Fields(content)
            if opcode in (3, 4):
                self._read_definition(opcode, fields)
            elif opcode == 8:
                fields.at = 16
                chunk_at = fields.number('Q')
                fields.number('Q')
                for channel, index_at in fields.map('H', 'Q').items():
                    assert (chunk_at, channel) in self.message_places and self.data[index_at] == 7
                num_indexed += 1
            elif opcode == 0x0B:
                self._check_statistics(fields)
        assert num_indexed == self.num_chunks, 'chunks without an index'
        listed = {}
        for opcode, _, content in records(self.data, offsets, end):
            assert opcode == 0x0E
            group, start, length = struct.unpack('<BQQ', content)
            listed[group] = [start, start + length]
        assert listed == groups, 'wrong offsets of the summary'

    def _check_statistics(self, fields):
        counted = [fields.number(kind) for kind in 'QHIIIIQQ']
        times = [ns for _, ns, _ in self.messages]
        assert counted == [len(self.messages), len(self.schemas), len(self.channels), 0, 0, self.num_chunks,
                           min(times), max(times)], 'wrong statistics'
        for channel, count in fields.map('H', 'Q').items():
            assert count == len(self.on(self.channels[channel]['topic']))

    def on(self, topic):
        """The messages of a topic as (ns, bytes)."""
        return [(ns, data) for name, ns, data in self.messages if name == topic]

    def type_of(self, topic):
        channel, = [entry for entry in self.channels.values() if entry['topic'] == topic]
        return self.schemas[channel['schema']]['name']
