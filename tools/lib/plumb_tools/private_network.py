"""A network of a program's own, which LCM multicast cannot leave."""
import os
import subprocess
import sys

from plumb_tools.command_line import UsageError

INSIDE = 'PLUMB_PRIVATE_NETWORK_OF'


def enter():
    """Starts this program again in a network of its own, and prepares that network for multicast."""
    name = os.path.abspath(sys.argv[0])
    if os.environ.get(INSIDE) == name:
        for words in ('link set lo up multicast on', 'route add 224.0.0.0/4 dev lo'):
            subprocess.run(['ip', *words.split()], check=True)
        return
    os.environ[INSIDE] = name
    flags = ['--net'] if os.geteuid() == 0 else ['--net', '--map-root-user']
    if subprocess.run(['unshare', *flags, 'true'], capture_output=True).returncode != 0:
        raise UsageError('a private network namespace is not permitted here (unshare --net)')
    os.execvp('unshare', ['unshare', *flags, sys.executable, *sys.argv])
