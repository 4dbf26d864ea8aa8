"""LCM logs and LCM's UDP packets, as far as the live faults need them."""
import socket
import struct
import threading
import time
from collections import defaultdict
from dataclasses import dataclass

from plumb_tools.command_line import UsageError

GROUP = '239.255.76.67'
PORT = 7667
SYNC = 0xEDA1DA01
SHORT, FRAGMENT = b'LC02', b'LC03'
SO_TIMESTAMPNS, SO_RCVBUFFORCE = 35, 33  # Linux; the module socket does not name them
RECEIVE_BYTES = 16 << 20


def url(port=PORT):
    """The network as the programs take it."""
    return f'udpm://{GROUP}:{port}?ttl=0'


def read_log(path):
    """Yields (log time in us, channel, data) of every event of an LCM log."""
    with open(path, 'rb') as file:
        while head := file.read(28):
            if len(head) < 28 or struct.unpack('>I', head[:4])[0] != SYNC:
                raise UsageError(f'{path} is no LCM log, or is cut')
            _, _, time_us, channel_bytes, data_bytes = struct.unpack('>IqqII', head)
            yield time_us, file.read(channel_bytes).decode(), file.read(data_bytes)


def write_log(path, events):
    """Writes (log time in us, channel, data) as an LCM log."""
    with open(path, 'wb') as file:
        for number, (time_us, channel, data) in enumerate(events):
            name = channel.encode()
            file.write(struct.pack('>IqqII', SYNC, number, time_us, len(name), len(data)) + name + data)


def stamp_of(data):
    """The time stamp of any of the project's messages: it follows the fingerprint."""
    return struct.unpack_from('>q', data, 8)[0]


def split_packet(packet):
    """(channel, the begin of the data) of a packet; (None, b'') when it does not begin a message."""
    if packet[:4] == FRAGMENT:
        if packet[16:18] != b'\0\0':
            return None, b''
        body = packet[20:]
    else:
        body = packet[8:] if packet[:4] == SHORT else b'\0'
    name, _, data = body.partition(b'\0')
    return name.decode('latin1') or None, data


class Sender:
    """Sends packets to the network of a port."""

    def __init__(self, port=PORT):
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_TTL, 0)
        self.socket.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, RECEIVE_BYTES)
        self.port, self.number = port, 0

    def send(self, packet):
        self.socket.sendto(packet, (GROUP, self.port))

    def publish(self, channel, data):
        """Sends a message that fits into one packet."""
        self.send(struct.pack('>4sI', SHORT, self.number) + channel.encode() + b'\0' + data)
        self.number += 1


def open_receiver(port):
    """A socket that hears the network of a port."""
    receiver = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    receiver.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    receiver.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, RECEIVE_BYTES)
    try:
        receiver.setsockopt(socket.SOL_SOCKET, SO_RCVBUFFORCE, RECEIVE_BYTES)
    except PermissionError:
        pass  # the smaller buffer does, unless this process is held up
    receiver.setsockopt(socket.SOL_SOCKET, SO_TIMESTAMPNS, 1)
    receiver.bind((GROUP, port))
    member = struct.pack('4s4s', socket.inet_aton(GROUP), socket.inet_aton('127.0.0.1'))
    receiver.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, member)
    receiver.settimeout(0.1)
    return receiver


class PacketThread(threading.Thread):
    """Calls take(packet, sender's port, calendar time of arrival in s) for every packet."""

    def __init__(self, port):
        super().__init__(daemon=True)
        self.receiver = open_receiver(port)
        self.is_ending = False
        self.start()

    def run(self):
        while not self.is_ending:
            try:
                packet, notes, _, source = self.receiver.recvmsg(65536, 256)
            except TimeoutError:
                continue
            arrival_s = time.time()
            for level, kind, value in notes:
                if level == socket.SOL_SOCKET and kind == SO_TIMESTAMPNS:
                    seconds, nanoseconds = struct.unpack('qq', value)
                    arrival_s = seconds + nanoseconds * 1e-9
            self.take(packet, source[1], arrival_s)

    def end(self):
        self.is_ending = True
        self.join()


@dataclass
class SentImage:
    """An image as it was put on the network."""
    arrival_s: float
    stamp_us: int
    source: int  # the sender's port


class Listener(PacketThread):
    """Keeps when images were sent, and all messages that fit into one packet, by channel."""

    def __init__(self, port=PORT):
        self.images = []
        self.messages = defaultdict(list)
        super().__init__(port)

    def take(self, packet, source, arrival_s):
        channel, data = split_packet(packet)
        if channel == 'CAMERA':
            if len(data) >= 16:
                self.images.append(SentImage(arrival_s, stamp_of(data), source))
        elif channel is not None and packet[:4] == SHORT:
            self.messages[channel].append((arrival_s, data))


class Relay(PacketThread):
    """Carries every packet from one network to another; `change` makes a list of each one."""

    def __init__(self, from_port, to_port, change):
        self.change = change
        self.sender = Sender(to_port)
        super().__init__(from_port)

    def take(self, packet, source, arrival_s):
        for changed in self.change(packet):
            self.sender.send(changed)
