"""Reads LCM messages without an LCM package for Python, which Debian does not have.

Both functions yield (channel, bytes); the classes that lcm-gen -p makes decode the bytes.
"""
import socket
import struct


def log(path):
    """The messages of a log."""
    with open(path, 'rb') as file:
        while header := file.read(28):
            sync, _, _, channel_size, data_size = struct.unpack('>IqqII', header)
            if sync != 0xEDA1DA01:
                raise ValueError(f'{path} is damaged before byte {file.tell()}')
            yield file.read(channel_size).decode(), file.read(data_size)


def live(group='239.255.76.67', port=7667):
    """The messages on the network as they come. Images come in fragments and are left out."""
    receiver = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    receiver.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    receiver.bind((group, port))
    receiver.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, socket.inet_aton(group) + bytes(4))
    while True:
        packet = receiver.recv(65536)
        if packet[:4] == b'LC02':  # then a number of 32 bits, the channel, a zero, the message
            channel, _, data = packet[8:].partition(b'\0')
            yield channel.decode(), data
