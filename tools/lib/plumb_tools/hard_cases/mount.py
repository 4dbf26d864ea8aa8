"""What the mount check says on CAN about a drive in which the camera is knocked."""
import math
import shlex

MOUNT_IDENTIFIER = '3A9'
STATUS_STEADY, STATUS_MOVED, STATUS_UNAVAILABLE = 2, 3, 0xF
ANGLE_BITS = {'pitch': 28, 'roll': 40, 'yaw': 52}
ANGLE_UNAVAILABLE = 0xFFF


class MountFrame:
    """One PLB_Mount frame: time, status, and the angles off the reference in degrees."""

    def __init__(self, time_s, data):
        raw = int.from_bytes(data, 'little')
        self.time_s = time_s
        self.status = raw >> 12 & 0xF
        self.angles_deg = {name: self._degrees(raw >> bit & 0xFFF) for name, bit in ANGLE_BITS.items()}

    @staticmethod
    def _degrees(raw):
        return math.nan if raw == ANGLE_UNAVAILABLE else math.degrees(0.0002 * raw - 0.4096)


def read_trace(lines):
    """The PLB_Mount frames of a CAN trace in candump's format."""
    frames = []
    for line in lines:
        time, _, frame = line.split()
        identifier, data = frame.split('#')
        if identifier == MOUNT_IDENTIFIER:
            frames.append(MountFrame(float(time.strip('()')), bytes.fromhex(data)))
    return frames


def knock_time_s(synth_text):
    """When the camera is knocked, in seconds from the first frame."""
    words = shlex.split(synth_text)
    return float(words[words.index('--knock-at') + 1])


def measure_mount(frames, knock_s, times, true_steps):
    """Figures of the mount check.

    They say after which distance it had its reference, what distance after the knock it first
    reported a moved camera, and how far off the camera is in the end. `times` are those of the
    images, and `knock_s` that of the knock, on the trace's clock.
    """
    frames = [frame for frame in frames if frame.status != STATUS_UNAVAILABLE]
    distances = [sum(true_steps[:i + 1]) for i in range(len(true_steps))]

    def distance_at(time_s):
        return distances[max(i for i, t in enumerate(times) if t <= time_s + 1e-3)]

    steady = [frame.time_s for frame in frames if frame.status == STATUS_STEADY]
    moved = [frame.time_s for frame in frames if frame.status == STATUS_MOVED]
    last_angles = frames[-1].angles_deg if frames else dict.fromkeys(ANGLE_BITS, math.nan)
    return {'mount_status': frames[-1].status if frames else math.nan,
            'mount_reference_m': distance_at(steady[0]) if steady else math.inf,
            'mount_false_alarms': sum(time_s < knock_s for time_s in moved),
            'mount_moved_m': distance_at(moved[0]) - distance_at(knock_s) if moved else math.inf,
            **{f'mount_{name}_deg': angle for name, angle in last_angles.items()}}
